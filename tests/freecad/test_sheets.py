"""Tables of a machine to a request, and what is wrong back to a cell."""

import pytest
from freecad.counterweight.asking import ask
from freecad.counterweight.service import Refused, Service
from freecad.counterweight.sheets import SheetRequest, Wrong, completed, from_tables, letters, table

ENVELOPE = {"envelope.shape": "sector", "envelope.outer_radius_m": 0.3, "envelope.thickness_m": 0.05}
TABLES = {
    "machine": [["field", "value"], ["machine.speed_rpm", 500.0], ["objective.priorities", '["force"]']],
    "throws": [
        ["use", "name", "position_m", "crank_radius_m", "crank_angle_deg"],
        ["no", "web?", 0.0, 0.05, 0.0],
        ["yes", 1.0, 0.175, 0.14, 0.0],
        ["yes", "2", -0.175, 0.14, 180.0],
    ],
    "rows": [
        ["throw", "name", "axis_deg", "reciprocating_mass_kg", "connecting_rod.mass_kg", "rod"],
        ["2", "II", 180.0, 250.0, None, "Rod 2"],
        [1, "I", 0.0, 270.0, 86.0, None],
    ],
    "webs": table(["name", "position_m", *ENVELOPE], [{"name": "1a", "position_m": 0.28, **ENVELOPE}]),
}


def test_the_request_of_tables() -> None:
    tables = from_tables(TABLES)
    machine = tables.body["machine"]
    assert tables.body["objective"] == {"priorities": ["force"]}
    # the doubtful pin does not count; a spreadsheet made a number of the name
    assert [throw["name"] for throw in machine["throws"]] == ["1", "2"]
    assert machine["throws"][0]["rows"] == [
        {"name": "I", "axis_deg": 0.0, "reciprocating_mass_kg": 270.0, "connecting_rod": {"mass_kg": 86.0}}
    ]
    assert tables.rods == {(1, 0): "Rod 2"}
    assert machine["webs"][0]["envelope"] == {"shape": "sector", "outer_radius_m": 0.3, "thickness_m": 0.05}


@pytest.mark.parametrize(
    ("pointer", "where"),
    [
        ("/machine/speed_rpm", "machine!B2"),
        ("/machine/throws/0/crank_radius_m", "throws!D3"),
        ("/machine/throws/1/rows/0/reciprocating_mass_kg", "rows!D2"),
        ("/machine/throws/0/rows/0/connecting_rod/mass_kg", "rows!E3"),
        (
            "/machine/throws/0/rows/0/connecting_rod/length_m",
            "rows!3 (/machine/throws/0/rows/0/connecting_rod/length_m)",
        ),
        ("/machine/webs/0/envelope/thickness_m", "webs!E2"),
        ("", "the request"),
    ],
)
def test_a_field_has_its_cell(pointer: str, where: str) -> None:
    assert from_tables(TABLES).where(pointer) == where


@pytest.mark.parametrize(
    ("sheet", "line", "text"),
    [
        ("rows", ["3", "III", 0.0, 1.0], "rows!4: throw: there is no throw '3' that is used"),
        (
            "throws",
            ["yes", "3", "far", 0.1, 0.0],
            "throws!C5: position_m: must be a number, or one with a unit such as",
        ),
        ("webs", ["bare", 0.1], "webs!3: a web needs its envelope"),
        ("machine", ["machine.kind", "scroll"], "machine: one crankshaft"),
    ],
)
def test_what_is_wrong_is_said_at_its_cell(sheet: str, line: list[object], text: str) -> None:
    with pytest.raises(Wrong, match=r".") as wrong:
        from_tables({**TABLES, sheet: [*TABLES[sheet], line]})  # type: ignore[dict-item]
    assert wrong.value.lines[0].startswith(text)


def test_a_machine_without_throws_or_webs() -> None:
    with pytest.raises(Wrong) as wrong:
        from_tables({"machine": TABLES["machine"]})
    assert wrong.value.lines == ["throws: no throw is used", "webs: no web is used"]


SHOWN = {
    "machine": [["field", "value"]],
    "throws": table(["use", "name", "position_m"], [{"use": "no", "name": "web?"}, {"use": "yes", "name": "1"}]),
    "rows": [["throw"]],
    "webs": table(["use", "name", "position_m"], [{"use": "yes", "name": "web 1", "position_m": 0.1}]),
}
MESSAGES = {
    "machine": {
        "speed_rpm": 500,
        "throws": [{"crank_radius_m": 0.14, "rows": [{"axis_deg": 90, "connecting_rod": {"mass_kg": 3.0}}]}],
        "webs": [{"position_m": 0.2, "envelope": {"shape": "sector"}}],
    },
    "objective": {"symmetric": False},
}


def test_what_no_face_shows_is_added_to_what_they_show() -> None:
    body = from_tables(completed(SHOWN, MESSAGES)).body
    assert body == {
        "machine": {
            "kind": "reciprocating",
            "speed_rpm": 500,
            "throws": [
                {
                    "name": "1",
                    "crank_radius_m": 0.14,
                    "rows": [{"axis_deg": 90, "connecting_rod": {"mass_kg": 3.0}}],
                }
            ],
            # what is said stands above what is shown
            "webs": [{"name": "web 1", "position_m": 0.2, "envelope": {"shape": "sector"}}],
        },
        "objective": {"symmetric": False},
    }


def test_other_than_is_shown_cannot_be_described() -> None:
    with pytest.raises(Wrong, match="throws: the faces show 1, 2 are described"):
        completed(SHOWN, {"machine": {"throws": [{}, {}]}})


def test_columns() -> None:
    assert [letters(column) for column in (0, 25, 26, 51, 52, 701, 702)] == ["A", "Z", "AA", "AZ", "BA", "ZZ", "AAA"]


class _Refusing(Service):
    def optimize(self, request: object) -> dict[str, object]:
        raise Refused(422, {"errors": [{"pointer": "/machine/webs/0/position_m", "message": "must be a number"}]})


def test_what_the_service_refuses_is_said_at_its_cell() -> None:
    with pytest.raises(Wrong, match="webs!B2: must be a number"):
        ask(_Refusing(), from_tables(TABLES))


def test_a_service_that_is_away() -> None:
    with pytest.raises(Wrong, match=r"the service at http://127\.0\.0\.1:9 does not answer"):
        ask(Service("http://127.0.0.1:9"), SheetRequest({"machine": {}}))
