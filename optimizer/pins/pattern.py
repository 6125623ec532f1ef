"""Pins of a scroll and the drive's bearing as arrays, and the loads of such a pattern."""

from dataclasses import replace

import numpy as np

from optimizer.mechanics.angles import direction
from optimizer.numerics.arrays import Complex, Real
from optimizer.numerics.records import record
from optimizer.pins.contact import Contact, pin_contact
from optimizer.pins.loads import LoadShapes, Pins, at_dead_point, dead_points, elastic_loads, even_pin_loads, levers
from schemas.scroll.pin_loads import PinLoadsRequest


@record(frozen=True)
class Pattern:
    """Pins as arrays (n,). Where the drive's bearing carries, the loads have it as their last column.

    A bearing at the scroll's centre acts as one more pin there, whose lever is always 0.
    """

    phase_deg: Real
    radius: Real
    stiffness: Real
    clearance: Real
    error: Real
    #: whether the loads are those of equation (1) of Liu, Zhao and Li, in equilibrium or not
    formula: bool
    #: stiffness of the drive's bearing: 0 free, inf rigid
    drive: float
    dead_deg: Real

    @property
    def count(self) -> int:
        return int(self.radius.size)

    @property
    def is_rigid(self) -> bool:
        """The scroll's centre stays on the eccentric."""
        return self.drive == np.inf

    @property
    def places(self) -> Complex:
        """Where the loads act, m: the pins, and the drive's bearing where it carries."""
        pins = self.radius * direction(self.phase_deg)
        return np.append(pins, 0.0) if self.drive > 0.0 else pins

    @property
    def pins(self) -> Pins:
        if self.is_rigid:
            return Pins(self.places[:-1], self.stiffness, is_rigid=True)
        return Pins(self.places, self._with_drive(self.stiffness, self.drive))

    @property
    def has_clearance(self) -> bool:
        return not self.formula and bool(np.any(self.clearance > 0.0) or np.any(self.error != 0.0))

    @property
    def play(self) -> tuple[Real, Real]:
        """Clearances and errors of the pins [m], and of an elastic bearing, which has none."""
        return self._with_drive(self.clearance, 0.0), self._with_drive(self.error, 0.0)

    def _with_drive(self, pins: Real, drive: float) -> Real:
        return np.append(pins, drive) if 0.0 < self.drive < np.inf else pins

    def at_dead_point(self, angle_deg: Real) -> np.ndarray:
        """Whether no loads hold a torque at shaft angles (...); the formula has loads at any."""
        return np.zeros(np.shape(angle_deg), dtype=bool) if self.formula else at_dead_point(angle_deg, self.dead_deg)

    def contact(self, torque: Real, angle_deg: Real) -> Contact:
        """Loads with clearances, those of an elastic bearing the last; a rigid one holds the shift at 0."""
        dead = self.at_dead_point(angle_deg)
        # levers are equal at a dead point, and no turn of the scroll changes a strain; digits alone would differ
        lever = np.where(dead[..., None], 0.0, levers(self.pins.place, angle_deg))
        return pin_contact(lever, np.where(dead, 0.0, torque), self.pins.stiffness, *self.play, is_rigid=self.is_rigid)

    def loads(self, torque: Real, angle_deg: Real) -> Real:
        """(..., n) N, or (..., n + 1) with the drive's bearing; at dead points, which hold no torque, those of none."""
        if self.formula:
            return even_pin_loads(torque, self.radius[0], self.count, angle_deg - self.phase_deg[0])
        if self.has_clearance:
            return self.with_rest(self.contact(torque, angle_deg).load)
        return self.with_rest(elastic_loads(np.where(self.at_dead_point(angle_deg), 0.0, torque), self.pins, angle_deg))

    def with_rest(self, load: Real) -> Real:
        """Loads with what a rigid bearing carries: the rest of the net force."""
        return np.concatenate([load, -np.sum(load, axis=-1, keepdims=True)], axis=-1) if self.is_rigid else load

    def shapes(self) -> LoadShapes:
        """Of the same columns as the loads; without clearances."""
        if self.formula:
            return LoadShapes.even(self.phase_deg, float(self.radius[0]))
        return LoadShapes.elastic(self.pins)


def pattern_of(request: PinLoadsRequest) -> Pattern:
    """The pattern of a request. One pin alone on a free bearing has the formula of even pins, there is no other."""
    bearing = request.drive_bearing
    drive = {"free": 0.0, "rigid": np.inf, "elastic": bearing.stiffness_N_per_m or 0.0}[bearing.type]
    if request.pins is None:
        count, ones = request.pin_count or 0, np.ones(request.pin_count or 0)
        phase, radius = 360.0 * np.arange(count) / count, (request.pin_circle_radius_m or 0.0) * ones
        stiffness, clearance, error, even = ones, 0.0 * ones, 0.0 * ones, True
        # equal pins give a bearing nothing to carry, or all it carries: no stiffness of theirs makes a difference
        drive = 1.0 if bearing.type == "elastic" else drive
    else:
        pins = request.pins
        phase = np.array([pin.angle_deg % 360.0 for pin in pins])
        radius = np.array([pin.radius_m for pin in pins])
        stiffness = np.array([1.0 if pin.stiffness_N_per_m is None else pin.stiffness_N_per_m for pin in pins])
        clearance = np.array([pin.clearance_m for pin in pins])
        error = np.array([pin.eccentricity_error_m for pin in pins])
        even = len(pins) == 1
    pattern = Pattern(phase, radius, stiffness, clearance, error, even and drive == 0.0, drive, np.zeros(0))
    return replace(pattern, dead_deg=_dead(pattern, even))


def _dead(pattern: Pattern, even: bool) -> Real:
    """Shaft angles at which no loads hold a torque, (0,) or (2,) degrees."""
    if even and pattern.count < 3:
        return np.sort(np.mod(pattern.phase_deg[0] + np.array([0.0, 180.0]), 360.0))
    if even and pattern.formula:
        return np.zeros(0)
    return dead_points(pattern.places)
