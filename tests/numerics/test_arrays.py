"""Masks, and sums that cancel: few of one machine are compared in plain numbers, many by arrays."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from optimizer.numerics.arrays import all_true, any_true, read_only, total


@given(arrays.arrays(bool, arrays.array_shapes(min_dims=0, max_dims=3, min_side=0, max_side=5)), st.booleans())
def test_masks_are_as_numpy_reduces_them(mask: np.ndarray, apart: bool) -> None:
    # independent: numpy's reductions, of masks that lie apart in memory too
    actual_mask = mask[..., ::2] if apart and mask.ndim else mask
    assert any_true(actual_mask) is bool(np.any(actual_mask))
    assert all_true(actual_mask) is bool(np.all(actual_mask))


def test_a_mask_that_is_spread_is_read_in_full() -> None:
    # analytic
    mask = np.broadcast_to(np.array([False, True]), (3, 2))
    assert any_true(mask)
    assert not all_true(mask)
    assert all_true(np.array(True))
    assert not any_true(np.array(False))


@pytest.mark.parametrize("seed", range(5))
def test_few_sums_are_as_many(seed: int) -> None:
    # independent: the same sums among many; every third cancels up to rounding
    rng = np.random.default_rng(seed)
    terms = rng.normal(size=(60, 5)) + 1j * rng.normal(size=(60, 5))
    terms[::3, 4] = -np.add.reduce(terms[::3, :4], axis=-1) * (1.0 + 2.0 ** -rng.integers(45, 56, 20))
    many = total(terms)
    few = np.concatenate([total(terms[n : n + 6]) for n in range(0, 60, 6)])
    alone = np.array([total(row) for row in terms])
    assert np.array_equal(many, few)
    assert np.array_equal(many, alone)
    assert np.count_nonzero(many == 0)


@pytest.mark.parametrize("count", [1, 6, 40])
def test_nothing_real_is_that_small(count: int) -> None:
    # analytic: no terms cancel, yet a sum below what is real is nothing
    sums = total(np.array([[1e-260, 2e-260j], [1e-240, 2e-240j]] * count))
    assert np.array_equal(sums, [0.0, 1e-240 + 2e-240j] * count)


def test_a_read_only_array_is_a_view_of_one_that_is_not() -> None:
    array = np.arange(4.0)
    view = read_only(array)
    assert np.shares_memory(view, array)
    assert (view.flags.writeable, array.flags.writeable) == (False, True)
