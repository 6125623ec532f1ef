"""Directions from angles in degrees, exact where they can be."""

import numpy as np
from numpy.typing import NDArray

from optimizer.arrays import Complex, Real

_QUADRANTS = np.array([1, 1j, -1, -1j])


def direction(angle_deg: Real) -> Complex:
    """Unit vector e^{j angle} for angles in degrees.

    The angle is first reduced to an eighth of a turn, in degrees, where the reduction is exact. So
    angles 90, 120 or 180 degrees apart give unit vectors whose sum is exactly zero, and a machine
    that balances itself does so in the numbers as well.

    Parameters
    ----------
    angle_deg : (...) degrees.

    Returns
    -------
    (...) complex, dimensionless.
    """
    turn = np.mod(np.asarray(angle_deg, dtype=float), 360.0)
    quadrant = np.floor(turn / 90.0)
    rest = turn - 90.0 * quadrant
    cosine, sine = _cosine(np.array([rest, 90.0 - rest]))
    return (cosine + 1j * sine) * _QUADRANTS[quadrant.astype(int) % 4]


def turned(sense: Real, angle_rad: Real) -> Complex:
    """Unit vectors e^{j s angle} of shafts that have turned through an angle; designs share what they have in common.

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


def _cosine(angle_deg: NDArray[np.float64]) -> NDArray[np.float64]:
    """Cosine on [0, 90] degrees; cos 60 = 1/2 and cos 90 = 0 exactly."""
    small = np.cos(np.deg2rad(angle_deg))
    large = np.sin(np.deg2rad(90.0 - angle_deg))
    value: Real = np.where(angle_deg <= 45.0, small, large)
    value[angle_deg == 60.0] = 0.5
    return value


def angle_deg(vector: Complex) -> Real:
    """Angle of a vector in degrees, in [0, 360); 0 for the zero vector.

    Parameters
    ----------
    vector : (...) complex, any unit.
    """
    value = np.rad2deg(np.angle(vector))
    value = np.where(value < 0.0, value + 360.0, value)
    return np.where((value >= 360.0) | (vector == 0), 0.0, value)
