"""Loads of scroll pins with clearance in the checker: their peaks are enclosed, and brackets held from both sides."""

from math import radians, sin
from typing import Any

import numpy as np
import pytest
from scipy.optimize import root as optimize_root

from service.verification import checker
from tests.verification.checking import is_broken
from tests.verification.falsified import at, replaced
from tests.verification.pin_requests import BETWEEN, JUMPS, LOOSE, PLACES, WITH_CLEARANCE, pair, pins_of
from tests.verification.test_curves import part


@pytest.mark.parametrize("name", WITH_CLEARANCE)
def test_with_clearance_all_is_held_but_peaks_where_loads_jump(name: str) -> None:
    verdict = checker().verify(*pair(name))
    assert verdict["verdict"] == ("not covered" if name == JUMPS else "held")
    assert all(where.removesuffix("/*").rpartition("/")[2] in BETWEEN for where in verdict["not_covered"]), verdict[
        "not_covered"
    ]


@pytest.mark.parametrize("end", [0.999999, 1.00001])
def test_the_upper_end_of_a_bracket_with_clearance_is_held_from_both_sides(end: float) -> None:
    request, answer = pair("clearance, rigid")
    place = ("drive_bearing", "peak_bracket_N", 1)
    assert is_broken(request, replaced(answer, place, end * at(answer, place)))


def test_a_wide_bracket_is_broken_where_the_answer_does_not_say_that_it_is() -> None:
    """Of all pins the largest end is stated again, so both are wide alike."""
    request, answer = pair("clearance")
    wide = answer["pins"][2]["peak_bracket_N"][1] * 1.01
    for place in (("pins", 2, "peak_bracket_N", 1), ("peak_bracket_N", 1)):
        answer = replaced(answer, place, wide)
    assert is_broken(request, answer)
    answer["warnings"].append({"code": "peaks_not_certified", "message": "", "pointer": ""})
    assert not is_broken(request, answer)
    assert checker().verify(request, answer)["verdict"] == "not covered"


@pytest.mark.parametrize("name", ["clearance", "clearance, rigid", "clearance, elastic"])
def test_a_peak_with_clearance_is_enclosed(name: str) -> None:
    """Independent: the loads at many angles, by scipy's search for the least energy."""
    request = WITH_CLEARANCE[name]
    torque = part("pins").causes(part("numbers").Place(request, "request"))["rotation"]
    play = part("pin_play").Play(pins_of(request), torque)
    peaks = play.peaks()
    springs = [place[2] for place in PLACES] + [5e7] * (name == "clearance, elastic")
    play_of = [(pin["clearance_m"], pin["eccentricity_error_m"]) for pin in LOOSE] + [(0.0, 0.0)]
    compared = 0
    for angle in np.linspace(0.0, 350.0, 8):
        levers = [radius * sin(radians(angle - phase)) for phase, radius, _ in PLACES] + [0.0]

        def carried(motion: Any, levers: list[float] = levers) -> Any:
            strains = [lever * motion[0] + motion[1] - error for lever, (_, error) in zip(levers, play_of, strict=True)]
            over = [max(abs(d) - c, 0.0) * (1.0 if d > 0 else -1.0) for d, (c, _) in zip(strains, play_of, strict=True)]
            return np.array(springs) * over[: len(springs)]

        def missing(motion: Any, levers: list[float] = levers, angle: float = angle) -> Any:
            loads = carried(motion, levers)
            moment = float(np.dot(loads, levers[: loads.size])) - torque.at(angle)
            return [moment, motion[1] * 1e7 if "rigid" in name else 0.05 * float(np.sum(loads))]

        balance = optimize_root(missing, [1e-4, 0.0], method="hybr", tol=1e-14)
        loads = carried(balance.x)
        if np.max(np.abs(missing(balance.x))) > 1e-9:
            # scipy has not come to an end
            continue
        compared += 1
        np.testing.assert_allclose(play.loads(angle)[: loads.size], loads, atol=1e-6)
        assert all(abs(load) <= peak.high + 1e-6 for load, peak in zip(loads, peaks, strict=False))
    assert compared >= 6
    assert all(peak.low <= peak.high <= peak.low + 1e-9 * max(peak.low for peak in peaks) for peak in peaks)


def test_a_peak_below_what_an_error_strains_at_a_dead_point_is_broken() -> None:
    """All of what two pins carry at the points is their strain, 40 N; beside them no more than T' / 2 R."""
    request, answer = pair("an error at a dead point")
    assert answer["pins"][0]["load_N"][1] == pytest.approx(-40.0) or answer["pins"][0]["load_N"][1] == pytest.approx(40)
    assert is_broken(request, replaced(answer, ("pins", 0, "peak_N"), 0.9 * answer["pins"][0]["peak_N"]))
