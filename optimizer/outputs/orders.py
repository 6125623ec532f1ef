"""Phasors of force and moment by order, without and with counterweights."""

from typing import Any

from optimizer.formulation.simulation import Prepared
from optimizer.mechanics.inertia import Wrench
from optimizer.numerics.arrays import Complex, Real
from optimizer.outputs.first_order import FIRST_ORDER_EFFECTS
from optimizer.outputs.output import Columns, Output
from optimizer.outputs.phasors import Polar, orders_of, vectors_of
from schemas.answer.outputs import OrdersComparison


def by_order(scene: Prepared, unbalance: Complex | None) -> dict[int, Wrench]:
    """Force [N] and moment [N m] of every order; counterweights change the first, balance shafts two of them."""
    results, square = scene.results, scene.layout.omega**2
    higher = {2: results["second_order"], **results["higher_orders"]}
    if unbalance is not None:
        higher = {order: scene.with_shafts(wrench, order) for order, wrench in higher.items()}
    return {1: scene.first_order(unbalance), **{order: wrench.times(square) for order, wrench in higher.items()}}


def orders(scene: Prepared, unbalance: Complex | None) -> OrdersComparison:
    """Orders 1, 2, 4 and 6 of one machine."""

    def sets(fitted: Complex | None) -> list[dict[str, Any]]:
        wrenches = by_order(scene, fitted)
        return orders_of([*wrenches], Polar.of(vectors_of([*wrenches.values()])))

    return OrdersComparison.model_validate(
        {"before": tuple(sets(None)), "after": None if unbalance is None else tuple(sets(unbalance))}
    )


def _columns(scene: Prepared, unbalance: Complex) -> dict[str, Real]:
    results: dict[str, Real] = {}
    for order, wrench in by_order(scene, unbalance).items():
        for quantity, unit, pair in (("force", "N", wrench.force), ("moment", "Nm", wrench.moment)):
            results[f"{quantity}_peak_{unit}.order_{order}"] = pair.peak
            for sense, phasor in (("co", pair.co), ("counter", pair.counter)):
                results[f"{quantity}_{sense}_rotating_real_{unit}.order_{order}"] = phasor.real
                results[f"{quantity}_{sense}_rotating_imag_{unit}.order_{order}"] = phasor.imag
    return results


ORDERS = Output(
    "orders",
    "phasors at orders 1, 2, 4 and 6",
    (*FIRST_ORDER_EFFECTS, "second_order", "higher_orders"),
    orders,
    Columns(_columns),
)
