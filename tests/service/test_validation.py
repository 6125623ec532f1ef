"""From bytes to a checked request: what is unreadable, what is invalid, and where."""

import copy
import json
import math
import time
from collections.abc import Callable, Iterator
from typing import Any, get_args

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from schemas.answer.outputs import OutputName
from schemas.request.requests import AnalyzeRequest, OptimizeRequest
from schemas.request.verify import VerifyRequest
from service.common.validation import (
    MAX_ERRORS,
    InvalidRequest,
    UnreadableJson,
    check,
    locate,
    pointer,
    read_json,
    read_request,
)
from service.documents.examples import bodies


def complaints(body: object, model: Any = OptimizeRequest) -> dict[str, str]:
    with pytest.raises(InvalidRequest) as caught:
        check(model, body)
    return {pointer(path): message for path, message in caught.value.problems}


def scroll(**changes: Any) -> dict[str, Any]:
    pins = {"type": "crank_pins", "count": 3, "pin_circle_radius_m": 0.05, "position_m": 0.03}
    machine = {
        "kind": "scroll",
        "speed_rpm": 3000,
        "orbit_radius_m": 0.005,
        "orbiting_mass_kg": 1,
        "orbiting_position_m": 0,
        "anti_rotation": {**pins, **changes},
    }
    return {"machine": machine}


@pytest.mark.parametrize(
    ("data", "reason"),
    [
        (b"", "no JSON"),
        (b" \r\n\t", "no JSON"),
        (b"\xef\xbb\xbf", "no JSON"),
        (b"{", "line 1, column 2"),
        (b'{"a": 1,}', "line 1, column 9"),
        (b'{\n"a" 1}', "line 2, column 5"),
        (b"{} {}", "Extra data"),
        (b"machine: 1", "line 1"),
        (b"\xff\xfe{\x00}\x00", "not UTF-8 at byte 0"),
        (b'{"a": "\xed\xa0\x80"}', "not UTF-8 at byte 7"),
        (b"{\x00}", "line 1"),
        (b"[" * 400_000, "nested too deeply"),
        (b'{"a":' * 200_000, "nested too deeply"),
    ],
)
def test_unreadable(data: bytes, reason: str) -> None:
    with pytest.raises(UnreadableJson, match=reason):
        read_json(data)
    with pytest.raises(UnreadableJson, match=reason):
        read_request(OptimizeRequest, data)


#: what stands in place of a value: right for some fields, wrong for most
_VALUES = (0, 1, -1, 1.0, -0.0, 5e-324, 10**15, 2**63, 10**400, math.inf, math.nan, "1", " 1", "1e3", "20 lb", "true",
           True, False, None, "ccw", "first", "é", [], [1], {}, {"x": 1})  # fmt: skip


def _places(body: Any) -> Iterator[tuple[Any, Any]]:
    """Every object and list of a body with each of its keys."""
    keys = list(body) if isinstance(body, dict) else range(len(body)) if isinstance(body, list) else ()
    for key in keys:
        yield body, key
        yield from _places(body[key])


def _outcome(read: Callable[[], OptimizeRequest]) -> object:
    """What a body is read as: a request with the fields that it states, or what is said of it."""
    try:
        request = read()
    except UnreadableJson as error:
        return str(error)
    except InvalidRequest as error:
        return error.problems, error.more
    return request.model_dump_json(), request.model_dump_json(exclude_unset=True)


@given(data=st.data())
def test_one_pass_reads_what_two_do(data: st.DataObject) -> None:
    """Independent: the value of the JSON first, and a request of it then."""
    body = copy.deepcopy(data.draw(st.sampled_from(list(bodies().values()))))
    for _ in range(data.draw(st.integers(0, 2))):
        where, key = data.draw(st.sampled_from(list(_places(body))))
        where[key] = copy.deepcopy(data.draw(st.sampled_from(_VALUES)))
    text = json.dumps(body)
    # a name that stands twice counts where it stands last
    text = text.replace('{"', '{"speed_rpm": 1, "', data.draw(st.integers(0, 2))).encode()
    outcome = _outcome(lambda: read_request(OptimizeRequest, text))
    assert outcome == _outcome(lambda: check(OptimizeRequest, read_json(text), len(text)))


@pytest.mark.parametrize("number", ["1" * 400, "1" * 401, "-" + "1" * 4000, "1" * 90_000, "0." + "1" * 500, "1e400"])
def test_a_long_number_is_read_alike(number: str) -> None:
    """Independent, as above; what is to be verified may hold any number."""
    data = f'{{"request": {{"x": {number}}}, "answer": {{}}}}'.encode()
    body = read_request(VerifyRequest, data)
    assert repr(body) == repr(check(VerifyRequest, read_json(data), len(data)))


def test_readable() -> None:
    assert read_json(b"\xef\xbb\xbf{}") == {}
    assert read_json(b'{"a": 1, "a": 2}') == {"a": 2}
    assert read_json('["\\ud800", "°", 1e999, -0]'.encode()) == ["\ud800", "°", float("inf"), 0]
    assert read_json(b"1" * 5000) == float("inf")
    assert read_json(b"-" + b"1" * 5000) == float("-inf")
    assert read_json(b"1" * 400) == int("1" * 400)
    assert read_json(b'{"a": "' + b"7" * 500 + b'", "b": 12}') == {"a": "7" * 500, "b": 12}


@given(
    st.text('[]{},:"\\ \n+-.0123456789eEux')
    | st.text()
    | st.from_regex(r"-?[0-9]{1,30}(\.[0-9]{1,30})?([eE]-?[0-9]{1,3})?", fullmatch=True)
)
@example("[NaN, -Infinity]").via("no JSON, and yet read")
@example("-0").via("a whole number")
@example("[" * 300 + "]" * 300).via("deeper than the fast reader goes")
@example('"\\ud83d"').via("half of a character")
def test_bytes_are_read_as_the_library_of_python_reads_them(text: str) -> None:
    # independent: json.loads; by their spelling, because NaN is not equal to itself
    try:
        expected = repr(json.loads(text.removeprefix("\ufeff")))
    except ValueError:
        with pytest.raises(UnreadableJson):
            read_json(text.encode())
    else:
        assert repr(read_json(text.encode())) == expected


@pytest.mark.parametrize("text", ["NaN", "Infinity", "-Infinity", "1e999", "-1e999", "1" * 5000, "1" * 400])
def test_numbers_that_are_none_name_their_field(body: dict[str, Any], text: str) -> None:
    body["machine"]["speed_rpm"] = "?"
    variant = json.dumps(body).replace('"?"', text).encode()
    assert list(complaints(read_json(variant))) == ["/machine/speed_rpm"]


@pytest.mark.parametrize("text", ["NaN", "Infinity", "1e999", "1" * 5000])
def test_whole_numbers_that_are_none_name_their_field(text: str) -> None:
    variant = json.dumps(scroll(count="?")).replace('"?"', text).encode()
    assert list(complaints(read_json(variant))) == ["/machine/anti_rotation/count"]


@pytest.mark.parametrize("root", [None, True, 1, "text", [], [{}], float("nan")])
def test_a_root_that_is_no_object(root: object) -> None:
    assert complaints(root) == {"": "must be an object"}


def set_at(body: dict[str, Any], path: str, value: object) -> None:
    node: Any = body
    *parents, last = [int(key) if key.isdecimal() else key for key in path.split("/")[1:]]
    for key in parents:
        node = node[key]
    node[last] = value


ROW = "/machine/throws/0/rows/0"
*_FIRST, _LAST = map(repr, get_args(OutputName))
NAMES = f"{', '.join(_FIRST)} or {_LAST}"


@pytest.mark.parametrize(
    ("path", "value", "message"),
    [
        ("/machine", 5, "must be an object"),
        ("/machine", [], "must be an object"),
        ("/machine", None, "must be an object"),
        ("/machine/kind", "turbine", "must be one of 'reciprocating', 'scroll'"),
        ("/machine/kind", ["reciprocating"], "must be one of 'reciprocating', 'scroll'"),
        ("/machine/kind", "\ud800", "must be one of 'reciprocating', 'scroll'"),
        ("/machine/throws", {}, "must be a list"),
        ("/machine/throws", "abc", "must be a list"),
        ("/machine/throws", [], "must hold at least one item"),
        ("/machine/throws/1", 7, "must be an object"),
        ("/machine/throws/0/crank_radius_m", 0, "must be at least 1e-12"),
        ("/machine/throws/0/crank_radius_m", -0.1, "must be at least 1e-12"),
        ("/machine/throws/0/crank_radius_m", "140 kg", "unit must be one of m, cm, mm, in, ft"),
        ("/machine/throws/0/crank_radius_m", True, "must be a number in m, not true or false"),
        ("/machine/throws/0/crank_radius_m", None, "must be a number"),
        ("/machine/throws/0/crank_radius_m", [], "must be a number"),
        ("/machine/throws/0/crank_radius_m", {}, "must be a number"),
        (f"{ROW}/reciprocating_mass_kg", -1, "must be at least 0"),
        (f"{ROW}/connecting_rod/reciprocating_share", "0.3", "must be a number"),
        (f"{ROW}/connecting_rod/reciprocating_share", 1.5, "must be at most 1"),
        (f"{ROW}/cylinder/acting", "both", "must be 'double', 'head' or 'crank'"),
        (f"{ROW}/cylinder/discharge_pressure_Pa", 1000, "must not be below the suction pressure"),
        (f"{ROW}/connecting_rod/length_m", 0.14, "the connecting rod must be longer than the crank radius"),
        ("/machine/webs/1/name", "1a", "this name is taken already; names must be unique"),
        ("/machine/webs/1/name", "", "must have at least 1 character"),
        ("/machine/webs/1/name", "x" * 65, "must have at most 64 characters"),
        ("/machine/webs/1/name", "a\nb", "must not contain control characters"),
        ("/machine/webs/1/name", 5, "must be a string"),
        ("/machine/webs/1/name", "\ud800", "must be valid Unicode text"),
        ("/machine/speed", 5, "unknown field"),
        ("/machine/a~1b~0c", 5, None),
        ("/objective", {"combine": "product"}, None),
        ("/outputs", ["residual", "smell"], None),
        ("/accuracy", {"relative_gap": 0}, None),
        ("/angles", {"step_deg": 7}, None),
    ],
)
def test_each_field_is_named(body: dict[str, Any], path: str, value: object, message: str | None) -> None:
    set_at(body, path, value)
    actual_complaints = complaints(body)
    if message is not None:
        assert actual_complaints == {path: message}
    assert len(actual_complaints) == 1


def test_pointers_below_and_beside(body: dict[str, Any]) -> None:
    body["objective"] = {"combine": "product", "direction_weights": {"x": 0, "y": 0}}
    body["outputs"] = ["residual", "smell"]
    body["angles"] = {"step_deg": 7}
    body["a/b~c"] = body["machine"]["x/~y"] = 1
    assert complaints(body) == {
        "/objective/combine": "must be 'sum' or 'max'",
        "/objective/direction_weights/y": "only one of the two direction weights may be 0",
        "/outputs/1": f"must be {NAMES}",
        "/angles/step_deg": "360 degrees must be a whole number of steps",
        "/a~1b~0c": "unknown field",
        "/machine/x~1~0y": "unknown field",
    }


@pytest.mark.parametrize(
    "path",
    [
        "/machine",
        "/machine/kind",
        "/machine/speed_rpm",
        "/machine/throws",
        "/machine/throws/1/position_m",
        f"{ROW}/axis_deg",
        f"{ROW}/connecting_rod/length_m",
        "/machine/webs/3/max_mass_kg",
    ],
)
def test_a_missing_field_is_named(body: dict[str, Any], path: str) -> None:
    node: Any = body
    *parents, last = [int(key) if key.isdecimal() else key for key in path.split("/")[1:]]
    for key in parents:
        node = node[key]
    del node[last]
    assert complaints(body) == {path: "this field is required"}


@pytest.mark.parametrize(
    ("change", "pointed"),
    [
        ({"count": 0}, "/machine/anti_rotation/count"),
        ({"count": 2.5}, "/machine/anti_rotation/count"),
        ({"type": "glue"}, "/machine/anti_rotation/type"),
        ({"crank_pins": 1}, "/machine/anti_rotation/crank_pins"),
        ({"scroll": 1}, "/machine/anti_rotation/scroll"),
    ],
)
def test_nested_unions(change: dict[str, Any], pointed: str) -> None:
    assert list(complaints(scroll(**change))) == [pointed]


def test_a_field_named_like_the_tag_does_not_lead_astray(body: dict[str, Any]) -> None:
    body["machine"]["reciprocating"] = {"throws": [{"position_m": 0}]}
    del body["machine"]["throws"][0]["position_m"]
    assert set(complaints(body)) == {"/machine/throws/0/position_m", "/machine/reciprocating"}


def test_several_cross_field_problems_are_listed_one_by_one(body: dict[str, Any]) -> None:
    for web in body["machine"]["webs"]:
        web["name"] = "w"
    body["machine"]["throws"][1]["name"] = "1"
    duplicates = [f"/machine/webs/{k}/name" for k in (1, 2, 3)]
    assert list(complaints(body)) == [*duplicates, "/machine/throws/1/name"]


def test_counterweights_of_an_analysis_must_fit_the_machine(body: dict[str, Any]) -> None:
    fitted = [{"web": name, "mass_kg": 1, "angle_deg": 0} for name in ("1a", "nowhere", "1a")]
    assert complaints({**body, "counterweights": fitted}, AnalyzeRequest) == {
        "/counterweights/1/web": "the machine has no web of this name",
        "/counterweights/2/web": "this web carries a counterweight already",
    }


def test_a_surrogate_in_a_name_of_a_field(body: dict[str, Any]) -> None:
    body["machine"]["\ud800"] = 1
    assert complaints(body) == {"/machine": "must be valid Unicode text"}


def test_a_very_long_name_is_not_repeated(body: dict[str, Any]) -> None:
    body["machine"]["x" * 1000] = 1
    assert complaints(body) == {"/machine": "holds an unknown field with a very long name"}


@pytest.mark.parametrize(
    "wrong",
    [
        {"throws": [0] * 400_000},
        {"throws": [{}] * 250_000},
        {"throws": [[]] * 250_000},
        {"throws": [{"rows": [{}] * 60}] * 500},
        {"throws": [{"rows": [{}] * 300}] * 160},
        {"webs": [None] * 49_000},
        {f"a{k}": 0 for k in range(90_000)},
        {"name": {"deep": [[[]] * 100] * 400}},
    ],
    ids=["numbers", "objects", "lists", "rows", "many rows", "nulls", "unknown", "name"],
)
def test_the_work_and_the_answer_are_bounded(body: dict[str, Any], wrong: dict[str, Any]) -> None:
    body["machine"] |= wrong
    start = time.thread_time()
    actual_complaints = complaints(body)
    # regression: about 0.6 s of this thread's own work, whatever else the processor does; unbounded 3 s and more
    assert time.thread_time() - start < 2.5
    assert 1 <= len(actual_complaints) <= MAX_ERRORS
    assert len(str(actual_complaints)) < 20_000


def test_long_lists_are_refused_by_their_length(body: dict[str, Any]) -> None:
    web = body["machine"]["webs"][0]
    body["machine"]["webs"] = [{**web, "name": str(k)} for k in range(501)]
    assert complaints(body) == {"/machine/webs": "must have at most 500 items"}


def test_locate_drops_labels_of_plain_unions() -> None:
    body = {"torque": {"angle_deg": [0, 1]}}
    assert locate(body, ("torque", "Table", "angle_deg", 1)) == ("torque", "angle_deg", 1)
    assert locate(body, ("torque", "Table", "torque_Nm"), missing=True) == ("torque", "torque_Nm")
    assert locate(body, ("torque", "float")) == ("torque",)
    assert locate([1], (1,)) == ()
