"""A scene made ready: what its outputs call for has been simulated, and the responses stand."""

import time
from dataclasses import dataclass

import numpy as np

from optimizer.effects import Simulated, require_inputs, simulate
from optimizer.mechanics.inertia import Wrench, counterweights, first_order_responses
from optimizer.mechanics.layout import Layout, layout
from optimizer.response import Complex, Response
from schemas.requests import Scene


@dataclass(frozen=True)
class Prepared:
    """Arrays of a scene."""

    request: Scene
    outputs: tuple[str, ...]
    layout: Layout
    simulated: Simulated
    responses: tuple[Response, Response]
    mechanics_ms: float

    @property
    def omega_squared(self) -> float:
        return float(self.layout.omega**2)

    def first_order(self, unbalance: Complex | None = None) -> Wrench:
        """First-order force [N] and moment [N m], with counterweights if given (K,) kg m."""
        wrench = self.simulated.first_order
        if unbalance is not None:
            wrench = wrench.plus(counterweights(self.layout, unbalance))
        return wrench.times(self.layout.omega**2)

    def angles_rad(self) -> tuple[np.ndarray, np.ndarray]:
        """Sampled shaft angles theta [deg], and s*theta [rad] for the phasors."""
        count = self.request.angles.count
        turn = np.arange(count) * (360.0 / count)
        return turn, self.layout.sense * np.deg2rad(turn)


def prepare(request: Scene, always: tuple[str, ...] = ()) -> Prepared:
    """Simulate what the outputs call for.

    Parameters
    ----------
    always : outputs that are needed whether they were asked for or not.

    Raises
    ------
    MissingInput
        if the machine lacks what an output needs.
    """
    outputs = tuple(dict.fromkeys((*always, *request.outputs)))
    require_inputs(request.machine, outputs)
    start = time.perf_counter()
    plan = layout(request.machine)
    simulated = simulate(plan, outputs, request.fidelity)
    responses = first_order_responses(plan, simulated.first_order)
    elapsed = (time.perf_counter() - start) * 1e3
    return Prepared(request, outputs, plan, simulated, responses, elapsed)
