"""Weights in the checker: guides, bearings and foundation, with a direction of gravity and without."""

import json
from functools import cache
from math import cos, radians
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from service.verification import checker
from tests import night
from tests.pairs.asking import body_of
from tests.verification.answers import answered
from tests.verification.checking import broken, is_broken
from tests.verification.falsified import at, numbers, replaced
from tests.verification.test_curves import part

#: what the checker learns of weights, by parts of the paths
_OF_GRAVITY = {"guide", "bearing_weights", "foundation_weight_N"}
#: machine, feature, and where gravity pulls
_KINDS: dict[str, tuple[str, tuple[str, ...], float | None]] = {
    "below": ("twin", (), 270.0),
    "clockwise, askew": ("twin", ("clockwise",), 123.0),
    "gas": ("vee", ("gas",), 270.0),
    "friction": ("vee", ("friction",), 45.0),
    "balance shaft": ("vee", ("balance shaft backwards",), 123.0),
    "continuous": ("twin", ("three bearings", "continuous shaft"), 270.0),
    "no direction": ("twin", (), None),
    "plates": ("twin", ("plates, segments", "budget"), 123.0),
}


def _body(base: str, features: tuple[str, ...], gravity: float | None, **more: Any) -> Any:
    body = body_of(base, features, 2.0)
    assert body is not None
    wheel = {"name": "wheel", "position_m": 0.3, "mass_kg": 40.0}
    body["machine"] |= {"stationary_mass_kg": 300.0, "shaft_parts": [wheel], "gravity_deg": gravity, **more}
    return json.loads(json.dumps({**body, "outputs": ["loads"], "angles": {"step_deg": 30.0}}))


@cache
def _text(name: str) -> str:
    return json.dumps(answered(_body(*_KINDS[name])))


def _pair(name: str) -> tuple[Any, Any]:
    return _body(*_KINDS[name]), json.loads(_text(name))


@pytest.mark.parametrize("name", night.part(2, _KINDS))
def test_loads_are_held_entirely(name: str) -> None:
    request, answer = _pair(name)
    verdict = checker().verify(request, answer)
    assert not broken(request, answer)
    assert not [where for where in verdict["not_covered"] if "loads" in where]


@pytest.mark.parametrize("name", night.part(4, _KINDS))
def test_weights_that_are_off_by_a_millionth_are_broken(name: str) -> None:
    request, answer = _pair(name)
    places = [("loads", *path) for path in numbers(answer["loads"]) if _OF_GRAVITY & {*path}]
    assert len(places) > 2
    for path in places:
        leaf = at(answer, path)
        # an upright row has no weight on its guide, and one pull has no part across itself
        if leaf:
            assert is_broken(request, replaced(answer, path, leaf * (1 + 1e-6))), path


@pytest.mark.parametrize(
    ("name", "path", "wrong"),
    [
        ("below", ("rows", 0, "guide"), None),
        ("below", ("bearing_weights", 0, "x_N"), None),
        ("below", ("foundation_weight_N",), None),
        ("below", ("gravity_deg",), 90.0),
        ("clockwise, askew", ("rows", 0, "guide", "lifted_share"), 1.0),
        ("no direction", ("bearing_weights", 0, "x_N"), 0.0),
        ("no direction", ("rows", 0, "guide"), {"weight_N": 0.0}),
    ],
)
def test_weights_are_said_where_they_are(name: str, path: tuple[str | int, ...], wrong: Any) -> None:
    request, answer = _pair(name)
    assert at(answer, ("loads", *path)) != wrong
    assert is_broken(request, replaced(answer, ("loads", *path), wrong))


def test_whether_a_crosshead_lifts_follows_from_its_share() -> None:
    request, answer = _pair("clockwise, askew")
    path = ("loads", "rows", 0, "guide", "lifts")
    assert is_broken(request, replaced(answer, path, not at(answer, path)))


def test_what_is_upright_presses_the_bearings_alone() -> None:
    """Analytic: gravity along the axis of a row leaves nothing on its guide; at an angle its share."""
    for degrees in (0.0, 60.0, 180.0):
        axis, down = (part("gravity")._way(part("numbers").Place(angle)) for angle in (30.0, 30.0 + degrees))
        assert (axis.conjugate() * down).real == pytest.approx(cos(radians(degrees)), abs=1e-15)


@night.by_day(5, 10)
@given(
    st.sampled_from([0.0, 45.0, 90.0, 180.0, 270.0]) | st.integers(0, 3599).map(lambda number: number / 10.0),
    st.sampled_from(["ccw", "cw"]),
    st.sampled_from(["twin", "vee"]),
)
def test_weights_of_any_direction_are_held(gravity: float, rotation: str, base: str) -> None:
    request = _body(base, (), gravity, rotation=rotation)
    answer = answered(request)
    verdict = checker().verify(request, answer)
    assert not broken(request, answer)
    assert not [where for where in verdict["not_covered"] if "loads" in where]
