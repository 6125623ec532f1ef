"""Phasors of force and moment by order, without and with counterweights."""

import numpy as np

from optimizer.arrays import Complex
from optimizer.figures.first_order import FIRST_ORDER_EFFECTS
from optimizer.figures.output import Output
from optimizer.mechanics.inertia import Wrench
from optimizer.scene import Prepared
from schemas.outputs import ForceOrder, ForcePhasor, MomentOrder, MomentPhasor, Order, OrdersComparison


def orders(scene: Prepared, unbalance: Complex | None) -> OrdersComparison:
    """Orders 1, 2, 4 and 6 of one machine; counterweights on the shaft change the first alone."""
    results, square = scene.results, scene.layout.omega**2
    higher = {2: results["second_order"], **results["higher_orders"]}
    others = tuple(_order(number, wrench.times(square)) for number, wrench in higher.items())
    return OrdersComparison(
        before=(_order(1, scene.first_order()), *others),
        after=None if unbalance is None else (_order(1, scene.first_order(unbalance)), *others),
    )


def _order(number: int, wrench: Wrench) -> Order:
    """One order of force [N] and moment [N m] of one machine."""
    force, moment = wrench
    return Order(
        order=number,
        force=ForceOrder(
            co_rotating=ForcePhasor(**_phasor(force.co, "N")),
            counter_rotating=ForcePhasor(**_phasor(force.counter, "N")),
            peak_N=float(force.peak),
        ),
        moment=MomentOrder(
            co_rotating=MomentPhasor(**_phasor(moment.co, "Nm")),
            counter_rotating=MomentPhasor(**_phasor(moment.counter, "Nm")),
            peak_Nm=float(moment.peak),
        ),
    )


def _phasor(value: Complex, unit: str) -> dict[str, float]:
    vector = complex(value)
    return {
        f"real_{unit}": vector.real,
        f"imag_{unit}": vector.imag,
        f"magnitude_{unit}": abs(vector),
        "phase_deg": float(np.rad2deg(np.angle(vector))) if vector else 0.0,
    }


ORDERS = Output(
    "orders", "phasors at orders 1, 2, 4 and 6", (*FIRST_ORDER_EFFECTS, "second_order", "higher_orders"), orders
)
