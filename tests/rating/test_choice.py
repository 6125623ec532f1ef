"""Piston rods and motors chosen from tables, and coefficients read off curves."""

from typing import Any

import pytest

from optimizer.errors import OutOfRange
from optimizer.rating.rate import rate
from schemas.rating.answer import RatingAnswer
from tests.rating.design import near, request, rods
from tests.rating.test_refusals import Path, refused

#: the type names a frame of 12 t (117.7 kN), for which 90 mm are taken at first
RODS = [
    {"diameter_m": 0.09, "largest_force_N": 117679.8},
    {"diameter_m": 0.1, "largest_force_N": 180e3},
    {"diameter_m": "110 mm", "largest_force_N": "250 kN"},
]
CURVE = {"pressure_ratio": [2.0, 4.0], "temperature_coefficient": [0.97, 0.94], "source": "here"}
MOTORS = [
    {"power_W": power, "speed_rpm": speed} for power, speed in ((1.3e6, 497), (1.4e6, 496), (1.4e6, 740), (1.6e6, 497))
]
OPEN: list[tuple[str, Any]] = [("stages/0/piston_rod_diameter_m", None), ("stages/1/piston_rod_diameter_m", None)]


def rating_of(*changes: tuple[str, Any], **more: Any) -> RatingAnswer:
    return rate(request(*changes, mean_piston_speed_m_s=4.0, **more))


def test_rods_of_the_2d12_published() -> None:
    """It begins with 90 mm, finds some 24 t, and ends with 110 mm."""
    answer = rating_of(*OPEN, piston_rods=RODS)
    assert answer.choice is not None
    first, *_, last = answer.choice.steps
    assert first.piston_rod_diameters_m == (0.09, 0.09)
    assert min(first.rod_loads_N) > 2 * 117e3
    assert last.piston_rod_diameters_m == answer.choice.piston_rod_diameters_m == (0.11, 0.11)
    # the figures are those of the same rods given
    reply = rating_of(*rods(0.11))
    assert answer.model_copy(update={"choice": None}) == reply
    assert reply.choice is None
    assert [stage.cylinder.piston_rod_diameter_m for stage in answer.stages] == [0.11, 0.11]


def test_a_given_rod_stays() -> None:
    answer = rating_of(OPEN[1], ("stages/0/piston_rod_diameter_m", 0.08), piston_rods=RODS)
    assert answer.choice is not None
    assert answer.choice.piston_rod_diameters_m == (0.08, 0.11)


def test_a_motor_at_its_own_speed_analytic() -> None:
    """1394 kW are needed at 500 rpm; 1300 kW do not do, 740 rpm are too far off, and the machine runs at 496 rpm."""
    answer = rating_of(motors=MOTORS)
    assert answer.choice is not None
    assert (answer.choice.motor_power_W, answer.choice.speed_rpm) == (1.4e6, 496)
    assert [step.speed_rpm for step in answer.choice.steps] == [497, 496]
    assert answer.motor_power_W <= 1.4e6
    assert answer.motor_power_W == rating_of(speed_rpm=496).motor_power_W
    # slower cylinders are larger
    assert answer.stages[0].calculated.swept_volume_m3 == pytest.approx(
        rating_of().stages[0].calculated.swept_volume_m3 * 500 / 496
    )
    at_any_speed = rating_of(motors=[{"power_W": 2e6}])
    assert at_any_speed.choice is not None
    assert (at_any_speed.choice.speed_rpm, len(at_any_speed.choice.steps)) == (500, 1)


@pytest.mark.parametrize(
    ("more", "path"),
    [
        ({"piston_rods": RODS[:2]}, ("piston_rods",)),
        ({"piston_rods": RODS, "motors": MOTORS[:1]}, ("motors",)),
        ({"piston_rods": RODS, "motors": [{"power_W": 2e6, "speed_rpm": 740}]}, ("motors",)),
    ],
)
def test_tables_that_do_not_suffice(more: dict[str, Any], path: Path) -> None:
    with pytest.raises(OutOfRange) as caught:
        rating_of(*OPEN, **more)
    assert {problem.path for problem in caught.value.problems} == {path}


@pytest.mark.parametrize(
    ("changes", "path"),
    [
        ({"stages/0/piston_rod_diameter_m": None}, ("stages", 0, "piston_rod_diameter_m")),
        ({"piston_rods": RODS[::-1]}, ("piston_rods", 1, "diameter_m")),
        ({"piston_rods": [RODS[0], {**RODS[1], "largest_force_N": 1}]}, ("piston_rods", 1, "largest_force_N")),
        ({"motors": MOTORS[::-1]}, ("motors", 1, "power_W")),
        ({"motors": MOTORS, "installed_motor_power_W": 1e6}, ("installed_motor_power_W",)),
        ({"temperature_curve": {**CURVE, "pressure_ratio": [2]}}, ("temperature_curve", "pressure_ratio")),
        ({"temperature_curve": {**CURVE, "pressure_ratio": [4, 2]}}, ("temperature_curve", "pressure_ratio", 1)),
        ({"temperature_curve": {**CURVE, "source": ""}}, ("temperature_curve", "source")),
    ],
)
def test_tables_that_are_wrong(changes: dict[str, Any], path: Path) -> None:
    assert path in refused(changes)


def test_coefficients_off_curves_with_their_source() -> None:
    """Analytic: the power law between two readings, and the customary curves given as the request's own."""
    unsaid = [
        (f"stages/{i}/{name}", None) for i in (0, 1) for name in ("suction_pressure_loss", "discharge_pressure_loss")
    ]
    unsaid += [(f"stages/{i}/temperature_coefficient", None) for i in (0, 1)]
    customary = rating_of(*unsaid)
    assert {stage.sources.suction_pressure_loss for stage in customary.stages} == {
        "design calculation of the 2D12-90/2-20 compressor, under (1-24)"
    }
    assert [stage.actual_coefficients.temperature for stage in customary.stages] == [0.96, 0.96]
    own = {
        "suction_loss_curve": {"pressure_Pa": ["0.3 MPa", "0.79 MPa"], "relative_loss": [0.036, 0.028], "source": "a"},
        "discharge_loss_curve": {"pressure_Pa": [0.79e6, 2.1e6], "relative_loss": [0.061, 0.045], "source": "b"},
    }
    same = rating_of(*unsaid, **own)
    for rating, second_stage in zip(same.stages, customary.stages, strict=True):
        assert rating.model_copy(update={"sources": second_stage.sources}) == second_stage
    assert [(stage.sources.suction_pressure_loss, stage.sources.discharge_pressure_loss) for stage in same.stages] == [
        ("a", "b"),
        ("a", "b"),
    ]
    curved = rating_of(*unsaid, temperature_curve=CURVE)
    ratio = 7**0.5
    power = 0.97 * (0.94 / 0.97) ** ((0.5 * 1.9459101490553132 - 0.6931471805599453) / 0.6931471805599453)
    assert curved.stages[0].nominal.pressure_ratio == pytest.approx(ratio)
    assert curved.stages[0].design_coefficients.temperature == near(power, 1e-12)
    assert curved.stages[0].sources.temperature_coefficient == "here"
    assert rating_of().stages[0].sources.temperature_coefficient == "request"
    beyond = rating_of(*unsaid, temperature_curve={**CURVE, "pressure_ratio": [3.0, 4.0]})
    warnings = [
        warning
        for warning in beyond.warnings
        if warning.code == "temperature_coefficient" and "extrapolated" in warning.message
    ]
    assert [warning.stage for warning in warnings] == [1, 2]
