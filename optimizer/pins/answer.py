"""Loads of the anti-rotation pins of a scroll, from the request to the answer."""

from collections.abc import Iterator

import numpy as np

from optimizer.numerics.arrays import Real
from optimizer.pins.brackets import Peaks
from optimizer.pins.contact import Contact
from optimizer.pins.energy import compared, pitch_energy
from optimizer.pins.loads import PeriodicTable, degrees_of_freedom, gas_torques, levers
from optimizer.pins.pattern import Pattern, pattern_of
from optimizer.pins.peaks import GRID_DEG, is_stuck, turn_peaks
from schemas.base.mappings import or_mapping
from schemas.scroll.over_turn import ForceTable, TorqueTable
from schemas.scroll.pin_loads import (
    DegreesOfFreedom,
    DriveBearingLoad,
    PinContact,
    PinEquilibrium,
    PinLoad,
    PinLoadsAnswer,
    PinLoadsRequest,
    PinWarning,
)

#: balances that close to this share of their terms hold
_ROUNDING = 1e-9


@or_mapping(PinLoadsRequest)
def pin_loads(request: PinLoadsRequest) -> PinLoadsAnswer:
    """What every pin carries over a turn, and whether that holds the scroll at every instant."""
    pattern = pattern_of(request)
    torque, resistance = _torques(request)
    angle = np.arange(request.angles.count, dtype=float) * (360.0 / request.angles.count)
    # at these the formula for one pin and two is worst; entries of the table are the ends of its pieces
    watched = np.concatenate([angle, torque.angle_deg, np.arange(0.0, 360.0, 45.0) + pattern.phase_deg[0]])
    contact = pattern.contact(torque.at(angle), angle) if pattern.has_clearance else None
    load = pattern.loads(torque.at(angle), angle) if contact is None else pattern.with_rest(contact.load)
    stuck = is_stuck(pattern, torque, angle)
    equilibrium = _equilibrium(pattern, torque, watched)
    unbounded = not pattern.formula and bool(np.any(torque.at(pattern.dead_deg) != 0.0))
    peaks = turn_peaks(pattern, torque)
    bears = None if contact is None else (contact.load != 0.0) & ~stuck[:, None]
    halves = None if contact is not None or not torque.keeps_its_sign else _compression_from(pattern, torque)
    pins = tuple(
        PinLoad(
            index=i + 1,
            phase_deg=float(pattern.phase_deg[i]),
            load_N=_without(load[:, i], stuck),
            peak_N=None if unbounded else float(peaks.size[i]),
            peak_bracket_N=None if unbounded else peaks.bracket(i),
            peak_angle_deg=None if unbounded else float(peaks.angle_deg[i]),
            compression_from_deg=None if halves is None else float(halves[i]),
            compression_to_deg=None if halves is None else float((halves[i] + 180.0) % 360.0),
            tension_from_deg=None if halves is None else float((halves[i] + 180.0) % 360.0),
            tension_to_deg=None if halves is None else float(halves[i]),
            carries_load=None if bears is None else tuple(bears[:, i].tolist()),
        )
        for i in range(pattern.count)
    )
    drive = None
    if pattern.drive > 0.0:
        drive = DriveBearingLoad(
            load_N=_without(load[:, -1], stuck),
            peak_N=None if unbounded else float(peaks.size[-1]),
            peak_bracket_N=None if unbounded else peaks.bracket(-1),
            peak_angle_deg=None if unbounded else float(peaks.angle_deg[-1]),
        )
    largest, lever = float(np.max(np.abs(torque.value))), request.orbit_radius_m or 0.0
    return PinLoadsAnswer(
        angle_deg=angle,
        rotation_torque_Nm=torque.at(angle),
        orbiting_resistance_torque_Nm=None if resistance is None else resistance.at(angle),
        pins=pins,
        peak_N=None if unbounded else float(np.max(peaks.size[: pattern.count])),
        peak_bracket_N=None if unbounded else peaks.largest_bracket(pattern.count),
        half_turn_mechanism_peak_N=4.0 * largest / (pattern.count * float(np.mean(pattern.radius))),
        equilibrium=equilibrium,
        dead_points_deg=tuple(pattern.dead_deg.tolist()),
        mechanism=_freedom(pattern.count),
        contact=None if contact is None else _contact(contact.load[:, : pattern.count], contact, stuck),
        drive_bearing=drive,
        energy=pitch_energy(pattern, torque),
        comparison=None if request.comparison is None else compared(request.comparison, lever, pattern, torque, angle),
        warnings=tuple(_warnings(pattern, contact, stuck, None if unbounded else peaks)),
    )


def _torques(request: PinLoadsRequest) -> tuple[PeriodicTable, PeriodicTable | None]:
    """Rotation torque and, from the tangential gas force if any, orbiting resistance torque."""
    force = request.tangential_gas_force_N
    if force is None:
        return _periodic(request.rotation_torque_Nm), None
    table = _periodic(force)
    rotation, resistance = gas_torques(table.value, np.asarray(request.orbit_radius_m))
    return PeriodicTable(table.angle_deg, rotation), PeriodicTable(table.angle_deg, resistance)


def _periodic(torque: float | TorqueTable | ForceTable | None) -> PeriodicTable:
    if isinstance(torque, TorqueTable | ForceTable):
        values = torque.torque_Nm if isinstance(torque, TorqueTable) else torque.force_N
        angle = np.array(torque.angle_deg)
        inside = angle < 360.0
        return PeriodicTable(angle[inside], np.array(values)[inside])
    return PeriodicTable(np.zeros(1), np.array([float(torque or 0.0)]))


def _without(values: Real, left_out: np.ndarray) -> tuple[float | None, ...]:
    return tuple(None if out else value for value, out in zip(values.tolist(), left_out.tolist(), strict=True))


def _compression_from(pattern: Pattern, torque: PeriodicTable) -> Real:
    """Where every load becomes positive, (n,) degrees: half a turn long, since the torque keeps its sign."""
    start = pattern.shapes().phase_deg
    return np.mod(start if torque.value[0] > 0.0 else start + 180.0, 360.0)


def _equilibrium(pattern: Pattern, torque: PeriodicTable, angle: Real) -> PinEquilibrium:
    """Balances of the loads at shaft angles (m,)."""
    moment = torque.at(angle)
    load = pattern.loads(moment, angle)
    lever = levers(pattern.places, angle)
    stuck = is_stuck(pattern, torque, angle)
    dead = np.zeros(0) if pattern.formula else torque.at(pattern.dead_deg)
    residual = np.where(stuck, 0.0, np.sum(load * lever, axis=-1) - moment)
    net = np.where(stuck, 0.0, np.sum(load, axis=-1))
    moment_error = float(max(np.max(np.abs(residual)), np.max(np.abs(dead), initial=0.0)))
    net_force = float(np.max(np.abs(net)))
    used = np.where(stuck[:, None], 0.0, np.abs(load))
    in_balance = np.abs(residual) <= _ROUNDING * np.sum(used * np.max(pattern.radius), axis=-1)
    holds = bool(np.all(in_balance) and np.all(np.abs(net) <= _ROUNDING * np.sum(used, axis=-1)) and not np.any(dead))
    reason = None if holds else _reason(pattern, bool(np.any(dead)))
    return PinEquilibrium(holds=holds, max_moment_error_Nm=moment_error, max_net_force_N=net_force, reason=reason)


def _reason(pattern: Pattern, dead: bool) -> str:
    if pattern.formula:
        force = ", and the sum of the forces is not 0" if pattern.count == 1 else ""
        return (
            f"with {pattern.count} pin(s) the loads give the torque only on the average over a revolution: "
            f"their moment swings between 0 and twice the torque{force}"
        )
    if dead and pattern.drive > 0.0:
        return (
            "all pins are on one line through the shaft's centre; where the eccentric lies along it no pin has a lever"
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


def _contact(pins: Real, contact: Contact, stuck: np.ndarray) -> PinContact:
    bearing = np.sum(pins != 0.0, axis=-1)[~stuck]
    return PinContact(
        fewest_pins=int(np.min(bearing, initial=pins.shape[-1])),
        most_pins=int(np.max(bearing, initial=0)),
        scroll_rotation_deg=_without(np.rad2deg(contact.rotation), stuck),
        load_error_bound_N=float(np.max(contact.error_bound[~stuck], initial=0.0)),
        gap_J=float(np.max(contact.gap[~stuck], initial=0.0)),
    )


def _warnings(
    pattern: Pattern, contact: Contact | None, stuck: np.ndarray, peaks: Peaks | None
) -> Iterator[PinWarning]:
    """``peaks``: None where a dead point has no bound."""
    if pattern.count < 3 and pattern.dead_deg.size:
        message = f"{pattern.count} pin(s) have dead points; at least 3, not on one line, are needed"
        yield PinWarning(code="too_few_pins", message=message)
    elif pattern.count < 3:
        message = "2 pins run, but load the scroll and the drive's bearing unevenly; evenly spaced 3 do not"
        yield PinWarning(code="uneven_load", message=message)
    elif pattern.dead_deg.size:
        yield PinWarning(code="dead_points", message="all pins are on one line and pass dead points")
    largest = 0.0 if contact is None else float(np.max(np.abs(contact.load[~stuck]), initial=0.0))
    # where nothing is carried at all, nothing is open
    if contact is not None and largest > 0.0 and np.any(contact.error_bound[~stuck] > 1e-6 * largest):
        message = "the loads are certified to no more than contact.load_error_bound_N"
        yield PinWarning(code="not_converged", message=message)
    if peaks is not None and not peaks.is_certified:
        message = f"peaks are the largest of samples every {GRID_DEG:g} degrees, refined around the largest; " + (
            "at and beside dead points nothing bounds them"
            if peaks.bound is None
            else "their brackets stayed wider than 1e-6 of the largest"
        )
        yield PinWarning(code="peaks_not_certified", message=message)
