"""The objective of the request."""

from collections.abc import Iterable, Iterator

from optimizer.formulation.formulate import objective_ceilings, weights
from schemas.base.responses import ResponseFields, active_responses
from schemas.base.titles import field_title
from schemas.request.objective import Objective, Priority
from schemas.request.requests import OptimizeRequest
from service.report.blocks import Table, facts

#: fields of the objective that look at the whole turn, in words
_OVER_THE_TURN = {
    "bearing_weight": "weight of the largest bearing load, 1/N or 1/Pa",
    "bearing_measure": "measure of the bearing loads",
    "bearing_ceiling_N": "ceiling of the bearing loads, N",
    "specific_load_ceiling_Pa": "ceiling of the specific bearing loads, Pa",
    "bending_weight": "weight of the largest bending moment, 1/(N m)",
    "bending_ceiling_Nm": "ceiling of the bending moments, N m",
    "roll_weight": "weight of the roll moment, 1/(N m)",
    "orders": "orders of force and moment",
    "priorities": "goals in their order",
}


def _text(value: float | str | tuple[Priority, ...]) -> float | str:
    return ", ".join(priority.goal for priority in value) if isinstance(value, tuple) else value


def _per(unit: str) -> str:
    return f"1/({unit})" if " " in unit else f"1/{unit}"


def _ceilings(goal: Objective, responses: Iterable[ResponseFields]) -> Iterator[tuple[ResponseFields, float]]:
    """Ceilings that there are of whole responses."""
    for response in responses:
        allowed: float | None = getattr(goal, response.ceilings[0].field)
        if allowed is not None:
            yield response, allowed


def objective(request: OptimizeRequest) -> Table:
    """Weights, ceilings and goals, as they hold."""
    goal, weight_of = request.objective, weights(request.machine, request.objective)
    count = active_responses(goal)
    *rest, last = (response.label for response in count)
    names = ", ".join(f"peak {name}" for name in rest)
    combined = {
        "sum": f"smallest weighted sum of {names} and peak {last}",
        "max": "smallest larger one of weighted peak force and weighted peak moment"
        if len(count) == 2
        else f"smallest of the largest of {names} and peak {last}, all weighted",
    }
    return facts(
        "Objective",
        [
            ("aim", combined[goal.combine]),
            *(
                (f"weight of the peak {response.label}, {_per(response.unit)}", float(weight_of[response.name]))
                for response in count
            ),
            *(
                (field_title("Objective", field), getattr(goal, field))
                for response in count
                for field in response.parameters
            ),
            *(
                (f"weight of components along {axis}", weight)
                for axis, weight in (("x", goal.direction_weights.x), ("y", goal.direction_weights.y))
                if weight != 1
            ),
            *(
                (f"ceiling of the peak {response.label}, {response.unit}", most)
                for response, most in _ceilings(goal, count)
            ),
            *(
                (f"ceiling of the {response.label}, {response.unit}", allowed)
                for response, allowed in objective_ceilings(goal)
                if response.axis is not None
            ),
            *(
                (_OVER_THE_TURN[name], _text(getattr(goal, name)))
                for name in (*goal.over_the_turn, *(("bearing_measure",) if goal.bearing_weight else ()))
            ),
            ("among all optima", "the lightest" if goal.least_mass else "any"),
            ("relative gap asked for", request.accuracy.relative_gap),
        ],
    )
