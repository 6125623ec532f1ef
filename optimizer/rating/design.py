"""What the capacity asks for: coefficients, volumes and bores between the nominal pressures."""

from collections.abc import Iterator, Sequence

from optimizer.errors import refuse
from optimizer.numerics.records import record
from optimizer.rating.curves import TEMPERATURE_COEFFICIENT, Curve, temperature_coefficients
from optimizer.rating.delivery import (
    coefficients,
    expansion_exponent,
    leakage_coefficients,
    pressure_coefficient,
    volumetric_coefficient,
)
from optimizer.rating.power import at_suction
from optimizer.rating.ratios import split, stage_state
from optimizer.rating.sizes import Piston, stage_flow, swept_volume
from optimizer.rating.steam import condensate_coefficients, saturation_pressure
from schemas.base.model import FieldProblem
from schemas.rating.answer import CylinderSize, DeliveryCoefficients, StageState
from schemas.rating.request import CompressionStage, RatingRequest

SMALLEST_BORE_M, LARGEST_BORE_M = 1e-4, 100.0


@record(frozen=True)
class StageDesign:
    """One stage between its nominal pressures."""

    stage: CompressionStage
    piston: Piston
    m: float
    n: float
    nominal: StageState
    coefficients: DeliveryCoefficients
    saturation_pressure: float | None
    condensate: float
    size: CylinderSize


def suction_per_capacity(request: RatingRequest) -> float:
    """Volume at the first suction state over volume in the state in which the capacity is measured."""
    p1, T1 = request.suction_pressure_Pa, request.stages[0].suction_temperature_K
    p = p1 if request.capacity_pressure_Pa is None else request.capacity_pressure_Pa
    T = T1 if request.capacity_temperature_K is None else request.capacity_temperature_K
    return at_suction(p, T, p1, T1)


def design(request: RatingRequest, rods: Sequence[float]) -> list[StageDesign]:
    """Every stage between its nominal pressures, (1-1) to (1-12) and (1-17), with rods of these diameters [m].

    Raises
    ------
    OutOfRange
        if a clearance leaves nothing to take in, the gas at the inlet would be all steam, or no bore will do.
    """
    stages = request.stages
    pressures = split(
        request.suction_pressure_Pa, request.discharge_pressure_Pa, len(stages), request.interstage_pressures_Pa
    )
    exponents = [stage.compression_exponent or request.isentropic_exponent for stage in stages]
    nominal = [
        stage_state(p1, p2, stage.suction_temperature_K, n)
        for stage, p1, p2, n in zip(stages, pressures[:-1], pressures[1:], exponents, strict=True)
    ]
    expansion = [
        stage.expansion_exponent or expansion_exponent(p1, request.isentropic_exponent)
        for stage, p1 in zip(stages, pressures[:-1], strict=True)
    ]
    result = delivery(request, nominal, expansion)
    saturation = _saturation(request)
    condensate = [1.0] * len(stages)
    if saturation is not None:
        condensate = condensate_coefficients(request.relative_humidity, pressures[:-1], saturation)
    flow = request.capacity_m3_per_min * suction_per_capacity(request)
    designs = []
    for i, stage in enumerate(stages):
        share = condensate[i] * stage.side_flow_coefficient
        temperatures = stages[0].suction_temperature_K, stage.suction_temperature_K
        here = stage_flow(flow, pressures[0], pressures[i], *temperatures, share)
        piston = Piston(stage.cylinders, stage.acting, rods[i], request.stroke_m)
        bore = piston.bore(swept_volume(here, request.speed_rpm, result[i].delivery))
        designs.append(
            StageDesign(
                stage=stage,
                piston=piston,
                m=expansion[i],
                n=exponents[i],
                nominal=nominal[i],
                coefficients=result[i],
                saturation_pressure=None if saturation is None else saturation[i],
                condensate=condensate[i],
                size=piston.size(bore),
            )
        )
    refuse(_size_problems(designs))
    return designs


def delivery(
    request: RatingRequest, states: Sequence[StageState], expansion: Sequence[float]
) -> list[DeliveryCoefficients]:
    """Delivery coefficients of every stage between these pressures, (1-4) to (1-6).

    Raises
    ------
    OutOfRange
        if a clearance leaves nothing to take in.
    """
    stages, curve = request.stages, temperature_coefficients(request)
    volumetric = [
        volumetric_coefficient(stage.relative_clearance, state.pressure_ratio, m)
        for stage, state, m in zip(stages, states, expansion, strict=True)
    ]
    refuse(
        FieldProblem(
            ("stages", i, "relative_clearance"),
            f"too large: at a pressure ratio of {state.pressure_ratio:.4g} the clearance gas fills the cylinder",
        )
        for i, state in enumerate(states)
        if volumetric[i] <= 0.0
    )
    leakage = leakage_coefficients(stages)
    return [
        coefficients(
            volumetric[i],
            pressure_coefficient(stage, i),
            _temperature_coefficient(stage, curve, states[i].pressure_ratio),
            leakage[i],
        )
        for i, stage in enumerate(stages)
    ]


def _temperature_coefficient(stage: CompressionStage, curve: Curve | None, ratio: float) -> float:
    """lam_T of the request, read off the curve at a pressure ratio, or customary."""
    if stage.temperature_coefficient is not None:
        return stage.temperature_coefficient
    return TEMPERATURE_COEFFICIENT if curve is None else curve.at(ratio)


def _saturation(request: RatingRequest) -> list[float] | None:
    """Saturation pressure [Pa] at every suction; None where the gas is dry."""
    if request.relative_humidity == 0.0:
        return None
    pressures = [saturation_pressure(stage.suction_temperature_K) for stage in request.stages]
    if not request.relative_humidity * pressures[0] < request.suction_pressure_Pa:
        message = f"too large: at saturation the vapour has {pressures[0]:.4g} Pa, and the gas at suction has less"
        refuse([FieldProblem(("relative_humidity",), message)])
    return pressures


def _size_problems(designs: Sequence[StageDesign]) -> Iterator[FieldProblem]:
    for i, stage_design in enumerate(designs):
        bore = stage_design.size.bore_m
        if not SMALLEST_BORE_M <= bore <= LARGEST_BORE_M:
            message = f"would take a bore of {bore:.4g} m in stage {i + 1}; {SMALLEST_BORE_M} to {LARGEST_BORE_M} m do"
            yield FieldProblem(("capacity_m3_per_min",), message)
        elif not stage_design.piston.rod < bore:
            message = f"must be smaller than the bore, which is calculated to be {bore:.4g} m"
            yield FieldProblem(("stages", i, "piston_rod_diameter_m"), message)
