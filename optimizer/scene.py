"""A scene made ready: what its outputs call for has been simulated, and the responses stand."""

import time
from dataclasses import dataclass

import numpy as np

from optimizer.arrays import Complex, Real
from optimizer.effects.registry import Simulated, require_inputs, simulate
from optimizer.mechanics.inertia import Wrench, counterweights, first_order_responses
from optimizer.mechanics.layout import Layout, layout
from optimizer.response import Response
from schemas.requests import Scene


@dataclass(frozen=True)
class Prepared:
    """Arrays of a scene."""

    request: Scene
    outputs: tuple[str, ...]
    layout: Layout
    angle_deg: Real  # (T,) sampled shaft angles, the end point not repeated
    simulated: Simulated
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

    @property
    def responses(self) -> tuple[Response, Response]:
        """First-order force and moment as responses to the unbalance of the counterweights."""
        return first_order_responses(self.layout, self.simulated.first_order)

    @property
    def turned_rad(self) -> Real:
        """How far the shaft has turned about +z at the samples, s*theta (T,) rad."""
        return self.layout.sense * np.deg2rad(self.angle_deg)


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
    require_inputs(request.machine, outputs, request.angles.count)
    start = time.perf_counter()
    plan = layout(request.machine)
    turn: Real = np.arange(request.angles.count, dtype=float) * (360.0 / request.angles.count)
    simulated = simulate(request.machine, plan, outputs, request.fidelity, np.deg2rad(turn))
    elapsed = (time.perf_counter() - start) * 1e3
    return Prepared(request, outputs, plan, turn, simulated, elapsed)
