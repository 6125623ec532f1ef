"""Phasors of force and moment by order, without and with counterweights."""

from optimizer.effects.inertia import FIRST_ORDER_EFFECTS
from optimizer.formulation.simulation import Prepared
from optimizer.numerics.arrays import Complex, Real
from optimizer.outputs.output import Columns, Output
from optimizer.outputs.phasors import PlainWrench, polar_wrenches
from schemas.answer.outputs import OrdersComparison


def orders(scene: Prepared, unbalance: Complex | None) -> OrdersComparison:
    """Orders 1, 2, 4 and 6 of one machine."""
    sets = [scene.orders(None)] if unbalance is None else [scene.orders(None), scene.orders(unbalance)]
    polars = iter(polar_wrenches([PlainWrench.of(wrench) for wrenches in sets for wrench in wrenches.values()]))
    before, *after = ([next(polars).order(number) for number in wrenches] for wrenches in sets)
    return OrdersComparison.of_figures({"before": before, "after": after[0] if after else None})


def _columns(scene: Prepared, unbalance: Complex) -> dict[str, Real]:
    results: dict[str, Real] = {}
    for order, wrench in scene.orders(unbalance).items():
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
