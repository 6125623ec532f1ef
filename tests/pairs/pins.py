"""What an answer on the loads of pins claims that cannot be, evaluated by numpy from the request alone."""

from collections.abc import Iterator

import numpy as np

from optimizer.numerics.arrays import Real
from schemas.scroll.over_turn import ForceTable, TorqueTable
from schemas.scroll.pin_loads import DriveBearingLoad, PinLoad, PinLoadsAnswer, PinLoadsRequest

#: of the sums of the terms, what rounding leaves
_ROUNDING = 1e-8
#: of all loads, by which one may be above its bracket
_BESIDE = 1e-12


def wrong_loads(request: PinLoadsRequest, answer: PinLoadsAnswer) -> Iterator[str]:
    """Moment and force that do not balance, loads that are not elastic, and peaks below a load."""
    angle = np.deg2rad(np.array(answer.angle_deg))
    torque = _torque(request, np.array(answer.angle_deg))
    if np.max(np.abs(torque - answer.rotation_torque_Nm)) > _ROUNDING * np.max(np.abs(torque), initial=1.0):
        yield "the torque is another one"
    carriers = (*answer.pins, *_bearing(answer))
    size = np.nanmax(np.abs(_loads(carriers)), initial=0.0)
    for carrier in carriers:
        yield from _wrong_peaks(carrier, size)
    if answer.peak_N is not None and answer.peak_N != max(pin.peak_N or 0.0 for pin in answer.pins):
        yield "the largest load is that of no pin"
    if not answer.equilibrium.holds:
        if not answer.equilibrium.reason or not answer.warnings:
            yield "the loads do not hold the scroll, and nothing says why"
        return
    yield from _wrong_balance(request, answer, angle, torque)
    if request.count > 2 and not request.has_clearance:
        yield from _wrong_strains(request, answer, angle)


def _torque(request: PinLoadsRequest, angle_deg: Real) -> Real:
    """By linear interpolation, at shaft angles (m,); the lever of a gas force is half of the orbit radius."""
    cause, lever = request.rotation_torque_Nm, 1.0
    if request.tangential_gas_force_N is not None:
        cause, lever = request.tangential_gas_force_N, 0.5 * (request.orbit_radius_m or 0.0)
    if isinstance(cause, TorqueTable | ForceTable):
        values = cause.torque_Nm if isinstance(cause, TorqueTable) else cause.force_N
        return lever * np.interp(angle_deg, cause.angle_deg, values, period=360.0)
    return np.full(angle_deg.shape, lever * (cause or 0.0))


def _places(request: PinLoadsRequest) -> Real:
    """(pins,) complex m."""
    if request.pins is not None:
        return np.array([pin.radius_m * np.exp(1j * np.deg2rad(pin.angle_deg)) for pin in request.pins])
    return (request.pin_circle_radius_m or 0.0) * np.exp(2j * np.pi * np.arange(request.count) / request.count)


def _bearing(answer: PinLoadsAnswer) -> tuple[DriveBearingLoad, ...]:
    return () if answer.drive_bearing is None else (answer.drive_bearing,)


def _loads(carriers: tuple[PinLoad | DriveBearingLoad, ...]) -> Real:
    """(samples, carriers) N; nan at dead points."""
    return np.array([carrier.load_N for carrier in carriers], dtype=float).T


def _levers(request: PinLoadsRequest, angle: Real) -> Real:
    """(samples, pins) m, Im(e^{j theta} conj(z))."""
    return np.imag(np.exp(1j * angle)[:, None] * np.conj(_places(request)))


def _wrong_peaks(carrier: PinLoad | DriveBearingLoad, size: float) -> Iterator[str]:
    loads = np.abs(np.array(carrier.load_N, dtype=float))
    name = f"pin {carrier.index}" if isinstance(carrier, PinLoad) else "the drive's bearing"
    if carrier.peak_bracket_N is None or carrier.peak_N is None:
        if carrier.peak_bracket_N is not None:
            yield f"{name} has a bracket without a peak"
        return
    low, high = carrier.peak_bracket_N
    if not low <= high or carrier.peak_N != low:
        yield f"the peak of {name} is {carrier.peak_N}, its bracket {low} to {high}"
    if np.nanmax(loads, initial=0.0) > high + _BESIDE * size:
        yield f"a load of {name} is above {high}"


def _wrong_balance(request: PinLoadsRequest, answer: PinLoadsAnswer, angle: Real, torque: Real) -> Iterator[str]:
    pins = _loads(answer.pins)
    others = _loads(_bearing(answer)).sum(axis=-1) if answer.drive_bearing is not None else 0.0
    size, lever = np.sum(np.abs(pins), axis=-1), _levers(request, angle)
    left = np.abs(np.sum(pins * lever, axis=-1) - torque)
    if np.any(left > _ROUNDING * np.max(np.abs(_places(request))) * size):
        yield f"a moment of {np.nanmax(left)} N m is open"
    force = np.abs(np.sum(pins, axis=-1) + others)
    if np.any(force > _ROUNDING * size):
        yield f"a force of {np.nanmax(force)} N is open"


def _wrong_strains(request: PinLoadsRequest, answer: PinLoadsAnswer, angle: Real) -> Iterator[str]:
    """Pins strain as their scroll turns and gives way: load over stiffness is a sum of the lever and of a constant."""
    stiffness = np.array([pin.stiffness_N_per_m or 1.0 for pin in request.pins or ()] or [1.0] * request.count)
    strains, levers = _loads(answer.pins) / stiffness, _levers(request, angle)
    rigid, bearing = request.drive_bearing.type == "rigid", request.drive_bearing.stiffness_N_per_m
    for number, (strain, lever) in enumerate(zip(strains, levers, strict=True)):
        if np.any(np.isnan(strain)):
            continue
        motions = np.stack([lever, np.full(lever.shape, 0.0 if rigid else 1.0)], axis=-1)
        motion = np.linalg.lstsq(motions, strain, rcond=None)[0]
        if np.max(np.abs(motions @ motion - strain)) > _ROUNDING * np.max(np.abs(strain)):
            yield f"the loads at sample {number} are not elastic"
            return
        if bearing is not None and answer.drive_bearing is not None:
            load = answer.drive_bearing.load_N[number] or 0.0
            if abs(load / bearing - motion[1]) > _ROUNDING * (np.max(np.abs(strain)) + abs(motion[1])):
                yield f"the load of the drive's bearing at sample {number} is not elastic"
                return
