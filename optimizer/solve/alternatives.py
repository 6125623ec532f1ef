"""Cheaper choices from a catalogue, beside the best one: what a little of the objective saves of mass, of castings and
of part numbers.

Each makes goals small in their order, the objective with an allowance before a cost. All use the same
searches; a point of one search serves all.
"""

import logging
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from typing import NamedTuple, get_args

import numpy as np

from optimizer.choices.construction import feasible_set, limits_beside_castings, takes_options
from optimizer.choices.discrete.options import EQUAL
from optimizer.choices.feasible_set import Choice, FeasibleSet
from optimizer.formulation.balance_shafts import placement_of
from optimizer.formulation.counterweights import masses_and_angles
from optimizer.formulation.simulation import Prepared
from optimizer.formulation.task import Task
from optimizer.numerics.arrays import Complex
from optimizer.program.cuts.optimum import over_turn
from optimizer.program.limits import Limits
from optimizer.solve.caps import cost
from optimizer.solve.costs import COMPARED, Costs
from optimizer.solve.uncertain_program import MOST_ROUNDS, Robust
from schemas.answer.alternatives import Alternative, Cheaper

_LOG = logging.getLogger(__name__)
#: share of the time limit that the best choice may take; of the rest the shares of the costs
BEST, _SHARES = 0.6, {"mass": 0.4, "pieces": 0.3, "sizes": 0.3}
#: width of the brackets by which the best choice is judged, as a share of goals
_CLOSE = 1e-10
#: what is left open at the end of every search, which looks at the time now and then
_SPARE = 0.9


def alternatives(
    task: Task, allowances: Sequence[float], scene: Prepared, u: Complex, left_s: float
) -> tuple[Alternative, ...]:
    """What is cheaper than the best choice within each allowance, without what a smaller allowance gives already.

    Parameters
    ----------
    allowances : shares of the objective of the best choice.
    u : (K,) kg m, the best choice, without the weights that are fixed.
    left_s : what is left of the time limit.
    """

    def choices(limits: Limits) -> FeasibleSet:
        return feasible_set(task, limits)

    demand = task.of_any_mass
    robust = Robust(task, scene, demand._replace(time_limit_s=_SPARE * max(left_s, 0.0)))
    points = [u]
    for _ in range(MOST_ROUNDS):
        robust.learnt(u)
        candidates = list(_cheaper(allowances, robust, choices, points))
        # of masses that scatter, changes that make one of these worse than before
        worse = [robust.learnt(candidate.choice.unbalance) for candidate in candidates]
        if not any(worse):
            break
        points += [candidate.choice.unbalance for candidate in candidates]
    return tuple(_described(task, scene, candidate) for candidate in candidates)


class _Cheap(NamedTuple):
    """A choice that is cheaper than the best one within an allowance."""

    minimised: Cheaper
    allowance: float
    choice: Choice
    value: float  # of the objective, over omega^2
    lower_bound: float  # kg, or a number


def _cheaper(
    every: Sequence[float],
    robust: Robust,
    choices: Callable[[Limits], FeasibleSet],
    incumbents: Sequence[Complex],
) -> Iterator[_Cheap]:
    """Choices that are cheaper than the best, under the changes of masses so far.

    Parameters
    ----------
    incumbents : (K,) kg m each, the best choice first.
    """
    allowances = sorted(set(every))
    program = robust.goals().program
    # the best choice keeps the ceilings
    first = over_turn(program, robust.demand.relative_gap, False, robust.left_s).certain()
    size = float(program.units[-1])
    task, seconds = robust.task, robust.left_s
    castings = takes_options(task)
    whole = bool(np.all(castings))
    if not whole:
        worst = float(program.values(incumbents[0], _CLOSE).goals[-1]) * (1.0 + max(every))
        first = replace(first, limits=limits_beside_castings(task, program, np.array([worst])))
    costs = Costs(program, first, (), choices, size=size, whole=whole)
    # to the last digit, as it is answered
    offered = [
        Choice(*masses_and_angles(task.space.machine, u, program.limits), u, COMPARED, None if whole else castings)
        for u in incumbents
    ]
    for start in offered:
        costs.offer(start)
    best = costs.value(offered[0])
    for minimised in get_args(Cheaper):
        cheapest = offered[0]
        for n, allowance in enumerate(allowances):
            level = best * (1.0 + allowance) + EQUAL * size
            left = _SHARES[minimised] * seconds / (len(allowances) - n if minimised == "mass" else 1 + n)
            choice, bound = costs.least(minimised, level, left)
            if choice is not None and cost(choice, minimised) < cost(cheapest, minimised) * (1.0 - EQUAL):
                yield _Cheap(minimised, allowance, choice, costs.value(choice), bound)
                cheapest = choice


def _described(task: Task, scene: Prepared, cheap: _Cheap) -> Alternative:
    """As it is answered."""
    minimised, allowance, choice, value, bound = cheap
    placement = placement_of(task.machine, task.objective, choice.mass, choice.angle)
    total = float(np.sum([weight.mass_kg for weight in placement.every_weight]))
    own = cost(choice, minimised)
    fixed = total - cost(choice, "mass") if minimised == "mass" else 0.0
    proven = None
    if bound > own * (1.0 + EQUAL):
        _LOG.error("a choice of %s %g is below its bound of %g", minimised, own, bound)
    else:
        # sums of masses are rounded
        proven = min(bound, own)
    return Alternative(
        minimised=minimised,
        allowance=allowance,
        objective=value * scene.omega_squared,
        total_mass_kg=total,
        pieces=int(cost(choice, "pieces")),
        sizes=int(cost(choice, "sizes")),
        lower_bound=None if proven is None else proven + fixed,
        counterweights=placement.counterweights,
        balance_shafts=placement.balance_shafts,
    )
