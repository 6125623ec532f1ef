"""What is drawn of a machine that is half-typed, and what is said of the rest."""

import json
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from optimizer.optimize import optimize
from schemas.request.layout import LayoutRequest
from schemas.request.requests import OptimizeRequest
from service.common.validation import check
from service.documents.examples import bodies
from service.drawings.layout import CrankMachine, layout_of
from service.drawings.typed import partial_layout
from service.drawings.views import views

EXAMPLES = {name: body["machine"] for name, body in bodies().items()}
THROW = {"position_m": "175 mm", "crank_radius_m": 0.14, "crank_angle_deg": 0}
NOTHING: dict[str, Any] = {"counterweights": [], "fitted": []}
MISSING = "this field is required"


def machine(*throws: Any, **more: Any) -> dict[str, Any]:
    return {**NOTHING, "machine": {"kind": "reciprocating", "throws": list(throws), **more}}


def reasons(typed: dict[str, Any]) -> dict[str, str]:
    return {"/".join(map(str, problem.path[1:])): problem.message for problem in partial_layout(typed)[1]}


@pytest.mark.parametrize("name", EXAMPLES)
def test_whole_machines_are_known_whole(name: str) -> None:
    layout, why = partial_layout({**NOTHING, "machine": EXAMPLES[name]})
    assert why == []
    assert layout == layout_of(OptimizeRequest.model_validate({"machine": EXAMPLES[name]}).machine, ())


@pytest.mark.parametrize("name", ["2d12", "single-vertical", "scroll-three-pins", "scroll-oldham"])
@pytest.mark.parametrize("plane", [None, 0.03])
def test_the_plane_of_moments_is_that_of_the_answer(name: str, plane: float | None) -> None:
    request = OptimizeRequest.model_validate({"machine": {**EXAMPLES[name], "reference_plane_m": plane}})
    # independent: the optimiser's own
    assert layout_of(request.machine, ()).reference_plane_m == optimize(request).reference_plane_m


def test_a_part_that_lacks_something_is_left_out_and_named() -> None:
    typed = machine(THROW, {"position_m": 0.3, "crank_radius_m": "wide"}, "x")
    layout, _ = partial_layout(typed)
    assert layout is not None
    assert isinstance(layout.machine, CrankMachine)
    # places keep their numbers
    assert [name for name, _ in layout.machine.cranks] == ["1"]
    assert reasons(typed) == {
        "throws/1/crank_radius_m": "must be a number in m, or a string such as '1.5 m'",
        "throws/1/crank_angle_deg": MISSING,
        "throws/2": "must be an object",
    }


def test_a_balance_shaft_that_is_half_typed_is_left_out_and_named() -> None:
    web = {"name": "w", "position_m": 0.1, "counterweight_radius_m": 0.05}
    whole = {"name": "a", "speed_ratio": -1, "x_m": "-120 mm", "webs": [web, {"name": "v"}]}
    typed = machine(THROW, balance_shafts=[whole, {"name": "b"}, {"name": "c", "speed_ratio": 3}])
    layout, _ = partial_layout(typed)
    assert layout is not None
    ((shaft, best, built),) = layout.balance
    assert (shaft.axis, [place.name for place in shaft.places], best, built) == ((0.12, 180.0), ["w"], (), ())
    assert reasons(typed) == {
        "balance_shafts/0/webs/1/position_m": MISSING,
        "balance_shafts/1/speed_ratio": MISSING,
        "balance_shafts/2/speed_ratio": "must be -2, -1, 1 or 2",
    }


def test_what_may_be_missing_goes_alone() -> None:
    web = {"name": "a", "position_m": 0, "counterweight_radius_m": "?", "sector": {"centre_deg": 90}}
    typed = machine({**THROW, "rows": [{"axis_deg": "up"}, {"axis_deg": 90}]}, webs=[web], rotation="left")
    layout, _ = partial_layout(typed)
    assert layout is not None
    assert isinstance(layout.machine, CrankMachine)
    assert [row and row.axis_deg for row in layout.machine.cranks[0][1].rows] == [None, 90]
    assert (layout.machine.places[0].sector, layout.machine.places[0].reach_m) == (None, None)
    assert set(reasons(typed)) == {
        "throws/0/rows/0/axis_deg",
        "webs/0/counterweight_radius_m",
        "webs/0/sector/half_angle_deg",
        "rotation",
    }


@pytest.mark.parametrize(
    ("typed", "why"),
    [
        ({}, {"kind": MISSING}),
        ({"kind": "rotary"}, {"kind": "must be one of 'reciprocating', 'scroll'"}),
        ({"kind": "reciprocating"}, {"throws": MISSING}),
        ({"kind": "reciprocating", "throws": {}}, {"throws": "must be a list"}),
        ({"kind": "scroll"}, {"orbit_radius_m": MISSING, "orbiting_position_m": MISSING}),
    ],
)
def test_nothing_is_drawn_where_nothing_is_known(typed: Any, why: dict[str, str]) -> None:
    answer = views(LayoutRequest(machine=typed))
    assert (answer.front, answer.side) == (None, None)
    assert {error.pointer.removeprefix("/machine/"): error.message for error in answer.missing} == why


def test_weights_are_seen_where_they_have_mass_radius_and_web() -> None:
    webs = [{"name": name, "position_m": 0, "counterweight_radius_m": 0.2} for name in "abc"]
    weights = [{"web": name, "mass_kg": mass, "angle_deg": 0} for name, mass in (("a", 60), ("b", 1e-5), ("c", 0))]
    elsewhere = {"web": "of a balance shaft", "mass_kg": 3, "angle_deg": 0, "radius_m": 0.1}
    fitted = [{"web": "b", "mass_kg": "2 kg", "angle_deg": 5, "radius_m": "300 mm"}]
    layout, why = partial_layout(
        machine(THROW, webs=webs) | {"counterweights": [*weights, elsewhere], "fitted": fitted}
    )
    assert layout is not None
    assert why == []
    assert [(fitting.web.name, fitting.radius_m) for fitting in layout.best] == [("a", 0.2)]
    assert [(fitting.web.name, fitting.mass_kg, fitting.radius_m) for fitting in layout.built] == [("b", 2.0, 0.3)]


def test_a_machine_is_no_larger_than_the_service_takes() -> None:
    rows = [{"axis_deg": 0}] * 51
    assert "rows together" in reasons(machine(*[{**THROW, "rows": rows}] * 10))["throws"]
    assert "500" in reasons(machine(*[THROW] * 501))["throws"]


@pytest.mark.parametrize("place", ["machine", "counterweights", "fitted"])
def test_what_is_nested_as_deeply_as_can_be_read_is_answered(place: str) -> None:
    deep: Any = {"kind": "reciprocating"}
    for _ in range(900):
        deep = {"throws": [deep], "kind": "reciprocating"}
    body: Any = {"machine": EXAMPLES["2d12"]} | {place: deep if place == "machine" else [deep]}
    answer = views(check(LayoutRequest, body))
    assert (answer.front is None) == (place == "machine")


_JSON = st.recursive(
    st.none() | st.booleans() | st.floats() | st.integers() | st.sampled_from(["", "1 mm", "x", "oldham", "scroll"]),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.sampled_from(["type", "rows", "axis_deg"]), inner),
    max_leaves=6,
)
_FIELDS = st.sampled_from(
    ["throws", "webs", "bearings", "rotation", "anti_rotation", "orbit_radius_m", "reference_plane_m", "kind"]
)


@given(st.sampled_from(["2d12", "scroll-three-pins", "plate-single"]), _FIELDS, st.integers(0, 1), _JSON)
def test_whatever_is_typed_is_answered(name: str, field: str, place: int, value: Any) -> None:
    """Whatever stands in a field or in one of a list, the rest is drawn or said to be missing."""
    typed = json.loads(json.dumps(EXAMPLES[name]))
    if isinstance(typed.get(field), list) and place < len(typed[field]):
        item = typed[field][place]
        item[sorted(item)[place]] = value
    else:
        typed[field] = value
    answer = views(LayoutRequest(machine=typed))
    assert (answer.front is None) == (answer.side is None)
    assert answer.front is not None or answer.missing
    for view in (answer.front, answer.side):
        assert view is None or not {"nan", "inf"} & set(view.replace('"', " ").split())
