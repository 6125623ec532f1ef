"""The balance rate: which share of the rotating unbalance of each throw its own webs balance.

A web belongs to the throw that it names or else to the nearest, and to those equally near in equal shares. Rate and
sideways part are the real and imaginary part of -e^{-jd} sum u / (m_rot r), d the angle of the crank: 1 is the
customary crank, 0 a bare one.
"""

import numpy as np

from optimizer.numerics.arrays import SMALLEST, Complex, Real, all_true

#: distances that differ by less than this share of the extent are equal
_TIE = 1e-9


def web_shares(throw: Real, web: Real, own: Real | None = None) -> Real:
    """Which share of each web belongs to each throw, (..., throws, webs).

    Parameters
    ----------
    throw, web : (..., throws) and (..., webs) places on z, m.
    own : (..., webs) numbers from 0 of the throws that webs name; nan is the nearest, None that of all.
    """
    distance = np.abs(throw[..., :, None] - web[..., None, :])
    least = np.minimum.reduce(distance, axis=-2, keepdims=True)
    extent = np.maximum.reduce(np.abs(throw), axis=-1)[..., None, None] + np.maximum.reduce(
        distance, axis=(-2, -1), keepdims=True, initial=0
    )
    near = distance <= least + _TIE * extent
    shares: Real = near / np.add.reduce(near, axis=-2, keepdims=True)
    if own is None:
        return shares
    own_shares = own[..., None, :] == np.arange(throw.shape[-1])[:, None]
    return np.where(np.isnan(own)[..., None, :], shares, own_shares)


def balance_rates(rotating: Complex, shares: Real, unbalance: Complex) -> Complex:
    """Balance rate (real part) and its sideways part (imaginary) of every throw, (..., throws); nan without unbalance.

    Parameters
    ----------
    rotating : (..., throws) rotating unbalance m r e^{jd} of the throws with the shares of their rods, kg m.
    shares : (..., throws, webs).
    unbalance : (..., webs) of the counterweights, kg m.
    """
    opposed = -np.add.reduce(shares * unbalance[..., None, :], axis=-1)
    there = np.abs(rotating) > SMALLEST
    if all_true(there):
        # as mostly
        return np.asarray(opposed / rotating)
    return np.where(there, opposed / np.where(there, rotating, 1.0), np.nan)


def customary(rotating: Complex, shares: Real) -> Complex:
    """Counterweights (..., webs) kg m that balance the rotating unbalance of every throw, alike on each of its webs."""
    sums = np.add.reduce(shares, axis=-1, keepdims=True)
    of_webs = shares / np.where(sums > 0.0, sums, 1.0)
    return -np.add.reduce(of_webs * rotating[..., None], axis=-2)
