"""What limits cost where the objective looks at the whole turn: every ceiling by all of its cuts."""

from collections.abc import Collection, Iterator, Mapping, Sequence

import numpy as np

from optimizer.formulation.formulate import RESPONSES
from optimizer.formulation.goals import Goals
from optimizer.numerics.arrays import Complex
from optimizer.program import sensitivity
from optimizer.program.certificate import normalised
from optimizer.program.cuts.proof import Proof
from optimizer.program.sensitivity import ShadowPrices
from optimizer.solve.prices import Priced, Quantity, of_ceilings, of_limits, per, quantity_of, shadow_prices
from schemas.answer.counterweights import Counterweight
from schemas.answer.limits import CeilingField, MachineLimit, ShadowPrice
from schemas.request.objective import Objective
from schemas.request.requests import OptimizeRequest

#: units of the ceilings over the turn
_UNIT_OF: Mapping[CeilingField, str] = {
    "bearing_ceiling_N": "N",
    "specific_load_ceiling_Pa": "Pa",
    "bending_ceiling_Nm": "N m",
    **{ceiling.field: ceiling.unit for response in RESPONSES.values() for ceiling in response.limits},
}


def prices_over_turn(
    request: OptimizeRequest,
    asked: Goals,
    proof: Proof,
    u: Complex,
    counterweights: Sequence[Counterweight],
    touched: Collection[MachineLimit],
    gap: float,
) -> tuple[ShadowPrice, ...]:
    """Prices of the limits of one machine with one goal, as :func:`optimizer.solve.prices.shadow_prices` has them.

    Parameters
    ----------
    request : whose machine has all webs (K,) that the program chooses.
    proof : of the objective.
    u : (K,) kg m.
    gap : certified gap, over omega^2.
    """
    (case,) = asked.cases
    square = float(case.omega_squared)
    usable, _ = normalised(proof.statement, proof.multipliers)
    prices = sensitivity.shadow_prices(proof.statement, u, usable)
    # the ceilings of the first order come first, and cuts of what is limited over the turn behind them
    first_order = prices.ceiling[: len(asked.program.ceilings)]
    exact = of_ceilings(request.objective, first_order, square) if first_order.size else ()
    return shadow_prices(
        request.machine,
        _quantity(request),
        (*of_limits(request.machine, prices), *exact, *_of_limited(request.objective, asked, proof, prices)),
        counterweights,
        touched,
        square,
        gap,
        float(asked.program.at_rest.goals[-1]),
    )


def _quantity(request: OptimizeRequest) -> Quantity:
    objective = request.objective
    of_frame = quantity_of(request.machine, objective)
    if of_frame is not None:
        return of_frame
    if objective.bearing_weight > 0:
        return Quantity(objective.bearing_weight, "Pa" if objective.bearing_measure == "specific" else "N")
    return Quantity(objective.bending_weight or objective.roll_weight, "N m")


def _of_limited(objective: Objective, asked: Goals, proof: Proof, prices: ShadowPrices) -> Iterator[Priced]:
    """Every ceiling over the turn: raising it raises the caps of all cuts of all that it limits."""
    counts = [proof.cuts[each.quantity] for each in asked.limited]
    first = len(asked.program.ceilings) + np.cumsum([0, *counts])
    found: dict[CeilingField, tuple[MachineLimit, float]] = {}
    for n, each in enumerate(asked.limited):
        allowed = getattr(objective, each.field)
        # of specific loads the area of the bearing
        share = each.ceiling / allowed if allowed > 0 else 1.0
        of_cuts = float(np.sum(prices.ceiling[first[n] : first[n + 1]])) * share / each.omega_squared
        found[each.field] = each.limit, found.get(each.field, (each.limit, 0.0))[1] + of_cuts
    for field, (limit, price) in found.items():
        yield Priced(limit, None, price, getattr(objective, field), per(_UNIT_OF[field]))
