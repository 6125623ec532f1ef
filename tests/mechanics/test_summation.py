"""Sums that are exactly zero where only rounding errors are left."""

import numpy as np

from optimizer.numerics.arrays import total


def test_cancelling_terms_are_zero() -> None:
    terms = np.array([0.1, 0.2, -0.3 + 1e-17j])
    assert np.sum(terms) != 0
    assert total(terms) == 0


def test_small_but_real_sums_are_kept() -> None:
    terms = np.array([1.0, -1.0 + 1e-12j])
    assert total(terms) == 1e-12j


def test_the_threshold_follows_the_terms() -> None:
    assert total(np.array([1e-12, 1e-12j])) == 1e-12 + 1e-12j
    assert total(np.array([1e12, -1e12, 1e-5])) == 0
    assert total(np.array([1e12, -1e12, 1.0])) == 1.0


def test_nothing_sums_to_zero() -> None:
    assert total(np.zeros(0, complex)) == 0
    assert total(np.zeros((3, 0), complex)).shape == (3,)


def test_sums_run_over_the_last_axis() -> None:
    rng = np.random.default_rng(2)
    terms = rng.normal(size=(4, 5, 6)) + 1j * rng.normal(size=(4, 5, 6))
    np.testing.assert_allclose(total(terms), terms.sum(axis=-1), rtol=1e-15)
