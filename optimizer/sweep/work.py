"""How much there is to do for one design over the turn."""

from optimizer.effects.registry import effects_of
from optimizer.outputs import OUTPUTS, needs_samples
from schemas.machine import ReciprocatingMachine
from schemas.requests import AnalyzeRequest, OptimizeRequest


def work_per_design(request: OptimizeRequest | AnalyzeRequest) -> int:
    """Rows times angles that one design needs at once, which bounds the memory of a block; 0 without any."""
    effects = effects_of([need for output in request.outputs for need in OUTPUTS[output].column_needs])
    if not isinstance(request.machine, ReciprocatingMachine) or "kinematics" not in effects:
        return 0
    rows = sum(len(throw.rows) for throw in request.machine.throws)
    samples = request.angles.count if needs_samples(request) else 1
    # a row brings at most 6 breaks, and the halved panels of 10 degrees have 12 nodes each
    nodes = 24 * (36 + 6 * rows) if "torque_integrals" in effects else 1
    # and the pieces of 5 degrees have ten coefficients each
    pieces = 10 * (72 + 6 * rows) if "whole_turn" in effects else 1
    return max(rows, 1) * max(samples, nodes, pieces)
