"""The responses that an objective can weigh and limit.

The only place that translates the fields of the contract that name responses; everything after it goes by name.
Fields may hold columns, as in :func:`optimizer.mechanics.layout.layout`.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Literal, NamedTuple

import numpy as np

from optimizer.formulation.limits import limits
from optimizer.mechanics.balance_shafts import first_order_responses
from optimizer.mechanics.inertia import Wrench
from optimizer.mechanics.layout import Layout, stacked
from optimizer.numerics.arrays import SMALLEST, Reals
from optimizer.numerics.memoization import remembered
from optimizer.program.rows import combined, statement, weighted_peak
from optimizer.program.statement import Statement
from optimizer.responses.response import Response
from schemas.answer.limits import CeilingField, MachineLimit
from schemas.machine.machine import Machine
from schemas.machine.reciprocating import ReciprocatingMachine
from schemas.request.objective import Objective


@remembered
def span(machine: Machine) -> Reals:
    """Axial span L of throws and webs, m; 1 m if that is zero (docs/api/optimize.md)."""
    if isinstance(machine, ReciprocatingMachine):
        planes = [throw.position_m for throw in machine.throws]
    else:
        planes = [machine.orbiting_position_m, machine.anti_rotation.position_m]
    planes += [web.position_m for web in machine.webs]
    places = stacked(planes)
    length = np.maximum.reduce(places, axis=-1) - np.minimum.reduce(places, axis=-1)
    return np.where(length <= SMALLEST, 1.0, length)[()]


Axis = Literal["x", "y"]


@dataclass(frozen=True)
class Ceiling:
    """A hard limit on a peak."""

    name: str  # of the response that it limits
    unit: str  # of the response
    allowed: Callable[[Objective], float | None]  # [unit of the response]; a number or a column
    field: CeilingField  # of the request
    limit: MachineLimit  # what it is called where it is touched
    axis: Axis | None = None  # of the component that it limits; None is the whole vector


class Component(NamedTuple):
    """A component of a response that an objective can limit."""

    axis: Axis
    ceiling: Callable[[Objective], float | None]  # [unit of the response]; a number or a column
    ceiling_field: CeilingField  # of the request
    limit: MachineLimit  # what a touched ceiling is called


@dataclass(frozen=True)
class Weighable:
    """A response that an objective can weigh and limit."""

    name: str  # of the response
    unit: str  # of the response
    response: Callable[[Layout, Wrench], Response]  # from the first order without counterweights
    weight: Callable[[Machine, Objective], Reals]  # [1/unit of the response]; a number or a column
    ceiling: Callable[[Objective], float | None]  # [unit of the response]; a number or a column
    ceiling_field: CeilingField  # of the request
    limit: MachineLimit  # what a touched ceiling is called
    components: tuple[Component, ...] = ()  # that have ceilings of their own

    @cached_property
    def limits(self) -> tuple[Ceiling, ...]:
        """Its ceilings, that of the whole vector first."""
        return (
            Ceiling(self.name, self.unit, self.ceiling, self.ceiling_field, self.limit),
            *(
                Ceiling(f"{self.name}:{axis}", self.unit, ceiling, field, limit, axis)
                for axis, ceiling, field, limit in self.components
            ),
        )


FORCE = Weighable(
    name="force",
    unit="N",
    response=lambda layout, baseline: first_order_responses(layout, baseline)[0],
    weight=lambda machine, objective: objective.force_weight,
    ceiling=lambda objective: objective.force_ceiling_N,
    ceiling_field="force_ceiling_N",
    limit="force_ceiling",
    components=(
        Component("x", lambda objective: objective.force_ceiling_x_N, "force_ceiling_x_N", "force_ceiling_x"),
        Component("y", lambda objective: objective.force_ceiling_y_N, "force_ceiling_y_N", "force_ceiling_y"),
    ),
)
MOMENT = Weighable(
    name="moment",
    unit="N m",
    response=lambda layout, baseline: first_order_responses(layout, baseline)[1],
    weight=lambda machine, objective: (
        1.0 / span(machine) if objective.moment_weight is None else objective.moment_weight
    ),
    ceiling=lambda objective: objective.moment_ceiling_Nm,
    ceiling_field="moment_ceiling_Nm",
    limit="moment_ceiling",
    components=(
        Component("x", lambda objective: objective.moment_ceiling_x_Nm, "moment_ceiling_x_Nm", "moment_ceiling_x"),
        Component("y", lambda objective: objective.moment_ceiling_y_Nm, "moment_ceiling_y_Nm", "moment_ceiling_y"),
    ),
)
#: what can be weighed, in the order of the answer; one more is one more entry
RESPONSES: dict[str, Weighable] = {each.name: each for each in (FORCE, MOMENT)}


def responses(layout: Layout, baseline: Wrench) -> tuple[Response, ...]:
    """All responses to the unbalance of the counterweights.

    Parameters
    ----------
    baseline : first-order force and moment without counterweights.
    """
    return tuple(each.response(layout, baseline) for each in RESPONSES.values())


def weights(machine: Machine, objective: Objective) -> Mapping[str, Reals]:
    """Weight of each response, by name: w_F [1/N] and w_M [1/(N m)]."""
    return {each.name: each.weight(machine, objective) for each in RESPONSES.values()}


def with_weights_of(machine: Machine, objective: Objective) -> Objective:
    """The objective with the weights given that a machine decides by default."""
    return objective.model_copy(update={"moment_weight": float(MOMENT.weight(machine, objective))})


def given_ceilings(objective: Objective) -> list[tuple[Ceiling, float]]:
    """Hard limits on the peaks that an objective gives, with the largest peaks allowed: N and N m."""
    all_of = ((each, each.allowed(objective)) for response in RESPONSES.values() for each in response.limits)
    return [(each, allowed) for each, allowed in all_of if allowed is not None]


def limited(responses: Sequence[Response], objective: Objective) -> list[tuple[Response, float]]:
    """Responses, and components of them, that have a ceiling, with the largest peaks allowed: N and N m."""
    by_name = {response.name: response for response in responses}
    return [(_of(by_name, ceiling), allowed) for ceiling, allowed in given_ceilings(objective)]


def _of(responses: Mapping[str, Response], ceiling: Ceiling) -> Response:
    if ceiling.axis is None:
        return responses[ceiling.name]
    return responses[ceiling.name.removesuffix(f":{ceiling.axis}")].along(ceiling.axis)


def shape_facts(machine: Machine, objective: Objective) -> tuple[np.ndarray, ...]:
    """What decides of which terms and rows a program is made, each yes or no, a number or a column."""
    across = objective.direction_weights
    weighed = (np.asarray(weight) > 0 for weight in weights(machine, objective).values())
    return (*weighed, np.asarray(across.x) == across.y)


def smallest_peak(response: Response, machine: Machine) -> Statement:
    """The program for one peak alone (...), without ceilings."""
    # the larger of one is that one, and its row has its name
    peak = weighted_peak(response, 1.0)
    return statement(combined([peak], "max"), [], limits(machine, response.baseline.co.shape))
