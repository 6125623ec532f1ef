"""docs/pareto.md shows what the package does today; expected numbers are regressions."""

import json
import re
from pathlib import Path
from typing import Any

import pytest

from optimizer.studies.pareto.pareto import pareto
from schemas.front.pareto import ParetoAnswer, ParetoRequest
from tests.docs.test_documents import agrees

ROOT = Path(__file__).parents[3]
TEXT = (ROOT / "docs/pareto.md").read_text()


def example(name: str, drop: tuple[str, ...] = (), **more: Any) -> ParetoAnswer:
    body = json.loads((ROOT / "examples" / name).read_bytes())
    budget = more.pop("max_total_mass_kg", None)
    webs = [web for web in body["machine"]["webs"] if web["name"] not in drop]
    return pareto(
        ParetoRequest.model_validate(
            {"machine": {**body["machine"], "webs": webs, "max_total_mass_kg": budget}, **more}
        )
    )


def test_the_table_and_the_point() -> None:
    answer = example("2d12.json", points=5, total_mass_budgets_kg=[120, 180, 240])
    rows = re.findall(r"^\| (\d*) ?\| ([\d.]+) \| ([\d.]+) \| ([\d.]+) \|$", TEXT, re.MULTILINE)
    points = [point for front in answer.fronts for point in front.points]
    assert len(rows) == len(points) == 11
    assert [row[0] for row in rows if row[0]] == ["120", "180", "240"]
    for (_, *value), point in zip(rows, points, strict=True):
        figures = (point.force_peak_N, point.moment_peak_Nm, point.total_mass_kg)
        assert list(map(float, value)) == pytest.approx(figures, rel=1e-5)
    (block,) = re.findall(r"```json\n(.*?)```", TEXT, re.DOTALL)
    agrees(json.loads(block), answer.fronts[2].points[2].model_dump(mode="json"))
    assert [front.reason for front in answer.fronts] == [None, "reached_together", None]


def test_the_moment_that_a_budget_leaves_to_the_v8() -> None:
    answer = example("v8-cross-plane.json", points=2, total_mass_budgets_kg=[1, 2, 3, 4, 5])
    assert [front.reason for front in answer.fronts] == ["reached_together"] * 5
    moments = [front.points[0].moment_peak_Nm for front in answer.fronts]
    assert moments == pytest.approx([15278, 9904, 4529, 530, 0], abs=0.6)
    assert answer.fronts[4].points[0].total_mass_kg == pytest.approx(4.145, abs=1e-3)


def test_the_bent_front_of_the_v8() -> None:
    (front,) = example("v8-cross-plane.json", ("4a", "4b"), points=9, max_total_mass_kg=5.0).fronts
    ends, bend = (front.points[0], front.points[-1]), front.points[6]
    assert front.knee == 6
    assert [point.moment_peak_Nm for point in (*ends, bend)] == pytest.approx([4400, 1949, 2463], abs=1)
    assert [point.force_peak_N for point in (*ends, bend)] == pytest.approx([0, 48371, 34589], abs=1)
