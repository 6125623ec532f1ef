"""Figures that leave their customary range are said, and the answer stands."""

from typing import Any

import pytest

from optimizer.rating.rate import rate
from tests.rating.design import request


def codes(*changes: tuple[str, Any], **more: Any) -> list[tuple[str, int | None]]:
    # exact bores, and a limit that leaves some room: the seed's own machine gets a little too hot
    answer = rate(request(("discharge_temperature_limit_K", 440), ("bore_series", "none"), *changes, **more))
    assert all(warning.message for warning in answer.warnings)
    return [(warning.code, warning.stage) for warning in answer.warnings]


def test_a_customary_design_has_none() -> None:
    assert codes() == []


@pytest.mark.parametrize(
    ("changes", "expected"),
    [
        ({"discharge_temperature_limit_K": 432.5}, [("discharge_temperature", 1)]),
        ({"discharge_temperature_limit_K": 420}, [("discharge_temperature", 1), ("discharge_temperature", 2)]),
        ({"stages/0/pressure_coefficient": 0.985}, [("pressure_coefficient", 1)]),
        ({"stages/0/pressure_coefficient": 0.98}, []),
        ({"stages/1/pressure_coefficient": 0.97}, [("pressure_coefficient", 2)]),
        ({"stages/1/pressure_coefficient": None}, []),
        ({"stages/0/temperature_coefficient": 0.98}, [("temperature_coefficient", 1)]),
        ({"stages/0/relative_leaks/valves": 0.2}, [("leakage_coefficient", 1)]),
        ({"mean_piston_speed_m_s": 4.0}, [("mean_piston_speed", None)]),
        ({"rated_rod_load_N": "250 kN"}, [("rod_load", 1)]),
        ({"rated_rod_load_N": 117679.8}, [("rod_load", 1), ("rod_load", 2)]),
        ({"rated_rod_load_N": 3e5}, []),
        ({"installed_motor_power_W": 450e3}, [("motor_power", None)]),
        ({"installed_motor_power_W": 1600e3}, []),
        ({"stages/0/bore_m": 0.71}, [("capacity", None)]),
        ({"stages/0/suction_pressure_loss": None}, []),
        ({"stages/0/discharge_pressure_loss": None, "suction_pressure_Pa": 3.1e5}, []),
        ({"stages/1/discharge_pressure_loss": None, "discharge_pressure_Pa": 2.11e6}, [("pressure_losses", 2)]),
        ({"stages/0/suction_pressure_loss": None, "suction_pressure_Pa": 2.99e5}, [("pressure_losses", 1)]),
    ],
    ids=str,
)
def test_what_is_out_of_range_is_said(changes: dict[str, Any], expected: list[tuple[str, int | None]]) -> None:
    assert codes(*changes.items()) == expected


def test_both_sides_of_an_extrapolated_loss_are_named() -> None:
    changes = [(f"stages/0/{side}_pressure_loss", None) for side in ("suction", "discharge")]
    body = request(*changes, suction_pressure_Pa=1e5, discharge_pressure_Pa=6e5)
    message = next(warning.message for warning in rate(body).warnings if warning.code == "pressure_losses")
    assert "suction and discharge" in message
