"""What a machine does at a shaft angle, all orders: forces on shaft and frame, and what its bearings carry of them."""

from __future__ import annotations

from math import isfinite, isqrt
from typing import Dict, Iterator, NamedTuple, Tuple

from verify_machine import ON_FRAME, Machine, over, row_masses
from verify_numbers import BITS, ONE, ZERO, J, NotCovered, Number, Place, direction, largest, real, total


class Row(NamedTuple):
    """A piston on its crank."""

    product: Number  # reciprocating mass times crank radius, kg m
    crank: Number
    axis: Number
    ratio: Number  # crank radius over rod length
    position: Number


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
        if loads and (fidelity / "shaft").text(default="simple_spans") != "simple_spans":
            raise NotCovered(fidelity / "shaft")
        self.rows = list(_rows(asked, loads))
        self.turning = [mass for mass in machine.masses if mass.counter is ZERO]
        places = [((one / "name").text(), (one / "position_m").number() * machine.wide) for one in asked / "bearings"]
        self.bearings, self.place = sorted(places, key=lambda one: one[1].low), asked / "bearings"
        self._known: Dict[Tuple[str, int], Number] = {}

    def seen(self, response: str, degrees: float) -> Number:
        """A response without counterweights at a shaft angle, as the shaft sees it."""
        machine, on_shaft = self.machine, response.partition(":")[0] in ("bearing", "bending")
        turn = self.turned(degrees)
        found = ZERO
        for row in self.rows:
            own = row.crank * row.axis.conjugate() * turn
            cosine, sine = own.parts()  # the latter times the sense of rotation
            upright = ONE - row.ratio * row.ratio * sine * sine
            root, both = _root(upright), row.ratio * cosine * sine
            outward = cosine + over(row.ratio * (cosine * cosine - sine * sine), root, self.place)
            outward = outward + over(row.ratio * both * both, upright * root, self.place)
            force = row.product * machine.wide * outward * row.axis * turn.conjugate()
            if on_shaft:
                force = force * (ONE - J * over(row.ratio * sine, root, self.place))
            found = found + force * self.factor(response, row.position)
        for mass in self.turning:
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
        place = position * self.machine.wide
        if kind in ON_FRAME:
            return self.machine.arm(kind, position, self.machine.wide)
        carried = self._carried(place)
        if kind == "bearing":
            return carried[name]
        plane = real(float(name)) * self.machine.wide
        arms = (largest(where - plane, ZERO) * carried[each] for each, where in self.bearings)
        return total(arms) - largest(place - plane, ZERO)

    def _carried(self, place: Number) -> Dict[str, Number]:
        """Shares of a load in a plane that the bearings carry, every span by itself, overhangs with the next."""
        found = {name: ZERO for name, _ in self.bearings}
        k = sum(place.low > where.low for _, where in self.bearings[1:-1])
        (left, start), (right, end) = self.bearings[k : k + 2]
        found[left], found[right] = (over(one, end - start, self.place) for one in (end - place, place - start))
        return found

    def knows(self, response: str) -> bool:
        """Whether there is such a response."""
        kind, _, name = response.partition(":")
        if kind not in ("bearing", "bending"):
            return response in ON_FRAME
        if len(self.bearings) < 2 or kind == "bearing":
            return len(self.bearings) > 1 and name in dict(self.bearings)
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
            yield Row(weight * radius, crank, direction((row / "axis_deg").double()), ratio, where)


def _root(number: Number) -> Number:
    """Of a number above 0."""
    return Number(isqrt(max(number.low, 0) << BITS), isqrt(number.high << BITS) + 1)
