"""Counterweights as masses and angles."""

from collections.abc import Iterator, Sequence
from itertools import compress

import numpy as np

from optimizer.formulation.limits import all_free, limit_sizes, sectors
from optimizer.mechanics.angles import angle_deg, direction
from optimizer.mechanics.crank_of_web import own_throws
from optimizer.mechanics.fixed_weights import beside
from optimizer.mechanics.layout import stacked, web_radii
from optimizer.mechanics.shapes import every_plate, plates
from optimizer.numerics.arrays import Complex, Real, all_true, any_true
from optimizer.program.limits import Limits
from schemas.answer.counterweights import Counterweight, Shape
from schemas.base.model import FieldProblem
from schemas.base.variation import with_fields
from schemas.machine.fitted import FittedCounterweight, GivenCounterweight
from schemas.machine.machine import Machine
from schemas.machine.reciprocating import BalanceShaft

#: of a mass, relative to it, and of an angle, relative to a turn
_ROUNDING = 8 * float(np.finfo(float).eps)
#: by which a mass that was answered may be above what its envelope holds
_ABOVE_ENVELOPE = 1e-12


def masses_and_angles(machine: Machine, unbalance: Complex, limits: Limits) -> tuple[Real, Real]:
    """Masses [kg] and angles [deg] of unbalances [kg m] (..., K), within the limits of the webs to the last digit.

    What a sum or the rounding of an angle has left outside, or next to a limit, is brought to the limit. Webs with
    equal castings are equal to the last digit.

    Parameters
    ----------
    limits : (..., K) of the machine.
    """
    mass, angle = _within(machine, unbalance, limits)
    return (mass, angle) if limits.alike is None else limits.alike.fitted(mass, angle)


def _within(machine: Machine, unbalance: Complex, limits: Limits) -> tuple[Real, Real]:
    mass, angle = np.abs(unbalance) / limits.radius, angle_deg(unbalance)
    full = mass >= limits.max_mass * (1.0 - _ROUNDING)
    if any_true(full):
        mass = np.where(full, limits.max_mass, mass)
    free, centre, half_angle = sectors(machine)
    if all_free(free):
        has_mass = mass > 0
        return mass, angle if all_true(has_mass) else np.where(has_mass, angle, 0.0)
    # reduced first, without which the edge of a sector at 1e6 degrees would be rounded to 1e-10
    centre = np.mod(centre, 360.0)
    off = _in_a_turn(angle - centre + 180.0) - 180.0
    over = np.abs(off) - half_angle
    outside = ~free & (over > 0) & (mass > 0)
    if any_true(outside):
        # few are
        mass[outside] *= np.maximum(np.cos(np.deg2rad(over[outside])), 0.0)
    edge = _in_a_turn(centre + np.copysign(half_angle, off))
    at_edge = ~free & (over > -_ROUNDING * 360.0)
    return mass, np.where(mass > 0, np.where(at_edge, edge, angle), 0.0)


def _in_a_turn(angle_deg: Real) -> Real:
    """Angles from -360 to 720 degrees within a turn, as the remainder is, in a third of its time."""
    return np.where(angle_deg < 0.0, angle_deg + 360.0, np.where(angle_deg >= 360.0, angle_deg - 360.0, angle_deg))


def unbalance(mass_kg: Real, angles_deg: Real, radius: Real) -> Complex:
    """Unbalances m R e^{ja} [kg m] of masses and angles (..., K): what every figure is evaluated from."""
    return mass_kg * radius * direction(angles_deg)


def mass_and_angle(
    machine: Machine, counterweights: Sequence[FittedCounterweight | GivenCounterweight]
) -> tuple[Real, Real]:
    """Masses (..., K) [kg] and angles (..., K) [deg] of counterweights on webs and of fixed weights;
    0 where a web has neither.

    Those on the webs of balance shafts stand behind those of the crankshaft.
    """
    weights = {counterweight.web: counterweight for counterweight in counterweights}
    fitted = [weights.get(web.name) for web in machine.every_web]
    mass = stacked([weight.mass_kg if weight else 0.0 for weight in fitted])
    angle = np.mod(stacked([weight.angle_deg if weight else 0.0 for weight in fitted]), 360.0)
    # what is not there has no direction, wherever it is said to be
    return beside(machine, mass, np.where(mass > 0.0, angle, 0.0))


def too_heavy(
    machine: Machine, weights: Sequence[FittedCounterweight | GivenCounterweight], field: str
) -> Iterator[FieldProblem]:
    """Counterweights of a field of the request that are more than the envelope of their web holds."""
    cut, webs = every_plate(machine), machine.every_web
    if cut is None:
        return
    most = {webs[k].name: mass for k, mass in zip(cut.webs.tolist(), cut.mass(cut.most).tolist(), strict=True)}
    for index, weight in enumerate(weights):
        if weight.mass_kg > most.get(str(weight.web), np.inf) * (1.0 + _ABOVE_ENVELOPE):
            message = f"the envelope of this web holds {most[str(weight.web)]:.6g} kg at most"
            yield FieldProblem((field, index, "mass_kg"), message)


def counterweights(
    machine: Machine, mass_kg: Real, angles_deg: Real, vectors: Complex | None = None
) -> tuple[Counterweight, ...]:
    """The counterweights of a machine, one for each web of its crankshaft.

    Parameters
    ----------
    vectors : (K,) kg m, their unbalances, if at hand.
    """
    return _placed(machine, mass_kg, angles_deg, own_throws(machine), 1.0, vectors)


def unbalances_of_shaft(
    machine: Machine, shaft: BalanceShaft, mass_kg: Real, angles_deg: Real
) -> tuple[Counterweight, ...]:
    """The unbalances of a balance shaft (S,), one for each of its webs."""
    alone = with_fields(machine, {("webs",): shaft.webs})
    return _placed(alone, mass_kg, angles_deg, [None] * len(shaft.webs), float(shaft.speed_ratio))


def _placed(
    machine: Machine,
    mass_kg: Real,
    angles_deg: Real,
    own: Sequence[int | None],
    ratio: float,
    vectors: Complex | None = None,
) -> tuple[Counterweight, ...]:
    """One for each web of a machine.

    Parameters
    ----------
    own : throw of each web.
    ratio : turns of the webs for one of the crankshaft.
    """
    limits = limit_sizes(machine)
    touched = [limit.touched(machine, mass_kg, angles_deg).tolist() for limit, _ in limits.values()]
    if vectors is None:
        vectors = unbalance(mass_kg, angles_deg, web_radii(machine))
    throws, webs = machine.throws, machine.webs
    active = [tuple(compress(limits, at)) for at in zip(*touched, strict=True)] or [()] * len(webs)
    shapes, radii = _shapes(machine, mass_kg), web_radii(machine).tolist()
    square = (ratio * (machine.overspeed_rpm or machine.speed_rpm) * np.pi / 30.0) ** 2
    return tuple(
        [
            Counterweight.of_figures(
                {
                    "web": web.name,
                    "mass_kg": mass,
                    "angle_deg": angle,
                    "position_m": web.position_m,
                    "radius_m": radius,
                    "throw": throw,
                    # twice, because a hair below 0 comes to 360
                    "angle_from_crank_deg": None
                    if throw is None or mass == 0.0
                    else (angle - throws[throw].crank_angle_deg) % 360.0 % 360.0,
                    "mass_radius_kg_m": mass * radius,
                    "x_kg_m": vector.real,
                    "y_kg_m": vector.imag,
                    "centrifugal_force_N": mass * radius * square,
                    "active_limits": () if (fixed := web.fixed) else active[k],
                    "fixed": fixed is not None,
                    "shape": shapes.get(k) if mass > 0.0 else None,
                }
            )
            for k, (web, radius, mass, angle, vector, throw) in enumerate(
                zip(webs, radii, mass_kg.tolist(), angles_deg.tolist(), vectors.tolist(), own, strict=True)
            )
        ]
    )


def _shapes(machine: Machine, mass_kg: Real) -> dict[int, Shape]:
    """What is cut of the plates of a machine, by number of the web."""
    cut = plates(machine)
    if cut is None:
        return {}
    radius = np.array([machine.webs[k].radius_m for k in cut.webs])
    half_angle = cut.opened_by_mass(mass_kg[cut.webs], radius)
    figures = (np.rad2deg(half_angle), cut.chord(half_angle), cut.outer, cut.inertia(half_angle))
    return {
        k: Shape(
            half_angle_deg=opening,
            chord_height_m=None if np.isnan(chord) else chord,
            outer_radius_m=outer,
            inertia_kg_m2=inertia,
        )
        for k, opening, chord, outer, inertia in zip(
            cut.webs.tolist(), *(figure.tolist() for figure in figures), strict=True
        )
    }
