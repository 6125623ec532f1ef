"""Cheaper choices from a catalogue, beside the best one: what a little of the objective saves of mass, of castings and
of part numbers.

Each is what goals in their order come to, the objective with an allowance before a cost, and is found by the same
searches; what one of them comes upon serves all.
"""

import logging
from dataclasses import dataclass
from typing import get_args

import numpy as np

from optimizer.choices.construction import feasible_set
from optimizer.choices.discrete.options import EQUAL
from optimizer.choices.feasible_set import Choice, FeasibleSet
from optimizer.formulation.counterweights import counterweights, masses_and_angles
from optimizer.formulation.demand import of_any_mass
from optimizer.formulation.simulation import Prepared
from optimizer.mechanics.fixed_weights import beside
from optimizer.numerics.arrays import Complex
from optimizer.program.cuts.optimum import Found, over_turn
from optimizer.program.limits import Limits
from optimizer.program.reference.solver import Solver
from optimizer.solve.costs import COMPARED, Costs, cost
from optimizer.solve.uncertain_program import Robust
from schemas.answer.alternatives import Alternative, Cheaper
from schemas.request.requests import OptimizeRequest

_LOG = logging.getLogger(__name__)
#: share of the time limit of the request that all of this may take, and of that the shares of the costs
_TIME, _SHARES = 0.5, {"mass": 0.4, "pieces": 0.3, "sizes": 0.3}
#: width of the brackets by which the best choice is told, as a share of the objective
_CLOSE = 1e-10


def alternatives(request: OptimizeRequest, scene: Prepared, u: Complex, solver: Solver) -> tuple[Alternative, ...]:
    """What is cheaper than the best choice within each allowance, without what a smaller allowance gives already.

    Parameters
    ----------
    u : (K,) kg m, the best choice, without the weights that are fixed.
    """

    def choices(limits: Limits) -> FeasibleSet:
        some = feasible_set(request, limits, solver)
        assert some is not None  # there is a catalogue
        return some

    allowances = sorted(set(request.alternatives))
    wanted = of_any_mass(request)
    robust = Robust(request, scene, wanted._replace(time_limit_s=_TIME * wanted.time_limit_s))
    program = robust.asked().program
    first, size = over_turn(program, wanted.relative_gap, False, robust.left_s), float(program.units[-1])
    assert isinstance(first, Found)  # the best choice keeps the ceilings
    costs, seconds = Costs(program, first, (), choices, solver, size=size), robust.left_s
    # to the last digit, as it is answered
    mass, angle = masses_and_angles(request.machine, u, program.limits)
    best = _Best(Choice(mass, angle, u, COMPARED), float(program.values(u, _CLOSE).goals[-1]))
    costs.offer(best.choice)
    listed: list[Alternative] = []
    for minimised in get_args(Cheaper):
        known = best.choice
        for n, allowance in enumerate(allowances):
            level = best.value * (1.0 + allowance) + EQUAL * size
            left = _SHARES[minimised] * seconds / (len(allowances) - n if minimised == "mass" else 1 + n)
            found = costs.least(minimised, level, left)
            assert found.choice is not None  # the best one keeps every level
            if cost(found.choice, minimised) < cost(known, minimised) * (1.0 - EQUAL):
                value = costs.value(found.choice)
                listed.append(_described(request, scene, minimised, allowance, found.choice, value, found.lower_bound))
                known = found.choice
    return tuple(listed)


@dataclass(frozen=True)
class _Best:
    choice: Choice
    value: float  # of the objective, over omega^2


def _described(
    request: OptimizeRequest,
    scene: Prepared,
    minimised: Cheaper,
    allowance: float,
    choice: Choice,
    value: float,
    bound: float,
) -> Alternative:
    """As it is answered."""
    machine = request.machine
    mass, angle = beside(machine, choice.mass, choice.angle)
    total, own = float(np.sum(mass)), cost(choice, minimised)
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
        counterweights=counterweights(machine, mass, angle),
    )
