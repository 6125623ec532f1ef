"""What choices are judged by: the certified optimum of any masses, first order alone."""

import numpy as np

from optimizer.formulation.task import Task
from optimizer.outputs.registry import prepare
from optimizer.solve.certify import Certified, certified
from schemas.request.requests import OptimizeRequest


def of_any_mass(request: OptimizeRequest) -> tuple[Certified, float]:
    """The optimum, and the yardstick of its objective over omega^2, kg m."""
    scene, task = prepare(request, ("residual",)), Task.of(request)
    square = np.array([scene.omega_squared])
    best = certified(task.machine, task.objective, scene.responses, square, task.of_any_mass)
    return best, float(best.certificate["yardstick"][0] / square[0])
