"""The pins that keep a scroll from turning, and what each carries: in doubles.

A pin at z of the scroll has the lever Im(e^{jt} conj(z)) and carries k d T / sum k d^2 with d = Im(e^{jt} conj(w)), w
its distance from where the scroll turns: from the mean of all places, weighted with stiffnesses k, or from the centre
where the drive's bearing is rigid. With c = 2 k |w| / sum k |w|^2 and g the direction of w that is

    T c sin(t - g) / (1 - e cos 2(t - b)),    1 - e = 2 s^2 / (S^2 + s^2)

of the semi-axes S and s of the pattern, the longer one along b. Equal pins around a circle have e = 0.
"""

from __future__ import annotations

from bisect import bisect_right
from cmath import phase, rect
from math import atan2, degrees, hypot, inf, isinf, radians, sin, sqrt
from typing import Dict, List, NamedTuple, Tuple

from verify_numbers import NotCovered, Place, Unreadable

#: pins that leave a line by less than this share of their span are on it; so near to a dead point [rad] nothing is told
LINE = 1e-6
#: by which doubles are off at a usual angle, and where levers are all but equal
_OFF, _NEAR = 1e-12, 1e-13
#: of the largest entry of a torque, by which it may be off beside where it changes its sign
_DIGITS = 4e-15
#: times by which stiffnesses and semi-axes may differ without loss of digits
_ALIKE = 1e3
#: of clearances and errors
_PLAY = 1e-10
#: pins of one machine, evenly spaced ones and others
_MOST, _MOST_UNEVEN = 1000, 200


class Torque:
    """A torque or a force over a revolution: linear between its entries, and from the last on to the first."""

    def __init__(self, place: Place, name: str) -> None:
        table = isinstance(place.value, dict)
        angles = [item.double() for item in place / "angle_deg"] if table else [0.0]
        values = [item.double() for item in place / name] if table else [place.double(0.0)]
        rising = all(a < b for a, b in zip(angles, angles[1:]))
        if not angles or len(angles) != len(values) or not rising or not 0 <= angles[0] <= angles[-1] <= 360:
            raise Unreadable(place.path, "must hold one value for each of its angles, which rise within a revolution")
        inside = [(a, b) for a, b in zip(angles, values) if a < 360]
        self.angles, self.values = [a for a, _ in inside], [b for _, b in inside]

    def times(self, factor: float) -> Torque:
        torque = Torque(Place(0.0), "")
        torque.angles, torque.values = self.angles, [factor * value for value in self.values]
        return torque

    def at(self, angle: float) -> float:
        """At an angle [degrees]."""
        angle %= 360
        k = bisect_right(self.angles, angle) - 1
        count = len(self.angles)
        start, end = self.angles[k], self.angles[(k + 1) % count]
        wide = (end - start) % 360 or 360.0
        low, high = self.values[k], self.values[(k + 1) % count]
        return low + (high - low) * ((angle - start) % 360) / wide

    def work(self, start: float, end: float) -> float:
        """The integral over the angle [rad] between two angles [degrees]."""
        edges = [start, *(a for a in self.angles if start < a < end), end]
        # of what is linear the mean of both ends is exact
        return sum(radians(b - a) * self.at((a + b) / 2) for a, b in zip(edges, edges[1:]))

    @property
    def most(self) -> float:
        return max(map(abs, self.values))

    @property
    def sign(self) -> int:
        """Of all values; 0 where they have several."""
        low, high = min(self.values), max(self.values)
        return 1 if low > 0 else -1 if high < 0 else 0


class Shape(NamedTuple):
    """c [1/m] and g [rad] of one pin, and what c would be of its like that is farthest from where the scroll turns."""

    factor: float
    phase: float
    most: float


class Pins:
    """Pins as a request says them; the drive's bearing, where it carries, is the last of those that carry."""

    def __init__(self, place: Place) -> None:
        bearing, entries = place / "drive_bearing", list(place / "pins")
        kind = (bearing / "type").text("free", "rigid", "elastic", default="free")
        stiffness = (bearing / "stiffness_N_per_m").double(0.0)
        self.drive = {"free": 0.0, "rigid": inf, "elastic": stiffness}[kind]
        if place / "pins":
            if len(entries) > _MOST_UNEVEN:
                raise NotCovered(place / "pins")
            self.phases = [(pin / "angle_deg").double() % 360.0 for pin in entries]
            self.radii = [(pin / "radius_m").double(least=1e-9) for pin in entries]
            self.stiffness = [(pin / "stiffness_N_per_m").double(1.0, least=1e-9) for pin in entries]
            self.clearances = [(pin / "clearance_m").double(0.0) for pin in entries]
            self.errors = [(pin / "eccentricity_error_m").double(0.0) for pin in entries]
            self.even = len(entries) == 1
        else:
            count = (place / "pin_count").whole(least=1)
            if count > _MOST:
                raise NotCovered(place / "pin_count")
            self.phases = [360.0 * k / count for k in range(count)]
            self.radii = [(place / "pin_circle_radius_m").double(least=1e-9)] * count
            self.stiffness, self.even = [1.0] * count, True
            self.clearances = self.errors = [0.0] * count
            # equal pins give a bearing nothing to carry, or all of it
            self.drive = 1.0 if kind == "elastic" else self.drive
        if not self.phases or (kind == "elastic" and not self.drive):
            raise Unreadable(place.path, "must have pins, and an elastic bearing its stiffness")
        self.formula = self.even and self.drive == 0
        self.is_rigid = isinf(self.drive)
        self.places = [rect(radius, radians(angle)) for radius, angle in zip(self.radii, self.phases)]
        self.loose = not self.formula and (any(self.clearances) or any(self.errors))
        self.dead = self._dead()
        self._shapes()

    @property
    def count(self) -> int:
        return len(self.phases)

    def _dead(self) -> List[float]:
        """Angles at which nothing holds a torque [degrees]."""
        if self.even and self.count < 3:
            return sorted((self.phases[0] + half) % 360 for half in (0.0, 180.0))
        if self.even:
            return []
        places = [*self.places, *([0j] if self.drive else [])]
        mean = sum(places) / len(places)
        shape = ellipse([place - mean for place in places], [1.0] * len(places))
        major, minor, along = shape
        if abs(minor - LINE * major) <= 1e-4 * LINE * major:
            raise NotCovered(Place({}, "request"))
        first = _round(degrees(along)) % 180
        return [] if minor > LINE * major else [first, first + 180]

    def _shapes(self) -> None:
        """Of all that carries: the pins, and the drive's bearing."""
        if self.formula or (self.even and self.count > 2):
            factor = 2 / (self.count * self.radii[0])
            self.shapes = [Shape(factor, radians(angle), factor) for angle in self.phases]
            self.shapes += [Shape(0.0, 0.0, factor * self.count)] if self.drive else []
            self.flat, self.rest, self.axis = 0.0, 1.0, 0.0
            return
        most = max([*self.stiffness, *([] if self.is_rigid else [self.drive])])
        weights = [stiffness / most for stiffness in self.stiffness]
        places = list(self.places)
        if self.drive and not self.is_rigid:
            places, weights = [*places, 0j], [*weights, self.drive / most]
        whole = sum(weights)
        # from pin to pin: beside a pin that is much stiffer than the others the mean would cancel
        offsets = (
            places
            if self.is_rigid
            else [sum(weight * (place - other) for other, weight in zip(places, weights)) / whole for place in places]
        )
        major, minor, self.axis = ellipse(offsets, weights)
        square = major**2 + minor**2
        if square <= 0:
            raise NotCovered(Place({}, "request"))
        self.flat, self.rest = (major - minor) * (major + minor) / square, 2 * minor**2 / square
        pushes = [weight * offset for weight, offset in zip(weights, offsets)]
        if self.is_rigid:
            pushes.append(-sum(pushes))
        far = max(map(abs, offsets))
        sizes = [weight * far for weight in weights]
        sizes += [sum(sizes)] if self.is_rigid else []
        pairs = zip(pushes, sizes)
        self.shapes = [Shape(2 * abs(push) / square, phase(push), 2 * size / square) for push, size in pairs]

    def below(self, angle: float) -> float:
        """1 - e cos 2(t - b) at an angle [rad]."""
        return self.rest + 2 * self.flat * sin(angle - self.axis) ** 2

    def load(self, k: int, torque: float, angle: float, most: float = 0.0) -> Tuple[float, float]:
        """What a pin carries at an angle [degrees], and by how much doubles may be off [N]; ``most``: of the torque."""
        angle_rad, shape = radians(angle), self.shapes[k]
        below = self.below(angle_rad)
        if below <= 0:
            return 0.0, 0.0
        off = shape.most / below * (abs(torque) * (_OFF + _NEAR / sqrt(below)) + _DIGITS * most)
        return torque * shape.factor / below * sin(angle_rad - shape.phase), off

    @property
    def steady(self) -> bool:
        """Whether rounding leaves their loads in balance beyond doubt."""
        alike = max(self.stiffness) <= _ALIKE * min([*self.stiffness, *([] if self.is_rigid else [self.drive or inf])])
        return not self.loose and self.rest >= 1 / _ALIKE and (alike or self.even)

    @property
    def noise(self) -> float:
        """Loads that the digits of clearances and errors leave where there is no torque [N]."""
        strained = zip(self.stiffness, self.clearances, self.errors)
        return _PLAY * max(stiffness * (play + abs(error)) for stiffness, play, error in strained)

    def is_dead(self, angle: float) -> bool:
        """Whether a dead point is so near that nothing is told."""
        return not self.formula and any(abs((angle - dead + 180) % 360 - 180) <= degrees(LINE) for dead in self.dead)

    def lever(self, k: int, angle: float) -> float:
        """Of a pin at an angle [degrees]."""
        return self.radii[k] * sin(radians(angle - self.phases[k]))


class Turn(NamedTuple):
    """Pins and the torque on them over a revolution."""

    pins: Pins
    torque: Torque
    angles: List[float]  # of the samples, degrees

    def is_stuck(self, angle: float) -> bool:
        """Whether there is a torque where nothing holds it."""
        return self.pins.is_dead(angle) and self.torque.at(angle) != 0

    @property
    def is_unbounded(self) -> bool:
        """Whether there is one anywhere."""
        return not self.pins.formula and any(self.torque.at(dead) for dead in self.pins.dead)


def _round(angle: float) -> float:
    """A round figure [degrees] where rounding alone keeps an angle off it: a torque may be 0 there alone."""
    figure = round(angle, 6)
    return figure if abs(angle - figure) < 1e-10 else angle


def ellipse(offsets: List[complex], weights: List[float]) -> Tuple[float, float, float]:
    """Semi-axes of sum k w w^T, and the direction of the longer one [rad]."""
    xx = sum(k * w.real**2 for k, w in zip(weights, offsets))
    yy = sum(k * w.imag**2 for k, w in zip(weights, offsets))
    xy = sum(k * w.real * w.imag for k, w in zip(weights, offsets))
    area, rooted = 0.0, [sqrt(k) * w for k, w in zip(weights, offsets)]
    for n, vector in enumerate(rooted):
        # the area from pairs, in which a pattern near a line keeps its width
        area += sum((vector.conjugate() * other).imag ** 2 for other in rooted[n + 1 :])
    major = sqrt((xx + yy + hypot(xx - yy, 2 * xy)) / 2)
    return major, sqrt(area) / major if major > 0 else 0.0, atan2(2 * xy, xx - yy) / 2


def causes(place: Place) -> Dict[str, Torque]:
    """The torque that turns the scroll, and where its cause is given what the motor overcomes beside."""
    force = place / "tangential_gas_force_N"
    if not force:
        return {"rotation": Torque(place / "rotation_torque_Nm", "torque_Nm")}
    # the force acts midway between both centres: half of the orbit is its lever on the scroll
    lever, table = (place / "orbit_radius_m").double(), Torque(force, "force_N")
    return {"rotation": table.times(lever / 2), "resistance": table.times(lever)}
