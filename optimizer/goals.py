"""From machine and objective to the program over the turn: force and moment, bearing loads, bending moments.

What :mod:`optimizer.formulate` is to the first order: the only place that names the fields that ask for the whole turn.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np

from optimizer.arrays import Real
from optimizer.curve import TurnResponse
from optimizer.errors import MissingInput
from optimizer.formulate import RESPONSES, ceilings, weights
from optimizer.formulate import limited as limited_responses
from optimizer.limits import limits
from optimizer.mechanics.layout import Layout
from optimizer.mechanics.shaft_curves import bearing_loads, bending_moments, shaking
from optimizer.mechanics.whole_turn import WholeTurn
from optimizer.program.cut import Quantity
from optimizer.program.over_turn import Goal, Group, OverTurn, Weighed
from optimizer.program.statement import combined, weighted_peak
from optimizer.response import Response
from optimizer.shaft import INFLUENCES, bearing_places
from schemas.answers import CeilingField, MachineLimit
from schemas.base import FieldProblem
from schemas.machine import ReciprocatingMachine
from schemas.requests import Fidelity, Objective, OptimizeRequest


@dataclass(frozen=True)
class Limited:
    """A ceiling on a quantity over the turn."""

    field: CeilingField  # of the request
    limit: MachineLimit  # what it is called where it is touched
    quantity: int  # its place in the program
    ceiling: float  # [unit of the response]


@dataclass(frozen=True)
class Goals:
    """What is asked of the whole turn."""

    program: OverTurn  # over omega^2
    allowances: tuple[float, ...]  # of all goals but the last
    limited: tuple[Limited, ...]  # as in the program


def bearing_responses(
    machine: ReciprocatingMachine, fidelity: Fidelity, layout: Layout, turn: WholeTurn
) -> tuple[TurnResponse, ...]:
    """Loads of the main bearings of one machine."""
    names = [f"bearing:{bearing.name}" for bearing in machine.bearings]
    return bearing_loads(turn, layout, names, bearing_places(machine), INFLUENCES[fidelity.shaft])


def goals(request: OptimizeRequest, layout: Layout, responses: Sequence[Response], turn: WholeTurn) -> Goals:
    """The program over the turn of one request.

    Parameters
    ----------
    responses : of the first order.
    turn : of the machine, which has bearings.

    Raises
    ------
    MissingInput
        if specific loads are asked for and a bearing has no diameter or length.
    """
    machine, objective = request.machine, request.objective
    assert isinstance(machine, ReciprocatingMachine)  # no other has bearings
    asked = _Asked(request, machine, layout, turn)
    groups = {"external": asked.external(responses)}
    if objective.bearing_weight > 0:
        groups["bearings"] = (asked.weighed_bearings(),)
    if objective.bending_weight > 0:
        groups["bending"] = (asked.weighed_bending(),)
    limited = tuple(asked.limited())
    chosen, allowances = _in_order(objective, groups)
    square = float(layout.omega**2)
    # of all orders the ceilings are among what is limited over the turn
    first = limited_responses(responses, objective) if objective.orders == "first" else ()
    exact = tuple((each, allowed / square) for each, allowed in first)
    capped = tuple((each.quantity, each.ceiling / square) for each in limited)
    program = OverTurn(tuple(asked.quantities), chosen, exact, capped, limits(machine))
    return Goals(program, allowances, limited)


class _Asked:
    """The quantities that an objective asks for, each once."""

    def __init__(
        self, request: OptimizeRequest, machine: ReciprocatingMachine, layout: Layout, turn: WholeTurn
    ) -> None:
        self.objective, self.fidelity, self.machine = request.objective, request.fidelity, machine
        self.layout, self.turn = layout, turn
        self.quantities: list[Quantity] = []
        self._places: dict[str, range] = {}

    def external(self, responses: Sequence[Response]) -> tuple[Group, ...]:
        """Force and moment, as they are weighed and combined: of the first order in closed form, of all by cuts."""
        wanted, across = weights(self.machine, self.objective), self.objective.direction_weights
        if self.objective.orders == "all":
            places = zip(RESPONSES, self._of_shaking(), strict=True)
            weighed = [Weighed(q, float(wanted[name])) for name, q in places if wanted[name] > 0]
            return tuple(Group(weighed=(each,)) for each in weighed)
        peaks = [
            weighted_peak(each, wanted[each.name], across.x, across.y) for each in responses if wanted[each.name] > 0
        ]
        return tuple(Group(rows=rows) for rows in combined(peaks, self.objective.combine)) if peaks else ()

    def weighed_bearings(self) -> Group:
        measure, weight = self.objective.bearing_measure, self.objective.bearing_weight
        area = self._areas if measure == "specific" else np.ones(len(self.machine.bearings))
        places = self._of_bearings("rms" if measure == "rms" else "peak")
        return Group(weighed=tuple(Weighed(q, weight / size) for q, size in zip(places, area.tolist(), strict=True)))

    def weighed_bending(self) -> Group:
        return Group(weighed=tuple(Weighed(q, self.objective.bending_weight) for q in self._of_bending()))

    def limited(self) -> Iterator[Limited]:
        """Ceilings, whatever is weighed on peaks."""
        if self.objective.orders == "all":
            allowed = ceilings(self.objective)
            for each, q in zip(RESPONSES.values(), self._of_shaking(), strict=True):
                if each.name in allowed:
                    yield Limited(each.ceiling_field, each.limit, q, allowed[each.name])
        load, specific = self.objective.bearing_ceiling_N, self.objective.specific_load_ceiling_Pa
        if load is not None:
            for q in self._of_bearings("peak"):
                yield Limited("bearing_ceiling_N", "bearing_ceiling", q, load)
        if specific is not None:
            for q, area in zip(self._of_bearings("peak"), self._areas.tolist(), strict=True):
                yield Limited("specific_load_ceiling_Pa", "specific_load_ceiling", q, specific * area)
        if self.objective.bending_ceiling_Nm is not None:
            for q in self._of_bending():
                yield Limited("bending_ceiling_Nm", "bending_ceiling", q, self.objective.bending_ceiling_Nm)

    def _of_shaking(self) -> range:
        """Force and moment of all orders."""
        return self._placed("shaking", lambda: [Quantity(each) for each in shaking(self.turn, self.layout)])

    def _of_bearings(self, measure: Literal["peak", "rms"]) -> range:
        def loads() -> list[Quantity]:
            responses = bearing_responses(self.machine, self.fidelity, self.layout, self.turn)
            return [Quantity(response, measure) for response in responses]

        return self._placed(measure, loads)

    def _of_bending(self) -> range:
        def moments() -> list[Quantity]:
            influence = INFLUENCES[self.fidelity.shaft]
            responses = bending_moments(self.turn, self.layout, bearing_places(self.machine), influence)
            return [Quantity(response) for response in responses]

        return self._placed("bending", moments)

    def _placed(self, kind: str, found: Callable[[], list[Quantity]]) -> range:
        if kind not in self._places:
            first = len(self.quantities)
            self.quantities += found()
            self._places[kind] = range(first, len(self.quantities))
        return self._places[kind]

    @cached_property
    def _areas(self) -> Real:
        """Diameter times length of every bearing, m^2."""
        problems = list(missing_sizes(self.machine))
        if problems:
            raise MissingInput(problems)
        return np.array([(each.diameter_m or 0.0) * (each.length_m or 0.0) for each in self.machine.bearings])


def _in_order(objective: Objective, groups: dict[str, tuple[Group, ...]]) -> tuple[tuple[Goal, ...], tuple[float, ...]]:
    """Goals one after the other with their allowances, or one of them all."""
    order = [priority for priority in objective.priorities if priority.goal != "mass"]
    if order:
        return (
            tuple(Goal(priority.goal, groups[priority.goal]) for priority in order),
            tuple(priority.allowance for priority in order[:-1]),
        )
    every = [group for one in groups.values() for group in one]
    # several goals in their order are never combined: their quantities are of one kind
    if objective.combine == "max":
        rows = tuple(row for group in every for row in group.rows)
        every = [Group(rows, tuple(each for group in every for each in group.weighed))]
    return (Goal("all", tuple(every)),), ()


def missing_sizes(machine: ReciprocatingMachine) -> Iterator[FieldProblem]:
    """Sizes of bearings that specific loads need and the machine does not give."""
    for k, bearing in enumerate(machine.bearings):
        for name in ("diameter_m", "length_m"):
            if getattr(bearing, name) is None:
                path = ("machine", "bearings", k, name)
                yield FieldProblem(path, "specific loads need diameter and length of every bearing")
