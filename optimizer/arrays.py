"""Arrays and their exact sums. Leading axes are programs or machines; vectors across the shaft are complex, x + jy."""

import numpy as np
from numpy.typing import NDArray

Real = NDArray[np.float64]
Complex = NDArray[np.complex128]
#: one number, or one for each of many programs
Reals = Real | float

#: a sum smaller than this share of the sum of the magnitudes of its terms is rounding error
_ROUNDING = 16 * np.finfo(float).eps
#: nothing real is this small; below it quotients lose their digits and then overflow
SMALLEST = 1e-250


def total(terms: Complex) -> Complex:
    """Sum over the last axis; exactly zero where the terms cancel up to rounding.

    A machine that balances itself then has a baseline of zero, not of 1e-13 N, and is the
    ordinary case that it should be.

    Parameters
    ----------
    terms : (..., n) complex.

    Returns
    -------
    (...) complex.
    """
    value = np.sum(terms, axis=-1)
    noise = np.maximum(_ROUNDING * np.sum(np.abs(terms), axis=-1), SMALLEST)
    return np.where(np.abs(value) <= noise, 0.0, value)
