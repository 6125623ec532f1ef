"""Counterweights over the turn without dust, and at the limits that they touch
(:mod:`optimizer.program.methods.rounding`)."""

from dataclasses import replace

import numpy as np

from optimizer.numerics.arrays import Complex, Real
from optimizer.program.cuts.semi_infinite import Problem
from optimizer.program.cuts.stage import Point
from optimizer.program.methods.compensation import near_limits
from optimizer.program.methods.plate_sizes import CutWeights, equal_sizes, unlike
from optimizer.program.methods.rounding import HEAVIER, NEAR
from optimizer.program.solution import CEILING_ROUNDING
from optimizer.program.statement import Statement
from optimizer.program.verdict import MASS_GAP

#: relative gap of the mass that may be left where plates are opened to their limit: most of what may be claimed
_HEAVIER_PLATES = 0.9 * MASS_GAP
#: all at once, then dust and limits by themselves, each as far as it can be had
_STEPS = ((NEAR[0], NEAR[0]), *((near, 0.0) for near in NEAR[1:]), *((0.0, near) for near in NEAR))


def snap_turn_to_limits(
    program: Problem, statement: Statement, point: Point, most: Real, mass_bound: float | None, width: float
) -> Point:
    """The point, settled as far as it is no worse for it.

    Parameters
    ----------
    statement : the program with some cuts; of every response one row is left as it was.
    most : (goals,) what the goals may come to; the point may be above it.
    mass_bound : kg, nothing is lighter; None where the mass does not count.
    width : of the brackets of all figures.
    """
    responses = [term.response for term in statement.names.terms]
    rows = [responses.index(name) for name in dict.fromkeys(responses)]
    influence = np.concatenate([statement.norms.influence[rows], statement.ceilings.norms.influence])
    # the edge of a full plate weighs much and moves little
    heavier = HEAVIER if program.plates is None else _HEAVIER_PLATES
    heaviest = np.inf if mass_bound is None else mass_bound / (1.0 - heavier)
    for dust, touched in _STEPS:
        u, is_new = near_limits(statement.limits, influence[None], point.unbalance[None], dust, touched)
        if not is_new[0]:
            continue
        point = _snap(program, point, u[0], most, heaviest, width) or point
    if program.plates is None:
        return point
    plates = program.plates
    angle = plates.opened(np.abs(point.unbalance[plates.webs]))
    if not unlike(plates, angle):
        return point
    alone = statement.alone()
    for cut in equal_sizes(alone, plates, CutWeights(point.unbalance, angle, point.mass)):
        alike = _snap(program, point, cut.unbalance, most, heaviest, width)
        if alike is not None:
            return alike
    return point


def _snap(program: Problem, point: Point, u: Complex, most: Real, heaviest: float, width: float) -> Point | None:
    """The point with other counterweights (K,), None where it is worse for them."""
    mass = program.mass(u)
    if mass > max(point.mass, heaviest):
        return None
    old, new = program.values(point.unbalance, width), program.values(u, width)
    verdict = np.all(new.goals <= np.maximum(most, old.goals))
    verdict &= new.over_budget <= max(old.over_budget, 0.0)
    verdict &= new.excess <= max(old.excess, CEILING_ROUNDING)
    return replace(point, unbalance=u, values=new, mass=mass) if verdict else None
