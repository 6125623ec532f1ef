"""What of one term the webs come to each alone: analytic."""

import numpy as np
import pytest

from optimizer.program.methods.cascade import _single_term
from optimizer.program.rows import combined, statement, weighted_peak
from optimizer.program.solution import evaluated
from optimizer.program.statement import Statement
from optimizer.responses.response import Phasors, Response
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
    found = _single_term(program, evaluated(program, np.array(point, complex)))
    assert found.objective == pytest.approx(objective, abs=1e-12)
    assert found.lower_bound <= found.objective + 1e-12
