"""Forces of balance shafts: unbalances that turn rho times while the crankshaft turns once, rho = -2, -1, 1, 2.

An unbalance v in plane z puts the force rho^2 v e^{j s rho theta} on the frame, over omega^2, and that times
z - z_ref in the moment. So a shaft answers one phasor of one order: the co-rotating one where it turns with the
crankshaft, the counter-rotating one where it turns against it. Source: F. W. Lanchester, patent GB 13,219 (1912).
"""

from dataclasses import replace

import numpy as np

from optimizer.mechanics import inertia
from optimizer.mechanics.inertia import Wrench
from optimizer.mechanics.layout import BalanceWebs, Layout
from optimizer.numerics.arrays import Complex, Real, side_by_side, total
from optimizer.responses.curve import TurnResponse
from optimizer.responses.response import Phasors, Response


def shaft_influence(shafts: BalanceWebs, ratio: int) -> Real:
    """What one kg m on each web (..., webs) adds to the phasor that turns ``ratio`` times: rho^2, or 0 elsewhere."""
    result: Real = (shafts.ratio == ratio) * float(ratio) ** 2
    return result


def shaft_arms(layout: Layout, shafts: BalanceWebs) -> Real:
    """Distance of the webs of the shafts from the reference plane (..., webs) m."""
    return shafts.position - layout.reference_plane[..., None]


def of_balance_shafts(layout: Layout, shafts: BalanceWebs, unbalance: Complex, order: int) -> Wrench:
    """Force and moment of one order, over omega^2.

    Parameters
    ----------
    unbalance : (..., webs) mass-radius products m R e^{ja} of all shafts at shaft angle 0, kg m.
    order : 1 or 2.
    """
    arm = shaft_arms(layout, shafts)
    co, counter = (shaft_influence(shafts, sign * order) * unbalance for sign in (1, -1))
    return Wrench(Phasors(total(co), total(counter)), Phasors(total(arm * co), total(arm * counter)))


def first_order_responses(layout: Layout, baseline: Wrench) -> tuple[Response, Response]:
    """Force and moment as responses to the counterweights and, behind them, to the unbalances of the balance shafts.

    Parameters
    ----------
    baseline : first-order force and moment without counterweights.
    """
    force, moment = inertia.first_order_responses(layout, baseline)
    shafts = layout.balance
    if shafts is None:
        return force, moment
    return _widened(force, shafts, np.ones_like(shafts.position)), _widened(moment, shafts, shaft_arms(layout, shafts))


def _widened(response: Response, shafts: BalanceWebs, arm: Real) -> Response:
    co, counter = (arm * shaft_influence(shafts, ratio) for ratio in (1, -1))
    own = np.zeros_like(response.influence)
    return replace(
        response,
        influence=side_by_side(response.influence, co),
        counter_influence=side_by_side(own, counter) if np.any(shafts.ratio == -1.0) else None,
    )


def with_balance_shafts(layout: Layout, response: TurnResponse, arm: Real) -> TurnResponse:
    """A response of all orders on the frame, with the webs of balance shafts behind the others.

    What a shaft adds turns, as the crankshaft sees it, s (rho - 1) times while that turns once.

    Parameters
    ----------
    arm : (webs,) what a unit of force in the plane of each web of the shafts adds to the response.
    """
    shafts = layout.balance
    if shafts is None:
        return response
    turning = layout.sense * (shafts.ratio - 1.0)
    return replace(
        response,
        influence=np.concatenate([response.influence, arm * shafts.ratio**2]),
        turning=np.concatenate([np.zeros(response.influence.shape), turning]),
    )


def beside(layout: Layout, responses: tuple[TurnResponse, ...]) -> tuple[TurnResponse, ...]:
    """Responses of the crankshaft itself, which balance shafts do not load: their webs behind the others do nothing."""
    if layout.balance is None:
        return responses
    none = np.zeros(layout.balance.position.shape)
    return tuple(replace(response, influence=np.concatenate([response.influence, none])) for response in responses)
