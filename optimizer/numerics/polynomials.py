"""Polynomials of one variable on [-1, 1]: their squares, their Bernstein coefficients, and parts of the interval."""

from functools import cache
from math import comb

import numpy as np
from numpy.typing import NDArray

from optimizer.numerics.arrays import Complex, Real


def squared(polynomial: Complex) -> Real:
    """|p|^2 of polynomials (..., k) of a real variable: (..., 2 k - 1)."""
    count = polynomial.shape[-1]
    square = np.zeros((*polynomial.shape[:-1], 2 * count - 1))
    for i in range(count):
        square[..., i : i + count] += (polynomial[..., i : i + 1] * np.conj(polynomial)).real
    return square


def bernstein(polynomial: Real) -> Real:
    """Bernstein coefficients on [-1, 1] of polynomials (n, k)."""
    return polynomial @ to_bernstein(polynomial.shape[-1] - 1)


@cache
def to_bernstein(degree: int) -> Real:
    """From coefficients to those of Bernstein on [-1, 1], of which the first and last are the values at the ends,
    (degree + 1, degree + 1): x^k = (2 t - 1)^k, and t^i = sum_j C(j, i) / C(degree, i) B_j(t)."""
    in_t = [[comb(k, i) * 2.0**i * (-1.0) ** (k - i) for i in range(degree + 1)] for k in range(degree + 1)]
    raised = [[comb(j, i) / comb(degree, i) for j in range(degree + 1)] for i in range(degree + 1)]
    return np.array(in_t) @ np.array(raised)


@cache
def shifts(parts: int) -> tuple[Real, NDArray[np.float64]]:
    """Centres (parts,) of equal parts of [-1, 1], and what takes a cubic to each of them (parts, 4, 4)."""
    places = (2.0 * np.arange(parts) + 1.0) / parts - 1.0
    matrix = [
        [[comb(k, i) * place ** (k - i) * parts**-i if i <= k else 0.0 for i in range(4)] for k in range(4)]
        for place in places.tolist()
    ]
    return places, np.array(matrix)
