"""Whose crank each web belongs to: what angles from the own crank, balance rates and groups of webs refer to."""

from collections.abc import Sequence
from functools import lru_cache
from itertools import chain
from typing import Any, NamedTuple

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
    places = _places(machine)
    if np.ndarray in map(type, chain(*places)):
        return _shares(*places)
    return _of_places(*places).shares


@remembered
def own_throws(machine: Machine) -> Sequence[int | None]:
    """Number of the throw whose crank each web of one machine belongs to; None where it is none alone."""
    if not isinstance(machine, ReciprocatingMachine) or not machine.webs:
        return [None] * len(machine.webs)
    return _of_places(*_places(machine)).throws


@remembered
def _places(machine: ReciprocatingMachine) -> tuple[tuple[Any, ...], tuple[Any, ...], tuple[Any, ...]]:
    """Places of throws and of webs, and the throws that webs name."""
    webs = machine.webs
    return (
        tuple([throw.position_m for throw in machine.throws]),
        tuple([web.position_m for web in webs]),
        tuple([web.throw for web in webs]),
    )


def _shares(throws: Sequence[Any], webs: Sequence[Any], stated_throws: Sequence[Any]) -> Real:
    if not any(throw is not None for throw in stated_throws):
        return web_shares(stacked(throws), stacked(webs))
    own = stacked([np.nan if throw is None else throw for throw in stated_throws])
    return web_shares(stacked(throws), stacked(webs), own)


class _Cranks(NamedTuple):
    """Whose crank each web of one machine belongs to; nobody writes to it."""

    shares: Real  # (throws, webs)
    throws: tuple[int | None, ...]  # (webs,)


# of machines that recur; of few, for large ones are a third of a megabyte
@lru_cache(maxsize=16)
def _of_places(throws: tuple[float, ...], webs: tuple[float, ...], stated_throws: tuple[int | None, ...]) -> _Cranks:
    fractions, own = _shares(throws, webs, stated_throws), dict[int, int]()
    for throw, web in zip(*map(np.ndarray.tolist, (fractions == 1.0).nonzero()), strict=True):
        own[web] = throw
    fractions.flags.writeable = False
    return _Cranks(fractions, tuple(own.get(web) for web in range(len(webs))))


def crank_angles(machine: Machine) -> list[float | None]:
    """Angle of the own crank of every web, deg, None where it has none; the eccentric of a scroll points along +x."""
    if not isinstance(machine, ReciprocatingMachine):
        return [0.0] * len(machine.webs)
    return [None if throw is None else machine.throws[throw].crank_angle_deg for throw in own_throws(machine)]
