"""POST /v1/accuracy and ``counterweight accuracy``: answers, tables, pictures, refusals."""

import json
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import pytest
from click.testing import Result
from typer.testing import CliRunner

from schemas.request.accuracy import AccuracyAnswer
from service.cli import app
from service.report.accuracy_picture import draw
from tests.night import every
from tests.studies.accuracy.problems import body

Post = Callable[..., Any]
#: why a method has no answer where time is short
SLOW = re.compile(r"not solved within \d|the 60 s of the whole ladder were used up")
SVG = "{http://www.w3.org/2000/svg}"


def run(*arguments: str, stdin: bytes | None = None) -> Result:
    return CliRunner().invoke(app, ["accuracy", *arguments], input=stdin)


def request(**changes: Any) -> bytes:
    return json.dumps({**body("2d12"), "repeats": 1, **changes}).encode()


@pytest.fixture(scope="module")
def answer() -> AccuracyAnswer:
    result = run("-", "--json", stdin=request())
    assert result.exit_code == 0
    return AccuracyAnswer.model_validate_json(result.stdout)


def test_the_route_answers_the_ladders(post: Post, answer: AccuracyAnswer) -> None:
    """The same methods, and errors that do not depend on the time, over both doors."""
    response = post("/v1/accuracy", request())
    assert response.status_code == 200
    assert response.headers["cache-control"] == "no-store"
    second_answer = AccuracyAnswer.model_validate_json(response.content)
    assert [(row.method, row.setting) for row in second_answer.ladder] == [
        (row.method, row.setting) for row in answer.ladder
    ]
    pairs = [*zip(second_answer.ladder, answer.ladder, strict=True)]
    # on a machine that is busy a rival may have no answer in its time, and the service has
    assert all(row.skipped is None or SLOW.search(row.skipped) for pair in pairs for row in pair)
    both = [pair for pair in pairs if pair[0].skipped is pair[1].skipped is None]
    assert {row.method for row, _ in both} >= {"service"}
    for first_row, two in both:
        assert first_row.relative_error == pytest.approx(two.relative_error, rel=1e-3, abs=1e-12)
        assert first_row.certified_gap == pytest.approx(two.certified_gap, rel=1e-3, abs=1e-12)
    assert {row.quantity for row in second_answer.effects_ladder} == {
        "mean_torque",
        "peak_torque",
        "fluctuation_energy",
    }
    assert second_answer.environment.versions.keys() >= {"python", "numpy", "scipy", "clarabel", "cvxpy"}
    assert second_answer.size.webs == 4
    assert second_answer.repeats == 1


def test_the_rows_hold_what_the_contract_names(answer: AccuracyAnswer) -> None:
    for row in answer.model_dump(mode="json")["ladder"]:
        assert row.keys() >= {"method", "setting", "time_ms", "relative_error", "certified_gap"}


@pytest.mark.parametrize("outputs", every(2, [["pin_loads"], ["torque"]]))
def test_outputs_play_no_part(post: Post, outputs: list[str]) -> None:
    """A file that asks for outputs can be measured, even where the machine cannot answer them."""
    plain = {**body("single-vertical"), "repeats": 1, "outputs": outputs}
    assert post("/v1/accuracy", json.dumps(plain)).json()["status"] == "measured"


@pytest.mark.parametrize(
    ("changes", "pointer"),
    [
        ({"repeats": 0}, "/repeats"),
        ({"repeats": 21}, "/repeats"),
        ({"repeats": 1.5}, "/repeats"),
        ({"repeats": "5"}, "/repeats"),
        ({"points": 5}, "/points"),
        ({"machine": {"kind": "reciprocating"}}, "/machine/speed_rpm"),
    ],
)
def test_refusals_name_the_field(post: Post, changes: dict[str, Any], pointer: str) -> None:
    response = post("/v1/accuracy", request(**changes))
    assert response.status_code == 422
    assert response.headers["content-type"] == "application/problem+json"
    assert pointer in [error["pointer"] for error in response.json()["errors"]]


def test_infeasible_is_an_answer_over_rest_and_exit_code_1(post: Post) -> None:
    impossible = request(objective={"force_ceiling_N": 1.0})
    assert post("/v1/accuracy", impossible).json()["status"] == "infeasible"
    result = run("-", stdin=impossible)
    assert result.exit_code == 1
    assert "No counterweights satisfy the ceilings" in result.stdout


def test_a_scroll_has_a_ladder_without_effects(post: Post) -> None:
    document = post("/v1/accuracy", json.dumps({**body("scroll-oldham"), "repeats": 1})).json()
    assert document["status"] == "measured"
    assert document["effects_ladder"] == []


def test_the_command_prints_tables() -> None:
    result = run("-", "--repeats", "2", stdin=request())
    assert result.exit_code == 0
    for text in (
        "2D12-90/2-20",
        "minimum mass is off",
        "sampled angles",
        "720 angles",
        "polygonal cones",
        "256 sides",
        "tolerance 1e-10",
        "frontier",
        "fluctuation energy",
        "0.1 deg",
        "median of 2 rounds",
        "Certified: no counterweights within the limits bring the objective below 41250.2",
    ):
        assert text in result.stdout


def test_the_command_refuses_what_is_wrong(tmp_path: Path) -> None:
    for arguments, query, text in (
        (["-", "--repeats", "21"], request(), "repeats"),
        (["-"], b"{", "not JSON"),
        (["-"], request(repeats=0), "/repeats"),
        (["nowhere.json"], None, "cannot read"),
        (["-", "--picture", str(tmp_path)], request(), "cannot write"),
    ):
        result = run(*arguments, stdin=query)
        assert result.exit_code == 2
        assert text in result.stderr
        assert "Traceback" not in result.stderr


def test_the_picture_holds_every_method_and_the_frontier(tmp_path: Path) -> None:
    path = tmp_path / "picture.svg"
    assert run("-", "--picture", str(path), stdin=request()).exit_code == 0
    texts = {"".join(element.itertext()).strip() for element in ElementTree.parse(path).iter(f"{SVG}text")}
    assert texts >= {"the service", "cone program", "sampled angles", "polygonal cones", "frontier"}
    assert texts >= {"720", "256", "1e-10", "true relative error", "time of one solve [ms]", "2D12-90/2-20"}


def test_an_empty_ladder_can_be_drawn() -> None:
    process = run("-", "--json", stdin=request(objective={"force_ceiling_N": 1.0}))
    assert draw("nothing", AccuracyAnswer.model_validate_json(process.stdout)).count("<svg") == 1
