"""Independent: the loop sums as arrays and plain numbers do, to the last digit."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from optimizer.numerics import sums
from optimizer.numerics.sums import MANY, force_and_couple

#: more than the loop takes at least, of the shortest sums
_MACHINES = MANY


def _separately(forces: np.ndarray, arm: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The same of one machine at a time, by arrays or in plain numbers."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(sums, "_compiler_is_loaded", lambda: False)
        pairs = [force_and_couple(force, own) for force, own in zip(forces, arm, strict=True)]
    force, couple = zip(*pairs, strict=True)
    return np.array(force), np.array(couple)


@given(terms=st.integers(1, 70), many=st.integers(0, 3), seed=st.integers(0, 2**16))
def test_sums_of_many_machines_are_those_of_each(terms: int, many: int, seed: int) -> None:
    source = np.random.default_rng(seed)
    rows = (many,) if many else ()
    machines = -(-_MACHINES // (terms * max(many, 1)))
    shape = (machines, *rows, terms)
    forces = source.normal(size=shape) + 1j * source.normal(size=shape)
    arm = source.normal(size=(machines, *(1 for _ in rows), terms))
    # some cancel, and some vanish
    forces[::3] = np.rint(forces[::3])
    arm[::3] = np.rint(arm[::3])
    forces[::4, ..., -1] = -forces[::4, ..., 0]
    couple, expected = force_and_couple(forces, arm), _separately(forces, arm)
    for ours, theirs in zip(couple, expected, strict=True):
        np.testing.assert_array_equal(ours, theirs)
    alone = force_and_couple(forces[0], arm[0])
    for ours, theirs in zip(alone, expected, strict=True):
        np.testing.assert_array_equal(ours, theirs[0])
        assert ours.shape == rows


def test_arms_of_all_machines_may_be_the_same() -> None:
    forces = np.random.default_rng(0).normal(size=(_MACHINES, 2, 3)).astype(complex)
    arm = np.array([[0.1, 0.2, 0.3]])
    couple = force_and_couple(forces, arm)
    expected = _separately(forces, np.broadcast_to(arm, (_MACHINES, 1, 3)))
    for ours, theirs in zip(couple, expected, strict=True):
        np.testing.assert_array_equal(ours, theirs)


@pytest.mark.parametrize("size", [1e-8, 1.0, 1e300, 1e-300])
def test_what_cancels_up_to_rounding_is_nothing(size: float) -> None:
    """Analytic: 0.1 + 0.2 - 0.3 is no force, whatever the unit, and with arms it is a couple."""
    forces = np.tile(np.array([0.1 * size, 0.2 * size, -0.3 * size], complex), (_MACHINES, 1))
    force, couple = force_and_couple(forces, np.broadcast_to([1.0, 2.0, 3.0], (_MACHINES, 3)))
    np.testing.assert_array_equal(force, 0.0)
    np.testing.assert_allclose(couple, 0.0 if size < 1e-250 else -0.4 * size, rtol=1e-12)
