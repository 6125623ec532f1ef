from concurrent.futures import ThreadPoolExecutor

import cvxpy as cp
import numpy as np
import pytest

from optimizer.program.reference.assembled import Assembled, GroupLimit, solved
from optimizer.program.reference.modelling import ConeProgram
from optimizer.program.reference.solver import smallest_objective
from optimizer.program.scaled_program import ScaledSolution, Shape, Stage
from optimizer.program.scaling import Scaling, scale
from optimizer.program.statement import Statement
from tests.night import part
from tests.program.cases import random_statement

STAGES: tuple[Stage, Stage] = ("objective", "mass")
SHAPE = Shape("objective", webs=2, rows=(0, 0), groups=(0,), ceilings=0, sectors=False, budget=False)


def test_a_program_that_is_not_dpp_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cp.Problem, "is_dcp", lambda _self, dpp=False: not dpp)
    with pytest.raises(RuntimeError, match="DPP"):
        ConeProgram(SHAPE)


@pytest.mark.parametrize("stage", ["objective", "mass"])
@pytest.mark.parametrize("sectors", [False, True])
@pytest.mark.parametrize("budget", [False, True])
@pytest.mark.parametrize("ceilings", [0, 2])
@pytest.mark.parametrize(("rows", "groups"), [((0, 0), (0,)), ((0, 0, 1, 1), (0, 0)), ((0, 0, 1), (0, 1))])
def test_every_shape_compiles(stage, sectors, budget, ceilings, rows, groups) -> None:
    shape = Shape(stage, 3, rows, groups, ceilings, sectors, budget)
    assert ConeProgram(shape).shape == shape


@pytest.mark.parametrize("combine", part(2, ["sum", "max"]))
@pytest.mark.parametrize("sectors", [False, True])
@pytest.mark.parametrize("budget", [False, True])
@pytest.mark.parametrize("ceilings", [False, True])
def test_matrices_are_the_same_program(combine: str, sectors: bool, budget: bool, ceilings: bool) -> None:
    """Independent: the model in cvxpy, in both stages; the least mass under a level in the second."""
    statement = random_statement(3, combine, (1.0, 1.0), sectors, budget, ceilings, webs=4)
    largest = float(np.max(statement.limits.reach))
    data, scaling = scale(statement, "objective", largest, 1e-9)
    target = 1.1 * _objective(statement, ConeProgram(data.shape).solve(data, 1e-10), scaling)
    for stage in STAGES:
        data, scaling = scale(statement, stage, largest, 1e-9, target)
        model = ConeProgram(data.shape).solve(data, 1e-10)
        whole = GroupLimit(np.ones(1, bool), float(data.target[0]))
        matrices = solved(data, 1e-10, np.inf, targets=(whole,) if stage == "mass" else ())
        assert isinstance(matrices, Assembled)
        if stage == "objective":
            objective, second_objective = (
                _objective(statement, solution, scaling) for solution in (model, matrices.solution)
            )
        else:
            objective, second_objective = (
                _mass(statement, solution, scaling) for solution in (model, matrices.solution)
            )
        assert objective == pytest.approx(second_objective, rel=1e-6)


def _objective(statement: Statement, solution: ScaledSolution | None, scaling: Scaling) -> float:
    assert solution is not None
    return float(statement.objective(scaling.unbalance(statement, solution)))


def _mass(statement: Statement, solution: ScaledSolution | None, scaling: Scaling) -> float:
    assert solution is not None
    return float(statement.mass(scaling.unbalance(statement, solution)))


def test_threads_beside_one_another_get_the_answers_of_one() -> None:
    problems = [random_statement(seed, "sum", (1.0, 1.0), False, False, False, webs=4) for seed in range(24)]
    alone = [smallest_objective(problem, 1e-9) for problem in problems]
    with ThreadPoolExecutor(4) as threads:
        together = list(threads.map(lambda problem: smallest_objective(problem, 1e-9), problems))
    for solution, second_solution in zip(alone, together, strict=True):
        assert np.array_equal(solution.unbalance, second_solution.unbalance)
