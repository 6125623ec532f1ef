"""The order for a workshop: sizes, pieces, places, angles from own cranks, tolerances."""

import json
from pathlib import Path
from typing import Any

import pytest

from optimizer.errors import OutOfRange
from optimizer.optimize import optimize
from schemas.request.requests import OptimizeRequest
from service.report.chapters.answers import optimized
from service.tables.as_built import ALLOWANCE
from service.tables.tables import order

TWIN = json.loads((Path(__file__).parents[2] / "examples/catalogue-twin.json").read_bytes())


def twin_request(**machine: Any) -> OptimizeRequest:
    return OptimizeRequest.model_validate({"machine": {**TWIN["machine"], **machine}})


def test_castings_by_size() -> None:
    """Independent: every casting of the answer, counted here; tolerances from the sensitivity."""
    request = twin_request()
    answer = optimize(request)
    head, *lines = order(request)
    assert head[:2] == ["size, kg", "of this size"]
    fitted = {counterweight.web: counterweight for counterweight in answer.counterweights if counterweight.mass_kg > 0}
    assert {line[3] for line in lines} == set(fitted)
    masses = [float(str(line[0])) for line in lines]
    assert masses == sorted(masses, reverse=True)
    assert answer.sensitivity is not None
    assert answer.certificate is not None
    room = ALLOWANCE * answer.certificate.yardstick
    share = min(room / answer.sensitivity.objective_rise_per_percent, 1.0) / 100
    for mass, pieces, radius, web, from_crank, drawn, off, turned in lines:
        weight = fitted[str(web)]
        assert (mass, radius, from_crank, drawn) == (
            weight.mass_kg,
            weight.radius_m,
            weight.angle_from_crank_deg,
            weight.angle_deg,
        )
        assert pieces == sum(
            counterweight.mass_kg == mass and counterweight.radius_m == radius for counterweight in fitted.values()
        )
        assert off == pytest.approx(share * weight.mass_kg)
        assert turned is not None
    titles = [chapter.title for chapter in optimized(request, answer)]
    assert "Order for the workshop" in titles


def test_pieces_of_balance_shafts_are_made_too() -> None:
    place = {"name": "s", "position_m": 0.0, "counterweight_radius_m": 0.05, "max_mass_kg": 30.0}
    request = twin_request(balance_shafts=[{"name": "back", "speed_ratio": -1, "webs": [place]}])
    _, *lines = order(request)
    (line,) = (line for line in lines if line[3] == "s")
    (shaft,) = optimize(request).balance_shafts
    # of a shaft there is no crank to count from
    assert line[0] == pytest.approx(shaft.counterweights[0].mass_kg, rel=1e-6)
    assert line[4] is None


def test_where_there_is_nothing_to_order_it_is_refused() -> None:
    with pytest.raises(OutOfRange, match="nothing to order"):
        order(twin_request(max_counterweights=0))
