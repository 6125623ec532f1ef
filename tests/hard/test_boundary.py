"""Ceilings on the edge of what can be reached; analytic: see :mod:`tests.hard.boundary`."""

import numpy as np
import pytest

from tests.hard.boundary import ladders, run
from tests.night import every

#: enough to stand on both sides of the place, within and beyond the tolerance of a ceiling
DISTANCES = (-1e-6, -1e-9, -1e-12, 0.0, 1e-12, 1e-9, 1e-8, 1e-6)


@pytest.mark.parametrize("seed", every(3, range(3)))
def test_nothing_jumps_and_everything_is_settled(seed: int) -> None:
    """Objectives fall as ceilings are raised, nothing gets out of reach, and every answer is decided."""
    ladders = run(2, seed, DISTANCES)
    assert ladders
    for ladder in ladders:
        assert not ladder.faults, (ladder.place, ladder.ceilings, ladder.faults)
        statuses = [rung.status for rung in ladder.rungs]
        assert set(statuses) <= {"optimal", "infeasible"}, (ladder.place, ladder.ceilings, statuses)


@pytest.mark.nightly
def test_many_webs_on_the_boundary() -> None:
    """32 webs, half of which carry next to nothing: doubles do not tell whether both ceilings can be kept."""
    (reachable,) = (
        ladder
        for ladder in ladders(np.random.default_rng((0, 120)), (-1e-12, 0.0, 1e-12))
        if ladder.place == "reachable"
    )
    below, *statuses = [rung.status for rung in reachable.rungs]
    # what is out of reach by 1e-12 is told, or taken up by the tolerance of a ceiling
    assert below in {"infeasible", "optimal"}
    assert statuses == ["optimal", "optimal"]


@pytest.mark.parametrize(("number", "places"), [(141, {"reachable"}), (243, {"reachable", "at rest", "unlimited"})])
def test_ceilings_that_cost_far_more_or_far_less_than_what_is_weighed(number: int, places: set[str]) -> None:
    """An optimum of 367 times the objective at rest; a web of 1e-7 kg, whose mass the ceiling alone holds up."""
    near = (-1e-8, -1e-9, 0.0, 1e-11, 1e-8)
    actual_ladders = [scale for scale in ladders(np.random.default_rng((0, number)), near) if scale.place in places]
    assert {actual_ladder.place for actual_ladder in actual_ladders} == places
    for ladder in actual_ladders:
        assert not ladder.faults, (ladder.place, ladder.faults)
        assert {rung.status for rung in ladder.rungs} <= {"optimal", "infeasible"}, ladder.place
