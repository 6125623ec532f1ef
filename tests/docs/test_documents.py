"""What the documents show is what the package does today."""

import json
import re
from pathlib import Path
from typing import Any, get_args

import pytest

from optimizer.analyze import analyze
from optimizer.effects.catalogue import catalogue
from optimizer.optimize import optimize
from optimizer.rating.rate import rate
from schemas.rating import RatingRequest
from schemas.requests import AnalyzeRequest, OptimizeRequest, Output

ROOT = Path(__file__).parents[2]


def blocks(document: str) -> list[Any]:
    text = (ROOT / document).read_text()
    return [json.loads(block) for block in re.findall(r"```json\n(.*?)```", text, re.DOTALL)]


def agrees(shown: Any, found: Any) -> None:
    """Everything shown is in what was found, to the digits shown."""
    if isinstance(shown, dict):
        for key, value in shown.items():
            agrees(value, found[key])
    elif isinstance(shown, list):
        assert len(shown) == len(found)
        for one, other in zip(shown, found, strict=True):
            agrees(one, other)
    elif isinstance(shown, float):
        assert found == pytest.approx(shown, rel=1e-4, abs=1e-8)
    else:
        assert shown == found


def test_the_answer_in_the_readme() -> None:
    body = (ROOT / "examples" / "2d12.json").read_bytes()
    found = optimize(OptimizeRequest.model_validate_json(body)).model_dump(mode="json")
    (shown,) = blocks("README.md")
    shown["certificate"].pop("mass_relative_gap")  # rounding, not a figure to hold on to
    agrees(shown, found)


def test_the_request_and_the_infeasible_answer_in_the_api_by_example() -> None:
    request, infeasible, *_ = blocks("docs/api.md")
    assert optimize(OptimizeRequest.model_validate(request)).status == "optimal"
    request["objective"]["force_ceiling_N"] = 300
    found = optimize(OptimizeRequest.model_validate(request)).model_dump(mode="json")
    infeasible["infeasibility"].pop("closest")  # abbreviated
    agrees(infeasible, found)


def after(heading: str) -> list[Any]:
    """Blocks of one section of the API by example."""
    section = (ROOT / "docs/api.md").read_text().split(f"\n## {heading}\n")[1].split("\n## ")[0]
    return [json.loads(block) for block in re.findall(r"```json\n(.*?)```", section, re.DOTALL)]


def test_the_machine_with_gas_in_the_api_by_example() -> None:
    _, request, shown = after("POST /v1/analyze")
    agrees(shown, analyze(AnalyzeRequest.model_validate(request)).model_dump(mode="json"))


def test_the_rating_in_the_api_by_example() -> None:
    request, shown = after("POST /v1/rating")
    agrees(shown, rate(RatingRequest.model_validate(request)).model_dump(mode="json"))


def test_the_effects_in_the_api_by_example() -> None:
    (shown,) = after("GET /v1/effects")
    found = catalogue().model_dump(mode="json")
    for key, entries in shown.items():
        by_name = {one["name"]: one for one in found[key]}
        for one in entries:
            agrees(one, by_name[one["name"]])


def test_the_table_of_outputs_is_complete() -> None:
    listed = re.findall(r"^\| `(\w+)` \|", (ROOT / "docs/api.md").read_text(), re.MULTILINE)
    assert listed == list(get_args(Output))


@pytest.mark.parametrize("document", ["README.md", *(f"docs/{path.name}" for path in (ROOT / "docs").glob("*.md"))])
def test_links_lead_somewhere(document: str) -> None:
    text = (ROOT / document).read_text()
    for target in re.findall(r"\]\(([^)#]+)\)", text):
        assert ((ROOT / document).parent / target).exists(), target


def test_the_readme_counts_the_examples_right() -> None:
    count = re.search(r"(\d+) machines to start from", (ROOT / "README.md").read_text())
    assert count is not None
    assert int(count[1]) == len(list((ROOT / "examples").glob("*.json")))
