"""Checks the answer to one request of optimize against that request, from the two files alone.

    python verify.py request.json answer.json

The standard library, Python 3.8 or newer; nothing of the service is imported. verify_many.py, beside it, does the same
for fronts and sweeps. Machine, limits, values and bounds are evaluated anew from the doubles in the files, in numbers
that enclose every quotient, square root, sine and cosine. What is claimed, by which formulas and to which tolerance is
in docs/verify.md. Exit code 0: nothing is broken, 1: something is, 2: the files cannot be read.
"""

from __future__ import annotations

import json
import re
import sys
from fractions import Fraction
from functools import lru_cache, partial
from math import inf, isfinite, isqrt
from pathlib import Path
from typing import Any, Callable, Dict, Generator, Iterable, Iterator, NamedTuple, Optional, Sequence, Tuple

DATA = 2.0**-48  # of itself: what every datum in a figure may be off by, because the service computes in doubles
MASS = 1e-12  # of a limit: by which rounded masses may exceed it
ANGLE = 1e-12  # degrees likewise
CEILING = 1e-9  # of the larger of a ceiling and what is there without counterweights, likewise
MASS_GAP = 1e-4  # largest mass_relative_gap of an optimal answer
NOTHING = 1e-230  # in the unit of a figure: what doubles do not tell from 0
#: an answer is held if these claims are, as far as they are made
CENTRAL = {"counterweights", "max_mass", "sector", "max_total_mass", "ceilings", "objective", "lower_bound"}
CENTRAL |= {"status", "corner", "conflict", "reach", "request"}
VERDICTS = ("held", "not covered", "broken")

# ---- numbers

BITS = 800


class Number:
    """A complex number in a rectangle (low, high) x y of whole multiples of 2^-BITS, as all doubles are.

    Sums are exact, all else is rounded outwards. Only real numbers are compared, divided by, or made a float.
    """

    __slots__ = ("high", "low", "y")

    def __init__(self, low: int, high: int, y: tuple[int, int] = (0, 0)) -> None:
        self.low, self.high, self.y = low, high, y

    def __add__(self, other: Number) -> Number:
        return Number(self.low + other.low, self.high + other.high, (self.y[0] + other.y[0], self.y[1] + other.y[1]))

    def __neg__(self) -> Number:
        return Number(-self.high, -self.low, (-self.y[1], -self.y[0]))

    def __sub__(self, other: Number) -> Number:
        return self + -other

    def __mul__(self, other: Number) -> Number:
        x, y = (self.low, self.high), (other.low, other.high)
        (a, b), (c, d), (e, f), (g, h) = (
            _product(*of) for of in ((x, y), (self.y, other.y), (x, other.y), (self.y, y))
        )
        return Number((a - d) >> BITS, -((c - b) >> BITS), ((e + g) >> BITS, -(-(f + h) >> BITS)))

    def __truediv__(self, other: Number) -> Number:
        """By a number above 0."""
        return self * Number((1 << 2 * BITS) // other.high, -(-(1 << 2 * BITS) // other.low))

    def __abs__(self) -> Number:
        (a, b), (c, d) = ((max(x, -y, 0), max(-x, y)) for x, y in ((self.low, self.high), self.y))
        return Number(a, b) if d == 0 else Number(isqrt(a * a + c * c), isqrt(b * b + d * d) + 1)

    def conjugate(self) -> Number:
        return Number(self.low, self.high, (-self.y[1], -self.y[0]))

    def parts(self) -> tuple[Number, Number]:
        """Of the vector x + jy across the shaft."""
        return Number(self.low, self.high), Number(*self.y)

    def along(self, other: Number) -> Number:
        return (self.conjugate() * other).parts()[0]

    def __float__(self) -> float:
        """The upper end."""
        try:
            return self.high / (1 << BITS)
        except OverflowError:
            return sys.float_info.max if self.high > 0 else -sys.float_info.max


def _product(a: tuple[int, int], b: tuple[int, int]) -> tuple[int, int]:
    if a == (0, 0) or b == (0, 0):
        return 0, 0
    ends = [p * q for p in a for q in b]
    return min(ends), max(ends)


def real(number: float | Fraction) -> Number:
    top, bottom = number.as_integer_ratio()
    return Number((top << BITS) // bottom, -((-top << BITS) // bottom))


def total(numbers: Iterable[Number]) -> Number:
    return sum(numbers, ZERO)


def largest(*numbers: Number) -> Number:
    return Number(max(one.low for one in numbers), max(one.high for one in numbers))


ZERO, ONE, HALF, J = real(0), real(1), real(0.5), Number(0, 0, (1 << BITS, 1 << BITS))
STEP = Number(1, 1)
#: 0 and 1 to the rounding of the data; the former for both parts of a direction
SPECK = Number(-real(DATA).high, real(DATA).high)
ABOUT_ONE, BLUR = ONE + SPECK, SPECK + J * SPECK
PI = int("314159265358979323846264338327950288419716939937510582097494459230781640628620899")  # 10^80 times, cut off


@lru_cache(maxsize=4096)
def direction(degrees: float) -> Number:
    """Unit vector: quarter turns are split off exactly, the series is summed in whole multiples of 2^-224.

    The angle is off by 2 of these at most, every term by less than 6, and 60 terms together by less than 2^10.
    """
    top, bottom = degrees.as_integer_ratio()
    quarter, rest = divmod(top % (360 * bottom), 90 * bottom)
    angle = rest * (PI << 224) // (180 * bottom * 10**80)
    sums, term, n = [0, 0], 1 << 224, 0
    while term:
        sums[n % 2] += term if n % 4 < 2 else -term
        n += 1
        term = term * angle // (n << 224)
    slack = 1 << 10 if rest else 0
    x, y = (((one - slack) << BITS - 224, (one + slack) << BITS - 224) for one in sums)
    found = Number(*x, y)
    for _ in range(quarter):
        found = found * J
    return found


# ---- reading: nothing in the files is trusted

_PI, _LBF = Fraction("3.14159265358979323846264338327950288"), Fraction("4.4482216152605")
UNITS: dict[str, dict[str, Any]] = {
    "m": {"m": 1, "cm": "0.01", "mm": "0.001", "in": "0.0254", "ft": "0.3048"},
    "kg": {"kg": 1, "g": "0.001", "t": 1000, "lb": "0.45359237"},
    "deg": {"deg": 1, "rad": 180 / _PI},
    "rpm": {"rpm": 1, "rad/s": 30 / _PI, "Hz": 60},
    "N": {"N": 1, "kN": 1000, "lbf": _LBF},
    "Nm": {"N m": 1, "N mm": "0.001", "lbf ft": _LBF * Fraction("0.3048")},
}
_QUANTITY = re.compile(r"\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d{1,3})?)\s*([A-Za-z][A-Za-z/ ]*?)\s*", re.ASCII)
#: fields of a request that are read here, and those that change nothing of what is checked
KNOWN = (
    " machine objective accuracy kind speed_rpm rotation reference_plane_m webs max_total_mass_kg throws position_m"
    " crank_radius_m crank_angle_deg rotating_mass_kg rows axis_deg offset_m reciprocating_mass_kg connecting_rod"
    " mass_kg reciprocating_share orbit_radius_m orbiting_mass_kg orbiting_position_m anti_rotation type count"
    " eccentric_mass_kg counterweight_radius_m max_mass_kg sector centre_deg half_angle_deg combine force_weight"
    " moment_weight direction_weights x y force_ceiling_N moment_ceiling_Nm least_mass orders relative_gap "
)
IDLE = (
    " name description length_m throw friction flywheel bearings cylinder cylinders rotation_torque_Nm"
    " tangential_gas_force_N drive_bearing pin_circle_radius_m outputs angles fidelity multipliers symmetric points"
    " total_mass_budgets_kg "
)


class Unreadable(ValueError):
    """Request or answer is not what the service takes or gives; ``path`` names the field."""

    def __init__(self, path: Sequence[str | int], message: str) -> None:
        super().__init__(f"{pointer(path)}: {message}")
        self.path, self.message = tuple(path), message


class NotCovered(Exception):
    """The place of something that changes what is to be checked, and that is not known here."""


def pointer(path: Sequence[str | int]) -> str:
    """JSON pointer (RFC 6901), printable whatever the names in it are, and not for ever."""
    found = "".join("/" + str(part).replace("~", "~0").replace("/", "~1") for part in path)
    return found[:200].encode("utf-8", "backslashreplace").decode()


class Place:
    """A value in one of the files, and where it stands; false where there is none."""

    def __init__(self, value: Any, *path: str | int) -> None:
        self.value, self.path = value, path

    def read(self, kinds: tuple[type, ...], name: str, default: Any = None) -> Any:
        found = default if self.value is None else self.value
        if not isinstance(found, kinds) or (isinstance(found, bool) and bool not in kinds):
            raise Unreadable(self.path, f"must be {name}")
        return found

    def __bool__(self) -> bool:
        return self.value is not None

    def __truediv__(self, name: str) -> Place:
        return Place(self.read((dict,), "an object", {}).get(name), *self.path, name)

    def __iter__(self) -> Iterator[Place]:
        return (Place(one, *self.path, k) for k, one in enumerate(self.read((list,), "a list", [])))

    def text(self, *allowed: str, default: str | None = None) -> str:
        found: str = self.read((str,), "a text", default)
        if allowed and found not in allowed:
            raise Unreadable(self.path, f"must be one of {', '.join(allowed)}")
        return found

    def double(self, default: float | None = None, least: float = -inf) -> float:
        """The number as a double; a text with a unit is read in the request, to the nearest double."""
        found = self.read((int, float, str), "a number", default)
        try:
            found = float(self._quantity(found) if isinstance(found, str) else found)
        except OverflowError:
            found = inf
        if not isfinite(found) or found < least:
            raise Unreadable(self.path, f"must be a finite number of at least {least:g}")
        return found

    def number(self, default: float | None = None, least: float = -inf) -> Number:
        return real(self.double(default, least))

    def _quantity(self, text: str) -> Fraction:
        # of a list, the name of the list
        name = next(str(part) for part in reversed(self.path) if isinstance(part, str))
        units = UNITS.get(name.rpartition("_")[2], {}) if self.path[0] == "request" else {}
        match = _QUANTITY.fullmatch(text) if len(text) <= 48 else None
        symbol = " ".join(match.group(2).split()) if match else ""
        if match is None or symbol not in units:
            raise Unreadable(self.path, " ".join(["must be a number", *(f"or one in {unit}" for unit in units)]))
        return Fraction(match.group(1)) * Fraction(units[symbol])

    def known(self) -> None:
        """Raises NotCovered where there is a field that is not known."""
        for name in self.value if isinstance(self.value, dict) else ():
            if f" {name} " not in IDLE and (self / name).value not in (None, [], {}):
                if f" {name} " not in KNOWN:
                    raise NotCovered(self / name)
                (self / name).known()
        for one in self if isinstance(self.value, list) else ():
            one.known()


# ---- the machine


class Mass(NamedTuple):
    """A mass on a crank: kg m, its directions with and against the shaft, and where along the shaft [m]."""

    product: Number
    co: Number
    counter: Number
    position: Number


class Web(NamedTuple):
    """A place for a counterweight."""

    name: str
    position: Number
    radius: Number
    limit: Optional[Number]
    sector: Optional[Tuple[float, float]]  # centre and half-angle, degrees


NAMES = {"force": "N", "moment": "Nm"}
#: phasors that turn with and against the shaft, of force [N] and moment [N m]
Responses = Dict[str, Tuple[Number, Number]]


class Machine:
    """A machine in the units of the answer; its masses are exact, or known to their rounding."""

    def __init__(self, place: Place, plane: Place, budget: Place, exact: bool = False) -> None:
        (place / "rotation").text("ccw", "cw", default="ccw")
        kind = (place / "kind").text("reciprocating", "scroll")
        masses, planes, ends = (_throws if kind == "reciprocating" else _scroll)(place)
        self.wide, self.blur = (ONE, ZERO) if exact else (ABOUT_ONE, BLUR)
        omega = (place / "speed_rpm").number(least=0) * Number(PI, PI + 1) / Number(30 * 10**80, 30 * 10**80)
        self.square, self.masses, self.webs = omega * omega, masses, [_web(web) for web in place / "webs"]
        if len({web.name for web in self.webs}) < len(self.webs):
            raise Unreadable((*place.path, "webs"), "names must be unique")
        self.budget = budget.number(least=0) if budget else None
        # where the machine says that moments are, or midway; where the answer says so is what counts from here
        self.asked_plane = (place / "reference_plane_m").number(0.5 * (min(planes) + max(planes)))
        self.plane = plane.number() if plane else self.asked_plane
        ends = [*ends, *((web / "position_m").double() for web in place / "webs")]
        span = real(max(ends)) - real(min(ends))
        self.span = span if span.low > real(NOTHING).high else ONE
        self.before = self.responses([])

    def responses(self, weights: Sequence[Mass]) -> Responses:
        """With counterweights."""
        found = {}
        for name in NAMES:
            co = counter = ZERO
            for mass in (*self.masses, *weights):
                arm = ONE if name == "force" else mass.position * self.wide - self.plane * self.wide
                size = mass.product * self.wide * self.square * arm
                co = co + (mass.co + self.blur) * size
                counter = counter + (mass.counter + self.blur) * size if mass.counter is not ZERO else counter
            found[name] = co, counter
        return found


def _web(place: Place) -> Web:
    most, sector = place / "max_mass_kg", place / "sector"
    edges = ((sector / "centre_deg").double(), (sector / "half_angle_deg").double(least=0)) if sector else None
    radius, limit = (place / "counterweight_radius_m").number(least=0), most.number(least=0) if most else None
    return Web((place / "name").text(), (place / "position_m").number(), radius, limit, edges)


def _moving(product: Number, crank: Number, degrees: float, position: Number) -> Mass:
    """Along an axis g: half of it turns along e^{jd}, half along e^{j(2g - d)} against the shaft."""
    return Mass(product * HALF, crank, direction(degrees) * direction(degrees) * crank.conjugate(), position)


def _throws(place: Place) -> tuple[list[Mass], list[float], list[float]]:
    """Masses, planes whose middle is the default reference, and planes that the span counts."""
    masses, planes = [], []
    for throw in place / "throws":
        radius, crank = (throw / "crank_radius_m").number(), direction((throw / "crank_angle_deg").double())
        planes.append((throw / "position_m").double())
        masses.append(Mass((throw / "rotating_mass_kg").number(0.0) * radius, crank, ZERO, real(planes[-1])))
        for row in throw / "rows":
            rod, where = row / "connecting_rod", real(planes[-1]) + (row / "offset_m").number(0.0)
            share, weight = (rod / "reciprocating_share").number(1 / 3), (rod / "mass_kg").number(0.0)
            moving = ((row / "reciprocating_mass_kg").number() + share * weight) * radius
            masses.append(_moving(moving, crank, (row / "axis_deg").double(), where))
            masses.append(Mass((ONE - share) * weight * radius, crank, ZERO, where))
    if not planes:
        raise Unreadable((*place.path, "throws"), "must hold at least one item")
    return masses, planes, planes


def _scroll(place: Place) -> tuple[list[Mass], list[float], list[float]]:
    orbit, crank, guide = (place / "orbit_radius_m").number(), direction(0.0), place / "anti_rotation"
    own, other = (place / "orbiting_position_m").double(), (guide / "position_m").double()
    masses = [Mass((place / "orbiting_mass_kg").number() * orbit, crank, ZERO, real(own))]
    if (guide / "type").text("oldham", "crank_pins") == "oldham":
        # it slides with the projection of the orbit: a crank with an infinite rod
        masses.append(_moving((guide / "mass_kg").number() * orbit, crank, (guide / "axis_deg").double(), real(other)))
    else:
        pins = (guide / "count").number() * (guide / "eccentric_mass_kg").number(0.0)
        masses.append(Mass(pins * orbit, crank, ZERO, real(other)))
    return masses, [own], [own, other]


# ---- what is to be small, under which ceilings, and what multipliers prove of it (docs/mathematics.md section 5)


#: response, and co, counter or ceiling
Key = Tuple[str, str]


class Term(NamedTuple):
    """A length |start + factor f| in a row, or one that a ceiling limits; f is what counterweights add."""

    row: str
    response: str
    start: Number
    factor: Number


class Bound(NamedTuple):
    """The rows times their multipliers are at least this; None: nothing is proven."""

    least: Optional[Number]
    rows: Dict[str, Number]


class Statement:
    """Rows, which are sums of weighted peaks, and ceilings; they go by their names in the answer."""

    def __init__(self, machine: Machine, goal: Place, rows: dict[str, dict[str, Number]], capped: bool = True) -> None:
        self.machine, self.rows = machine, rows
        self.x, self.y = ((goal / "direction_weights" / name).number(1.0, least=0) for name in ("x", "y"))
        self.floor: dict[str, Number] = dict.fromkeys(rows, ZERO)
        self.terms: dict[Key, Term] = {}
        for row, name, weight in ((r, name, weight) for r, each in rows.items() for name, weight in each.items()):
            floor, lengths = self.peak(machine.before[name], weight)
            self.floor[row] = self.floor[row] + floor
            self.terms.update({(name, part): Term(row, name, *length) for part, length in lengths.items()})
        limits = {name: goal / f"{name}_ceiling_{unit}" for name, unit in NAMES.items() if capped}
        #: ceiling less the phasor against the shaft, and the size of the ceiling
        self.caps = {n: most.number(least=0) - abs(machine.before[n][1]) for n, most in limits.items() if most}
        self.sizes = {name: largest(abs(machine.before[name][0]), abs(cap)) for name, cap in self.caps.items()}

    def peak(self, response: tuple[Number, Number], weight: Number) -> tuple[Number, dict[str, tuple[Number, Number]]]:
        """A floor, and vectors whose lengths it adds; each with the factor of the phasor with the shaft in it."""
        p, q, f, b = weight * (self.x + self.y) * HALF, weight * (self.x - self.y) * HALF, *response
        if self.x.low == self.y.low:
            return p * abs(b), {"co": (f * p, p)}
        return ZERO, {"co": (f * p + b.conjugate() * q, p), "counter": (f * q + b.conjugate() * p, q)}

    def values(self, responses: Responses) -> dict[str, Number]:
        """Of every row."""
        peaks = {row: [self.peak(responses[n], w) for n, w in names.items()] for row, names in self.rows.items()}
        return {row: total(f + total(abs(v) for v, _ in v_.values()) for f, v_ in p) for row, p in peaks.items()}

    def bound(self, proof: Place, implied: Place, slack: dict[str, Number], cost: Number, believed: bool) -> Bound:
        """Of rows and cost * mass, for all within the limits that exceed no ceiling by more than slack.

        What the answer says that missing limits imply is believed, or shown to be of no account. Without rows
        of an objective the multipliers have those of the ceilings, and prove that they conflict.
        """
        limits = {(name, "ceiling"): Term(name, name, self.machine.before[name][0], ONE) for name in self.caps}
        terms = {**self.terms, **limits}
        rows, y = self._multipliers(proof, terms)
        if cost is ZERO and total(rows.values()).low <= 0:
            return Bound(None, rows)
        machine = self.machine
        price = cost + ((proof / "budget").number(0.0, least=0) if machine.budget else ZERO)
        free = {w.name: w for w in machine.webs if not believed and (w.limit is None or implied / w.name)}
        if price.high == 0:
            free = self._balance(y, terms, [web for web in free.values() if web.sector is None])
        # |y| <= lambda holds by shortening all alike; what a ceiling costs is its own length, if it has no row
        most = {key: rows.get(one.row, ZERO) for key, one in terms.items()}
        most.update({key: Number(abs(y[key]).high, abs(y[key]).high) for key in limits if self.floor})
        share = _share((most[key], abs(y[key])) for key in y)
        least, slope = total(rows[name] * self.floor[name] for name in rows if self.floor), dict.fromkeys(NAMES, ZERO)
        for key, term in terms.items():
            least = least + y[key].along(term.start) * share
            slope[term.response] = slope[term.response] + y[key] * term.factor * share
        for name, _ in limits:
            least = least - most[name, "ceiling"] * (self.caps[name] + slack.get(name, ZERO))
        gains = {}
        for web in machine.webs:
            pull = -(slope["force"] + slope["moment"] * (web.position - machine.plane)) * machine.square
            gains[web.name] = web.radius * support(pull, web.sector)
        # where a kilogram has a price, what has no limit must gain no more: all multipliers are shortened alike
        share = _share((price, gains[name]) for name in free if price.low > 0 and not machine.budget)
        least = least * share
        for web in machine.webs:
            gain = gains[web.name] * share - price
            if gain.high > 0 and (web.name not in free or (machine.budget and price.high > 0)):
                limit = self.reach(web, implied if believed else Place(None))
                if limit is None:
                    return Bound(None, rows)
                least = least - Number(max(gain.low, 0), gain.high) * limit
        if machine.budget:
            least = least - (price - cost) * machine.budget
        return Bound(least, {name: row * share for name, row in rows.items()})

    def _multipliers(self, proof: Place, terms: Iterable[Key]) -> tuple[dict[str, Number], dict[Key, Number]]:
        """Of the rows and of the terms, those that are not 0 and those that are to be given."""
        rows = {(one / "name").text(): (one / "value").number(least=0) for one in proof / "rows"}
        rows = {name: row for name, row in rows.items() if row.high > 0}
        if not rows.keys() <= (self.floor or self.caps).keys():
            raise NotCovered(proof / "rows")
        y = dict.fromkeys(terms, ZERO)
        for field in ("terms", "ceilings"):
            for one in proof / field:
                part = (one / "part").text("co", "counter", default="co")
                key = (one / "response").text(), part if field == "terms" else "ceiling"
                vector = (one / "x").number() + J * (one / "y").number()
                if abs(vector).high > 0 and (key not in y or one / "angle_deg" or one / "scenario"):
                    raise NotCovered(one)
                if abs(vector).high > 0:
                    y[key] = y[key] + vector
        return rows, y

    def _balance(self, y: dict[Key, Number], terms: dict[Key, Term], webs: Sequence[Web]) -> dict[str, Web]:
        """Choose a multiplier so that webs without limit gain exactly nothing; those for which that can be done."""
        slope = dict.fromkeys(NAMES, ZERO)
        chosen: dict[str, Key] = {}
        for key, one in terms.items():
            slope[one.response] = slope[one.response] + y[key] * one.factor
            if one.factor.low > 0:
                chosen.setdefault(one.response, key)
        arms = {web.position.low: web.position - self.machine.plane for web in webs}
        if len(arms) == 1 and "force" in chosen:
            # on one plane it is enough that force and moment together do nothing
            slope = {"force": slope["force"] + slope["moment"] * next(iter(arms.values()))}
        if not webs or any(abs(slope[name]).high > 0 for name in slope.keys() - chosen.keys()):
            return {}
        for name in chosen.keys() & slope.keys():
            y[chosen[name]] = y[chosen[name]] - slope[name] / terms[chosen[name]].factor
        return {web.name: web for web in webs}

    def reach(self, web: Web, implied: Place) -> Number | None:
        """Largest mass of a web: its limit, the budget or what the answer says that they imply; None without."""
        said = (implied / web.name).number(least=0) if implied / web.name else None
        limits = [limit for limit in (web.limit, self.machine.budget, said) if limit is not None]
        return min(limits, key=lambda one: one.high) if limits else None


def _share(pairs: Iterable[tuple[Number, Number]]) -> Number:
    """What all sizes are to be multiplied by to be no more than allowed (allowed, size), at most 1."""
    share = ONE.low
    for allowed, size in pairs:
        if size.high > allowed.low:
            share = min(share, (allowed.low << BITS) // size.high)
    return Number(share, share)


def support(pull: Number, sector: tuple[float, float] | None) -> Number:
    """Largest Re(conj(pull) v) over unit-disc vectors v in the sector, or somewhat more."""
    if sector is None:
        return abs(pull)
    (along, across), (cos, sin) = (pull * direction(sector[0]).conjugate()).parts(), direction(sector[1]).parts()
    across = abs(across)
    if (along * sin).high > (across * cos).low:
        return abs(pull)
    return largest(along * cos + across * sin, ZERO)


# ---- what is claimed

#: kind of claim, where it stands, the room that is left (None: not covered), and what it is a share of
Claim = Tuple[str, Place, Optional[Number], Number]
Claims = Generator[Claim, None, Any]


def near(claim: str, place: Place, figure: Number) -> Claim:
    """A figure lies where it has to."""
    if not place:
        return claim, place, None, ONE
    off = min(place.number() - figure, figure - place.number(), key=lambda one: one.high)
    return claim, place, off + real(NOTHING), abs(figure)


def proven(
    claim: str,
    place: Place,
    statement: Statement,
    proof: Place,
    implied: Place,
    slack: dict[str, Number],
    price: Callable[[dict[str, Number]], Number],
    cost: Number = ZERO,
) -> Iterator[Claim]:
    """What is said, by what its rows are multiplied with, is no more than multipliers prove."""
    for believed in (False, True):
        bound = statement.bound(proof, implied, slack, cost, believed)
        said = price(bound.rows)
        room = bound.least - said if place and bound.least is not None else None
        if room is not None and room.high >= 0:
            break
    if believed and room is not None and room.high >= 0:
        yield "reach", implied, None, ONE
    yield claim, place, room, largest(abs(said), abs(bound.least or ZERO))


def priced_at(values: dict[str, Number], rows: dict[str, Number], least: Number = ZERO) -> Number:
    """Rows of these values, and a mass."""
    return least + total(row * values[name] for name, row in rows.items())


_FIGURES: dict[str, Callable[[Number, Number], Number]] = {
    "peak": lambda co, counter: abs(co) + abs(counter),
    "minor": lambda co, counter: abs(abs(co) - abs(counter)),
    "peak_x": lambda co, counter: abs(co + counter.conjugate()),
    "peak_y": lambda co, counter: abs(co - counter.conjugate()),
    "co_rotating": lambda co, counter: abs(co),
    "counter_rotating": lambda co, counter: abs(counter),
}


def first_order(claim: str, place: Place, responses: Responses) -> Claims:
    for name, phasors in responses.items():
        for figure, evaluate in _FIGURES.items():
            said = place / name / f"{figure}_{NAMES[name]}"
            if said:
                yield near(claim, said, evaluate(*phasors))
        axis, product = place / name / "major_axis_deg", phasors[0] * phasors[1]
        if axis:
            # along e^{ja} both phasors point the same way: their product is along e^{2ja}
            way = direction(axis.double()) + BLUR
            yield claim, axis, -abs(product - way * way * abs(product)), abs(product)


def counterweights(machine: Machine, place: Place) -> Claims:
    """Their consistency and the limits of the webs; returns them as masses, and their total mass."""
    names = [(one / "web").text() for one in place]
    yield "counterweights", place, ONE if names == [web.name for web in machine.webs] else -ONE, ONE
    by_name, turning, total_mass = dict(zip(names, place)), [], ZERO
    for web in machine.webs:
        one = by_name.get(web.name, Place({"mass_kg": 0, "angle_deg": 0}, *place.path))
        said, mass, angle = one / "mass_kg", (one / "mass_kg").number(), (one / "angle_deg").double()
        u = (direction(angle) + machine.blur) * mass * web.radius * machine.wide
        figures = zip(("mass_radius_kg_m", "x_kg_m", "y_kg_m"), (mass * web.radius * machine.wide, *u.parts()))
        yield from (near("counterweights", one / field, exact) for field, exact in figures if one / field)
        yield "max_mass", said, mass, abs(mass)
        if web.limit is not None:
            yield "max_mass", said, web.limit * real(1 + MASS) - mass, web.limit
        if web.sector is not None and mass.high > 0:
            turn, (centre, half) = Fraction(360), web.sector
            off = abs((Fraction(angle) - Fraction(centre) + turn / 2) % turn - turn / 2)
            yield "sector", one / "angle_deg", real(Fraction(half) + Fraction(ANGLE) - off), ONE
        total_mass = total_mass + mass
        turning.append(Mass(mass * web.radius, direction(angle), ZERO, web.position))
    if machine.budget is not None:
        yield "max_total_mass", place, machine.budget * real(1 + MASS) - total_mass, machine.budget
    return turning, total_mass * machine.wide


def ceilings(statement: Statement, weights: Sequence[Mass], place: Place, kept: bool) -> Claims:
    """``kept``: whether the answer says that they are; returns by how much they are exceeded."""
    machine, excess = statement.machine, {}
    after = machine.responses(weights)
    for name, cap in statement.caps.items():
        size = statement.sizes[name]
        if size.low <= 0:
            # nothing is there and nothing allowed: what each of the counterweights does
            arms = (ONE if name == "force" else abs(one.position - machine.plane) for one in weights)
            size = total(one.product * machine.square * arm for one, arm in zip(weights, arms))
        excess[name] = largest(abs(after[name][0]) - cap, ZERO)
        room = size * real(CEILING) - excess[name]
        yield "ceilings", place, room if kept or room.high >= 0 else None, size
    return excess


def optimum(request: Place, answer: Place) -> Claims:
    """The answer to one request: counterweights with their certificate, or the proof that there are none."""
    request.known()
    if answer / "fronts":
        raise NotCovered(answer / "fronts")
    asked, goal, proof = request / "machine", request / "objective", answer / "certificate"
    (goal / "orders").text("first", default="first")
    status = (answer / "status").text("optimal", "inaccurate", "infeasible")
    machine = Machine(asked, answer / "reference_plane_m", asked / "max_total_mass_kg")
    yield from before(machine, answer, answer / "residual" / "before")
    if status == "infeasible":
        yield from infeasible(request, answer, asked / "max_total_mass_kg", answer / "infeasibility")
        return
    weights = {"force": (goal / "force_weight").number(1.0, least=0), "moment": ONE / machine.span}
    if goal / "moment_weight":
        weights["moment"] = (goal / "moment_weight").number(least=0)
    weights = {name: weight for name, weight in weights.items() if weight.high > 0}
    together = (goal / "combine").text("sum", "max", default="sum") == "sum"
    rows = {"sum": weights} if together else {name: {name: weight} for name, weight in weights.items()}
    statement = Statement(machine, goal, rows)
    found, mass = yield from counterweights(machine, answer / "counterweights")
    excess = yield from ceilings(statement, found, answer / "counterweights", status == "optimal")
    after = machine.responses(found)
    yield near("total_mass", answer / "total_mass_kg", mass)
    yield from first_order("after", answer / "residual" / "after", after)
    value, rest = (largest(ZERO, *statement.values(responses).values()) for responses in (after, machine.before))
    objective, lowest, implied = proof / "objective", proof / "lower_bound", proof / "implied_max_mass_kg"
    yield near("objective", objective, value)
    yield near("before", proof / "objective_without_counterweights", rest)
    # nothing that exceeds no ceiling by more is better
    multipliers, priced = proof / "multipliers", partial(priced_at, dict.fromkeys(rows, lowest.number(0.0)))
    yield from proven("lower_bound", lowest, statement, multipliers / "objective", implied, excess, priced)
    gap, size = objective.number(0.0) - lowest.number(0.0), (proof / "yardstick").number(0.0)
    noise = SPECK * (abs(objective.number(0.0)) + abs(lowest.number(0.0)))
    if lowest and proof / "yardstick":
        yield near("gap", proof / "gap", gap + noise)
        yield near("relative_gap", proof / "relative_gap", (gap + noise) * ABOUT_ONE / size if size.low > 0 else ZERO)
        yield yardstick(statement, proof / "yardstick", rest, implied)
    asks_least = (goal / "least_mass").read((bool,), "true or false", True)
    if asks_least:
        most = (proof / "mass_objective_limit").number(0.0)
        yield from lightest(statement, proof, multipliers, dict.fromkeys(rows, most), after, mass)
    if status == "optimal":
        room = (request / "accuracy" / "relative_gap").number(1e-6, least=0) * size + noise - gap
        yield "status", lowest, room if proof / "yardstick" else None, size
        if asks_least:
            least = proof / "mass_lower_bound_kg"
            yield "status", least, mass * real(MASS_GAP) - mass + least.number(0.0), mass


def lightest(
    statement: Statement, proof: Place, multipliers: Place, most: dict[str, Number], after: Responses, mass: Number
) -> Claims:
    """Nothing with rows up to these, which the answer keeps, and that counts as keeping the ceilings is lighter."""
    place, implied = proof / "mass_lower_bound_kg", proof / "implied_max_mass_kg"
    slack = {name: size * real(CEILING) for name, size in statement.sizes.items()}
    least = place.number(0.0)
    if least.high <= 0:
        yield "mass_lower_bound", place, -least if place else None, ONE
    else:
        priced = partial(priced_at, most, least=least)
        yield from proven("mass_lower_bound", place, statement, multipliers / "mass", implied, slack, priced, ONE)
        for name, value in statement.values(after).items():
            yield "mass_lower_bound", place, most[name] - value, abs(value)
    if place:
        yield near("mass_gap", proof / "mass_relative_gap", ONE - place.number() / mass if mass.low > 0 else ZERO)


def before(machine: Machine, answer: Place, place: Place) -> Claims:
    """The machine as it is."""
    if answer / "reference_plane_m":
        yield near("reference_plane", answer / "reference_plane_m", machine.asked_plane * ABOUT_ONE)
    yield from first_order("before", place, machine.before)
    for name, unit in NAMES.items() if answer / "floor" else ():
        yield near("floor", answer / "floor" / f"{name}_{unit}", abs(machine.before[name][1]))


def yardstick(statement: Statement, place: Place, rest: Number, implied: Place) -> Claim:
    """The objective without counterweights, or where it is 0 to rounding at most what they could make it."""
    if rest.low > 0:
        return near("yardstick", place, rest)
    reach, machine = ZERO, statement.machine
    for web in machine.webs:
        limit = statement.reach(web, implied)
        if limit is None:
            return "yardstick", place, None, ONE
        arms = {"force": ONE, "moment": abs(web.position - machine.plane)}
        does = total(abs(one.factor) * arms[one.response] for one in statement.terms.values())
        reach = reach + does * web.radius * limit * machine.square
    return "yardstick", place, reach * ABOUT_ONE - place.number(), reach


def infeasible(request: Place, answer: Place, budget: Place, said: Place) -> Claims:
    """No counterweights within the limits keep the ceilings, and what can be reached without them."""
    goal, proofs, implied = request / "objective", said / "multipliers", said / "implied_max_mass_kg"
    plain = Machine(request / "machine", answer / "reference_plane_m", budget)
    exact = Machine(request / "machine", answer / "reference_plane_m", budget, exact=True)
    statement = Statement(exact, goal, {})
    given = {f"{name}_ceiling_{NAMES[name]}": name for name in statement.caps}
    named = [one.text(*given) for one in said / "conflict"]
    if proofs / "conflict" and named:
        # strictly above 0: what is at most 0 proves nothing
        yield from proven("conflict", proofs / "conflict", statement, proofs / "conflict", implied, {}, lambda _: STEP)
    else:
        yield "conflict", proofs / "conflict", None if named else -ONE, ONE
    yield from smallest(plain, Place({}), said, proofs, implied)
    for name, unit in NAMES.items():
        lowest, found = (said / f"smallest_{name}{part}_{unit}" for part in ("_lower_bound", ""))
        if lowest and found:
            yield f"smallest_{name}", found, found.number() * ABOUT_ONE - lowest.number(), abs(found.number())
        if lowest and f"{name}_ceiling_{unit}" in named and len(named) < len(given):
            # this ceiling alone is out of reach
            yield "conflict", lowest, lowest.number() - (goal / f"{name}_ceiling_{unit}").number(), lowest.number()
    if said / "closest":
        weights, _ = yield from counterweights(plain, said / "closest" / "counterweights")
        yield from first_order("closest", said / "closest" / "first_order", plain.responses(weights))


def smallest(machine: Machine, goal: Place, said: Place, proofs: Place, implied: Place) -> Claims:
    """Bounds on either peak alone, under the ceilings of a goal."""
    for name, unit in NAMES.items():
        lowest = said / f"smallest_{name}_lower_bound_{unit}"
        alone, priced = Statement(machine, goal, {name: {name: ONE}}), partial(priced_at, {name: lowest.number(0.0)})
        yield from proven(f"smallest_{name}", lowest, alone, proofs / f"smallest_{name}", implied, {}, priced)


def judged(claims: Iterable[Claim]) -> dict[str, Any]:
    """What becomes of every kind of claim, of several of one kind the worst, and the verdict on the whole."""
    found: dict[str, tuple[int, float, dict[str, Any]]] = {}
    for claim, place, room, size in claims:
        share = None if room is None else float(room / Number(size.high, size.high) if size.high > 0 else room)
        rank = 1 if room is None else 0 if room.high >= 0 else 2
        told = {"claim": claim, "verdict": VERDICTS[rank], "margin": share, "where": pointer(place.path)}
        one = rank, -(share or 0.0), told
        found[claim] = max(found.get(claim, one), one, key=lambda one: one[:2])
    central = {rank for claim, (rank, _, _) in found.items() if claim in CENTRAL}
    worst = max([rank for rank, _, _ in found.values()], default=1)
    rank = worst if worst == 2 else 0 if central == {0} else 1
    return {"claims": [told for _, _, told in found.values()], "verdict": VERDICTS[rank]}


def covered(claims: Iterator[Claim]) -> Iterator[Claim]:
    """The claims as far as what they stand on is known."""
    try:
        yield from claims
    except NotCovered as found:
        (place,) = found.args
        yield "request", place, None, ONE


def verify(request: Any, answer: Any) -> dict[str, Any]:
    """Every claim of an answer, and the verdict on the whole; both are what a JSON file holds.

    Raises
    ------
    Unreadable
        naming the field that is not what the service takes or gives.
    """
    return judged(covered(optimum(Place(request, "request"), Place(answer, "answer"))))


def read(path: str) -> Any:
    """JSON in a file or, as -, from standard input; or a JSON value a line. Raises OSError, ValueError."""
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


def main(check: Callable[[Any, Any], dict[str, Any]], arguments: Sequence[str]) -> int:
    if len(arguments) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    try:
        found = check(*map(read, arguments))
    except (OSError, ValueError) as error:
        print(error, file=sys.stderr)
        return 2
    for one in found["claims"]:
        margin = "" if one["margin"] is None else f"{one['margin']:.1e}"
        print(f"{one['claim']:<18} {one['verdict']:<12} {margin:>9}  {one['where']}")
    print(found["verdict"])
    return int(found["verdict"] == "broken")


if __name__ == "__main__":
    sys.exit(main(verify, sys.argv[1:]))
