"""Taylor coefficients of closed forms, at points or bounded over intervals of the angle; compiled.

A function f of an angle has the coefficients f^(k)/k!, k = 0..n. At a point they are numbers. Over an interval each is
enclosed by a middle and a radius, so that the coefficient of order n + 1 bounds what a polynomial of degree n leaves
out. Sums, products and real powers are exact recurrences; the rounding of single operations is not enclosed.
Source: R. E. Moore, R. B. Kearfott, M. J. Cloud, Introduction to Interval Analysis, SIAM 2009, chapter 9.

Many places stand side by side, in lanes: the innermost loops are over lanes, which the processor takes several at a
time, and no lane knows of another. All lanes are taken, whether there are places in them or not: of a number that the
compiler knows it leaves no rest to be taken one by one.
"""

from typing import NamedTuple

import numpy as np

from optimizer.numerics.arrays import Real
from optimizer.numerics.compiling import inner

#: places side by side: their data fit the cache
LANES = 32
#: the first coefficient, for all of them
ALL = np.int64(0)


class Series(NamedTuple):
    """Some functions, each with a number.

    middle : (functions, n + 1, LANES) the coefficients, or the middles of their enclosures. Where powers are made the
        last of them is none, but room.
    radius : (functions, n + 1, LANES) of their enclosures; at points without meaning.
    bounded : whether these are enclosures.
    """

    middle: Real
    radius: Real
    bounded: bool


@inner
def copied(values, out):  # type: ignore[no-untyped-def]
    """Values into others; of a number that the compiler does not know, or it writes a copy of each lane by itself."""
    for p in range(out.size):
        out[p] = values[p]


@inner
def any_of(marked, first, lanes):  # type: ignore[no-untyped-def]
    """Whether any of so many places is marked (Q,)."""
    result = False
    for p in range(first, first + lanes):
        result = result or marked[p]
    return result


@inner
def circular(series, multiple, values, cosine, sine):  # type: ignore[no-untyped-def]
    """cos and sin of a multiple of an angle, from what these are, or from the middles and radii of their ranges:
    values (4, LANES), cos, sin, radius of cos, radius of sin."""
    middle, radius, bounded = series
    factor = 1.0
    for k in range(middle.shape[1]):
        if k > 0:
            factor *= multiple / k
        # cos' = -sin, sin' = cos
        odd = k % 2
        of_cos, of_sin = values[odd], values[1 - odd]
        up, along = -factor if k % 4 in (1, 2) else factor, -factor if k % 4 in (2, 3) else factor
        cos, sin = middle[cosine, k], middle[sine, k]
        for p in range(LANES):
            cos[p] = up * of_cos[p]
            sin[p] = along * of_sin[p]
        if bounded:
            of_cos, of_sin, cos, sin = values[2 + odd], values[3 - odd], radius[cosine, k], radius[sine, k]
            for p in range(LANES):
                cos[p] = factor * of_cos[p]
                sin[p] = factor * of_sin[p]


@inner
def constant(series, value, out):  # type: ignore[no-untyped-def]
    """The same all the way: values (LANES,)."""
    middle, radius, _ = series
    for k in range(middle.shape[1]):
        result, off = middle[out, k], radius[out, k]
        for p in range(LANES):
            result[p] = value[p] if k == 0 else 0.0
            off[p] = 0.0


@inner
def scaled(series, a, factor, plus, out):  # type: ignore[no-untyped-def]
    """factor a + a number, (LANES,) each; a itself may be what comes out."""
    middle, radius, bounded = series
    for k in range(middle.shape[1]):
        source, result = middle[a, k], middle[out, k]
        for p in range(LANES):
            result[p] = factor[p] * source[p]
        if bounded:
            source, result = radius[a, k], radius[out, k]
            for p in range(LANES):
                result[p] = abs(factor[p]) * source[p]
    result = middle[out, 0]
    for p in range(LANES):
        result[p] += plus[p]


@inner
def summed(series, a, b, factor, out):  # type: ignore[no-untyped-def]
    """a + factor b, factors (LANES,); either may be what comes out."""
    middle, radius, bounded = series
    for k in range(middle.shape[1]):
        addend, second, result = middle[a, k], middle[b, k], middle[out, k]
        for p in range(LANES):
            result[p] = addend[p] + factor[p] * second[p]
        if bounded:
            addend, second, result = radius[a, k], radius[b, k], radius[out, k]
            for p in range(LANES):
                result[p] = addend[p] + abs(factor[p]) * second[p]


@inner
def product(series, a, b, out, first):  # type: ignore[no-untyped-def]
    """a b, from coefficient ``first`` on; neither may be ``out``."""
    middle, radius, bounded = series
    multiplied((middle[a], radius[a]), (middle[b], radius[b]), (middle[out], radius[out]), bounded, first)


@inner
def multiplied(left, right, outcome, bounded, first):  # type: ignore[no-untyped-def]
    """Cauchy product, (f g)_k = sum_i f_i g_{k-i}, of functions, each of middles and radii (n + 1, LANES)."""
    (f, f_off), (g, g_off), (out, out_off) = left, right, outcome
    # by rising places of all three: to places that fall the compiler has loops that take lanes one by one
    for i in range(out.shape[0]):
        factor, factor_off = f[i], f_off[i]
        for k in range(max(i, first), out.shape[0]):
            second, result = g[k - i], out[k]
            if i == 0:
                for p in range(LANES):
                    result[p] = factor[p] * second[p]
            else:
                for p in range(LANES):
                    result[p] += factor[p] * second[p]
            if bounded:
                second_off, off = g_off[k - i], out_off[k]
                if i == 0:
                    for p in range(LANES):
                        off[p] = abs(factor[p]) * second_off[p] + factor_off[p] * (abs(second[p]) + second_off[p])
                else:
                    for p in range(LANES):
                        off[p] += abs(factor[p]) * second_off[p] + factor_off[p] * (abs(second[p]) + second_off[p])


@inner
def power(series, a, exponent, out, lanes):  # type: ignore[no-untyped-def]
    """f^a for f > 0, exponents (LANES,): k f_0 p_k = sum_{i=1..k} (a i - (k - i)) f_i p_{k-i}; f may not be what comes
    out."""
    middle, radius, bounded = series
    first, of_first, base, spread = middle[out, 0], radius[out, 0], middle[a, 0], radius[a, 0]
    if not bounded:
        _raise(base, exponent, first, lanes)
    else:
        low, high = middle[middle.shape[0] - 1, 0], radius[middle.shape[0] - 1, 0]
        for p in range(LANES):
            low[p], high[p] = base[p] - spread[p], base[p] + spread[p]
        _raise(low, exponent, first, lanes)
        _raise(high, exponent, of_first, lanes)
        for p in range(LANES):
            least, most = first[p], of_first[p]
            first[p], of_first[p] = 0.5 * (least + most), 0.5 * abs(most - least)
        # of 1 / f_0
        inverse, wide = low, high
        for p in range(LANES):
            least, most = 1.0 / low[p], 1.0 / high[p]
            inverse[p], wide[p] = 0.5 * (least + most), 0.5 * (least - most)
    for k in range(1, middle.shape[1]):
        result, off = middle[out, k], radius[out, k]
        for p in range(LANES):
            result[p] = 0.0
        if bounded:
            for p in range(LANES):
                off[p] = 0.0
        for i in range(1, k + 1):
            factor, second = middle[a, i], middle[out, k - i]
            for p in range(LANES):
                result[p] += (exponent[p] * i - (k - i)) * factor[p] * second[p]
            if bounded:
                # in a loop of its own: of as many arrays as both have together none would be taken several at a time
                factor_off, second_off = radius[a, i], radius[out, k - i]
                for p in range(LANES):
                    share = abs(factor[p]) * second_off[p] + factor_off[p] * (abs(second[p]) + second_off[p])
                    off[p] += abs(exponent[p] * i - (k - i)) * share
        if bounded:
            inverse, wide = middle[middle.shape[0] - 1, 0], radius[middle.shape[0] - 1, 0]
            for p in range(LANES):
                off[p] = (abs(result[p]) * wide[p] + off[p] * (inverse[p] + wide[p])) / k
                result[p] = result[p] * inverse[p] / k
        else:
            for p in range(LANES):
                result[p] = result[p] / base[p] / k


@inner
def _raise(base, exponent, out, lanes):  # type: ignore[no-untyped-def]
    """Write base^exponent; halves by roots, which cost a tenth of a power, and of all lanes at once where they can."""
    common = exponent[0]
    for p in range(LANES):
        if exponent[p] != exponent[0]:
            common = 0.0
    if common == 0.5:
        for p in range(LANES):
            out[p] = np.sqrt(base[p])
    elif common == -0.5:
        for p in range(LANES):
            out[p] = 1.0 / np.sqrt(base[p])
    elif common == -1.0:
        for p in range(LANES):
            out[p] = 1.0 / base[p]
    elif common == -1.5:
        for p in range(LANES):
            out[p] = 1.0 / (base[p] * np.sqrt(base[p]))
    else:
        for p in range(lanes):
            out[p] = _raised(base[p], exponent[p])


@inner
def _raised(base, exponent):  # type: ignore[no-untyped-def]
    """base^exponent."""
    if exponent == 0.0:
        return 1.0
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
    """Closer bounds (LANES,) of a function itself over the interval."""
    middle, radius = series.middle[a, 0], series.radius[a, 0]
    for p in range(LANES):
        middle[p], radius[p] = 0.5 * (low[p] + high[p]), 0.5 * (high[p] - low[p])
