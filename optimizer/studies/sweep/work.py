"""How much there is to do for one design over the turn."""

from optimizer.effects.registry import effects_of
from optimizer.mechanics.cylinders import cycle_turns, entry_count
from optimizer.outputs.registry import column_groups
from schemas.machine.reciprocating import ReciprocatingMachine
from schemas.request.requests import AnalyzeRequest, OptimizeRequest
from schemas.sweep.request import SweepRequest


def work_per_design(
    request: OptimizeRequest | AnalyzeRequest, always: tuple[str, ...], selection: frozenset[str]
) -> int:
    """Rows times angles that one design needs at once, which bounds the memory of a block; 0 without any.

    Parameters
    ----------
    always : outputs with columns in every row, whether the request names them or not.
    selection : keys of the columns that are.
    """
    groups = column_groups(request, always, selection)
    effects = effects_of([need for group in groups for need in group.needs or ()])
    if not isinstance(request.machine, ReciprocatingMachine) or "kinematics" not in effects:
        return 0
    rows = sum(len(throw.rows) for throw in request.machine.throws)
    turns = cycle_turns(request.machine)
    samples = turns * request.angles.count if any(group.sampled for group in groups) else 1
    # a row brings at most 6 breaks in a turn, a trace its entries; the halved panels of 10 degrees have 12 nodes each,
    # where integrals have no closed form
    breaks = 6 * rows * turns + entry_count(request.machine)
    by_quadrature = request.fidelity.kinematics != "exact" or entry_count(request.machine) > 0
    nodes = 24 * (36 * turns + breaks) if by_quadrature and "torque_integrals" in effects else 1
    # and the pieces of 5 degrees have ten coefficients each
    pieces = 10 * (72 * turns + breaks) if "whole_turn" in effects else 1
    return max(rows, 1) * max(samples, nodes, pieces)


def worked_out_alone(request: SweepRequest) -> int:
    """How many groups of columns every design is worked out by itself for."""
    return sum(group.alone for group in column_groups(request.base, request.always, request.column_keys))


def curves_over_turn(request: SweepRequest) -> int:
    """Curves that the program of one design cuts, over all its goals: bearing loads, bending moments, all orders."""
    machine, names = request.base.machine, request.over_the_turn
    if not isinstance(machine, ReciprocatingMachine) or not isinstance(request.base, OptimizeRequest):
        return 0
    bearings = len(machine.bearings)
    planes = bearings + sum(1 + len(throw.rows) for throw in machine.throws) + len(machine.webs)
    of_orders = 2 if "orders" in names else 0
    of_bearings = bearings if any(name.startswith(("bearing", "specific")) for name in names) else 0
    of_bending = planes if any(name.startswith("bending") for name in names) else 0
    return (of_orders + of_bearings + of_bending) * max(1, len(request.base.objective.priorities))
