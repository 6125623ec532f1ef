"""What the built machine does: rounded bores, corrected pressures, losses, pressures in the cylinder."""

from collections.abc import Iterator, Sequence

from optimizer.errors import refuse
from optimizer.numerics.records import record
from optimizer.rating.curves import discharge_losses, suction_losses
from optimizer.rating.design import StageDesign, delivery
from optimizer.rating.losses import corrected_loss, mean_piston_speed, pressures_in_cylinder
from optimizer.rating.ratios import stage_state
from optimizer.rating.sizes import nominal_bore, pressure_correction
from schemas.base.model import FieldProblem
from schemas.rating.answer import CylinderSize, DeliveryCoefficients, PressureLosses, StageState
from schemas.rating.request import RatingRequest


@record(frozen=True)
class ActualStage:
    """One stage as built."""

    size: CylinderSize
    corrections: tuple[float, float]
    corrected: StageState
    reference_losses: PressureLosses
    losses: PressureLosses
    in_cylinder: StageState
    coefficients: DeliveryCoefficients


def piston_speed(request: RatingRequest) -> float:
    """Mean piston speed [m/s] for the pressure losses: of the request, or that of the machine."""
    if request.mean_piston_speed_m_s is not None:
        return request.mean_piston_speed_m_s
    return mean_piston_speed(request.stroke_m, request.speed_rpm)


def build(request: RatingRequest, designs: Sequence[StageDesign]) -> list[ActualStage]:
    """Every stage as built, (1-18) to (1-27).

    Raises
    ------
    OutOfRange
        if the built bores leave a stage nothing to compress, or the losses are as large as the pressures.
    """
    sizes = _sizes(request, designs)
    # before the first and after the last stage, the pressures are not the machine's to change
    first = designs[0].size.swept_volume_m3, sizes[0].swept_volume_m3
    inner = [
        pressure_correction(*first, design.size.swept_volume_m3, size.swept_volume_m3)
        for design, size in zip(designs[1:], sizes[1:], strict=True)
    ]
    corrections = [1.0, *inner, 1.0]
    corrected = [_corrected(design, *corrections[i : i + 2]) for i, design in enumerate(designs)]
    refuse(_order_problems(corrected))
    reference = [_reference_losses(request, design) for design in designs]
    losses = [_losses(request, stage_losses) for stage_losses in reference]
    refuse(_loss_problems(losses))
    in_cylinder = [
        _in_cylinder(design, state, loss) for design, state, loss in zip(designs, corrected, losses, strict=True)
    ]
    coefficients = delivery(request, in_cylinder, [design.m for design in designs])
    return [
        ActualStage(
            size=sizes[i],
            corrections=(corrections[i], corrections[i + 1]),
            corrected=corrected[i],
            reference_losses=reference[i],
            losses=losses[i],
            in_cylinder=in_cylinder[i],
            coefficients=coefficients[i],
        )
        for i in range(len(designs))
    ]


def _sizes(request: RatingRequest, designs: Sequence[StageDesign]) -> list[CylinderSize]:
    bores = [design.stage.bore_m or nominal_bore(design.size.bore_m, request.bore_series) for design in designs]
    refuse(
        FieldProblem(
            ("stages", i, "piston_rod_diameter_m"), f"must be smaller than the bore, which is rounded to {bore:.4g} m"
        )
        for i, (stage_design, bore) in enumerate(zip(designs, bores, strict=True))
        if not stage_design.piston.rod < bore
    )
    return [design.piston.size(bore) for design, bore in zip(designs, bores, strict=True)]


def _corrected(design: StageDesign, suction: float, discharge: float) -> StageState:
    """p1' = beta_k p1, p2' = beta_(k+1) p2, eps' = p2'/p1', (1-21) to (1-23)."""
    p1, p2 = design.nominal.suction_pressure_Pa * suction, design.nominal.discharge_pressure_Pa * discharge
    return stage_state(p1, p2, design.stage.suction_temperature_K, design.n)


def _in_cylinder(design: StageDesign, state: StageState, losses: PressureLosses) -> StageState:
    p_s, p_d = pressures_in_cylinder(
        state.suction_pressure_Pa, state.discharge_pressure_Pa, losses.suction, losses.discharge
    )
    return stage_state(p_s, p_d, design.stage.suction_temperature_K, design.n)


def _reference_losses(request: RatingRequest, design: StageDesign) -> PressureLosses:
    suction, discharge = design.stage.suction_pressure_loss, design.stage.discharge_pressure_loss
    return PressureLosses(
        suction=suction_losses(request).at(design.nominal.suction_pressure_Pa) if suction is None else suction,
        discharge=discharge_losses(request).at(design.nominal.discharge_pressure_Pa)
        if discharge is None
        else discharge,
    )


def _losses(request: RatingRequest, reference: PressureLosses) -> PressureLosses:
    speed, density = piston_speed(request), request.relative_density
    return PressureLosses(
        suction=corrected_loss(reference.suction, speed, density),
        discharge=corrected_loss(reference.discharge, speed, density),
    )


def _order_problems(states: Sequence[StageState]) -> Iterator[FieldProblem]:
    for i, state in enumerate(states):
        if not state.pressure_ratio > 1.0:
            message = "the bores leave this stage nothing to compress: its discharge would not be above its suction"
            yield FieldProblem(("stages", i, "bore_m"), message)


def _loss_problems(losses: Sequence[PressureLosses]) -> Iterator[FieldProblem]:
    for i, pair in enumerate(losses):
        for name, loss in (("suction", pair.suction), ("discharge", pair.discharge)):
            if not loss < 1.0:
                message = f"becomes {loss:.3g} times the pressure at this mean piston speed and density"
                yield FieldProblem(("stages", i, f"{name}_pressure_loss"), message)
