"""Light sets near the optimum of any masses, of slots with many options.

The lightest optimum of any masses is on few webs. Their options near it are compared in halves, beside light ones on
two or four other slots. That is some ten thousand sums on either side, of each the nearest of the other. Force and
moment have four real dimensions, in which so many sums lie close together.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from optimizer.choices.clock import Clock
from optimizer.choices.discrete.few_slots import CLOSE, PAIRS, SUMS, improve
from optimizer.choices.discrete.halves import exhaust
from optimizer.choices.discrete.light_sizes import LightSizes
from optimizer.choices.discrete.neighbourhoods import light_options, near_options, neighbourhoods, used_slots
from optimizer.choices.discrete.options import Incumbent, Options
from optimizer.choices.discrete.part_sizes import PartSizes
from optimizer.numerics.arrays import Complex
from optimizer.program.methods.compiled import stage_solutions, suits_kernel
from optimizer.program.solution import OPTIMUM_SHARE
from optimizer.program.statement import Statement

#: part numbers that are tried where any number may be used, and the share of the time left that these have
_SIZES, _OF_SIZES = 2, 0.25
#: share of the time of few part numbers in which sizes are tried for a light set within the target gap
_FIRST = 0.4


class Pass(NamedTuple):
    """How many options of how many slots are tried together."""

    near: int  # options of each of two slots that are near to the optimum
    many: int  # light options of each other one
    trims: int  # of those
    several: int  # sets of others that are looked at
    sums: int  # of a half, at most


#: the sets of each are hundreds to thousands of times as many as those of the one before
_PASSES = (Pass(40, 200, 2, 28, SUMS), Pass(40, 100, 4, 4, 500_000), Pass(20, 50, 6, 2, 4_000_000))


def light_sizes(statement: Statement, options: Options, relaxed: Complex) -> LightSizes | None:
    """Sets of few part numbers near to the lightest optimum of any masses; None where these are not few.

    Parameters
    ----------
    relaxed : (K,) kg m of first webs, an optimum of any masses.
    """
    if not options.limits_parts:
        return None
    light = _lightest(statement, relaxed)
    used = used_slots(light)
    return LightSizes(statement, options, light, used) if used else None


def offer_light_sets(
    incumbent: Incumbent,
    below: Statement,
    relaxed: Complex,
    enough: Callable[[], bool],
    clock: Clock,
    sizes: LightSizes | None,
    limit: float,
) -> None:
    """Offer the sets of these searches.

    Parameters
    ----------
    below : the incumbent's program, or one of fewer rows that is nowhere above it.
    relaxed : (K,) kg m of first webs, an optimum of any masses.
    enough : whether the best set is within the target gap.
    sizes : of few part numbers, what is tried first for a set that is as good.
    limit : of the objective of such a set.
    """
    light = _lightest(below, relaxed)
    used = used_slots(light)
    if not used:
        return
    if incumbent.options.limits_parts:
        selection = None if sizes is None else sizes.below(None, limit, Clock(_FIRST * clock.left_s))
        if selection is not None:
            incumbent.offer(selection[None])
        PartSizes(incumbent, light, used, incumbent.options.most_parts or 0, enough, clock).run()
        return
    for stage in _PASSES:
        for candidates in neighbourhoods(incumbent.options, light, stage.near, stage.many, stage.trims, stage.several):
            if enough() or clock.spent():
                return
            exhaust(incumbent.options, candidates, incumbent, stage.sums, PAIRS, clock)

    # few sizes are few sums, and where any may be used they are among them
    PartSizes(incumbent, light, used, _SIZES, enough, Clock(_OF_SIZES * clock.left_s)).run()

    def close(slot: int, selection: np.ndarray) -> np.ndarray:
        options = incumbent.options
        about = (options.unbalance[slot, selection[slot]], light[slot])
        near = [near_options(options, slot, complex(point), CLOSE) for point in about]
        return np.unique(np.concatenate([*near, light_options(options, slot, CLOSE // 2)]))

    improve(incumbent, incumbent.options, close, enough, clock)


def _lightest(statement: Statement, relaxed: Complex) -> Complex:
    """(K,) kg m: the lightest optimum of any masses, or ``relaxed`` where the kernel does not apply."""
    if not suits_kernel(statement) or not statement.at_rest > 0:
        return relaxed
    share = np.array([OPTIMUM_SHARE * float(statement.at_rest)])
    stages = stage_solutions(statement.alone(), share, share, True)
    return stages.unbalance[0] if stages.certified[0] else relaxed
