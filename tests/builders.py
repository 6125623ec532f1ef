"""Builders of machines for tests: a shorthand for fixed ones, random ones, and hypothesis strategies."""

from collections.abc import Callable, Sequence
from dataclasses import fields, is_dataclass
from typing import Any, TypeVar

import numpy as np
from hypothesis import strategies as st

from optimizer.mechanics.inertia import reciprocating, rotating
from optimizer.mechanics.layout import Layout
from optimizer.mechanics.slider_crank import acceleration_harmonic
from optimizer.numerics.arrays import Complex, Real
from optimizer.outputs.ellipses import Ellipse, polar_pairs
from optimizer.outputs.stages import stages
from optimizer.responses.response import Phasors
from schemas.answer.outputs import Stage
from schemas.machine.reciprocating import ReciprocatingMachine
from schemas.machine.throws import ConnectingRod, Row, Throw
from schemas.machine.webs import Web

OMEGA = 50.0  # rad/s, the speed of the seeds' reference figures
RPM = OMEGA * 30.0 / np.pi
RADIUS = 0.14  # m
ROD_RATIO = 0.2

T = TypeVar("T")


def row(axis_deg: float, mass_kg: float = 10.0, *, offset_m: float = 0.0, length_m: float | None = 0.7) -> Row:
    """A row with a massless rod."""
    return Row(
        axis_deg=axis_deg,
        offset_m=offset_m,
        reciprocating_mass_kg=mass_kg,
        connecting_rod=ConnectingRod(length_m=length_m),
    )


def throw(crank_deg: float, *rows: Row, z: float = 0.0, rotating_kg: float = 0.0, radius_m: float = RADIUS) -> Throw:
    return Throw(
        position_m=z, crank_radius_m=radius_m, crank_angle_deg=crank_deg, rotating_mass_kg=rotating_kg, rows=rows
    )


def web(name: str, z: float, *, radius_m: float = 0.2, max_mass_kg: float = 100.0) -> Web:
    return Web(name=name, position_m=z, counterweight_radius_m=radius_m, max_mass_kg=max_mass_kg)


def machine(*throws: Throw, webs: Sequence[Web] = (), speed_rpm: float = RPM, **rest: Any) -> ReciprocatingMachine:
    return ReciprocatingMachine(kind="reciprocating", speed_rpm=speed_rpm, throws=throws, webs=tuple(webs), **rest)


def inline(cranks_deg: Sequence[float], positions_m: Sequence[float], axis_deg: float = 90.0) -> list[Throw]:
    """Equal rows on parallel axes, 10 kg reciprocating and 10 kg rotating each."""
    return [throw(d, row(axis_deg), z=z, rotating_kg=10.0) for d, z in zip(cranks_deg, positions_m, strict=True)]


def opposed(cranks_deg: Sequence[float], positions_m: Sequence[float]) -> list[Throw]:
    """As :func:`inline`, with the axes in turn at 0 and 180 degrees."""
    return [
        throw(d, row(180.0 * (i % 2)), z=z, rotating_kg=10.0)
        for i, (d, z) in enumerate(zip(cranks_deg, positions_m, strict=True))
    ]


def random_machine(rng: np.random.Generator, style: str = "any", rod_ratios: tuple[float, float] = (0.1, 0.6)) -> Any:
    """A machine of a kind of layout: "v", "star", "opposed", "offset", "cw", "plane" or "any".

    Every one has unequal masses, radii and rods; "offset" has rows beside their throw's plane, "cw" turns
    clockwise, "plane" has its moments about a plane away from the middle.
    """
    size = 5 if style == "star" else 2
    throws = []
    for _ in range(rng.integers(1, 5)):
        radius = rng.uniform(0.02, 0.4)
        first = rng.uniform(0.0, 360.0)
        rows = []
        for i in range(size):
            axis = {"star": 72.0 * i, "opposed": 180.0 * i, "v": 70.0 * i}.get(style, rng.uniform(-400.0, 400.0))
            rod = ConnectingRod(
                length_m=radius / rng.uniform(*rod_ratios),
                mass_kg=rng.uniform(0.0, 20.0),
                reciprocating_share=rng.uniform(0.0, 1.0),
            )
            offset = rng.uniform(-0.3, 0.3) if style in ("offset", "any") else 0.0
            rows.append(
                Row(
                    axis_deg=first + axis,
                    offset_m=offset,
                    reciprocating_mass_kg=rng.uniform(1.0, 50.0),
                    connecting_rod=rod,
                )
            )
        throws.append(
            throw(
                rng.uniform(-400.0, 400.0),
                *rows,
                z=rng.uniform(-1.0, 1.0),
                rotating_kg=rng.uniform(0.0, 30.0),
                radius_m=radius,
            )
        )
    return machine(
        *throws,
        webs=[web(str(k), rng.uniform(-1.0, 1.0)) for k in range(3)],
        speed_rpm=rng.uniform(100.0, 3000.0),
        rotation="cw" if style == "cw" or (style == "any" and rng.random() < 0.5) else "ccw",
        reference_plane_m=rng.uniform(-2.0, 2.0) if style in ("plane", "any") else None,
    )


def stack(layouts: Sequence[T]) -> T:
    """Layouts of one shape as one layout with a leading axis."""
    first = layouts[0]
    parts = {
        f.name: stack([getattr(layout, f.name) for layout in layouts])
        if is_dataclass(getattr(first, f.name))
        else np.stack([getattr(layout, f.name) for layout in layouts])
        for f in fields(first)  # type: ignore[arg-type]
    }
    return type(first)(**parts)


def force_scale(layout: Layout) -> float:
    """Sum of all mass-radius products, kg m: what rounding errors of forces are measured by."""
    turning, moving = layout.rotating, layout.reciprocating
    return float(np.sum(turning.mass * turning.radius) + np.sum(moving.mass * moving.crank_radius))


def moment_scale(layout: Layout) -> float:
    """The same for couples, kg m^2, with the longest arm that occurs."""
    planes = np.concatenate([layout.rotating.position, layout.reciprocating.position, [layout.reference_plane]])
    return force_scale(layout) * float(np.ptp(planes) + 1e-3)


def _number(low: float, high: float) -> st.SearchStrategy[float]:
    return st.floats(low, high, allow_nan=False, allow_subnormal=False)


ANGLES = st.one_of(_number(-720.0, 720.0), st.sampled_from([0.0, 30.0, 45.0, 60.0, 90.0, 120.0, 180.0, 270.0]))
POSITIONS = _number(-5.0, 5.0)


@st.composite
def rows(draw: st.DrawFn, radius_m: float) -> Row:
    rod = ConnectingRod(
        length_m=draw(st.one_of(st.none(), st.builds(lambda q: radius_m / q, _number(0.05, 0.9)))),
        mass_kg=draw(_number(0.0, 50.0)),
        reciprocating_share=draw(_number(0.0, 1.0)),
    )
    return Row(
        axis_deg=draw(ANGLES),
        offset_m=draw(_number(-1.0, 1.0)),
        reciprocating_mass_kg=draw(_number(0.0, 500.0)),
        connecting_rod=rod,
    )


@st.composite
def throws(draw: st.DrawFn) -> Throw:
    radius = draw(_number(0.01, 1.0))
    return Throw(
        position_m=draw(POSITIONS),
        crank_radius_m=radius,
        crank_angle_deg=draw(ANGLES),
        rotating_mass_kg=draw(_number(0.0, 500.0)),
        rows=tuple(draw(st.lists(rows(radius), max_size=3))),
    )


@st.composite
def machines(draw: st.DrawFn) -> ReciprocatingMachine:
    """Any machine of up to four throws, three rows on each and three webs."""
    return machine(
        *draw(st.lists(throws(), min_size=1, max_size=4)),
        webs=[web(str(k), draw(POSITIONS)) for k in range(draw(st.integers(0, 3)))],
        speed_rpm=draw(_number(10.0, 10000.0)),
        rotation=draw(st.sampled_from(["ccw", "cw"])),
        reference_plane_m=draw(st.one_of(st.none(), POSITIONS)),
    )


def all_stages(
    arrays: Layout, unbalance: Complex | None, harmonic: Callable[[int, Real], Real] = acceleration_harmonic
) -> tuple[Stage, ...]:
    """The eight stages of a machine, from its own inertia forces."""
    parts = rotating(arrays), reciprocating(arrays, 1), reciprocating(arrays, 2, harmonic)
    return tuple(map(Stage.of_figures, stages(arrays, *parts, unbalance)))


def ellipse(phasors: Phasors) -> Ellipse:
    """On which the vector of a pair moves."""
    (polar,) = polar_pairs([complex(phasors.co), complex(phasors.counter)])
    return polar.ellipse
