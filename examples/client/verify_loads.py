"""Curves over a revolution by their harmonics: force and moment on the frame, bearing loads, bending moments, roll.

All are seen from the shaft, which changes no length: a force m r omega^2 g(phi) along an axis is turned back by the
shaft angle. With phi = phi_0 + t its harmonics of orders k are of orders k - 1 in t; t is the shaft angle, or its
negative where the shaft turns clockwise. What turns with the shaft is of order 0, a balance shaft that turns n times of
order n - 1. Roll is a number: r F (sin phi + cos phi tan b) of each piston, without the mean of all.
"""

from __future__ import annotations

from functools import cached_property
from typing import Dict, NamedTuple, Sequence, Tuple

from verify_curves import Row, Turn
from verify_harmonics import Curve, Harmonics, rod, total
from verify_machine import ON_FRAME, Machine, Mass
from verify_numbers import NotCovered, Number, Place

#: planes of the shaft times harmonics that are looked at
MOST = 3_000


class Piston(NamedTuple):
    """What a piston puts on the shaft, on the frame, and on it about the shaft; N, N m."""

    position: Number
    shaft: Harmonics
    frame: Harmonics
    roll: Harmonics


class Loads:
    """Curves of one machine without counterweights, and what those add."""

    def __init__(self, asked: Place, machine: Machine, turn: Turn) -> None:
        self.turn, self.square, self.plane = turn, machine.square.middle().real, machine.plane.middle().real
        self.pistons = [_piston(row, self.square) for row in turn.rows]
        #: of every web of the balance shafts, where its shaft is [m]
        self.levers = [
            complex((shaft / "x_m").double(0.0), (shaft / "y_m").double(0.0))
            for shaft in asked / "balance_shafts"
            for _ in shaft / "webs"
        ]
        places = [one.position for one in (*turn.rows, *turn.turning, *machine.webs)]
        #: planes of loads, webs and bearings, in which the bending moment has its corners [m]
        self.planes = sorted({*(one.middle().real for one in places), *turn.places})
        self._curves: Dict[str, Curve] = {}

    def size_of(self, response: str) -> float:
        """What a response is small beside where it cancels: the sum of all forces, times the length of the machine."""
        kind = response.partition(":")[0]
        arms = {"moment": max(abs(plane - self.plane) for plane in self.planes)}
        arms["bending"] = max(self.planes) - min(self.planes)
        return self._forces * arms.get(kind, 1.0)

    @cached_property
    def _forces(self) -> float:
        rows = sum(abs(each) for one in self.pistons for each in one.shaft.values())
        return rows + sum(abs(one.product.middle().real) * self.square for one in self.turn.turning)

    def curve(self, response: str) -> Curve:
        """Of a response by its name, without counterweights."""
        if response not in self._curves:
            self._curves[response] = self._curve(response)
        return self._curves[response]

    def _curve(self, response: str) -> Curve:
        orders = max((len(one.shaft) for one in self.pistons), default=1)
        if response.startswith("bending") and len(self.planes) * orders > MOST:
            raise NotCovered(self.turn.place)
        if response == "roll":
            around = total([(1.0, one.roll) for one in self.pistons]).harmonics
            return Curve({k: each for k, each in around.items() if k}, scalar=True)
        on_frame = response in ON_FRAME
        rows = [(self.factor(response, one.position), one.frame if on_frame else one.shaft) for one in self.pistons]
        return total([*rows, (1.0, {0: self.added(response, self.turn.turning)})])

    def added(self, response: str, weights: Sequence[Mass]) -> complex:
        """What weights on the crankshaft add, all of order 0."""
        if response == "roll":
            return 0j
        vectors = (self.factor(response, one.position) * (one.product * one.co).middle() for one in weights)
        return sum(vectors, 0j) * self.square

    def with_weights(self, response: str, weights: Sequence[Mass], on_shafts: Sequence[Tuple[int, Mass]] = ()) -> Curve:
        """The curve with weights, those on balance shafts by the sizes of their speed ratios."""
        found = self.curve(response).moved(self.added(response, weights))
        for lever, (ratio, one) in zip(self.levers, on_shafts):
            size = ratio**2 * self.square * one.product.middle().real
            if response == "roll":
                around = Curve({}, scalar=True)
                for sense, vector in ((1, one.co), (-1, one.counter)):
                    turning = Curve({sense * ratio: -1j * lever.conjugate() * size * vector.middle()}, scalar=True)
                    around = Curve(total([(1.0, around.harmonics), (1.0, turning.harmonics)]).harmonics)
                found = Curve(total([(1.0, found.harmonics), (1.0, around.harmonics)]).harmonics)
            elif response in ON_FRAME:
                size *= self.factor(response, one.position)
                found = found.moved(size * one.co.middle(), ratio - 1).moved(size * one.counter.middle(), -ratio - 1)
        return found

    def factor(self, response: str, position: Number) -> float:
        """What a newton in a plane adds to a response."""
        return self.turn.factor(response, position).middle().real


def _piston(row: Row, square: float) -> Piston:
    harmonics = rod(row.ratio.middle().real)
    if harmonics is None:
        raise NotCovered(row.place)
    size, first = row.product.middle().real * square, (row.crank * row.axis.conjugate()).middle()
    axis, lever = row.axis.middle(), row.radius.middle().real
    powers = {k: first**k for k in range(min(harmonics) - 1, max(harmonics) + 1)}
    # of the even part, the acceleration alone
    even = {k: (each + harmonics[-k]) / 2 for k, each in harmonics.items()}
    on_shaft, on_frame = (
        {k - 1: size * each * axis * powers[k] for k, each in one.items()} for one in (harmonics, even)
    )
    around = {k - 1: 1j * lever * size * each * powers[k - 1] for k, each in harmonics.items()}
    return Piston(row.position, on_shaft, on_frame, around)
