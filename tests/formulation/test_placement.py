"""Counterweights at a radius or in a plane of their own: each with a web that has it (analytic)."""

from typing import Any

from optimizer.formulation.placement import on_webs
from schemas.machine.reciprocating import ReciprocatingMachine
from schemas.request.requests import AnalyzeRequest
from tests.optimize.machines import machine, row, throw, web


def _placed(*counterweights: dict[str, Any]) -> AnalyzeRequest:
    shaft = {"name": "back", "speed_ratio": -1, "webs": [web("c", 0.2, 5.0, 0.3)]}
    webs = [web("a", 0.0, 5.0, 0.1), web("counterweight 2", 0.5, 5.0, 0.2)]
    body = machine([throw(0.0, 0.0, [row(90.0, 5.0)])], webs, balance_shafts=[shaft])
    return AnalyzeRequest.model_validate({"machine": body, "counterweights": list(counterweights)})


def _radii(request: AnalyzeRequest) -> dict[str, float]:
    assert isinstance(request.machine, ReciprocatingMachine)
    webs = [*request.machine.webs, *(plane for shaft in request.machine.balance_shafts for plane in shaft.webs)]
    return {plane.name: plane.counterweight_radius_m for plane in webs}


def test_what_is_on_webs_at_their_radii_stays_as_it_is() -> None:
    request = _placed({"web": "a", "mass_kg": 1.0, "angle_deg": 10.0}, {"web": "c", "mass_kg": 1.0, "angle_deg": 0.0})
    assert on_webs(request) is request


def test_a_web_takes_the_radius_of_its_counterweight_on_any_shaft() -> None:
    counterweight, second_counterweight = {"mass_kg": 1.0, "angle_deg": 10.0}, {"mass_kg": 2.0, "angle_deg": 20.0}
    before = {"a": 0.1, "counterweight 2": 0.2, "c": 0.3}
    assert _radii(
        on_webs(_placed({"web": "a", "radius_m": 0.7, **counterweight}, {"web": "c", **second_counterweight}))
    ) == before | {"a": 0.7}
    assert _radii(
        on_webs(_placed({"web": "a", **counterweight}, {"web": "c", "radius_m": 0.8, **second_counterweight}))
    ) == before | {"c": 0.8}


def test_a_plane_of_its_own_is_a_web_with_a_name_that_no_other_has() -> None:
    answer = on_webs(
        _placed(
            {"web": "a", "mass_kg": 1.0, "angle_deg": 10.0},
            {"position_m": 0.9, "radius_m": 0.4, "mass_kg": 2.0, "angle_deg": 20.0},
            {"position_m": 1.1, "radius_m": 0.6, "mass_kg": 3.0, "angle_deg": 30.0},
        )
    )
    names = ["counterweight 2'", "counterweight 3"]
    assert [counterweight.web for counterweight in answer.counterweights] == ["a", *names]
    assert [(plane.name, plane.position_m, plane.counterweight_radius_m) for plane in answer.machine.webs[2:]] == [
        (names[0], 0.9, 0.4),
        (names[1], 1.1, 0.6),
    ]
    assert _radii(answer) == {"a": 0.1, "counterweight 2": 0.2, "c": 0.3, names[0]: 0.4, names[1]: 0.6}
    assert [(counterweight.mass_kg, counterweight.angle_deg) for counterweight in answer.counterweights] == [
        (1.0, 10.0),
        (2.0, 20.0),
        (3.0, 30.0),
    ]
