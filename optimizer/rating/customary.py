"""Customary ranges, and warnings where a figure leaves them."""

from collections.abc import Iterator, Sequence

from optimizer.rating.actual_stage import ActualStage
from optimizer.rating.curves import discharge_losses, suction_losses, temperature_coefficients
from optimizer.rating.design import StageDesign
from optimizer.rating.losses import mean_piston_speed
from schemas.rating.answer import RatingWarning
from schemas.rating.request import RatingRequest

#: section 1.3.2 of the design calculation of the 2D12: first stage, other stages
PRESSURE_COEFFICIENTS = ((0.95, 0.98), (0.98, 1.0))
#: section 1.3.3 of the design calculation of the 2D12
TEMPERATURE_COEFFICIENTS = (0.935, 0.975)
#: under (1-6) of the calculation of the 2D12, 0.85 to 0.95, without lubrication; a lubricated cylinder is tighter
LEAKAGE_COEFFICIENTS = (0.85, 0.98)
#: an actual capacity this close to that of the request counts as equal
CAPACITY_TOLERANCE = 0.05
#: a piston speed of the request this close to that of the machine counts as equal
SPEED_TOLERANCE = 0.01


def stage_warnings(
    request: RatingRequest, designs: Sequence[StageDesign], actuals: Sequence[ActualStage], gas_loads: Sequence[float]
) -> Iterator[RatingWarning]:
    """Warnings about single stages; ``gas_loads`` [N] are their largest gas forces."""
    for i, (plan, actual) in enumerate(zip(designs, actuals, strict=True)):
        number = i + 1
        temperature, limit = actual.in_cylinder.discharge_temperature_K, request.discharge_temperature_limit_K
        if temperature > limit:
            message = f"the gas leaves the cylinder at {temperature:.2f} K, above {limit:.2f} K"
            yield RatingWarning(code="discharge_temperature", message=message, stage=number)
        c = plan.coefficients
        if message := _outside(c.pressure, *PRESSURE_COEFFICIENTS[min(i, 1)]):
            yield RatingWarning(code="pressure_coefficient", message=message, stage=number)
        if message := _outside(c.temperature, *TEMPERATURE_COEFFICIENTS):
            yield RatingWarning(code="temperature_coefficient", message=message, stage=number)
        curve = temperature_coefficients(request)
        if plan.stage.temperature_coefficient is None and curve and not curve.covers(plan.nominal.pressure_ratio):
            message = f"it is extrapolated beyond the readings to a pressure ratio of {plan.nominal.pressure_ratio:.4g}"
            yield RatingWarning(code="temperature_coefficient", message=message, stage=number)
        if message := _outside(c.leakage, *LEAKAGE_COEFFICIENTS):
            yield RatingWarning(code="leakage_coefficient", message=message, stage=number)
        if sides := " and ".join(_extrapolated(request, plan)):
            message = f"the loss at {sides} is extrapolated beyond the readings of the chart; give it"
            yield RatingWarning(code="pressure_losses", message=message, stage=number)
        rated = request.rated_rod_load_N
        if rated is not None and gas_loads[i] > rated:
            message = f"the gas force reaches {gas_loads[i]:.5g} N, the frame is rated for {rated:.5g} N"
            yield RatingWarning(code="rod_load", message=message, stage=number)


def machine_warnings(request: RatingRequest, capacity_share: float, motor_power: float) -> Iterator[RatingWarning]:
    """Warnings about the whole machine; ``motor_power`` [W] is what it needs."""
    if abs(capacity_share - 1.0) > CAPACITY_TOLERANCE:
        message = f"the built machine delivers {capacity_share:.1%} of the capacity asked for"
        yield RatingWarning(code="capacity", message=message, stage=None)
    speed, own = request.mean_piston_speed_m_s, mean_piston_speed(request.stroke_m, request.speed_rpm)
    if speed is not None and abs(speed / own - 1.0) > SPEED_TOLERANCE:
        message = f"losses are corrected for {speed:.4g} m/s, but stroke and speed make {own:.4g} m/s"
        yield RatingWarning(code="mean_piston_speed", message=message, stage=None)
    installed = request.installed_motor_power_W
    if installed is not None and motor_power > installed:
        message = f"the machine needs a motor of {motor_power:.5g} W, it has one of {installed:.5g} W"
        yield RatingWarning(code="motor_power", message=message, stage=None)


def _outside(value: float, low: float, high: float) -> str:
    return "" if low <= value <= high else f"{value:.4g} is not within the customary {low:.4g} to {high:.4g}"


def _extrapolated(request: RatingRequest, design: StageDesign) -> Iterator[str]:
    stage, nominal = design.stage, design.nominal
    if stage.suction_pressure_loss is None and not suction_losses(request).covers(nominal.suction_pressure_Pa):
        yield "suction"
    if stage.discharge_pressure_loss is None and not discharge_losses(request).covers(nominal.discharge_pressure_Pa):
        yield "discharge"
