"""The eight stages as data: what acts and what is left of it, and the iron of stage VII for any share.

Of the first-order force of a reciprocating mass, m r omega^2 cos phi along its axis, a counterweight that turns with
the shaft takes the share k away along the axis and brings k of it across. Its phasor is 2 k A1 for A1 the co-rotating
phasor: k = 1/2 removes A1 and leaves the counter-rotating phasor alone (Balancing, slides, stages III and VII).
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import Literal

import numpy as np

from optimizer.mechanics.inertia import Wrench, reciprocating, rotating
from optimizer.mechanics.layout import Layout
from optimizer.numerics.arrays import Complex
from optimizer.outputs.ellipses import Ellipse
from optimizer.outputs.rules_of_thumb import SAME_PLANE_M
from schemas.answer.stages import Acting, StageIron

#: the smaller phasor over the larger one below which it counts as none: an optimum leaves what the asked gap allows
_SHAPE = 1e-6
Motion = Literal["none", "with_shaft", "against_shaft", "fixed", "ellipse"]


def actings(parts: Sequence[tuple[Ellipse, int]], speed: float, noise: tuple[float, float]) -> tuple[Acting, ...]:
    """Force and moment, in turn, of some wrenches, each with its order.

    Parameters
    ----------
    speed : rad/s.
    noise : force and moment that are none where they are no larger than this.
    """
    return tuple(_acting(*part, k % 2 == 1, speed, noise[k % 2]) for k, part in enumerate(parts))


def _acting(pair: Ellipse, order: int, moment: bool, speed: float, noise: float) -> Acting:
    motion, direction = _motion(pair, noise)
    return Acting(
        quantity="moment" if moment else "force",
        order=order,
        frequency_Hz=order * speed / (2.0 * np.pi),
        unit="N m" if moment else "N",
        peak=0.0 if motion == "none" else pair.peak,
        minor=0.0 if motion == "none" else pair.minor,
        motion=motion,
        direction_deg=direction,
    )


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


def iron(layout: Layout, turning: Wrench, first: Wrench) -> tuple[StageIron, ...]:
    """Stage VII in the two outermost planes of the webs; in one where all webs are in one; none without webs."""
    planes = layout.webs.position
    if planes.size == 0:
        return ()
    layout, turning, first = about_centre(layout, turning, first)
    low, high = float(np.min(planes)), float(np.max(planes))
    ends = (low, high) if high - low > SAME_PLANE_M else (low,)
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
