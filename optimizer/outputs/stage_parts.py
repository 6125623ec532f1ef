"""The eight stages as data: what acts and what is left of it, and the iron of stage VII for any share.

Of the first-order force of a reciprocating mass, m r omega^2 cos phi along its axis, a counterweight that turns with
the shaft takes the share k away along the axis. It brings k of it across. Its phasor is 2 k A1 for A1 the co-rotating
phasor: k = 1/2 removes A1 and leaves the counter-rotating phasor alone (Balancing, slides, stages III and VII).
"""

from collections.abc import Sequence
from dataclasses import replace
from math import pi
from typing import Any, Literal

from optimizer.mechanics.inertia import Wrench, reciprocating, rotating
from optimizer.mechanics.layout import Layout
from optimizer.outputs.ellipses import Ellipse
from optimizer.outputs.phasors import PlainWrench
from optimizer.outputs.rules_of_thumb import SAME_PLANE_M
from schemas.answer.stages import StageIron

#: the smaller phasor over the larger one below which it counts as none: an optimum leaves what its target gap allows
_SHAPE = 1e-6
Motion = Literal["none", "with_shaft", "against_shaft", "fixed", "ellipse"]


def superposed(turning: PlainWrench, first: PlainWrench, fitted: PlainWrench) -> tuple[PlainWrench, PlainWrench]:
    """What counterweights leave of rotating and first-order reciprocating masses (:mod:`optimizer.outputs.stages`)."""
    force, of_first = _split(turning.force, first.force, fitted.force)
    moment, of_couple = _split(turning.moment, first.moment, fitted.moment)
    return (
        PlainWrench(force, turning.counter_force, moment, turning.counter_moment),
        PlainWrench(
            of_first,
            first.counter_force + fitted.counter_force,
            of_couple,
            first.counter_moment + fitted.counter_moment,
        ),
    )


def _split(turning: complex, first: complex, fitted: complex) -> tuple[complex, complex]:
    """Of phasors that turn with the shaft: what counterweights leave of both; the first is opposed first."""
    size = abs(turning)
    outward = turning / size if size else 0j
    opposed = min(max(-(fitted * outward.conjugate()).real, 0.0), size)
    return (size - opposed) * outward, first + fitted + opposed * outward


def missing(planes: Sequence[float], centre: float, force: complex, couple: complex) -> float:
    """Stage VII: |u1| + |u2| of two planes that cancel all that turns with the shaft, kg m.

    Parameters
    ----------
    planes, centre : of the webs, and that about which the couple is, m.
    force, couple : over omega^2, kg m and kg m^2.
    """
    if not planes:
        return abs(force)
    low, high = min(planes), max(planes)
    return float(in_two_planes(force, couple, low, high, centre)) if high - low > SAME_PLANE_M else abs(force)


def in_two_planes(force: Any, couple: Any, low: Any, high: Any, centre: Any) -> Any:
    """The same (...) of planes that are apart."""
    return (abs(couple - (high - centre) * force) + abs(couple - (low - centre) * force)) / (high - low)


def actings(
    parts: Sequence[tuple[Ellipse, int]], speed: float, noise: tuple[float, float]
) -> tuple[dict[str, Any], ...]:
    """Fields (:class:`schemas.answer.stages.Acting`) of force and moment, in turn, of wrenches, each with its order.

    Parameters
    ----------
    speed : rad/s.
    noise : force and moment that are none where they are no larger than this.
    """
    return tuple([_acting(*part, k % 2 == 1, speed, noise[k % 2]) for k, part in enumerate(parts)])


def _acting(pair: Ellipse, order: int, moment: bool, speed: float, noise: float) -> dict[str, Any]:
    motion, direction = _motion(pair, noise)
    return {
        "quantity": "moment" if moment else "force",
        "order": order,
        "frequency_Hz": order * speed / (2.0 * pi),
        "unit": "N m" if moment else "N",
        "peak": 0.0 if motion == "none" else pair.peak,
        "minor": 0.0 if motion == "none" else pair.minor,
        "motion": motion,
        "direction_deg": direction,
    }


def _motion(pair: Ellipse, noise: float) -> tuple[Motion, float | None]:
    """How a pair moves, and in which direction."""
    if not pair.peak > noise:
        return "none", None
    if pair.counter <= _SHAPE * pair.co:
        return "with_shaft", pair.co_deg
    if pair.co <= _SHAPE * pair.counter:
        return "against_shaft", pair.counter_deg
    return "fixed" if pair.minor <= _SHAPE * pair.peak else "ellipse", pair.axis_deg


def about_centre(layout: Layout, turning: Wrench, first: Wrench) -> tuple[Layout, Wrench, Wrench]:
    """A machine and its rotating and first-order forces with couples about the centre: a far reference plane would
    cost digits."""
    if layout.central:
        return layout, turning, first
    centred = replace(layout, reference_plane=layout.centre_plane)
    return centred, rotating(centred), reciprocating(centred, 1)


def iron(planes: Sequence[float], centre: float, turning: PlainWrench, first: PlainWrench) -> tuple[StageIron, ...]:
    """Stage VII in the two outermost planes of the webs; in one where all webs are in one; none without webs.

    Parameters
    ----------
    planes, centre : of the webs, and that about which couples are, m.
    turning, first : of rotating masses, and of the first order of reciprocating ones, over omega^2.
    """
    if not planes:
        return ()
    low, high = min(planes), max(planes)
    ends = (low, high) if high - low > SAME_PLANE_M else (low,)
    turns = _against(ends, centre, turning.force, turning.moment)
    moves = _against(ends, centre, 2.0 * first.force, 2.0 * first.moment)
    return tuple(
        [
            StageIron(
                position_m=place,
                rotating_x_kg_m=turn.real,
                rotating_y_kg_m=turn.imag,
                reciprocating_x_kg_m=move.real,
                reciprocating_y_kg_m=move.imag,
            )
            for place, turn, move in zip(ends, turns, moves, strict=True)
        ]
    )


def _against(ends: tuple[float, ...], centre: float, force: complex, couple: complex) -> tuple[complex, ...]:
    """u1 + u2 = -f, (z1 - centre) u1 + (z2 - centre) u2 = -c; of one plane the force alone."""
    if len(ends) == 1:
        return (0.0 - force,)
    low, high = (end - centre for end in ends)
    # not high - low: the webs may be far from the centre
    apart = ends[1] - ends[0]
    return (couple - high * force) / apart, (low * force - couple) / apart
