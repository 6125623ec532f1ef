"""The outputs of a scene without and with counterweights, as they were asked for."""

from collections.abc import Callable
from typing import Any

from optimizer.arrays import Complex
from optimizer.figures import dynamics
from optimizer.figures.bearings import main_bearings
from optimizer.figures.first_order import first_order, floor, hodograph
from optimizer.figures.orders import order
from optimizer.figures.stages import stages
from optimizer.mechanics.inertia import Wrench
from optimizer.scene import Prepared
from schemas.answers import Residual
from schemas.outputs import Hodographs, Order, OrdersComparison

_OVER_THE_TURN: dict[str, Callable[[dynamics.Samples], Any]] = {
    "kinematics": dynamics.kinematics,
    "gas": dynamics.gas,
    "piston_force": dynamics.piston_force,
    "rod_loads": dynamics.rod_loads,
    "torque": dynamics.torque,
    "flywheel": dynamics.flywheel,
    "overturning": dynamics.overturning,
}
#: outputs that show first-order force and moment
_FIRST_ORDER = frozenset({"residual", "hodograph", "orders", "stages"})
_STAGE_PARTS = ("rotating_inertia", "reciprocating_inertia", "second_order")


def outputs(scene: Prepared, unbalance: Complex | None) -> dict[str, Any]:
    """Fields of the answer for the outputs of a scene.

    Parameters
    ----------
    unbalance : (K,) kg m, the counterweights; None where there are none to show (infeasible).
    """
    return {**_first_order_outputs(scene, unbalance), **_outputs_over_the_turn(scene, unbalance)}


def _first_order_outputs(scene: Prepared, unbalance: Complex | None) -> dict[str, Any]:
    if not _FIRST_ORDER.intersection(scene.outputs):
        return {}
    before = scene.first_order()
    after = None if unbalance is None else scene.first_order(unbalance)
    fields: dict[str, Any] = {"floor": floor(before)}
    if "residual" in scene.outputs:
        fields["residual"] = Residual(before=first_order(before), after=None if after is None else first_order(after))
    if "hodograph" in scene.outputs:
        fields["hodograph"] = Hodographs(
            angle_deg=tuple(scene.angle_deg.tolist()),
            before=hodograph(before, scene.turned_rad),
            after=None if after is None else hodograph(after, scene.turned_rad),
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


def _outputs_over_the_turn(scene: Prepared, unbalance: Complex | None) -> dict[str, Any]:
    fields: dict[str, Any] = {}
    samples = dynamics.Samples(scene.request.machine, scene.layout, scene.angle_deg, scene.simulated.results)
    for name, report in _OVER_THE_TURN.items():
        if name in scene.outputs:
            fields[name] = report(samples)
    if "main_bearings" in scene.outputs:
        fields["main_bearings"] = main_bearings(samples, scene.request.fidelity, unbalance)
    if "pin_loads" in scene.outputs:
        fields["pin_loads"] = scene.simulated.results["pin_loads"]
    return fields


def _orders(scene: Prepared, first: Wrench) -> tuple[Order, ...]:
    """Orders of one machine; counterweights on the shaft change the first alone."""
    results, square = scene.simulated.results, scene.layout.omega**2
    higher = {2: results["second_order"], **results["higher_orders"]}
    return (order(1, first), *(order(number, wrench.times(square)) for number, wrench in higher.items()))
