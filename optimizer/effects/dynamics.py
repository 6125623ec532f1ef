"""Effects over the turn: motion, gas, friction, forces in the mechanism, torque, flywheel, main bearings.

Every array has the leading axes (...) of the layout: none for one machine, one for many designs of one shape.
"""

from collections.abc import Iterator, Sequence

import numpy as np

from optimizer.effects.effect import Context, Effect
from optimizer.effects.inertia import RODS, rod_problems
from optimizer.effects.machine_kinds import reciprocating
from optimizer.effects.results import (
    FlywheelFigures,
    FrictionForces,
    GasCycle,
    PistonForces,
    TorqueErrors,
    TorqueIntegrals,
    TorqueSeries,
)
from optimizer.mechanics.cylinders import chambers, delivery_rules, gas_problems, trace_rules, traces, without_gas
from optimizer.mechanics.friction import reciprocating_friction, share_of_losses
from optimizer.mechanics.gas import gas_forces
from optimizer.mechanics.indicated import TURN, turns_of
from optimizer.mechanics.kinematics import Motion, motion
from optimizer.mechanics.layout import layout as layout_of
from optimizer.mechanics.layout import stacked
from optimizer.mechanics.rod import RodForces, rod_forces, shaft_loads
from optimizer.mechanics.row_data import row_data
from optimizer.mechanics.row_work import RowWork
from optimizer.mechanics.turn import Turn, fluctuation, mean, panels
from optimizer.mechanics.whole_turn import WholeTurn, break_angles, whole_turn
from optimizer.numerics.arrays import Complex, Real, spread
from optimizer.responses.piecewise_cubics import ROUNDING
from schemas.base.model import FieldProblem
from schemas.base.rules import Rule
from schemas.machine.machine import Machine
from schemas.machine.reciprocating import ReciprocatingMachine

_WIDEST_PANEL = np.deg2rad(10.0)


def _motion_problems(machine: Machine) -> Iterator[FieldProblem]:
    if not isinstance(machine, ReciprocatingMachine):
        yield FieldProblem(("kind",), "only a reciprocating machine has this")
    yield from rod_problems(machine)


def _gas_problems(machine: Machine) -> Iterator[FieldProblem]:
    if isinstance(machine, ReciprocatingMachine):
        yield from gas_problems(machine)


def _cylinder_problems(machine: Machine) -> Iterator[FieldProblem]:
    if isinstance(machine, ReciprocatingMachine):
        for path in without_gas(machine):
            yield FieldProblem(path, "gas forces need the cylinder")


def _has_gas(machine: Machine) -> bool:
    """Whether any of the rows has a cylinder; the others carry no gas."""
    if not isinstance(machine, ReciprocatingMachine):
        return False
    rows = sum(len(throw.rows) for throw in machine.throws)
    return rows == 0 or len(without_gas(machine)) < rows


def _friction_problems(machine: Machine) -> Iterator[FieldProblem]:
    data = reciprocating(machine).friction
    by_efficiency = data is not None and data.mechanical_efficiency is not None
    if by_efficiency and data is not None and data.indicated_power_W is None and not _has_gas(machine):
        message = "friction by the efficiency needs the indicated power, or the cylinders"
        yield FieldProblem(("friction", "indicated_power_W"), message)


def _gas_rules(machine: Machine) -> Iterator[Rule]:
    layout = layout_of(machine)
    yield from delivery_rules(reciprocating(machine), layout)
    yield from trace_rules(reciprocating(machine), layout)


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
    layout = context.layout
    data = chambers(reciprocating(context.machine), layout.omega.shape)
    records = traces(reciprocating(context.machine), layout)
    forces = gas_forces(data, context.results["kinematics"], layout, records)
    return GasCycle(data, layout, forces, context.fidelity.kinematics == "exact", records)


def _friction(context: Context) -> FrictionForces:
    data = reciprocating(context.machine).friction
    assert data is not None  # the effect does not apply without it
    moving = context.results["kinematics"]
    omega, stroke = context.layout.omega, 2.0 * context.layout.reciprocating.crank_radius

    def of_rows(values: Sequence[float] | None, default: Real) -> Real:
        return spread(default if values is None else stacked(values), stroke.shape)

    def of_shaft(value: float | None) -> Real:
        return spread(np.asarray(0.0 if value is None else value, dtype=float), omega.shape)

    if data.mechanical_efficiency is None:
        magnitude, torque = of_rows(data.reciprocating_force_N, np.zeros(())), of_shaft(data.rotating_torque_Nm)
    else:
        magnitude, torque = share_of_losses(
            of_rows(data.indicated_power_W, _indicated_power(context)),
            of_shaft(data.mechanical_efficiency),
            of_shaft(data.reciprocating_share),
            stroke,
            omega,
        )
    return FrictionForces(magnitude, reciprocating_friction(moving, magnitude), torque)


def _indicated_power(context: Context) -> Real:
    """Power put into the gas of the rows, (..., rows) W."""
    return (
        context.results["gas"].power if "gas" in context.results else np.zeros(context.layout.reciprocating.mass.shape)
    )


def _piston_force(context: Context) -> PistonForces:
    inertia = context.layout.reciprocating.mass[..., None] * context.results["kinematics"].acceleration
    gas = context.results["gas"].forces.total if "gas" in context.results else np.zeros_like(inertia)
    friction = context.results["friction"].force if "friction" in context.results else np.zeros_like(inertia)
    return PistonForces(gas, inertia, friction, gas + inertia + friction)


def _rod_forces(context: Context) -> RodForces:
    return rod_forces(context.results["piston_force"].total, context.results["kinematics"], context.layout)


def _torque(context: Context) -> TorqueSeries:
    rows = context.results["rod_forces"].torque
    friction = context.results["friction"].torque if "friction" in context.results else np.zeros(rows.shape[:-2])
    return TorqueSeries(rows, np.add.reduce(rows, axis=-2) + friction[..., None], friction)


def _torque_at(context: Context, turn: Turn) -> tuple[Real, Real]:
    """Torque of the rows (..., rows, T) and with the friction of the shaft (..., T) at the nodes of panels."""
    whole: WholeTurn = context.results["whole_turn"]
    leading, radius = context.layout.omega.shape, context.layout.reciprocating.crank_radius[..., None]
    force = whole.tangential(turn)
    rows = radius * force.reshape(*leading, *force.shape[1:])
    friction = context.results["friction"].torque[..., None] if "friction" in context.results else 0.0
    return rows, np.add.reduce(rows, axis=-2) + friction


def _breaks(context: Context) -> Real:
    """Shaft angles between which all is smooth, (..., B) rad."""
    if "gas" not in context.results:
        return break_angles(context.layout)
    gas = context.results["gas"]
    return break_angles(context.layout, gas.opens, gas.traces)


def _turns(context: Context) -> int:
    """Turns of the shaft after which all repeats."""
    return turns_of(context.results["gas"].traces) if "gas" in context.results else 1


def _row_work(context: Context) -> RowWork | None:
    """Work of the rows in closed form, where there is one."""
    gas: GasCycle | None = context.results.get("gas")
    if context.fidelity.kinematics != "exact" or (gas is not None and gas.traces):
        return None
    friction = context.results["friction"].magnitude if "friction" in context.results else None
    if gas is None:
        return RowWork(context.layout, friction)
    return RowWork(context.layout, friction, gas.chambers, gas.work)


def _torque_integrals(context: Context) -> TorqueIntegrals:
    omega = context.layout.omega
    friction_power, rotating = np.zeros(omega.shape), np.zeros(omega.shape)
    if "friction" in context.results:
        friction = context.results["friction"]
        per_turn = np.add.reduce(friction.magnitude * 4.0 * context.layout.reciprocating.crank_radius, axis=-1)
        friction_power, rotating = per_turn * omega / TURN + friction.torque * omega, friction.torque
    closed = _row_work(context)
    if closed is None:
        fine = panels(_breaks(context), _WIDEST_PANEL, halved=True, turns=_turns(context))
        rows, total = _torque_at(context, fine)
        row_mean = np.zeros_like(context.layout.reciprocating.mass)
        for k in range(rows.shape[-2]):
            row_mean[..., k] = mean(fine, rows[..., k, :])
        whole, energy, error = mean(fine, total), fluctuation(fine, total), None
    else:
        row_mean = closed.of_a_turn / TURN
        whole = np.add.reduce(row_mean, axis=-1) + rotating
        energy, error = closed.fluctuation(context.results["whole_turn"].torque)
    return TorqueIntegrals(
        row_mean=row_mean,
        mean=whole,
        fluctuation=energy,
        fluctuation_error=error,
        indicated_power=np.add.reduce(_indicated_power(context), axis=-1),
        friction_power=friction_power,
    )


def _torque_errors(context: Context) -> TorqueErrors:
    fine: TorqueIntegrals = context.results["torque_integrals"]
    if fine.fluctuation_error is not None:
        size = context.results["whole_turn"].torque.pieces.size
        return TorqueErrors(
            mean=ROUNDING * size.reshape(context.layout.omega.shape), fluctuation=fine.fluctuation_error
        )
    coarse = panels(_breaks(context), _WIDEST_PANEL, turns=_turns(context))
    _, total = _torque_at(context, coarse)
    return TorqueErrors(
        mean=np.abs(fine.mean - mean(coarse, total)), fluctuation=np.abs(fine.fluctuation - fluctuation(coarse, total))
    )


def _flywheel(context: Context) -> FlywheelFigures:
    data = reciprocating(context.machine).flywheel
    assert data is not None  # checked by the problems
    # delta = dE / (J omega^2), the design calculation of the 2D12 (2-28)
    ratio = context.results["torque_integrals"].fluctuation / context.layout.omega**2
    is_stated = data.irregularity is not None
    stated = np.broadcast_to(
        np.asarray(data.irregularity if is_stated else data.inertia_kg_m2, dtype=float), ratio.shape
    )
    return FlywheelFigures(stated, ratio / stated) if is_stated else FlywheelFigures(ratio / stated, stated)


def _shaft_loads(context: Context) -> tuple[Real, Complex]:
    return shaft_loads(
        context.results["piston_force"].total, context.results["kinematics"], context.layout, context.angle
    )


def _whole_turn(context: Context) -> WholeTurn:
    results = context.results
    rows = row_data(
        context.layout,
        context.fidelity.kinematics == "exact",
        results["friction"].magnitude if "friction" in results else None,
        results["gas"].chambers if "gas" in results else None,
        results["gas"].traces if "gas" in results else (),
    )
    closed = _row_work(context)
    means = None if closed is None else closed.of_a_turn / (TURN * context.layout.reciprocating.crank_radius)
    # of the loads of bearings mean squares are shown, by quadratures
    squared, single = "shaft_loads" in context.demands, not context.layout.omega.shape
    return whole_turn(rows, _breaks(context), means, squared, context.readings, single)


def _frame_forces(context: Context) -> WholeTurn:
    rows = row_data(context.layout, context.fidelity.kinematics == "exact", None, None, ())
    return whole_turn(rows, break_angles(context.layout), single=not context.layout.omega.shape)


DYNAMICS = (
    Effect("kinematics", "motion of the rows", _kinematics, inputs=RODS, problems=_motion_problems),
    Effect(
        "gas",
        "four-process cycle or indicated pressure in every chamber, where rows have cylinders",
        _gas,
        needs=("kinematics",),
        inputs=("machine.throws.rows.cylinder",),
        problems=_gas_problems,
        rules=_gas_rules,
        applies=_has_gas,
    ),
    Effect(
        "indicated_work",
        "work put into the gas of every chamber",
        lambda context: context.results["gas"].work,
        needs=("gas",),
        inputs=("machine.throws.rows.cylinder",),
        problems=_cylinder_problems,
    ),
    Effect(
        "friction",
        "friction of the rows and of the shaft, where the machine gives it",
        _friction,
        needs=("kinematics", "gas"),
        inputs=("machine.friction",),
        problems=_friction_problems,
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
    Effect(
        "whole_turn",
        "forces of the rows between the angles at which something jumps, for exact peaks",
        _whole_turn,
        needs=("gas", "friction"),
    ),
    Effect(
        "frame_forces",
        "inertia of the rows over the revolution, for exact peaks on the frame, where gas and friction are none",
        _frame_forces,
        needs=("kinematics",),
    ),
    Effect("torque", "torque of rows and shaft against rotation", _torque, needs=("rod_forces", "friction")),
    Effect(
        "torque_integrals",
        "mean torque, powers and fluctuation energy",
        _torque_integrals,
        needs=("gas", "friction", "whole_turn"),
    ),
    Effect(
        "torque_errors",
        "by how much integrals over wider panels differ",
        _torque_errors,
        needs=("gas", "friction", "whole_turn", "torque_integrals"),
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
