"""Workbooks over REST: in by their media type, out by `Accept`, and what is wrong with one."""

import io
import json
from collections.abc import Callable
from typing import Any
from zipfile import ZIP_DEFLATED, ZipFile

import openpyxl
import pytest
from openpyxl.utils import get_column_letter
from starlette.testclient import TestClient

from schemas.request.requests import OptimizeRequest
from service.computations.computation import XLSX
from service.documents.examples import bodies
from service.workbook.files import workbook, workbook_sheets
from service.workbook.sheets import request_sheets
from tests.night import part

OPTIMIZE, CONVERT = "/v1/optimize", "/v1/convert"


@pytest.fixture
def post_workbook(client: TestClient) -> Callable[..., Any]:
    """Post a workbook."""

    def send(content: bytes, path: str = OPTIMIZE, **headers: str) -> Any:
        fields = {name.replace("_", "-"): value for name, value in headers.items()}
        return client.post(path, content=content, headers={"Content-Type": XLSX, **fields})

    return send


def packed(parts: dict[str, bytes]) -> bytes:
    out = io.BytesIO()
    with ZipFile(out, "w", ZIP_DEFLATED) as archive:
        for name, content in parts.items():
            archive.writestr(name, content)
    return out.getvalue()


def with_part(content: bytes, name: str, change: Callable[[bytes], bytes]) -> bytes:
    with ZipFile(io.BytesIO(content)) as archive:
        parts = {text: archive.read(text) for text in archive.namelist()}
    parts[name] = change(parts.get(name, b""))
    return packed(parts)


def test_a_template_comes_back_as_an_answer(client: TestClient, post_workbook: Callable[..., Any]) -> None:
    template = client.get("/v1/template.xlsx", params={"example": "2d12"})
    assert template.headers["content-type"] == XLSX
    assert 'filename="machine.xlsx"' in template.headers["content-disposition"]
    response = post_workbook(template.content, Accept=XLSX)
    assert (response.status_code, response.headers["content-type"]) == (200, XLSX)
    assert response.headers["vary"].startswith("Accept, Accept-Encoding")
    sheets = workbook_sheets(response.content)
    fields = {str(name): value for name, value in (line[:2] for line in sheets["answer"])}
    assert fields["status"] == "optimal"
    # and posted once more, the sheets of the answer say nothing of the machine
    again = post_workbook(response.content).json()
    assert again["total_mass_kg"] == pytest.approx(fields["total_mass_kg"], rel=1e-12)


def test_a_workbook_may_be_answered_in_json_and_json_in_a_workbook(
    post: Callable[..., Any], post_workbook: Callable[..., Any], body: dict[str, Any]
) -> None:
    plain = post(OPTIMIZE, json.dumps(body)).json()
    assert post_workbook(workbook(request_sheets(body))).json()["counterweights"] == plain["counterweights"]
    response = post(OPTIMIZE, json.dumps(body), Accept=f"application/json;q=0.5, {XLSX}")
    assert response.headers["content-type"] == XLSX
    assert len(workbook_sheets(response.content)["counterweights"]) == 1 + len(plain["counterweights"])


@pytest.mark.parametrize("accept", ["*/*", "text/html", "application/json", "application/*"])
def test_who_does_not_ask_for_a_workbook_gets_json(post: Callable[..., Any], body: dict[str, Any], accept: str) -> None:
    assert post(OPTIMIZE, json.dumps(body), Accept=accept).headers["content-type"] == "application/json"


def test_what_is_wrong_is_said_with_its_cell(post_workbook: Callable[..., Any], body: dict[str, Any]) -> None:
    body["machine"]["webs"][1]["max_mass_kg"] = -3
    del body["machine"]["throws"][0]["crank_radius_m"]
    response = post_workbook(workbook(request_sheets(body)))
    assert response.status_code == 422
    messages = {error["pointer"]: error["message"] for error in response.json()["errors"]}
    assert messages["/machine/webs/1/max_mass_kg"].startswith("webs!")
    assert messages["/machine/throws/0/crank_radius_m"] == "throws, line 2: crank_radius_m: this field is required"


def test_what_cannot_be_computed_is_said_with_its_cell(post_workbook: Callable[..., Any], body: dict[str, Any]) -> None:
    del body["machine"]["flywheel"]
    response = post_workbook(workbook(request_sheets({**body, "outputs": ["flywheel"]})))
    assert response.status_code == 422
    assert response.json()["errors"][0]["message"].startswith("machine: machine.")


def test_sheets_that_say_nothing_of_a_machine(post_workbook: Callable[..., Any]) -> None:
    response = post_workbook(workbook({"machines": [["field", "value"]]}))
    assert response.status_code == 422
    assert response.json()["errors"][0]["message"].startswith("machines: no sheet of a machine")


def test_a_formula_is_never_computed(post_workbook: Callable[..., Any], body: dict[str, Any]) -> None:
    book = openpyxl.load_workbook(
        io.BytesIO(workbook(request_sheets({**body, "machine": {**body["machine"], "name": "="}})))
    )
    book["webs"]["B2"] = "=1+1"
    out = io.BytesIO()
    book.save(out)
    response = post_workbook(out.getvalue())
    assert response.status_code == 422
    assert response.json()["errors"][0]["message"].startswith("webs!B2: a formula without a value")


def test_a_text_that_begins_like_a_formula_stays_text(post_workbook: Callable[..., Any], body: dict[str, Any]) -> None:
    body["machine"]["webs"][0]["name"] = '=HYPERLINK("http://127.0.0.1")'
    response = post_workbook(workbook(request_sheets(body)), Accept=XLSX)
    assert response.status_code == 200
    book = openpyxl.load_workbook(io.BytesIO(response.content))
    cells = [cell for sheet in book for line in sheet.iter_rows() for cell in line]
    assert any(cell.value == '=HYPERLINK("http://127.0.0.1")' for cell in cells)
    assert not [cell for cell in cells if cell.data_type == "f"]


def many_lines(content: bytes) -> bytes:
    """A sheet of lines without end."""
    line = b'<row r="1"><c r="A1"><v>1</v></c></row>'
    return content.replace(b"</sheetData>", line * 200_000 + b"</sheetData>")


def entities(content: bytes) -> bytes:
    """Text that doubles each time that it is named."""
    first = '<!DOCTYPE x [<!ENTITY a0 "ha">'
    more = "".join(f'<!ENTITY a{k} "&a{k - 1};&a{k - 1};">' for k in range(1, 30))
    return (first + more + "]><sst>&a29;</sst>").encode()


@pytest.mark.parametrize(
    ("change", "text"),
    [
        (lambda content: b"", "no xlsx"),
        (lambda content: b"{}", "no xlsx"),
        (lambda content: content[: len(content) // 2], "no xlsx"),
        (lambda content: packed({"a.txt": b"a"}), "cannot be read"),
        (lambda content: packed({"xl/workbook.xml": b"0" * 30_000_000}), "more than 4 MB"),
        (lambda content: packed({f"{k}": b"" for k in range(1001)}), "200 files"),
        (lambda content: with_part(content, "xl/worksheets/sheet1.xml", many_lines), "more than 4 MB"),
        (lambda content: with_part(content, "xl/sharedStrings.xml", entities), "entities"),
        (
            lambda content: with_part(
                content, "xl/sharedStrings.xml", lambda _: entities(b"").decode().encode("utf-16")
            ),
            "entities",
        ),
    ],
)
def test_what_is_no_workbook_is_refused(
    post_workbook: Callable[..., Any], body: dict[str, Any], change: Callable[[bytes], bytes], text: str
) -> None:
    response = post_workbook(change(workbook(request_sheets(body))))
    assert response.status_code == 400
    assert response.json()["type"] == "/problems/unreadable-body"
    assert text in response.json()["detail"]


def test_a_workbook_that_is_too_large_is_not_read(post_workbook: Callable[..., Any]) -> None:
    assert post_workbook(b"0" * 1_000_001).status_code == 413


def test_workbooks_go_where_they_are_understood(
    client: TestClient, post_workbook: Callable[..., Any], body: dict[str, Any]
) -> None:
    content = workbook(request_sheets(body))
    for path in ("/v1/analyze", "/v1/pareto", "/v1/sweeps"):
        assert post_workbook(content, path).status_code == 415, path
    assert post_workbook(content, Content_Encoding="gzip").status_code == 415
    refused = client.post(OPTIMIZE, content="x", headers={"Content-Type": "text/plain"})
    assert refused.status_code == 415
    assert XLSX in refused.json()["detail"]


def test_a_workbook_is_answered_at_once(post_workbook: Callable[..., Any], body: dict[str, Any]) -> None:
    assert post_workbook(workbook(request_sheets(body)), Prefer="respond-async").status_code == 200


def test_there_is_a_template_of_every_example_and_of_nothing_else(client: TestClient) -> None:
    assert client.get("/v1/template.xlsx", params={"example": "no-such"}).status_code == 404
    assert client.get("/v1/template.xlsx", params={"example": "x" * 65}).status_code == 422
    assert workbook_sheets(client.get("/v1/template.xlsx").content)["machine"]


@pytest.mark.parametrize("name", part(3, sorted(bodies())))
def test_the_request_in_a_workbook_is_the_one_that_was_written(
    client: TestClient, post_workbook: Callable[..., Any], name: str
) -> None:
    template = client.get("/v1/template.xlsx", params={"example": name}).content
    read = post_workbook(template, CONVERT)
    assert (read.status_code, read.headers["content-type"]) == (200, "application/json")
    # independent: the example as it is published, with its quantities as numbers
    published = client.get(f"/v1/examples/{name}").json()
    assert OptimizeRequest.model_validate(read.json()) == OptimizeRequest.model_validate(published)
    # and as a workbook again
    written_again = client.post(CONVERT, json=read.json(), headers={"Accept": XLSX})
    assert written_again.headers["content-type"] == XLSX
    assert 'filename="machine.xlsx"' in written_again.headers["content-disposition"]
    assert post_workbook(written_again.content, CONVERT).json() == read.json()


def test_the_sheets_of_an_answer_are_no_part_of_the_request(
    post_workbook: Callable[..., Any], body: dict[str, Any]
) -> None:
    actual_workbook = workbook(request_sheets(body))
    answered = post_workbook(actual_workbook, Accept=XLSX).content
    assert {"answer", "counterweights"} <= workbook_sheets(answered).keys()
    assert post_workbook(answered, CONVERT).json() == post_workbook(actual_workbook, CONVERT).json()


def test_a_quantity_is_read_in_the_unit_of_its_field(post_workbook: Callable[..., Any], body: dict[str, Any]) -> None:
    body["machine"]["speed_rpm"] = "12 Hz"
    # analytic: 12 turns a second
    assert post_workbook(workbook(request_sheets(body)), CONVERT).json()["machine"]["speed_rpm"] == pytest.approx(720)


def test_what_is_wrong_is_said_by_its_cell_where_nothing_is_solved(
    client: TestClient, post_workbook: Callable[..., Any], body: dict[str, Any]
) -> None:
    sheets = request_sheets(body)
    column = sheets["throws"][0].index("crank_radius_m")
    sheets["throws"][1][column] = "long"
    refused = post_workbook(workbook(sheets), CONVERT)
    assert (refused.status_code, refused.headers["content-type"]) == (422, "application/problem+json")
    (error,) = refused.json()["errors"]
    assert error["pointer"] == "/machine/throws/0/crank_radius_m"
    assert error["message"].startswith(f"throws!{get_column_letter(column + 1)}2: ")
    assert post_workbook(b"no workbook", CONVERT).status_code == 400
    bomb = with_part(workbook(request_sheets(body)), "xl/worksheets/sheet1.xml", many_lines)
    assert post_workbook(bomb, CONVERT).status_code == 400
    assert client.post(CONVERT, content="x", headers={"Content-Type": "text/plain"}).status_code == 415
    assert post_workbook(workbook(request_sheets(body)), CONVERT, Accept="text/html").status_code == 406


def test_half_of_a_surrogate_pair_in_a_refusal_is_no_fault(post_workbook: Callable[..., Any]) -> None:
    """JSON in a cell may name a throw so, and the refusal lists the names of throws."""
    sheets = {"throws": [["name"], ['"\\ud800"']], "rows": [["throw"], [7]]}
    answer = post_workbook(workbook(sheets))
    assert answer.status_code == 422
    assert "the name of its throw" in answer.text
