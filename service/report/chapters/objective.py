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

#: what may be weighed beside responses, in words
_LOADS = {
    "roll_weight": "roll moment",
    "bearing_weight": "largest bearing load",
    "bending_weight": "largest bending moment",
}


def _text(value: float | str | tuple[Priority, ...]) -> float | str:
    return ", ".join(map(_goal, value)) if isinstance(value, tuple) else value


def _goal(priority: Priority) -> str:
    """A goal, with what those after it may use of it."""
    return priority.goal if not priority.allowance else f"{priority.goal} (allowance {100 * priority.allowance:g} %)"


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
    # of goals in their order the loads are goals by themselves
    fields = _LOADS if not goal.priorities else ("roll_weight",)
    loads = [_LOADS[field] for field in fields if getattr(goal, field)]
    *rest, last = (*(f"peak {response.label}" for response in count), *loads)
    names = ", ".join(rest)
    combined = {
        "sum": f"smallest weighted sum of {names} and {last}",
        "max": "smallest larger one of weighted peak force and weighted peak moment"
        if len(rest) == 1
        else f"smallest of the largest of {names} and {last}, all weighted",
    }
    aim = combined[goal.combine]
    if goal.priorities:
        external = any(priority.goal == "external" for priority in goal.priorities)
        aim = f"goals in their order; external: {aim}" if external else "goals in their order"
    return facts(
        "Objective",
        [
            ("aim", aim),
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
