from concurrent.futures import ThreadPoolExecutor

import cvxpy as cp
import numpy as np
import pytest

from optimizer.program.reference.modelling import CompiledPrograms, ConeProgram
from optimizer.program.reference.solver import Solver
from optimizer.program.scaled_program import Shape
from tests.program.cases import random_statement

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


def test_idle_programs_are_lent_again_and_busy_ones_are_not() -> None:
    programs = CompiledPrograms()
    with programs.lend(SHAPE) as first, programs.lend(SHAPE) as second:
        assert first is not second
    with programs.lend(SHAPE) as again:
        assert again in (first, second)


def test_the_least_used_shapes_are_forgotten() -> None:
    programs = CompiledPrograms(capacity=1)
    with programs.lend(SHAPE) as first:
        pass
    with programs.lend(SHAPE._replace(webs=3)):
        pass
    with programs.lend(SHAPE) as again:
        assert again is not first


def test_a_program_that_failed_is_not_lent_again() -> None:
    programs = CompiledPrograms()
    with pytest.raises(ZeroDivisionError), programs.lend(SHAPE) as broken:
        raise ZeroDivisionError
    with programs.lend(SHAPE) as other:
        assert other is not broken


def test_threads_that_share_a_solver_get_the_answers_of_one() -> None:
    solver = Solver()
    problems = [random_statement(seed, "sum", (1.0, 1.0), False, False, False, webs=4) for seed in range(24)]
    alone = [solver.smallest_objective(problem, 1e-9) for problem in problems]
    with ThreadPoolExecutor(4) as threads:
        together = list(threads.map(lambda problem: solver.smallest_objective(problem, 1e-9), problems))
    for one, other in zip(alone, together, strict=True):
        assert np.array_equal(one.unbalance, other.unbalance)
