"""Curves over a revolution by their harmonics: force and moment on the frame, bearing loads, bending moments, roll.

All are seen from the shaft, which changes no length: a force m r omega^2 g(phi) along an axis is turned back by the
shaft angle. With phi = phi_0 + t its harmonics of orders k are of orders k - 1 in t; t is the shaft angle, or its
negative where the shaft turns clockwise. What turns with the shaft is of order 0, a balance shaft that turns n times of
order n - 1. Roll is a number: r F (sin phi + cos phi tan b) of each piston, without the mean of all.
"""

from __future__ import annotations

from functools import cached_property
from typing import Dict, NamedTuple, Sequence, Tuple, Union

from verify_curves import Turn
from verify_harmonics import Curve, Harmonics, rod, total
from verify_machine import ON_FRAME, Machine, Mass
from verify_numbers import NotCovered, Number, Place
from verify_pistons import Row
from verify_pressed import PressureCurve

#: planes of the shaft times harmonics that are looked at
MOST = 3_000
#: planes of the shaft times rows likewise, where gas or friction acts
MOST_WITH_GAS = 200

Periodic = Union[Curve, PressureCurve]


class Piston(NamedTuple):
    """What a piston puts on the shaft, on the frame, and on it about the shaft; N, N m."""

    position: Number
    shaft: Harmonics
    frame: Harmonics
    roll: Harmonics


class Loads:
    """Curves of one machine without counterweights, and what those add."""

    def __init__(self, design: Place, machine: Machine, turn: Turn) -> None:
        self.turn, self.square, self.plane = turn, machine.square.middle().real, machine.plane.middle().real
        self.pistons = [_piston(row, self.square) for row in turn.rows]
        #: of every web of the balance shafts, where its shaft is [m]
        self.levers = [
            complex((shaft / "x_m").double(0.0), (shaft / "y_m").double(0.0))
            for shaft in design / "balance_shafts"
            for _ in shaft / "webs"
        ]
        places = [part.position for part in turn.rows]
        places += [part.position for part in turn.turning]
        places += [web.position for web in machine.webs]
        #: planes of loads, webs and bearings, in which the bending moment has its corners [m]
        self.planes = sorted({*(part.middle().real for part in places), *turn.places})
        self._curves: Dict[str, Periodic] = {}

    @property
    def turns(self) -> int:
        """Revolutions after which all repeats."""
        return 1 if self.turn.pistons is None else self.turn.pistons.turns

    def size_of(self, response: str) -> float:
        """What a response is small beside where it cancels: the sum of all forces, times the length of the machine."""
        kind = response.partition(":")[0]
        arms = {"moment": max(abs(plane - self.plane) for plane in self.planes)}
        arms["bending"] = max(self.planes) - min(self.planes)
        return self._forces * arms.get(kind, 1.0)

    @cached_property
    def _forces(self) -> float:
        rows = sum(abs(force) for item in self.pistons for force in item.shaft.values())
        rows += sum(item.most + item.friction for item in self.turn.pistons.rows) if self.turn.pistons else 0.0
        return rows + sum(abs(item.product.middle().real) * self.square for item in self.turn.turning)

    def curve(self, response: str) -> Periodic:
        """Of a response by its name, without counterweights."""
        if response not in self._curves:
            self._curves[response] = self._curve(response)
        return self._curves[response]

    def _curve(self, response: str) -> Periodic:
        orders = max((len(item.shaft) for item in self.pistons), default=1)
        if response.startswith("bending") and len(self.planes) * orders > MOST:
            raise NotCovered(self.turn.place)
        pistons, on_frame = self.turn.pistons, response in ON_FRAME
        if pistons is not None and response == "roll":
            # what machine and driver take up all the time does not shake
            around = PressureCurve(
                pistons, "tangential", [(k, pistons.sense * item.radius) for k, item in enumerate(pistons.rows)]
            )
            return around.plus(-around.mean)
        if pistons is not None and not on_frame:
            if response.startswith("bending") and len(self.planes) * len(pistons.rows) > MOST_WITH_GAS:
                raise NotCovered(self.turn.place)
            weights = [(k, self.factor(response, row.position) * row.axis) for k, row in enumerate(pistons.rows)]
            return PressureCurve(pistons, "shaft", weights, {0: self.vector(response, self.turn.turning)})
        if response == "roll":
            rolling = total([(1.0, item.roll) for item in self.pistons]).harmonics
            return Curve({k: phasor for k, phasor in rolling.items() if k}, scalar=True)
        rows = [(self.factor(response, item.position), item.frame if on_frame else item.shaft) for item in self.pistons]
        return total([*rows, (1.0, {0: self.vector(response, self.turn.turning)})])

    def vector(self, response: str, weights: Sequence[Mass]) -> complex:
        """What weights on the crankshaft add, all of order 0."""
        if response == "roll":
            return 0j
        vectors = (self.factor(response, mass.position) * (mass.product * mass.co).middle() for mass in weights)
        return sum(vectors, 0j) * self.square

    def with_weights(
        self, response: str, weights: Sequence[Mass], on_shafts: Sequence[Tuple[int, Mass]] = ()
    ) -> Periodic:
        """The curve with weights, those on balance shafts by the sizes of their speed ratios."""
        curve = self.curve(response).plus(self.vector(response, weights))
        for lever, (ratio, mass) in zip(self.levers, on_shafts):
            size = ratio**2 * self.square * mass.product.middle().real
            if isinstance(curve, PressureCurve):
                lever = -1j * lever.conjugate() * size
                for sense, vector in ((1, mass.co), (-1, mass.counter)) if response == "roll" else ():
                    curve = curve.plus(lever * vector.middle(), sense * ratio)
            elif response == "roll":
                around = Curve({}, scalar=True)
                for sense, vector in ((1, mass.co), (-1, mass.counter)):
                    turning = Curve({sense * ratio: -1j * lever.conjugate() * size * vector.middle()}, scalar=True)
                    around = Curve(total([(1.0, around.harmonics), (1.0, turning.harmonics)]).harmonics)
                curve = Curve(total([(1.0, curve.harmonics), (1.0, around.harmonics)]).harmonics)
            elif response in ON_FRAME:
                size *= self.factor(response, mass.position)
                curve = curve.plus(size * mass.co.middle(), ratio - 1).plus(size * mass.counter.middle(), -ratio - 1)
        return curve

    def of_weights(self, response: str, weights: Sequence[Mass], on_shafts: Sequence[Tuple[int, Mass]]) -> float:
        """What weights add to a response on the frame at most, whatever of it cancels."""
        sizes = [*((1, mass) for mass in weights), *on_shafts]
        parts = (
            ratio**2 * abs(self.factor(response, mass.position) * mass.product.middle().real) for ratio, mass in sizes
        )
        return self.square * sum(parts)

    def factor(self, response: str, position: Number) -> float:
        """What a newton in a plane adds to a response."""
        value: float = self.turn.factor(response, position).middle().real
        return value


def _piston(row: Row, square: float) -> Piston:
    harmonics = rod(row.ratio.middle().real)
    if harmonics is None:
        raise NotCovered(row.place)
    size, first = row.product.middle().real * square, (row.crank * row.axis.conjugate()).middle()
    axis, lever = row.axis.middle(), row.radius.middle().real
    powers = {k: first**k for k in range(min(harmonics) - 1, max(harmonics) + 1)}
    # of the even part, the acceleration alone
    even = {k: (value + harmonics[-k]) / 2 for k, value in harmonics.items()}
    on_shaft, on_frame = (
        {k - 1: size * value * axis * powers[k] for k, value in series.items()} for series in (harmonics, even)
    )
    around = {k - 1: 1j * lever * size * value * powers[k - 1] for k, value in harmonics.items()}
    return Piston(row.position, on_shaft, on_frame, around)
