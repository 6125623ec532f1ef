"""What an objective over the whole turn needs and a machine does not give, in the objective's name."""

from collections.abc import Iterator

from optimizer.effects.registry import problems_of
from optimizer.goals import missing_sizes
from optimizer.outputs import OUTPUTS
from schemas.base import FieldProblem
from schemas.machine import ReciprocatingMachine
from schemas.requests import OptimizeRequest

#: effects that force and moment of all orders need
_TURN = ("whole_turn",)


def missing(request: OptimizeRequest) -> Iterator[FieldProblem]:
    """Fields that the objective of one request needs and the machine does not give; paths from the request."""
    machine, goal = request.machine, request.objective
    if not goal.over_the_turn:
        return
    needs = OUTPUTS["main_bearings"].needs if goal.of_the_shaft else _TURN
    for path, message in problems_of(machine, needs):
        yield FieldProblem(("machine", *path), f"{message}; asked for by objective.{goal.over_the_turn[0]}")
    specific = goal.specific_load_ceiling_Pa is not None or (goal.bearing_weight and goal.bearing_measure == "specific")
    if specific and isinstance(machine, ReciprocatingMachine):
        yield from missing_sizes(machine)
