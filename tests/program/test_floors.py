"""Bounds by smallest circles, which need no solver."""

import numpy as np
import pytest

from optimizer.numerics.enclosing_circle import smallest_circle
from optimizer.program.certificate import objective_lower_bound
from optimizer.program.cuts.floors import floor_multipliers
from tests.program.cases import random_point
from tests.program.turning import bearings, wide


@pytest.mark.parametrize("beside", [False, True])
def test_floors_are_proven_whatever_the_limits(beside: bool) -> None:
    """Analytic: the largest radius, and beside it the counter-rotating phasors, which no counterweight changes."""
    program = bearings(3, limits=wide(6, 1e9), beside=beside)
    posed = program.outer(program.first)
    expected = max(smallest_circle(np.array([cut.constant for cut in cuts])).radius for cuts in program.first)
    expected += sum(peak.floor for group in program.groups for row in group.rows for peak in row.peaks)
    bound = objective_lower_bound(posed, floor_multipliers(program, program.first, posed))
    # slopes cancel to rounding, times a reach of 1e9 kg
    assert bound == pytest.approx(expected, rel=1e-5)
    rng = np.random.default_rng(0)
    for _ in range(5):
        assert bound <= program.values(random_point(rng, wide(6)), 1e-9).goals[0]
