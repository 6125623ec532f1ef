"""Which points are kept, and which is the knee; expected results are analytic."""

from functools import cache

import pytest

from optimizer.studies.pareto.points import knee, undominated, weighted_peaks
from schemas.front.pareto import ParetoPoint
from tests.studies.pareto.cases import front, straight


@cache
def point() -> ParetoPoint:
    """Any of a front."""
    return front(straight(), points=2).points[0]


def points(*peaks: tuple[float, float]) -> list[ParetoPoint]:
    return [point().model_copy(update={"weighted_force_peak_N": f, "weighted_moment_peak_Nm": m}) for f, m in peaks]


@pytest.mark.parametrize(
    ("values", "entries"),
    [
        ([(1, 9), (2, 5), (3, 1)], [(1, 9), (2, 5), (3, 1)]),
        ([(3, 1), (1, 9), (2, 5)], [(1, 9), (2, 5), (3, 1)]),
        ([(1, 9), (1, 8), (2, 5)], [(1, 8), (2, 5)]),
        ([(1, 9), (2, 9), (3, 1)], [(1, 9), (3, 1)]),
        ([(1, 9), (1, 9)], [(1, 9)]),
        ([(1, 5), (2, 6), (3, 4)], [(1, 5), (3, 4)]),
    ],
)
def test_points_that_another_equals_or_beats_are_left_out(
    values: list[tuple[float, float]], entries: list[tuple[float, float]]
) -> None:
    assert [weighted_peaks(position) for position in undominated(points(*values), weighted_peaks)] == entries


@pytest.mark.parametrize(
    ("values", "index"),
    [
        ([(0, 9)], None),
        ([(0, 9), (9, 0)], None),
        ([(0, 9), (3, 6), (9, 0)], None),
        ([(0, 9), (1, 3), (3, 2), (9, 0)], 1),
        ([(0, 900), (2, 250), (3, 200), (9, 0)], 1),
        ([(0, 9), (2, 5), (3, 2), (9, 0)], 2),
    ],
)
def test_the_knee_is_farthest_from_the_chord(values: list[tuple[float, float]], index: int | None) -> None:
    assert knee(points(*values)) == index
