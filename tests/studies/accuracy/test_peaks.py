"""The ladder of peaks: brute force on even and uneven grids against the bracket."""

import numpy as np
import pytest

from optimizer.analyze import analyze
from optimizer.mechanics.layout import layout
from optimizer.studies.accuracy.peaks import PLACES, STEPS_DEG, TOLERANCES, peaks_ladder
from schemas.machine.reciprocating import ReciprocatingMachine
from schemas.request.accuracy import PeakRow
from schemas.request.requests import AnalyzeRequest
from tests.analyze.engines import FOUR, engine
from tests.builders import machine, row, throw
from tests.studies.accuracy.problems import body

QUANTITIES = ("peak_bearing_load", "peak_bending_moment", "peak_torque")


def ladder(design: ReciprocatingMachine) -> dict[tuple[str, str, str], PeakRow]:
    return {(line.quantity, line.method, line.setting): line for line in peaks_ladder(design, layout(design), 1)}


def posted(plan: object) -> ReciprocatingMachine:
    return ReciprocatingMachine.model_validate(plan)


@pytest.mark.parametrize("plan", [body("2d12")["machine"], engine(FOUR)], ids=["compressor", "engine"])
def test_brute_force_comes_near_and_never_beats_the_bracket(plan: object) -> None:
    scale = ladder(posted(plan))
    for quantity in QUANTITIES:
        sharpest = scale[quantity, "bracket", f"tolerance {TOLERANCES[-1]:.0e}"]
        assert sharpest.relative_error == 0.0
        assert sharpest.certified_gap is not None
        assert 0.0 <= sharpest.certified_gap < 1e-9
        for tolerance in TOLERANCES:
            rung = scale[quantity, "bracket", f"tolerance {tolerance:.0e}"]
            assert rung.certified_gap is not None
            assert -1e-12 <= rung.relative_error <= rung.certified_gap <= tolerance
            assert rung.angles is None
        # independent: samples of the same forces, with friction that jumps and valves or entries between them
        grids = [line for line in scale.values() if line.quantity == quantity and line.method != "bracket"]
        assert {grid.method for grid in grids} == {"pieces", "samples"}
        assert all(grid.certified_gap is None for grid in grids)
        assert all(grid.relative_error >= -sharpest.certified_gap - 1e-12 for grid in grids)
        uneven = [scale[quantity, "pieces", f"{count} in a piece"] for count in PLACES]
        assert uneven[-1].relative_error < 1e-5
        even = {grid.setting: grid for grid in grids if grid.method == "samples"}
        assert even["0.1 deg"].relative_error < 1e-2
        assert even["30 deg"].relative_error > even["0.1 deg"].relative_error - 1e-12
        turns = 2 if plan != body("2d12")["machine"] else 1
        assert even["1 deg"].angles == 360 * turns


def test_the_sharpest_bracket_is_what_the_service_answers() -> None:
    """Independent of the ladder: the coarse grids against peaks of /v1/analyze at the same step."""
    plan = engine(FOUR)
    scale = ladder(posted(plan))
    payload = {"machine": plan, "outputs": ["main_bearings", "torque"], "angles": {"step_deg": 10}}
    answer = analyze(AnalyzeRequest.model_validate(payload))
    assert answer.main_bearings is not None
    assert answer.torque is not None
    loads = [np.hypot(bearing.before.force_x_N, bearing.before.force_y_N) for bearing in answer.main_bearings.bearings]
    peak = max(bearing.before.peak_N for bearing in answer.main_bearings.bearings)
    assert scale["peak_bearing_load", "samples", "10 deg"].relative_error == pytest.approx(
        (peak - np.max(loads)) / peak, abs=1e-9
    )
    sampled = np.max(np.abs(answer.torque.torque_Nm))
    assert scale["peak_torque", "samples", "10 deg"].relative_error == pytest.approx(
        (answer.torque.peak_Nm - sampled) / answer.torque.peak_Nm, abs=1e-9
    )


def test_what_an_even_grid_misses_of_a_sine() -> None:
    """Analytic: T = -1/2 m r^2 w^2 sin 2 phi of a scotch yoke, sampled at 0, 30, 60 degrees: 1 - sin 60."""
    scale = ladder(machine(throw(0.0, row(0.0, 10.0, length_m=None))))
    assert {key[0] for key in scale} == {"peak_torque"}
    assert scale["peak_torque", "samples", "30 deg"].relative_error == pytest.approx(1.0 - np.sqrt(0.75), abs=1e-9)
    # 45 degrees is among the steps of 5
    assert scale["peak_torque", "samples", "5 deg"].relative_error == pytest.approx(0.0, abs=1e-9)
    assert {line.setting for line in scale.values() if line.method == "samples"} == {
        f"{step:g} deg" for step in STEPS_DEG
    }


def test_only_machines_with_the_data_have_a_ladder() -> None:
    bare = machine(throw(0.0, row(0.0).model_copy(update={"connecting_rod": None})))
    many = machine(*(throw(0.0, *(row(3.0 * k) for k in range(60))) for _ in range(2)))
    incomplete = engine(FOUR)
    del incomplete["throws"][0]["rows"][0]["cylinder"]["ambient_pressure_Pa"]
    for plan in (bare, machine(throw(0.0, rotating_kg=10.0)), many, posted(incomplete)):
        assert peaks_ladder(plan, layout(plan), 1) == ()
