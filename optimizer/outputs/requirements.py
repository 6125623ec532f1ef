"""What an objective over the whole turn needs and a machine does not give, in the objective's name."""

from collections.abc import Iterator

from optimizer.effects.registry import problems_of
from optimizer.formulation.goals import missing_sizes
from optimizer.outputs.registry import OUTPUTS
from schemas.base.model import FieldProblem
from schemas.machine.machine import Machine
from schemas.request.objective import Objective

#: effects that an objective over the whole turn needs, and one about peaks on the frame alone
_TURN, _ON_FRAME = ("whole_turn",), ("frame_forces",)
#: why the bending of a shaft without bearings is undetermined
_FREE = (
    "a free shaft bends in a known way only where its loads balance at every angle, which those of pistons never do:"
    " give the bearings that carry them"
)


def effects_of_objective(objective: Objective) -> tuple[str, ...]:
    """Effects that an objective needs of a machine, beyond the first order: none, or one."""
    if not objective.of_the_revolution:
        return ()
    return _TURN if objective.of_the_shaft or objective.roll_weight > 0 else _ON_FRAME


def missing(machine: Machine, goal: Objective) -> Iterator[FieldProblem]:
    """Fields that the objective of one request needs and the machine does not give; paths from the request."""
    if not goal.of_the_revolution:
        return
    needs = OUTPUTS["main_bearings"].needs if goal.of_the_shaft else effects_of_objective(goal)
    field = goal.of_the_revolution[0]
    for path, message in problems_of(machine, needs):
        why = _FREE if path == ("bearings",) and field.startswith("bending") else message
        yield FieldProblem(("machine", *path), f"{why}; needed by objective.{field}")
    specific = goal.specific_load_ceiling_Pa is not None or (goal.bearing_weight and goal.bearing_measure == "specific")
    if specific:
        yield from missing_sizes(machine)
