"""Whose crank each web belongs to: what angles from the own crank, balance rates and groups of webs refer to."""

import numpy as np

from optimizer.mechanics.balance_rate import web_shares
from optimizer.mechanics.layout import stacked
from optimizer.numerics.arrays import Real
from optimizer.numerics.memoization import remembered
from schemas.machine.machine import Machine
from schemas.machine.reciprocating import ReciprocatingMachine


@remembered
def shares(machine: ReciprocatingMachine) -> Real:
    """Which share of each web belongs to each throw, (..., throws, webs); fields of the machine may hold columns."""
    throw, web = (stacked([one.position_m for one in which]) for which in (machine.throws, machine.webs))
    if all(one.throw is None for one in machine.webs):
        return web_shares(throw, web)
    return web_shares(throw, web, stacked([np.nan if one.throw is None else one.throw for one in machine.webs]))


@remembered
def own_throws(machine: Machine) -> list[int | None]:
    """Number of the throw whose crank each web of one machine belongs to; None where it is none alone."""
    if not isinstance(machine, ReciprocatingMachine) or not machine.webs:
        return [None] * len(machine.webs)
    own: list[int | None] = [None] * len(machine.webs)
    throws, webs = (shares(machine) == 1.0).nonzero()
    for throw, web in zip(throws.tolist(), webs.tolist(), strict=True):
        own[web] = throw
    return own


def crank_angles(machine: Machine) -> list[float | None]:
    """Angle of the own crank of every web, deg, None where it has none; the eccentric of a scroll points along +x."""
    if not isinstance(machine, ReciprocatingMachine):
        return [0.0] * len(machine.webs)
    return [None if throw is None else machine.throws[throw].crank_angle_deg for throw in own_throws(machine)]
