"""What gas does to the piston of a row: the pressures in its chambers at a crank angle, in doubles.

A chamber is one side of a piston. Over its own travel y, from where it is smallest, and with its clearance as a travel
c, the gas goes through four processes. Or its pressure is a table over one or two revolutions, linear between entries.

    y grows:    p_d (c / (c + y))^m, but no less than p_s
    y shrinks:  p_s ((c + S) / (c + y))^n, but no more than p_d

A force is positive where it pulls at the rod: -p A on the head side, +p A on the crank side. Between two angles without
a kink y moves one way, and what is compressed is steepest where y is smallest.
"""

from __future__ import annotations

from bisect import bisect_right
from math import atan2, cos, degrees, expm1, log1p, pi, radians, sin, sqrt
from typing import Iterator, List, NamedTuple, Sequence, Tuple, Union

from verify_numbers import NotCovered, Place

TURN = 2 * pi
STATE = (
    "suction_pressure_Pa",
    "discharge_pressure_Pa",
    "relative_clearance",
    "expansion_exponent",
    "compression_exponent",
)
#: degrees by which a dead centre may be rounded where it is written down
ROUNDED = 1e-3


class Motion(NamedTuple):
    """A piston at its own crank angle [rad], which counts from the outer dead centre; lengths in crank radii."""

    own: float
    cosine: float
    sine: float
    leaning: float  # cosine of the angle of the rod
    tangent: float  # of the angle of the rod: force on the guide over piston force
    travel: float  # towards the shaft
    rest: float  # to the inner dead centre
    outward: float  # acceleration over r omega^2

    @property
    def turning(self) -> float:
        """Tangential force over piston force, and speed over r omega."""
        return self.sine + self.cosine * self.tangent

    @property
    def radial(self) -> float:
        """Radial force over piston force."""
        return self.cosine - self.sine * self.tangent


def motion(ratio: float, own: float) -> Motion:
    """At an angle, with a crank radius over a rod length."""
    cosine, sine = cos(own), sin(own)
    leaning = sqrt(1 - (ratio * sine) ** 2)
    outward = cosine + ratio * (cosine**2 - sine**2) / leaning + ratio**3 * (cosine * sine) ** 2 / leaning**3
    dip = ratio * sine**2 / (1 + leaning)
    travel, rest = 2 * sin(own / 2) ** 2 + dip, 2 * cos(own / 2) ** 2 - dip
    return Motion(own, cosine, sine, leaning, ratio * sine / leaning, travel, rest, outward)


class Slopes(NamedTuple):
    """What a pressure changes by at most: by its travel [Pa/m, Pa/m^2], or by the angle [Pa/rad]."""

    first: float
    second: float
    by_angle: float


FLAT = Slopes(0.0, 0.0, 0.0)


class Cycle(NamedTuple):
    """A chamber with four processes."""

    head: bool
    area: float
    low: float
    high: float
    clear: float  # m
    stroke: float
    expansion: float
    compression: float

    @property
    def most(self) -> float:
        """The largest pressure."""
        return self.high

    @property
    def pressures(self) -> List[float]:
        """Between the smallest and the largest of them are all others."""
        return [self.low, self.high]

    def _travel(self, piston: Motion) -> float:
        return (piston.travel if self.head else piston.rest) * self.stroke / 2

    def at(self, piston: Motion, to_shaft: bool) -> float:
        """The pressure; ``to_shaft``: which way the piston moves."""
        travel = self._travel(piston)
        if self.head == to_shaft:
            return max(self.high * (self.clear / (self.clear + travel)) ** self.expansion, self.low)
        return min(self.low * ((self.clear + self.stroke) / (self.clear + travel)) ** self.compression, self.high)

    def slopes(self, first: Motion, last: Motion, to_shaft: bool) -> Slopes:
        """Between two angles, which no process ends between."""
        near, far = sorted((first, last), key=self._travel)
        pressure, exponent = self.at(near, to_shaft), self.expansion
        length = self.clear + self._travel(near)
        if self.head == to_shaft:
            if pressure <= self.low:
                return FLAT
        else:
            if self.at(far, to_shaft) >= self.high:
                return FLAT
            exponent = self.compression
            # what is let out is not compressed any more
            least = (self.clear + self.stroke) * (self.low / self.high) ** (1 / exponent)
            length = max(length, least)
        slope = exponent * pressure / length
        return Slopes(slope, (exponent + 1) * slope / length, 0.0)

    def breaks(self, ratio: float) -> Tuple[float, float]:
        """Own angles at which suction and discharge open [rad]."""
        grown = log1p((self.high - self.low) / self.low)
        opens = self.clear * expm1(grown / self.expansion)
        travel = -(self.stroke + self.clear) * expm1(-grown / self.compression)
        # of the former how far it is from the smallest volume, of the latter how far from the largest
        suction = _angle(ratio, opens, self.stroke - opens, self.stroke, self.head)
        discharge = _angle(ratio, self.stroke - travel, travel, self.stroke, self.head)
        return (suction, TURN - discharge) if self.head else (TURN - suction, discharge)


def _angle(ratio: float, travel: float, rest: float, stroke: float, head: bool) -> float:
    """Own angle [rad], up to half a revolution, at which a chamber has gone through a travel (law of cosines)."""
    t, u = (max(2 * distance / stroke, 0.0) for distance in ((travel, rest) if head else (rest, travel)))
    return 2 * atan2(sqrt(t * (2 * (1 - ratio) + ratio * u)), sqrt(u * (2 + ratio * u)))


class Table(NamedTuple):
    """A chamber with a pressure as indicated, from its own angle ``lead`` on; steady where it has one entry."""

    head: bool
    area: float
    angles: List[float]  # rad, from at most 0 to at least the end of the cycle
    pressures: List[float]
    turns: int = 1
    lead: float = 0.0

    @property
    def most(self) -> float:
        """The largest pressure."""
        return max(map(abs, self.pressures))

    def at(self, piston: Motion, to_shaft: bool) -> float:
        """The pressure."""
        if len(self.angles) == 1:
            return self.pressures[0]
        place = (piston.own - self.lead) % (TURN * self.turns)
        k = self._entry(place)
        return self.pressures[k] + self._slope(k) * (place - self.angles[k])

    def _entry(self, place: float) -> int:
        return min(max(bisect_right(self.angles, place) - 1, 0), len(self.angles) - 2)

    def _slope(self, k: int) -> float:
        step = self.angles[k + 1] - self.angles[k]
        return (self.pressures[k + 1] - self.pressures[k]) / step if step > 0 else 0.0

    def slopes(self, first: Motion, last: Motion, to_shaft: bool) -> Slopes:
        """Between two angles, which no entry is between."""
        if len(self.angles) == 1:
            return FLAT
        middle = ((first.own + last.own) / 2 - self.lead) % (TURN * self.turns)
        return Slopes(0.0, 0.0, abs(self._slope(self._entry(middle))))

    def breaks(self, ratio: float) -> List[float]:
        """Own angles of its entries, within its cycle."""
        return [angle + self.lead for angle in self.angles[1:-1]]


Chamber = Union[Cycle, Table]


def chambers(row: Place, stroke: float, ahead: float) -> Iterator[Chamber]:
    """Of the cylinders of a row, head and crank side of each.

    Parameters
    ----------
    ahead : own angle of the row at shaft angle 0 [rad].
    """
    cylinders = [row / "cylinder"] if row / "cylinder" else list(row / "cylinders")
    for cylinder in cylinders:
        for side in ("head", "crank"):
            yield _chamber(cylinder, side, stroke, ahead)


def _chamber(cylinder: Place, side: str, stroke: float, ahead: float) -> Chamber:
    area, record = _area(cylinder, side), cylinder / "pressure"
    if record / side:
        turns = (record / "cycle_turns").whole(1.0)
        # else from the first outer dead centre of the row
        first = degrees(-ahead) % 360
        start = radians((record / "dead_centre_deg").double(0.0 if first > 360 - ROUNDED else first))
        return _table(record / side, side == "head", area, turns, TURN * round((start + ahead) / TURN))
    if not (_acts(cylinder, side) and area > 0):
        ambient = (cylinder / "ambient_pressure_Pa").double() if area > 0 else 0.0
        return Table(side == "head", area, [0.0], [ambient])
    low, high, clearance, expansion, compression = (_value(cylinder, side, name).double() for name in STATE)
    if min(low, clearance, expansion - 1, compression - 1) <= 0 or high < low:
        raise NotCovered(cylinder)
    return Cycle(side == "head", area, low, high, clearance * stroke, stroke, expansion, compression)


def _table(place: Place, head: bool, area: float, turns: int, lead: float) -> Table:
    angles = [radians(entry.double()) for entry in place / "angle_deg"]
    pressures = [entry.double() for entry in place / "pressure_Pa"]
    if len(angles) < 3 or len(angles) != len(pressures) or turns not in (1, 2) or sorted(angles) != angles:
        raise NotCovered(place)
    cycle = TURN * turns
    # from an entry of the cycle before to one of the next
    angles = [angles[-1] - cycle, *angles, angles[0] + cycle]
    return Table(head, area, angles, [pressures[-1], *pressures, pressures[0]], turns, lead)


def _value(cylinder: Place, side: str, name: str) -> Place:
    own = cylinder / side / name
    return own if own else cylinder / name


def _acts(cylinder: Place, side: str) -> bool:
    """Whether a side compresses gas."""
    acting = (cylinder / "acting").text("double", "head", "crank", default="") if cylinder / "acting" else ""
    if acting:
        return acting in ("double", side)
    state = any(_value(cylinder, side, name) for name in STATE)
    return bool(cylinder / "pressure" / side) or not cylinder / "pressure" or state


def _area(cylinder: Place, side: str) -> float:
    if not cylinder / "bore_m":
        return (cylinder / f"{side}_area_m2").double(least=0)
    bore = (cylinder / "bore_m").double(least=0)
    if side == "head":
        return pi / 4 * bore**2
    rod = cylinder / "piston_rod_diameter_m"
    # a trunk piston is open to the crankcase
    trunk = cylinder / "pressure" and not rod and not _acts(cylinder, side)
    diameter = 0.0 if trunk else rod.double(least=0)
    return pi / 4 * (bore - diameter) * (bore + diameter)


def force(chamber: Chamber, pressure: float) -> float:
    """On the piston, N."""
    return -pressure * chamber.area if chamber.head else pressure * chamber.area


def gauss(count: int) -> Sequence[Tuple[float, float]]:
    """Places in [0, 1] and shares of the quadrature of Gauss and Legendre: roots of P_n by Newton's method."""
    nodes = []
    for k in range(count):
        x = cos(pi * (k + 0.75) / (count + 0.5))
        for _ in range(20):
            before, value = 1.0, x
            for n in range(2, count + 1):
                before, value = value, ((2 * n - 1) * x * value - (n - 1) * before) / n
            slope = count * (x * value - before) / (x * x - 1)
            x -= value / slope
        nodes.append(((1 + x) / 2, 1 / ((1 - x * x) * slope * slope)))
    return nodes
