"""Taylor coefficients of closed forms, at points or bounded over intervals of the angle.

A function f of an angle has the coefficients f^(k)/k!, k = 0..n, on the first axis. At a point they are numbers. Over
an interval each is enclosed by a middle and a radius, so that the coefficient of order n + 1 bounds what a polynomial
of degree n leaves out. Sums, products and real powers are exact recurrences; the rounding of single operations is not
enclosed.
Source: R. E. Moore, R. B. Kearfott, M. J. Cloud, Introduction to Interval Analysis, SIAM 2009, chapter 9.
"""

from dataclasses import dataclass
from math import factorial

import numpy as np
from numpy.typing import NDArray

from optimizer.arrays import Real


@dataclass(frozen=True)
class Taylor:
    """Coefficients of functions, (n + 1, ...).

    middle : the coefficients, or the middles of their enclosures; complex for vectors across the shaft.
    radius : of their enclosures; None at points.
    """

    middle: Real
    radius: Real | None = None

    def __add__(self, other: "Taylor") -> "Taylor":
        return Taylor(self.middle + other.middle, _added(self.radius, other.radius))

    def __sub__(self, other: "Taylor") -> "Taylor":
        return Taylor(self.middle - other.middle, _added(self.radius, other.radius))

    def times(self, factor: Real | float) -> "Taylor":
        """Times constants (...)."""
        return Taylor(self.middle * factor, None if self.radius is None else self.radius * np.abs(factor))

    def plus(self, constant: Real | float) -> "Taylor":
        """With constants (...) added."""
        shape = np.broadcast_shapes(self.middle.shape[1:], np.shape(constant))
        middle = np.array(np.broadcast_to(self.middle, (len(self.middle), *shape)))
        middle[0] += constant
        return Taylor(middle, self.radius)

    def between(self, low: Real, high: Real) -> "Taylor":
        """With closer bounds of the function itself over the intervals; at points as it is."""
        if self.radius is None:
            return self
        middle, radius = self.middle.copy(), self.radius.copy()
        middle[0], radius[0] = 0.5 * (low + high), 0.5 * (high - low)
        return Taylor(middle, radius)

    def __mul__(self, other: "Taylor") -> "Taylor":
        """Cauchy product, (f g)_k = sum_i f_i g_{k-i}."""
        count = len(self.middle)
        shape = np.broadcast_shapes(self.middle.shape, other.middle.shape)
        middle = np.zeros(shape, dtype=np.result_type(self.middle, other.middle))
        if self.radius is None or other.radius is None:
            for i in range(count):
                middle[i:] += self.middle[i] * other.middle[: count - i]
            return Taylor(middle)
        radius = np.zeros(shape)
        size, other_size = np.abs(self.middle), np.abs(other.middle) + other.radius
        for i in range(count):
            middle[i:] += self.middle[i] * other.middle[: count - i]
            radius[i:] += size[i] * other.radius[: count - i] + self.radius[i] * other_size[: count - i]
        return Taylor(middle, radius)

    def power(self, exponent: Real | float) -> "Taylor":
        """f^a for f > 0 and constants a (...): k f_0 p_k = sum_{i=1..k} (a i - (k - i)) f_i p_{k-i}."""
        shape = np.broadcast_shapes(self.middle.shape[1:], np.shape(exponent))
        middle = np.empty((len(self.middle), *shape))
        axes = (1,) * len(shape)
        if self.radius is None:
            middle[0] = _raised(self.middle[0], exponent)
            for k in range(1, len(middle)):
                terms = _factors(exponent, k, axes) * self.middle[1 : k + 1] * middle[k - 1 :: -1]
                middle[k] = np.sum(terms, axis=0) / (k * self.middle[0])
            return Taylor(middle)
        radius = np.empty_like(middle)
        low, high = self.middle[0] - self.radius[0], self.middle[0] + self.radius[0]
        ends = _raised(low, exponent), _raised(high, exponent)
        middle[0], radius[0] = 0.5 * (ends[0] + ends[1]), 0.5 * np.abs(ends[1] - ends[0])
        inverse, spread = 0.5 * (1.0 / low + 1.0 / high), 0.5 * (1.0 / low - 1.0 / high)
        size = np.abs(self.middle)
        for k in range(1, len(middle)):
            some, off, factors = slice(1, k + 1), radius[k - 1 :: -1], _factors(exponent, k, axes)
            value = np.sum(factors * self.middle[some] * middle[k - 1 :: -1], axis=0)
            error = size[some] * off + self.radius[some] * (np.abs(middle[k - 1 :: -1]) + off)
            error = np.sum(np.abs(factors) * error, axis=0)
            middle[k] = value * inverse / k
            radius[k] = (np.abs(value) * spread + error * (inverse + spread)) / k
        return Taylor(middle, radius)


def _factors(exponent: Real | float, k: int, axes: tuple[int, ...]) -> Real:
    """a i - (k - i) for i = 1..k on the first axis, before some axes of length 1 that are those of a."""
    i = np.arange(1.0, k + 1.0).reshape(-1, *axes)
    factors: Real = exponent * i - (k - i)
    return factors


def _raised(base: Real, exponent: Real | float) -> Real:
    """base^exponent; halves by roots, which cost a tenth of a power."""
    if isinstance(exponent, float) and exponent in (-1.5, -0.5):
        root = np.sqrt(base)
        return 1.0 / (root if exponent == -0.5 else base * root)
    return base**exponent


def cosine(multiple: int, angle: Real, half: Real | None, order: int) -> Taylor:
    """Coefficients of cos(multiple angle) at angles (...), or over intervals of half widths (...), rad."""
    return _circular(multiple, angle, half, order, 0)


def sine(multiple: int, angle: Real, half: Real | None, order: int) -> Taylor:
    """Coefficients of sin(multiple angle), likewise."""
    return _circular(multiple, angle, half, order, 1)


def _circular(multiple: int, angle: Real, half: Real | None, order: int, first: int) -> Taylor:
    # sin' = cos, cos' = -sin: the derivatives are these four in turn, sine after cosine three times on
    turned = multiple * angle
    if half is None and order == 0:
        return Taylor((np.sin if first else np.cos)(turned)[None])
    size = [multiple**k / factorial(k) for k in range(order + 1)]
    turns = [(k - first) % 4 for k in range(order + 1)]
    if half is None:
        cos, sin = np.cos(turned), np.sin(turned)
        cycle = (cos, -sin, -cos, sin)
        return Taylor(np.stack([s * cycle[k] for s, k in zip(size, turns, strict=True)]))
    cos_middle, cos_radius = _cosine_range(turned, multiple * half)
    sin_middle, sin_radius = _cosine_range(turned - 0.5 * np.pi, multiple * half)
    cycle, radii = (cos_middle, -sin_middle, -cos_middle, sin_middle), (cos_radius, sin_radius)
    return Taylor(
        np.stack([s * cycle[k] for s, k in zip(size, turns, strict=True)]),
        np.stack([s * radii[k % 2] for s, k in zip(size, turns, strict=True)]),
    )


def _cosine_range(angle: Real, half: Real) -> tuple[Real, Real]:
    """Middle and radius of the range of the cosine over intervals: by its ends, and 1 and -1 where it has them."""
    ends = np.cos(angle - half), np.cos(angle + half)

    def holds(at: float) -> NDArray[np.bool_]:
        return np.abs(np.mod(angle - at + np.pi, 2.0 * np.pi) - np.pi) <= half

    high = np.where(holds(0.0), 1.0, np.maximum(*ends))
    low = np.where(holds(np.pi), -1.0, np.minimum(*ends))
    return 0.5 * (low + high), 0.5 * (high - low)


def _added(first: Real | None, second: Real | None) -> Real | None:
    return None if first is None or second is None else first + second
