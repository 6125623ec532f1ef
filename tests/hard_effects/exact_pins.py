"""Loads of anti-rotation pins at 50 digits: elastic distribution, contact by trying every set of pins, peaks."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise, product
from typing import Any

from tests.hard_effects.exact import Number, cis, mp


@dataclass(frozen=True)
class Pattern:
    """Pins as they are posted, and the torque: a number, or a table over the turn."""

    pins: list[dict[str, Any]]
    torque: Any

    @cached_property
    def stiffness(self) -> list[Number]:
        return [mp.mpf(pin.get("stiffness_N_per_m", 1.0)) for pin in self.pins]

    @cached_property
    def offset(self) -> list[Number]:
        """Places from their weighted mean."""
        places = [mp.mpf(pin["radius_m"]) * cis(pin["angle_deg"] % 360.0) for pin in self.pins]
        mean = sum(k * z for k, z in zip(self.stiffness, places, strict=True)) / sum(self.stiffness)
        return [z - mean for z in places]

    def torque_at(self, angle: Number) -> tuple[Number, Number]:
        """Torque and its slope per degree at an angle in [0, 360) degrees; tables run on from end to beginning."""
        if not isinstance(self.torque, dict):
            return mp.mpf(self.torque), mp.mpf(0)
        knots = [mp.mpf(a) for a in self.torque["angle_deg"]]
        values = [mp.mpf(v) for v in self.torque["torque_Nm"]]
        knots, values = [knots[-1] - 360, *knots, knots[0] + 360], [values[-1], *values, values[0]]
        k = max(i for i in range(len(knots) - 1) if knots[i] <= angle)
        slope = (values[k + 1] - values[k]) / (knots[k + 1] - knots[k])
        return values[k] + slope * (angle - knots[k]), slope

    def levers(self, angle: Number) -> list[Number]:
        turned = mp.expjpi(mp.mpf(angle) / 180)
        return [mp.im(turned * mp.conj(w)) for w in self.offset]

    def loads(self, angle: Number) -> list[Number]:
        """All pins bear: T k d / sum k d^2."""
        lever = self.levers(angle)
        below = sum(k * d**2 for k, d in zip(self.stiffness, lever, strict=True))
        torque, _ = self.torque_at(angle)
        return [torque * k * d / below for k, d in zip(self.stiffness, lever, strict=True)]

    def contact(self, angle: Number) -> list[Number]:
        """Loads with clearances and errors: the one set of bearing pins whose strains agree with it."""
        lever, torque = self.levers(angle), self.torque_at(angle)[0]
        clearance = [mp.mpf(pin.get("clearance_m", 0.0)) for pin in self.pins]
        wrong = [mp.mpf(pin.get("eccentricity_error_m", 0.0)) for pin in self.pins]
        for sides in product((-1, 0, 1), repeat=len(self.pins)):
            # Q = k (d rho + t - eps - side c) for bearing pins; sum Q = 0, sum Q d = T
            bears = [
                (k, d, e + s * c)
                for s, k, d, e, c in zip(sides, self.stiffness, lever, wrong, clearance, strict=True)
                if s
            ]
            whole, first = sum(k for k, _, _ in bears), sum(k * d for k, d, _ in bears)
            second = sum(k * d * d for k, d, _ in bears)
            determinant = whole * second - first**2
            if len(bears) < 2 or determinant == 0:
                continue
            force, moment = sum(k * g for k, _, g in bears), torque + sum(k * d * g for k, d, g in bears)
            turn, shift = (
                (whole * moment - first * force) / determinant,
                (second * force - first * moment) / determinant,
            )
            strain = [d * turn + shift - e for d, e in zip(lever, wrong, strict=True)]
            if all(s * x >= c if s else abs(x) <= c for s, x, c in zip(sides, strain, clearance, strict=True)):
                return [
                    k * (x - s * c) if s else mp.mpf(0)
                    for s, k, x, c in zip(sides, self.stiffness, strain, clearance, strict=True)
                ]
        raise AssertionError("no set of bearing pins is consistent")

    def peak(self, pin: int) -> Number:
        """Largest |Q| of a pin over the turn: roots of the derivative between the entries of the torque."""
        own, squares = self.offset[pin], sum(k * w**2 for k, w in zip(self.stiffness, self.offset, strict=True))
        sizes = sum(k * abs(w) ** 2 for k, w in zip(self.stiffness, self.offset, strict=True))

        def parts(angle: Number) -> tuple[Number, Number, Number, Number]:
            turned = mp.expjpi(angle / 180)
            along, twice = turned * mp.conj(own), turned**2 * mp.conj(squares)
            return mp.im(along), mp.re(along), (sizes - mp.re(twice)) / 2, mp.im(twice)

        def derivative(angle: Number) -> Number:
            lever, rate, below, change = parts(angle)
            torque, slope = self.torque_at(angle)
            return slope * 180 / mp.pi * lever * below + torque * (rate * below - lever * change)

        axis = mp.arg(squares) * 90 / mp.pi
        knots = [mp.mpf(a) for a in self.torque["angle_deg"]] if isinstance(self.torque, dict) else []
        tried = {mp.mpf(k) for k in range(0, 360, 2)} | set(knots)
        for centre in (axis, axis + 180):
            near = [side * mp.mpf(2) ** -k for k in range(30) for side in (-1, 1)]
            tried |= {mp.fmod(centre + offset + 720, 360) for offset in (0, *near)}
        edges = [*sorted(tried), mp.mpf(360) - mp.mpf(10) ** -40]
        actual_edges = list(edges)
        tiny = mp.mpf(10) ** -30
        for left, right in pairwise(edges):
            a, b = left + tiny, right - tiny
            if derivative(a) * derivative(b) < 0:
                actual_edges.append(_root(derivative, a, b))

        def size(angle: Number) -> Number:
            return abs(self.torque_at(angle)[0] * self.stiffness[pin] * parts(angle)[0] / parts(angle)[2])

        return max(size(angle) for angle in actual_edges)


def _root(function: Callable[[Number], Number], left: Number, right: Number) -> Number:
    """Root in a bracket by regula falsi (Illinois)."""
    at_left, at_right = function(left), function(right)
    for _ in range(80):
        if at_left == at_right or abs(right - left) < mp.mpf(10) ** -24:
            break
        middle = (left * at_right - right * at_left) / (at_right - at_left)
        at_middle = function(middle)
        if at_middle * at_right < 0:
            left, at_left = right, at_right
        else:
            at_left /= 2
        right, at_right = middle, at_middle
        if at_middle == 0:
            break
    return right
