"""What of one term the webs come to each alone, analytic; and what is found for many programs at once."""

from dataclasses import replace

import numpy as np
import pytest

from optimizer.program.methods.cascade import _single_term, cascade
from optimizer.program.methods.optima import optima
from optimizer.program.methods.single import Target, interior_point
from optimizer.program.rows import combined, statement, weighted_peak
from optimizer.program.solution import evaluated
from optimizer.program.statement import Statement
from optimizer.responses.response import Phasors, Response
from tests.program.cases import random_statement, stacked
from tests.program.turning import wide


def _term(most: float, ceiling: float | None = None) -> Statement:
    """|1 + u1 + 0.5 u2| with webs of 0.2 m, and under a ceiling |u1|."""
    force = Response("force", "N", Phasors(np.asarray(1.0 + 0j), np.asarray(0j)), np.array([1.0, 0.5]))
    first = Response("first", "N", Phasors(np.asarray(0j), np.asarray(0j)), np.array([1.0, 0.0]))
    ceilings = [] if ceiling is None else [(first, ceiling)]
    return statement(combined([weighted_peak(force, 1.0)], "sum"), ceilings, wide(2, most))


@pytest.mark.parametrize(
    ("most", "ceiling", "point", "objective"),
    [
        # one web cancels all of it
        (9.0, None, [0.0, -0.2], 0.0),
        # two that are full do more than one
        (2.0, None, [-0.4, -0.4], 0.4),
        (2.0, None, [0.0, -0.4], 0.6),
        # the web that does most alone is above the ceiling
        (2.0, 0.1, [-0.1, -0.4], 0.7),
    ],
)
def test_a_web_alone_is_taken_where_it_is_better_and_keeps_the_ceilings(
    most: float, ceiling: float | None, point: list[float], objective: float
) -> None:
    program = _term(most, ceiling)
    solution = _single_term(program, evaluated(program, np.array(point, complex)))
    assert solution.objective == pytest.approx(objective, abs=1e-12)
    assert solution.lower_bound <= solution.objective + 1e-12


@pytest.mark.parametrize("least_mass", [True, False])
def test_ceilings_out_of_reach_are_proven_together_as_by_the_cascade(least_mass: bool) -> None:
    """Independent: the cascade, which takes one program at a time, finds the same points and the same proofs."""
    cases = [random_statement(seed, "sum", (1.0, 1.0), True, True, True, 6) for seed in range(12)]
    program = stacked(cases)
    share = np.full(len(cases), 0.3)
    share[::3] = 1.0
    program = replace(program, ceilings=replace(program.ceilings, cap=share[:, None] * program.ceilings.cap))
    bound = optima(program, 1e-6, least_mass)
    assert 2 <= np.count_nonzero(bound.unreachable) <= 8
    assert not bound.unreachable[::3].any()
    for n in bound.unreachable.nonzero()[0].tolist():
        alone, target = program.subset(n), Target(1e-6, 1e-6, least_mass)
        own = cascade(alone, target, interior_point(alone, target))
        assert own.conflict is not None
        assert np.array_equal(own.unbalance, bound.unbalance[n])
        assert np.array_equal(own.conflict.ceiling, bound.conflict.ceiling[n])
        assert np.array_equal(own.conflict.row, bound.conflict.row[n])
        assert own.method == bound.method[n]
        assert (own.lower_bound, own.mass_lower_bound) == (bound.lower_bound[n], bound.mass_lower_bound[n])
        assert own.mass_target == bound.mass_target[n]
        for name in ("objective", "mass", "excess"):
            assert getattr(own, name) == pytest.approx(getattr(bound, name)[n], rel=1e-13)
