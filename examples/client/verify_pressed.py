"""Curves of what gas, friction and inertia put on shaft and frame: their largest values, enclosed for every angle.

A curve is R(t) = sum of w F(t) g(t) over the rows, and what counterweights add: a weight, the force on a piston, and
what the motion makes of it. Between two angles h apart without a kink a curve leaves its chord by at most h^2/8 times
the largest second derivative, which is at most the sum of |w| (|F''| |g| + 2 |F'| |g'| + |F| |g''|):

* g has harmonics, and so has the inertia; a frame that turns m times with the shaft makes their orders k - m;
* pressures have the slopes of their processes, at the end of the interval where they are steepest.

Intervals are halved until no angle can exceed the largest value by more than 1e-10 of it.
"""

from __future__ import annotations

from cmath import exp
from functools import cached_property, lru_cache
from math import cos, hypot, inf, pi, sin, sqrt
from typing import Callable, Dict, List, NamedTuple, Optional, Sequence, Tuple

from verify_gas import Motion, motion
from verify_harmonics import CLOSE, MOST, Harmonics, Peak, transform
from verify_pistons import BESIDE, DEEPEST, NODES, Instant, Pistons
from verify_pistons import CLOSE as ROUGH

FINEST = 4096  # angles at which harmonics are found

#: what the motion makes of a force on the piston; of the shaft across it, as the shaft sees it
READINGS: Dict[str, Callable[[Motion], float]] = {
    "piston": lambda piston: 1.0,
    "rod": lambda piston: 1 / piston.leaning,
    "side": lambda piston: piston.tangent,
    "tangential": lambda piston: piston.turning,
    "radial": lambda piston: piston.radial,
    "shaft": lambda piston: piston.tangent,
}
NARROWEST = 1e-10  # rad, of what may be on either side of a level
LEFT_OUT = 1e-12  # share of all that is added up to which a largest value is enclosed


class Acting(NamedTuple):
    """Which forces on the piston count."""

    gas: bool = True
    friction: bool = True
    inertia: bool = True

    def of(self, instant: Instant) -> float:
        """Their sum."""
        return self.gas * instant.gas + self.friction * instant.friction + self.inertia * instant.inertia


ALL = Acting()


class Mean(NamedTuple):
    """Of a curve over the revolutions: its mean, and the mean square of what moves around it."""

    value: complex
    square: float


class _Part(NamedTuple):
    """A part of a piece, and the heights of a curve at its ends."""

    start: float
    end: float
    within: float
    first: float = 0.0
    last: float = 0.0

    @property
    def ends(self) -> Tuple[Tuple[float, float], Tuple[float, float]]:
        return (self.start, self.first), (self.end, self.last)


class PressureCurve:
    """Sums of a force of rows, by their numbers, times weights, and of what turns k times with the shaft."""

    def __init__(
        self,
        pistons: Pistons,
        reading: str,
        weights: Sequence[Tuple[int, complex]],
        turning: Optional[Harmonics] = None,
        acting: Acting = ALL,
    ) -> None:
        self.pistons, self.reading, self.weights, self.acting = pistons, reading, list(weights), acting
        self.scalar, self.beside = reading != "shaft", dict(turning or {})
        self._rows: Optional[Mean] = None

    def plus(self, by: complex, order: int = 0) -> PressureCurve:
        """The curve with a vector that turns ``order`` times."""
        turning = {**self.beside, order: self.beside.get(order, 0j) + by}
        curve = PressureCurve(self.pistons, self.reading, self.weights, turning, self.acting)
        curve._rows = self._rows
        return curve

    def value(self, shaft: float, within: Optional[float] = None) -> complex:
        """At a shaft angle [rad]."""
        vector, reads, sense = 0j, READINGS[self.reading], self.pistons.sense
        for k, weight in self.weights:
            instant = self.pistons.at(k, shaft, within)
            factor = reads(instant.piston)
            vector += weight * self.acting.of(instant) * (factor if self.scalar else complex(1, -sense * factor))
        if not self.scalar:
            vector *= complex(cos(shaft), -sense * sin(shaft))
        for order, phasor in self.beside.items():
            vector += phasor * (exp(1j * order * sense * shaft) if order else 1)
        return complex(vector.real) if self.scalar else vector

    def at(self, angle: float) -> complex:
        """At an angle of the harmonics [rad], the negative of the shaft's where that turns clockwise."""
        return self.value(self.pistons.sense * angle)

    def sides(self, angle: float) -> List[complex]:
        """At an angle of the harmonics, on both sides of a kink that may be there."""
        shaft = self.pistons.sense * angle
        return [self.value(shaft, shaft + side) for side in (-BESIDE, BESIDE)]

    def length(self, angle: float) -> float:
        """The largest length at an angle of the harmonics."""
        return max(map(abs, self.sides(angle)))

    @cached_property
    def size(self) -> float:
        """What no angle exceeds."""
        bound = sum(map(abs, self.beside.values()))
        for k, weight in self.weights:
            row = self.pistons.rows[k]
            force = self.acting.gas * row.most + self.acting.friction * row.friction
            force += self.acting.inertia * row.moving[0]
            bound += abs(weight) * force * _sizes(self.reading, row.ratio, 0.0)[0]
        return bound

    def _middle(self) -> float:
        """How often the frame turns in which the curve bends little."""
        if self.scalar:
            return 0.0
        still, every = abs(self.beside.get(0, 0j)), self.size
        return -(every - still) / every if every else 0.0

    def peak(self, enough: float = 0.0, sign: int = 0) -> Optional[Peak]:
        """The largest length, or the largest value of a scalar times a sign; None where it takes too many angles."""
        size = self.size
        if size == 0:
            return Peak(0.0, 0.0, 0.0)
        bends = self._bends(0.0 if sign else self._middle())

        def height(shaft: float, within: float) -> float:
            value = self.value(shaft, within)
            return sign * value.real if sign else abs(value)

        parts = [_Part(start, end, (start + end) / 2) for start, end in self.pistons.pieces]
        parts = [arc._replace(first=height(arc.start, arc.within), last=height(arc.end, arc.within)) for arc in parts]
        low, best = max((height, place) for arc in parts for place, height in arc.ends)
        high, visits = -inf, 0
        while parts:
            finer: List[_Part] = []
            floor = low if sign else max(low, enough)
            most = floor + CLOSE * abs(floor) + LEFT_OUT * size
            for arc in parts:
                bound = (
                    max(arc.first, arc.last) + bends(arc.start, arc.end, arc.within) * (arc.end - arc.start) ** 2 / 8
                )
                if not bound > most:
                    high = max(high, bound)
                    continue
                there = (arc.start + arc.end) / 2
                value = height(there, arc.within)
                low, best = max((low, best), (value, there))
                finer += [arc._replace(end=there, last=value), arc._replace(start=there, first=value)]
            parts, visits = finer, visits + len(finer)
            if visits > MOST:
                return None
        return Peak(low, max(high, low), self.pistons.sense * best)

    def share_below(self, level: float, off: float) -> Optional[Tuple[float, float]]:
        """Share of the revolutions over which a scalar is below a level, at least and at most, where it may be off
        itself; None where it takes too many angles."""
        bends = self._bends(0.0)

        def height(shaft: float, within: float) -> float:
            return self.value(shaft, within).real - level

        parts = [_Part(start, end, (start + end) / 2) for start, end in self.pistons.pieces]
        parts = [arc._replace(first=height(arc.start, arc.within), last=height(arc.end, arc.within)) for arc in parts]
        sure, open_, visits = 0.0, 0.0, 0
        while parts:
            finer: List[_Part] = []
            for arc in parts:
                width = arc.end - arc.start
                beside = bends(arc.start, arc.end, arc.within) * width**2 / 8
                if max(arc.first, arc.last) + beside < -off:
                    sure += width
                elif min(arc.first, arc.last) - beside > off:
                    continue
                elif width < NARROWEST or max(abs(arc.first), abs(arc.last)) + beside < 2 * off:
                    open_ += width
                else:
                    there = (arc.start + arc.end) / 2
                    value = height(there, arc.within)
                    finer += [arc._replace(end=there, last=value), arc._replace(start=there, first=value)]
            parts, visits = finer, visits + len(finer)
            if visits > MOST:
                return None
        return sure / self.pistons.period, (sure + open_) / self.pistons.period

    def _bends(self, frame: float) -> Callable[[float, float, float], float]:
        """What the second derivative comes to at most between two angles of a piece, in a frame that turns."""
        weights = [(k, abs(weight)) for k, weight in self.weights]
        rows = [self.pistons.rows[k] for k, _ in weights]
        own = [_sizes(self.reading, row.ratio, frame) for row in rows]
        always = sum((order - frame) ** 2 * abs(phasor) for order, phasor in self.beside.items())
        for (_, weight), row, (flat, slope, curve) in zip(weights, rows, own):
            still, once, twice = row.moving if self.acting.inertia else (0.0, 0.0, 0.0)
            rubs = row.friction if self.acting.friction else 0.0
            always += weight * (twice * flat + 2 * once * slope + (still + rubs) * curve)

        def bends(start: float, end: float, within: float) -> float:
            bound = always
            for (k, weight), (flat, slope, curve) in zip(weights if self.acting.gas else (), own):
                most, first, second = self.pistons.steepness(k, start, end, within)
                bound += weight * (second * flat + 2 * first * slope + most * curve)
            return bound

        return bends

    @property
    def mean(self) -> complex:
        """Over the revolutions."""
        return self._of_rows.value + self.beside.get(0, 0j)

    @property
    def rms(self) -> float:
        """Root of the mean square, where nothing turns beside the rows."""
        return hypot(sqrt(max(self._of_rows.square, 0.0)), abs(self.mean))

    @property
    def _of_rows(self) -> Mean:
        if self._rows is None:
            rows = PressureCurve(self.pistons, self.reading, self.weights, {}, self.acting)
            pieces = [_integrals(rows, *piece, (sum(piece)) / 2, rows.size) for piece in self.pistons.pieces]
            whole = self.pistons.period
            middle = sum(pair[0] for pair in pieces) / whole
            self._rows = Mean(middle, sum(pair[1] for pair in pieces) / whole - abs(middle) ** 2)
        return self._rows


def _integrals(
    curve: PressureCurve, start: float, end: float, within: float, size: float, depth: int = 0
) -> Tuple[complex, float]:
    """Of a curve and its square between two angles: by a quadrature, and both halves of it."""
    width, middle = end - start, (start + end) / 2
    whole, halves, square = 0j, 0j, 0.0
    for place, share in NODES:
        whole += width * share * curve.value(start + width * place, within)
        for half in (start, middle):
            value = curve.value(half + width / 2 * place, within)
            halves += width / 2 * share * value
            square += width / 2 * share * abs(value) ** 2
    if not abs(whole - halves) > ROUGH * size or depth == DEEPEST:
        return halves, square
    left, right = (_integrals(curve, *ends, within, size, depth + 1) for ends in ((start, middle), (middle, end)))
    return left[0] + right[0], left[1] + right[1]


@lru_cache(maxsize=256)
def _sizes(reading: str, ratio: float, frame: float) -> Tuple[float, float, float]:
    """Sums of the sizes of the harmonics of what the motion makes of a force, and of its slopes in a frame."""
    count, sizes = 32, [1.0]
    while max(sizes[count // 4 - 2 : count // 4 + 2], default=1.0) > 1e-12 and count < FINEST:
        count *= 2
        values = [complex(READINGS[reading](motion(ratio, 2 * pi * n / count))) for n in range(count)]
        sizes = [abs(size) / count for size in transform(values)][: count // 2]
    orders = {sign * k: size for k, size in enumerate(sizes) if size > 1e-14 for sign in (1, -1)}
    if reading == "shaft":
        # 1 - j s tan b, turned back by the shaft angle
        orders = {-1: 1.0, **{k - 1: size for k, size in orders.items() if k}}
    flat, slope, curve = (1.0001 * sum(abs(k - frame) ** n * size for k, size in orders.items()) for n in range(3))
    return flat, slope, curve
