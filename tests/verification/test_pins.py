"""Loads of scroll pins in the checker: genuine ones are held, figures that are falsified are broken."""

import json
from functools import cache
from math import cos, pi, radians, sin, sqrt
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import root as optimize_root

from optimizer.pins.answer import pin_loads
from schemas.scroll.pin_loads import PinLoadsRequest
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
from tests.verification.test_curves import part

_ANGLES = {"step_deg": 30.0}
_RING = {"key_radius_m": 0.06, "mass_kg": 0.35, "axis_deg": 20.0, "friction_coefficient": 0.08}
_LOSSES = {
    "speed_rpm": 3000.0,
    "pin_diameter_m": 0.008,
    "pin_friction_coefficient": 0.002,
    "oldham_ring": _RING,
}
_TABLE = {"angle_deg": [10, 120, 240], "torque_Nm": [12.0, 15.0, -3.0]}
_FORCE = {"angle_deg": [0, 90, 360], "force_N": [1000.0, 1500.0, 1000.0]}
_EVEN = {"pin_circle_radius_m": 0.05, "rotation_torque_Nm": 12.5, "angles": _ANGLES}
_PLACES = [(10.0, 0.05, 2e7), (130.0, 0.06, 1e7), (250.0, 0.045, 3e7), (300.0, 0.05, 2e7)]
_PINS = [{"angle_deg": angle, "radius_m": radius, "stiffness_N_per_m": k} for angle, radius, k in _PLACES]
_LOOSE = [{**pin, "clearance_m": 1e-5, "eccentricity_error_m": 4e-6 * n} for n, pin in enumerate(_PINS)]
_LINE = [{"angle_deg": angle, "radius_m": 0.05} for angle in (30.0, 210.0)]
_UNEVEN = {"pins": _PINS, "rotation_torque_Nm": _TABLE, "angles": _ANGLES}
_REQUESTS: dict[str, dict[str, Any]] = {
    **{f"{count} even": {**_EVEN, "pin_count": count} for count in (1, 2, 3, 5)},
    "rigid": {**_EVEN, "pin_count": 3, "drive_bearing": {"type": "rigid"}},
    "two, rigid": {**_EVEN, "pin_count": 2, "drive_bearing": {"type": "rigid"}},
    "table": {**_EVEN, "pin_count": 2, "rotation_torque_Nm": _TABLE},
    "uneven": _UNEVEN,
    "uneven, rigid": {**_UNEVEN, "rotation_torque_Nm": -4.0, "drive_bearing": {"type": "rigid"}},
    "uneven, elastic": {**_UNEVEN, "drive_bearing": {"type": "elastic", "stiffness_N_per_m": 5e7}},
    "on a line": {"pins": _LINE, "rotation_torque_Nm": 4.0, "angles": _ANGLES},
    "force, losses": {
        "pins": _PINS,
        "tangential_gas_force_N": _FORCE,
        "orbit_radius_m": 0.005,
        "comparison": _LOSSES,
        "angles": _ANGLES,
    },
}
_WITH_CLEARANCE: dict[str, dict[str, Any]] = {
    "clearance": {**_UNEVEN, "pins": _LOOSE, "rotation_torque_Nm": 12.0},
    "clearance, rigid": {**_UNEVEN, "pins": _LOOSE, "drive_bearing": {"type": "rigid"}},
    "clearance, elastic": {
        **_UNEVEN,
        "pins": _LOOSE,
        "drive_bearing": {"type": "elastic", "stiffness_N_per_m": 5e7},
    },
    "an error at a dead point": {
        "pins": [{**pin, "stiffness_N_per_m": 2e7, "eccentricity_error_m": 4e-6 * n} for n, pin in enumerate(_LINE)],
        "rotation_torque_Nm": {"angle_deg": [30, 120, 210, 300], "torque_Nm": [0.0, 2.0, 0.0, -2.0]},
        "angles": _ANGLES,
    },
}
#: pins on a line, whose loads jump at dead points
_JUMPS = "an error at a dead point"
#: what may be off by a millionth: where a curve is level, what rounding leaves, and what has kinks
_LEVEL = {
    "peak_angle_deg", "max_moment_error_Nm", "max_net_force_N", "sum_J", "load_error_bound_N", "gap_J", "pins_W",
    "loss_W",
}  # fmt: skip
_BETWEEN = {"peak_N", "peak_bracket_N", "peak_angle_deg"}


def _answer(request: Any) -> Any:
    return json.loads(pin_loads(PinLoadsRequest.model_validate(request)).model_dump_json())


@cache
def _text(name: str) -> str:
    return json.dumps(_answer((_REQUESTS | _WITH_CLEARANCE)[name]))


def _pair(name: str) -> tuple[Any, Any]:
    return json.loads(json.dumps((_REQUESTS | _WITH_CLEARANCE)[name])), json.loads(_text(name))


@pytest.mark.parametrize("name", _REQUESTS)
def test_every_number_of_genuine_loads_is_held(name: str) -> None:
    verdict = checker().verify(*_pair(name))
    assert (verdict["verdict"], verdict["checked"]) == ("held", verdict["leaves"])


@pytest.mark.parametrize("name", _WITH_CLEARANCE)
def test_with_clearance_all_is_held_but_peaks_where_loads_jump(name: str) -> None:
    verdict = checker().verify(*_pair(name))
    assert verdict["verdict"] == ("not covered" if name == _JUMPS else "held")
    assert all(where.removesuffix("/*").rpartition("/")[2] in _BETWEEN for where in verdict["not_covered"]), verdict[
        "not_covered"
    ]


@pytest.mark.parametrize("end", [0.999999, 1.00001])
def test_the_upper_end_of_a_bracket_with_clearance_is_held_from_both_sides(end: float) -> None:
    request, answer = _pair("clearance, rigid")
    place = ("drive_bearing", "peak_bracket_N", 1)
    assert is_broken(request, replaced(answer, place, end * at(answer, place)))


def test_a_wide_bracket_is_broken_where_the_answer_does_not_say_that_it_is() -> None:
    """Of all pins the largest end is stated again, so both are wide alike."""
    request, answer = _pair("clearance")
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
    request = _WITH_CLEARANCE[name]
    torque = part("pins").causes(part("numbers").Place(request, "request"))["rotation"]
    play = part("pin_play").Play(_pins(request), torque)
    peaks = play.peaks()
    springs = [place[2] for place in _PLACES] + [5e7] * (name == "clearance, elastic")
    play_of = [(pin["clearance_m"], pin["eccentricity_error_m"]) for pin in _LOOSE] + [(0.0, 0.0)]
    for angle in np.linspace(0.0, 350.0, 8):
        levers = [radius * sin(radians(angle - phase)) for phase, radius, _ in _PLACES] + [0.0]

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
            continue
        np.testing.assert_allclose(play.loads(angle)[: loads.size], loads, atol=1e-6)
        assert all(abs(load) <= peak.high + 1e-6 for load, peak in zip(loads, peaks, strict=False))
    assert all(peak.low <= peak.high <= peak.low + 1e-9 * max(peak.low for peak in peaks) for peak in peaks)


def test_a_peak_below_what_an_error_strains_at_a_dead_point_is_broken() -> None:
    """All of what two pins carry at the points is their strain, 40 N; beside them no more than T' / 2 R."""
    request, answer = _pair("an error at a dead point")
    assert answer["pins"][0]["load_N"][1] == pytest.approx(-40.0) or answer["pins"][0]["load_N"][1] == pytest.approx(40)
    assert is_broken(request, replaced(answer, ("pins", 0, "peak_N"), 0.9 * answer["pins"][0]["peak_N"]))


@pytest.mark.parametrize("step", [5, pytest.param(1, marks=pytest.mark.nightly)])
@pytest.mark.parametrize("name", [*_REQUESTS, *_WITH_CLEARANCE])
def test_figures_that_are_off_by_a_millionth_are_broken(name: str, step: int) -> None:
    request, answer = _pair(name)
    largest = max(abs(load or 0.0) for pin in answer["pins"] for load in pin["load_N"])
    count = 0
    for path in list(numbers(answer))[::step]:
        leaf, field = at(answer, path), next(part for part in reversed(path) if isinstance(part, str))
        if "timing" in path or field in _LEVEL or leaf == 0 or (name == _JUMPS and field in _BETWEEN):
            continue
        if field == "load_N" and abs(leaf) < 1e-6 * largest:
            # what rounding leaves
            continue
        count += 1
        # an upper end that is higher is true, and named
        off = -1e-6 if name in _WITH_CLEARANCE and field == "peak_bracket_N" else 1e-6
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
    request, answer = _pair(name)
    assert at(answer, path) != wrong
    assert is_broken(request, replaced(answer, path, wrong))


@pytest.mark.parametrize("name", [*bodies("pin-loads")])
def test_examples_are_not_broken(name: str) -> None:
    request = json.loads(json.dumps(bodies("pin-loads")[name]))
    assert not broken(request, _answer(request))


def test_the_output_of_a_scroll_is_held() -> None:
    body = json.loads(json.dumps(SINGLE["scroll-three-pins"] | {"outputs": ["pin_loads"], "angles": _ANGLES}))
    answer = answered(body)
    verdict = checker().verify(body, answer)
    assert (verdict["verdict"], verdict["checked"]) == ("held", verdict["leaves"])
    load = ("pin_loads", "pins", 1, "load_N", 2)
    assert is_broken(body, replaced(answer, load, at(answer, load) * (1 + 1e-6)))


def test_a_question_that_is_not_known_is_named() -> None:
    request, answer = _pair("3 even")
    verdict = checker().verify({**request, "lubricant": "oil"}, answer)
    assert (verdict["verdict"], verdict["claims"][0]["where"]) == ("not covered", "/request/lubricant")


def _pins(request: dict[str, Any]) -> Any:
    return part("pins").Pins(part("numbers").Place(request, "request"))


def test_even_pins_carry_what_liu_zhao_and_li_say() -> None:
    """Published: equation (3), 2 T sin(t - 2 pi (i - 1) / n) / (n R)."""
    pins = _pins({"pin_count": 5, "pin_circle_radius_m": 0.05})
    for k in range(5):
        for angle in (0.0, 33.0, 200.0):
            force = 2 * 7.0 * sin(radians(angle - 72.0 * k)) / (5 * 0.05)
            assert pins.load(k, 7.0, angle)[0] == pytest.approx(force, abs=1e-12)


@pytest.mark.parametrize(
    "bearing", [{"type": "free"}, {"type": "rigid"}, {"type": "elastic", "stiffness_N_per_m": 5e7}]
)
def test_loads_of_any_pattern_are_the_elastic_ones(bearing: dict[str, Any]) -> None:
    """Independent: the least energy by a linear system of numpy."""
    pins = _pins({"pins": _PINS, "drive_bearing": bearing})
    for angle in np.linspace(0.0, 350.0, 11):
        levers = np.array([pins.lever(k, angle) for k in range(4)] + [0.0] * (bearing["type"] == "elastic"))
        stiffness = np.array([place[2] for place in _PLACES] + [5e7] * (bearing["type"] == "elastic"))
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
    request = _REQUESTS[name]
    pins = _pins(request)
    torque = part("pins").causes(part("numbers").Place(request, "request"))["rotation"]
    for k in range(len(pins.shapes)):
        peak = part("pin_peaks").peak(pins, k, torque)
        values = [abs(pins.load(k, torque.at(angle), angle)[0]) for angle in np.linspace(0.0, 360.0, 2000)]
        assert peak.low <= peak.high <= peak.low * (1 + 1e-9) + 1e-12
        assert max(values) <= peak.high + 1e-12
        assert max(values) >= peak.low * (1 - 1e-3)


def test_a_table_is_linear_between_its_entries_and_around_the_revolution() -> None:
    """Independent: numpy; its integral by a fine sum."""
    torque = part("pins").Torque(part("numbers").Place(_TABLE), "torque_Nm")
    angles = np.linspace(0.0, 359.0, 360)
    actual = np.interp(angles, _TABLE["angle_deg"], _TABLE["torque_Nm"], period=360.0)
    np.testing.assert_allclose([torque.at(angle) for angle in angles], actual, atol=1e-12)
    fine = (np.arange(40_000) + 0.5) * 120.0 / 40_000
    whole = np.mean(np.interp(fine, _TABLE["angle_deg"], _TABLE["torque_Nm"], period=360.0)) * radians(120.0)
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
    st.sampled_from([12.0, -3.0, 0.0, _TABLE, {**_TABLE, "torque_Nm": [1.0, 2.0, 3.0]}]),
    st.sampled_from(["free", "rigid", "elastic"]),
    st.booleans(),
)
def test_loads_of_any_pins_are_held(pins: list[dict[str, float]], torque: Any, bearing: str, loose: bool) -> None:
    stiffness = {"stiffness_N_per_m": 5e7} if bearing == "elastic" else {}
    named = [{**pin, "clearance_m": 1e-5} for pin in pins] if loose else pins
    drive = {"type": bearing, **stiffness}
    request = {"pins": named, "rotation_torque_Nm": torque, "drive_bearing": drive, "angles": _ANGLES}
    try:
        answer = _answer(request)
    except ValueError:
        # two in one place
        return
    verdict = checker().verify(request, answer)
    assert not [claim for claim in verdict["claims"] if claim["verdict"] == "broken"]
    assert all(where.removesuffix("/*").rpartition("/")[2] in {*_BETWEEN, *_UNTOLD} for where in verdict["not_covered"])


#: of contacts that certify little, and of pins that are all but on a line
_UNTOLD = ("load_error_bound_N", "holds", "max_moment_error_Nm", "max_net_force_N")


@settings(max_examples=30, deadline=None)
@given(data=st.data())
def test_nothing_that_is_sent_raises(data: st.DataObject) -> None:
    """Any JSON in any place of a question or an answer is judged, or refused by name."""
    request, answer = _pair(data.draw(st.sampled_from(["uneven", "clearance", "force, losses", "on a line"])))
    for _ in range(data.draw(st.integers(0, 2))):
        request = replaced_anywhere(request, data.draw(st.sampled_from(paths(request))), data.draw(JSON))
    for _ in range(data.draw(st.integers(0, 2))):
        answer = replaced_anywhere(answer, data.draw(st.sampled_from(paths(answer))), data.draw(JSON))
    judged(request, answer)


def _grazing() -> dict[str, list[float]]:
    """A torque that a heavy ring's inertia exceeds for less than a degree, 45 degrees from its axis."""
    inertia = 2.0 * _RING["key_radius_m"] * 0.5 * 40.0 * 0.005 * (100.0 * pi) ** 2 * cos(pi / 4.0)
    return {
        "angle_deg": [60.0, 90.0],
        "torque_Nm": [inertia * (1.0 - 3e-5 + sign * radians(15.0)) for sign in (1.0, -1.0)],
    }


@pytest.mark.parametrize(
    "torque", [12.0, {"angle_deg": [0.0, 90.0, 200.0], "torque_Nm": [14.0, -6.0, 3.0]}, _grazing()]
)
def test_losses_of_a_heavy_ring_are_held(torque: Any) -> None:
    """Regression: its keys change sides beside the ends of the pieces of an integral, which did not see it."""
    ring = {**_RING, "mass_kg": 40.0, "axis_deg": 30.0}
    body = body_of("pins", ("comparison",))
    assert body is not None
    body |= {"rotation_torque_Nm": torque, "comparison": {**body["comparison"], "oldham_ring": ring}}
    answer = _answer(body)
    assert not broken(body, answer)
    loss = ("comparison", "oldham_ring", "loss_W")
    assert is_broken(body, replaced(answer, loss, at(answer, loss) * (1.0 + 1e-7)))


def test_a_load_beside_a_change_of_sign_is_held() -> None:
    """Regression: the torque is a difference of its entries there, whose digits are those of the entries."""
    torques = {"angle_deg": [105.80581690866347, 134.19339127536264], "torque_Nm": [-10.0, 10.0]}
    body = {"pin_count": 3, "pin_circle_radius_m": 0.06, "rotation_torque_Nm": torques, "angles": {"step_deg": 120.0}}
    answer = _answer(body)
    assert not broken(body, answer)
    load = ("pins", 0, "load_N", 1)
    assert is_broken(body, replaced(answer, load, at(answer, load) * (1.0 + 1e-9)))
