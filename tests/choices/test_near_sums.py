"""Which sums are near to one another: what comparing all of them comes to (independent)."""

from itertools import pairwise

import numpy as np
import pytest

from optimizer.choices.discrete.kernel.near_sums import ALL, gridded, near

_EVERY = np.array([-np.inf, np.inf])


def _pairs(
    lists: list[np.ndarray], radius: float, edges: list[float], cells: int, most: tuple[int, int]
) -> list[tuple[int, int, int, int]]:
    """Places in four lists of all pairs of sums that are found near, slab by slab, so many at a time."""
    values, d = [], lists[0].shape[1]
    axes = np.array([1, 2] if d > 2 else [0, d - 1])
    for slab in pairwise(edges):
        wide, start, ended = np.array(slab) + np.array([-radius, radius]), np.array([0, 0, -1, -1]), len(lists[2])
        grid = np.full(2, -1.0), 2.0 / cells, np.full(2, cells)
        side = max(grid[1], radius)
        first, sums, places = gridded(lists[0], lists[1], wide, axes, grid[0], side, grid[2], ALL)
        while start[0] < ended:
            met, start, _ = near(
                first, sums, lists[2], lists[3], np.array(slab), axes, grid[0], side, grid[2], ALL, start, radius**2,
                np.array(most),
            )  # fmt: skip
            values += zip(*places[:, met[0]].tolist(), *met[1:].tolist(), strict=True)
    return values


@pytest.mark.parametrize("d", [1, 2, 4, 6])
@pytest.mark.parametrize("most", [(1, 10**9), (1000, 0), (1000, 10**9)])
def test_every_pair_once(d: int, most: tuple[int, int]) -> None:
    """Independent: all distances, some sums beyond the grid; one pair at a time, one sum at a time, all at once."""
    chance = np.random.default_rng([d, most[0]])
    lists = [chance.normal(size=(n, d)) for n in (7, 9, 8, 6)]
    for n in (1, 3):
        lists[n] = lists[n][np.argsort(lists[n][:, 0])]
    first = (lists[0][:, None] + lists[1][None]).reshape(-1, d)
    second = (lists[2][:, None] + lists[3][None]).reshape(-1, d)
    off = np.linalg.norm(first[:, None] - second, axis=-1)
    radius = float(np.quantile(off, 0.02))
    i, j = np.nonzero(off <= radius)
    expected = sorted(zip(*np.divmod(i, 9), *np.divmod(j, 6), strict=True))
    for edges in ([-np.inf, np.inf], [-np.inf, -0.5, 0.1, np.inf]):
        for cells in (1, 5):
            assert sorted(_pairs(lists, radius, edges, cells, most)) == expected
    assert len(expected) > 10


def test_a_share_is_about_that_many_and_the_same_each_time() -> None:
    """Analytic: of 40,000 sums a quarter, four standard deviations more or less."""
    chance = np.random.default_rng(0)
    lists = chance.normal(size=(200, 2)), np.sort(chance.normal(size=(200, 2)), axis=0)
    grid = np.arange(2), np.zeros(2), 1.0, np.ones(2, np.int64)
    first, sums, places = gridded(*lists, _EVERY, *grid, np.uint64(2**62))
    assert abs(first[-1] - 10_000) <= 4.0 * np.sqrt(40_000 * 0.25 * 0.75)
    assert np.array_equal(sums, lists[0][places[0]] + lists[1][places[1]])
    assert np.array_equal(places, gridded(*lists, _EVERY, *grid, np.uint64(2**62))[2])
