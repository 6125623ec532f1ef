"""A scene made ready: what its outputs call for has been simulated, and the responses stand."""

import time
from collections.abc import Mapping, Sequence
from dataclasses import field
from functools import lru_cache
from typing import Any

import numpy as np

from optimizer.effects.inertia import FIRST_ORDER_EFFECTS, second_order
from optimizer.effects.registry import Simulated, closure, simulate
from optimizer.formulation.formulate import extra_responses, responses
from optimizer.mechanics.balance_shafts import of_balance_shafts
from optimizer.mechanics.cylinders import cycle_turns
from optimizer.mechanics.fixed_weights import laden
from optimizer.mechanics.frame import Shares
from optimizer.mechanics.inertia import Wrench, counterweights, first_order, reciprocating, rotating
from optimizer.mechanics.layout import Layout, layout, spread
from optimizer.mechanics.reading import Reading
from optimizer.mechanics.roll import roll
from optimizer.mechanics.shaft import INFLUENCES, bearing_places
from optimizer.mechanics.shaft_curves import ShaftCurves, bending_influence, planes, shaft_curves, stations
from optimizer.numerics.arrays import Complex, Real, variant
from optimizer.numerics.memoization import cached_property
from optimizer.numerics.records import record
from optimizer.responses.curve import TurnResponse
from optimizer.responses.peak_table import PeakTable
from optimizer.responses.response import Response
from schemas.base.curves import Curve
from schemas.base.responses import ResponseFields
from schemas.machine.machine import Machine
from schemas.machine.reciprocating import ReciprocatingMachine
from schemas.machine.scroll_machine import ScrollMachine
from schemas.request.objective import Objective
from schemas.request.requests import OptimizeRequest
from schemas.request.scene import Scene


@record(frozen=True)
class Prepared:
    """A machine as arrays and what was simulated of it.

    A request whose fields hold columns (n,) is many designs of one shape: all arrays then have that leading axis.

    request : outputs, objective and machine.
    machine : that of the request, of a scenario, or with the radii of what is cut from its plates.
    objective : what is to be small; the usual one by default.
    """

    request: Scene
    machine: ReciprocatingMachine | ScrollMachine
    objective: Objective
    layout: Layout
    angle_deg: Real  # (T,) sampled shaft angles, the end point not repeated
    angle_rad: Real  # (T,) the same
    simulated: Simulated
    mechanics_ms: float
    shafts: Complex | None = None  # (..., S) kg m, unbalances of the balance shafts that go with counterweights
    turns: int = 1  # over which the samples go: 2 where gas takes so long
    peaks: PeakTable = field(default_factory=PeakTable)  # over the turn, searched before outputs show them

    @property
    def results(self) -> Mapping[str, Any]:
        """Results of the effects that ran, by name."""
        return self.simulated.results

    @cached_property
    def angles(self) -> Curve[float]:
        """Sampled shaft angles as outputs show them, all the same curve."""
        return Curve(self.angle_deg)

    @cached_property
    def row_labels(self) -> list[dict[str, Any]]:
        """Where each row is and what it is called, as answers name it; none of a scroll machine."""
        throws = self.machine.throws if isinstance(self.machine, ReciprocatingMachine) else ()
        return [
            {"throw": t, "row": i, "name": row.name}
            for t, throw in enumerate(throws)
            for i, row in enumerate(throw.rows)
        ]

    @cached_property
    def omega_squared(self) -> float:
        return float(self._square)

    @cached_property
    def _square(self) -> Real:
        """The square of the speed (...) rad^2/s^2."""
        return self.layout.omega**2

    def first_order(self, unbalance: Complex | None = None) -> Wrench:
        """First-order force [N] and moment [N m], without or with counterweights (..., K) kg m."""
        if unbalance is None:
            return self._bare
        # both at once, for another thread may ask too
        last = self._last[0] if self._last else None
        if last is None or last[0] is not unbalance:
            wrench = self.simulated.first_order.plus(counterweights(self.layout, unbalance))
            last = unbalance, self.with_shafts(wrench, 1).times(self._square)
            self._last[:] = [last]
        return last[1]

    @cached_property
    def _last(self) -> list[tuple[Complex, Wrench]]:
        """The last counterweights with their first order: many outputs show the same."""
        return []

    @cached_property
    def _bare(self) -> Wrench:
        """First-order force [N] and moment [N m] without counterweights."""
        return self.simulated.first_order.times(self._square)

    def orders(self, unbalance: Complex | None) -> dict[int, Wrench]:
        """Force [N] and moment [N m] of every order; counterweights change the first, balance shafts two of them."""
        higher = self._higher
        if unbalance is not None and self.shafts is not None:
            square = self._square
            higher = {order: self.with_shafts(own, order).times(square) for order, own in self._over_square.items()}
        return {1: self.first_order(unbalance), **higher}

    @cached_property
    def second_order(self) -> Wrench:
        """The second order over omega^2 without counterweights, of a machine whose rows have rods."""
        if "second_order" in self.results:
            wrench: Wrench = self.results["second_order"]
            return wrench
        return second_order(self.layout, self.request.fidelity)

    @cached_property
    def _over_square(self) -> dict[int, Wrench]:
        """The orders above the first over omega^2, without counterweights."""
        return {2: self.second_order, **self.results["higher_orders"]}

    @cached_property
    def _higher(self) -> dict[int, Wrench]:
        """The same in N and N m."""
        square = self._square
        return {order: own.times(square) for order, own in self._over_square.items()}

    def with_shafts(self, wrench: Wrench, order: int) -> Wrench:
        """Force and moment of an order over omega^2, with what the balance shafts add."""
        if self.layout.balance is None or self.shafts is None:
            return wrench
        return wrench.plus(of_balance_shafts(self.layout, self.layout.balance, self.shafts, order))

    def beside(self, shafts: Complex | None) -> "Prepared":
        """The same with unbalances of the balance shafts (..., S) kg m; None where there are no such shafts."""
        return self if shafts is None else variant(self, shafts=shafts)

    @cached_property
    def laden(self) -> Layout:
        """The machine with the weights that are on it already."""
        return laden(self.layout, self.machine)

    @cached_property
    def responses(self) -> tuple[Response, ...]:
        """What can be weighed, as responses to the unbalance of counterweights that are variables."""
        plan, goal = self.laden, self.objective
        if plan is self.layout:
            return responses(plan, self.simulated.first_order, goal)
        return responses(plan, rotating(plan).plus(reciprocating(plan, 1)), goal)

    @cached_property
    def bearing_influence(self) -> Real:
        """Loads of the main bearings for unit loads in all planes, (..., B, L)."""
        return INFLUENCES[self.request.fidelity.shaft](bearing_places(self.machine), planes(self.layout))

    @cached_property
    def stations(self) -> Real:
        """Planes in which the bending moment of the shaft has corners, (..., S) m."""
        return stations(self.layout, bearing_places(self.machine))

    @cached_property
    def shaft_curves(self) -> ShaftCurves:
        """Loads of the B main bearings and bending moments at the S corners, over omega^2: B + S curves together."""
        places, reaction = bearing_places(self.machine), self.bearing_influence
        moments = bending_influence(self.layout, places, reaction, self.stations)
        influence = np.concatenate([reaction, moments], axis=-2)
        return shaft_curves(self.results["whole_turn"], self.layout, influence)

    @cached_property
    def roll(self) -> TurnResponse:
        """Alternating moment about the crankshaft on the frame of one machine, over omega^2."""
        return roll(self.results["whole_turn"], self.layout)

    @cached_property
    def extra_responses(self) -> tuple[tuple[ResponseFields, Shares], ...]:
        """Responses that count beside force and moment, with what they have of both."""
        return tuple(
            (response.fields, response.shares(self.layout, self.objective))
            for response in extra_responses(self.objective)
        )

    @property
    def first_turn_deg(self) -> Real:
        """The samples of the first turn."""
        return self.angle_deg[: self.angle_deg.size // self.turns]


def simulated(
    request: Scene,
    outputs: Mapping[str, Sequence[str]],
    samples: int,
    leading: tuple[int, ...] = (),
    machine: Machine | None = None,
    readings: tuple[Reading, ...] = (),
) -> Prepared:
    """Simulate what the outputs call for.

    Parameters
    ----------
    request : its machine gives what the effects need; its fields may hold columns of the leading axes.
    outputs : outputs by name, with the effects that each needs.
    samples : number of sampled shaft angles in one turn.
    leading : axes of all results; none for one machine.
    machine : another in place of that of the request.
    readings : of the forces of many designs over the turn, that columns will need.
    """
    start = time.perf_counter()
    machine = request.machine if machine is None else machine
    plan, needs = layout(machine), [need for needs in outputs.values() for need in needs]
    wrenches: dict[str, Wrench] = {}
    if leading and not set(FIRST_ORDER_EFFECTS).isdisjoint(closure(machine, needs)):
        # of what the designs have in common once, and once for the program and for the outputs
        wrenches = dict(zip(FIRST_ORDER_EFFECTS, (wrench.spread(leading) for wrench in first_order(plan)), strict=True))
    if leading:
        plan = spread(plan, leading)
    turns = turns_over(machine, needs)
    angle, radians = _sampled(samples, turns)
    result = simulate(machine, plan, outputs, request.fidelity, radians, wrenches, readings)
    objective = request.objective if isinstance(request, OptimizeRequest) else Objective()
    spent_ms = (time.perf_counter() - start) * 1e3
    return Prepared(request, machine, objective, plan, angle, radians, result, spent_ms, turns=turns)


@lru_cache(maxsize=4)
def _sampled(samples: int, turns: int) -> tuple[Real, Real]:
    """Shaft angles of all samples (T,) in degrees and in radians, to which nobody writes."""
    angle = np.arange(samples * turns, dtype=float) * (360.0 / samples)
    return angle, np.deg2rad(angle)


def turns_over(machine: Machine, needs: Sequence[str]) -> int:
    """Turns of the shaft over which results of effects go: 2 where they hold gas of a cycle that takes so long."""
    return cycle_turns(machine) if isinstance(machine, ReciprocatingMachine) and "gas" in closure(machine, needs) else 1
