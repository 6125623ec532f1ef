"""Relaxations of nodes: what the time leaves out proves nothing, and nothing is false of it."""

from dataclasses import replace

import numpy as np
import pytest

from optimizer.choices.clock import Clock
from optimizer.choices.relaxations import solved
from optimizer.program.certificate import objective_lower_bound
from optimizer.program.statement import Statement
from tests.program.cases import random_statement, stacked

_COUNT = 6


def _turned() -> Statement:
    """Programs whose influences have a phase, which the compiled kernel does not take."""
    single = random_statement(5, "sum", (1.0, 1.0), False, False, False, webs=3)
    norms = single.norms
    influence = norms.influence * np.exp(0.3j * np.arange(norms.influence.shape[0]))[:, None]
    return stacked([replace(single, norms=replace(norms, influence=influence))] * _COUNT)


@pytest.mark.parametrize("calls", [0, 2])
def test_the_time_ends_programs_that_are_solved_one_by_one(calls: int) -> None:
    # analytic: a clock that runs out after so many looks leaves so many programs
    ticks = iter([0.0] * (calls + 1) + [2.0] * _COUNT)
    programs = _turned()
    solutions = solved(programs, None, np.full(_COUNT, 1e-6), np.zeros(_COUNT), False, Clock(1.0, lambda: next(ticks)))
    bounds = objective_lower_bound(programs, solutions.multipliers)
    assert np.all(np.isfinite(bounds[:calls]))
    assert np.all(bounds[calls:] == -np.inf)
    assert not np.any(solutions.unbalance[calls:])
    assert not np.any(solutions.nowhere)
