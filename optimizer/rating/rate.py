"""The thermal design of a compressor, from the request to the answer."""

from collections.abc import Sequence

from optimizer.rating.actual_stage import ActualStage, build, piston_speed
from optimizer.rating.choice import with_choice
from optimizer.rating.curves import (
    REQUEST,
    TEMPERATURE_SOURCE,
    discharge_losses,
    suction_losses,
    temperature_coefficients,
)
from optimizer.rating.customary import machine_warnings, stage_warnings
from optimizer.rating.design import StageDesign, design, suction_per_capacity
from optimizer.rating.loads import gas_loads, rod_loads, tandem_loads
from optimizer.rating.power import indicated_power, motor_power, shaft_power, suction_flow
from optimizer.rating.ratios import discharge_temperature
from schemas.base.mappings import or_mapping
from schemas.machine.cylinder import Cylinder
from schemas.rating.answer import CoefficientSources, RatingAnswer, StageRating
from schemas.rating.request import CompressionStage, RatingRequest


@or_mapping(RatingRequest)
def rate(request: RatingRequest) -> RatingAnswer:
    """Size the cylinders of a compressor for a capacity, and say what the built machine delivers and needs.

    Raises
    ------
    OutOfRange
        if no machine meets the request; names the fields.
    """
    entries = [stage.piston_rod_diameter_m for stage in request.stages]
    diameters = [diameter for diameter in entries if diameter is not None]
    if request.motors or len(diameters) < len(entries):
        return with_choice(request, _rated)
    return _rated(request, diameters)


def _rated(request: RatingRequest, rods: Sequence[float]) -> RatingAnswer:
    """The machine at the speed of the request, with piston rods of these diameters [m]."""
    designs = design(request, rods)
    actuals = build(request, designs)
    stages = tuple(_stage(request, stage_design, actual) for stage_design, actual in zip(designs, actuals, strict=True))
    capacity = suction_flow(
        actuals[0].size.swept_volume_m3, request.speed_rpm, actuals[0].coefficients.delivery
    ) / suction_per_capacity(request)
    share = capacity / request.capacity_m3_per_min
    gas = [stage.actual_loads for stage in stages]
    tandems = tuple(tandem_loads(numbers, gas) for numbers in request.tandems)
    loads = rod_loads(gas, tandems)
    indicated = sum(stage.indicated_power_W for stage in stages)
    shaft = shaft_power(indicated, request.mechanical_efficiency)
    motor = motor_power(shaft, request.motor_margin, request.drive_efficiency)
    return RatingAnswer(
        total_pressure_ratio=request.discharge_pressure_Pa / request.suction_pressure_Pa,
        mean_piston_speed_m_s=piston_speed(request),
        capacity_m3_per_min=capacity,
        capacity_share=share,
        stages=stages,
        tandem_loads=tandems,
        largest_rod_load_N=max(loads),
        indicated_power_W=indicated,
        shaft_power_W=shaft,
        motor_power_W=motor,
        warnings=(*stage_warnings(request, designs, actuals, loads), *machine_warnings(request, share, motor)),
    )


def _stage(request: RatingRequest, design: StageDesign, actual: ActualStage) -> StageRating:
    stage, nominal, inside = design.stage, design.nominal, actual.in_cylinder
    ambient = request.ambient_pressure_Pa
    return StageRating(
        name=stage.name,
        cylinders=stage.cylinders,
        nominal=nominal,
        expansion_exponent=design.m,
        design_coefficients=design.coefficients,
        saturation_pressure_Pa=design.saturation_pressure,
        condensate_coefficient=design.condensate,
        calculated=design.size,
        nominal_loads=gas_loads(
            nominal.suction_pressure_Pa, nominal.discharge_pressure_Pa, ambient, stage.acting, design.size
        ),
        actual=actual.size,
        suction_pressure_correction=actual.corrections[0],
        discharge_pressure_correction=actual.corrections[1],
        corrected=actual.corrected,
        reference_losses=actual.reference_losses,
        losses=actual.losses,
        in_cylinder=inside,
        polytropic_temperature_K=None
        if stage.polytropic_exponent is None
        else discharge_temperature(stage.suction_temperature_K, inside.pressure_ratio, stage.polytropic_exponent),
        actual_coefficients=actual.coefficients,
        actual_loads=gas_loads(
            inside.suction_pressure_Pa, inside.discharge_pressure_Pa, ambient, stage.acting, actual.size
        ),
        sources=_sources(request, stage),
        indicated_power_W=indicated_power(
            inside.suction_pressure_Pa,
            actual.size.swept_volume_m3,
            actual.coefficients.volumetric,
            inside.pressure_ratio,
            design.n,
            request.speed_rpm,
        ),
        cylinder=_cylinder(request, design, actual),
    )


def _sources(request: RatingRequest, stage: CompressionStage) -> CoefficientSources:
    curve = temperature_coefficients(request)
    customary = TEMPERATURE_SOURCE if curve is None else curve.source
    return CoefficientSources(
        suction_pressure_loss=suction_losses(request).source if stage.suction_pressure_loss is None else REQUEST,
        discharge_pressure_loss=discharge_losses(request).source if stage.discharge_pressure_loss is None else REQUEST,
        temperature_coefficient=customary if stage.temperature_coefficient is None else REQUEST,
    )


def _cylinder(request: RatingRequest, design: StageDesign, actual: ActualStage) -> Cylinder:
    """One cylinder as a row of a machine takes it: pressures in the cylinder, exponents of the thermal design."""
    return Cylinder(
        bore_m=actual.size.bore_m,
        piston_rod_diameter_m=design.piston.rod,
        acting=design.stage.acting,
        suction_pressure_Pa=actual.in_cylinder.suction_pressure_Pa,
        discharge_pressure_Pa=actual.in_cylinder.discharge_pressure_Pa,
        ambient_pressure_Pa=request.ambient_pressure_Pa,
        relative_clearance=design.stage.relative_clearance,
        expansion_exponent=design.m,
        compression_exponent=design.n,
    )
