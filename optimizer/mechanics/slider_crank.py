"""Harmonics of the slider-crank, exact for every rod ratio.

With the rod ratio lam = r/l and sin beta = lam sin phi, the pin that reciprocates is at
x = r (cos phi + sqrt(1 - lam^2 sin^2 phi) / lam) from the shaft, and the force on the frame is
-m x'' = m r omega^2 sum_k A_k cos(k phi).
"""

from functools import cache

import numpy as np

from optimizer.arrays import Real


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
    # takes as long to load as all that the first order needs
    from scipy.special import hyp2f1

    n = order // 2
    complement = np.sqrt((1.0 - lam) * (1.0 + lam))
    # q / lam, without the division that an infinite rod would not survive
    q_over_lam = lam / (1.0 + complement) ** 2
    q = lam * q_over_lam
    series = hyp2f1(n - 0.5, -0.5, n + 1.0, q**2)
    displacement = (1.0 + complement) * _half_binomial(n) * q_over_lam * q ** (n - 1) * series
    return order**2 * displacement


def acceleration_harmonic_order_2(order: int, rod_ratio: Real) -> Real:
    """The same coefficient from the series cut off after the second order: 1, lam, 0, 0, ...

    Source: Qian and Qu eq (1), lecture slides on compressors.
    """
    lam = np.asarray(rod_ratio, dtype=float)
    if order == 1:
        return np.ones_like(lam)
    return lam.copy() if order == 2 else 0.0 * lam


@cache
def _half_binomial(n: int) -> float:
    from scipy.special import binom

    return float(binom(0.5, n))
