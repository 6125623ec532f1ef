"""Loads on the foundation by order: without counterweights, with them, and as built."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from optimizer.formulation.balance_shafts import fitted
from optimizer.formulation.counterweights import mass_and_angle
from optimizer.formulation.simulation import Prepared
from optimizer.mechanics.foundation import foundation_load, outer_dead_centre_deg, rounding
from optimizer.mechanics.inertia import Wrench
from optimizer.mechanics.shapes import fitted_masses
from optimizer.numerics.arrays import Complex
from optimizer.outputs.orders import ORDERS
from optimizer.outputs.output import Output
from optimizer.outputs.phasors import vectors_of
from optimizer.responses.response import Phasors
from schemas.machine.machine import Machine
from schemas.machine.reciprocating import ReciprocatingMachine
from schemas.request.requests import OptimizeRequest

#: of an order that a machine has not
_NOTHING = Wrench(*(Phasors(np.zeros((), complex), np.zeros((), complex)) for _ in range(2)))
_UNITS = {"force_x": "N", "force_y": "N", "couple_of_x_forces": "Nm", "couple_of_y_forces": "Nm"}


def foundation_loads(scene: Prepared, unbalance: Complex | None) -> tuple[dict[str, Any], ...]:
    """Loads of the orders of a request, one machine: fields of :class:`schemas.answer.foundation.OrderOfFoundation`."""
    sets: dict[str, tuple[Prepared, Complex | None]] = {"before": (scene, None)}
    if unbalance is not None:
        sets["after"] = (scene, unbalance)
    actual = _as_built(scene)
    if actual is not None:
        sets["as_built"] = actual
    reference = dead_centre_deg(scene.machine)
    of_sets = dict(zip(sets, _loads(scene, list(sets.values()), reference), strict=True))
    return tuple(
        {"order": order, "dead_centre_deg": reference, **{name: loads[order] for name, loads in of_sets.items()}}
        for order in scene.request.foundation_orders
    )


def dead_centre_deg(machine: Machine) -> float:
    """Shaft angle of the outer dead centre of throw 1, first row; 0 where there is none."""
    rows = machine.throws[0].rows if isinstance(machine, ReciprocatingMachine) and machine.throws else ()
    if not isinstance(machine, ReciprocatingMachine) or not rows:
        return 0.0
    sense = 1.0 if machine.rotation == "ccw" else -1.0
    return float(outer_dead_centre_deg(machine.throws[0].crank_angle_deg, rows[0].axis_deg, sense))


def _as_built(scene: Prepared) -> tuple[Prepared, Complex] | None:
    """The machine with what its request says is fitted; None where it says nothing."""
    request = scene.request
    if not isinstance(request, OptimizeRequest) or not request.fitted:
        return None
    mass, angle = mass_and_angle(request.machine, request.fitted)
    placement = fitted(fitted_masses(request.machine, mass), mass, angle)
    return replace(scene, shafts=placement.on_shafts), placement.on_crank


def _loads(
    scene: Prepared, sets: Sequence[tuple[Prepared, Complex | None]], reference: float
) -> list[dict[int, dict[str, Any]]]:
    """Fields of the loads of all orders with sets of counterweights, all sets at once."""
    orders, bare = scene.request.foundation_orders, np.zeros(len(scene.machine.webs), complex)
    wrenches = [fitted_scene.orders(vectors) for fitted_scene, vectors in sets]
    # odd orders above the first vanish for a slider-crank
    every = [vectors_of([of_set.get(order, _NOTHING) for order in orders]) for of_set in wrenches]
    phasors = np.array(every).transpose(2, 3, 0, 1)
    weights = np.array([bare if vectors is None else vectors for _, vectors in sets])
    force, couple = (least[:, None] for least in rounding(scene.layout, weights))
    wrench = Wrench(Phasors(phasors[0, 0], phasors[0, 1]), Phasors(phasors[1, 0], phasors[1, 1]))
    loads = foundation_load(wrench, np.array(orders), scene.layout.sense, np.asarray(reference), (force, couple))
    results: list[dict[int, dict[str, Any]]] = [{order: {} for order in orders} for _ in sets]
    for name, load in loads._asdict().items():
        unit = _UNITS[name]
        for of_set, amplitudes, phases in zip(results, load.amplitude.tolist(), load.phase_deg.tolist(), strict=True):
            for order, amplitude, phase in zip(orders, amplitudes, phases, strict=True):
                of_set[order][name] = {f"amplitude_{unit}": amplitude, "phase_deg": phase}
    return results


FOUNDATION_LOADS = Output("foundation_loads", "loads on the foundation by order", ORDERS.needs, foundation_loads)
