"""Taylor coefficients of closed forms, at points or bounded over intervals of the angle; compiled.

A function f of an angle has the coefficients f^(k)/k!, k = 0..n. At a point they are numbers. Over an interval each is
enclosed by a middle and a radius, so that the coefficient of order n + 1 bounds what a polynomial of degree n leaves
out. Sums, products and real powers are exact recurrences; the rounding of single operations is not enclosed.
Source: R. E. Moore, R. B. Kearfott, M. J. Cloud, Introduction to Interval Analysis, SIAM 2009, chapter 9.
"""

from typing import NamedTuple

import numpy as np

from optimizer.arrays import Real
from optimizer.compiling import inner


class Series(NamedTuple):
    """Some functions, each known by its number.

    middle : (functions, n + 1) the coefficients, or the middles of their enclosures.
    radius : (functions, n + 1) of their enclosures; at points without meaning.
    bounded : whether these are enclosures.
    """

    middle: Real
    radius: Real
    bounded: bool


@inner
def circular(series, multiple, cos, sin, cosine, sine):  # type: ignore[no-untyped-def]
    """cos and sin of a multiple of an angle, from what these are, or from the middle and radius of their ranges."""
    middle, radius, bounded = series
    (cos, cos_off), (sin, sin_off) = cos, sin
    factor = 1.0
    for k in range(middle.shape[1]):
        if k > 0:
            factor *= multiple / k
        middle[cosine, k], middle[sine, k] = factor * cos, factor * sin
        if bounded:
            radius[cosine, k], radius[sine, k] = factor * cos_off, factor * sin_off
        # cos' = -sin, sin' = cos
        cos, sin, cos_off, sin_off = -sin, cos, sin_off, cos_off


@inner
def cosine_range(angle, half):  # type: ignore[no-untyped-def]
    """Middle and radius of the range of the cosine over an interval: by its ends, and 1 and -1 where it has them."""
    first, last = np.cos(angle - half), np.cos(angle + half)
    high = 1.0 if _holds(angle, half) else max(first, last)
    low = -1.0 if _holds(angle - np.pi, half) else min(first, last)
    return 0.5 * (low + high), 0.5 * (high - low)


@inner
def _holds(angle, half):  # type: ignore[no-untyped-def]
    """Whether a whole turn is within a half width of an angle."""
    return abs((angle + np.pi) % (2.0 * np.pi) - np.pi) <= half


@inner
def constant(series, value, out):  # type: ignore[no-untyped-def]
    """A number."""
    for k in range(series.middle.shape[1]):
        series.middle[out, k], series.radius[out, k] = 0.0, 0.0
    series.middle[out, 0] = value


@inner
def scaled(series, a, factor, plus, out):  # type: ignore[no-untyped-def]
    """factor a + a number; a itself may be what comes out."""
    middle, radius, bounded = series
    for k in range(middle.shape[1]):
        middle[out, k] = factor * middle[a, k]
        if bounded:
            radius[out, k] = abs(factor) * radius[a, k]
    middle[out, 0] += plus


@inner
def summed(series, a, b, factor, out):  # type: ignore[no-untyped-def]
    """a + factor b; either may be what comes out."""
    middle, radius, bounded = series
    for k in range(middle.shape[1]):
        middle[out, k] = middle[a, k] + factor * middle[b, k]
        if bounded:
            radius[out, k] = radius[a, k] + abs(factor) * radius[b, k]


@inner
def product(series, a, b, out):  # type: ignore[no-untyped-def]
    """Cauchy product, (f g)_k = sum_i f_i g_{k-i}; neither may be what comes out."""
    middle, radius, bounded = series
    for k in range(middle.shape[1]):
        value = 0.0
        for i in range(k + 1):
            value += middle[a, i] * middle[b, k - i]
        middle[out, k] = value
        if bounded:
            off = 0.0
            for i in range(k + 1):
                off += abs(middle[a, i]) * radius[b, k - i]
                off += radius[a, i] * (abs(middle[b, k - i]) + radius[b, k - i])
            radius[out, k] = off


@inner
def power(series, a, exponent, out):  # type: ignore[no-untyped-def]
    """f^a for f > 0: k f_0 p_k = sum_{i=1..k} (a i - (k - i)) f_i p_{k-i}; f may not be what comes out."""
    middle, radius, bounded = series
    if not bounded:
        middle[out, 0], inverse, spread = _raised(middle[a, 0], exponent), 1.0 / middle[a, 0], 0.0
    else:
        low, high = middle[a, 0] - radius[a, 0], middle[a, 0] + radius[a, 0]
        first, last = _raised(low, exponent), _raised(high, exponent)
        middle[out, 0], radius[out, 0] = 0.5 * (first + last), 0.5 * abs(last - first)
        inverse, spread = 0.5 * (1.0 / low + 1.0 / high), 0.5 * (1.0 / low - 1.0 / high)
    for k in range(1, middle.shape[1]):
        value, error = 0.0, 0.0
        for i in range(1, k + 1):
            factor = exponent * i - (k - i)
            value += factor * middle[a, i] * middle[out, k - i]
            if bounded:
                off = radius[out, k - i]
                off = abs(middle[a, i]) * off + radius[a, i] * (abs(middle[out, k - i]) + off)
                error += abs(factor) * off
        middle[out, k] = value * inverse / k
        if bounded:
            radius[out, k] = (abs(value) * spread + error * (inverse + spread)) / k


@inner
def _raised(base, exponent):  # type: ignore[no-untyped-def]
    """base^exponent; halves by roots, which cost a tenth of a power."""
    if exponent == 0.5:
        return np.sqrt(base)
    if exponent == -0.5:
        return 1.0 / np.sqrt(base)
    if exponent == -1.0:
        return 1.0 / base
    if exponent == -1.5:
        return 1.0 / (base * np.sqrt(base))
    return base**exponent


@inner
def between(series, a, low, high):  # type: ignore[no-untyped-def]
    """Closer bounds of a function itself over the interval."""
    series.middle[a, 0], series.radius[a, 0] = 0.5 * (low + high), 0.5 * (high - low)
