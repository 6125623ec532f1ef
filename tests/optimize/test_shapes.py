"""Counterweights that are cut from a plate, from the request to the answer."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from optimizer.analyze import analyze
from optimizer.optimize import optimize
from optimizer.program.verdict import MASS_GAP, NOT_LIGHT
from optimizer.solve import plates as certified_shapes
from schemas.answer.answers import OptimizeAnswer
from schemas.request.report import ReportRequest
from schemas.request.requests import AnalyzeRequest, OptimizeRequest
from service.documents.examples import bodies
from service.report.document import report
from service.report.html import html
from tests.verification.answers import pair

PLATE = {"inner_radius_m": 0.08, "outer_radius_m": 0.32, "thickness_m": 0.06, "max_half_angle_deg": 75}
SHAPES = ("sector", "segment")


def plate_body(shape: str, **plate: float) -> dict[str, Any]:
    """The 2D12 with plates in place of its radii and masses."""
    body: dict[str, Any] = bodies()["2d12"]
    for web in body["machine"]["webs"]:
        del web["counterweight_radius_m"], web["max_mass_kg"]
        web["envelope"] = {"shape": shape, **PLATE, **plate}
    return body


def answered(body: dict[str, Any]) -> OptimizeAnswer:
    return optimize(OptimizeRequest.model_validate(body))


def single_throw(rotating: float, envelope: dict[str, Any]) -> dict[str, Any]:
    throw = {"position_m": 0, "crank_radius_m": 0.1, "crank_angle_deg": 30, "rotating_mass_kg": rotating}
    web = {"name": "a", "position_m": 0, "envelope": envelope}
    return {"machine": {"kind": "reciprocating", "speed_rpm": 1000, "throws": [throw], "webs": [web]}}


def test_one_web_that_balances_one_crank() -> None:
    plate = {"outer_radius_m": 0.2, "thickness_m": 0.03, "density_kg_m3": 7850}
    areal = 0.03 * 7850
    # analytic: U = m r = 2/3 rho t R^3 sin a, m = rho t R^2 a
    answer = answered(single_throw(5.0, {"shape": "sector", **plate}))
    half = np.arcsin(0.5 / (2.0 / 3.0 * areal * 0.2**3))
    (counterweight,) = answer.counterweights
    assert answer.status == "optimal"
    assert counterweight.mass_kg == pytest.approx(areal * 0.2**2 * half, rel=1e-5)
    assert counterweight.shape is not None
    assert counterweight.shape.half_angle_deg == pytest.approx(np.rad2deg(half), rel=1e-5)
    assert (counterweight.shape.chord_height_m, counterweight.angle_deg) == (None, pytest.approx(210.0))
    # analytic: sin^3 a = U / (2/3 rho t R^3), m = rho t R^2 (a - sin a cos a), chord at R cos a
    optimum = answered(single_throw(5.0, {"shape": "segment", **plate}))
    half = np.arcsin(np.cbrt(0.5 / (2.0 / 3.0 * areal * 0.2**3)))
    (weight,) = optimum.counterweights
    assert optimum.status == "optimal"
    assert weight.mass_kg == pytest.approx(areal * 0.2**2 * (half - np.sin(half) * np.cos(half)), rel=1e-5)
    assert weight.shape is not None
    assert weight.shape.chord_height_m == pytest.approx(0.2 * np.cos(half), rel=1e-5)
    assert weight.mass_radius_kg_m == pytest.approx(0.5, rel=1e-6)


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("plate", [{}, {"thickness_m": 0.2}, {"max_half_angle_deg": 90}, {"inner_radius_m": 0.0}])
def test_the_smallest_objective_is_that_of_the_same_reach(shape: str, plate: dict[str, float]) -> None:
    # independent: in the first stage a plate is how far its unbalance reaches, whatever it weighs
    answer = answered(plate_body(shape, **plate))
    body = bodies()["2d12"]
    size = {**PLATE, **plate}
    whole = 2 / 3 * size["thickness_m"] * 7850 * (size["outer_radius_m"] ** 3 - size["inner_radius_m"] ** 3)
    if shape == "sector":
        whole *= np.sin(np.deg2rad(size["max_half_angle_deg"]))
    else:
        height = size["outer_radius_m"] * np.cos(np.deg2rad(size["max_half_angle_deg"]))
        hub = max(size["inner_radius_m"] ** 2 - height**2, 0.0) ** 1.5
        whole = 2 / 3 * size["thickness_m"] * 7850 * ((size["outer_radius_m"] ** 2 - height**2) ** 1.5 - hub)
    for web in body["machine"]["webs"]:
        web["max_mass_kg"] = whole / web["counterweight_radius_m"]
    plain = answered(body)
    assert answer.status == plain.status == "optimal"
    assert answer.certificate is not None
    assert plain.certificate is not None
    assert answer.certificate.lower_bound == pytest.approx(plain.certificate.lower_bound, rel=1e-6)


def test_a_segment_is_no_heavier_than_a_sector() -> None:
    sector, segment = (answered(plate_body(shape)) for shape in SHAPES)
    assert segment.total_mass_kg is not None
    assert sector.total_mass_kg is not None
    assert segment.total_mass_kg < sector.total_mass_kg


@settings(max_examples=12)
@given(
    st.sampled_from(SHAPES), st.floats(0.01, 0.3), st.floats(30.0, 90.0), st.floats(0.0, 0.9), st.integers(0, 2**32 - 1)
)
def test_nothing_lighter_does_as_well(shape: str, thickness: float, half: float, inner: float, seed: int) -> None:
    # independent: random counterweights about those that were found, by analyze
    body = plate_body(shape, thickness_m=thickness, max_half_angle_deg=half, inner_radius_m=inner * 0.32)
    answer = answered(body)
    assert answer.status == "optimal"
    proof = answer.certificate
    assert proof is not None
    assert proof.mass_lower_bound_kg is not None
    assert proof.mass_objective_limit is not None
    random = np.random.default_rng(seed)
    for scale in (1e-6, 1e-4, 1e-2):
        fitted = [
            {
                "web": counterweight.web,
                "mass_kg": counterweight.mass_kg * (1.0 - scale * random.uniform()),
                "angle_deg": counterweight.angle_deg + 10 * scale * random.normal(),
            }
            for counterweight in answer.counterweights
        ]
        analysis = analyze(AnalyzeRequest.model_validate({"machine": body["machine"], "counterweights": fitted}))
        assert analysis.residual is not None
        assert analysis.residual.after is not None
        after = analysis.residual.after
        span = 0.28 * 2
        objective = after.force.peak_N + after.moment.peak_Nm / span
        lighter = analysis.total_mass_kg < proof.mass_lower_bound_kg * (1.0 - 1e-9)
        assert not (lighter and objective < proof.mass_objective_limit * (1.0 - 1e-9))


@pytest.mark.parametrize("shape", SHAPES)
def test_what_is_answered_is_what_analyze_finds(shape: str) -> None:
    body = plate_body(shape)
    answer = answered(body)
    fitted = [
        {"web": counterweight.web, "mass_kg": counterweight.mass_kg, "angle_deg": counterweight.angle_deg}
        for counterweight in answer.counterweights
    ]
    again = analyze(AnalyzeRequest.model_validate({"machine": body["machine"], "counterweights": fitted}))
    assert again.residual is not None
    assert again.residual.after is not None
    assert answer.residual.after is not None
    assert again.residual.after.force.peak_N == pytest.approx(answer.residual.after.force.peak_N, rel=1e-6)
    assert again.residual.after.moment.peak_Nm == pytest.approx(answer.residual.after.moment.peak_Nm, rel=1e-6)
    for first_counterweight, second_counterweight in zip(answer.counterweights, again.counterweights, strict=True):
        assert second_counterweight.radius_m == pytest.approx(first_counterweight.radius_m, rel=1e-6)


@pytest.mark.parametrize("shape", SHAPES)
def test_a_budget_counts_what_is_cut(shape: str) -> None:
    body = plate_body(shape)
    free = answered(body)
    assert free.total_mass_kg is not None
    body["machine"]["max_total_mass_kg"] = 0.7 * free.total_mass_kg
    answer = answered(body)
    assert answer.status == "optimal"
    assert answer.total_mass_kg == pytest.approx(0.7 * free.total_mass_kg, rel=1e-4)
    assert answer.active_limits == ("max_total_mass",)
    assert answer.certificate is not None
    assert free.certificate is not None
    assert answer.certificate.objective > free.certificate.objective * 1.01


def test_of_a_budget_of_nothing_nothing_is_cut() -> None:
    body = plate_body(SHAPES[0])
    body["machine"]["max_total_mass_kg"] = 0.0
    answer = answered(body)
    assert (answer.status, answer.total_mass_kg) == ("optimal", 0.0)
    # independent: what the first kilogram takes off the objective
    body["machine"]["max_total_mass_kg"] = 1.0
    first = answered(body)
    assert answer.certificate is not None
    assert first.certificate is not None
    (price,) = answer.shadow_prices
    assert price.value == pytest.approx(answer.certificate.objective - first.certificate.objective, rel=1e-3)


@pytest.mark.parametrize("share", [0.1, 0.4, 0.8])
@pytest.mark.parametrize("shape", SHAPES)
def test_the_mass_is_proven_for_what_a_budget_lets_plates_reach(
    shape: str, share: float, caplog: pytest.LogCaptureFixture
) -> None:
    body = plate_body(shape, inner_radius_m=0.0)
    body["machine"]["max_total_mass_kg"] = 100.0 * share
    answer = answered(body)
    assert answer.status == "optimal"
    assert not caplog.records
    proof = answer.certificate
    assert proof is not None
    assert proof.mass_objective_limit is not None
    assert proof.objective <= proof.mass_objective_limit


@pytest.mark.parametrize("shape", SHAPES)
def test_what_a_thicker_plate_would_gain(shape: str) -> None:
    # analytic: the unbalance that a plate holds grows with its thickness; central differences of certified objectives
    answer = answered(plate_body(shape, thickness_m=0.03))
    prices = {price.web: price.value for price in answer.shadow_prices if price.limit == "envelope"}
    held = {
        counterweight.web: counterweight.mass_radius_kg_m
        for counterweight in answer.counterweights
        if "envelope" in counterweight.active_limits
    }
    assert set(prices) == set(held)
    assert len(held) >= 2
    objectives = []
    for share in (0.99, 1.01):
        proof = answered(plate_body(shape, thickness_m=0.03 * share)).certificate
        assert proof is not None
        objectives.append(proof.objective)
    gained = sum(prices[web] * held[web] * 0.02 for web in held)
    assert objectives[0] - objectives[1] == pytest.approx(gained, rel=2e-3)


@pytest.mark.parametrize("thickness", [0.03, 0.06])
@pytest.mark.parametrize("shape", SHAPES)
def test_plates_that_are_all_but_full_are_full_and_alike(shape: str, thickness: float) -> None:
    # three of the four pull at their limits; the least mass would leave one a hundredth of a degree short
    answer = answered(plate_body(shape, thickness_m=thickness))
    full = [counterweight for counterweight in answer.counterweights if "envelope" in counterweight.active_limits]
    assert answer.status == "optimal"
    assert len(full) == 3
    assert [counterweight.shape.half_angle_deg for counterweight in full if counterweight.shape] == pytest.approx(
        [75.0] * 3, abs=1e-12
    )
    assert len({counterweight.mass_kg for counterweight in full}) == 1


def test_plates_may_all_be_alike_so_that_none_is_left_to_choose() -> None:
    answer = answered({**bodies("drawings")["2d12-plates"], "objective": {"combine": "max"}})
    assert answer.status == "optimal"


def test_plates_that_cannot_be_alike_within_what_is_certified_stay_apart() -> None:
    # analytic: the last degrees before 90 weigh without pulling; all alike would be 4e-4 heavier
    answer = answered(plate_body("sector", max_half_angle_deg=90))
    assert answer.status == "optimal"
    assert answer.certificate is not None
    assert answer.certificate.mass_relative_gap is not None
    assert answer.certificate.mass_relative_gap < 1e-4


@pytest.mark.parametrize("name", ["plate-single", "drawings/2d12-plates"])
def test_the_guess_is_near_enough_for_one_round(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    rounds = _counted(monkeypatch, "optima")
    folder, _, example = name.rpartition("/")
    answer = answered(bodies(folder)[example] if folder else bodies()[example])
    assert (answer.status, len(rounds)) == ("optimal", 1)
    assert answer.certificate is not None
    assert answer.certificate.mass_relative_gap is not None
    assert answer.certificate.mass_relative_gap < 1e-5


def test_rounds_that_cannot_be_the_least_mass_are_not_judged(monkeypatch: pytest.MonkeyPatch) -> None:
    rounds, judged = _counted(monkeypatch, "optima"), _counted(monkeypatch, "judgement")
    monkeypatch.setattr(certified_shapes, "guessed", lambda *arguments: None)
    assert answered(bodies()["plate-single"]).status == "optimal"
    assert len(rounds) > len(judged) == 1
    # if it ends there what was found is judged nevertheless, and is the answer
    monkeypatch.setattr(certified_shapes, "_ROUNDS", 1)
    answer = answered(bodies()["plate-single"])
    assert (answer.status, answer.status_reason) == ("inaccurate", NOT_LIGHT)
    assert answer.certificate is not None
    assert answer.certificate.mass_relative_gap is not None
    assert 2 * MASS_GAP < answer.certificate.mass_relative_gap < 0.1


def _counted(monkeypatch: pytest.MonkeyPatch, name: str) -> list[str]:
    """A name for every call of a function from now on."""
    calls: list[str] = []
    function = getattr(certified_shapes, name)
    monkeypatch.setattr(certified_shapes, name, lambda *arguments: calls.append(name) or function(*arguments))
    return calls


def test_ceilings_that_plates_cannot_keep() -> None:
    body = plate_body("segment")
    body["objective"] = {"moment_ceiling_Nm": 10.0}
    answer = answered(body)
    assert answer.status == "infeasible"
    assert answer.infeasibility is not None
    assert answer.infeasibility.conflict == ("moment_ceiling_Nm",)


def test_a_report_shows_the_plates() -> None:
    document = html(report(ReportRequest.model_validate(plate_body("segment")))).decode()
    assert "segment, radii" in document


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize(
    "plate",
    [
        {"outer_radius_m": 1000, "thickness_m": 100, "inner_radius_m": 0},
        {"outer_radius_m": 1e-4, "thickness_m": 1e-5, "inner_radius_m": 0, "max_half_angle_deg": 0.1},
        {"inner_radius_m": 0.3196, "max_half_angle_deg": 90},
    ],
)
def test_plates_at_the_ends_of_what_is_taken(
    shape: str, plate: dict[str, float], caplog: pytest.LogCaptureFixture
) -> None:
    assert answered(plate_body(shape, **plate)).status == "optimal"
    # no bound was above a value on the way
    assert not caplog.records


def test_the_price_of_a_budget_is_its_slope_and_proves_the_bound() -> None:
    """Independent: the difference of certified optima; one more kilogram is added at the edges of the plates."""
    body, answer = pair("plates, segments, budget")

    def objective(budget_kg: float) -> float:
        request = {**body, "machine": {**body["machine"], "max_total_mass_kg": budget_kg}}
        certificate = optimize(OptimizeRequest.model_validate(request)).certificate
        assert certificate is not None
        return certificate.objective

    budget, step = body["machine"]["max_total_mass_kg"], 0.02
    slope = (objective(budget - step) - objective(budget + step)) / (2 * step)
    (price,) = [
        shadow_price["value"] for shadow_price in answer["shadow_prices"] if shadow_price["limit"] == "max_total_mass"
    ]
    assert price == pytest.approx(slope, rel=1e-4)
    assert answer["certificate"]["multipliers"]["objective"]["budget"] == pytest.approx(slope, rel=1e-4)
