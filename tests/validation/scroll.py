"""Anti-rotation pins: the equations of Liu, Zhao and Li (2006), and what their section 2 says in words."""

from collections.abc import Iterator
from typing import Any

import numpy as np

from optimizer.pins.answer import pin_loads
from schemas.scroll.pin_loads import PinLoadsAnswer, PinLoadsRequest
from tests.validation.comparison import Comparison

_TORQUE, _RADIUS = 12.0, 0.05


def _ask(**body: Any) -> PinLoadsAnswer:
    return pin_loads(PinLoadsRequest.model_validate({"rotation_torque_Nm": _TORQUE, **body}))


def comparisons() -> Iterator[Comparison]:
    for count in (3, 4, 6):
        analysis = _ask(pin_count=count, pin_circle_radius_m=_RADIUS)
        machine, peak = f"{count} even pins", 2.0 * _TORQUE / (count * _RADIUS)
        work, half = analysis.energy.pins_work_J, analysis.half_turn_mechanism_peak_N
        yield Comparison(machine, "Q_max, equation (3)", "published", peak, analysis.peak_N or np.nan, 1e-9, "N")
        yield Comparison(machine, "W_Q, equation (2)", "published", -np.pi * peak * _RADIUS, work, 1e-9, "J")
        yield Comparison(machine, "half-turn mechanism, peak over ours", "published", 2.0, half / peak, 1e-12, "-")
    two, three = ([{"angle_deg": angle, "radius_m": _RADIUS} for angle in of] for of in ((0, 90), (0, 110, 250)))
    rigid = {"type": "rigid"}
    cases = (
        ("2 pins at 0, 90 deg, rigid drive bearing", _ask(pins=two, drive_bearing=rigid), 240.0),
        ("3 pins at 0, 110, 250 deg, free drive bearing", _ask(pins=three), 178.8349),
        ("3 pins at 0, 110, 250 deg, rigid drive bearing", _ask(pins=three, drive_bearing=rigid), 194.4965),
    )
    for machine, answer, expected in cases:
        yield Comparison(machine, "largest load", "independent", expected, answer.peak_N or np.nan, 1e-4, "N")
