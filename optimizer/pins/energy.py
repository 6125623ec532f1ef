"""Work of the pins over one pitch, and their losses beside those of an Oldham ring."""

from collections.abc import Callable

import numpy as np

from optimizer.mechanics.oldham import Keys, Oldham, keys, largest_key, level_angles, pin_losses
from optimizer.numerics.arrays import Real
from optimizer.pins.loads import PeriodicTable, levers
from optimizer.pins.pattern import Pattern
from schemas.scroll.losses import LossComparison, Losses, OldhamLoads
from schemas.scroll.pin_loads import PitchEnergy

#: panels of the integrals, which end where a load changes its sign or a pin begins to bear as well; with play a pin may
#: bear for less than a degree
_PANEL_DEG, _PANEL_WITH_PLAY_DEG, _BISECTIONS = 2.0, 0.5, 44
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(4)


def pitch_energy(pattern: Pattern, torque: PeriodicTable) -> PitchEnergy:
    """W_Q = - integral of sum Q a over one pitch, and W_F = integral of T, for d theta from 0."""
    pitch = 360.0 / pattern.count
    angle, weight = _quadrature(pitch, torque.angle_deg, _PANEL_DEG)
    load = pattern.loads(torque.at(angle), angle)
    pins = -float(np.sum(weight * np.sum(load * levers(pattern.places, angle), axis=-1)))
    work = float(np.sum(weight * torque.at(angle)))
    return PitchEnergy(pitch_deg=pitch, pins_work_J=pins, torque_work_J=work, sum_J=pins + work)


def compared(
    comparison: LossComparison, orbit_radius: float, pattern: Pattern, torque: PeriodicTable, angle_deg: Real
) -> Losses:
    """Losses of the pins and of a ring in their place; the ring's keys at shaft angles (T,) degrees."""
    omega, ring = comparison.speed_rpm * np.pi / 30.0, comparison.oldham_ring
    data = Oldham(*map(np.asarray, (orbit_radius, ring.key_radius_m, ring.mass_kg, np.deg2rad(ring.axis_deg), omega)))

    def pin_forces(angle: Real) -> Real:
        return pattern.loads(torque.at(angle), angle)[:, : pattern.count]

    def key_forces(angle: Real) -> Real:
        ring_keys = keys(data, torque.at(angle), np.deg2rad(angle))
        return np.column_stack([ring_keys.frame, ring_keys.scroll])

    panel = _PANEL_WITH_PLAY_DEG if pattern.has_clearance else _PANEL_DEG
    breaks = np.concatenate([torque.angle_deg, torque.changes_deg])
    # two changes of one pin may be nearer than a panel is wide: of its torque, and of its lever
    levels = np.zeros(0) if pattern.has_clearance else pattern.shapes().phase_deg + np.array([[0.0], [180.0]])
    own = np.concatenate([breaks, pattern.dead_deg, levels.ravel() % 360.0])
    angle, weight = _quadrature(360.0, own, panel, pin_forces)
    of_pins = pin_losses(
        pin_forces(angle),
        np.asarray(comparison.pin_diameter_m),
        np.asarray(comparison.pin_friction_coefficient),
        np.asarray(omega),
    )
    unbounded = not pattern.formula and bool(np.any(torque.at(pattern.dead_deg) != 0.0))
    pins = None if unbounded else float(np.sum(weight * of_pins)) / (2.0 * np.pi)
    friction = np.asarray(ring.friction_coefficient)
    # sliding speeds change their signs on the ring's axis and across it
    axes = np.mod(ring.axis_deg + np.arange(0.0, 360.0, 90.0), 360.0)
    # and loads theirs once at most where they rise or fall throughout
    level = np.rad2deg(level_angles(data, torque.value, np.deg2rad(torque.angle_deg))).ravel() % 360.0
    angle, weight = _quadrature(360.0, np.concatenate([breaks, axes, level]), _PANEL_DEG, key_forces)
    of_ring = keys(data, torque.at(angle), np.deg2rad(angle)).loss(friction)
    loss = float(np.sum(weight * of_ring)) / (2.0 * np.pi)
    at_samples = keys(data, torque.at(angle_deg), np.deg2rad(angle_deg))
    peak = float(largest_key(data, torque.value, np.deg2rad(torque.angle_deg)))
    loads = _ring(at_samples, peak, orbit_radius * omega, loss)
    return Losses(pins_W=pins, oldham_ring=loads, ratio=None if pins is None or loss == 0.0 else pins / loss)


def _ring(keys: Keys, peak: float, speed: float, loss: float) -> OldhamLoads:
    return OldhamLoads(
        frame_key_N=keys.frame,
        scroll_keys_N=tuple((key, second) for key, second in keys.scroll.tolist()),
        frame_speed_m_s=keys.frame_speed,
        scroll_speed_m_s=keys.scroll_speed,
        peak_key_N=peak,
        peak_speed_m_s=speed,
        loss_W=loss,
    )


def _quadrature(
    end_deg: float, breaks_deg: Real, panel_deg: float, forces: Callable[[Real], Real] | None = None
) -> tuple[Real, Real]:
    """Nodes in degrees and weights in radians over [0, end], panel by panel between the breaks.

    forces : whose magnitudes have kinks where they change their signs, (n,) degrees to (n, ...).
    """
    grid = np.linspace(0.0, end_deg, max(1, int(np.ceil(end_deg / panel_deg))) + 1)
    edges = np.unique(np.concatenate([grid, breaks_deg[breaks_deg < end_deg]]))
    if forces is not None:
        edges = np.unique(np.append(edges, _changes(forces, edges)))
    half = 0.5 * np.diff(edges)
    nodes = (edges[:-1] + half)[:, None] + half[:, None] * _NODES
    return nodes.ravel(), np.deg2rad(half[:, None] * _WEIGHTS).ravel()


def _changes(forces: Callable[[Real], Real], edges_deg: Real) -> Real:
    """Where forces change their signs inside panels, become 0 or cease to be, in degrees."""
    sign = np.sign(forces(edges_deg))
    panel, column = np.nonzero(sign[:-1] != sign[1:])
    low, high, first = edges_deg[panel], edges_deg[panel + 1], sign[panel, column]
    for _ in range(_BISECTIONS):
        middle = 0.5 * (low + high)
        same = np.sign(forces(middle))[np.arange(middle.size), column] == first
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    return np.asarray(0.5 * (low + high))
