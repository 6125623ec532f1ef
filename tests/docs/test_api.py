"""The API by example: every route and problem is named, every call runs, every answer is that of today."""

import re
import subprocess
from pathlib import Path
from typing import get_args

import pytest

from optimizer.analyze import analyze
from optimizer.mechanics.crankshaft.read import read_shaft
from optimizer.optimize import optimize
from optimizer.outputs.descriptions import catalogue
from optimizer.program import solution
from optimizer.program.cuts import optimum as cuts
from optimizer.program.kernel import finer_numbers
from optimizer.rating.rate import rate
from optimizer.studies.matching.match import match
from optimizer.studies.pareto.pareto import pareto
from optimizer.studies.rounding.round import round_weights
from schemas.answer.outputs import OutputName
from schemas.answer.shaft import DoubtCode
from schemas.front.pareto import ParetoRequest
from schemas.match.request import MatchRequest
from schemas.rating.request import RatingRequest
from schemas.request.requests import AnalyzeRequest, OptimizeRequest
from schemas.request.rounding import RoundRequest
from schemas.request.shaft import ShaftRequest
from service.app import create_app
from service.documents.examples import bodies
from service.guard.keys import SCOPES
from service.settings import Settings
from tests.docs.reading import ROOT, agrees, blocks, document, section
from tests.service.faults import emitted

INDEX = document("docs/api.md")
#: the pages by route in the order of the index: later calls go on from earlier ones
PAGES = {name: document(f"docs/api/{name}.md") for name in re.findall(r"\]\(api/([\w-]+)\.md\)", INDEX)}
_CALL = re.compile(r"```sh\n(.*?)```\n(?:\n```text\n(.*?)```)?", re.DOTALL)
_WRITTEN = "http://127.0.0.1:8000"


def first_column(page: str, heading: str) -> list[str]:
    """Names in the first column of the tables of a section."""
    rows = re.findall(r"^\| (`[^|]+) \|", section(f"docs/api/{page}.md", heading), re.MULTILINE)
    return [name for row in rows for name in re.findall(r"`([^`]+)`", row)]


def test_the_table_of_routes_is_complete() -> None:
    paths = create_app(Settings()).openapi()["paths"]
    listed = [name for row in re.findall(r"^\| (.+?) \|", INDEX, re.MULTILINE) for name in re.findall(r"`(.+?)`", row)]
    assert sorted(listed) == sorted(f"{method.upper()} {path}" for path, file in paths.items() for method in file)


def test_the_index_leads_to_every_page_and_no_page_is_long() -> None:
    assert sorted(PAGES) == sorted(path.stem for path in (ROOT / "docs" / "api").iterdir())
    assert max(text.count("\n") for text in PAGES.values()) <= 200


def test_the_calls_print_what_stands_below_them(url: str, tmp_path: Path) -> None:
    calls = _CALL.findall("".join(PAGES.values()))
    script = "".join(code.replace(_WRITTEN, url) for code, _ in calls)
    command = ["bash", "-euo", "pipefail", "-c", script]
    ran = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, timeout=300, check=False)
    assert ran.returncode == 0, ran.stderr
    # headers end with CR LF, which is no difference
    assert ran.stdout.split() == "".join(output for _, output in calls).split()


def test_the_request_its_answer_and_the_infeasible_one() -> None:
    request, answer, infeasible = blocks(PAGES["optimize"])
    agrees(answer, optimize(OptimizeRequest.model_validate(request)).model_dump(mode="json"))
    request["objective"]["force_ceiling_N"] = 300
    fields = optimize(OptimizeRequest.model_validate(request)).model_dump(mode="json")
    infeasible["infeasibility"].pop("closest")  # abbreviated
    agrees(infeasible, fields)


def test_the_whole_turn() -> None:
    request, answer, infeasible = blocks(PAGES["revolution"])
    agrees(answer, optimize(OptimizeRequest.model_validate(request)).model_dump(mode="json"))
    # analytic: an allowance is a share of the moment without counterweights, weighed by the span of 0.16 m
    optimum = optimize(OptimizeRequest.model_validate({**request, "objective": {}}))
    (external,) = answer["certificate"]["goals"]
    moment = optimum.residual.before.moment.peak_Nm / 0.16
    assert external["limit"] - external["lower_bound"] == pytest.approx(0.01 * moment, abs=0.02)
    request["objective"]["bearing_ceiling_N"] = 1000
    agrees(infeasible, optimize(OptimizeRequest.model_validate(request)).model_dump(mode="json"))


def test_the_balance_shafts() -> None:
    request, answer = blocks(PAGES["balance-shafts"])
    agrees(answer, optimize(OptimizeRequest.model_validate(request)).model_dump(mode="json"))


def test_scenarios_and_tolerances() -> None:
    request, answer = blocks(PAGES["scenarios"])
    agrees(answer, optimize(OptimizeRequest.model_validate(request)).model_dump(mode="json"))


def test_what_is_cut_from_a_plate() -> None:
    request, answer = blocks(PAGES["plates"])
    agrees(answer, optimize(OptimizeRequest.model_validate(request)).model_dump(mode="json"))


def test_what_a_shadow_price_promises() -> None:
    """Analytic: below the optimum mass every kilogram takes R omega^2 = 877.3 N off the peak."""
    request, *_ = blocks(PAGES["optimize"])
    before = optimize(OptimizeRequest.model_validate(request)).certificate
    request["machine"]["max_total_mass_kg"] += 0.1
    after = optimize(OptimizeRequest.model_validate(request)).certificate
    assert before is not None
    assert after is not None
    assert before.objective - after.objective == pytest.approx(87.73, abs=0.01)


def test_the_methods_of_the_certificate() -> None:
    listed = re.findall(r"`((?:interior point|cone program|closed form|cuts), [^`]+)` ?[|,]", PAGES["certificate"])
    finer = [precision.name for precision in finer_numbers.PRECISIONS]
    assert listed == [solution.INTERIOR_POINT, solution.CONE_PROGRAM, *finer, solution.CLOSED_FORM, cuts.METHOD]


def test_the_machine_with_gas() -> None:
    _, request, answer = blocks(section("docs/api/analyze.md", "POST /v1/analyze"))
    agrees(answer, analyze(AnalyzeRequest.model_validate(request)).model_dump(mode="json"))


def test_the_front() -> None:
    (block,) = blocks(section("docs/api/studies.md", "POST /v1/pareto"))
    request = ParetoRequest.model_validate({**bodies("")["2d12"], "points": 3})
    agrees(block, pareto(request).model_dump(mode="json"))


def test_the_rating() -> None:
    request, answer = blocks(PAGES["rating"])
    agrees(answer, rate(RatingRequest.model_validate(request)).model_dump(mode="json"))


def test_the_matching() -> None:
    request, answer = blocks(PAGES["match"])
    agrees(answer, match(MatchRequest.model_validate(request)).model_dump(mode="json"))


def test_the_rounding() -> None:
    request, answer = blocks(PAGES["round"])
    agrees(answer, round_weights(RoundRequest.model_validate(request)).model_dump(mode="json"))


def test_the_shaft() -> None:
    pages = blocks(PAGES["shaft"])
    for request, page in zip(pages[::2], pages[1::2], strict=True):
        agrees(page, read_shaft(ShaftRequest.model_validate(request)).model_dump(mode="json"))
    table = PAGES["shaft"].split("| doubt |")[1].split("\n\n")[0]
    assert sorted(re.findall(r"`(\w+)`", table)) == sorted(get_args(DoubtCode))


def test_the_effects() -> None:
    (block,) = blocks(section("docs/api/analyze.md", "GET /v1/effects"))
    fields = catalogue().model_dump(mode="json")
    for key, entries in block.items():
        by_name = {entry["name"]: entry for entry in fields[key]}
        for record in entries:
            agrees(record, by_name[record["name"]])


def test_the_table_of_outputs_is_complete() -> None:
    assert first_column("analyze", "POST /v1/analyze") == list(get_args(OutputName))


def test_the_table_of_scopes_is_complete() -> None:
    assert first_column("service", "Keys") == list(SCOPES)


def test_the_table_of_problems_is_complete() -> None:
    rows = re.findall(r"^\| (\d{3}) \| (.+?) \|", section("docs/api/service.md", "Errors"), re.MULTILINE)
    listed = {(int(status), kind) for status, kinds in rows for kind in re.findall(r"`(.+?)`", kinds)}
    # nobody reads the answer of a client that has gone; 500 stands below the table
    assert emitted() - {(499, "client-gone"), (500, "internal-error")} == listed - {(405, "method-not-allowed")}


def test_the_examples_that_hold_an_objective_are_named() -> None:
    words = section("docs/api/analyze.md", "POST /v1/analyze").split("```")[0]
    refused = {name for name, body in bodies().items() if set(body) - set(AnalyzeRequest.model_fields)}
    assert {name for name in bodies() if f"`{name}`" in words} == refused
