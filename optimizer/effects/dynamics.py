"""Effects over the turn: motion, gas, friction, forces in the mechanism, torque, flywheel, main bearings."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from optimizer.arrays import Complex, Real
from optimizer.effects.effect import Context, Effect
from optimizer.effects.inertia import RODS, rod_problems
from optimizer.mechanics.cylinders import chambers, delivery_problems, gas_problems
from optimizer.mechanics.friction import reciprocating_friction, share_of_losses
from optimizer.mechanics.gas import Chambers, GasForces, gas_forces, indicated_work, switching_angles
from optimizer.mechanics.kinematics import Motion, motion, own_angle, steep_angles
from optimizer.mechanics.layout import layout as layout_of
from optimizer.mechanics.rod import RodForces, rod_forces, shaft_loads
from optimizer.mechanics.turn import fluctuation, mean, panels
from schemas.base import FieldProblem
from schemas.machine import Machine, ReciprocatingMachine

_WIDEST_PANEL = np.deg2rad(10.0)
#: rows times angles that are worked on at once, which bounds the memory
_AT_ONCE = 500_000


@dataclass(frozen=True)
class GasCycle:
    """Gas of all rows: chambers, forces over the samples, switching angles and work of a turn."""

    chambers: Chambers
    forces: GasForces
    suction_opens: Real  # (rows, 2) rad, own crank angle
    discharge_opens: Real  # (rows, 2) rad
    work: Real  # (rows, 2) J
    power: Real  # (rows,) W, indicated


@dataclass(frozen=True)
class FrictionForces:
    """Friction of all rows over the samples, and of the shaft."""

    magnitude: Real  # (rows,) N
    force: Real  # (rows, T) N
    torque: float  # N m


@dataclass(frozen=True)
class PistonForces:
    """What acts on the pistons, (rows, T) N."""

    gas: Real
    inertia: Real
    friction: Real
    total: Real


@dataclass(frozen=True)
class TorqueSeries:
    """Torque over the samples, N m."""

    rows: Real  # (rows, T)
    total: Real  # (T,)
    rotating_friction: float


@dataclass(frozen=True)
class TorqueIntegrals:
    """Means and ranges over the turn, whatever the samples."""

    row_mean: Real  # (rows,) N m
    mean: float  # N m
    mean_error: float
    fluctuation: float  # J
    fluctuation_error: float
    indicated_power: float  # W
    friction_power: float  # W


@dataclass(frozen=True)
class FlywheelFigures:
    """Irregularity and inertia that belong to each other."""

    irregularity: float
    inertia: float  # kg m^2


def _reciprocating(machine: Machine) -> ReciprocatingMachine:
    assert isinstance(machine, ReciprocatingMachine)  # checked by the problems of every effect below
    return machine


def _motion_problems(machine: Machine) -> Iterator[FieldProblem]:
    if not isinstance(machine, ReciprocatingMachine):
        yield FieldProblem(("kind",), "only a reciprocating machine has this")
    yield from rod_problems(machine)


def _gas_problems(machine: Machine) -> Iterator[FieldProblem]:
    if isinstance(machine, ReciprocatingMachine):
        missing = list(gas_problems(machine))
        yield from missing
        if not missing and not list(rod_problems(machine)):
            yield from delivery_problems(machine, layout_of(machine))


def _flywheel_problems(machine: Machine) -> Iterator[FieldProblem]:
    if isinstance(machine, ReciprocatingMachine) and machine.flywheel is None:
        yield FieldProblem(("flywheel",), "the flywheel needs the irregularity or the inertia")


def _bearing_problems(machine: Machine) -> Iterator[FieldProblem]:
    if isinstance(machine, ReciprocatingMachine) and not machine.bearings:
        yield FieldProblem(("bearings",), "bearing loads need the bearings")


def _has_friction(machine: Machine) -> bool:
    return isinstance(machine, ReciprocatingMachine) and machine.friction is not None


def _kinematics(context: Context) -> Motion:
    return motion(context.layout, context.angle, context.fidelity.kinematics == "exact")


def _gas(context: Context) -> GasCycle:
    data = chambers(_reciprocating(context.machine))
    forces = gas_forces(data, context.given["kinematics"], context.layout)
    work = indicated_work(data, context.layout)
    power = np.sum(work, axis=-1) * context.layout.omega / (2.0 * np.pi)
    return GasCycle(data, forces, *switching_angles(data, context.layout), work, power)


def _friction(context: Context) -> FrictionForces:
    data = _reciprocating(context.machine).friction
    assert data is not None  # the effect does not apply without it
    moving, cycle = context.given["kinematics"], context.given["gas"]
    omega, stroke = context.layout.omega, 2.0 * context.layout.reciprocating.crank_radius
    if data.mechanical_efficiency is None:
        magnitude = np.array(data.reciprocating_force_N or np.zeros(stroke.size), dtype=float)
        torque = np.asarray(data.rotating_torque_Nm or 0.0)
    else:
        indicated = data.indicated_power_W or cycle.power
        magnitude, torque = share_of_losses(
            np.asarray(indicated, dtype=float),
            np.asarray(data.mechanical_efficiency),
            np.asarray(data.reciprocating_share),
            stroke,
            omega,
        )
    return FrictionForces(magnitude, reciprocating_friction(moving, magnitude), float(torque))


def _piston_force(context: Context) -> PistonForces:
    gas = context.given["gas"].forces.total
    inertia = context.layout.reciprocating.mass[:, None] * context.given["kinematics"].acceleration
    friction = context.given["friction"].force if "friction" in context.given else np.zeros_like(gas)
    return PistonForces(gas, inertia, friction, gas + inertia + friction)


def _rod_forces(context: Context) -> RodForces:
    return rod_forces(context.given["piston_force"].total, context.given["kinematics"], context.layout)


def _torque(context: Context) -> TorqueSeries:
    rows = context.given["rod_forces"].torque
    friction = context.given["friction"].torque if "friction" in context.given else 0.0
    return TorqueSeries(rows, np.sum(rows, axis=0) + friction, friction)


def _torque_at(context: Context, angle: Real) -> TorqueSeries:
    """Torque at other angles, piece by piece."""
    rows = max(context.layout.reciprocating.mass.size, 1)
    pieces = np.array_split(angle, max(1, rows * angle.size // _AT_ONCE))
    found = [context.elsewhere(piece)["torque"] for piece in pieces]
    return TorqueSeries(
        np.concatenate([one.rows for one in found], axis=-1),
        np.concatenate([one.total for one in found]),
        found[0].rotating_friction,
    )


def _torque_integrals(context: Context) -> TorqueIntegrals:
    layout, cycle = context.layout, context.given["gas"]
    ahead = own_angle(layout, np.zeros(1))[:, 0]
    # valves open and rows reverse at these own angles; between them all is smooth
    dead = np.broadcast_to([0.0, np.pi], (ahead.size, 2))
    steep = steep_angles(layout.reciprocating.rod_ratio)
    own = np.concatenate([cycle.suction_opens, cycle.discharge_opens, dead, steep], axis=1)
    breaks = np.unique((own - ahead[:, None])[~np.isnan(own)])
    coarse, fine = panels(breaks, _WIDEST_PANEL), panels(breaks, _WIDEST_PANEL, halved=True)
    at_coarse, at_fine = (_torque_at(context, turn.angle) for turn in (coarse, fine))
    omega = float(layout.omega)
    friction_power = 0.0
    if "friction" in context.given:
        friction = context.given["friction"]
        per_turn = np.sum(friction.magnitude * 4.0 * layout.reciprocating.crank_radius)
        friction_power = float(per_turn * omega / (2.0 * np.pi) + friction.torque * omega)
    middle, energy = mean(fine, at_fine.total), fluctuation(fine, at_fine.total)
    return TorqueIntegrals(
        row_mean=np.array([mean(fine, row) for row in at_fine.rows]),
        mean=float(middle),
        mean_error=float(abs(middle - mean(coarse, at_coarse.total))),
        fluctuation=float(energy),
        fluctuation_error=float(abs(energy - fluctuation(coarse, at_coarse.total))),
        indicated_power=float(np.sum(cycle.power)),
        friction_power=friction_power,
    )


def _flywheel(context: Context) -> FlywheelFigures:
    data = _reciprocating(context.machine).flywheel
    assert data is not None
    # delta = dE / (J omega^2), seed 004 (2-28)
    ratio = context.given["torque_integrals"].fluctuation / float(context.layout.omega) ** 2
    if data.irregularity is not None:
        return FlywheelFigures(data.irregularity, ratio / data.irregularity)
    assert data.inertia_kg_m2 is not None
    return FlywheelFigures(ratio / data.inertia_kg_m2, data.inertia_kg_m2)


def _shaft_loads(context: Context) -> tuple[Real, Complex]:
    return shaft_loads(context.given["piston_force"].total, context.given["kinematics"], context.layout, context.angle)


DYNAMICS = (
    Effect("kinematics", "motion of the rows", _kinematics, inputs=RODS, problems=_motion_problems),
    Effect(
        "gas",
        "four-process cycle in every chamber",
        _gas,
        needs=("kinematics",),
        inputs=("machine.throws.rows.cylinder",),
        problems=_gas_problems,
    ),
    Effect(
        "friction",
        "friction of the rows and of the shaft, where the machine gives it",
        _friction,
        needs=("kinematics", "gas"),
        inputs=("machine.friction",),
        applies=_has_friction,
    ),
    Effect(
        "piston_force",
        "gas, inertia and friction on every piston",
        _piston_force,
        needs=("kinematics", "gas", "friction"),
    ),
    Effect(
        "rod_forces",
        "forces on rod, guide and crank pin",
        _rod_forces,
        needs=("kinematics", "piston_force"),
    ),
    Effect("torque", "torque of rows and shaft against rotation", _torque, needs=("rod_forces", "friction")),
    Effect(
        "torque_integrals",
        "mean torque, powers and fluctuation energy",
        _torque_integrals,
        needs=("gas", "friction", "torque"),
    ),
    Effect(
        "flywheel",
        "irregularity of the speed and inertia",
        _flywheel,
        needs=("torque_integrals",),
        inputs=("machine.flywheel",),
        problems=_flywheel_problems,
    ),
    Effect(
        "shaft_loads",
        "forces of rows and rotating masses on the shaft, plane by plane",
        _shaft_loads,
        needs=("kinematics", "piston_force"),
        inputs=("machine.bearings",),
        problems=_bearing_problems,
    ),
)
