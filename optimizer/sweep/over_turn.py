"""Figures of the dynamics for many designs at once: gas, rod loads, torque, flywheel, bearings.

The same mechanics in the same order as the effects of one machine (:mod:`optimizer.effects.dynamics`), on arrays
with a leading axis, and only as far as the outputs call for them.
"""

from dataclasses import dataclass, fields, is_dataclass
from functools import cached_property
from typing import Any, NamedTuple, TypeVar

import numpy as np

from optimizer.arrays import Complex, Real
from optimizer.effects.registry import OUTPUTS, effects_of
from optimizer.mechanics.bearings import continuous_beam, simple_spans
from optimizer.mechanics.cylinders import chambers as chambers_of
from optimizer.mechanics.friction import reciprocating_friction, share_of_losses
from optimizer.mechanics.gas import Chambers, gas_forces, indicated_work, switching_angles
from optimizer.mechanics.kinematics import Motion, motion, own_angle, steep_angles
from optimizer.mechanics.layout import Layout, stacked
from optimizer.mechanics.rod import rod_forces, shaft_loads
from optimizer.mechanics.turn import fluctuation, mean, panels
from schemas.machine import ReciprocatingMachine
from schemas.requests import AnalyzeRequest, OptimizeRequest

_WIDEST_PANEL = np.deg2rad(10.0)
#: outputs whose figures come from integrals over the turn
_INTEGRALS = frozenset({"torque", "flywheel"})
#: outputs whose figures come from samples of the turn
_SAMPLED = frozenset({"piston_force", "rod_loads", "torque", "overturning", "main_bearings"})
OVER_THE_TURN = _INTEGRALS | _SAMPLED | {"gas"}

#: parts of a layout that have one value for each machine
_OF_THE_WHOLE = frozenset({"omega", "sense", "centre_plane", "reference_plane"})

Arrays = TypeVar("Arrays")


class Forces(NamedTuple):
    """What acts on the pistons, (n, rows, T) N."""

    motion: Motion
    gas: Real
    inertia: Real
    friction: Real

    @property
    def total(self) -> Real:
        return self.gas + self.inertia + self.friction


@dataclass(frozen=True)
class Drive:
    """Machines of one shape with all that turns and moves in them; every array has the leading axis (n,)."""

    machine: ReciprocatingMachine
    layout: Layout
    exact: bool

    @cached_property
    def chambers(self) -> Chambers:
        return with_leading(chambers_of(self.machine), self.layout.omega.size)

    @cached_property
    def power(self) -> Real:
        """Indicated power of the rows, (n, rows) W."""
        work = np.sum(indicated_work(self.chambers, self.layout), axis=-1)
        return work * self.layout.omega[:, None] / (2.0 * np.pi)

    @cached_property
    def friction(self) -> tuple[Real, Real]:
        """Friction force of the rows (n, rows) N, and torque of the shaft (n,) N m."""
        data, stroke = self.machine.friction, 2.0 * self.layout.reciprocating.crank_radius
        count = stroke.shape[:1]
        if data is None:
            return np.zeros_like(stroke), np.zeros(count)
        if data.mechanical_efficiency is None:
            given, torque = data.reciprocating_force_N, data.rotating_torque_Nm
            magnitude = np.zeros_like(stroke) if given is None else stacked(given)
            return np.broadcast_to(magnitude, stroke.shape), np.broadcast_to(0.0 if torque is None else torque, count)
        indicated = self.power if data.indicated_power_W is None else stacked(data.indicated_power_W)
        efficiency, share = (
            np.broadcast_to(np.asarray(value, dtype=float), count)
            for value in (data.mechanical_efficiency, data.reciprocating_share)
        )
        return share_of_losses(np.broadcast_to(indicated, stroke.shape), efficiency, share, stroke, self.layout.omega)

    def forces(self, angle: Real) -> Forces:
        """Forces on the pistons at shaft angles (T,) or (n, T) rad."""
        moving = motion(self.layout, angle, self.exact)
        gas = gas_forces(self.chambers, moving, self.layout).total
        inertia = self.layout.reciprocating.mass[..., None] * moving.acceleration
        return Forces(moving, gas, inertia, reciprocating_friction(moving, self.friction[0]))

    def torque(self, forces: Forces) -> Real:
        """Torque of rows and shaft against rotation, (n, T) N m."""
        rows = rod_forces(forces.total, forces.motion, self.layout).torque
        return np.sum(rows, axis=-2) + self.friction[1][:, None]


def figures(request: OptimizeRequest | AnalyzeRequest, layout: Layout, unbalance: Complex) -> dict[str, Real]:
    """Columns of the outputs over the turn, (n,) each.

    Parameters
    ----------
    request : of columns, valid and complete.
    layout : of its machine.
    unbalance : (n, webs) kg m, the counterweights.
    """
    asked = OVER_THE_TURN.intersection(request.outputs)
    if not asked:
        return {}
    assert isinstance(request.machine, ReciprocatingMachine)  # missing inputs otherwise
    drive = Drive(request.machine, with_leading(layout, unbalance.shape[0]), request.fidelity.kinematics == "exact")
    found: dict[str, Real] = {"indicated_power_W": np.sum(drive.power, axis=-1)}
    if asked & _INTEGRALS:
        found |= _integrals(drive)
    if asked & _SAMPLED:
        found |= _extremes(drive, request, asked, unbalance)
    return found


def work_per_design(request: OptimizeRequest | AnalyzeRequest) -> int:
    """Rows times angles that one design needs at once, which bounds the memory of a block; 0 without any."""
    asked = OVER_THE_TURN.intersection(request.outputs)
    if not isinstance(request.machine, ReciprocatingMachine) or "kinematics" not in effects_of(
        [need for output in asked for need in OUTPUTS[output].needs]
    ):
        return 0
    rows = sum(len(throw.rows) for throw in request.machine.throws)
    samples = request.angles.count if asked & _SAMPLED else 1
    # a row brings at most 6 breaks, and the halved panels of 10 degrees have 12 nodes each
    nodes = 24 * (36 + 6 * rows) if asked & _INTEGRALS else 1
    return max(rows, 1) * max(samples, nodes)


def with_leading(part: Arrays, count: int) -> Arrays:
    """Arrays that all have the leading axis (count,); what was common to all designs is repeated, not copied."""
    own = 2 if isinstance(part, Chambers) else 1
    spread: dict[str, Any] = {}
    for field in fields(part):  # type: ignore[arg-type]
        value = getattr(part, field.name)
        if is_dataclass(value):
            spread[field.name] = with_leading(value, count)
        elif value is not None:
            shape = value.shape[value.ndim - (0 if field.name in _OF_THE_WHOLE else own) :]
            spread[field.name] = np.broadcast_to(value, (count, *shape))
    return type(part)(**spread)


def _integrals(drive: Drive) -> dict[str, Real]:
    """Means and ranges over the turn, whatever the samples."""
    layout = drive.layout
    ahead = own_angle(layout, np.zeros(1))
    ratio = layout.reciprocating.rod_ratio
    # valves open and rows reverse at these own angles; between them all is smooth
    dead = np.broadcast_to([0.0, np.pi], (*ratio.shape, 2))
    own = np.concatenate([*switching_angles(drive.chambers, layout), dead, steep_angles(ratio)], axis=-1)
    breaks = (own - ahead).reshape(ratio.shape[0], -1)
    fine = panels(breaks[:, ~np.all(np.isnan(breaks), axis=0)], _WIDEST_PANEL, halved=True)
    torque = drive.torque(drive.forces(fine.angle))
    middle, energy = mean(fine, torque), fluctuation(fine, torque)
    magnitude, rotating = drive.friction
    per_turn = np.sum(magnitude * 4.0 * layout.reciprocating.crank_radius, axis=-1)
    found = {
        "mean_torque_Nm": middle,
        "fluctuation_energy_J": energy,
        "shaft_power_W": middle * layout.omega,
        "friction_power_W": per_turn * layout.omega / (2.0 * np.pi) + rotating * layout.omega,
    }
    wheel = drive.machine.flywheel
    if wheel is not None:
        # delta = dE / (J omega^2), seed 004 (2-28)
        share = energy / layout.omega**2
        known = wheel.inertia_kg_m2 if wheel.irregularity is None else wheel.irregularity
        given = np.broadcast_to(np.asarray(known, dtype=float), energy.shape)
        other = share / given
        irregularity, inertia = (other, given) if wheel.irregularity is None else (given, other)
        found |= {"irregularity": irregularity, "inertia_J_kg_m2": inertia}
    return found


def _extremes(
    drive: Drive, request: OptimizeRequest | AnalyzeRequest, asked: frozenset[str], unbalance: Complex
) -> dict[str, Real]:
    """Largest magnitudes among the samples."""
    angle = np.deg2rad(np.arange(request.angles.count, dtype=float) * (360.0 / request.angles.count))
    forces = drive.forces(angle)
    total, cosine = forces.total, forces.motion.rod_angle_cosine
    found: dict[str, Real] = {}
    if "piston_force" in asked:
        found["peak_piston_force_N"] = _largest(total)
    if "rod_loads" in asked:
        # running, without gas, gas alone (seed 004 section 2.5)
        cases = (total, forces.inertia + forces.friction, forces.gas)
        found["peak_rod_load_N"] = np.max([_largest(case / cosine) for case in cases], axis=0)
    if "torque" in asked:
        found["peak_torque_Nm"] = _largest(drive.torque(forces))
    if "overturning" in asked:
        couple = rod_forces(total, forces.motion, drive.layout).overturning
        found["peak_overturning_Nm"] = _largest(np.sum(couple, axis=-2))
    if "main_bearings" in asked:
        found["peak_bearing_load_N"] = _bearing_load(drive, request, total, forces.motion, angle, unbalance)
    return found


def _bearing_load(
    drive: Drive,
    request: OptimizeRequest | AnalyzeRequest,
    total: Real,
    moving: Motion,
    angle: Real,
    unbalance: Complex,
) -> Real:
    layout = drive.layout
    planes, loads = shaft_loads(total, moving, layout, angle)
    turn = np.exp(1j * layout.sense[:, None] * angle)
    iron = (unbalance * layout.omega[:, None] ** 2)[..., None] * turn[:, None, :]
    places = stacked([bearing.position_m for bearing in drive.machine.bearings])
    spread = simple_spans if request.fidelity.shaft == "simple_spans" else continuous_beam
    everywhere = np.concatenate([planes, layout.webs.position], axis=-1)
    return _largest(spread(places, everywhere, np.concatenate([loads, iron], axis=-2)))


def _largest(values: Real | Complex) -> Real:
    """Largest magnitude of each design (n, ...); 0 where there is nothing."""
    return np.max(np.abs(values).reshape(values.shape[0], -1), axis=-1, initial=0.0)
