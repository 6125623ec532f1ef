"""Weights: on the guides of crossheads, which they may lift off, and on the main bearings."""

import numpy as np

from optimizer.numerics.arrays import Complex, Real

#: m/s^2, standard acceleration of free fall
GRAVITY = 9.80665


def on_guide(side: Real, axis: Complex, sense: Real, mass: Real, down: Complex) -> tuple[Real, Real]:
    """Force of the crossheads on their guides with their weight, and the weight alone, across the axis.

    In rod tension the rod draws the crosshead to the side of the crank pin: the side force N points along s j e^{jg}.
    Of the weight the part across the axis lies on the guide. Both are positive towards the lower guide. So a crosshead
    is off it where the sum is negative (lecture slides on compressors). There one of two opposed rows is lifted by its
    side force, falls at the dead centres, and knocks.

    Parameters
    ----------
    side : (..., rows, T) N, positive in rod tension.
    axis : (..., rows) direction of the cylinder axes.
    sense : (...) of rotation.
    mass : (..., rows) kg.
    down : (...) direction of gravity.

    Returns
    -------
    (..., rows, T) N and (..., rows) N; the latter 0 where the axis is upright, so that there is no lower guide.
    """
    across = 1j * axis
    part = (np.conj(across) * np.asarray(down)[..., None]).real
    # an upright row has none; 1e-12 of the weight is rounding
    weight = np.where(np.abs(part) > 1e-12, mass * GRAVITY * np.abs(part), 0.0)
    towards = np.where(part < 0.0, -1.0, 1.0) * np.asarray(sense)[..., None]
    return towards[..., None] * side + weight[..., None], weight


def along_axis(mass: Real, axis: Complex, down: Complex) -> Complex:
    """What a row's weight presses on its crank: the part along the axis, (..., rows) N; the guide bears the rest.

    The rod leans, but over the turn as much to one side as to the other, so that this is its mean.

    Parameters
    ----------
    mass : (..., rows) kg that reciprocates.
    axis : (..., rows) direction of the cylinder axes.
    down : (...) direction of gravity.
    """
    result: Complex = mass * GRAVITY * (np.conj(axis) * np.asarray(down)[..., None]).real * axis
    return result
