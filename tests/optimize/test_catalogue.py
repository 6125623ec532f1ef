"""Counterweights chosen from what there is: what trying every set comes to, what is refused, and what is said."""

import json
from collections.abc import Iterator
from itertools import product
from pathlib import Path
from typing import Any

import pytest
from pydantic import ValidationError

from optimizer.analyze import analyze
from optimizer.errors import OutOfRange
from optimizer.optimize import optimize
from schemas.answer.answers import OptimizeAnswer
from schemas.request.requests import AnalyzeRequest, OptimizeRequest
from tests.optimize.machines import machine, row, throw, web
from tests.verification.checking import optimized, verdict

_V8 = Path(__file__).parents[2] / "examples" / "v8-cross-plane.json"


def twin(webs: list[dict[str, Any]] | None = None, **more: Any) -> dict[str, Any]:
    """Two cranks at right angles, a web on either side of each."""
    throws = [throw(-0.3, 0.0, [row(0.0, 21.0)], rotating=9.0), throw(0.3, 90.0, [row(0.0, 20.0)], rotating=9.0)]
    planes = webs or [web(name, z, 60.0, 0.12) for name, z in zip("abcd", (-0.4, -0.2, 0.2, 0.4), strict=True)]
    return machine(throws, planes, **({"catalogue": {"masses_kg": [3, 7.5, 16], "angle_step_deg": 60}} | more))


def answer(body: dict[str, Any], accuracy: dict[str, Any] | None = None, **objective: Any) -> OptimizeAnswer:
    return optimized({"machine": body, "objective": objective, "accuracy": accuracy or {"time_limit_s": 30}})


def every_set(body: dict[str, Any], angles: list[list[float]]) -> Iterator[tuple[list[tuple[float, float]], Any]]:
    """Every set of masses and angles, and the residual that the analysis finds."""
    masses = body["catalogue"]["masses_kg"]
    values = [[(0.0, 0.0), *product(masses, some)] for some in angles]
    bare = {name: value for name, value in body.items() if name != "catalogue"}
    for some in product(*values):
        fitted = [
            {"web": web["name"], "mass_kg": mass, "angle_deg": angle}
            for web, (mass, angle) in zip(body["webs"], some, strict=True)
            if mass > 0
        ]
        analysis = analyze(AnalyzeRequest.model_validate({"machine": bare, "counterweights": fitted}))
        yield list(some), analysis.residual.after


@pytest.mark.parametrize("combine", ["sum", "max"])
def test_the_best_of_all_sets(combine: str) -> None:
    """Independent: every set, by the analysis of each."""
    body = twin([web("a", -0.4, 60.0, 0.12), web("d", 0.4, 60.0, 0.12)])
    body["catalogue"]["angle_step_deg"] = 90
    optimum = answer(body, combine=combine, force_weight=1.0, moment_weight=2.0)
    values = []
    for _, after in every_set(body, [[0.0, 90.0, 180.0, 270.0]] * 2):
        peaks = after.force.peak_N, 2.0 * after.moment.peak_Nm
        values.append(sum(peaks) if combine == "sum" else max(peaks))
    assert optimum.status == "optimal"
    assert optimum.status_reason.startswith("Proven optimal: of all sets")
    assert optimum.certificate.objective == pytest.approx(min(values), rel=1e-9)
    assert optimum.certificate.lower_bound == pytest.approx(min(values), rel=1e-9)
    assert (optimum.certificate.nodes, optimum.certificate.method) == (0, "exhaustion in halves")
    assert optimum.certificate.continuous_lower_bound <= optimum.certificate.objective
    assert optimum.shadow_prices == ()
    assert optimum.certificate.mass_lower_bound_kg is None


def test_masses_and_angles_are_those_of_the_catalogue() -> None:
    holes = [100.0, 170.0, 260.0]
    body = twin([web("a", -0.4, 60.0, 0.12, hole_angles_deg=holes, catalogue_masses_kg=[4.0, 9.0]), web("d", 0.4, 10)])
    optimum = answer(body, direction_weights={"x": 1.0, "y": 0.4})
    own, counterweight = optimum.counterweights
    assert own.mass_kg in (0.0, 4.0, 9.0)
    assert own.angle_deg in (0.0, *holes)
    # 16 kg do not fit
    assert counterweight.mass_kg in (0.0, 3.0, 7.5)
    assert counterweight.angle_from_crank_deg is None or counterweight.angle_from_crank_deg % 60.0 == pytest.approx(
        0.0, abs=1e-9
    )


def test_counts() -> None:
    free = answer(twin())
    few = answer(twin(max_counterweights=2))
    same = answer(twin(catalogue={"masses_kg": [3, 7.5, 16], "angle_step_deg": 60, "max_part_numbers": 1}))
    assert sum(counterweight.mass_kg > 0 for counterweight in few.counterweights) <= 2
    assert len({counterweight.mass_kg for counterweight in same.counterweights} - {0.0}) <= 1
    assert free.certificate.objective <= min(few.certificate.objective, same.certificate.objective)
    none = answer(twin(max_counterweights=0))
    assert none.total_mass_kg == 0.0
    assert none.certificate.objective == none.certificate.objective_without_counterweights


def test_budget_and_sectors_hold() -> None:
    sector = {"centre_deg": 180, "half_angle_deg": 50}
    webs = [web("a", -0.4, 60.0, 0.12, sector=sector), web("d", 0.4, 60.0, 0.12)]
    optimum = answer(twin(webs, max_total_mass_kg=20.0))
    assert optimum.total_mass_kg <= 20.0
    assert optimum.counterweights[0].angle_deg in (0.0, 180.0)


def test_steps_of_mass() -> None:
    optimum = answer(twin(catalogue={"mass_step_kg": 0.25, "angle_step_deg": 10}), {"relative_gap": 0.05})
    for counterweight in optimum.counterweights:
        assert counterweight.mass_kg * 4.0 == pytest.approx(round(counterweight.mass_kg * 4.0), abs=1e-9)
        assert counterweight.mass_kg <= 60.0
    assert optimum.status == "optimal"
    assert optimum.certificate.relative_gap <= 0.05
    assert optimum.certificate.continuous_lower_bound <= optimum.certificate.lower_bound


def test_the_best_rounded_set_is_not_the_rounded_best() -> None:
    """Independent: the analysis of the optimum with every mass and angle rounded by itself."""
    body = json.loads(_V8.read_text())
    body["machine"]["catalogue"] = {"mass_step_kg": 0.25, "angle_step_deg": 5}
    best = optimized(body | {"accuracy": {"relative_gap": 0.01, "time_limit_s": 30}})
    del body["machine"]["catalogue"]
    smooth = optimize(OptimizeRequest.model_validate(body))
    rounded = [
        {
            "web": counterweight.web,
            "mass_kg": round(4 * counterweight.mass_kg) / 4,
            "angle_deg": 5 * round(counterweight.angle_deg / 5),
        }
        for counterweight in smooth.counterweights
    ]
    by_hand = analyze(AnalyzeRequest.model_validate({"machine": body["machine"], "counterweights": rounded}))
    assert best.status == "optimal"
    assert best.residual.after.moment.peak_Nm * 1.44 < by_hand.residual.after.moment.peak_Nm


def test_ceilings_out_of_reach_of_all_masses_are_proven_by_multipliers() -> None:
    optimum = answer(twin(), force_ceiling_N=1.0)
    assert optimum.status == "infeasible"
    assert optimum.infeasibility.multipliers.conflict is not None


def test_ceilings_that_only_the_catalogue_does_not_keep() -> None:
    smooth = answer({name: value for name, value in twin().items() if name != "catalogue"})
    ceiling = smooth.residual.after.force.peak_N * 1.0001
    optimum = answer(twin(), force_ceiling_N=ceiling, moment_ceiling_Nm=smooth.residual.after.moment.peak_Nm * 1.0001)
    assert optimum.status == "infeasible"
    assert "no set of counterweights keeps the ceilings" in optimum.status_reason
    assert optimum.infeasibility.multipliers.conflict is None
    assert optimum.infeasibility.closest.counterweights[0].mass_kg in (0.0, 3.0, 7.5, 16.0)
    assert optimum.certificate is None


def test_the_gap_is_a_thousandth_where_none_is_said() -> None:
    body = OptimizeRequest.model_validate({"machine": twin(), "accuracy": {"relative_gap": 1e-5}})
    silent = OptimizeRequest.model_validate({"machine": twin(), "accuracy": {"time_limit_s": 2}})
    again = OptimizeRequest.model_validate_json(silent.model_dump_json())
    smooth = {name: value for name, value in twin().items() if name != "catalogue"}
    assert body.accuracy.relative_gap == 1e-5
    assert silent.accuracy.relative_gap == again.accuracy.relative_gap == 1e-3
    assert OptimizeRequest.model_validate({"machine": smooth}).accuracy.relative_gap == 1e-6


def test_a_search_that_runs_out_of_time_says_so() -> None:
    body = twin(catalogue={"mass_step_kg": 0.37, "angle_step_deg": 7.5})
    optimum = answer(body, {"relative_gap": 1e-9, "time_limit_s": 0.01})
    assert optimum.status == "inaccurate"
    assert "time_limit_s" in optimum.status_reason
    proof = optimum.certificate
    assert proof.continuous_lower_bound <= proof.lower_bound <= proof.objective


def test_of_an_ample_choice_it_says_that_nothing_closer_can_be_proven() -> None:
    # any masses reach the floor, which no tree can raise until all sets are compared
    body = twin(catalogue={"mass_step_kg": 0.37, "angle_step_deg": 7.5})
    optimum = answer(body, {"relative_gap": 1e-9, "time_limit_s": 0.01})
    proof = optimum.certificate
    assert (optimum.status, proof.lower_bound) == ("inaccurate", proof.continuous_lower_bound)
    assert "no closer bound was proven" in optimum.status_reason


def test_the_checker_says_that_it_does_not_cover_the_tree() -> None:
    body = {"machine": twin()}
    document = json.loads(optimize(OptimizeRequest.model_validate(body)).model_dump_json())
    assert verdict(body, document) == "not covered"
    document["counterweights"][0]["mass_kg"] = 16.5
    assert verdict(body, document) == "broken"


def test_a_scroll_counts_from_its_eccentric() -> None:
    body = {
        "kind": "scroll", "speed_rpm": 3000, "orbit_radius_m": 0.005, "orbiting_mass_kg": 1, "orbiting_position_m": 0,
        "anti_rotation": {"type": "oldham", "mass_kg": 0.1, "axis_deg": 0, "position_m": 0},
        "webs": [web("w", 0.0, 1.0, 0.03)], "catalogue": {"mass_step_kg": 0.01, "angle_step_deg": 90},
    }  # fmt: skip
    (counterweight,) = answer(body).counterweights
    assert counterweight.angle_deg == 180.0


WEB = {"name": "a", "position_m": 0.0, "counterweight_radius_m": 0.1, "max_mass_kg": 5.0}


@pytest.mark.parametrize(
    ("changes", "web_changes", "path"),
    [
        ({"catalogue": {"masses_kg": [], "angle_step_deg": 10}}, {}, "machine.catalogue.masses_kg"),
        ({"catalogue": {"masses_kg": [0], "angle_step_deg": 10}}, {}, "machine.catalogue.masses_kg"),
        ({"catalogue": {"masses_kg": [2, 3, 2], "angle_step_deg": 10}}, {}, "machine.catalogue.masses_kg.2"),
        ({"catalogue": {"masses_kg": [1], "mass_step_kg": 1}}, {}, "machine.catalogue.mass_step_kg"),
        ({"catalogue": {"masses_kg": [1], "angle_step_deg": 7}}, {}, "machine.catalogue.angle_step_deg"),
        ({"catalogue": {"masses_kg": [1]}}, {}, "machine.webs.0.hole_angles_deg"),
        ({"catalogue": {"angle_step_deg": 10}}, {}, "machine.webs.0.catalogue_masses_kg"),
        ({"max_counterweights": 1}, {}, "machine.webs.0.catalogue_masses_kg"),
        ({"catalogue": {"mass_step_kg": 1, "angle_step_deg": 9}}, {"max_mass_kg": None}, "machine.webs.0.max_mass_kg"),
        ({"catalogue": {"mass_step_kg": 1e-6, "angle_step_deg": 1}}, {}, "machine.webs.0"),
        (
            {"catalogue": {"mass_step_kg": 2.5, "angle_step_deg": 9}},
            {"max_mass_kg": 2.4},
            "machine.catalogue.mass_step_kg",
        ),
        ({}, {"catalogue_masses_kg": [1], "hole_angles_deg": []}, "machine.webs.0.hole_angles_deg"),
        ({}, {"catalogue_masses_kg": [1], "hole_angles_deg": [1, 361]}, "machine.webs.0.hole_angles_deg.1"),
        (
            {},
            {"catalogue_masses_kg": [1], "hole_angles_deg": [1], "sector": {"centre_deg": 90, "half_angle_deg": 5}},
            "machine.webs.0.hole_angles_deg.0",
        ),
    ],
)
def test_refusals_name_the_field(changes: dict[str, Any], web_changes: dict[str, Any], path: str) -> None:
    body = machine([throw(0.0, 0.0, [])], [WEB | web_changes], **changes)
    with pytest.raises(ValidationError) as caught:
        OptimizeRequest.model_validate({"machine": body})
    texts = [
        ".".join(str(part) for part in (*error["loc"], *problem.path) if part != "reciprocating")
        for error in caught.value.errors()
        for problem in error["ctx"]["problems"]
    ]
    assert path in texts


@pytest.mark.parametrize("field", ["mass_step_kg", "angle_step_deg"])
@pytest.mark.parametrize("step", [0, -1])
def test_steps_are_above_nothing(field: str, step: float) -> None:
    catalogue = {"masses_kg": [1], "angle_step_deg": 10} | {field: step}
    with pytest.raises(ValidationError) as caught:
        OptimizeRequest.model_validate({"machine": machine([throw(0.0, 0.0, [])], [WEB], catalogue=catalogue)})
    assert any(field in error["loc"] for error in caught.value.errors())


def test_a_negative_mass_is_refused() -> None:
    catalogue = {"masses_kg": [1, -1], "angle_step_deg": 10}
    with pytest.raises(ValidationError) as caught:
        OptimizeRequest.model_validate({"machine": machine([throw(0.0, 0.0, [])], [WEB], catalogue=catalogue)})
    assert [error["loc"][-3:] for error in caught.value.errors()] == [("catalogue", "masses_kg", 1)]


def test_steps_of_angle_need_a_crank_and_a_place_in_the_sector() -> None:
    between = machine(
        [throw(-0.1, 0.0, []), throw(0.1, 90.0, [])], [WEB], catalogue={"masses_kg": [1], "angle_step_deg": 90}
    )
    with pytest.raises(OutOfRange) as caught:
        optimize(OptimizeRequest.model_validate({"machine": between}))
    assert [problem.path for problem in caught.value.problems] == [("machine", "webs", 0, "throw")]
    narrow = WEB | {"throw": 0, "sector": {"centre_deg": 45, "half_angle_deg": 5}}
    with pytest.raises(OutOfRange) as caught:
        optimize(OptimizeRequest.model_validate({"machine": between | {"webs": [narrow]}}))
    assert [problem.path for problem in caught.value.problems] == [("machine", "webs", 0, "sector")]


def test_what_does_not_go_with_a_catalogue() -> None:
    body = {"machine": twin(), "tolerances": {"mass_relative": 0.01}, "objective": {"force_ceiling_N": 1e5}}
    with pytest.raises(ValidationError) as caught:
        OptimizeRequest.model_validate(body)
    problems = [tuple(problem.path) for error in caught.value.errors() for problem in error["ctx"]["problems"]]
    assert ("tolerances", "mass_relative") in problems


@pytest.mark.parametrize("time_limit_s", [1e-9, 30.0])
def test_nothing_to_choose_for(time_limit_s: float) -> None:
    bare = machine(twin()["throws"], [], catalogue={"masses_kg": [3], "angle_step_deg": 60})
    optimum = answer(bare, {"time_limit_s": time_limit_s})
    assert (optimum.status, optimum.counterweights, optimum.total_mass_kg) == ("optimal", (), 0.0)


@pytest.mark.parametrize("over", [0.0, 2e-16])
def test_a_budget_is_kept_to_the_rounding_of_the_masses(over: float) -> None:
    web_a = web("a", 0.0, 60.0, 0.12, hole_angles_deg=[40.0])
    body = machine(
        [throw(0.0, 220.0, [], rotating=10.0)],
        [web_a],
        catalogue={"masses_kg": [0.5, 1.0 + over]},
        max_total_mass_kg=1.0,
    )
    assert answer(body).total_mass_kg == 1.0 + over
    # more than that is above the budget, and what it reaches below what any counterweights within it can
    body["catalogue"]["masses_kg"] = [0.5, 1.0 + 5e-13]
    assert answer(body).total_mass_kg == 0.5


@pytest.mark.parametrize("centre", [0.0, 33.3, 271.7, -725.1])
def test_a_hole_at_the_edge_of_its_sector(centre: float) -> None:
    held = {"sector": {"centre_deg": centre, "half_angle_deg": 30.1}}
    crank = [throw(0.0, centre + 220.0, [], rotating=10.0)]
    for turns in (0.0, 360.0, -1080.0):
        hole = web("a", 0.0, 5.0, 0.12, hole_angles_deg=[centre + 30.1 + turns], **held)
        optimum = answer(machine(crank, [hole], catalogue={"masses_kg": [5.0]}))
        # analytic: it is where counterweights of any angle would be, so that the bound is what is reached
        assert optimum.status == "optimal"
        assert optimum.certificate.continuous_lower_bound == pytest.approx(optimum.certificate.objective, rel=1e-6)
    beyond = web("a", 0.0, 5.0, 0.12, hole_angles_deg=[centre + 30.1 + 1e-9], **held)
    with pytest.raises(ValidationError, match="outside the sector"):
        answer(machine(crank, [beyond], catalogue={"masses_kg": [5.0]}))
