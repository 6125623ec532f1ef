"""The responses that an objective can weigh and limit.

What they are called is in :mod:`schemas.base.responses`; how each is made of force and moment stands here, and
everything after it goes by name.
Fields may hold columns, as in :func:`optimizer.mechanics.layout.layout`.
"""

from collections.abc import Callable, Mapping, Sequence

import numpy as np

from optimizer.mechanics.balance_shafts import first_order_responses
from optimizer.mechanics.frame import FORCE, MOMENT, Shares, first_order, shaking
from optimizer.mechanics.inertia import Wrench
from optimizer.mechanics.layout import Layout, outermost
from optimizer.mechanics.whole_turn import WholeTurn
from optimizer.numerics.arrays import SMALLEST, Reals
from optimizer.numerics.memoization import remembered
from optimizer.numerics.records import record
from optimizer.responses.curve import TurnResponse
from optimizer.responses.response import Response
from schemas.base.responses import PAIR, CeilingFields, ResponseFields
from schemas.base.responses import RESPONSES as FIELDS
from schemas.base.responses import active_responses as fields_that_count
from schemas.base.responses import limited as limited_fields
from schemas.base.rules import Path
from schemas.base.variation import with_fields
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
    if np.ndarray not in map(type, planes):
        length = max(planes) - min(planes)
        return 1.0 if length <= SMALLEST else length
    low, high = outermost(planes)
    length = high - low
    return np.where(length <= SMALLEST, 1.0, length)[()]


@record(frozen=True)
class Weighable:
    """A response on the frame that an objective can weigh, limit and trade.

    fields : what it is called.
    shares : what it has of force and moment; fields of the objective may be columns.
    """

    fields: ResponseFields
    shares: Callable[[Layout, Objective], Shares]

    @property
    def name(self) -> str:
        return self.fields.name

    @property
    def unit(self) -> str:
        return self.fields.unit

    def weight(self, machine: Machine, objective: Objective) -> Reals:
        """Its weight, 1/unit; a number or a column."""
        weight: Reals | None = getattr(objective, self.fields.weight)
        return 1.0 / span(machine) if weight is None else weight


#: how each comes about; one more is one more entry here and in :mod:`schemas.base.responses`
SHARES: dict[str, Callable[[Layout, Objective], Shares]] = {
    "force": lambda layout, objective: FORCE,
    "moment": lambda layout, objective: MOMENT,
    # beside these two
}
#: in the order of the answer
RESPONSES: dict[str, Weighable] = {name: Weighable(fields, SHARES[name]) for name, fields in FIELDS.items()}


def active_responses(objective: Objective) -> tuple[Weighable, ...]:
    """Force and moment, and of the others those that an objective weighs or limits."""
    return tuple(RESPONSES[field.name] for field in fields_that_count(objective))


def extra_responses(objective: Objective) -> tuple[Weighable, ...]:
    """Those that count beside force and moment."""
    if len(RESPONSES) == len(PAIR):
        return ()
    return tuple(response for response in active_responses(objective) if response.name not in PAIR)


def responses(layout: Layout, baseline: Wrench, objective: Objective) -> tuple[Response, ...]:
    """Responses that count to the unbalance of the counterweights, force and moment first.

    Parameters
    ----------
    baseline : first-order force and moment without counterweights.
    """
    force, moment = first_order_responses(layout, baseline)
    return tuple(
        first_order(response.name, response.unit, response.shares(layout, objective), force, moment)
        for response in active_responses(objective)
    )


def of_all_orders(turn: WholeTurn, layout: Layout, objective: Objective) -> tuple[TurnResponse, ...]:
    """The same of all orders, of one machine."""
    units = {
        response.name: (response.unit, response.shares(layout, objective)) for response in active_responses(objective)
    }
    return shaking(turn, layout, units)


def weights(machine: Machine, objective: Objective) -> Mapping[str, Reals]:
    """Weight of each response, by name: 1/N and 1/(N m)."""
    return {response.name: response.weight(machine, objective) for response in RESPONSES.values()}


def with_weights_of(machine: Machine, objective: Objective) -> Objective:
    """The objective, in which weights that the machine decides by default are numbers."""
    fields = (response.fields.weight for response in RESPONSES.values())
    usual: dict[Path, Reals] = {(field,): 1.0 / span(machine) for field in fields if getattr(objective, field) is None}
    return with_fields(objective, usual) if usual else objective


def weighing(objective: Objective, weights: Mapping[str, float], **update: object) -> Objective:
    """The objective that weighs these responses on the frame and no others."""
    weight_fields = {response.fields.weight: weights.get(response.name, 0.0) for response in RESPONSES.values()}
    return objective.model_copy(update=weight_fields | update)


def objective_ceilings(objective: Objective) -> list[tuple[CeilingFields, float]]:
    """Hard limits on the peaks that an objective gives, with the largest peaks allowed: N and N m."""
    return [(fields, getattr(objective, fields.field)) for fields in limited_fields(objective)]


def limited(responses: Sequence[Response], objective: Objective) -> list[tuple[Response, float]]:
    """Responses, and components of them, that have a ceiling, with the largest peaks allowed: N and N m."""
    by_name = {response.name: response for response in responses}
    return [(_of(by_name, ceiling), allowed) for ceiling, allowed in objective_ceilings(objective)]


def _of(responses: Mapping[str, Response], ceiling: CeilingFields) -> Response:
    if ceiling.axis is None:
        return responses[ceiling.response]
    return responses[ceiling.response.removesuffix(f":{ceiling.axis}")].along(ceiling.axis)


def shape_facts(machine: Machine, objective: Objective) -> tuple[np.ndarray, ...]:
    """What decides of which terms and rows a program is made, each yes or no, a number or a column."""
    across = objective.direction_weights
    weighed = (np.asarray(weight) > 0 for weight in weights(machine, objective).values())
    return (*weighed, np.asarray(across.x) == across.y)
