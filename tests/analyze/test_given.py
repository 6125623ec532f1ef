"""Counterweights that are on a machine at a radius or in a plane of their own."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from pydantic import ValidationError

from optimizer.analyze import analyze
from optimizer.errors import OutOfRange
from optimizer.studies.sweep.whole import sweep_table
from schemas.answer.answers import AnalyzeAnswer
from schemas.request.requests import AnalyzeRequest
from schemas.sweep.request import SweepRequest

_EXAMPLES = Path(__file__).parents[2] / "examples"
_GRADED = {"grade_mm_s": 6.3, "mass_kg": 300.0, "centre_of_mass_m": 0.0, "plane_a_m": -0.4, "plane_b_m": 0.4}


def body(counterweights: list[dict[str, Any]], name: str = "2d12") -> dict[str, Any]:
    machine = json.loads((_EXAMPLES / f"{name}.json").read_text())["machine"]
    return {"machine": machine | {"balance_quality": _GRADED}, "counterweights": counterweights}


def answer(counterweights: list[dict[str, Any]], name: str = "2d12") -> AnalyzeAnswer:
    return analyze(AnalyzeRequest.model_validate(body(counterweights, name)))


def weight(mass: float, angle: float, **place: Any) -> dict[str, Any]:
    return {"mass_kg": mass, "angle_deg": angle, **place}


def same(first_answer: AnalyzeAnswer, second_answer: AnalyzeAnswer) -> None:
    """Equal to the rounding of a sum in another order."""
    for analysis in (first_answer, second_answer):
        assert analysis.residual is not None
        assert analysis.residual.after is not None
        assert analysis.balance_quality is not None
        assert analysis.balance_quality.after is not None
    figures = [
        [
            *analyze_answer.residual.after.force.model_dump().values(),
            *analyze_answer.residual.after.moment.model_dump().values(),
            analyze_answer.balance_quality.after.grade_mm_s,
        ]
        for analyze_answer in (first_answer, second_answer)
    ]
    np.testing.assert_allclose(figures[0], figures[1], rtol=1e-9, atol=1e-6)


def test_in_the_plane_of_a_web_as_on_it_analytic() -> None:
    web = body([])["machine"]["webs"][1]
    there = {"position_m": web["position_m"], "radius_m": web["counterweight_radius_m"]}
    same(answer([weight(20.0, 130.0, **there)]), answer([weight(20.0, 130.0, web=web["name"])]))


def test_mass_times_radius_is_what_counts_analytic() -> None:
    web = body([])["machine"]["webs"][0]
    half = 0.5 * web["counterweight_radius_m"]
    near = answer([weight(20.0, 130.0, web=web["name"], radius_m=half)])
    same(near, answer([weight(10.0, 130.0, web=web["name"])]))
    assert near.counterweights[0].radius_m == half
    assert near.total_mass_kg == 20.0


def test_several_in_one_plane_add_up_analytic() -> None:
    """Two equal weights 60 degrees to either side do what one of their mass does."""
    place = {"position_m": 0.31, "radius_m": 0.2}
    two = answer([weight(5.0, 100.0, **place), weight(5.0, 220.0, **place)])
    same(two, answer([weight(5.0, 160.0, **place)]))
    names = [counterweight.web for counterweight in two.counterweights]
    assert names[-2:] == ["counterweight 1", "counterweight 2"]
    assert len(set(names)) == len(names)
    assert two.counterweights[-1].position_m == 0.31
    assert two.counterweights[-1].throw == 0


def test_a_plane_is_not_named_like_a_web() -> None:
    payload = body([weight(1.0, 0.0, position_m=0.0, radius_m=0.1)])
    payload["machine"]["webs"][0]["name"] = "counterweight 1"
    names = [counterweight.web for counterweight in analyze(AnalyzeRequest.model_validate(payload)).counterweights]
    assert names.count("counterweight 1") == 1
    assert names[-1] == "counterweight 1'"


def test_on_a_plate_its_own_radius_takes_the_place_of_what_is_cut() -> None:
    with pytest.raises(OutOfRange):
        answer([weight(9.0, 270.0, web="front")], "plate-single")
    analysis = answer([weight(9.0, 270.0, web="front", radius_m=0.02)], "plate-single")
    assert analysis.counterweights[0].shape is None
    assert analysis.counterweights[0].mass_radius_kg_m == pytest.approx(0.18)
    cut = answer([weight(1.0, 270.0, web="front")], "plate-single")
    assert cut.counterweights[0].shape is not None


def test_on_a_balance_shaft() -> None:
    name = "single-balance-shaft"
    plain = answer([weight(0.5, 30.0, web="balancer")], name)
    same(answer([weight(0.25, 30.0, web="balancer", radius_m=0.06)], name), plain)


def test_a_shaft_without_webs() -> None:
    payload = body([weight(4.0, 180.0, position_m=0.1, radius_m=0.2)])
    payload["machine"]["webs"] = []
    analysis = analyze(AnalyzeRequest.model_validate(payload))
    assert [counterweight.mass_kg for counterweight in analysis.counterweights] == [4.0]


@pytest.mark.parametrize(
    ("fields", "field"),
    [
        ({}, "web"),
        ({"radius_m": 0.2}, "web"),
        ({"web": "1a", "position_m": 0.1, "radius_m": 0.2}, "position_m"),
        ({"position_m": 0.1}, "radius_m"),
        ({"position_m": 0.1, "radius_m": 0.0}, "radius_m"),
    ],
)
def test_what_is_refused(fields: dict[str, Any], field: str) -> None:
    with pytest.raises(ValidationError) as refused:
        AnalyzeRequest.model_validate(body([weight(1.0, 0.0, **fields)]))
    (error,) = refused.value.errors()
    places = [problem.path for problem in error.get("ctx", {}).get("problems", ())] or [error["loc"][-1:]]
    assert [place[-1] for place in places] == [field]


def test_planes_and_radii_of_a_sweep() -> None:
    """Independent: every row beside the analysis of that design."""
    values = {"position_m": [-0.3, 0.1, 0.4], "radius_m": [0.1, 0.2, 0.25]}
    base = body([weight(12.0, 200.0, position_m=0.0, radius_m=0.2), weight(3.0, 10.0, web="1a", radius_m=0.1)])
    axes = [{"path": f"/counterweights/0/{name}", "values": some} for name, some in values.items()]
    sweep = {"task": "analyze", "base": base, "axes": axes, "design": "paired"}
    table = sweep_table(SweepRequest.model_validate(sweep))
    for k, (plane, radius) in enumerate(zip(*values.values(), strict=True)):
        base["counterweights"][0] |= {"position_m": plane, "radius_m": radius}
        after = analyze(AnalyzeRequest.model_validate(base)).residual.after
        assert table["status"][k].as_py() == "analyzed"
        assert table["force_peak_N"][k].as_py() == pytest.approx(after.force.peak_N, rel=1e-12)
        assert table["moment_peak_Nm"][k].as_py() == pytest.approx(after.moment.peak_Nm, rel=1e-12)
