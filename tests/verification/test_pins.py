"""Loads of scroll pins in the checker: genuine ones are held, figures that are falsified are broken."""

import json
from math import cos, pi, radians, sin, sqrt
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from service.documents.examples import bodies
from service.verification import checker
from tests.night import by_day
from tests.pairs.asking import body_of
from tests.verification.answers import answered
from tests.verification.anything import JSON, judged, paths
from tests.verification.anything import replaced as replaced_anywhere
from tests.verification.checking import broken, is_broken
from tests.verification.falsified import at, numbers, replaced
from tests.verification.kinds import SINGLE
from tests.verification.pin_requests import (
    ANGLES,
    BETWEEN,
    JUMPS,
    PINS,
    PLACES,
    REQUESTS,
    RING,
    TABLE,
    WITH_CLEARANCE,
    answer_to,
    pair,
    pins_of,
)
from tests.verification.test_curves import part

#: what may be off by a millionth: where a curve is level, what rounding leaves, and what has kinks
_LEVEL = {
    "peak_angle_deg", "max_moment_error_Nm", "max_net_force_N", "sum_J", "load_error_bound_N", "gap_J", "pins_W",
    "loss_W",
}  # fmt: skip


@pytest.mark.parametrize("name", REQUESTS)
def test_every_number_of_genuine_loads_is_held(name: str) -> None:
    verdict = checker().verify(*pair(name))
    assert (verdict["verdict"], verdict["checked"]) == ("held", verdict["leaves"])


@pytest.mark.parametrize("step", [5, pytest.param(1, marks=pytest.mark.nightly)])
@pytest.mark.parametrize("name", [*REQUESTS, *WITH_CLEARANCE])
def test_figures_that_are_off_by_a_millionth_are_broken(name: str, step: int) -> None:
    request, answer = pair(name)
    largest = max(abs(load or 0.0) for pin in answer["pins"] for load in pin["load_N"])
    count = 0
    for path in list(numbers(answer))[::step]:
        leaf, field = at(answer, path), next(part for part in reversed(path) if isinstance(part, str))
        if "timing" in path or field in _LEVEL or leaf == 0 or (name == JUMPS and field in BETWEEN):
            continue
        if field == "load_N" and abs(leaf) < 1e-6 * largest:
            # what rounding leaves
            continue
        count += 1
        # an upper end that is higher is true, and named
        off = -1e-6 if name in WITH_CLEARANCE and field == "peak_bracket_N" else 1e-6
        try:
            assert is_broken(request, replaced(answer, path, leaf * (1 + off))), path
        except checker().Unreadable:
            continue
    assert count > 10 // step


@pytest.mark.parametrize(
    ("name", "path", "wrong"),
    [
        ("3 even", ("pins", 0, "peak_angle_deg"), 80.0),
        ("3 even", ("equilibrium", "holds"), False),
        ("3 even", ("equilibrium", "max_moment_error_Nm"), 1e-3),
        ("3 even", ("equilibrium", "max_net_force_N"), 1e-3),
        ("3 even", ("peak_N",), None),
        ("3 even", ("peak_bracket_N",), None),
        ("3 even", ("pins", 0, "peak_bracket_N"), None),
        ("3 even", ("dead_points_deg",), [0.0, 180.0]),
        ("3 even", ("mechanism", "degrees_of_freedom"), 0),
        ("3 even", ("drive_bearing",), {"load_N": [], "peak_N": 0.0, "peak_angle_deg": 0.0}),
        ("3 even", ("pins", 1, "carries_load"), [True]),
        ("3 even", ("energy", "sum_J"), 1e-3),
        ("2 even", ("equilibrium", "holds"), True),
        ("1 even", ("equilibrium", "max_net_force_N"), 0.0),
        ("table", ("pins", 0, "compression_from_deg"), 0.0),
        ("uneven", ("pins", 0, "compression_from_deg"), 0.0),
        ("on a line", ("dead_points_deg",), []),
        ("on a line", ("dead_points_deg", 1), 211.0),
        ("on a line", ("pins", 0, "peak_N"), 100.0),
        ("on a line", ("pins", 0, "load_N", 1), 100.0),
        ("on a line", ("equilibrium", "holds"), True),
        ("on a line", ("equilibrium", "max_moment_error_Nm"), 0.0),
        ("force, losses", ("comparison",), None),
        ("force, losses", ("comparison", "oldham_ring", "loss_W"), 1.0),
        ("force, losses", ("comparison", "pins_W"), 1.0),
        ("force, losses", ("comparison", "ratio"), None),
        ("force, losses", ("orbiting_resistance_torque_Nm",), None),
        ("clearance", ("contact",), None),
        ("clearance", ("contact", "fewest_pins"), 1),
        ("clearance", ("contact", "gap_J"), 1.0),
        ("clearance", ("pins", 0, "peak_N"), 1.0),
        ("clearance", ("pins", 0, "peak_angle_deg"), 400.0),
        ("clearance", ("pins", 0, "peak_bracket_N", 0), 1.0),
        ("clearance", ("pins", 0, "peak_bracket_N", 1), 1.0),
        ("clearance", ("peak_bracket_N", 1), 1e6),
        ("clearance", ("pins", 0, "peak_bracket_N"), None),
        ("an error at a dead point", ("pins", 0, "peak_bracket_N"), [1.0, 1.0]),
        ("clearance", ("pins", 0, "carries_load"), []),
    ],
)
def test_what_an_answer_says_is_true(name: str, path: tuple[str | int, ...], wrong: Any) -> None:
    request, answer = pair(name)
    assert at(answer, path) != wrong
    assert is_broken(request, replaced(answer, path, wrong))


@pytest.mark.parametrize("name", [*bodies("pin-loads")])
def test_examples_are_not_broken(name: str) -> None:
    request = json.loads(json.dumps(bodies("pin-loads")[name]))
    assert not broken(request, answer_to(request))


def test_the_output_of_a_scroll_is_held() -> None:
    body = json.loads(json.dumps(SINGLE["scroll-three-pins"] | {"outputs": ["pin_loads"], "angles": ANGLES}))
    answer = answered(body)
    verdict = checker().verify(body, answer)
    assert (verdict["verdict"], verdict["checked"]) == ("held", verdict["leaves"])
    load = ("pin_loads", "pins", 1, "load_N", 2)
    assert is_broken(body, replaced(answer, load, at(answer, load) * (1 + 1e-6)))


def test_a_question_that_is_not_known_is_named() -> None:
    request, answer = pair("3 even")
    verdict = checker().verify({**request, "lubricant": "oil"}, answer)
    assert (verdict["verdict"], verdict["claims"][0]["where"]) == ("not covered", "/request/lubricant")


def test_even_pins_carry_what_liu_zhao_and_li_say() -> None:
    """Published: equation (3), 2 T sin(t - 2 pi (i - 1) / n) / (n R)."""
    pins = pins_of({"pin_count": 5, "pin_circle_radius_m": 0.05})
    for k in range(5):
        for angle in (0.0, 33.0, 200.0):
            force = 2 * 7.0 * sin(radians(angle - 72.0 * k)) / (5 * 0.05)
            assert pins.load(k, 7.0, angle)[0] == pytest.approx(force, abs=1e-12)


@pytest.mark.parametrize(
    "bearing", [{"type": "free"}, {"type": "rigid"}, {"type": "elastic", "stiffness_N_per_m": 5e7}]
)
def test_loads_of_any_pattern_are_the_elastic_ones(bearing: dict[str, Any]) -> None:
    """Independent: the least energy by a linear system of numpy."""
    pins = pins_of({"pins": PINS, "drive_bearing": bearing})
    for angle in np.linspace(0.0, 350.0, 11):
        levers = np.array([pins.lever(k, angle) for k in range(4)] + [0.0] * (bearing["type"] == "elastic"))
        stiffness = np.array([place[2] for place in PLACES] + [5e7] * (bearing["type"] == "elastic"))
        rows = [levers] if bearing["type"] == "rigid" else [levers, np.ones(levers.size)]
        pushed = np.array(rows)
        targets = np.array([12.0, 0.0][: len(rows)])
        loads = stiffness * (np.linalg.solve(pushed * stiffness @ pushed.T, targets) @ pushed)
        values = [pins.load(k, 12.0, angle)[0] for k in range(levers.size)]
        np.testing.assert_allclose(values, loads, rtol=1e-9, atol=1e-9 * np.max(np.abs(loads)))
        if bearing["type"] == "rigid":
            assert pins.load(4, 12.0, angle)[0] == pytest.approx(-np.sum(loads), abs=1e-9)


@pytest.mark.parametrize("name", ["uneven", "uneven, rigid", "uneven, elastic", "2 even", "table"])
def test_a_peak_is_enclosed(name: str) -> None:
    """Independent: the loads at many angles."""
    request = REQUESTS[name]
    pins = pins_of(request)
    torque = part("pins").causes(part("numbers").Place(request, "request"))["rotation"]
    for k in range(len(pins.shapes)):
        peak = part("pin_peaks").peak(pins, k, torque)
        values = [abs(pins.load(k, torque.at(angle), angle)[0]) for angle in np.linspace(0.0, 360.0, 2000)]
        assert peak.low <= peak.high <= peak.low * (1 + 1e-9) + 1e-12
        assert max(values) <= peak.high + 1e-12
        assert max(values) >= peak.low * (1 - 1e-3)


def test_a_table_is_linear_between_its_entries_and_around_the_revolution() -> None:
    """Independent: numpy; its integral by a fine sum."""
    torque = part("pins").Torque(part("numbers").Place(TABLE), "torque_Nm")
    angles = np.linspace(0.0, 359.0, 360)
    actual = np.interp(angles, TABLE["angle_deg"], TABLE["torque_Nm"], period=360.0)
    np.testing.assert_allclose([torque.at(angle) for angle in angles], actual, atol=1e-12)
    fine = (np.arange(40_000) + 0.5) * 120.0 / 40_000
    whole = np.mean(np.interp(fine, TABLE["angle_deg"], TABLE["torque_Nm"], period=360.0)) * radians(120.0)
    assert torque.work(0.0, 120.0) == pytest.approx(whole, rel=1e-7)
    assert (torque.most, torque.sign, torque.times(-2.0).at(120.0)) == (15.0, 0, -30.0)


def test_semi_axes_of_a_pattern() -> None:
    """Analytic: a rectangle that lies askew has its own sides, and points on a line no width."""
    turn = complex(cos(0.3), sin(0.3))
    corners = [turn * complex(x, y) for x in (-3.0, 3.0) for y in (-1.0, 1.0)]
    major, minor, axis = part("pins").ellipse(corners, [1.0] * 4)
    assert (major, minor, axis) == (pytest.approx(6.0), pytest.approx(2.0), pytest.approx(0.3))
    major, minor, axis = part("pins").ellipse([turn * 2.0, turn * -1.0], [1.0, 4.0])
    assert (major, minor) == (pytest.approx(sqrt(8.0)), pytest.approx(0.0, abs=1e-12))
    assert axis % pi == pytest.approx(0.3)


_PIN = st.fixed_dictionaries(
    {
        "angle_deg": st.sampled_from([0.0, 90.0, 120.0, 240.0])
        | st.integers(0, 35_999).map(lambda number: number / 100.0),
        "radius_m": st.sampled_from([0.05]) | st.floats(0.01, 0.1),
        "stiffness_N_per_m": st.sampled_from([1e7]) | st.floats(1e5, 1e8),
    }
)


@by_day(20, 40)
@given(
    st.lists(_PIN, min_size=1, max_size=5, unique_by=lambda pin: (pin["angle_deg"], pin["radius_m"])),
    st.sampled_from([12.0, -3.0, 0.0, TABLE, {**TABLE, "torque_Nm": [1.0, 2.0, 3.0]}]),
    st.sampled_from(["free", "rigid", "elastic"]),
    st.booleans(),
)
def test_loads_of_any_pins_are_held(pins: list[dict[str, float]], torque: Any, bearing: str, loose: bool) -> None:
    stiffness = {"stiffness_N_per_m": 5e7} if bearing == "elastic" else {}
    named = [{**pin, "clearance_m": 1e-5} for pin in pins] if loose else pins
    drive = {"type": bearing, **stiffness}
    request = {"pins": named, "rotation_torque_Nm": torque, "drive_bearing": drive, "angles": ANGLES}
    try:
        answer = answer_to(request)
    except ValueError:
        # two in one place
        return
    verdict = checker().verify(request, answer)
    assert not [claim for claim in verdict["claims"] if claim["verdict"] == "broken"]
    assert all(where.removesuffix("/*").rpartition("/")[2] in {*BETWEEN, *_UNTOLD} for where in verdict["not_covered"])


#: of contacts that certify little, and of pins that are all but on a line
_UNTOLD = ("load_error_bound_N", "holds", "max_moment_error_Nm", "max_net_force_N")


@settings(max_examples=30, deadline=None)
@given(data=st.data())
def test_nothing_that_is_sent_raises(data: st.DataObject) -> None:
    """Any JSON in any place of a question or an answer is judged, or refused by name."""
    request, answer = pair(data.draw(st.sampled_from(["uneven", "clearance", "force, losses", "on a line"])))
    for _ in range(data.draw(st.integers(0, 2))):
        request = replaced_anywhere(request, data.draw(st.sampled_from(paths(request))), data.draw(JSON))
    for _ in range(data.draw(st.integers(0, 2))):
        answer = replaced_anywhere(answer, data.draw(st.sampled_from(paths(answer))), data.draw(JSON))
    judged(request, answer)


def _grazing() -> dict[str, list[float]]:
    """A torque that a heavy ring's inertia exceeds for less than a degree, 45 degrees from its axis."""
    inertia = 2.0 * RING["key_radius_m"] * 0.5 * 40.0 * 0.005 * (100.0 * pi) ** 2 * cos(pi / 4.0)
    return {
        "angle_deg": [60.0, 90.0],
        "torque_Nm": [inertia * (1.0 - 3e-5 + sign * radians(15.0)) for sign in (1.0, -1.0)],
    }


@pytest.mark.parametrize(
    "torque", [12.0, {"angle_deg": [0.0, 90.0, 200.0], "torque_Nm": [14.0, -6.0, 3.0]}, _grazing()]
)
def test_losses_of_a_heavy_ring_are_held(torque: Any) -> None:
    """Regression: its keys change sides beside the ends of the pieces of an integral, which did not see it."""
    ring = {**RING, "mass_kg": 40.0, "axis_deg": 30.0}
    body = body_of("pins", ("comparison",))
    assert body is not None
    body |= {"rotation_torque_Nm": torque, "comparison": {**body["comparison"], "oldham_ring": ring}}
    answer = answer_to(body)
    assert not broken(body, answer)
    loss = ("comparison", "oldham_ring", "loss_W")
    assert is_broken(body, replaced(answer, loss, at(answer, loss) * (1.0 + 1e-7)))


def test_a_load_beside_a_change_of_sign_is_held() -> None:
    """Regression: the torque is a difference of its entries there, whose digits are those of the entries."""
    torques = {"angle_deg": [105.80581690866347, 134.19339127536264], "torque_Nm": [-10.0, 10.0]}
    body = {"pin_count": 3, "pin_circle_radius_m": 0.06, "rotation_torque_Nm": torques, "angles": {"step_deg": 120.0}}
    answer = answer_to(body)
    assert not broken(body, answer)
    load = ("pins", 0, "load_N", 1)
    assert is_broken(body, replaced(answer, load, at(answer, load) * (1.0 + 1e-9)))
