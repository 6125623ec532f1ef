"""The best set of options beside SCIP, a solver of mixed-integer cone programs (independent)."""

import numpy as np
import pytest

from optimizer.program.verdict import yardstick
from tests.choices.highs import SIDES, highs
from tests.choices.scip import scip
from tests.choices.sets import options_of
from tests.choices.test_search import search_result_of
from tests.night import part
from tests.program.cases import random_statement

#: SCIP keeps constraints to 1e-6 of what they are scaled to; of the yardstick
_CLOSE = 1e-5
#: s; no test ends by the clock
_LONG = 1e9


@pytest.mark.parametrize(
    ("combine", "budget", "ceilings", "fitted"),
    part(
        2,
        [("sum", False, False, None), ("max", True, False, None), ("sum", True, False, 3), ("max", False, True, None)],
        rows=True,
    ),
)
def test_four_webs(combine: str, budget: bool, ceilings: bool, fitted: int | None) -> None:
    """Four webs, five masses at six angles: 31^4 sets."""
    problem = random_statement(11, combine, (1.0, 0.7), False, budget, ceilings, webs=4)
    most = float(np.max(problem.limits.max_mass))
    masses = [0.1 * most, 0.25 * most, 0.4 * most, 0.6 * most, 0.8 * most]
    options = options_of(problem, masses, [0.0, 60.0, 120.0, 180.0, 240.0, 300.0], fitted)
    size = float(yardstick(problem.alone())[0])
    chosen, ours = search_result_of(problem, options, relative_gap=1e-6)
    objective = float(problem.objective(options.of(options.unbalance, chosen)))
    theirs = scip(problem, options, 1e-7, size, _LONG)
    assert objective == pytest.approx(theirs.objective, abs=_CLOSE * size)
    assert ours.lower_bound <= theirs.objective + _CLOSE * size
    assert theirs.lower_bound <= objective + _CLOSE * size


def test_two_solvers_of_others_agree() -> None:
    """SCIP on circles and HiGHS on polygons (independent): its bound is one of the circles, its set no better."""
    problem = random_statement(5, "sum", (1.0, 0.7), False, False, False, webs=3)
    most = float(np.max(problem.limits.max_mass))
    options = options_of(problem, [0.3 * most, 0.6 * most], [0.0, 90.0, 180.0, 270.0], None)
    size = float(yardstick(problem.alone())[0])
    theirs, bound = (rival(problem, options, 1e-7, size, _LONG) for rival in (scip, highs))
    chosen, _ = search_result_of(problem, options, relative_gap=1e-9)
    objective = float(problem.objective(options.of(options.unbalance, chosen)))
    assert theirs.objective == pytest.approx(objective, abs=_CLOSE * size)
    assert bound.objective >= objective - _CLOSE * size
    assert bound.objective <= objective + 5.0 / SIDES**2 * size
    assert bound.lower_bound <= objective + _CLOSE * size
    for body in (theirs, bound):
        assert body.selection is not None
        judged = float(problem.objective(options.of(options.unbalance, body.selection)))
        assert judged == pytest.approx(body.objective, abs=_CLOSE * size)
