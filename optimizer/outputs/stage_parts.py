"""The eight stages as data: what acts and what is left of it, and the iron of stage VII for any share.

Of the first-order force of a reciprocating mass, m r omega^2 cos phi along its axis, a counterweight that turns with
the shaft takes the share k away along the axis and brings k of it across. Its phasor is 2 k A1 for A1 the co-rotating
phasor: k = 1/2 removes A1 and leaves the counter-rotating phasor alone (Balancing, slides, stages III and VII).
"""

from dataclasses import replace
from typing import Literal

import numpy as np

from optimizer.mechanics.angles import angle_deg
from optimizer.mechanics.inertia import Wrench, reciprocating, rotating
from optimizer.mechanics.layout import Layout
from optimizer.numerics.arrays import Complex
from optimizer.outputs.rules_of_thumb import ONE_PLANE_M
from optimizer.responses.response import Phasors
from schemas.answer.stages import Acting, StageIron

#: the smaller phasor over the larger one below which it counts as none: an optimum leaves what the asked gap allows
_SHAPE = 1e-6
Motion = Literal["none", "with_shaft", "against_shaft", "fixed", "ellipse"]


def acting(pair: Phasors, order: int, speed: float, moment: bool, noise: float) -> Acting:
    """One force or moment.

    Parameters
    ----------
    speed : rad/s.
    noise : what is no larger than this is none.
    """
    motion, direction = _motion(pair, noise)
    none = motion == "none"
    return Acting(
        quantity="moment" if moment else "force",
        order=order,
        frequency_Hz=order * speed / (2.0 * np.pi),
        unit="N m" if moment else "N",
        peak=0.0 if none else float(pair.peak),
        minor=0.0 if none else float(pair.minor),
        motion=motion,
        direction_deg=direction,
    )


def of_wrench(wrench: Wrench, order: int, speed: float, noise: tuple[float, float]) -> tuple[Acting, Acting]:
    """Force and moment of one order."""
    force = acting(wrench.force, order, speed, False, noise[0])
    return force, acting(wrench.moment, order, speed, True, noise[1])


def _motion(pair: Phasors, noise: float) -> tuple[Motion, float | None]:
    co, counter = np.abs(pair.co), np.abs(pair.counter)
    if pair.peak <= noise:
        return "none", None
    if counter <= _SHAPE * co:
        return "with_shaft", float(np.mod(angle_deg(pair.co), 360.0))
    if co <= _SHAPE * counter:
        return "against_shaft", float(np.mod(angle_deg(pair.counter), 360.0))
    fixed = pair.minor <= _SHAPE * pair.peak
    return "fixed" if fixed else "ellipse", float(np.mod(pair.major_axis_deg, 180.0))


def iron(layout: Layout) -> tuple[StageIron, ...]:
    """Stage VII in the two outermost planes of the webs; in one where all webs are in one; none without webs."""
    planes = layout.webs.position
    if planes.size == 0:
        return ()
    centred = replace(layout, reference_plane=layout.centre_plane)
    turning, first = rotating(centred), reciprocating(centred, 1)
    low, high = float(np.min(planes)), float(np.max(planes))
    ends = (low, high) if high - low > ONE_PLANE_M else (low,)
    parts = [_against(ends, float(layout.centre_plane), *pair) for pair in (_co(turning, 1.0), _co(first, 2.0))]
    return tuple(
        StageIron(
            position_m=place,
            rotating_x_kg_m=float(turns.real),
            rotating_y_kg_m=float(turns.imag),
            reciprocating_x_kg_m=float(moves.real),
            reciprocating_y_kg_m=float(moves.imag),
        )
        for place, turns, moves in zip(ends, *parts, strict=True)
    )


def _co(wrench: Wrench, times: float) -> tuple[Complex, Complex]:
    return times * wrench.force.co, times * wrench.moment.co


def _against(ends: tuple[float, ...], centre: float, force: Complex, couple: Complex) -> tuple[complex, ...]:
    """u1 + u2 = -f, (z1 - centre) u1 + (z2 - centre) u2 = -c; of one plane the force alone."""
    if len(ends) == 1:
        return (complex(0.0 - force),)
    low, high = (end - centre for end in ends)
    return complex((couple - high * force) / (high - low)), complex((low * force - couple) / (high - low))
