"""Checks an answer of the service against its request, from the two files alone.

    python verify.py request.json answer.json

One file, the standard library, Python 3.8 or newer; nothing of the service is imported. Machine, limits, values and
bounds are evaluated anew from the doubles in the files, in intervals of whole numbers times powers of two that
enclose every square root, sine and cosine. So "held" and "broken" are proven; what lies between, or what this file does
not know, is "not covered". What is claimed, and which formulas stand here, is in docs/verify.md.

Exit code 0: nothing is broken, 1: something is, 2: the files cannot be read.
"""

from __future__ import annotations

import json
import re
import sys
from decimal import Decimal
from fractions import Fraction
from functools import lru_cache
from math import inf, isfinite, isqrt, ldexp
from pathlib import Path
from typing import Any, Callable, Iterator, NamedTuple, Sequence

# ---- what is allowed, and why

#: of the sum of the magnitudes that a figure is made of: figures, and the data that bounds stand on, are doubles
ROUNDING = 1e-14
#: of a limit on masses: the masses are rounded
MASS = 1e-12
#: degrees: so are angles, at up to 360 degrees
ANGLE = 1e-12
#: of the larger of a ceiling and what is there without counterweights: what an answer may exceed a ceiling by
CEILING = 1e-9
#: largest mass_relative_gap of an optimal answer
MASS_GAP = 1e-4
#: in the unit of the figure: what is smaller than doubles can tell from 0
NOTHING = 1e-230

HELD, BROKEN, NOT_COVERED = "held", "broken", "not covered"
#: an answer is held if these claims are, as far as they are made
CENTRAL = (
    "counterweights",
    "max_mass",
    "sector",
    "max_total_mass",
    "ceilings",
    "objective",
    "lower_bound",
    "corner",
    "conflict",
    "request",
)

# ---- numbers

#: digits of an enclosure, and of angles, in bits
BITS, FINE = 192, 224
PI = int("314159265358979323846264338327950288419716939937510582097494459230781640628620899")
PI_FINE = (PI << FINE) // 10**80


class Real:
    """A number that lies in [low, high] 2^power."""

    __slots__ = ("high", "low", "power")

    def __init__(self, low: int, high: int, power: int = 0) -> None:
        extra = max(low.bit_length(), high.bit_length()) - BITS
        if extra > 0:
            low, high, power = low >> extra, -(-high >> extra), power + extra
        self.low, self.high, self.power = low, high, power

    def shifts(self, other: Real) -> tuple[int, int, int]:
        """The common power, and by how much to shift both."""
        power = min(self.power, other.power)
        return power, self.power - power, other.power - power

    def __add__(self, other: Real) -> Real:
        power, i, j = self.shifts(other)
        return Real((self.low << i) + (other.low << j), (self.high << i) + (other.high << j), power)

    def __sub__(self, other: Real) -> Real:
        power, i, j = self.shifts(other)
        return Real((self.low << i) - (other.high << j), (self.high << i) - (other.low << j), power)

    def __neg__(self) -> Real:
        return Real(-self.high, -self.low, self.power)

    def __abs__(self) -> Real:
        if self.low >= 0:
            return self
        return -self if self.high <= 0 else Real(0, max(-self.low, self.high), self.power)

    def __mul__(self, other: Real) -> Real:
        power = self.power + other.power
        if self.low >= 0 and other.low >= 0:
            return Real(self.low * other.low, self.high * other.high, power)
        ends = [a * b for a in (self.low, self.high) for b in (other.low, other.high)]
        return Real(min(ends), max(ends), power)

    def __truediv__(self, other: Real) -> Real:
        """By a number above 0."""
        one = 1 << 2 * BITS
        return self * Real(one // other.high, -(-one // other.low), -2 * BITS - other.power)

    def root(self) -> Real:
        low, high = max(self.low, 0), max(self.high, 0)
        shift = max(0, 2 * BITS - high.bit_length())
        shift += (self.power - shift) % 2
        return Real(isqrt(low << shift), isqrt(high << shift) + (high > 0), (self.power - shift) // 2)

    def at_most(self, other: Real) -> bool:
        """Whether this is proven; ``not a.at_most(b)`` does not prove that a is larger."""
        return (other - self).low >= 0

    def positive_part(self) -> Real:
        return Real(max(self.low, 0), max(self.high, 0), self.power)

    def __float__(self) -> float:
        """The lower end, to the digits of a double."""
        extra = max(0, self.low.bit_length() - 64)
        try:
            return ldexp(self.low >> extra, self.power + extra)
        except OverflowError:
            return sys.float_info.max if self.low > 0 else -sys.float_info.max


def real(number: float | int) -> Real:
    top, bottom = number.as_integer_ratio()
    return Real(top, top, 1 - bottom.bit_length())


def larger(one: Real, other: Real) -> Real:
    power, i, j = one.shifts(other)
    return Real(max(one.low << i, other.low << j), max(one.high << i, other.high << j), power)


def total(numbers: Sequence[Real]) -> Real:
    found = ZERO
    for one in numbers:
        found = found + one
    return found


ZERO, ONE, HALF = real(0), real(1), real(0.5)
RADIAN = Real(PI, PI + 1) / (real(180) * Real(10**80, 10**80))


class Vector:
    """A vector across the shaft, x + jy."""

    __slots__ = ("x", "y")

    def __init__(self, x: Real, y: Real) -> None:
        self.x, self.y = x, y

    def __add__(self, other: Vector) -> Vector:
        return Vector(self.x + other.x, self.y + other.y)

    def __sub__(self, other: Vector) -> Vector:
        return Vector(self.x - other.x, self.y - other.y)

    def __mul__(self, factor: Real) -> Vector:
        return Vector(self.x * factor, self.y * factor)

    def turned(self, by: Vector) -> Vector:
        """The product of two complex numbers."""
        return Vector(self.x * by.x - self.y * by.y, self.x * by.y + self.y * by.x)

    def mirrored(self) -> Vector:
        return Vector(self.x, -self.y)

    def along(self, other: Vector) -> Real:
        """Re(conj(self) other)."""
        return self.x * other.x + self.y * other.y

    def __abs__(self) -> Real:
        x, y = abs(self.x), abs(self.y)
        return (x * x + y * y).root()


NOWHERE = Vector(ZERO, ZERO)


@lru_cache(maxsize=4096)
def direction(degrees: float) -> Vector:
    """Unit vector of an angle, reduced exactly and summed as a series of whole numbers of 2^-FINE.

    The angle is off by 2 of these at most and every term by less than 6, 60 terms together by less than 2^10.
    """
    top, bottom = degrees.as_integer_ratio()
    quarter, rest = divmod(top % (360 * bottom), 90 * bottom)
    angle = rest * PI_FINE // (180 * bottom)
    sums, term, n = [0, 0], 1 << FINE, 0
    while term:
        sums[n % 2] += term if n % 4 < 2 else -term
        n += 1
        term = term * angle // (n << FINE)
    slack = 1 << 10 if rest else 0
    vector = Vector(*(Real(one - slack, one + slack, -FINE) for one in sums))
    for _ in range(quarter):
        vector = Vector(-vector.y, vector.x)
    return vector


# ---- reading

#: units that a string may have, by the unit of the field
_LBF = Decimal("4.4482216152605")
_PI = Decimal("3.14159265358979323846264338327950288")
UNITS: dict[str, dict[str, Fraction]] = {
    suffix: {name: Fraction(str(value)) for name, value in units.items()}
    for suffix, units in {
        "m": {"m": 1, "cm": Decimal("0.01"), "mm": Decimal("0.001"), "in": Decimal("0.0254"), "ft": Decimal("0.3048")},
        "kg": {"kg": 1, "g": Decimal("0.001"), "t": 1000, "lb": Decimal("0.45359237")},
        "deg": {"deg": 1, "rad": 180 / Fraction(_PI)},
        "rpm": {"rpm": 1, "rad/s": 30 / Fraction(_PI), "Hz": 60},
        "N": {"N": 1, "kN": 1000, "lbf": _LBF},
        "Nm": {"N m": 1, "N mm": Decimal("0.001"), "lbf ft": _LBF * Decimal("0.3048")},
    }.items()
}
_QUANTITY = re.compile(r"\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d{1,3})?)\s*([A-Za-z][A-Za-z/ ]*?)\s*", re.ASCII)


class Unreadable(ValueError):
    """Request or answer is not what the service takes or gives; ``path`` names the field."""

    def __init__(self, path: Sequence[str | int], message: str) -> None:
        super().__init__(f"{pointer(path)}: {message}")
        self.path, self.message = tuple(path), message


class NotCovered(Exception):
    """Something that changes what is to be checked, and that this file does not know."""


def pointer(path: Sequence[str | int]) -> str:
    """JSON pointer (RFC 6901), printable whatever the names in it are, and not for ever."""
    found = "".join("/" + str(part).replace("~", "~0").replace("/", "~1") for part in path)
    return found[:200].encode("utf-8", "backslashreplace").decode()


class Place:
    """A value in one of the files, and where it stands."""

    __slots__ = ("path", "value")

    def __init__(self, value: Any, *path: str | int) -> None:
        self.value, self.path = value, path

    def __truediv__(self, name: str) -> Place:
        """A field, None where it is not there."""
        if self.value is not None and not isinstance(self.value, dict):
            raise Unreadable(self.path, "must be an object")
        return Place((self.value or {}).get(name), *self.path, name)

    def __bool__(self) -> bool:
        return self.value is not None

    def __iter__(self) -> Iterator[Place]:
        if not isinstance(self.value, (list, tuple, type(None))):
            raise Unreadable(self.path, "must be a list")
        return (Place(one, *self.path, index) for index, one in enumerate(self.value or ()))

    def text(self, *allowed: str, default: str | None = None) -> str:
        found = default if self.value is None else self.value
        if not isinstance(found, str) or (allowed and found not in allowed):
            raise Unreadable(self.path, f"must be one of {', '.join(allowed)}" if allowed else "must be a text")
        return found

    def flag(self, default: bool) -> bool:
        if not isinstance(self.value, (bool, type(None))):
            raise Unreadable(self.path, "must be true or false")
        return default if self.value is None else self.value

    def double(self, default: float | None = None, least: float = -inf) -> float:
        """The number as a double; a text with a unit is read in the request, to the nearest double."""
        found = default if self.value is None else self.value
        if isinstance(found, str) and self.path[0] == "request":
            found = self._quantity(found)
        if isinstance(found, bool) or not isinstance(found, (int, float)):
            raise Unreadable(self.path, "must be a number")
        try:
            found = float(found)
        except OverflowError:
            found = inf
        if not isfinite(found) or found < least:
            raise Unreadable(self.path, "must be a finite number" + (f" of at least {least:g}" if least > -inf else ""))
        return found

    def number(self, default: float | None = None, least: float = -inf) -> Real:
        return real(self.double(default, least))

    def vector(self) -> Vector:
        return Vector((self / "x").number(), (self / "y").number())

    def _quantity(self, text: str) -> float:
        # of a list, the name of the list
        name = next(str(part) for part in reversed(self.path) if isinstance(part, str))
        units = UNITS.get(name.rpartition("_")[2], {})
        match = _QUANTITY.fullmatch(text) if len(text) <= 48 else None
        symbol = " ".join(match.group(2).split()) if match else ""
        if match is None or symbol not in units:
            raise Unreadable(self.path, "must be a number, or a text with one of the units " + ", ".join(units))
        try:
            return float(Fraction(Decimal(match.group(1))) * units[symbol])
        except OverflowError:
            return inf


def known(place: Place, *names: str) -> None:
    """Fields that are not named must hold nothing.

    Raises
    ------
    NotCovered
    """
    if place and not isinstance(place.value, dict):
        raise Unreadable(place.path, "must be an object")
    for name in place.value or ():
        if name not in names and (place / str(name)).value not in (None, [], {}, ()):
            raise NotCovered(pointer((*place.path, name)))


# ---- the machine and its program


class Web(NamedTuple):
    """A place for a counterweight."""

    name: str
    arm: Real  # m from the reference plane
    radius: Real
    limit: Real | None  # kg, None without
    sector: tuple[float, float] | None  # centre and half-angle, degrees
    size: Real  # m, what the arm is the difference of


class Response(NamedTuple):
    """First-order force [N] or moment [N m]: phasors that turn with and against the shaft."""

    co: Vector
    counter: Vector
    size: Real  # the magnitudes that they are the sum of

    def weighted(self, weight: Real, x: Real, y: Real) -> tuple[Real, list[tuple[str, Vector, Real]]]:
        """Its weighted peak: a floor, and terms (part, vector, factor of co in it)."""
        p, q, b = weight * (x + y) * HALF, weight * (x - y) * HALF, self.counter.mirrored()
        if q.low == q.high == 0:
            return p * abs(b), [("co", self.co * p, p)]
        return ZERO, [("co", self.co * p + b * q, p), ("counter", self.co * q + b * p, q)]


class Machine:
    """A machine in the units of the answer."""

    def __init__(self, place: Place, plane: Place, budget: Place) -> None:
        kind = (place / "kind").text("reciprocating", "scroll")
        known(place, *_MACHINE, *(_RECIPROCATING if kind == "reciprocating" else _SCROLL))
        (place / "rotation").text("ccw", "cw", default="ccw")
        omega = (place / "speed_rpm").number(least=0) * real(6) * RADIAN
        self.square = omega * omega
        masses, planes, ends = (_reciprocating if kind == "reciprocating" else _scroll)(place)
        #: where the machine says that moments are, or midway; and where the answer says so, which is then used
        self.asked_plane = (place / "reference_plane_m").double(0.5 * (min(planes) + max(planes)))
        self.plane = plane.number(self.asked_plane)
        self.responses = {name: self._sum(masses, name == "moment") for name in ("force", "moment")}
        self.webs = [self._web(web) for web in place / "webs"]
        if len({web.name for web in self.webs}) < len(self.webs):
            raise Unreadable((*place.path, "webs"), "names must be unique")
        self.budget = budget.number(least=0) if budget else None
        self.parts = len(masses) + len(self.webs)
        planes = [*ends, *((web / "position_m").double() for web in place / "webs")]
        span = real(max(planes)) - real(min(planes))
        self.span = ONE if span.at_most(real(NOTHING)) else span

    def _sum(self, masses: Sequence[Mass], moment: bool) -> Response:
        co, counter, size = NOWHERE, NOWHERE, ZERO
        for mass in masses:
            arm = (mass.position - self.plane if moment else ONE) * self.square
            co, counter = co + mass.co * arm, counter + mass.counter * arm
            size = size + mass.size * self.square * (mass.reach + abs(self.plane) if moment else ONE)
        return Response(co, counter, size)

    def _web(self, place: Place) -> Web:
        known(place, "name", "position_m", "counterweight_radius_m", "max_mass_kg", "sector", "throw")
        position, most, sector = (place / "position_m").number(), place / "max_mass_kg", place / "sector"
        return Web(
            (place / "name").text(),
            position - self.plane,
            (place / "counterweight_radius_m").number(least=0),
            most.number(least=0) if most else None,
            ((sector / "centre_deg").double(), (sector / "half_angle_deg").double(least=0)) if sector else None,
            abs(position) + abs(self.plane),
        )

    def with_unbalance(self, unbalance: Sequence[Vector]) -> dict[str, Response]:
        """Force and moment with counterweights (webs,) kg m."""
        force, moment = self.responses["force"], self.responses["moment"]
        for web, u in zip(self.webs, unbalance):
            u = u * self.square
            force = Response(force.co + u, force.counter, force.size + abs(u))
            moment = Response(moment.co + u * web.arm, moment.counter, moment.size + abs(u) * web.size)
        return {"force": force, "moment": moment}


_MACHINE = ("kind", "name", "description", "speed_rpm", "rotation", "reference_plane_m", "webs", "max_total_mass_kg")
_RECIPROCATING = ("throws", "friction", "flywheel", "bearings")
_SCROLL = (
    "orbit_radius_m",
    "orbiting_mass_kg",
    "orbiting_position_m",
    "anti_rotation",
    "rotation_torque_Nm",
    "tangential_gas_force_N",
    "drive_bearing",
)


class Mass(NamedTuple):
    """What a mass adds to the first order, kg m."""

    co: Vector
    counter: Vector
    position: Real
    size: Real  # kg m
    reach: Real  # m, the sum of what the position is made of


def _turning(mass: Real, radius: Real, crank: Vector, position: Real, reach: Real) -> Mass:
    return Mass(crank * (mass * radius), NOWHERE, position, mass * radius, reach)


def _moving(mass: Real, radius: Real, crank: Vector, axis: Vector, position: Real, reach: Real) -> Mass:
    """m r / 2 along e^{jd}, and along e^{j(2g - d)} against the shaft."""
    half = mass * radius * HALF
    return Mass(crank * half, axis.turned(axis).turned(crank.mirrored()) * half, position, mass * radius, reach)


def _reciprocating(place: Place) -> tuple[list[Mass], list[float], list[float]]:
    """Masses, planes whose middle is the default reference, and planes that the span counts."""
    masses, planes = [], []
    for throw in place / "throws":
        known(throw, "name", "position_m", "crank_radius_m", "crank_angle_deg", "rotating_mass_kg", "rows")
        radius, crank = (throw / "crank_radius_m").number(), direction((throw / "crank_angle_deg").double())
        planes.append((throw / "position_m").double())
        plane = real(planes[-1])
        masses.append(_turning((throw / "rotating_mass_kg").number(0.0), radius, crank, plane, abs(plane)))
        for row in throw / "rows":
            rows = ("axis_deg", "offset_m", "reciprocating_mass_kg", "connecting_rod", "cylinder", "cylinders")
            known(row, "name", *rows)
            rod, offset = row / "connecting_rod", (row / "offset_m").number(0.0)
            known(rod, "length_m", "mass_kg", "reciprocating_share")
            share = (rod / "reciprocating_share").number(1 / 3)
            weight = (rod / "mass_kg").number(0.0) if rod else ZERO
            moving = (row / "reciprocating_mass_kg").number() + share * weight
            axis, where, reach = direction((row / "axis_deg").double()), plane + offset, abs(plane) + abs(offset)
            masses.append(_moving(moving, radius, crank, axis, where, reach))
            masses.append(_turning((ONE - share) * weight, radius, crank, where, reach))
    if not planes:
        raise Unreadable((*place.path, "throws"), "must hold at least one item")
    return masses, planes, planes


def _scroll(place: Place) -> tuple[list[Mass], list[float], list[float]]:
    orbit, crank = (place / "orbit_radius_m").number(), direction(0.0)
    guide, planes = place / "anti_rotation", [(place / name).double() for name in ("orbiting_position_m",)]
    ends = [*planes, (guide / "position_m").double()]
    own, other = map(real, ends)
    masses = [_turning((place / "orbiting_mass_kg").number(), orbit, crank, own, abs(own))]
    if (guide / "type").text("oldham", "crank_pins") == "oldham":
        # it slides with the projection of the orbit: a crank with an infinite rod
        axis = direction((guide / "axis_deg").double())
        masses.append(_moving((guide / "mass_kg").number(), orbit, crank, axis, other, abs(other)))
    else:
        mass = (guide / "count").number() * (guide / "eccentric_mass_kg").number(0.0)
        masses.append(_turning(mass, orbit, crank, other, abs(other)))
    return masses, planes, ends


class Program:
    """What is to be small, under which ceilings; rows, terms and ceilings go by their names in the answer."""

    def __init__(self, machine: Machine, objective: Place) -> None:
        self.machine = machine
        across = objective / "direction_weights"
        self.x, self.y = ((across / name).number(1.0, least=0) for name in ("x", "y"))
        self.floor: dict[str, Real] = {}
        self.size: dict[str, Real] = {}
        self.terms: dict[tuple[str, str], tuple[str, Vector, Real]] = {}
        self.ceilings: dict[str, tuple[Response, Real]] = {}
        for name, field in (("force", "force_ceiling_N"), ("moment", "moment_ceiling_Nm")):
            if objective / field:
                response = machine.responses[name]
                self.ceilings[name] = response, (objective / field).number(least=0) - abs(response.counter)

    def with_row(self, name: str, responses: dict[str, Real]) -> Program:
        """One more row: a sum of peaks with these weights."""
        self.floor[name], self.size[name] = ZERO, ZERO
        for which, weight in responses.items():
            response = self.machine.responses[which]
            floor, terms = response.weighted(weight, self.x, self.y)
            self.floor[name] = self.floor[name] + floor
            self.size[name] = self.size[name] + response.size * weight * larger(self.x, self.y)
            self.terms.update({(which, part): (name, vector, factor) for part, vector, factor in terms})
        return self

    def value(self, responses: dict[str, Response], weights: dict[str, Real], combine: str) -> tuple[Real, Real]:
        """The weighted peaks put together, and the size of what they are made of."""
        value, size = ZERO, ZERO
        for name, weight in weights.items():
            floor, terms = responses[name].weighted(weight, self.x, self.y)
            peak = total([floor, *(abs(vector) for _, vector, _ in terms)])
            value = larger(value, peak) if combine == "max" else value + peak
            size = size + responses[name].size * weight * larger(self.x, self.y)
        return value, size

    def without_ceilings(self) -> Program:
        self.ceilings = {}
        return self

    def bound(self, multipliers: Place, limits: Sequence[Real | None], cost: Real, conflict: bool = False) -> Bound:
        """The Lagrangian at its smallest over the limits, docs/mathematics.md section 5."""
        row = {(one / "name").text(): (one / "value").number(least=0) for one in multipliers / "rows"}
        row = {name: value for name, value in row.items() if value.high > 0}
        if not {*row} <= {*(self.ceilings if conflict else self.floor)}:
            raise NotCovered(pointer((*multipliers.path, "rows")))
        constant, noise, slope = ZERO, ZERO, {"force": NOWHERE, "moment": NOWHERE}
        for name in self.floor:
            constant = constant + row.get(name, ZERO) * self.floor[name]
            noise = noise + row.get(name, ZERO) * self.size[name]
        sums: dict[tuple[str, str], Vector] = {}
        for term in multipliers / "terms":
            vector = term.vector()
            if abs(vector).high > 0:
                key = _plain(term, self.terms)
                sums[key] = sums.get(key, NOWHERE) + vector
        for (which, part), vector in sums.items():
            name, start, factor = self.terms[which, part]
            y = shortened(vector, row.get(name, ZERO))
            constant, slope[which] = constant + y.along(start), slope[which] + y * factor
        prices = dict.fromkeys(self.ceilings, NOWHERE)
        for ceiling in multipliers / "ceilings":
            which, _ = _plain(ceiling, {(name, "co"): None for name in self.ceilings})
            prices[which] = prices[which] + ceiling.vector()
        for which, price in prices.items():
            response, cap = self.ceilings[which]
            size = row.get(which, ZERO) if conflict else abs(price)
            price = shortened(price, size)
            constant, slope[which] = constant + price.along(response.co) - size * cap, slope[which] + price
            noise = noise + size * response.size
        spent = (multipliers / "budget").number(0.0, least=0) if self.machine.budget else ZERO
        least = self._least(slope, limits, cost + spent)
        if least is not None and self.machine.budget:
            least = least - spent * self.machine.budget
        return Bound(None if least is None else constant + least, row, noise * real(ROUNDING))

    def _least(self, slope: dict[str, Vector], limits: Sequence[Real | None], cost: Real) -> Real | None:
        """- sum_k M_k max(R_k sigma_k - cost, 0); None without end."""
        loss, budget = ZERO, self.machine.budget
        for web, limit in zip(self.machine.webs, limits):
            pull = (slope["force"] + slope["moment"] * web.arm) * -self.machine.square
            gain = (web.radius * support(pull, web.sector) - cost).positive_part()
            if budget is not None:
                limit = budget if limit is None or budget.at_most(limit) else limit
            if gain.high > 0:
                if limit is None:
                    return None
                loss = loss + gain * limit
        return -loss


class Bound(NamedTuple):
    """What multipliers prove: rows times objective >= least."""

    least: Real | None
    row: dict[str, Real]
    noise: Real  # what the rounding of the machine's own data may have changed


def _plain(place: Place, names: Any) -> tuple[str, str]:
    key = (place / "response").text(), (place / "part").text(default="co")
    if key not in names or place / "angle_deg" or place / "scenario":
        raise NotCovered(pointer(place.path))
    return key


def shortened(vector: Vector, most: Real) -> Vector:
    """The vector, or one in its direction that is no longer than allowed."""
    size = abs(vector)
    if size.at_most(most):
        return vector
    if size.low <= 0:
        return NOWHERE
    share = most / size
    return vector * Real(max(share.low, 0), max(share.low, 0), share.power)


def support(pull: Vector, sector: tuple[float, float] | None) -> Real:
    """Largest Re(conj(pull) v) over unit-disc vectors v in the sector, or somewhat more."""
    if sector is None:
        return abs(pull)
    turned, edge = pull.turned(direction(sector[0]).mirrored()), direction(sector[1])
    across = abs(turned.y)
    if not (turned.x * edge.y).at_most(across * edge.x):
        return abs(pull)
    return (turned.x * edge.x + across * edge.y).positive_part()


# ---- what is claimed


class Claims:
    """What became of every kind of claim; of several of one kind, the worst."""

    def __init__(self, most: float) -> None:
        self.found: dict[str, dict[str, Any]] = {}
        self.places = most

    def count(self, places: int, place: Place) -> None:
        """Masses and webs that are looked at: what bounds the work."""
        self.places -= places
        if self.places < 0:
            raise Unreadable(place.path, "holds more than is checked at a time")

    def put(self, claim: str, verdict: str, margin: float | None, place: Place) -> None:
        order = (HELD, NOT_COVERED, BROKEN)
        told = {"claim": claim, "verdict": verdict, "margin": margin, "where": pointer(place.path)}
        rank = (order.index(verdict), -inf if margin is None else -margin)
        former = self.found.get(claim)
        if former is None or rank > (order.index(former["verdict"]), -(former["margin"] or 0.0)):
            self.found[claim] = told

    def room(self, claim: str, room: Real, size: Real, place: Place) -> None:
        """Held where there is proven to be room, broken where there is proven to be none."""
        verdict = HELD if room.low >= 0 else BROKEN if room.high < 0 else NOT_COVERED
        self.put(claim, verdict, float(room / size) if size.low > 0 else float(room), place)

    def near(self, claim: str, place: Place, exact: Real, size: Real) -> None:
        """A figure is what it has to be, to the rounding of doubles of this size."""
        if not place:
            self.put(claim, NOT_COVERED, None, place)
            return
        size = larger(abs(size), abs(exact))
        self.room(claim, size * real(ROUNDING) + real(NOTHING) - abs(place.number() - exact), size, place)

    def proven(self, claim: str, place: Place, bound: Bound | None, said: Real, size: Real) -> None:
        """What is said is not above what multipliers prove."""
        if bound is None or not place:
            self.put(claim, NOT_COVERED, None, place)
        elif bound.least is None:
            self.put(claim, BROKEN, None, place)
        else:
            self.room(claim, bound.least - said + bound.noise, size, place)

    def answer(self) -> dict[str, Any]:
        claims = list(self.found.values())
        central = [one["verdict"] for one in claims if one["claim"] in CENTRAL]
        if any(one["verdict"] == BROKEN for one in claims):
            verdict = BROKEN
        else:
            verdict = HELD if central and {*central} == {HELD} else NOT_COVERED
        return {"claims": claims, "verdict": verdict}


_FIGURES: tuple[tuple[str, Callable[[Response], Real]], ...] = (
    ("peak", lambda one: abs(one.co) + abs(one.counter)),
    ("minor", lambda one: abs(abs(one.co) - abs(one.counter))),
    ("peak_x", lambda one: abs(one.co + one.counter.mirrored())),
    ("peak_y", lambda one: abs(one.co - one.counter.mirrored())),
    ("co_rotating", lambda one: abs(one.co)),
    ("counter_rotating", lambda one: abs(one.counter)),
)
_UNITS = {"force": "N", "moment": "Nm"}


def check_first_order(claims: Claims, claim: str, place: Place, responses: dict[str, Response]) -> None:
    for name, response in responses.items():
        for figure, evaluate in _FIGURES:
            said = place / name / f"{figure}_{_UNITS[name]}"
            if said:
                claims.near(claim, said, evaluate(response), response.size)
        axis = place / name / "major_axis_deg"
        product, noise = response.co.turned(response.counter), response.size * real(ROUNDING) + real(NOTHING)
        if axis and not (abs(response.co).at_most(noise) or abs(response.counter).at_most(noise)):
            middle = direction(axis.double())
            off = abs(product - middle.turned(middle) * abs(product))
            allowed = noise * (abs(response.co) + abs(response.counter)) + abs(product) * real(4 * ROUNDING)
            claims.room(claim, allowed - off, abs(product), axis)


def check_counterweights(claims: Claims, machine: Machine, place: Place) -> tuple[list[Vector], Real]:
    """Their consistency and the limits of the webs; the unbalances that they make [kg m], and their total mass."""
    claims.count(len(machine.webs) + 5, place)
    weights = list(place)
    names = [(one / "web").text() for one in weights]
    claims.put("counterweights", HELD if names == [web.name for web in machine.webs] else BROKEN, None, place)
    by_name, unbalance, masses = dict(zip(names, weights)), [], []
    for web in machine.webs:
        one = by_name.get(web.name, Place({"mass_kg": 0.0, "angle_deg": 0.0}, *place.path))
        mass, angle = (one / "mass_kg").number(), (one / "angle_deg").double()
        product = mass * web.radius
        u = direction(angle) * product
        for field, exact in (("mass_radius_kg_m", product), ("x_kg_m", u.x), ("y_kg_m", u.y)):
            if one / field:
                claims.near("counterweights", one / field, exact, product)
        claims.room("max_mass", mass, abs(mass), one / "mass_kg")
        if web.limit is not None:
            claims.room("max_mass", web.limit * real(1 + MASS) - mass, web.limit, one / "mass_kg")
        if web.sector is not None and mass.high > 0:
            turn, (centre, half) = Fraction(360), web.sector
            off = abs((Fraction(angle) - Fraction(centre) + turn / 2) % turn - turn / 2)
            room = float(Fraction(half) + Fraction(ANGLE) - off)
            claims.put("sector", HELD if room >= 0 else BROKEN, room, one / "angle_deg")
        unbalance.append(u)
        masses.append(mass)
    mass = total(masses)
    if machine.budget is not None:
        claims.room("max_total_mass", machine.budget * real(1 + MASS) - mass, machine.budget, place)
    return unbalance, mass


def check_ceilings(claims: Claims, program: Program, after: dict[str, Response], place: Place, kept: bool) -> None:
    """``kept``: whether the answer says that they are."""
    for name, (before, cap) in program.ceilings.items():
        response = after[name]
        size, noise = larger(abs(before.co), abs(cap)), response.size * real(ROUNDING)
        if size.at_most(noise):
            size = response.size
        room = cap + size * real(CEILING) + noise - abs(response.co)
        if kept or room.low >= 0:
            claims.room("ceilings", room, size, place)
        else:
            claims.put("ceilings", NOT_COVERED, None, place)


def check_optimum(claims: Claims, request: Place, answer: Place) -> None:
    """The answer to one request: counterweights with their certificate, or the proof that there are none."""
    known(request, *_REQUEST)
    known(request / "objective", *_OBJECTIVE)
    (request / "objective" / "orders").text("first", default="first")
    status = (answer / "status").text("optimal", "inaccurate", "infeasible")
    asked, goal = request / "machine", request / "objective"
    machine = Machine(asked, answer / "reference_plane_m", asked / "max_total_mass_kg")
    claims.count(machine.parts + 5, answer)
    if answer / "reference_plane_m":
        plane = real(machine.asked_plane)
        claims.near("reference_plane", answer / "reference_plane_m", plane, plane)
    weights = {
        "force": (goal / "force_weight").number(1.0, least=0),
        "moment": (goal / "moment_weight").number(least=0) if goal / "moment_weight" else ONE / machine.span,
    }
    weights = {name: weight for name, weight in weights.items() if weight.high > 0}
    combine = (goal / "combine").text("sum", "max", default="sum")
    program = Program(machine, goal)
    for name, responses in {"sum": weights}.items() if combine == "sum" else ((n, {n: w}) for n, w in weights.items()):
        program.with_row(name, responses)
    if answer / "residual" / "before":
        check_first_order(claims, "before", answer / "residual" / "before", machine.responses)
    for name, response in machine.responses.items():
        if answer / "floor":
            floor = answer / "floor" / f"{name}_{_UNITS[name]}"
            claims.near("floor", floor, abs(response.counter), response.size)
    if status == "infeasible":
        check_infeasible(claims, program, goal, answer / "infeasibility")
        return

    unbalance, mass = check_counterweights(claims, machine, answer / "counterweights")
    claims.near("total_mass", answer / "total_mass_kg", mass, mass)
    after = machine.with_unbalance(unbalance)
    check_first_order(claims, "after", answer / "residual" / "after", after)
    check_ceilings(claims, program, after, answer / "counterweights", status == "optimal")
    proof = answer / "certificate"
    value, size = program.value(after, weights, combine)
    claims.near("objective", proof / "objective", value, size)
    rest = program.value(machine.responses, weights, combine)
    if proof / "objective_without_counterweights":
        claims.near("before", proof / "objective_without_counterweights", *rest)
    check_bounds(claims, program, request, proof, value, rest, mass, status == "optimal")


_REQUEST = ("machine", "objective", "accuracy", "outputs", "angles", "fidelity", "multipliers")
_PARETO = ("points", "total_mass_budgets_kg")
_OBJECTIVE = (
    "combine",
    "force_weight",
    "moment_weight",
    "direction_weights",
    "force_ceiling_N",
    "moment_ceiling_Nm",
    "least_mass",
    "orders",
    "symmetric",
)


def check_bounds(  # noqa: C901, PLR0912, PLR0915 - reads as docs/verify.md does, claim after claim
    claims: Claims,
    program: Program,
    request: Place,
    proof: Place,
    value: Real,
    rest: tuple[Real, Real],
    mass: Real,
    optimal: bool,
) -> None:
    """Lower bounds of objective and mass from their multipliers, gaps, and whether they make an optimum."""
    machine, names = program.machine, sorted(program.floor)
    objective, lowest, gap = (proof / name for name in ("objective", "lower_bound", "gap"))
    limits = reaches(machine, proof / "implied_max_mass_kg")
    multipliers = proof / "multipliers"
    size = total([program.size[name] for name in names])
    scale = (proof / "yardstick").number() if proof / "yardstick" else value
    if lowest:
        bound = program.bound(multipliers / "objective", limits, ZERO) if multipliers / "objective" else None
        said = lowest.number()
        # with no multipliers at all: every row is at least its floor
        floor = program.floor[names[0]] if len(names) == 1 else larger(*(program.floor[name] for name in names))
        if said.at_most(floor):
            claims.room("lower_bound", floor - said, scale, lowest)
        else:
            lam = ZERO if bound is None else total([*bound.row.values()])
            if lam.low <= 0:
                bound = None
            claims.proven("lower_bound", lowest, bound, said * lam, scale * lam if bound else ONE)
    else:
        claims.put("lower_bound", NOT_COVERED, None, lowest)
    both = abs(objective.number(0.0)) + abs(lowest.number(0.0))
    noise = both * real(ROUNDING)
    if gap:
        claims.near("gap", gap, objective.number(0.0) - lowest.number(0.0), both)
    difference = objective.number(0.0) - lowest.number(0.0)
    if proof / "yardstick":
        check_yardstick(claims, program, proof / "yardstick", rest, limits)
        share = proof / "relative_gap"
        if share:
            claims.room("relative_gap", noise - abs(share.number() * scale - difference), both, share)
    goal, accuracy = request / "objective", request / "accuracy"
    lightest, least = (goal / "least_mass").flag(True), proof / "mass_lower_bound_kg"
    if lightest and least:
        most = proof / "mass_objective_limit"
        bound = program.bound(multipliers / "mass", limits, ONE) if multipliers / "mass" and most else None
        if least.double() <= 0:
            claims.put("mass_lower_bound", HELD, 0.0, least)
        else:
            price = total([*bound.row.values()]) if bound else ZERO
            said = least.number() + price * most.number(0.0)
            claims.proven("mass_lower_bound", least, bound, said, mass)
            if most:
                claims.room("mass_lower_bound", most.number() + size * real(ROUNDING) - value, scale, most)
        share = proof / "mass_relative_gap"
        if share:
            claims.near("mass_gap", share, (mass - least.number()) / mass if mass.low > 0 else ZERO, ONE)
    elif lightest:
        claims.put("mass_lower_bound", NOT_COVERED, None, least)
    if optimal and proof / "yardstick":
        asked = (accuracy / "relative_gap").number(1e-6, least=0) if accuracy else real(1e-6)
        claims.room("status", asked * scale + noise - difference, scale, lowest)
        if lightest:
            claims.room("status", mass * real(MASS_GAP) - mass + least.number(0.0), mass, least)


def reaches(machine: Machine, implied: Place) -> list[Real | None]:
    """Largest masses (webs,): those of the limits, or what the answer says that they come to where there is none."""
    return [
        web.limit if web.limit is not None else ((implied / web.name).number(least=0) if implied / web.name else None)
        for web in machine.webs
    ]


def check_yardstick(
    claims: Claims, program: Program, place: Place, rest: tuple[Real, Real], limits: Sequence[Real | None]
) -> None:
    """The objective without counterweights, or where it is 0 to rounding at most what they could make it."""
    value, size = rest
    if not value.at_most(size * real(ROUNDING)):
        claims.near("yardstick", place, value, size)
        return
    reach, machine = ZERO, program.machine
    for web, own in zip(machine.webs, limits):
        limit = own if own is not None else machine.budget
        if limit is None:
            claims.put("yardstick", NOT_COVERED, None, place)
            return
        arm = {"force": ONE, "moment": abs(web.arm)}
        for (which, _), (_, _, factor) in program.terms.items():
            reach = reach + abs(factor) * arm[which] * web.radius * limit * machine.square
    claims.room("yardstick", reach * real(1 + ROUNDING) - place.number(), reach, place)


def check_infeasible(claims: Claims, program: Program, goal: Place, answer: Place) -> None:
    """No counterweights within the limits keep the ceilings, and what can be reached without them."""
    machine, proofs = program.machine, answer / "multipliers"
    limits = reaches(machine, answer / "implied_max_mass_kg")
    given = {f"{name}_ceiling_{_UNITS[name]}": name for name in program.ceilings}
    named = [one.text(*given) for one in answer / "conflict"]
    if proofs / "conflict":
        bound = Program(machine, goal).bound(proofs / "conflict", limits, ZERO, conflict=True)
        if bound.least is None:
            claims.put("conflict", BROKEN, None, proofs / "conflict")
        else:
            # strictly above 0: what is at most 0 proves nothing
            size = total([size * program.ceilings[name][0].size for name, size in bound.row.items()])
            proven = bound.least.low > 0 and bool(named)
            verdict = HELD if proven else BROKEN if bound.least.high <= 0 or not named else NOT_COVERED
            claims.put("conflict", verdict, float(bound.least / size) if size.low > 0 else None, proofs / "conflict")
    else:
        claims.put("conflict", NOT_COVERED, None, answer)
    for name, response in machine.responses.items():
        alone = Program(machine, Place({})).with_row(name, {name: ONE})
        said, found = (answer / f"smallest_{name}{part}_{_UNITS[name]}" for part in ("_lower_bound", ""))
        proof = proofs / f"smallest_{name}"
        check_smallest(claims, f"smallest_{name}", alone, said, proof, limits, response)
        field = f"{name}_ceiling_{_UNITS[name]}"
        if said and found:
            claims.room(f"smallest_{name}", found.number() - said.number(), response.size, found)
        if said and field in named and len(named) < len(given):
            # this ceiling alone is out of reach
            claims.room("conflict", said.number() - (goal / field).number(), response.size, said)
    closest = answer / "closest"
    if closest:
        unbalance, _ = check_counterweights(claims, machine, closest / "counterweights")
        check_first_order(claims, "closest", closest / "first_order", machine.with_unbalance(unbalance))


def check_smallest(
    claims: Claims,
    claim: str,
    alone: Program,
    said: Place,
    proof: Place,
    limits: Sequence[Real | None],
    response: Response,
) -> None:
    """A bound on one peak."""
    (name,) = alone.floor
    if not said or (not proof and not said.number().at_most(alone.floor[name])):
        claims.put(claim, NOT_COVERED, None, said)
    elif said.number().at_most(alone.floor[name]):
        claims.room(claim, alone.floor[name] - said.number(), response.size, said)
    else:
        bound = alone.bound(proof, limits, ZERO)
        share = total([*bound.row.values()])
        claims.proven(claim, said, bound if share.low > 0 else None, said.number() * share, response.size * share)


def check_pareto(claims: Claims, request: Place, answer: Place) -> None:
    """Fronts of force and moment, each point with its corner."""
    known(request, *_REQUEST, *_PARETO)
    known(request / "objective", *_OBJECTIVE)
    asked, goal = request / "machine", request / "objective"
    plain = Machine(asked, answer / "reference_plane_m", asked / "max_total_mass_kg")
    claims.near("reference_plane", answer / "reference_plane_m", real(plain.asked_plane), real(plain.asked_plane))
    check_first_order(claims, "before", answer / "without_counterweights", plain.responses)
    for name, response in plain.responses.items():
        claims.near("floor", answer / "floor" / f"{name}_{_UNITS[name]}", abs(response.counter), response.size)
    fronts, budgets = list(answer / "fronts"), list(request / "total_mass_budgets_kg")
    if len(fronts) != max(1, len(budgets)):
        raise Unreadable((*answer.path, "fronts"), "must hold one front for each budget")
    for front, budget in zip(fronts, budgets or [asked / "max_total_mass_kg"]):
        machine = Machine(asked, answer / "reference_plane_m", budget)
        claims.count(machine.parts, front)
        if (front / "status").text("optimal", "inaccurate", "infeasible") == "infeasible":
            check_infeasible(claims, Program(machine, goal), goal, front / "infeasibility")
            continue
        program = Program(machine, goal)
        for name in machine.responses:
            program.with_row(name, {name: ONE})
        limits = reaches(machine, front / "implied_max_mass_kg")
        for point in front / "points":
            check_point(claims, program, request, front, point, limits)
        for name, response in machine.responses.items():
            alone = Program(machine, goal).with_row(name, {name: ONE})
            said = front / "ends" / f"smallest_{name}_lower_bound_{_UNITS[name]}"
            proof = front / "ends" / "multipliers" / f"smallest_{name}"
            check_smallest(claims, f"smallest_{name}", alone, said, proof, limits, response)


def check_point(
    claims: Claims, program: Program, request: Place, front: Place, point: Place, limits: Sequence[Real | None]
) -> None:
    """One point of a front: nobody is below its corner in both weighted peaks."""
    machine, proof, status = program.machine, point / "certificate", (point / "status").text("optimal", "inaccurate")
    unbalance, mass = check_counterweights(claims, machine, point / "counterweights")
    claims.near("total_mass", point / "total_mass_kg", mass, mass)
    after = machine.with_unbalance(unbalance)
    check_ceilings(claims, program, after, point / "counterweights", status == "optimal")
    corner, peaks = {}, {}
    for name, response in after.items():
        unit = _UNITS[name]
        claims.near("after", point / f"{name}_peak_{unit}", abs(response.co) + abs(response.counter), response.size)
        peaks[name], size = program.value(after, {name: ONE}, "sum")
        claims.near("objective", point / f"weighted_{name}_peak_{unit}", peaks[name], size)
        corner[name] = (proof / f"{name}_{unit}").number()
        scale = (front / "scale" / f"{name}_{unit}").number()
        # the point is above its corner by no more than it says
        room = (proof / "relative_gap").number() * scale + size * real(ROUNDING) - (peaks[name] - corner[name])
        claims.room("gap", room, size, proof / f"{name}_{unit}")
    if status == "optimal":
        asked = (request / "accuracy" / "relative_gap").number(1e-6)
        claims.room("status", asked - (proof / "relative_gap").number(), ONE, proof / "relative_gap")
    multipliers = point / "multipliers"
    if multipliers / "objective":
        bound = program.bound(multipliers / "objective", limits, ZERO)
        said, sizes = _priced(bound, corner), _priced(bound, {name: one.size for name, one in after.items()})
        claims.proven("corner", proof, bound if sizes.low > 0 else None, said, sizes)
    else:
        claims.put("corner", NOT_COVERED, None, proof)
    least = proof / "mass_lower_bound_kg"
    if least and least.double() > 0:
        if multipliers / "mass":
            bound = program.bound(multipliers / "mass", limits, ONE)
            most = {name: (proof / f"mass_{name}_limit_{_UNITS[name]}").number() for name in machine.responses}
            claims.proven("mass_lower_bound", least, bound, least.number() + _priced(bound, most), mass)
        else:
            claims.put("mass_lower_bound", NOT_COVERED, None, least)
        if proof / "mass_relative_gap":
            share = (mass - least.number()) / mass if mass.low > 0 else ZERO
            claims.near("mass_gap", proof / "mass_relative_gap", share, ONE)


def _priced(bound: Bound, figures: dict[str, Real]) -> Real:
    return total([price * figures[name] for name, price in bound.row.items()])


def check_sweep(claims: Claims, request: Place, rows: Place) -> None:
    """Rows of a sweep, each as the answer to the base with the values of its axes."""
    paths = [(axis / "path").text() for axis in request / "axes"]
    for row in rows:
        status = (row / "status").text()
        if status not in ("optimal", "inaccurate", "infeasible"):
            continue
        body = (request / "base").value
        for path in paths:
            body = with_value(body, path.split("/")[1:], (row / path).value, Place(None, *request.path, "axes"))
        try:
            check_optimum(claims, Place(body, "request", "base"), _as_answer(row, body))
        except NotCovered as found:
            claims.put("request", NOT_COVERED, None, Place(None, *str(found).split("/")[1:]))


def with_value(body: Any, parts: Sequence[str], value: Any, place: Place) -> Any:
    """A copy of a body with another value at a JSON pointer (RFC 6901)."""
    if not parts:
        return value
    name = parts[0].replace("~1", "/").replace("~0", "~")
    if isinstance(body, list) and name.isdecimal() and len(name) < 6 and int(name) < len(body):
        found = list(body)
        found[int(name)] = with_value(found[int(name)], parts[1:], value, place)
        return found
    if not isinstance(body, (dict, type(None))) or len(parts) > 32:
        raise Unreadable(place.path, "an axis leads to no field of the base")
    return {**(body or {}), name: with_value((body or {}).get(name), parts[1:], value, place)}


def _as_answer(row: Place, body: Any) -> Place:
    """A row in the form of the answer to one request; what it does not hold stays out."""
    text = (row / "multipliers").value
    try:
        proof = {} if text is None else json.loads(text)
    except (TypeError, ValueError, RecursionError):
        proof = None
    if not isinstance(proof, dict):
        raise Unreadable((*row.path, "multipliers"), "must be a JSON object as a text")
    request = Place(body, "request", "base")
    weights = [
        {"web": name, "mass_kg": (row / f"mass_kg.{name}").value, "angle_deg": (row / f"angle_deg.{name}").value}
        for name in ((web / "name").text() for web in request / "machine" / "webs")
    ]
    if (row / "status").value != "infeasible" and any(one["mass_kg"] is None for one in weights):
        # a column that was not asked for
        raise NotCovered(pointer((*row.path, "mass_kg")))
    peaks = {name: {f"peak_{unit}": (row / f"{name}_peak_{unit}").value} for name, unit in _UNITS.items()}
    ceilings = [f"{name}_ceiling_{unit}" for name, unit in _UNITS.items()]
    found = {
        "status": (row / "status").value,
        "counterweights": weights,
        "total_mass_kg": (row / "total_mass_kg").value,
        "residual": {"after": peaks},
        "certificate": {**proof, **row.value, "multipliers": proof},
        "infeasibility": {
            **proof,
            "multipliers": proof,
            "conflict": [name for name in ceilings if request / "objective" / name],
        },
    }
    return Place(found, *row.path)


#: masses and webs, of all points or rows together, that a service looks at in one request
PLACES = 20_000


def verify(request: Any, answer: Any, most: float = inf) -> dict[str, Any]:
    """Every claim of an answer, and the verdict on the whole.

    Parameters
    ----------
    request, answer : what a JSON file holds: bodies of optimize or pareto with their answers, or the body of a sweep
        with a list of its rows.
    most : masses and webs to look at, of all points or rows together.

    Raises
    ------
    Unreadable
        naming the field that is not what the service takes or gives.
    """
    claims, asked, given = Claims(most), Place(request, "request"), Place(answer, "answer")
    try:
        if asked / "base":
            check_sweep(claims, asked, given)
        elif isinstance(answer, dict) and "fronts" in answer:
            check_pareto(claims, asked, given)
        else:
            check_optimum(claims, asked, given)
    except NotCovered as found:
        claims.put("request", NOT_COVERED, None, Place(None, *str(found).split("/")[1:]))
    return claims.answer()


def read(path: str) -> Any:
    """JSON in a file or, as -, from standard input; or a JSON value a line.

    Raises
    ------
    OSError, ValueError
    """
    data = sys.stdin.buffer.read() if path == "-" else Path(path).read_bytes()
    text = data.decode("utf-8-sig")
    try:
        try:
            return json.loads(text)
        except json.JSONDecodeError:
            return [json.loads(line) for line in text.splitlines() if line.strip()]
    except RecursionError:
        raise ValueError(f"{path}: nested too deeply") from None
    except json.JSONDecodeError as error:
        raise ValueError(f"{path} is not JSON: {error}") from None


def main(arguments: Sequence[str]) -> int:
    if len(arguments) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    try:
        found = verify(*map(read, arguments))
    except (OSError, ValueError) as error:
        print(error, file=sys.stderr)
        return 2
    for one in found["claims"]:
        margin = "" if one["margin"] is None else f"{one['margin']:.1e}"
        print(f"{one['claim']:<18} {one['verdict']:<12} {margin:>9}  {one['where']}")
    print(found["verdict"])
    return int(found["verdict"] == BROKEN)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
