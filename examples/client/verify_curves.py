"""What a machine does at a shaft angle, all orders: forces on shaft and frame, and what its bearings carry of them."""

from __future__ import annotations

from fractions import Fraction
from math import isfinite, isqrt
from typing import Dict, Iterator, NamedTuple, Tuple

from verify_machine import ON_FRAME, Machine, over, row_masses
from verify_numbers import BITS, ONE, SPECK, ZERO, J, NotCovered, Number, Place, direction, real
from verify_spans import Spans


class Row(NamedTuple):
    """A piston on its crank."""

    product: Number  # reciprocating mass times crank radius, kg m
    radius: Number  # of the crank, m
    crank: Number
    axis: Number
    ratio: Number  # crank radius over rod length
    position: Number
    place: Place  # in the request


class Turn:
    """What a machine does at a shaft angle, in the units of the answer."""

    def __init__(self, request: Place, machine: Machine, loads: bool) -> None:
        asked = request / "machine"
        self.machine, self.sense = machine, ONE if (asked / "rotation").text(default="ccw") == "ccw" else -ONE
        fidelity = request / "fidelity"
        if (fidelity / "kinematics").text(default="exact") != "exact":
            raise NotCovered(fidelity / "kinematics")
        if loads and asked / "friction":
            raise NotCovered(asked / "friction")
        continuous = (fidelity / "shaft").text("simple_spans", "continuous", default="simple_spans") == "continuous"
        self.rows = list(_rows(asked, loads))
        self.turning = [mass for mass in machine.masses if mass.counter is ZERO]
        self.place = asked / "bearings"
        bearings = sorted((Fraction((one / "position_m").double()), (one / "name").text()) for one in self.place)
        #: names of the bearings, and what they carry, in rising places
        self.bearings = {name: n for n, (_, name) in enumerate(bearings)}
        self.places = [float(place) for place, _ in bearings]
        apart = all(one < other for (one, _), (other, _) in zip(bearings, bearings[1:]))
        self.spans = Spans([place for place, _ in bearings], continuous) if len(bearings) > 1 and apart else None
        self._known: Dict[Tuple[str, int], Number] = {}

    def seen(self, response: str, degrees: float) -> Number:
        """A response without counterweights but those that are fixed, at a shaft angle, as the shaft sees it."""
        machine, on_shaft = self.machine, response.partition(":")[0] in ("bearing", "bending")
        turn = self.turned(degrees)
        found = ZERO
        for row in self.rows:
            own = row.crank * row.axis.conjugate() * turn
            cosine, sine = own.parts()  # the latter times the sense of rotation
            upright = ONE - row.ratio * row.ratio * sine * sine
            if upright.low <= 0:
                raise NotCovered(row.place)
            leaning, both = root(upright), row.ratio * cosine * sine
            outward = cosine + over(row.ratio * (cosine * cosine - sine * sine), leaning, self.place)
            outward = outward + over(row.ratio * both * both, upright * leaning, self.place)
            tangent = over(row.ratio * sine, leaning, self.place)
            if response == "roll":
                found = found + row.product * row.radius * machine.wide * outward * (sine + cosine * tangent)
                continue
            force = row.product * machine.wide * outward * row.axis * turn.conjugate()
            if on_shaft:
                force = force * (ONE - J * tangent)
            found = found + force * self.factor(response, row.position)
        for mass in (*self.turning, *machine.there) if response != "roll" else ():
            size = mass.product * machine.wide * self.factor(response, mass.position)
            found = found + (mass.co + machine.blur) * size
        return found * machine.square

    def turned(self, degrees: float) -> Number:
        """A unit vector that turns with the shaft."""
        turn = direction(degrees) + self.machine.blur
        return turn if self.sense is ONE else turn.conjugate()

    def factor(self, response: str, position: Number) -> Number:
        """What a unit of force in a plane adds to a response."""
        key = response, position.low
        if key not in self._known:
            self._known[key] = self._adds(response, position)
        return self._known[key]

    def _adds(self, response: str, position: Number) -> Number:
        kind, _, name = response.partition(":")
        if kind == "roll":
            return ZERO
        if kind in ON_FRAME:
            return self.machine.arm(kind, position, self.machine.wide)
        if self.spans is None:
            raise NotCovered(self.place)
        where = Fraction(position.low + position.high, 1 << BITS + 1)
        if kind == "bearing":
            exact, size = self.spans.shares(where)[self.bearings[name]], Fraction(1)
        else:
            exact, size = self.spans.bending(Fraction(float(name)), where), self.spans.extent
        # the service takes differences of places
        return real(exact) + SPECK * real(abs(exact) + size)

    def knows(self, response: str) -> bool:
        """Whether there is such a response."""
        kind, _, name = response.partition(":")
        if kind not in ("bearing", "bending"):
            return response in (*ON_FRAME, "roll")
        if self.spans is None or kind == "bearing":
            return self.spans is not None and name in self.bearings
        try:
            return isfinite(float(name))
        except ValueError:
            return False


def _rows(asked: Place, loads: bool) -> Iterator[Row]:
    for throw in asked / "throws":
        radius, crank = (throw / "crank_radius_m").number(), direction((throw / "crank_angle_deg").double())
        for row in throw / "rows":
            rod = row / "connecting_rod"
            for gas in ("cylinder", "cylinders"):
                if loads and row / gas:
                    raise NotCovered(row / gas)
            weight = row_masses(row)[0]
            ratio = over(radius, (rod / "length_m").number(), rod) if rod / "length_m" else ZERO
            where = (throw / "position_m").number() + (row / "offset_m").number(0.0)
            axis = direction((row / "axis_deg").double())
            yield Row(weight * radius, radius, crank, axis, ratio, where, row)


def root(number: Number) -> Number:
    """Of a number above 0."""
    return Number(isqrt(max(number.low, 0) << BITS), isqrt(number.high << BITS) + 1)
