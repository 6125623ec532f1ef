"""Ceilings on the edge of what can be reached; analytic: see :mod:`tests.hard.boundary`."""

import numpy as np
import pytest

from tests.hard.boundary import ladders, run

#: enough to stand on both sides of the place, within and beyond the tolerance of a ceiling
DISTANCES = (-1e-6, -1e-9, -1e-12, 0.0, 1e-12, 1e-9, 1e-8, 1e-6)


@pytest.mark.parametrize("seed", range(3))
def test_nothing_jumps_and_everything_is_settled(seed: int) -> None:
    """Objectives fall as ceilings are raised, nothing gets out of reach, and every answer is decided."""
    found = run(2, seed, DISTANCES)
    assert found
    for ladder in found:
        assert not ladder.faults, (ladder.place, ladder.ceilings, ladder.faults)
        statuses = [one.status for one in ladder.asked]
        assert set(statuses) <= {"optimal", "infeasible"}, (ladder.place, ladder.ceilings, statuses)


def test_many_webs_on_the_boundary() -> None:
    """32 webs, half of which carry next to nothing: doubles do not tell whether both ceilings can be kept."""
    (reachable,) = (
        each for each in ladders(np.random.default_rng((0, 120)), (-1e-12, 1e-12)) if each.place == "reachable"
    )
    assert [one.status for one in reachable.asked] == ["optimal", "optimal"]
