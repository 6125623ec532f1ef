"""Dynamics as answers: series of every row, and what they come to together."""

from collections.abc import Iterator
from math import isnan
from typing import Any, Literal

import numpy as np

from optimizer.formulation.simulation import Prepared
from optimizer.mechanics.reading import Reading
from optimizer.numerics.arrays import Complex, Real, read_only
from optimizer.outputs.output import Columns, Output
from optimizer.outputs.peaks import (
    largest_of_rows,
    of_torque,
    row_magnitudes,
    row_peaks,
    rows_search,
    torque_peak,
    torque_search,
)
from optimizer.responses.peak_table import PeakList
from schemas.answer.dynamics import (
    Flywheel,
    Gas,
    Kinematics,
    Overturning,
    PistonForce,
    RodLoads,
    Torque,
)
from schemas.base.curves import Curve
from schemas.machine.throws import row_cylinders
from schemas.sweep.details import Case

_SIDES: tuple[Literal["head", "crank"], ...] = ("head", "crank")


def kinematics(scene: Prepared, _fitted: Complex | None = None) -> Kinematics:
    """Motion of every row."""
    result = scene.results["kinematics"]
    own = np.mod(np.rad2deg(result.crank_angle), 360.0)
    # one validation of the whole takes two thirds of the time of one of each part, here and below
    return Kinematics.of_figures(
        {
            "angle_deg": scene.angles,
            "rows": tuple(
                {
                    **labels,
                    "crank_angle_deg": angle,
                    "displacement_m": displacement,
                    "velocity_m_s": velocity,
                    "acceleration_m_s2": acceleration,
                }
                for labels, angle, displacement, velocity, acceleration in _by_row(
                    scene, own, result.displacement, result.velocity, result.acceleration
                )
            ),
        }
    )


def _indicated_power(scene: Prepared) -> Real:
    power: Real = np.add.reduce(scene.results["gas"].power, axis=-1)
    return power


def gas(scene: Prepared, _fitted: Complex | None = None) -> Gas:
    """Gas of every row."""
    cycle, motion = scene.results["gas"], scene.results["kinematics"]
    total, force = cycle.forces.total, cycle.forces.force

    # a row without a cylinder has two sides without area
    names = [
        [getattr(cylinder, "name", None) for _, cylinder in row_cylinders(row)] or [None]
        for throw in scene.machine.throws
        for row in throw.rows
    ]

    opens, work = np.rad2deg(np.array(cycle.opens)).tolist(), scene.results["indicated_work"].tolist()
    pressure, forces = (Curve.rows(read_only(curves)) for curves in (cycle.forces.pressure, force))
    sides, power = force.shape[-2], cycle.power.tolist()

    def chamber(k: int, side: int) -> dict[str, Any]:
        suction, discharge = (None if isnan(angles[k][side]) else angles[k][side] for angles in opens)
        return {
            "side": _SIDES[side % 2],
            "cylinder": side // 2,
            "name": names[k][side // 2],
            "pressure_Pa": pressure[k * sides + side],
            "force_N": forces[k * sides + side],
            "suction_opens_deg": suction,
            "discharge_opens_deg": discharge,
            "indicated_work_J": work[k][side],
        }

    return Gas.of_figures(
        {
            "angle_deg": scene.angles,
            "rows": tuple(
                {
                    **labels,
                    "chambers": tuple(chamber(k, side) for side in range(2 * len(names[k]))),
                    "displacement_m": displacement,
                    "force_N": of_row,
                    "indicated_power_W": power[k],
                }
                for k, (labels, displacement, of_row) in enumerate(_by_row(scene, motion.displacement, total))
            ),
            "indicated_power_W": float(_indicated_power(scene)),
        }
    )


def piston_force(scene: Prepared, _fitted: Complex | None = None) -> PistonForce:
    """Gas, inertia and friction on every piston."""
    result, (high, low) = scene.results["piston_force"], row_peaks(scene, "piston")
    return PistonForce.of_figures(
        {
            "angle_deg": scene.angles,
            "rows": tuple(
                {
                    **labels,
                    "gas_N": of_gas,
                    "inertia_N": inertia,
                    "friction_N": friction,
                    "total_N": total,
                    "peak_tension_N": high.lower[k],
                    "peak_tension_bracket_N": high.bracket(k),
                    "peak_compression_N": -low.lower[k],
                    "peak_compression_bracket_N": _negated(low.bracket(k)),
                }
                for k, (labels, of_gas, inertia, friction, total) in enumerate(
                    _by_row(scene, result.gas, result.inertia, result.friction, result.total)
                )
            ),
        }
    )


#: rod force of every load case (design calculation of the 2D12, section 2.5)
CASES: dict[Case, Reading] = {"running": "rod", "no_load": "rod_without_gas", "sudden_stop": "rod_at_rest"}


def rod_loads(scene: Prepared, _fitted: Complex | None = None) -> RodLoads:
    """Forces in the mechanism, and the load cases of every rod."""
    result = scene.results["rod_forces"]
    forces = _by_row(scene, result.rod, result.side, result.tangential, result.radial)
    by_case = [_cases(case, *row_peaks(scene, reading)) for case, reading in CASES.items()]
    sides = row_magnitudes(scene, "side")
    rows = []
    for k, (labels, rod, side, tangential, radial) in enumerate(forces):
        cases = tuple(column[k] for column in by_case)
        worst = max(cases, key=_largest)
        rows.append(
            {
                **labels,
                "rod_N": rod,
                "side_N": side,
                "tangential_N": tangential,
                "radial_N": radial,
                "peak_side_N": sides[k][0],
                "peak_side_bracket_N": sides[k],
                "cases": cases,
                "governing_case": worst["case"],
                "governing_load_N": _largest(worst),
            }
        )
    return RodLoads.of_figures(
        {
            "angle_deg": scene.angles,
            "rows": tuple(rows),
            "governing_load_N": max((row["governing_load_N"] for row in rows), default=0.0),
        }
    )


def _shaft_power(scene: Prepared) -> Real:
    power: Real = scene.results["torque_integrals"].mean * scene.layout.omega
    return power


def torque(scene: Prepared, _fitted: Complex | None = None) -> Torque:
    """Torque over the turn and its integrals."""
    result, integrals = scene.results["torque"], scene.results["torque_integrals"]
    errors, shaft_power = scene.results["torque_errors"], _shaft_power(scene)
    peak = torque_peak(scene, result.rotating_friction)
    radii = scene.layout.reciprocating.crank_radius.tolist()
    common_radius = len(set(radii)) == 1
    return Torque.of_figures(
        {
            "angle_deg": scene.angles,
            "rows": tuple(
                {**labels, "torque_Nm": samples, "mean_torque_Nm": mean}
                for (labels, samples), mean in zip(
                    _by_row(scene, result.rows), integrals.row_mean.tolist(), strict=True
                )
            ),
            "rotating_friction_Nm": float(result.rotating_friction),
            "torque_Nm": result.total,
            "tangential_N": result.total / radii[0] if common_radius else None,
            "peak_Nm": peak.lower[0],
            "peak_bracket_Nm": peak.bracket(),
            "peak_angle_deg": peak.angle_deg[0],
            "mean_torque_Nm": float(integrals.mean),
            "mean_torque_error_Nm": float(errors.mean),
            "indicated_power_W": float(integrals.indicated_power),
            "friction_power_W": float(integrals.friction_power),
            "shaft_power_W": float(shaft_power),
            "fluctuation_energy_J": float(integrals.fluctuation),
            "fluctuation_energy_error_J": float(errors.fluctuation),
        }
    )


def flywheel(scene: Prepared, _fitted: Complex | None = None) -> Flywheel:
    """Irregularity and inertia, J and MD^2 both; the source prints the latter as the former."""
    result = scene.results["flywheel"]
    return Flywheel.of_figures(
        {
            "fluctuation_energy_J": float(scene.results["torque_integrals"].fluctuation),
            "irregularity": float(result.irregularity),
            "inertia_J_kg_m2": float(result.inertia),
            "inertia_MD2_kg_m2": 4.0 * float(result.inertia),
        }
    )


def overturning(scene: Prepared, _fitted: Complex | None = None) -> Overturning:
    """Overturning couple on the frame."""
    rows = scene.results["rod_forces"].overturning
    total, peak = np.add.reduce(rows, axis=-2), torque_peak(scene)
    return Overturning.of_figures(
        {
            "angle_deg": scene.angles,
            "rows": tuple({**labels, "couple_Nm": couple} for labels, couple in _by_row(scene, rows)),
            "couple_Nm": total,
            "peak_Nm": peak.lower[0],
            "peak_bracket_Nm": peak.bracket(),
            "peak_angle_deg": peak.angle_deg[0],
        }
    )


def _by_row(scene: Prepared, *series: Real) -> Iterator[tuple[Any, ...]]:
    """Labels of every row and its curves, of series (rows, T)."""
    # all at once: small arrays cost by their number
    curves = Curve.rows(read_only(np.concatenate(series) if len(series) > 1 else series[0]))
    count, rows = len(scene.row_labels), range(len(series))
    return zip(scene.row_labels, *(curves[count * n : count * (n + 1)] for n in rows), strict=True)


def _cases(case: Case, tension: PeakList, compression: PeakList) -> list[dict[str, Any]]:
    """A load case of every row, as fields."""
    return [
        {
            "case": case,
            "tension_N": max(high, 0.0),
            "tension_bracket_N": _pull((high, most)),
            "tension_deg": at,
            "compression_N": 0.0 - max(low, 0.0),
            "compression_bracket_N": _negated(_pull((low, deepest))),
            "compression_deg": there,
        }
        for high, most, at, low, deepest, there in zip(*tension, *compression, strict=True)
    ]


def _pull(extremes: tuple[float, float]) -> tuple[float, float]:
    """0 where there is none."""
    return max(extremes[0], 0.0), max(extremes[1], 0.0)


def _negated(extremes: tuple[float, float]) -> tuple[float, float]:
    # no -0.0
    return 0.0 - extremes[1], 0.0 - extremes[0]


def _largest(case: dict[str, Any]) -> float:
    return max(case["tension_N"], -case["compression_N"])


def _gas_columns(scene: Prepared, _fitted: Complex) -> dict[str, Real]:
    return {"indicated_power_W": _indicated_power(scene)}


def _piston_columns(scene: Prepared, _fitted: Complex) -> dict[str, Real]:
    return {"peak_piston_force_N": largest_of_rows(scene, "piston").lower}


def _rod_columns(scene: Prepared, _fitted: Complex) -> dict[str, Real]:
    return {"peak_rod_load_N": np.max([largest_of_rows(scene, reading).lower for reading in CASES.values()], axis=0)}


def _torque_columns(scene: Prepared, _fitted: Complex) -> dict[str, Real]:
    integrals, friction = scene.results["torque_integrals"], scene.results.get("friction")
    return {
        "mean_torque_Nm": integrals.mean,
        "peak_torque_Nm": of_torque(scene, 0.0 if friction is None else friction.torque),
        "fluctuation_energy_J": integrals.fluctuation,
        "shaft_power_W": _shaft_power(scene),
        "indicated_power_W": integrals.indicated_power,
        "friction_power_W": integrals.friction_power,
    }


def _flywheel_columns(scene: Prepared, _fitted: Complex) -> dict[str, Real]:
    result = scene.results["flywheel"]
    return {"irregularity": result.irregularity, "inertia_J_kg_m2": result.inertia}


def _overturning_columns(scene: Prepared, _fitted: Complex) -> dict[str, Real]:
    return {"peak_overturning_Nm": of_torque(scene)}


OVER_THE_TURN = (
    Output("kinematics", "motion of every row", ("kinematics",), kinematics),
    Output(
        "gas",
        "pressures and gas forces of every row, indicated power",
        ("kinematics", "gas", "indicated_work"),
        gas,
        Columns(_gas_columns),
    ),
    Output(
        "piston_force",
        "gas, inertia and friction on every piston",
        ("piston_force", "whole_turn"),
        piston_force,
        Columns(_piston_columns, needs=("whole_turn",), readings=("piston",)),
        lambda scene, _: (rows_search(scene, "piston"),),
    ),
    Output(
        "rod_loads",
        "forces on rod, guide and crank pin; load cases",
        ("rod_forces", "whole_turn"),
        rod_loads,
        Columns(_rod_columns, needs=("whole_turn",), readings=tuple(CASES.values())),
        lambda scene, _: (rows_search(scene, reading) for reading in (*CASES.values(), "side")),
    ),
    Output(
        "torque",
        "torque over the cycle, its mean, powers, fluctuation energy",
        ("torque", "torque_integrals", "torque_errors", "whole_turn"),
        torque,
        Columns(_torque_columns, needs=("friction", "torque_integrals", "whole_turn"), readings=("tangential",)),
        lambda scene, _: (torque_search(scene, scene.results["torque"].rotating_friction),),
    ),
    Output(
        "flywheel",
        "irregularity of the speed and inertia",
        ("torque_integrals", "flywheel"),
        flywheel,
        Columns(_flywheel_columns, needs=("flywheel",), readings=("tangential",)),
    ),
    Output(
        "overturning",
        "overturning couple on the frame",
        ("rod_forces", "whole_turn"),
        overturning,
        Columns(_overturning_columns, needs=("whole_turn",), readings=("tangential",)),
        lambda scene, _: (torque_search(scene),),
    ),
)
