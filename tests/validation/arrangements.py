"""Published crank arrangements: what is left of forces and moments, in units of one row.

F0 = m r omega^2 of one row, a the distance of neighbouring planes, lambda = 1/5. Moments are about the middle. The
second order is in units of F0 A2, A2 = lambda + lambda^3/4 + 15 lambda^5/128 + ..., the exact harmonic; the sources
write lambda. Sources: the five named in docs/validation.md; of engines, sums over the star of their cranks by hand.
"""

from collections.abc import Iterator, Sequence
from typing import Any, Literal, NamedTuple

import numpy as np

from optimizer.analyze import analyze
from schemas.request.requests import AnalyzeRequest
from tests.validation.comparison import Comparison, Misprint

LAMBDA = 0.2
#: of the exact acceleration of a piston at lambda = 0.2, from its Fourier integral
_TURN = 2.0 * np.pi * np.arange(64) / 64.0
_TRAVEL = np.cos(_TURN) + np.sqrt(1.0 / LAMBDA**2 - np.sin(_TURN) ** 2)
SECOND = float(4.0 * 2.0 * np.mean(_TRAVEL * np.cos(2.0 * _TURN)))


class Arrangement(NamedTuple):
    """Throws as (crank angle, axes) in planes one apart, or in the planes given; peaks of force and moment."""

    name: str
    throws: Sequence[tuple[float, Sequence[float]]]
    force_1: float
    moment_1: float
    force_2: float
    moment_2: float
    planes: Sequence[float] | None = None
    masses: Sequence[float] | None = None
    #: where the sources have the arrangement and leave the figures to the reader
    kind: Literal["published", "analytic"] = "published"


_ROOT = np.sqrt
_UP = (90.0,)
_V = (135.0, 45.0)
# cranks of cylinders 1 to 5 that fire 1-2-4-5-3, 144 deg apart
_FIVE = (0.0, -144.0, -576.0, -288.0, -432.0)


def _couple(order: int) -> float:
    """Of the five: the sum of arms from the middle times the crank's direction, taken so many times as fast."""
    return float(abs(np.dot(np.arange(5.0) - 2.0, np.exp(1j * order * np.radians(_FIVE)))))


#: of sources on compressors, then of engines
PUBLISHED = (
    Arrangement("single row", [(0, _UP)], 1, 0, 1, 0),
    Arrangement("two rows in line, cranks at 90 deg", [(0, _UP), (90, _UP)], _ROOT(2), _ROOT(0.5), 0, 1),
    Arrangement("two rows in line, cranks at 180 deg", [(0, _UP), (180, _UP)], 0, 1, 2, 0),
    Arrangement("opposed pair (D type)", [(0, (0,)), (180, (180,))], 0, 1, 0, 1),
    Arrangement("opposed on a forked rod", [(0, (0,)), (180, (180,))], 0, 0, 0, 0, (0, 0),
                kind="analytic"),
    Arrangement("pistons that move the same way, one throw", [(0, (0, 180))], 2, 0, 0, 0, kind="analytic"),
    Arrangement("M type, four opposed columns at 90 deg", [(0, (0,)), (180, (180,)), (90, (0,)), (270, (180,))],
                0, _ROOT(2), 0, 0, kind="analytic"),
    Arrangement("four opposed columns, second pair mirrored at 90 deg",
                [(0, (0,)), (180, (180,)), (270, (180,)), (90, (0,))], 0, _ROOT(2), 0, 2, kind="analytic"),
    Arrangement("six opposed columns, pair couples at 0, 240, 120 deg",
                [(0, (0,)), (180, (180,)), (240, (0,)), (60, (180,)), (120, (0,)), (300, (180,))], 0, 0, 0, 0),
    Arrangement("opposed triple, m = 1/2, 1, 1/2", [(180, (180,)), (0, (0,)), (180, (180,))], 0, 0, 0, 0,
                masses=(0.5, 1.0, 0.5), kind="analytic"),
    Arrangement("V 90 deg", [(0, _V)], 1, 0, _ROOT(2), 0),
    Arrangement("V 60 deg", [(0, (120.0, 60.0))], 1.5, 0, _ROOT(0.75), 0, kind="analytic"),
    Arrangement("W 60 deg", [(0, (150.0, 90.0, 30.0))], 1.5, 0, 1.5, 0),
    Arrangement("in-line three", [(0, _UP), (120, _UP), (240, _UP)], 0, _ROOT(3), 0, _ROOT(3), kind="analytic"),
    Arrangement("in-line four", [(0, _UP), (180, _UP), (180, _UP), (0, _UP)], 0, 0, 4, 0, kind="analytic"),
    Arrangement("in-line five, 1-2-4-5-3", [(angle, _UP) for angle in _FIVE], 0, _couple(1), 0, _couple(2),
                kind="analytic"),
    Arrangement("in-line six", [(a, _UP) for a in (0, 120, 240, 240, 120, 0)], 0, 0, 0, 0, kind="analytic"),
    Arrangement("boxer four", [(0, (0,)), (180, (180,)), (180, (0,)), (0, (180,))], 0, 0, 0, 2, kind="analytic"),
    Arrangement("V8 90 deg, flat shaft", [(a, _V) for a in (0, 180, 180, 0)], 0, 0, 4 * _ROOT(2), 0, kind="analytic"),
    Arrangement("V8 90 deg, cross shaft", [(a, _V) for a in (0, 90, 270, 180)], 0, _ROOT(10), 0, 0, kind="analytic"),
)  # fmt: skip


def machine(of: Arrangement) -> dict[str, Any]:
    """The arrangement as posted, with F0 = 1 N and a = 1 m."""
    planes = of.planes or np.arange(len(of.throws), dtype=float)
    masses = of.masses or np.ones(len(of.throws))
    return {
        "kind": "reciprocating",
        "speed_rpm": 30.0 / np.pi,
        "reference_plane_m": float(0.5 * (min(planes) + max(planes))),
        "throws": [
            {
                "position_m": float(plane),
                "crank_radius_m": 1.0,
                "crank_angle_deg": float(crank) % 360.0,
                "rows": [
                    {"axis_deg": axis, "reciprocating_mass_kg": mass, "connecting_rod": {"length_m": 1.0 / LAMBDA}}
                    for axis in axes
                ],
            }
            for (crank, axes), plane, mass in zip(of.throws, planes, masses, strict=True)
        ],
    }


def comparisons() -> Iterator[Comparison]:
    for of in PUBLISHED:
        first, second = _orders(of)[:2]
        figures = (
            ("first-order force, F0", of.force_1, first.force.peak_N),
            ("first-order moment, F0 a", of.moment_1, first.moment.peak_Nm),
            ("second-order force, F0 A2", of.force_2, second.force.peak_N / SECOND),
            ("second-order moment, F0 A2 a", of.moment_2, second.moment.peak_Nm / SECOND),
        )
        for quantity, expected, ours in figures:
            yield Comparison(of.name, quantity, of.kind, float(expected), ours, 1e-12, "-")


def misprints() -> Iterator[Misprint]:
    """What the sources print of arrangements, and what is right."""
    four, mirrored = (next(of for of in PUBLISHED if of.name.startswith(name)) for name in ("M type", "four opposed"))
    slides = "Lecture slides on compressors, balancing"
    reason = "remains only where the second pair is mirrored, 2 F0 A2 a; in the same order it cancels"
    second = _orders(four)[1].moment.peak_Nm / SECOND
    right = Comparison(four.name, "second-order moment", "analytic", 0.0, second, 1e-12, "F0 A2 a")
    yield Misprint(slides, "four opposed columns: a second-order moment remains", mirrored.moment_2, right, reason)
    literal = Arrangement(
        "six columns, pair couples at 0, 60, 120 deg",
        [(0, (0,)), (180, (180,)), (60, (0,)), (240, (180,)), (120, (0,)), (300, (180,))], 0, 2, 0, 0,
    )  # fmt: skip
    moment = _orders(literal)[0].moment.peak_Nm
    right = Comparison(literal.name, "first-order moment", "analytic", 2.0, moment, 1e-12, "F0 a")
    reason = "pair couples must be 120 deg apart; throws are 60 deg apart because a pair has two"
    yield Misprint(slides, "six columns offset by 60 deg: all balances", 0.0, right, reason)
    turn, axis = np.deg2rad(40.0), np.deg2rad(60.0)
    square = np.cos(turn) ** 2 + np.cos(turn + axis) ** 2
    resultant = np.abs(_force_of_v(axis, turn))
    expected = np.sqrt(square + 2.0 * np.cos(turn) * np.cos(turn + axis) * np.cos(axis))
    right = Comparison("V 60 deg", "first-order force at 40 deg", "analytic", expected, resultant, 1e-12, "F0")
    reason = "the axes are not perpendicular: 2 cos phi cos(phi + gamma) cos gamma is missing"
    yield Misprint("Balancing (slides)", "V not at 90 deg: resultant", float(np.sqrt(square)), right, reason)


def _orders(of: Arrangement) -> Any:
    orders = analyze(AnalyzeRequest.model_validate({"machine": machine(of), "outputs": ["orders"]})).orders
    assert orders is not None
    return orders.before


def _force_of_v(axis: float, turn: float) -> complex:
    """First-order force of a V by its phasors, its second axis behind the first in the sense of rotation."""
    first = _orders(Arrangement("", [(0, (0.0, -float(np.rad2deg(axis))))], 0, 0, 0, 0))[0].force
    co, counter = (
        complex(rotating.real_N, rotating.imag_N) for rotating in (first.co_rotating, first.counter_rotating)
    )
    return complex(co * np.exp(1j * turn) + counter * np.exp(-1j * turn))
