"""The forces of the rows over the turn, where an objective looks at them."""

from optimizer.formulation.simulation import Prepared
from optimizer.mechanics.whole_turn import WholeTurn
from optimizer.outputs.requirements import effects_of_objective
from schemas.request.objective import Objective


def whole_turn_of(scene: Prepared, objective: Objective) -> WholeTurn:
    """The forces of the rows over the turn, as far as an objective looks at them."""
    (effect,) = effects_of_objective(objective)
    turn: WholeTurn = scene.simulated.result(effect, "objective")
    return turn
