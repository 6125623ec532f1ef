"""Sums of options: of those that do the same one is left, the first in the order among equals."""

import numpy as np
import pytest

from optimizer.choices.discrete import sums
from optimizer.choices.discrete.sums import Sums


def drawn(rng: np.random.Generator, count: int) -> Sums:
    """Sums of few values, so that many are equal."""
    return Sums(
        rng.integers(-1, 2, (count, 2)) + 1j * rng.integers(-1, 2, (count, 2)),
        rng.integers(1, 3, count).astype(float),
        rng.integers(1, 3, count).astype(float),
        rng.integers(0, 2, count),
        rng.integers(0, 2, count),
        np.arange(count),
    )


@pytest.mark.parametrize("odd", [sums._ODD, np.uint64(0)])
@pytest.mark.parametrize("count", [0, 1, 2, 40, 400])
def test_one_of_each_kind_is_left(count: int, odd: np.uint64, monkeypatch: pytest.MonkeyPatch) -> None:
    """Independent: a dictionary of kinds. Of an odd number 0 all sums have the same number: chance changes nothing."""
    monkeypatch.setattr(sums, "_ODD", odd)
    several = drawn(np.random.default_rng(count), count)
    best: dict[tuple[object, ...], int] = {}
    for n in range(count):
        kind = (*several.z[n], several.fitted[n], several.parts[n])
        m = best.setdefault(kind, n)
        if (several.mass[n], several.square[n], n) < (several.mass[m], several.square[m], m):
            best[kind] = n
    assert sums._distinct(several).code.tolist() == sorted(best.values())
