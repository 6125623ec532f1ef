"""Plates that are none, and more than a plate holds: refused by their fields."""

from typing import Any

import pytest

from optimizer.analyze import analyze
from optimizer.errors import OutOfRange
from optimizer.mechanics.shapes import plates
from schemas.request.requests import AnalyzeRequest, OptimizeRequest
from service.common.validation import InvalidRequest, check
from tests.optimize.test_shapes import plate_body

BAD = {
    "/machine/webs/0/envelope/inner_radius_m": {"inner_radius_m": 0.3199},
    "/machine/webs/0/envelope/outer_radius_m": {"outer_radius_m": -1},
    "/machine/webs/0/envelope/density_kg_m3": {"density_kg_m3": 0},
    "/machine/webs/0/envelope/thickness_m": {"thickness_m": 0},
    "/machine/webs/0/envelope/max_half_angle_deg": {"max_half_angle_deg": 91},
    "/machine/webs/0/envelope/shape": {"shape": "heart"},
}


def test_an_inner_radius_above_the_outer_one_is_refused() -> None:
    body = plate_body("segment", inner_radius_m=0.33)
    with pytest.raises(InvalidRequest) as refused:
        check(OptimizeRequest, body)
    assert refused.value.problems[0].path == ("machine", "webs", 0, "envelope", "inner_radius_m")


@pytest.mark.parametrize("pointer", BAD)
def test_a_plate_that_is_none_is_refused_by_its_field(pointer: str) -> None:
    body = plate_body("sector")
    body["machine"]["webs"][0]["envelope"].update(BAD[pointer])
    with pytest.raises(InvalidRequest) as refused:
        check(OptimizeRequest, body)
    assert pointer in {"/" + "/".join(map(str, problem.path)) for problem in refused.value.problems}


@pytest.mark.parametrize(
    ("change", "field"),
    [
        ({"counterweight_radius_m": 0.2}, "counterweight_radius_m"),
        ({"max_mass_kg": 20}, "max_mass_kg"),
        ({"envelope": None, "max_mass_kg": 5}, "counterweight_radius_m"),
        ({"envelope": None, "counterweight_radius_m": 0.2}, "max_mass_kg"),
    ],
)
def test_a_web_has_a_plate_or_a_radius_and_a_mass(change: dict[str, Any], field: str) -> None:
    body = plate_body("sector")
    body["machine"]["webs"][1].update(change)
    with pytest.raises(InvalidRequest) as refused:
        check(OptimizeRequest, body)
    assert [problem.path for problem in refused.value.problems] == [("machine", "webs", 1, field)]


def test_more_than_a_plate_holds_is_refused() -> None:
    machine = plate_body("segment")["machine"]
    fitted = [{"web": "1b", "mass_kg": 1000, "angle_deg": 0}]
    with pytest.raises(OutOfRange, match="holds") as refused:
        analyze(AnalyzeRequest.model_validate({"machine": machine, "counterweights": fitted}))
    assert refused.value.problems[0].path == ("counterweights", 0, "mass_kg")


@pytest.mark.parametrize(("share", "taken"), [(1.0, True), (1.0 + 1e-13, True), (1.0 + 1e-9, False)])
def test_a_full_plate_is_taken_with_the_rounding_of_its_mass_alone(share: float, taken: bool) -> None:
    request = OptimizeRequest.model_validate(plate_body("segment"))
    cut = plates(request.machine)
    assert cut is not None
    name = request.machine.webs[int(cut.webs[0])].name
    mass = float(cut.mass(cut.most)[0]) * share
    fitted = [{"web": name, "mass_kg": mass, "angle_deg": 0}]
    body = AnalyzeRequest.model_validate({"machine": plate_body("segment")["machine"], "counterweights": fitted})
    if taken:
        assert analyze(body).counterweights[int(cut.webs[0])].mass_kg == mass
    else:
        with pytest.raises(OutOfRange, match="holds"):
            analyze(body)
