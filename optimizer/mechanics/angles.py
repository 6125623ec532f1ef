"""Directions from angles in degrees, exact where they can be."""

import cmath
import math
from functools import lru_cache

import numpy as np

from optimizer.numerics.arrays import Complex, Real
from optimizer.numerics.memoization import remembered_of_pair

_QUADRANTS = np.array([1, 1j, -1, -1j])
_QUADRANT: tuple[complex, ...] = (1.0 + 0.0j, 1.0j, -1.0 + 0.0j, -1.0j)
#: a degree in radians, as an exponent
_DEGREE = 1j * np.pi / 180.0
#: so many angles are quicker one by one, to the same last digit
_FEW = 16


def direction(angle_deg: Real) -> Complex:
    """Unit vector e^{j angle} for angles in degrees.

    The angle is first reduced to an eighth of a turn to either side of an axis, in degrees, where the reduction is
    exact. So angles 90, 120 or 180 degrees apart give unit vectors whose sum is exactly zero, and a machine
    that balances itself does so in the numbers as well.

    Parameters
    ----------
    angle_deg : (...) degrees.

    Returns
    -------
    (...) complex, dimensionless.
    """
    angle = np.asarray(angle_deg, dtype=float)
    if angle.ndim == 1 and angle.size <= _FEW:
        return np.array([_vector(degrees) for degrees in angle.tolist()], complex)
    if angle.ndim == 0:
        return np.array(_vector(float(angle)))
    quarters = np.asarray(np.rint(angle / 90.0))
    rest = angle - 90.0 * quarters
    radians = rest * (np.pi / 180.0)
    # in half the time of a complex exponential, to the same last digit
    vector = np.empty(angle.shape, complex)
    vector.real, vector.imag = np.cos(radians), np.sin(radians)
    # sin 30 = 1/2, and sin 45 = cos 45
    size = np.abs(rest)
    for exact, across in ((30.0, 0.5), (45.0, vector.real)):
        there = size == exact
        if np.count_nonzero(there):
            np.copysign(across, rest, out=vector.imag, where=there)
    vector *= _QUADRANTS.take(quarters.astype(np.int64) & 3)
    return vector


# cranks and axes of a machine have few angles, and most machines the same
@lru_cache(maxsize=1024)
def _vector(angle_deg: float) -> complex:
    """The same of one angle."""
    quarters = round(angle_deg / 90.0)
    rest = angle_deg - 90.0 * quarters
    vector, size = cmath.exp(_DEGREE * rest), abs(rest)
    if size >= 30.0:
        across = 0.5 if size == 30.0 else vector.real if size == 45.0 else abs(vector.imag)
        vector = complex(vector.real, math.copysign(across, rest))
    return vector * _QUADRANT[quarters % 4]


@remembered_of_pair
def shaft_vectors(sense: Real, angle_rad: Real) -> Complex:
    """Unit vectors e^{j s angle} of shafts that have turned through an angle; designs share what they have in common.

    Of the same shafts and samples they are made once; nobody writes to them.

    Parameters
    ----------
    sense : (...) +1 counter-clockwise, -1 clockwise.
    angle_rad : (T,) rad, or (..., T) others for each shaft.

    Returns
    -------
    (..., T) complex, dimensionless.
    """
    vector = np.exp(1j * angle_rad)
    return np.where(sense[..., None] > 0.0, vector, np.conj(vector))


def angle_deg(vector: Complex) -> Real:
    """Angle of a vector in degrees, in [0, 360); 0 for the zero vector.

    Parameters
    ----------
    vector : (...) complex, any unit.
    """
    value = np.asarray(np.rad2deg(np.arctan2(vector.imag, vector.real)))
    if value.ndim == 1 and value.size <= _FEW:
        return np.array([_of_turn(*pair) for pair in zip(vector.tolist(), value.tolist(), strict=True)])
    value += 360.0 * (value < 0.0)
    # a hair below 0 comes to 360; the zero vector has parts of either sign
    none = value >= 360.0
    if np.count_nonzero(vector) < vector.size:
        none |= vector == 0.0
    return np.where(none, 0.0, value) if np.count_nonzero(none) else value


def _of_turn(vector: complex, degrees: float) -> float:
    """The same of one vector at an angle from -180 to 180."""
    angle = degrees + 360.0 if degrees < 0.0 else degrees + 0.0
    return angle if vector and angle < 360.0 else 0.0
