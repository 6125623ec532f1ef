"""Peaks of the turn on machines that are hard to evaluate: closed brackets that no sample is above."""

import numpy as np
import pytest

from tests.analyze.driven import ask
from tests.hard_effects.machines import MACHINES, Hard

OUTPUTS = ("torque", "rod_loads", "overturning", "piston_force", "main_bearings")
BEARINGS = [{"name": "A", "position_m": -0.3}, {"name": "B", "position_m": 0.7}]


@pytest.mark.parametrize("hard", MACHINES, ids=lambda hard: hard.name)
def test_brackets_are_closed_and_above_all_samples(hard: Hard) -> None:
    # independent: series of the same quantities by other formulas, every 2 degrees
    answer = ask({**hard.body, "bearings": BEARINGS}, *OUTPUTS, step_deg=2.0)
    # what cancels between rows is known to the rounding of its parts
    rows = sum(np.max(np.abs(row.torque_Nm)) for row in answer.torque.rows)
    brackets = [
        (np.abs(answer.torque.torque_Nm), answer.torque.peak_bracket_Nm, rows),
        (np.abs(answer.overturning.couple_Nm), answer.overturning.peak_bracket_Nm, rows),
    ]
    for bearing in answer.main_bearings.bearings:
        size = np.hypot(bearing.before.force_x_N, bearing.before.force_y_N)
        brackets.append((size, bearing.before.peak_bracket_N, np.max(size)))
    for loads, piston in zip(answer.rod_loads.rows, answer.piston_force.rows, strict=True):
        total = np.array(piston.total_N)
        size = np.max(np.abs(total))
        brackets += [
            (np.array(loads.rod_N), loads.cases[0].tension_bracket_N, size),
            (np.abs(loads.side_N), loads.peak_side_bracket_N, size),
            (total, piston.peak_tension_bracket_N, size),
            (-total, tuple(-end for end in piston.peak_compression_bracket_N[::-1]), size),
        ]
    assert "peak_not_closed" not in [caution.code for caution in answer.warnings]
    for samples, (low, high), size in brackets:
        assert np.max(samples) <= high + 1e-10 * size
        assert low <= high <= low + 1e-8 * abs(low) + 1e-12 * size
