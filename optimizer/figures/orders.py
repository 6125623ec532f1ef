"""Phasors of force and moment by order, without and with counterweights."""

from optimizer.arrays import Complex
from optimizer.figures.first_order import FIRST_ORDER_EFFECTS
from optimizer.figures.output import Output
from optimizer.figures.phasors import order_of
from optimizer.scene import Prepared
from schemas.outputs import OrdersComparison


def orders(scene: Prepared, unbalance: Complex | None) -> OrdersComparison:
    """Orders 1, 2, 4 and 6 of one machine; counterweights on the shaft change the first alone."""
    results, square = scene.results, scene.layout.omega**2
    higher = {2: results["second_order"], **results["higher_orders"]}
    others = tuple(order_of(number, wrench.times(square)) for number, wrench in higher.items())
    return OrdersComparison(
        before=(order_of(1, scene.first_order()), *others),
        after=None if unbalance is None else (order_of(1, scene.first_order(unbalance)), *others),
    )


ORDERS = Output(
    "orders", "phasors at orders 1, 2, 4 and 6", (*FIRST_ORDER_EFFECTS, "second_order", "higher_orders"), orders
)
