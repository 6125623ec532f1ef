"""What was asked to be small."""

from optimizer.formulation.formulate import given_ceilings, weights
from schemas.request.objective import Priority
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


def _told(value: float | str | tuple[Priority, ...]) -> float | str:
    return ", ".join(each.goal for each in value) if isinstance(value, tuple) else value


def objective(request: OptimizeRequest) -> Table:
    """Weights, ceilings and goals, as they hold."""
    goal, wanted = request.objective, weights(request.machine, request.objective)
    combined = {
        "sum": "smallest weighted sum of peak force and peak moment",
        "max": "smallest larger one of weighted peak force and weighted peak moment",
    }
    return facts(
        "Objective",
        [
            ("aim", combined[goal.combine]),
            ("weight of the peak force, 1/N", float(wanted["force"])),
            ("weight of the peak moment, 1/(N m)", float(wanted["moment"])),
            ("weight of components along x", goal.direction_weights.x),
            ("weight of components along y", goal.direction_weights.y),
            ("ceiling of the peak force, N", "none" if goal.force_ceiling_N is None else goal.force_ceiling_N),
            ("ceiling of the peak moment, N m", "none" if goal.moment_ceiling_Nm is None else goal.moment_ceiling_Nm),
            *(
                (f"ceiling of the {each.name.replace(':', ' along ')}, {each.unit}", allowed)
                for each, allowed in given_ceilings(goal)
                if each.axis is not None
            ),
            *(
                (_OVER_THE_TURN[name], _told(getattr(goal, name)))
                for name in (*goal.over_the_turn, *(("bearing_measure",) if goal.bearing_weight else ()))
            ),
            ("among all optima", "the lightest" if goal.least_mass else "any"),
            ("relative gap asked for", request.accuracy.relative_gap),
        ],
    )
