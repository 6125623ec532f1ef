"""The outputs of a scene without and with counterweights, as they were asked for."""

from typing import Any

from optimizer.mechanics.inertia import Wrench
from optimizer.report.first_order import first_order, hodograph
from optimizer.report.orders import order
from optimizer.report.stages import stages
from optimizer.response import Complex
from optimizer.scene import Prepared
from schemas.answers import Residual
from schemas.outputs import Hodographs, Order, OrdersComparison

_STAGE_PARTS = ("rotating_inertia", "reciprocating_inertia", "second_order")


def outputs(scene: Prepared, unbalance: Complex | None) -> dict[str, Any]:
    """Fields of the answer for the outputs of a scene.

    Parameters
    ----------
    unbalance : (K,) kg m, the counterweights; None where there are none to show (infeasible).
    """
    before = scene.first_order()
    after = None if unbalance is None else scene.first_order(unbalance)
    fields: dict[str, Any] = {}
    if "residual" in scene.outputs:
        fields["residual"] = Residual(before=first_order(before), after=None if after is None else first_order(after))
    if "hodograph" in scene.outputs:
        turn, angle = scene.angles_rad()
        fields["hodograph"] = Hodographs(
            angle_deg=tuple(turn.tolist()),
            before=hodograph(before, angle),
            after=None if after is None else hodograph(after, angle),
        )
    if "orders" in scene.outputs:
        fields["orders"] = OrdersComparison(
            before=_orders(scene, before), after=None if after is None else _orders(scene, after)
        )
    if "stages" in scene.outputs:
        results = scene.simulated.results
        rotating, first, second = (results[name] for name in _STAGE_PARTS)
        fields["stages"] = stages(scene.layout, rotating, first, second, unbalance)
    return fields


def _orders(scene: Prepared, first: Wrench) -> tuple[Order, ...]:
    """Orders of one machine; counterweights on the shaft change the first alone."""
    results, square = scene.simulated.results, scene.layout.omega**2
    higher = {2: results["second_order"], **results["higher_orders"]}
    return (order(1, first), *(order(number, wrench.times(square)) for number, wrench in higher.items()))
