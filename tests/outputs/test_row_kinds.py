"""Peaks of rows that differ by their phase alone are found once, and shown for all of them."""

from typing import Any

import numpy as np
import pytest

from optimizer.mechanics import whole_turn
from optimizer.outputs.peaks import of_rows, row_peaks
from optimizer.outputs.registry import prepare
from schemas.request.requests import AnalyzeRequest
from tests import night
from tests.analyze.driven import STYLES, ask
from tests.mechanics.test_row_kinds import COUNTS, equal_throws

_SHOWN = ("piston_force", "rod_loads", "loads", "torque", "overturning", "main_bearings")


def _answer(body: dict[str, Any]) -> Any:
    return ask(body, *_SHOWN, step_deg=30.0)


@pytest.mark.parametrize("style", night.part(2, STYLES))
@pytest.mark.parametrize("count", night.part(2, COUNTS))
def test_answers_are_those_of_rows_one_by_one(count: int, style: str, monkeypatch: pytest.MonkeyPatch) -> None:
    # analytic: a row that is ahead has the same peaks, that much earlier
    body = equal_throws(count, style, count)
    answer = _answer(body)
    monkeypatch.setattr(whole_turn, "row_kinds", lambda *_: None)
    expected = _answer(body)
    for loads, forces, entry, part in zip(
        *(answer.rod_loads.rows, answer.piston_force.rows),
        *(expected.rod_loads.rows, expected.piston_force.rows),
        strict=True,
    ):
        assert loads.governing_case == entry.governing_case
        assert loads.peak_side_N == pytest.approx(entry.peak_side_N, rel=1e-9)
        assert forces.peak_tension_N == pytest.approx(part.peak_tension_N, rel=1e-9)
        assert forces.peak_compression_N == pytest.approx(part.peak_compression_N, rel=1e-9)
        for case, same in zip(loads.cases, entry.cases, strict=True):
            assert case.tension_bracket_N == pytest.approx(same.tension_bracket_N, rel=1e-9)
            assert case.compression_bracket_N == pytest.approx(same.compression_bracket_N, rel=1e-9)
    for name in ("torque", "overturning"):
        assert getattr(answer, name).peak_Nm == pytest.approx(getattr(expected, name).peak_Nm, rel=1e-9)
    for bearing, support in zip(answer.main_bearings.bearings, expected.main_bearings.bearings, strict=True):
        assert bearing.before.peak_N == pytest.approx(support.before.peak_N, rel=1e-9)
        assert bearing.before.rms_N == pytest.approx(support.before.rms_N, rel=1e-10)


def test_counterweights_without_mass_change_no_bearing_load() -> None:
    # analytic: what is nothing adds nothing, and is searched once
    body = equal_throws(1, "single", 2)
    main_bearings = ask(body, "main_bearings", step_deg=30.0).main_bearings
    assert main_bearings is not None
    assert main_bearings.bending.after_Nm == main_bearings.bending.before_Nm
    assert all(bearing.after == bearing.before for bearing in main_bearings.bearings)
    fitted = [{"web": web["name"], "mass_kg": 20.0, "angle_deg": 30.0} for web in body["webs"]]
    laden = ask(body, "main_bearings", step_deg=30.0, counterweights=fitted).main_bearings
    assert laden is not None
    assert all(bearing.after != bearing.before for bearing in laden.bearings)
    assert [bearing.before for bearing in laden.bearings] == [bearing.before for bearing in main_bearings.bearings]


@pytest.mark.parametrize("reading", ["piston", "rod", "rod_at_rest", "side"])
def test_a_row_has_its_peaks_where_it_stands(reading: Any) -> None:
    # independent: the force of the row at the angle that is shown
    request = AnalyzeRequest.model_validate({"machine": equal_throws(1, "v", 4), "outputs": _SHOWN})
    scene = prepare(request, request.outputs)
    turn = scene.results["whole_turn"]
    assert turn.kinds is not None
    count = turn.rows.crank_radius.shape[-1]
    curves = turn.curves(reading, np.eye(count)[None])
    high, low = row_peaks(scene, reading)
    extremes = of_rows(scene, reading)
    for sign, peaks, same in ((1.0, high, extremes.high), (-1.0, low, extremes.low)):
        values = sign * np.diagonal(curves.at(np.deg2rad(peaks.angle_deg))).real
        beside = sign * np.diagonal(curves.at(np.deg2rad(peaks.angle_deg) + 1e-12)).real
        before = sign * np.diagonal(curves.at(np.deg2rad(peaks.angle_deg) - 1e-12)).real
        # beside a jump it is a limit from one side
        attained = np.max([values, beside, before], axis=0)
        assert attained == pytest.approx(np.array(peaks.lower), rel=1e-8)
        np.testing.assert_array_equal(same.lower, peaks.lower)
        assert np.exp(1j * same.angle) == pytest.approx(np.exp(1j * np.deg2rad(peaks.angle_deg)), rel=1e-12)
