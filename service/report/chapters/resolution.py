"""The largest first-order peak that still counts as zero, by the gap of the certificate."""

from collections.abc import Mapping

from optimizer.formulation.formulate import weights
from schemas.answer.answers import OptimizeAnswer
from schemas.request.requests import Accuracy, OptimizeRequest


def resolutions(request: OptimizeRequest, answer: OptimizeAnswer) -> Mapping[str, float]:
    """Peaks by response [its unit] that the gap of the objective outweighs; none where it is of no such peaks.

    A choice has a wider gap, and its figures are those of the choice: the gap is no wider than that of any masses.
    """
    goal, proof = request.objective, answer.certificate
    if proof is None or proof.relative_gap is None or goal.orders != "first" or goal.priorities or request.robust:
        return {}
    usual: float = Accuracy.model_fields["relative_gap"].default
    gap = min(request.accuracy.relative_gap, usual) * proof.yardstick
    factors = {name: float(weight) for name, weight in weights(request.machine, goal).items()}
    return {name: gap / weight for name, weight in factors.items() if weight > 0.0}
