"""Exact numbers, and how the files of verify.py are read into them. The standard library, Python 3.8 or newer."""

from __future__ import annotations

import json
import re
import sys
from fractions import Fraction
from functools import lru_cache
from math import inf, isfinite, isnan, isqrt
from pathlib import Path
from typing import Any, Iterable, Iterator, Sequence

DATA = 2.0**-48  # of itself: what every datum in a figure may be off by, because the service computes in doubles

# ---- numbers

BITS = 1120


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
        return Number(self.low - other.high, self.high - other.low, (self.y[0] - other.y[1], self.y[1] - other.y[0]))

    def __mul__(self, other: Number) -> Number:
        x, y = (self.low, self.high), (other.low, other.high)
        if self.y == other.y == (0, 0):
            # most products are of real numbers
            a, b = _product(x, y)
            return Number(a >> BITS, -(-b >> BITS))
        (a, b), (c, d) = _product(x, y), _product(self.y, other.y)
        (e, f), (g, h) = _product(x, other.y), _product(self.y, y)
        return Number((a - d) >> BITS, -((c - b) >> BITS), ((e + g) >> BITS, -(-(f + h) >> BITS)))

    def __truediv__(self, other: Number) -> Number:
        """By a number above 0."""
        return self * Number((1 << 2 * BITS) // other.high, -(-(1 << 2 * BITS) // other.low))

    def __abs__(self) -> Number:
        a, b = _distance(self.low, self.high)
        if self.y == (0, 0):
            return Number(a, b)
        c, d = _distance(*self.y)
        return Number(isqrt(a * a + c * c), isqrt(b * b + d * d) + 1)

    def conjugate(self) -> Number:
        return Number(self.low, self.high, (-self.y[1], -self.y[0]))

    def parts(self) -> tuple[Number, Number]:
        """Of the vector x + jy across the shaft."""
        return Number(self.low, self.high), Number(*self.y)

    def along(self, other: Number) -> Number:
        return (self.conjugate() * other).parts()[0]

    def middle(self) -> complex:
        """In doubles."""
        return complex(_double(self.low + self.high, BITS + 1), _double(sum(self.y), BITS + 1))

    def __float__(self) -> float:
        """The upper end."""
        return _double(self.high, BITS)


def _double(number: int, bits: int) -> float:
    try:
        return number / (1 << bits)
    except OverflowError:
        return sys.float_info.max if number > 0 else -sys.float_info.max


def _distance(low: int, high: int) -> tuple[int, int]:
    """From 0."""
    return (low, high) if low >= 0 else (-high, -low) if high <= 0 else (0, max(-low, high))


def _product(a: tuple[int, int], b: tuple[int, int]) -> tuple[int, int]:
    (low, high), (least, most) = a, b
    if low < 0 < high or least < 0 < most:
        p, q, r, s = low * least, low * most, high * least, high * most
        return min(p, q, r, s), max(p, q, r, s)
    # of either sign all through: two products say it, and half of the time of a check goes into products
    if low >= 0:
        return (low * least, high * most) if least >= 0 else (high * least, low * most)
    return (low * most, high * least) if least >= 0 else (high * most, low * least)


def real(number: float | Fraction) -> Number:
    """Raises OverflowError for what is not finite."""
    if isinstance(number, float) and isnan(number):
        raise OverflowError
    top, bottom = number.as_integer_ratio()
    low = (top << BITS) // bottom
    # doubles are whole multiples
    return Number(low, low if isinstance(number, float) else -((-top << BITS) // bottom))


def total(numbers: Iterable[Number]) -> Number:
    return sum(numbers, ZERO)


def largest(*numbers: Number) -> Number:
    return Number(max(number.low for number in numbers), max(number.high for number in numbers))


ZERO, ONE, HALF, J = real(0), real(1), real(0.5), Number(0, 0, (1 << BITS, 1 << BITS))
STEP = Number(1, 1)
#: 0 and 1 to the rounding of the data; the former for both parts of a direction
SPECK = Number(-real(DATA).high, real(DATA).high)
#: goals that count what counterweights cost
COSTS = ("mass", "pieces", "sizes")
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
    x, y = (((value - slack) << BITS - 224, (value + slack) << BITS - 224) for value in sums)
    vector = Number(*x, y)
    for _ in range(quarter):
        vector = vector * J
    return vector


# ---- reading: nothing in the files is trusted

_PI, _LBF = Fraction("3.14159265358979323846264338327950288"), Fraction("4.4482216152605")
UNITS: dict[str, dict[str, Any]] = {
    "m": {"m": 1, "cm": "0.01", "mm": "0.001", "in": "0.0254", "ft": "0.3048"},
    "kg": {"kg": 1, "g": "0.001", "t": 1000, "lb": "0.45359237"},
    "deg": {"deg": 1, "rad": 180 / _PI},
    "rpm": {"rpm": 1, "rad/s": 30 / _PI, "Hz": 60},
    "N": {"N": 1, "kN": 1000, "lbf": _LBF},
    "Pa": {"Pa": 1, "kPa": 1000, "MPa": 10**6, "bar": 10**5, "psi": _LBF / Fraction("0.00064516")},
    "Nm": {"N m": 1, "N mm": "0.001", "lbf ft": _LBF * Fraction("0.3048")},
}
_QUANTITY = re.compile(r"\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d{1,3})?)\s*([A-Za-z][A-Za-z/ ]*?)\s*", re.ASCII)
#: fields of a request that are read here, and those that change nothing of what is checked
COVERAGE = (
    " machine objective accuracy kind speed_rpm rotation reference_plane_m webs max_total_mass_kg throws position_m"
    " crank_radius_m crank_angle_deg rotating_mass_kg rows axis_deg offset_m reciprocating_mass_kg connecting_rod"
    " mass_kg reciprocating_share orbit_radius_m orbiting_mass_kg orbiting_position_m anti_rotation type count"
    " eccentric_mass_kg counterweight_radius_m max_mass_kg sector centre_deg half_angle_deg combine force_weight"
    " moment_weight direction_weights x y force_ceiling_N force_ceiling_x_N force_ceiling_y_N moment_ceiling_Nm"
    " moment_ceiling_x_Nm moment_ceiling_y_Nm least_mass orders relative_gap unbalances x_kg_m y_kg_m"
    " catalogue masses_kg mass_step_kg angle_step_deg max_part_numbers max_counterweights catalogue_masses_kg"
    " hole_angles_deg fixed angle_deg radius_m web_groups mirror max_centrifugal_force_N min_fitted_mass_kg"
    " overspeed_rpm parts motion centre_of_mass_m length_m alternatives"
    " envelope shape inner_radius_m outer_radius_m thickness_m density_kg_m3 max_half_angle_deg "
)
IDLE = (
    " name description throw friction flywheel bearings cylinder cylinders rotation_torque_Nm"
    " tangential_gas_force_N drive_bearing pin_circle_radius_m time_limit_s outputs angles fidelity multipliers"
    " foundation_orders fitted"
    " symmetric points total_mass_budgets_kg bearing_measure balance_quality grade_mm_s"
    " plane_a_m plane_b_m gravity_deg shaft_parts stationary_mass_kg "
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
    text = "".join("/" + str(part).replace("~", "~0").replace("/", "~1") for part in path)
    return text[:200].encode("utf-8", "backslashreplace").decode()


class Place:
    """A value in one of the files, and where it stands; false where there is none."""

    def __init__(self, value: Any, *path: str | int) -> None:
        self.value, self.path = value, path

    def read(self, kinds: tuple[type, ...], name: str, default: Any = None) -> Any:
        value = default if self.value is None else self.value
        if not isinstance(value, kinds) or (isinstance(value, bool) and bool not in kinds):
            raise Unreadable(self.path, f"must be {name}")
        return value

    def __bool__(self) -> bool:
        return self.value is not None

    def __truediv__(self, name: str) -> Place:
        fields = self.value if isinstance(self.value, dict) else self.read((dict,), "an object", {})
        return Place(fields.get(name), *self.path, name)

    def __iter__(self) -> Iterator[Place]:
        return (Place(item, *self.path, k) for k, item in enumerate(self.read((list,), "a list", [])))

    def text(self, *allowed: str, default: str | None = None) -> str:
        value: str = self.read((str,), "a text", default)
        if allowed and value not in allowed:
            raise Unreadable(self.path, f"must be one of {', '.join(allowed)}")
        return value

    def double(self, default: float | None = None, least: float = -inf) -> float:
        """The number as a double; a text with a unit is read in the request, to the nearest double."""
        value = self.read((int, float, str), "a number", default)
        try:
            value = float(self._quantity(value) if isinstance(value, str) else value)
        except OverflowError:
            value = inf
        if not isfinite(value) or value < least:
            raise Unreadable(self.path, f"must be a finite number of at least {least:g}")
        return value

    def whole(self, default: float | None = None, least: float = -inf) -> int:
        """A whole number; a fraction of one is none."""
        value = self.double(default, least)
        if not value.is_integer():
            raise Unreadable(self.path, "must be a whole number")
        return int(value)

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

    def require_coverage(self, also: str = "") -> None:
        """Raises NotCovered where there is a field that is not known, here or to who asks."""
        for name in self.value if isinstance(self.value, dict) else ():
            # a weight of 0 is none
            nothing: tuple[Any, ...] = (None, [], {}, 0) if name.endswith("_weight") else (None, [], {})
            if f" {name} " not in IDLE and (self / name).value not in nothing:
                if f" {name} " not in f"{COVERAGE} {also} ":
                    raise NotCovered(self / name)
                (self / name).require_coverage(also)
        for item in self if isinstance(self.value, list) else ():
            item.require_coverage(also)


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
