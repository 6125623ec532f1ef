"""Requests at the edges of what the schema accepts are answered like any other."""

import random
from itertools import product
from typing import Any

import pytest

from optimizer.studies.pareto.pareto import pareto
from optimizer.studies.sweep import run_chunk
from schemas.front.pareto import ParetoRequest
from tests.hard.bodies import checked, drawn, strictly, tried
from tests.hard.cases.case import Body, four_webs, machine, row, throw, v_twin, web
from tests.hard.random_bodies import body
from tests.hard.random_features import FEATURES
from tests.night import part
from tests.pairs.asking import body_of
from tests.studies.sweep.single import sweep
from tests.verification.checking import optimized


def _without_influence(ceiling: float) -> Body:
    """The only web is in the plane of moments: it does nothing to the moment, which alone counts."""
    throws = [throw(-0.2, 0.0, [row(0.0, 10.0)]), throw(0.2, 90.0, [row(0.0, 10.0)])]
    objective = {"force_weight": 0, "moment_weight": 1, "moment_ceiling_Nm": ceiling}
    return {"machine": machine(throws, [web("middle", 0.0)]), "objective": objective}


@pytest.mark.parametrize(("ceiling", "status"), [(1.0, "infeasible"), (1e9, "optimal"), (0.0, "infeasible")])
def test_a_web_that_does_nothing_to_what_counts(ceiling: float, status: str) -> None:
    body = _without_influence(ceiling)
    answer = optimized(body)
    assert answer.status == status
    request = sweep(body, {"path": "/machine/speed_rpm", "values": [body["machine"]["speed_rpm"]]})
    assert run_chunk(request.model_dump_json().encode(), 0, 1).to_pylist()[0]["status"] == status
    assert pareto(ParetoRequest.model_validate(body | {"points": 3})).status == status


@pytest.mark.parametrize("weights", [(1e-30, 1e25), (1e25, 1e-30), (1e-30, 1e-30), (1e30, 1e30), (1e-30, 1e30)])
@pytest.mark.parametrize("combine", ["sum", "max"])
def test_weights_of_every_size(weights: tuple[float, float], combine: str) -> None:
    goal = {"force_weight": weights[0], "moment_weight": weights[1], "combine": combine}
    answer = optimized({"machine": machine(v_twin(), four_webs()), "objective": goal})
    assert answer.status == "optimal"


@pytest.mark.parametrize(
    "number", [*part(3, range(60)), *(pytest.param(n, marks=pytest.mark.nightly) for n in range(60, 200))]
)
def test_random_bodies_raise_nothing(number: int) -> None:
    tried(number)


#: small enough to be answered long before the time is over; no webs to choose for, plates without a least mass, a
#: conflict that is proven for less than peaks by themselves could need
_SMALL = [*product(FEATURES, (5, 6, 8, 9, 12)), ("catalogue", 21), ("plates", 232), ("balance shafts", 310)]


@pytest.mark.parametrize(("feature", "number"), part(4, _SMALL, rows=True))
def test_random_bodies_with_a_feature_raise_nothing(feature: str, number: int) -> None:
    drawing = drawn(number, 0, feature)
    if "parts" not in drawing:
        drawing["accuracy"]["time_limit_s"] = 30.0
    strictly(lambda: checked(drawing))


@pytest.mark.parametrize("number", [228, 345, 610, 1124, 1840, 3366])
def test_what_the_checker_once_refuted(number: int) -> None:
    # a price of the budget below a gain, a conflict proven for less than the reach (of both ceilings, and where one
    # alone is out of reach), a ceiling of 0 on nothing
    optimized(body(random.Random(f"0/{number}")))


def _with_masses(node: Any, factor: float) -> Any:
    """The same with all masses, and what is limited in newtons, times a factor."""
    if isinstance(node, list):
        return [_with_masses(value, factor) for value in node]
    if not isinstance(node, dict):
        return node
    units = ("_kg", "_N", "_Nm")
    return {
        name: value * factor if isinstance(value, float | int) and name.endswith(units) else _with_masses(value, factor)
        for name, value in node.items()
    }


@pytest.mark.parametrize(
    "features",
    [("bearings alone", "orders all"), ("combine max", "orders all"), ("bearing_ceiling_N slack", "priorities")],
)
def test_a_machine_of_any_masses_over_a_revolution(features: tuple[str, ...]) -> None:
    """Regression, analytic: widths of what has no part in a goal overflowed; forces are as many times larger."""
    body, factor = body_of("vee", features, 1.0), 2.0**40
    answers = [optimized(body), optimized(_with_masses(body, factor))]
    assert [answer.status for answer in answers] == ["optimal"] * 2
    small, large = (answer.certificate.objective for answer in answers if answer.certificate is not None)
    assert large == pytest.approx(factor * small, rel=1e-5)
