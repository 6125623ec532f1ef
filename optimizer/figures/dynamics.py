"""Dynamics as answers: series of every row, and what they come to together."""

from collections.abc import Iterator, Mapping
from typing import Any, Literal, NamedTuple

import numpy as np

from optimizer.arrays import Real
from optimizer.mechanics.layout import Layout
from schemas.dynamics import (
    Chamber,
    Flywheel,
    Gas,
    Kinematics,
    LoadCase,
    Overturning,
    PistonForce,
    RodLoads,
    RowGas,
    RowMotion,
    RowOverturning,
    RowPistonForce,
    RowRodLoads,
    RowTorque,
    Torque,
)
from schemas.machine import Machine, ReciprocatingMachine

Case = Literal["running", "no_load", "sudden_stop"]
_SIDES: tuple[Literal["head", "crank"], ...] = ("head", "crank")


class Samples(NamedTuple):
    """What every report reads: the machine, its arrays, the sampled angles and the results by effect."""

    machine: Machine
    layout: Layout
    angle_deg: Real  # (T,)
    results: Mapping[str, Any]

    @property
    def angles(self) -> tuple[float, ...]:
        return tuple(self.angle_deg.tolist())

    def rows(self) -> Iterator[tuple[int, dict[str, Any]]]:
        """Number of every row, and its labels."""
        assert isinstance(self.machine, ReciprocatingMachine)  # no other has effects over the turn
        places = [(t, i, row.name) for t, throw in enumerate(self.machine.throws) for i, row in enumerate(throw.rows)]
        for number, (t, i, name) in enumerate(places):
            yield number, {"throw": t, "row": i, "name": name}


def kinematics(samples: Samples) -> Kinematics:
    """Motion of every row."""
    found = samples.results["kinematics"]
    own = np.mod(np.rad2deg(found.crank_angle), 360.0)
    return Kinematics(
        angle_deg=samples.angles,
        rows=tuple(
            RowMotion(
                **labels,
                crank_angle_deg=_series(own[k]),
                displacement_m=_series(found.displacement[k]),
                velocity_m_s=_series(found.velocity[k]),
                acceleration_m_s2=_series(found.acceleration[k]),
            )
            for k, labels in samples.rows()
        ),
    )


def gas(samples: Samples) -> Gas:
    """Gas of every row."""
    cycle = samples.results["gas"]
    total = cycle.forces.total

    def chamber(k: int, side: int) -> Chamber:
        opens = (np.rad2deg(angles[k, side]) for angles in (cycle.suction_opens, cycle.discharge_opens))
        suction, discharge = (None if np.isnan(angle) else float(angle) for angle in opens)
        return Chamber(
            side=_SIDES[side],
            pressure_Pa=_series(cycle.forces.pressure[k, side]),
            force_N=_series(cycle.forces.force[k, side]),
            suction_opens_deg=suction,
            discharge_opens_deg=discharge,
            indicated_work_J=float(cycle.work[k, side]),
        )

    return Gas(
        angle_deg=samples.angles,
        rows=tuple(
            RowGas(
                **labels,
                chambers=(chamber(k, 0), chamber(k, 1)),
                force_N=_series(total[k]),
                indicated_power_W=float(cycle.power[k]),
            )
            for k, labels in samples.rows()
        ),
        indicated_power_W=float(np.sum(cycle.power)),
    )


def piston_force(samples: Samples) -> PistonForce:
    """Gas, inertia and friction on every piston."""
    found = samples.results["piston_force"]
    return PistonForce(
        angle_deg=samples.angles,
        rows=tuple(
            RowPistonForce(
                **labels,
                gas_N=_series(found.gas[k]),
                inertia_N=_series(found.inertia[k]),
                friction_N=_series(found.friction[k]),
                total_N=_series(found.total[k]),
                peak_tension_N=float(np.max(found.total[k])),
                peak_compression_N=float(np.min(found.total[k])),
            )
            for k, labels in samples.rows()
        ),
    )


def rod_loads(samples: Samples) -> RodLoads:
    """Forces in the mechanism, and the load cases of every rod (seed 004 section 2.5)."""
    found, pistons = samples.results["rod_forces"], samples.results["piston_force"]
    cosine = samples.results["kinematics"].rod_angle_cosine
    forces: dict[Case, Real] = {
        "running": found.rod,
        "no_load": (pistons.inertia + pistons.friction) / cosine,
        "sudden_stop": pistons.gas / cosine,
    }
    rows = []
    for k, labels in samples.rows():
        cases = tuple(_case(case, force[k], samples.angle_deg) for case, force in forces.items())
        worst = max(cases, key=_largest)
        rows.append(
            RowRodLoads(
                **labels,
                rod_N=_series(found.rod[k]),
                side_N=_series(found.side[k]),
                tangential_N=_series(found.tangential[k]),
                radial_N=_series(found.radial[k]),
                cases=cases,
                governing_case=worst.case,
                governing_load_N=_largest(worst),
            )
        )
    return RodLoads(
        angle_deg=samples.angles,
        rows=tuple(rows),
        governing_load_N=max((row.governing_load_N for row in rows), default=0.0),
    )


def torque(samples: Samples) -> Torque:
    """Torque over the turn and its integrals."""
    found, integrals = samples.results["torque"], samples.results["torque_integrals"]
    radius = samples.layout.reciprocating.crank_radius
    one_radius = radius.size > 0 and bool(np.all(radius == radius[0]))
    return Torque(
        angle_deg=samples.angles,
        rows=tuple(
            RowTorque(**labels, torque_Nm=_series(found.rows[k]), mean_torque_Nm=float(integrals.row_mean[k]))
            for k, labels in samples.rows()
        ),
        rotating_friction_Nm=found.rotating_friction,
        torque_Nm=_series(found.total),
        tangential_N=_series(found.total / radius[0]) if one_radius else None,
        mean_torque_Nm=integrals.mean,
        mean_torque_error_Nm=integrals.mean_error,
        indicated_power_W=integrals.indicated_power,
        friction_power_W=integrals.friction_power,
        shaft_power_W=integrals.mean * float(samples.layout.omega),
        fluctuation_energy_J=integrals.fluctuation,
        fluctuation_energy_error_J=integrals.fluctuation_error,
    )


def flywheel(samples: Samples) -> Flywheel:
    """Irregularity and inertia, J and MD^2 both (E004-18)."""
    found = samples.results["flywheel"]
    return Flywheel(
        fluctuation_energy_J=samples.results["torque_integrals"].fluctuation,
        irregularity=found.irregularity,
        inertia_J_kg_m2=found.inertia,
        inertia_MD2_kg_m2=4.0 * found.inertia,
    )


def overturning(samples: Samples) -> Overturning:
    """Overturning couple on the frame."""
    rows = samples.results["rod_forces"].overturning
    total = np.sum(rows, axis=0)
    return Overturning(
        angle_deg=samples.angles,
        rows=tuple(RowOverturning(**labels, couple_Nm=_series(rows[k])) for k, labels in samples.rows()),
        couple_Nm=_series(total),
        peak_Nm=float(np.max(np.abs(total))),
    )


def _series(values: Real) -> tuple[float, ...]:
    return tuple(values.tolist())


def _case(case: Case, force: Real, angle_deg: Real) -> LoadCase:
    high, low = int(np.argmax(force)), int(np.argmin(force))
    return LoadCase(
        case=case,
        tension_N=max(float(force[high]), 0.0),
        tension_deg=float(angle_deg[high]),
        compression_N=min(float(force[low]), 0.0),
        compression_deg=float(angle_deg[low]),
    )


def _largest(case: LoadCase) -> float:
    return max(case.tension_N, -case.compression_N)
