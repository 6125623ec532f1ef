"""Loads of the anti-rotation pins of a scroll, from the request to the answer."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from optimizer.arrays import Real
from optimizer.mechanics.angles import direction
from optimizer.pins.contact import Contact, pin_contact
from optimizer.pins.loads import (
    LoadShapes,
    PeriodicTable,
    Pins,
    at_dead_point,
    dead_points,
    degrees_of_freedom,
    elastic_loads,
    even_pin_loads,
    gas_torques,
    levers,
    peaks,
)
from schemas.over_turn import ForceTable, TorqueTable
from schemas.scroll import (
    DegreesOfFreedom,
    PinContact,
    PinEquilibrium,
    PinLoad,
    PinLoadsAnswer,
    PinLoadsRequest,
    PinWarning,
)

#: balances that close to this share of their terms hold
_ROUNDING = 1e-9
#: grid of the search for peaks with clearances or dead points, which does not depend on the samples
_GRID_DEG = 0.5
_REFINEMENTS, _PARTS = 8, 16


@dataclass(frozen=True)
class _Pattern:
    """Pins as arrays (n,)."""

    phase_deg: Real
    radius: Real
    stiffness: Real
    clearance: Real
    error: Real
    #: whether the loads are those of the seed's formula, in equilibrium or not
    formula: bool
    dead_deg: Real

    @property
    def pins(self) -> Pins:
        return Pins(self.radius * direction(self.phase_deg), self.stiffness)

    @property
    def has_clearance(self) -> bool:
        return not self.formula and bool(np.any(self.clearance > 0.0) or np.any(self.error != 0.0))

    def contact(self, torque: Real, angle_deg: Real) -> Contact:
        lever = levers(self.pins.place, angle_deg)
        return pin_contact(lever, torque, self.stiffness, self.clearance, self.error)

    def loads(self, torque: Real, angle_deg: Real) -> Real:
        """(..., n) N; without meaning at dead points."""
        if self.formula:
            return even_pin_loads(torque, self.radius[0], self.radius.size, angle_deg - self.phase_deg[0])
        if self.has_clearance:
            return self.contact(torque, angle_deg).load
        return elastic_loads(torque, self.pins, angle_deg)


def pin_loads(request: PinLoadsRequest) -> PinLoadsAnswer:
    """What every pin carries over a turn, and whether that holds the scroll at every instant."""
    pattern = _pattern(request)
    torque, resistance = _torques(request)
    angle = np.arange(request.angles.count, dtype=float) * (360.0 / request.angles.count)
    # at these the formula for one pin and two is worst; entries of the table are the ends of its pieces
    watched = np.concatenate([angle, torque.angle_deg, np.arange(0.0, 360.0, 45.0) + pattern.phase_deg[0]])
    contact = pattern.contact(torque.at(angle), angle) if pattern.has_clearance else None
    load = pattern.loads(torque.at(angle), angle) if contact is None else contact.load
    stuck = np.zeros(angle.shape, dtype=bool)
    if not pattern.formula:
        stuck = at_dead_point(angle, pattern.dead_deg) & (torque.at(angle) != 0.0)
    equilibrium = _equilibrium(pattern, torque, watched)
    unbounded = not pattern.formula and bool(np.any(torque.at(pattern.dead_deg) != 0.0))
    peak, peak_angle = _peaks(pattern, torque)
    bears = None if contact is None else (contact.load != 0.0) & ~stuck[:, None]
    halves = None if contact is not None or not torque.keeps_its_sign else _compression_from(pattern, torque)
    pins = tuple(
        PinLoad(
            index=i + 1,
            phase_deg=float(pattern.phase_deg[i]),
            load_N=_without(load[:, i], stuck),
            peak_N=None if unbounded else float(peak[i]),
            peak_angle_deg=None if unbounded else float(peak_angle[i]),
            compression_from_deg=None if halves is None else float(halves[i]),
            compression_to_deg=None if halves is None else float((halves[i] + 180.0) % 360.0),
            tension_from_deg=None if halves is None else float((halves[i] + 180.0) % 360.0),
            tension_to_deg=None if halves is None else float(halves[i]),
            carries_load=None if bears is None else tuple(bears[:, i].tolist()),
        )
        for i in range(pattern.radius.size)
    )
    largest = float(np.max(np.abs(torque.value)))
    return PinLoadsAnswer(
        angle_deg=tuple(angle.tolist()),
        rotation_torque_Nm=tuple(torque.at(angle).tolist()),
        orbiting_resistance_torque_Nm=None if resistance is None else tuple(resistance.at(angle).tolist()),
        pins=pins,
        peak_N=None if unbounded else float(np.max(peak)),
        half_turn_mechanism_peak_N=4.0 * largest / (pattern.radius.size * float(np.mean(pattern.radius))),
        equilibrium=equilibrium,
        dead_points_deg=tuple(pattern.dead_deg.tolist()),
        mechanism=_freedom(pattern.radius.size),
        contact=None if contact is None else _contact(contact, stuck),
        warnings=tuple(_warnings(pattern, contact, stuck)),
    )


def _pattern(request: PinLoadsRequest) -> _Pattern:
    """Pins as they are given. One pin alone has the seed's formula, there is no other."""
    if request.pins is None:
        count, radius = request.pin_count or 0, request.pin_circle_radius_m or 0.0
        phase = 360.0 * np.arange(count) / count
        ones = np.ones(count)
        dead = np.array([0.0, 180.0]) if count < 3 else np.zeros(0)
        return _Pattern(phase, radius * ones, ones, 0.0 * ones, 0.0 * ones, True, dead)
    pins = request.pins
    phase = np.array([pin.angle_deg % 360.0 for pin in pins])
    radius_given = np.array([pin.radius_m for pin in pins])
    if len(pins) == 1:
        dead = np.sort(np.mod(phase + np.array([0.0, 180.0]), 360.0))
    else:
        dead = dead_points(radius_given * direction(phase))
    return _Pattern(
        phase,
        radius_given,
        np.array([1.0 if pin.stiffness_N_per_m is None else pin.stiffness_N_per_m for pin in pins]),
        np.array([pin.clearance_m for pin in pins]),
        np.array([pin.eccentricity_error_m for pin in pins]),
        len(pins) == 1,
        dead,
    )


def _torques(request: PinLoadsRequest) -> tuple[PeriodicTable, PeriodicTable | None]:
    """Rotation torque and, if its cause is given, orbiting resistance torque."""
    force = request.tangential_gas_force_N
    if force is None:
        return _periodic(request.rotation_torque_Nm), None
    given = _periodic(force)
    rotation, resistance = gas_torques(given.value, np.asarray(request.orbit_radius_m))
    return PeriodicTable(given.angle_deg, rotation), PeriodicTable(given.angle_deg, resistance)


def _periodic(given: float | TorqueTable | ForceTable | None) -> PeriodicTable:
    if isinstance(given, TorqueTable | ForceTable):
        values = given.torque_Nm if isinstance(given, TorqueTable) else given.force_N
        angle = np.array(given.angle_deg)
        inside = angle < 360.0
        return PeriodicTable(angle[inside], np.array(values)[inside])
    return PeriodicTable(np.zeros(1), np.array([float(given or 0.0)]))


def _without(values: Real, left_out: np.ndarray) -> tuple[float | None, ...]:
    return tuple(None if out else value for value, out in zip(values.tolist(), left_out.tolist(), strict=True))


def _compression_from(pattern: _Pattern, torque: PeriodicTable) -> Real:
    """Where every load becomes positive, (n,) degrees: half a turn long, since the torque keeps its sign."""
    start = _shapes(pattern).phase_deg
    return np.mod(start if torque.value[0] > 0.0 else start + 180.0, 360.0)


def _shapes(pattern: _Pattern) -> LoadShapes:
    if pattern.formula:
        return LoadShapes.even(pattern.phase_deg, float(pattern.radius[0]))
    return LoadShapes.elastic(pattern.pins)


def _peaks(pattern: _Pattern, torque: PeriodicTable) -> tuple[Real, Real]:
    """Largest magnitudes (n,) N over the turn and their angles (n,) degrees."""
    if not pattern.has_clearance and (pattern.formula or not pattern.dead_deg.size):
        return peaks(_shapes(pattern), torque)

    def size(angle_deg: Real) -> Real:
        load = np.abs(pattern.loads(torque.at(angle_deg), angle_deg))
        return np.where(at_dead_point(angle_deg, pattern.dead_deg)[..., None], 0.0, load)

    return _refined_peaks(size, np.concatenate([np.arange(0.0, 360.0, _GRID_DEG), torque.angle_deg]))


def _refined_peaks(size: Callable[[Real], Real], grid_deg: Real) -> tuple[Real, Real]:
    """Largest values of every pin, from the best of a grid by ever finer ones around it."""
    on_grid = size(grid_deg)
    best = grid_deg[np.argmax(on_grid, axis=0)]
    half, pin = _GRID_DEG, np.arange(best.size)
    for _ in range(_REFINEMENTS):
        near = best[:, None] + half * np.linspace(-1.0, 1.0, _PARTS + 1)
        found = size(near)[pin[:, None], np.arange(_PARTS + 1), pin[:, None]]
        best = near[pin, np.argmax(found, axis=-1)]
        half *= 2.0 / _PARTS
    return np.max(found, axis=-1), np.mod(best, 360.0)


def _equilibrium(pattern: _Pattern, torque: PeriodicTable, angle: Real) -> PinEquilibrium:
    """Balances of the loads at shaft angles (m,)."""
    moment = torque.at(angle)
    load = pattern.loads(moment, angle)
    lever = levers(pattern.pins.place, angle)
    stuck = np.zeros(angle.shape, dtype=bool)
    dead = np.zeros(0)
    if not pattern.formula:
        stuck, dead = at_dead_point(angle, pattern.dead_deg), torque.at(pattern.dead_deg)
    turned = np.where(stuck, 0.0, np.sum(load * lever, axis=-1) - moment)
    net = np.where(stuck, 0.0, np.sum(load, axis=-1))
    moment_error = float(max(np.max(np.abs(turned)), np.max(np.abs(dead), initial=0.0)))
    net_force = float(np.max(np.abs(net)))
    used = np.where(stuck[:, None], 0.0, np.abs(load))
    in_balance = np.abs(turned) <= _ROUNDING * np.sum(used * np.max(pattern.radius), axis=-1)
    holds = bool(np.all(in_balance) and np.all(np.abs(net) <= _ROUNDING * np.sum(used, axis=-1)) and not np.any(dead))
    reason = None if holds else _reason(pattern, bool(np.any(dead)))
    return PinEquilibrium(holds=holds, max_moment_error_Nm=moment_error, max_net_force_N=net_force, reason=reason)


def _reason(pattern: _Pattern, dead: bool) -> str:
    if pattern.formula:
        force = ", and the sum of the forces is not 0" if pattern.radius.size == 1 else ""
        return (
            f"with {pattern.radius.size} pin(s) the loads give the torque only on the average over a turn: "
            f"their moment swings between 0 and twice the torque{force}"
        )
    if dead:
        return (
            "all pins are on one line; where the eccentric lies along it their levers are equal, "
            "and no loads without a net force hold a torque"
        )
    return (
        "rounding leaves more than 1e-9 of the loads out of balance: "
        "stiffnesses too unequal, or clearances far beyond the strains"
    )


def _freedom(count: int) -> DegreesOfFreedom:
    links, pairs, repeated, freedom = degrees_of_freedom(count)
    return DegreesOfFreedom(
        moving_links=links,
        lower_pairs=pairs,
        higher_pairs=0,
        virtual_constraints=repeated,
        local_freedoms=0,
        degrees_of_freedom=freedom,
    )


def _contact(contact: Contact, stuck: np.ndarray) -> PinContact:
    bearing = np.sum(contact.load != 0.0, axis=-1)[~stuck]
    return PinContact(
        fewest_pins=int(np.min(bearing, initial=contact.load.shape[-1])),
        most_pins=int(np.max(bearing, initial=0)),
        scroll_rotation_deg=_without(np.rad2deg(contact.rotation), stuck),
        load_error_bound_N=float(np.max(contact.error_bound[~stuck], initial=0.0)),
        gap_J=float(np.max(contact.gap[~stuck], initial=0.0)),
    )


def _warnings(pattern: _Pattern, contact: Contact | None, stuck: np.ndarray) -> Iterator[PinWarning]:
    if pattern.radius.size < 3:
        message = f"{pattern.radius.size} pin(s) have dead points; at least 3, not on one line, are needed"
        yield PinWarning(code="too_few_pins", message=message)
    elif pattern.dead_deg.size:
        yield PinWarning(code="dead_points", message="all pins are on one line and pass dead points")
    if contact is not None:
        largest = np.max(np.abs(contact.load), axis=-1)
        if np.any((contact.error_bound > 1e-6 * largest) & ~stuck):
            message = "the loads are certified to no more than contact.load_error_bound_N"
            yield PinWarning(code="not_converged", message=message)
