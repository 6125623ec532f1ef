"""Periodic curves by their harmonics, and the largest length of a curve, enclosed for every angle.

A curve is R(t) = sum of c_k e^{jkt}, a vector across the shaft.

1. Rods. The acceleration of a piston is an analytic function of the crank angle; so are the forces that follow it. With
   a bound M in the strip |Im t| <= a its harmonics are no larger than M e^{-a|k|}. The trapezoidal rule at N angles is
   then off by 2 M e^{-aN/2} / (1 - e^{-a}) at most (Trefethen, Weideman 2014). N makes that 1e-15 of M.
2. Peaks. A frame that turns m times with the shaft changes no length. There R'' is at most B = sum (k - m)^2 |c_k|.
   Between two angles h apart a vector leaves its chord by at most B h^2 / 8. So |R| is at most the larger end and that.
   Intervals are halved until no angle can exceed the largest value by more than 1e-10 of it.

All in doubles, to 1e-9 of the sum of the |c_k|.
"""

from __future__ import annotations

import cmath
from functools import lru_cache
from math import acosh, ceil, cos, cosh, exp, log, log2, pi, sin, sqrt
from typing import Dict, List, NamedTuple, Optional, Sequence, Tuple

CLOSE = 1e-10  # share of a peak by which its enclosure is wide
LEFT_OUT = 1e-15  # share of a force by which its harmonics are off
SMALLEST = 1e-13  # share of the largest harmonic: beyond the last one of that size there are none here
MOST = 40_000  # angles at which a curve is evaluated for a peak
STEEPEST = 0.9  # crank radius over rod length: beyond it there are too many harmonics

Harmonics = Dict[int, complex]


class Peak(NamedTuple):
    """The largest length of a curve is between these; the lower one is its length at an angle [rad]."""

    low: float
    high: float
    angle: float


class Curve:
    """A curve by its harmonics; ``scalar``: its real part alone counts."""

    def __init__(self, harmonics: Harmonics, scalar: bool = False) -> None:
        self.harmonics, self.scalar = harmonics, scalar
        if scalar:
            # Re R = (R + conj R) / 2
            orders = {*harmonics, *(-k for k in harmonics)}
            means = {k: (harmonics.get(k, 0j) + harmonics.get(-k, 0j).conjugate()) / 2 for k in orders}
            self.harmonics = means
        orders_there = sorted(self.harmonics)
        self.first = orders_there[0] if orders_there else 0
        last = orders_there[-1] if orders_there else 0
        # from the highest order down, for Horner's rule
        self.descending = [self.harmonics.get(k, 0j) for k in range(last, self.first - 1, -1)]

    def at(self, angle: float) -> complex:
        """The vector at an angle [rad]."""
        unit, value = cmath.exp(1j * angle), 0j
        for phasor in self.descending:
            value = value * unit + phasor
        return value * unit**self.first

    def sides(self, angle: float) -> List[complex]:
        """The same of a curve that may jump."""
        return [self.at(angle)]

    def length(self, angle: float) -> float:
        """Its length there."""
        unit, value = complex(cos(angle), sin(angle)), 0j
        for phasor in self.descending:
            value = value * unit + phasor
        return abs(value)

    @property
    def size(self) -> float:
        """Sum of the lengths of the harmonics, which no angle exceeds."""
        return sum(map(abs, self.harmonics.values()))

    @property
    def rms(self) -> float:
        """Root of the mean square (Parseval)."""
        return sqrt(sum(abs(phasor) ** 2 for phasor in self.harmonics.values()))

    @property
    def mean(self) -> complex:
        """Over a revolution."""
        return self.harmonics.get(0, 0j)

    def plus(self, by: complex, order: int = 0) -> Curve:
        """The curve with a vector that turns ``order`` times."""
        return Curve({**self.harmonics, order: self.harmonics.get(order, 0j) + by}, self.scalar)

    def along(self, axis: str) -> Curve:
        """The component of a curve that is seen from the shaft along an axis of the frame, x or y."""
        factor = 1 if axis == "x" else -1j
        return Curve({k + 1: factor * phasor for k, phasor in self.harmonics.items()}, scalar=True)

    def peak(self, enough: float = 0.0) -> Optional[Peak]:
        """The largest length; of no interest up to ``enough``. None where it takes too many angles."""
        lengths = {k: abs(amplitude) for k, amplitude in self.harmonics.items() if amplitude}
        size = sum(lengths.values())
        if size == 0:
            return Peak(0.0, 0.0, 0.0)
        middle = sum(k * amplitude for k, amplitude in lengths.items()) / size
        bend = sum((k - middle) ** 2 * amplitude for k, amplitude in lengths.items()) / 8
        count = 2 * len(self.descending) + 16
        step = 2 * pi / count
        ends = [self.length(step * n) for n in range(count)]
        low = max(ends)
        best, high, visits = step * ends.index(low), 0.0, count
        parts = [(step * n, ends[n], ends[(n + 1) % count]) for n in range(count)]
        while parts:
            finer: List[Tuple[float, float, float]] = []
            most = max(low, enough) * (1 + CLOSE) + 1e-14 * size
            for start, first, last in parts:
                bound = (first if first > last else last) + bend * step * step
                if bound <= most:
                    high = bound if bound > high else high
                    continue
                there = start + step / 2
                value = self.length(there)
                if value > low:
                    low, best = value, there
                finer += [(start, first, value), (there, value, last)]
            parts, step = finer, step / 2
            visits += len(finer)
            if visits > MOST:
                return None
        return Peak(low, max(high, low), best)


def total(curves: Sequence[Tuple[float, Harmonics]]) -> Curve:
    """The sum of curves, each times a factor."""
    sums: Harmonics = {}
    for factor, harmonics in curves:
        if factor:
            for k, phasor in harmonics.items():
                sums[k] = sums.get(k, 0j) + factor * phasor
    return Curve(sums)


@lru_cache(maxsize=256)
def rod(ratio: float) -> Optional[Dict[int, float]]:
    """Harmonics of a(t) (1 - j tan b) of a crank radius over a rod length; real, like those of a(t) by themselves.

    a(t) is the acceleration of the piston over r omega^2, b the angle of the rod, sin b = ratio sin t. Their product
    with the mass is what a piston puts on its crank. None where the rod is hardly longer than the crank.
    """
    if not 0 <= ratio <= STEEPEST:
        return None
    if ratio < SMALLEST:
        return {-1: 0.5, 1: 0.5}
    strip = acosh(1 / ratio) / 2
    wide = cosh(strip)
    upright = 1 - (ratio * wide) ** 2
    bound = (wide + 2 * ratio * wide**2 / sqrt(upright) + (ratio * wide) ** 3 * wide / upright**1.5) * (
        1 + ratio * wide / sqrt(upright)
    )
    count = 2 ** ceil(log2(2 / strip * log(4 * bound / LEFT_OUT / (1 - exp(-strip)))))
    values = []
    for n in range(count):
        cosine, sine = cos(2 * pi * n / count), sin(2 * pi * n / count)
        root = sqrt(1 - (ratio * sine) ** 2)
        outward = cosine + ratio * (cosine**2 - sine**2) / root + ratio**3 * (cosine * sine) ** 2 / root**3
        values.append(outward * complex(1, -ratio * sine / root))
    # even and odd parts: all harmonics are real
    terms = [value.real / count for value in transform(values)]
    last = max(k for k in range(count // 2) if max(abs(terms[k]), abs(terms[-k])) > SMALLEST * max(map(abs, terms)))
    return {k: terms[k % count] for k in range(-last, last + 1)}


def transform(values: Sequence[complex]) -> List[complex]:
    """Sums of values times e^{-2 pi j k n / N}, N a power of two (Cooley, Tukey 1965)."""
    count = len(values)
    if count == 1:
        return list(values)
    even, odd = transform(values[::2]), transform(values[1::2])
    odd = [cmath.exp(-2j * pi * k / count) * value for k, value in enumerate(odd)]
    return [a + b for a, b in zip(even, odd)] + [a - b for a, b in zip(even, odd)]
