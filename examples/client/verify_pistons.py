"""What acts on the pistons of a machine at a shaft angle: gas, friction and inertia, in doubles.

Friction of a row is as large both ways and against the motion. From the efficiency e it is a share of the losses
N (1/e - 1) of the indicated power N, or N (1 - e) of gas that gives power. The rest turns with the shaft. A pressure
jumps nowhere, friction at the dead centres alone: ``within`` says on which side of one an angle is.
"""

from __future__ import annotations

from cmath import phase
from functools import cached_property
from math import ceil, pi, sin, sqrt
from typing import Callable, Dict, Iterator, List, NamedTuple, Optional, Sequence, Tuple

from verify_gas import TURN, Chamber, Motion, Table, chambers, force, gauss, motion
from verify_harmonics import rod
from verify_machine import Machine, over, row_masses
from verify_numbers import ZERO, NotCovered, Number, Place, direction

WIDEST = pi / 18  # of a piece of the turn, rad
STILL = 1e-12  # |sin| of the own angle up to which a piston stands still
NODES = gauss(8)
CLOSE = 1e-13  # share of a size by which a quadrature and both of its halves may differ
DEEPEST = 20  # halvings
MOST = 200_000  # instants of rows that are looked at in one answer
BESIDE = 1e-9  # rad, beside a kink
ROUNDING = 1e-12  # of gas and friction
WORKING = 1e-11  # of the largest force over the crank radius: by which a mean torque may be off


class Row(NamedTuple):
    """A piston on its crank."""

    product: Number  # reciprocating mass times crank radius, kg m
    radius: Number  # of the crank, m
    crank: Number
    axis: Number
    ratio: Number  # crank radius over rod length
    position: Number
    place: Place  # in the request


class Instant(NamedTuple):
    """A row at a shaft angle: its motion, pressures [Pa], and forces on the piston, N, positive where they pull."""

    piston: Motion
    pressures: List[float]
    gas: float
    friction: float
    inertia: float


class Steepness(NamedTuple):
    """What the gas force of a row comes to at most between two angles, with its first two slopes [N, per rad]."""

    most: float
    first: float
    second: float


class Piston:
    """One row."""

    def __init__(self, row: Row, square: float, sense: int) -> None:
        ratio = row.ratio.middle().real
        harmonics = rod(ratio)
        if harmonics is None:
            raise NotCovered(row.place)
        self.ratio, self.radius = ratio, row.radius.middle().real
        self.place, self.position, self.axis = row.place, row.position, row.axis.middle()
        #: own angle at shaft angle 0, rad
        self.ahead = sense * phase((row.crank * row.axis.conjugate()).middle())
        self.chambers: List[Chamber] = list(chambers(row.place, 2 * self.radius, self.ahead))
        self.size = row.product.middle().real * square
        even = {k: abs(value + harmonics[-k]) / 2 for k, value in harmonics.items()}
        #: inertia and its slopes at most
        self.moving = [self.size * sum(abs(k) ** n * value for k, value in even.items()) for n in range(3)]
        self.fastest = sum(even.values())
        self.friction = 0.0

    @property
    def most(self) -> float:
        """The largest gas force there may be."""
        return sum(chamber.most * chamber.area for chamber in self.chambers)

    def at(self, shaft: float, within: float) -> Instant:
        """At a shaft angle [rad], and on which side of a dead centre it is."""
        piston, own = motion(self.ratio, shaft + self.ahead), within + self.ahead
        to_shaft = own % TURN < pi
        pressures = [chamber.at(piston, to_shaft) for chamber in self.chambers]
        gas = sum(force(chamber, pressure) for chamber, pressure in zip(self.chambers, pressures))
        still = abs(sin(own)) < STILL
        friction = 0.0 if still else self.friction if to_shaft else -self.friction
        return Instant(piston, pressures, gas, friction, self.size * piston.outward)

    def steepness(self, first: Instant, last: Instant, width: float, within: float) -> Steepness:
        """Of the gas between two angles without a kink between them."""
        if not self.chambers:
            return Steepness(0.0, 0.0, 0.0)
        to_shaft = (within + self.ahead) % TURN < pi
        ends = abs(first.piston.turning), abs(last.piston.turning)
        speed, bend = self.radius * (max(ends) + self.fastest * width / 2), self.radius * self.fastest
        slope = curve = 0.0
        for chamber in self.chambers:
            by = chamber.slopes(first.piston, last.piston, to_shaft)
            slope += chamber.area * (by.first * speed + by.by_angle)
            curve += chamber.area * (by.second * speed**2 + by.first * bend)
        return Steepness(max(abs(first.gas), abs(last.gas)) + slope * width / 2, slope, curve)

    def work(self, chamber: Chamber) -> float:
        """Put into the gas of a chamber in a revolution, J: the integral of its force over the way of the piston."""
        turns = _turns(chamber)
        ends = sorted({0.0, TURN * turns, *self.breaks(turns)})
        energy = 0.0
        for start, end in zip(ends, ends[1:]):
            to_shaft = (start + end) / 2 % TURN < pi

            def torque(own: float, to_shaft: bool = to_shaft) -> float:
                piston = motion(self.ratio, own)
                return force(chamber, chamber.at(piston, to_shaft)) * piston.turning * self.radius

            energy += integral(torque, start, end, chamber.most * chamber.area * self.radius)
        return energy / turns

    def power(self, omega: float) -> float:
        """Put into the gas of the row, W."""
        return sum(map(self.work, self.chambers)) * omega / TURN

    def breaks(self, turns: int) -> List[float]:
        """Own angles [rad] at which it turns back or a process ends."""
        angles = [k * pi for k in range(2 * turns)]
        for entry in self.chambers:
            period = _turns(entry)
            angles += [angle + TURN * k for angle in entry.breaks(self.ratio) for k in range(0, turns, period)]
        return [entry % (TURN * turns) for entry in angles]

    @property
    def turns(self) -> int:
        """Revolutions after which its gas repeats."""
        return max(map(_turns, self.chambers), default=1)


def _turns(chamber: Chamber) -> int:
    return chamber.turns if isinstance(chamber, Table) else 1


class Pistons:
    """All rows over the revolutions after which their gas repeats."""

    def __init__(self, design: Place, machine: Machine, rows: Sequence[Row]) -> None:
        self.sense = 1 if (design / "rotation").text(default="ccw") == "ccw" else -1
        self.square = machine.square.middle().real
        self.rows = [Piston(row, self.square, self.sense) for row in rows]
        self.turns = max((row.turns for row in self.rows), default=1)
        self.rubbing = self._rub(design / "friction", sqrt(self.square))
        #: whether anything but inertia acts
        self.place, self._count = design / "throws", 0
        self._instants: Dict[Tuple[int, float, float], Instant] = {}
        self._steepness: Dict[Tuple[int, float, float], Steepness] = {}

    @property
    def period(self) -> float:
        """rad, of the shaft."""
        return TURN * self.turns

    @cached_property
    def pieces(self) -> List[Tuple[float, float]]:
        """Shaft angles [rad] between which nothing has a kink, and which are not far apart."""
        breaks = {(own - row.ahead) % self.period for row in self.rows for own in row.breaks(self.turns)}
        if len(self.rows) * len(breaks) > MOST:
            raise NotCovered(self.place)
        ends = sorted({0.0, self.period, *breaks})
        intervals = []
        for start, end in zip(ends, ends[1:]):
            count = ceil((end - start) / WIDEST)
            cuts = [start + (end - start) * k / count for k in range(count)]
            intervals += list(zip(cuts, [*cuts[1:], end]))
        return intervals

    def at(self, k: int, shaft: float, within: Optional[float] = None) -> Instant:
        """A row at a shaft angle [rad], and on which side of a kink it is."""
        inside = shaft if within is None else within
        key = k, shaft, inside
        if key not in self._instants:
            self._count += 1
            if self._count > MOST:
                raise NotCovered(self.place)
            self._instants[key] = self.rows[k].at(shaft, inside)
        return self._instants[key]

    def steepness(self, k: int, start: float, end: float, within: float) -> Steepness:
        """Of the gas of a row between two angles of a piece."""
        key = k, start, end
        if key not in self._steepness:
            first, last = self.at(k, start, within), self.at(k, end, within)
            self._steepness[key] = self.rows[k].steepness(first, last, end - start, within)
        return self._steepness[key]

    def pushes(self, shaft: float) -> List[Tuple[float, float]]:
        """Gas and friction on every piston, N, and what they may be off by, on both sides of a kink."""
        forces = []
        for k, row in enumerate(self.rows):
            instant, other = (self.at(k, shaft, shaft + side) for side in (-BESIDE, BESIDE))
            jump = abs(instant.friction - other.friction) / 2
            off = ROUNDING * (row.most + row.friction) + jump
            forces.append((instant.gas + (instant.friction + other.friction) / 2, off))
        return forces

    @cached_property
    def mean_torque(self) -> Tuple[float, float]:
        """Of the rows, N m, and what it may be off by: their work in a revolution."""
        works = [sum(map(row.work, row.chambers)) + 4 * row.radius * row.friction for row in self.rows]
        sizes = [row.radius * (row.most + row.friction) for row in self.rows]
        return sum(works) / TURN, WORKING * sum(sizes)

    def _rub(self, place: Place, omega: float) -> float:
        """Sets the friction of the rows; returns that of the shaft, N m."""
        if not place:
            return 0.0
        efficiency = place / "mechanical_efficiency"
        if not efficiency:
            forces = list(place / "reciprocating_force_N")
            for item, size in zip(self.rows, forces):
                item.friction = size.double(least=0)
            return (place / "rotating_torque_Nm").double(0.0, least=0)
        entries, share = list(place / "indicated_power_W"), (place / "reciprocating_share").double(0.7, least=0)
        powers = [item.double(least=0) for item in entries] or [item.power(omega) for item in self.rows]
        e = efficiency.double(least=1e-6)
        losses = [-item * (1 - e) if item < 0 else item * (1 - e) / e for item in powers]
        for item, lost in zip(self.rows, losses):
            item.friction = share * lost * TURN / omega / (4 * item.radius) if omega > 0 else 0.0
        return (1 - share) * sum(losses) / omega if omega > 0 else 0.0


def integral(curve: Callable[[float], float], start: float, end: float, size: float, depth: int = 0) -> float:
    """Of a smooth curve, by a quadrature and both halves of it, to 1e-13 of a size."""
    width, middle = end - start, (start + end) / 2
    whole = width * sum(share * curve(start + width * place) for place, share in NODES)
    halves = (
        width
        / 2
        * sum(share * (curve(start + width / 2 * place) + curve(middle + width / 2 * place)) for place, share in NODES)
    )
    if not abs(whole - halves) > CLOSE * size or depth == DEEPEST:
        return halves
    return integral(curve, start, middle, size, depth + 1) + integral(curve, middle, end, size, depth + 1)


def rows_of(design: Place) -> Iterator[Row]:
    """Of a machine, throw by throw."""
    for throw in design / "throws":
        radius, crank = (throw / "crank_radius_m").number(), direction((throw / "crank_angle_deg").double())
        for row in throw / "rows":
            rod = row / "connecting_rod"
            weight = row_masses(row)[0]
            ratio = over(radius, (rod / "length_m").number(), rod) if rod / "length_m" else ZERO
            where = (throw / "position_m").number() + (row / "offset_m").number(0.0)
            axis = direction((row / "axis_deg").double())
            yield Row(weight * radius, radius, crank, axis, ratio, where, row)
