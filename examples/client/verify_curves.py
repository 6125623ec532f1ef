"""What a machine does at a shaft angle, all orders: forces on shaft and frame, and what its bearings carry of them."""

from __future__ import annotations

from fractions import Fraction
from math import isfinite, isqrt, radians
from typing import Dict, List, Tuple

from verify_machine import ON_FRAME, Machine, over
from verify_numbers import BITS, ONE, SPECK, ZERO, J, NotCovered, Number, Place, direction, real
from verify_pistons import Pistons, rows_of
from verify_spans import Spans


class Turn:
    """What a machine does at a shaft angle, in the units of the answer."""

    def __init__(self, request: Place, machine: Machine, loads: bool) -> None:
        design = request / "machine"
        self.machine, self.sense = machine, ONE if (design / "rotation").text(default="ccw") == "ccw" else -ONE
        fidelity = request / "fidelity"
        if (fidelity / "kinematics").text(default="exact") != "exact":
            raise NotCovered(fidelity / "kinematics")
        continuous = (fidelity / "shaft").text("simple_spans", "continuous", default="simple_spans") == "continuous"
        self.rows = list(rows_of(design))
        gas = any(row.place / "cylinder" or list(row.place / "cylinders") for row in self.rows)
        #: what acts on the pistons beside inertia, where loads count
        self.pistons = Pistons(design, machine, self.rows) if loads and (gas or design / "friction") else None
        self.turning = [mass for mass in machine.masses if mass.counter is ZERO]
        self.place = design / "bearings"
        bearings = sorted(
            (Fraction((bearing / "position_m").double()), (bearing / "name").text()) for bearing in self.place
        )
        #: names of the bearings, and what they carry, in rising places
        self.bearings = {name: n for n, (_, name) in enumerate(bearings)}
        self.places = [float(place) for place, _ in bearings]
        apart = all(position < other for (position, _), (other, _) in zip(bearings, bearings[1:]))
        self.spans = Spans([place for place, _ in bearings], continuous) if len(bearings) > 1 and apart else None
        self._factors: Dict[Tuple[str, int], Number] = {}

    def on_shaft(self, response: str, degrees: float) -> Number:
        """A response without counterweights but those that are fixed, at a shaft angle, as the shaft sees it."""
        machine, on_shaft = self.machine, response.partition(":")[0] in ("bearing", "bending")
        turn = self.unit(degrees)
        value = ZERO
        pushes = self._pushes(degrees) if on_shaft or response == "roll" else []
        for k, row in enumerate(self.rows):
            own = row.crank * row.axis.conjugate() * turn
            cosine, sine = own.parts()  # the latter times the sense of rotation
            upright = ONE - row.ratio * row.ratio * sine * sine
            if upright.low <= 0:
                raise NotCovered(row.place)
            leaning, slope = root(upright), row.ratio * cosine * sine
            outward = cosine + over(row.ratio * (cosine * cosine - sine * sine), leaning, self.place)
            outward = outward + over(row.ratio * slope * slope, upright * leaning, self.place)
            tangent = over(row.ratio * sine, leaning, self.place)
            pull = row.product * machine.wide * outward
            pull = pull + pushes[k] if pushes else pull
            if response == "roll":
                value = value + pull * row.radius * (sine + cosine * tangent)
                continue
            force = pull * row.axis * turn.conjugate()
            if on_shaft:
                force = force * (ONE - J * tangent)
            value = value + force * self.factor(response, row.position)
        for mass in (*self.turning, *machine.there) if response != "roll" else ():
            size = mass.product * machine.wide * self.factor(response, mass.position)
            value = value + (mass.co + machine.blur) * size
        if response == "roll" and self.pistons is not None:
            # what machine and driver take up all the time does not shake
            mean, off = self.pistons.mean_torque
            value = value - self._over_square(mean, off) * self.sense
        return value * machine.square

    def _pushes(self, degrees: float) -> List[Number]:
        """Gas and friction on every piston over omega^2, in doubles."""
        if self.pistons is None:
            return []
        return [self._over_square(force, off) for force, off in self.pistons.pushes(radians(degrees))]

    def _over_square(self, value: float, off: float) -> Number:
        number = Number(real(value - off).low, real(value + off).high)
        return over(number, self.machine.square, self.place)

    def unit(self, degrees: float) -> Number:
        """A unit vector that turns with the shaft."""
        turn = direction(degrees) + self.machine.blur
        return turn if self.sense is ONE else turn.conjugate()

    def factor(self, response: str, position: Number) -> Number:
        """What a unit of force in a plane adds to a response."""
        key = response, position.low
        if key not in self._factors:
            self._factors[key] = self._adds(response, position)
        return self._factors[key]

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


def root(number: Number) -> Number:
    """Of a number above 0."""
    return Number(isqrt(max(number.low, 0) << BITS), isqrt(number.high << BITS) + 1)
