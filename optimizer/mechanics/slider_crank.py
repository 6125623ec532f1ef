"""Harmonics of the slider-crank, exact for every rod ratio.

With the rod ratio lam = r/l and sin beta = lam sin phi, the pin that reciprocates is at
x = r (cos phi + sqrt(1 - lam^2 sin^2 phi) / lam) from the shaft, and the force on the frame is
-m x'' = m r omega^2 sum_k A_k cos(k phi).
"""

from functools import cache, lru_cache
from itertools import accumulate
from math import prod
from operator import mul

import numpy as np

from optimizer.numerics.arrays import Real

#: up to which square of q, that is for rods of more than 1.52 crank radii, these powers of it leave out less of the
#: hypergeometric function than rounding does
_NEAR, _POWERS = 0.02, np.arange(9.0)
#: rows of which the harmonics are kept
_FEW = 16


def acceleration_harmonic(order: int, rod_ratio: Real) -> Real:
    """Coefficient A_k of cos(k phi) in the acceleration over r omega^2.

    With k' = sqrt(1 - lam^2) and q = (1 - k') / (1 + k'),
    sqrt(1 - lam^2 sin^2 phi) = (1 + k')/2 |1 + q e^{2j phi}|, whose Fourier coefficients are
    hypergeometric functions of q^2: a closed form, no truncated series, good up to lam = 1.
    A_1 = 1; odd orders above are 0; A_2 = lam + lam^3/4 + 15 lam^5/128 + ...

    Parameters
    ----------
    order : k >= 1.
    rod_ratio : (...) lam, 0 <= lam <= 1; 0 is an infinite rod.

    Returns
    -------
    (...) dimensionless; nan where the rod ratio is nan.
    """
    lam = np.asarray(rod_ratio, dtype=float)
    if order == 1:
        return np.ones_like(lam)
    if order % 2:
        return np.zeros_like(lam)
    if lam.ndim == 1 and lam.size <= _FEW:
        return _of_machine(order, tuple(lam.tolist()))
    return _even_harmonic(order, lam)


# of machines that recur
@lru_cache(maxsize=256)
def _of_machine(order: int, rod_ratios: tuple[float, ...]) -> Real:
    """The same of the rows of one machine, of an even order; nobody writes to it."""
    harmonics = _even_harmonic(order, np.array(rod_ratios))
    harmonics.flags.writeable = False
    return harmonics


def _even_harmonic(order: int, lam: Real) -> Real:
    n = order // 2
    complement = np.sqrt((1.0 - lam) * (1.0 + lam))
    # q / lam, without the division that an infinite rod would not survive
    q_over_lam = lam / (1.0 + complement) ** 2
    q = lam * q_over_lam
    displacement = (1.0 + complement) * _half_binomial(n) * q_over_lam * q ** (n - 1) * _hypergeometric(n, q**2)
    return order**2 * displacement


def acceleration_harmonic_order_2(order: int, rod_ratio: Real) -> Real:
    """The same coefficient from the series cut off after the second order: 1, lam, 0, 0, ...

    Source: Qian and Qu eq (1), lecture slides on compressors.
    """
    lam = np.asarray(rod_ratio, dtype=float)
    if order == 1:
        return np.ones_like(lam)
    return lam.copy() if order == 2 else 0.0 * lam


def _hypergeometric(n: int, z: Real) -> Real:
    """2F1(n - 1/2, -1/2; n + 1; z) for 0 <= z <= 1: its first terms where those are all that doubles hold."""
    terms = np.power(z[..., None], _POWERS, order="C")
    terms *= _factors(n)
    value = np.add.reduce(terms, axis=-1, out=np.empty(z.shape))
    if np.count_nonzero(far := z > _NEAR):
        # takes as long to load as all that other rods need
        from scipy.special import hyp2f1

        value[far] = hyp2f1(n - 0.5, -0.5, n + 1.0, z[far])
    return value


@cache
def _factors(n: int) -> Real:
    """Those of the powers of z in it."""
    ratios = (((n - 0.5 + i) * (i - 0.5)) / ((n + 1.0 + i) * (i + 1.0)) for i in range(_POWERS.size - 1))
    return np.array(list(accumulate(ratios, mul, initial=1.0)))


@cache
def _half_binomial(n: int) -> float:
    """The binomial coefficient (1/2 over n)."""
    return prod((0.5 - i) / (i + 1.0) for i in range(n))
