"""From machine and objective to the problem: force and moment, bearing loads, bending moments.

The first order of the unchanged machine is the case without quantities over the turn. This is the only place that
names the fields that ask for the whole turn; those of the first order are in
:mod:`optimizer.formulation.formulate`.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Literal

import numpy as np

from optimizer.errors import MissingInput
from optimizer.formulation.formulate import limited as limited_responses
from optimizer.formulation.formulate import objective_ceilings, of_all_orders, weights
from optimizer.formulation.limits import limits
from optimizer.mechanics.layout import Layout
from optimizer.mechanics.roll import mirrored, roll
from optimizer.mechanics.shaft import INFLUENCES, bearing_places
from optimizer.mechanics.shaft_curves import bearing_loads, bending_moments
from optimizer.mechanics.shapes import closed, plates
from optimizer.mechanics.whole_turn import WholeTurn
from optimizer.numerics.arrays import Real, Reals
from optimizer.numerics.memoization import cached_property
from optimizer.numerics.records import record
from optimizer.program.cuts.cut import EXACT, Quantity, Scatter
from optimizer.program.cuts.dominance import Group, Weighed
from optimizer.program.cuts.semi_infinite import Goal, Problem
from optimizer.program.rows import Row, combined, weighted_peak
from optimizer.program.statement import Statement
from optimizer.responses.component import component
from optimizer.responses.curve import TurnResponse
from optimizer.responses.response import Response
from schemas.answer.limits import CeilingField, MachineLimit
from schemas.base.model import FieldProblem
from schemas.base.responses import CeilingFields
from schemas.machine.machine import Machine
from schemas.request.objective import COSTS, Objective
from schemas.request.scene import Fidelity

#: of responses that no shaft takes part in
_USUAL = Fidelity()


@record(frozen=True)
class Case:
    """A machine that the counterweights are to suit: the unchanged one, or that of a scenario."""

    machine: Machine
    omega_squared: Reals  # (...) rad^2/s^2; one, or one for each of many machines of one shape
    variants: tuple[tuple[Response, ...], ...]  # responses of the first order: nominal, then with other masses
    turn: tuple[WholeTurn, Layout] | None = None  # where the objective looks at the whole turn
    scenario: str | None = None
    weight: float = 1.0
    masses: float = 0.0  # share by which every reciprocating mass may be off, over the turn


@record(frozen=True)
class Limited:
    """A ceiling on a quantity over the turn."""

    field: CeilingField  # of the request
    limit: MachineLimit  # what it is called where it is touched
    quantity: int  # its place in the program
    ceiling: float  # [unit of the response]
    omega_squared: float  # of its case
    scenario: str | None


@record(frozen=True)
class Goals:
    """The goals of a request about the whole turn, or about several cases, as a program."""

    program: Problem  # over omega^2 of the unchanged machine
    limited: tuple[Limited, ...]  # as in the program
    cases: tuple[Case, ...]
    #: the problem with all changes of masses among which a peak has its largest, wherever counterweights are
    of_all_masses: Callable[[], Problem] | None = None  # None where no masses scatter

    @property
    def anywhere(self) -> Problem:
        """The problem as it holds of all counterweights, not of those alone by which changes of masses were sought."""
        return self.program if self.of_all_masses is None else self.of_all_masses()

    @property
    def speeds(self) -> Mapping[str | None, float]:
        """omega^2 by scenario, rad^2/s^2, of one request."""
        return {case.scenario: float(case.omega_squared) for case in self.cases}


def bearing_responses(
    machine: Machine, fidelity: Fidelity, turn: WholeTurn, layout: Layout
) -> tuple[TurnResponse, ...]:
    """Loads of the main bearings of one machine."""
    names = [f"bearing:{bearing.name}" for bearing in machine.bearings]
    return bearing_loads(turn, layout, names, bearing_places(machine), INFLUENCES[fidelity.shaft])


def formulate(
    machine: Machine,
    objective: Objective,
    cases: Sequence[Case],
    omega_squared: Reals,
    fidelity: Fidelity = _USUAL,
    scatter: Scatter = EXACT,
    apart: bool = False,
) -> Goals:
    """The problem of one request, or of many of the first order.

    Parameters
    ----------
    cases : machines that the counterweights are to suit, at least one; the largest weighted objective counts.
    omega_squared : (...) rad^2/s^2, what the program is divided by.
    scatter : what the counterweights may be off by.
    apart : every peak of a sum is a group by itself, the largest of its variants.

    Raises
    ------
    MissingInput
        if the objective has specific loads and a bearing has no diameter or length.
    """
    quantities: list[Quantity] = []
    response_weights = weights(machine, objective)
    case_quantities = [
        _CaseQuantities(case, objective, fidelity, response_weights, omega_squared, quantities) for case in cases
    ]
    groups: dict[str, list[tuple[Group, ...]]] = {"external": [entry.external(apart) for entry in case_quantities]}
    if objective.bearing_weight > 0:
        groups["bearings"] = [(entry.weighed_bearings(),) for entry in case_quantities]
    if objective.bending_weight > 0:
        groups["bending"] = [(entry.weighed_bending(),) for entry in case_quantities]
    limited = tuple(ceiling for entry in case_quantities for ceiling in entry.limited())
    order = _in_order(objective, groups)
    # of all orders the ceilings are among what is limited over the turn
    stated = objective.orders == "first" and objective_ceilings(objective)
    exact = tuple(
        [
            (entry, allowed / case.omega_squared)
            for case in (cases if stated else ())
            for responses in case.variants
            for entry, allowed in limited_responses(responses, objective)
        ]
    )
    capped = tuple((entry.quantity, entry.ceiling / entry.omega_squared) for entry in limited)
    cut, most = plates(machine), limits(closed(machine), np.shape(omega_squared))
    program = Problem(tuple(quantities), order, exact, capped, most, scatter, cut, objective.symmetric)
    return Goals(program, limited, tuple(cases))


def _all_positive(weight: Reals) -> bool:
    return weight > 0.0 if isinstance(weight, float) else bool(np.logical_and.reduce(weight > 0.0, axis=None))


def cone_program(
    machine: Machine, objective: Objective, responses: Sequence[Response], omega_squared: Reals
) -> Statement:
    """The program of the first order in mass-radius products: over omega^2, so that speed plays no part.

    Fields may hold columns, as in :func:`optimizer.mechanics.layout.layout`.

    Parameters
    ----------
    omega_squared : (...) rad^2/s^2; one program, or one for each of many machines that have one shape.
    """
    leading = np.shape(omega_squared)
    case = Case(machine, omega_squared, (tuple(response.spread(leading) for response in responses),))
    program = formulate(machine, objective, (case,), omega_squared).program.finite
    assert program is not None  # nothing of it is over the turn
    return program


class _CaseQuantities:
    """The quantities that an objective asks of a case, each once."""

    def __init__(
        self,
        case: Case,
        objective: Objective,
        fidelity: Fidelity,
        response_weights: Mapping[str, Reals],
        omega_squared: Reals,
        quantities: list[Quantity],
    ) -> None:
        """Prepare.

        Parameters
        ----------
        response_weights : weights of the responses of the first order.
        omega_squared : what the program is divided by.
        quantities : of all cases, to which those of this one are added.
        """
        self.objective, self.fidelity, self.case, self.quantities = objective, fidelity, case, quantities
        self._speed = case.omega_squared / omega_squared
        self._response_weights = {name: weight * self._speed * case.weight for name, weight in response_weights.items()}
        self._places: dict[str, range] = {}

    @property
    def machine(self) -> Machine:
        return self.case.machine

    @property
    def turn(self) -> tuple[WholeTurn, Layout]:
        assert self.case.turn is not None  # it is there where the objective looks at it
        return self.case.turn

    @property
    def _factor(self) -> float:
        return float(self._speed) * self.case.weight

    def external(self, apart: bool) -> tuple[Group, ...]:
        """Force and moment, as they are weighed and combined: of the first order in closed form, of all by cuts.

        The roll moment beside them always has all orders.
        """
        groups = self._of_frame(apart)
        if self.objective.roll_weight > 0:
            weight = self.objective.roll_weight * self._factor
            groups = (*groups, Group(weighed=tuple(Weighed(q, weight) for q in self._of_roll())))
        return (_union(groups),) if self.objective.combine == "max" and len(groups) > 1 else groups

    def _of_frame(self, apart: bool) -> tuple[Group, ...]:
        response_weights, across = self._response_weights, self.objective.direction_weights
        # of many programs of one shape all weigh it, or none
        weighs = [name for name, weight in response_weights.items() if _all_positive(weight)]
        if self.objective.orders == "all":
            places = [(self.quantities[q].response.name, q) for q in self._of_shaking()]
            weighed = [Weighed(q, float(response_weights[name])) for name, q in places if name in weighs]
            return tuple(Group(weighed=(entry,)) for entry in weighed)
        variants = [
            [
                weighted_peak(entry, response_weights[entry.name], across.x, across.y)
                for entry in of
                if entry.name in weighs
            ]
            for of in self.case.variants
        ]
        if not variants[0]:
            return ()
        if not apart:
            (peaks,) = variants
            rows = combined(peaks, self.objective.combine)
            return tuple(Group(rows=tuple(_called(row, self.case.scenario) for row in entry)) for entry in rows)
        results = [
            tuple(_called(Row(peak.name, (peak,)), self.case.scenario, n) for n, peak in enumerate(of_response))
            for of_response in zip(*variants, strict=True)
        ]
        return tuple(Group(rows=rows) for rows in results)

    def weighed_bearings(self) -> Group:
        measure, weight = self.objective.bearing_measure, self.objective.bearing_weight * self._factor
        area = self._areas if measure == "specific" else np.ones(len(self.machine.bearings))
        places = self._of_bearings("rms" if measure == "rms" else "peak")
        return Group(weighed=tuple(Weighed(q, weight / size) for q, size in zip(places, area.tolist(), strict=True)))

    def weighed_bending(self) -> Group:
        weight = self.objective.bending_weight * self._factor
        return Group(weighed=tuple(Weighed(q, weight) for q in self._of_bending()))

    def limited(self) -> Iterator[Limited]:
        """Ceilings, whatever is weighed on peaks."""
        for response, allowed in objective_ceilings(self.objective) if self.objective.orders == "all" else ():
            yield self._limited(response.field, response.limit, self._of_frame_under(response), allowed)
        load, specific = self.objective.bearing_ceiling_N, self.objective.specific_load_ceiling_Pa
        if load is not None:
            for q in self._of_bearings("peak"):
                yield self._limited("bearing_ceiling_N", "bearing_ceiling", q, load)
        if specific is not None:
            for q, area in zip(self._of_bearings("peak"), self._areas.tolist(), strict=True):
                yield self._limited("specific_load_ceiling_Pa", "specific_load_ceiling", q, specific * area)
        if self.objective.bending_ceiling_Nm is not None:
            for q in self._of_bending():
                yield self._limited("bending_ceiling_Nm", "bending_ceiling", q, self.objective.bending_ceiling_Nm)

    def _of_shaking(self) -> range:
        """Responses on the frame of all orders."""
        return self._placed(
            "shaking", lambda: [self._quantity(order) for order in of_all_orders(*self.turn, self.objective)]
        )

    def _of_frame_under(self, ceiling: CeilingFields) -> int:
        """What a ceiling limits of a response of all orders: all of it, or its component."""
        name, _, axis = ceiling.response.partition(":")
        (whole,) = (q for q in self._of_shaking() if self.quantities[q].response.name == name)
        if not axis:
            return whole
        response, sense = self.quantities[whole].response, float(self.turn[1].sense)
        return self._placed(ceiling.response, lambda: [self._quantity(component(response, axis, sense))])[0]

    def _of_roll(self) -> range:
        def moment() -> list[Quantity]:
            response, shafts = roll(*self.turn), self.turn[1].balance
            if shafts is not None and self.objective.orders == "first":
                response = mirrored(response, shafts)
            return [self._quantity(response)]

        return self._placed("roll", moment)

    def _of_bearings(self, measure: Literal["peak", "rms"]) -> range:
        def loads() -> list[Quantity]:
            responses = bearing_responses(self.machine, self.fidelity, *self.turn)
            return [self._quantity(response, measure) for response in responses]

        return self._placed(measure, loads)

    def _of_bending(self) -> range:
        def moments() -> list[Quantity]:
            influence = INFLUENCES[self.fidelity.shaft]
            responses = bending_moments(*self.turn, bearing_places(self.machine), influence)
            return [self._quantity(response) for response in responses]

        return self._placed("bending", moments)

    def _quantity(self, response: TurnResponse, measure: Literal["peak", "rms"] = "peak") -> Quantity:
        return Quantity(response, measure, self.case.scenario, self.case.masses)

    def _limited(self, field: CeilingField, limit: MachineLimit, quantity: int, ceiling: float) -> Limited:
        return Limited(field, limit, quantity, ceiling, float(self.case.omega_squared), self.case.scenario)

    def _placed(self, kind: str, source: Callable[[], list[Quantity]]) -> range:
        if kind not in self._places:
            first = len(self.quantities)
            self.quantities += source()
            self._places[kind] = range(first, len(self.quantities))
        return self._places[kind]

    @cached_property
    def _areas(self) -> Real:
        """Diameter times length of every bearing, m^2."""
        problems = list(missing_sizes(self.machine))
        if problems:
            raise MissingInput(problems)
        return np.array([(bearing.diameter_m or 0.0) * (bearing.length_m or 0.0) for bearing in self.machine.bearings])


def _called(row: Row, scenario: str | None, variant: int | None = None) -> Row:
    """A row by the names of its scenario and of its variant of the masses."""
    if scenario is None and not variant:
        return row
    name = row.name if not variant else f"{row.name} {variant}"
    return row._replace(name=name if scenario is None else f"{name} in {scenario}")


def _largest(name: str, cases: Sequence[tuple[Group, ...]]) -> Goal:
    """The largest of the sums of groups of several cases."""
    if len(cases) == 1:
        return Goal(name, cases[0])
    if all(len(case) == 1 for case in cases):
        return Goal(name, (_union([group for case in cases for group in case]),))
    flat = tuple(group for case in cases for group in case)
    return Goal(name, flat, cases=tuple(n for n, case in enumerate(cases) for _ in case))


def _union(groups: Sequence[Group]) -> Group:
    """The largest of several groups."""
    rows = tuple(row for group in groups for row in group.rows)
    return Group(rows, tuple(member for group in groups for member in group.weighed))


def _in_order(objective: Objective, groups: dict[str, list[tuple[Group, ...]]]) -> tuple[Goal, ...]:
    """Goals one after the other, or one of them all.

    Parameters
    ----------
    groups : of every goal those of each case.
    """
    if objective.priorities:
        *earlier, last = objective.priorities
        # nothing uses what the very last allows
        order = [*((entry.goal, entry.allowance) for entry in earlier), (last.goal, 0.0)]
        return tuple(
            _largest(name, groups[name])._replace(allowance=allowance) for name, allowance in order if name not in COSTS
        )
    every = [tuple(group for part in of_case for group in part) for of_case in zip(*groups.values(), strict=True)]
    # several goals in their order are never combined: their quantities are of one kind
    if objective.combine == "max":
        every = [(_union(entry),) for entry in every]
    return (_largest("all", every),)


def missing_sizes(machine: Machine) -> Iterator[FieldProblem]:
    """Sizes of bearings that specific loads need and the machine does not give."""
    for k, bearing in enumerate(machine.bearings):
        for name in ("diameter_m", "length_m"):
            if getattr(bearing, name) is None:
                path = ("machine", "bearings", k, name)
                yield FieldProblem(path, "specific loads need diameter and length of every bearing")
