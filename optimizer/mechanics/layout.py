"""A machine as arrays: the only thing that the effects read.

All arrays broadcast over leading axes, so that one machine and a million designs of one shape run
the same formulas. Angles are unit vectors (complex), as drawn at shaft angle 0.
"""

from dataclasses import dataclass

import numpy as np

from optimizer.mechanics.angles import direction
from optimizer.response import Complex, Real
from schemas.machine import ReciprocatingMachine, Rotor, ScrollMachine


@dataclass(frozen=True)
class Rotating:
    """Masses that turn with the shaft: (..., n)."""

    mass: Real  # kg
    radius: Real  # m
    direction: Complex
    position: Real  # m


@dataclass(frozen=True)
class Reciprocating:
    """Masses that move along an axis, driven by a crank: (..., n)."""

    mass: Real  # kg, with the rod's reciprocating share
    crank_radius: Real  # m
    crank_direction: Complex
    axis: Complex
    position: Real  # m
    rod_ratio: Real  # r/l; 0 for an infinite rod, nan where the rod is not given


@dataclass(frozen=True)
class Webs:
    """Places for counterweights: (..., n)."""

    position: Real  # m
    radius: Real  # m


@dataclass(frozen=True)
class Layout:
    """A machine as arrays."""

    omega: Real  # (...) rad/s
    sense: Real  # (...) +1 counter-clockwise, -1 clockwise
    centre_plane: Real  # (...) m, where couples are summed
    reference_plane: Real  # (...) m, where couples are reported
    rotating: Rotating
    reciprocating: Reciprocating
    webs: Webs


def layout(machine: ReciprocatingMachine | ScrollMachine) -> Layout:
    """Arrays of one machine (no leading axes); rods are shared between crosshead and pin here.

    Source: seed 001 l. 4 and 7 (share of the rod), seed 002 l. 735.
    """
    if isinstance(machine, ScrollMachine):
        rotating, reciprocating, planes = _scroll(machine)
    else:
        rotating, reciprocating, planes = _reciprocating(machine)
    centre = 0.5 * (min(planes) + max(planes))
    return Layout(
        omega=np.asarray(machine.speed_rpm * np.pi / 30.0),
        sense=np.asarray(1.0 if machine.rotation == "ccw" else -1.0),
        centre_plane=np.asarray(centre),
        reference_plane=np.asarray(centre if machine.reference_plane_m is None else machine.reference_plane_m),
        rotating=rotating,
        reciprocating=reciprocating,
        webs=_webs(machine),
    )


def _webs(machine: Rotor) -> Webs:
    return Webs(
        position=np.array([web.position_m for web in machine.webs], dtype=float),
        radius=np.array([web.counterweight_radius_m for web in machine.webs], dtype=float),
    )


def _reciprocating(machine: ReciprocatingMachine) -> tuple[Rotating, Reciprocating, list[float]]:
    turning = []  # mass, radius, angle, position
    moving = []  # mass, radius, crank angle, axis, position, rod ratio
    for throw in machine.throws:
        radius, angle, plane = throw.crank_radius_m, throw.crank_angle_deg, throw.position_m
        turning.append((throw.rotating_mass_kg, radius, angle, plane))
        for row in throw.rows:
            mass, ratio = row.reciprocating_mass_kg, np.nan
            if row.connecting_rod is not None:
                rod = row.connecting_rod
                mass += rod.reciprocating_share * rod.mass_kg
                ratio = 0.0 if rod.length_m is None else radius / rod.length_m
                # the big end turns in the plane of its own row, not in that of the throw
                turning.append(((1.0 - rod.reciprocating_share) * rod.mass_kg, radius, angle, plane + row.offset_m))
            moving.append((mass, radius, angle, row.axis_deg, plane + row.offset_m, ratio))
    return _rotating_table(turning), _reciprocating_table(moving), [throw.position_m for throw in machine.throws]


def _scroll(machine: ScrollMachine) -> tuple[Rotating, Reciprocating, list[float]]:
    orbit, guide = machine.orbit_radius_m, machine.anti_rotation
    turning = [(machine.orbiting_mass_kg, orbit, 0.0, machine.orbiting_position_m)]
    moving = []
    if guide.type == "oldham":
        # the ring slides along one axis with the orbit's projection: a crank with an infinite rod
        moving.append((guide.mass_kg, orbit, 0.0, guide.axis_deg, guide.position_m, 0.0))
    else:
        turning.append((guide.count * guide.eccentric_mass_kg, orbit, 0.0, guide.position_m))
    return _rotating_table(turning), _reciprocating_table(moving), [machine.orbiting_position_m]


def _rotating_table(rows: list[tuple[float, float, float, float]]) -> Rotating:
    mass, radius, angle, position = np.array(rows, dtype=float).reshape(-1, 4).T
    return Rotating(mass, radius, direction(angle), position)


def _reciprocating_table(rows: list[tuple[float, float, float, float, float, float]]) -> Reciprocating:
    mass, radius, angle, axis, position, ratio = np.array(rows, dtype=float).reshape(-1, 6).T
    return Reciprocating(mass, radius, direction(angle), direction(axis), position, ratio)
