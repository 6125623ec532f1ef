"""Places in rising lists, against numpy's search."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from optimizer.numerics.kernel.rising import first_no_less


@given(st.lists(st.integers(-5, 5), max_size=12), st.integers(-6, 6))
def test_the_first_that_is_no_less_is_that_of_numpy_independent(values: list[int], value: int) -> None:
    rows = np.array(sorted(values), float).reshape(-1, 1) * [1.0, -1.0]
    # as Python, since only kernels call it
    assert first_no_less.py_func(rows, float(value)) == np.searchsorted(rows[:, 0], value)
