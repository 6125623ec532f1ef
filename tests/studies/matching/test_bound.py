"""The bound by sorting against the linear programs of doubly stochastic matrices."""

import cvxpy as cp
import numpy as np
import pytest

from optimizer.studies.matching.bound import best_plane
from optimizer.studies.matching.problem import stated
from optimizer.studies.matching.search import searched
from schemas.match.request import MatchRequest
from tests.studies.matching.cases import machine, parts


@pytest.mark.parametrize(("rows", "classes"), [(6, 1), (8, 2)])
def test_it_is_that_of_all_mixtures(rows: int, classes: int) -> None:
    """Independent: the relaxation as a cone program; ours proves all of it but a thousandth of what is open."""
    cranks = [float(73 * k % 360) for k in range(rows)]
    body = {"machine": machine(cranks, [45.0, 120.0] * (rows // 2)), "parts": parts(rows, *[rows] * classes)}
    request = MatchRequest.model_validate(body)
    problem = stated(request, request.machine, np.zeros(0), np.zeros(0))
    shares = [cp.Variable((rows, rows), nonneg=True) for _ in range(classes)]
    once = [cp.sum(share, axis=axis) == 1 for share in shares for axis in (0, 1)]
    masses = cp.hstack([share @ places.mass for share, places in zip(shares, problem.classes, strict=True)])
    relaxed = cp.Problem(cp.Minimize(cp.sum(cp.abs(problem.start + problem.of_place @ masses))), once)
    relaxed.solve(solver=cp.CLARABEL)
    mass = searched(problem, problem.peaks, problem.input_order[None])[0]
    objective = float(problem.peaks.at(problem.vectors(mass)))
    number = best_plane(problem, problem.peaks, objective, 0.0).least
    assert number <= relaxed.value * (1 + 1e-6)
    assert relaxed.value - number <= 1e-3 * objective
    assert number <= objective
