"""The smallest circles around curves: how often their points are searched."""

from typing import Any

import numpy as np
import pytest

from optimizer.mechanics.kernel import entry
from optimizer.mechanics.kernel.circles import RADIUS, ROUNDS, UPPER
from optimizer.numerics.arrays import Real
from tests.analyze.driven import ask

#: places of two bearings beside a pair of opposed pistons at 0, whose loads of a few 100 kN cancel
_BEARINGS = [{"name": "A", "position_m": -0.2}, {"name": "B", "position_m": 0.3}]


def _circles(machine: dict[str, Any], monkeypatch: pytest.MonkeyPatch) -> Real:
    """Numbers of the circles around the bearing loads of a machine (J, 10)."""
    numbers: list[Real] = []
    over_turn = entry.over_turn

    def recorded(task: int, *arguments: Any, **rest: Any) -> Any:
        results = over_turn(task, *arguments, **rest)
        if task == entry.CIRCLES:
            numbers.append(results[2])
        return results

    monkeypatch.setattr(entry, "over_turn", recorded)
    ask(machine, "main_bearings", step_deg=90.0)
    return np.concatenate(numbers)


def _opposed(second_mass_kg: float) -> dict[str, Any]:
    """Two opposed pistons in one plane, the first of 100 kg."""
    throws = [
        {
            "name": name,
            "position_m": 0.0,
            "crank_radius_m": 0.1,
            "crank_angle_deg": angle,
            "rows": [
                {
                    "name": f"row {name}",
                    "axis_deg": angle,
                    "reciprocating_mass_kg": mass_kg,
                    "connecting_rod": {"length_m": 0.5},
                }
            ],
        }
        for name, angle, mass_kg in (("1", 0.0, 100.0), ("2", 180.0, second_mass_kg))
    ]
    return {"kind": "reciprocating", "name": "pair", "speed_rpm": 500.0, "throws": throws, "bearings": _BEARINGS}


def test_a_circle_around_what_rounding_leaves_ends_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """Analytic: the loads cancel. Regression: the circle was searched 50 times, to a share of what rounding leaves."""
    circles = _circles(_opposed(100.0), monkeypatch)
    assert 0.0 < np.max(circles[:, UPPER]) < 1e-9
    assert np.all(circles[:, ROUNDS] == 1)


def test_a_circle_around_a_load_is_searched_until_it_holds_the_load(monkeypatch: pytest.MonkeyPatch) -> None:
    """Analytic: half of 2 kg at 0.1 m turns against the shaft, of which bearing A carries 0.3/0.5; other orders add."""
    circles = _circles(_opposed(102.0), monkeypatch)
    largest = circles[np.argmax(circles[:, RADIUS])]
    assert largest[RADIUS] == pytest.approx(0.6 * 0.5 * 2.0 * 0.1, rel=0.25)
    # one search finds points beyond the first circle, the next finds none; others end as soon as they are smaller
    assert largest[ROUNDS] == 2
    assert np.all(circles[:, ROUNDS] <= 2)
