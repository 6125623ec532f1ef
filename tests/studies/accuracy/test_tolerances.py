"""The ladder where something is off: steps to the worst case, and methods that know no scatter."""

import json
from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np
import pytest
from typer.testing import CliRunner

from optimizer.formulation.task import Task
from optimizer.mechanics.scatter import changed, weighted
from optimizer.optimize import optimize
from optimizer.outputs.registry import prepare
from optimizer.solve.uncertain_program import Robust
from optimizer.studies.accuracy.measure import accuracy
from optimizer.studies.accuracy.uncertain import _steepest
from schemas.request.accuracy import AccuracyAnswer, AccuracyRow
from schemas.request.requests import OptimizeRequest
from service.cli import app
from tests.night import part
from tests.studies.accuracy.problems import body
from tests.studies.accuracy.test_choices import ALIKE, CHOSEN, cut, twin

Post = Callable[..., Any]
COUNTERWEIGHTS, MASSES = {"mass_relative": 0.02, "angle_deg": 2.0}, {"reciprocating_mass_relative": 0.05}
BOTH = {**COUNTERWEIGHTS, "unbalance_kg_m": 0.01, **MASSES}
MAX = {"combine": "max", "direction_weights": {"x": 1.0, "y": 0.3}}
STEPS = ["nominal", "partly_off", "first_order", "corners", "service"]


def measured(machine: dict[str, Any], **more: Any) -> AccuracyAnswer:
    return accuracy({"machine": machine, "repeats": 1, **more})


@cache
def _answer(text: str) -> AccuracyAnswer:
    return accuracy(json.loads(text))


def measured_once(tolerances: dict[str, float]) -> AccuracyAnswer:
    """Of the twin, shared by tests that read an answer."""
    return _answer(json.dumps({"machine": twin(), "tolerances": tolerances, "repeats": 1}))


def by_name(answer: AccuracyAnswer) -> dict[tuple[str, str], AccuracyRow]:
    return {(row.method, row.setting): row for row in answer.ladder}


def turning(**web: Any) -> dict[str, Any]:
    """20 kg that turn at 0.1 m and 10 rad/s, with a web in their plane."""
    throw = {"position_m": 0.0, "crank_radius_m": 0.1, "crank_angle_deg": 0.0, "rotating_mass_kg": 20.0, "rows": []}
    webs = [{"name": "a", "position_m": 0.0, "counterweight_radius_m": 0.1, "max_mass_kg": 100.0, **web}]
    return {"kind": "reciprocating", "speed_rpm": "10 rad/s", "throws": [throw], "webs": webs}


@pytest.mark.parametrize("share", [0.02, 0.5])
def test_a_turning_mass_is_off_by_its_share(share: float) -> None:
    """Analytic: |a - u| + s |u| of a = 2 kg m is least where u = a, and comes to s a omega^2."""
    measurement = measured(turning(), tolerances={"mass_relative": share})
    assert measurement.status == "measured"
    assert measurement.reference is not None
    assert measurement.reference.objective == pytest.approx(200.0 * share, rel=1e-9)
    assert measurement.reference.objective_without_counterweights == pytest.approx(200.0, rel=1e-12)
    nominal = by_name(measurement)["nominal", "nothing off"]
    # it sees nothing of what it comes to
    assert nominal.claim_error == pytest.approx(-share, rel=1e-6)
    assert nominal.certified_gap == pytest.approx(share, rel=1e-6)


@pytest.mark.parametrize("tolerances", part(2, [COUNTERWEIGHTS, MASSES, BOTH]))
@pytest.mark.parametrize("goal", part(2, [{}, MAX]))
def test_the_ladder_stands_on_the_worst_case_of_the_service(tolerances: dict[str, float], goal: dict[str, Any]) -> None:
    """Independent: the smallest worst case and that of the nominal optimum are what /v1/optimize answers."""
    payload = {"machine": body("2d12")["machine"], "tolerances": tolerances, "objective": goal}
    measurement, best = measured(**payload), optimize({**payload, "accuracy": {"relative_gap": 1e-9}})
    assert measurement.status == "measured"
    reference = measurement.reference
    assert reference is not None
    price = best.price_of_robustness
    assert price is not None
    rest, bound = reference.objective_without_counterweights, reference.lower_bound
    assert best.certificate is not None
    assert reference.objective == pytest.approx(best.certificate.objective, rel=1e-8)
    rows = by_name(measurement)
    nominal = rows["nominal", "nothing off"]
    assert nominal.relative_error is not None
    assert nominal.claim_error is not None
    if goal == {}:
        # of the largest of peaks there are many nominal optima
        assert bound + nominal.relative_error * rest == pytest.approx(price.nominal_optimum_worst_case, rel=1e-6)
    claim = bound + (nominal.relative_error + nominal.claim_error) * rest
    assert claim == pytest.approx(price.nominal_optimum, rel=1e-8)
    for row in measurement.ladder:
        if row.skipped is None:
            assert row.relative_error is not None
            assert row.certified_gap is not None
            assert -1e-14 <= row.relative_error <= row.certified_gap + 1e-14, row
    for gap in (1e-3, 1e-6, 1e-9):
        served = rows["service", f"relative gap {gap:.0e}"].certified_gap
        assert served is not None
        assert served <= gap
    # the same by all corners at once (independent)
    exact = rows["cone_program_matrices", "tolerance 1e-10"].relative_error
    assert exact is not None
    assert exact <= 1e-8


def test_rounds_of_corners_close_the_gap() -> None:
    """Property: a step that sees more proves no less, and with all that matters it proves the whole."""
    rows = by_name(measured(body("2d12")["machine"], tolerances=MASSES))
    steps = [rows["nominal", "nothing off"], *(row for (method, _), row in rows.items() if method == "corners")]
    gaps = [row.certified_gap for row in steps]
    assert all(gap is not None for gap in gaps)
    bounds = [row.relative_error - row.certified_gap for row in steps]  # type: ignore[operator]  # just asked for
    assert bounds == sorted(bounds)
    assert bounds[0] < -1e-2 < -1e-9 < bounds[-1]
    # rows of a horizontal machine: the corner by derivatives is the worst one there, and other ones matter elsewhere
    first = rows["first_order", "corners by derivatives"]
    assert first.claim_error is not None
    assert first.claim_error < -1e-3


def test_the_corner_by_derivatives_is_that_by_differences() -> None:
    """Independent: central differences of the peak, mass by mass."""
    request = OptimizeRequest.model_validate({**body("v8-cross-plane"), "tolerances": MASSES, "outputs": []})
    task = Task.of(request)
    worst = Robust(task, prepare(request, ("residual",)), task.demand)
    (machine,), rng = worst.machines, np.random.default_rng(7)
    webs = len(worst.space.machine.webs)
    u = 0.1 * (rng.normal(size=webs) + 1j * rng.normal(size=webs))
    for measure in worst.measures:
        vector, parts = machine.nominal[measure.response].to(u), machine.parts[measure.response]

        def peak(step: np.ndarray, vector: Any = vector, parts: Any = parts, weights: Any = measure[1:]) -> float:
            return float(weighted(vector + changed(parts, step, 1.0), *weights).peak)

        steps = 1e-5 * np.eye(parts.co.size)
        slopes = np.array([peak(step) - peak(-step) for step in steps])
        clear = np.abs(slopes) > 1e-3 * np.abs(slopes).max()
        assert np.any(clear)
        assert _steepest(machine, measure, u)[clear].tolist() == np.sign(slopes)[clear].tolist()


def test_methods_that_know_no_scatter_are_left_out_by_name() -> None:
    """What takes what is off as terms of its program has rows; others say in one row why they have none."""
    rows = measured_once(COUNTERWEIGHTS).ladder
    absent = {row.method: row.skipped for row in rows if row.skipped}
    assert absent.keys() == {"sampled_angles"}
    rows = measured(twin(), tolerances=COUNTERWEIGHTS, objective={"moment_ceiling_Nm": 1e5}).ladder
    absent = {row.method: row.skipped or "" for row in rows if row.skipped}
    assert all(reason.startswith("knows no scatter") for reason in absent.values())
    rivals = {"interior_point", "interior_point_batch", "interior_point_interpreted", "cone_program"}
    assert absent.keys() == {*rivals, "sampled_angles", "polygonal_cones"}
    assert all("ceilings" in absent[name] for name in rivals)
    rows = measured_once(MASSES).ladder
    absent = {row.method: row.skipped or "" for row in rows if row.skipped}
    assert all("several peaks" in absent[name] for name in rivals)
    for row in rows:
        assert row.skipped or row.relative_error is not None
        assert not row.skipped or (row.time_ms is None and not row.on_frontier)


def test_each_step_stands_where_it_says_something() -> None:
    def steps(tolerances: dict[str, float]) -> list[str]:
        answer = measured_once(tolerances)
        return [name for name in dict.fromkeys(row.method for row in answer.ladder) if name in STEPS]

    assert steps(BOTH) == STEPS
    assert steps(MASSES) == ["nominal", "first_order", "corners", "service"]
    assert steps(COUNTERWEIGHTS) == ["nominal", "service"]
    assert steps({"mass_relative": 0.0}) == ["service"]


def test_ceilings_hold_in_the_worst_case() -> None:
    """Property: what is nominally below a ceiling exceeds it where masses are off, and its row says so."""
    # regression: by `/v1/optimize` no counterweights have a smaller moment where masses are off
    most = 1.02 * 1246.65
    measurement = measured(twin(), tolerances=MASSES, objective={"moment_ceiling_Nm": most})
    worst = optimize({"machine": twin(), "tolerances": MASSES, "objective": {"moment_ceiling_Nm": most}})
    assert measurement.status == "measured"
    assert measurement.reference is not None
    assert worst.certificate is not None
    assert measurement.reference.lower_bound == pytest.approx(worst.certificate.lower_bound, rel=1e-5)
    rows = by_name(measurement)
    assert (rows["nominal", "nothing off"].excess or 0.0) > 1e-3
    assert not rows["nominal", "nothing off"].on_frontier
    assert (rows["service", "relative gap 1e-06"].excess or 0.0) <= 1e-9
    assert measured(twin(), tolerances=BOTH, objective={"moment_ceiling_Nm": 1.0}).status == "infeasible"


@pytest.mark.parametrize("kind", part(2, ["a catalogue", "groups", "plates"]))
def test_counterweights_as_they_are_made_are_judged_in_the_worst_case(kind: str) -> None:
    """Independent: the service row is the worst case that /v1/optimize answers, and rounding comes to no less."""
    machine = {"a catalogue": lambda: twin(**CHOSEN), "groups": lambda: twin(**ALIKE), "plates": lambda: cut(twin())}[
        kind
    ]()
    measurement = measured(machine, tolerances=BOTH)
    assert measurement.status == "measured"
    reference = measurement.reference
    assert reference is not None
    best = optimize({"machine": machine, "tolerances": BOTH, "accuracy": {"relative_gap": 1e-2}})
    assert best.worst_case is not None
    assert best.certificate is not None
    row = next(row for row in measurement.choices_ladder if row.setting == "relative gap 1e-02")
    assert row.objective == pytest.approx(best.worst_case.objective, rel=1e-9)
    assert row.lower_bound == pytest.approx(best.certificate.lower_bound, rel=1e-9)
    assert reference.objective_without_counterweights == pytest.approx(
        best.certificate.objective_without_counterweights, rel=1e-9
    )
    rounded = [row for row in measurement.choices_ladder if row.method == "rounding"]
    assert all(row.relative_error is not None and row.relative_error >= 0.0 for row in rounded)
    assert bool(rounded) == (kind != "plates")


def test_a_shaft_at_another_speed_is_off_too() -> None:
    """Property: what balance shafts carry is off by its own share, for the ladder as for the service."""
    from tests.studies.accuracy.test_balance_shafts import SHAFTS

    payload = {"machine": twin(balance_shafts=SHAFTS), "tolerances": BOTH}
    measurement, best = measured(**payload), optimize(payload)
    assert measurement.reference is not None
    assert best.certificate is not None
    near = 1e-6 * measurement.reference.objective_without_counterweights
    assert measurement.reference.objective == pytest.approx(best.certificate.objective, abs=near)


@pytest.mark.parametrize(
    ("changes", "pointer"),
    [
        ({"tolerances": {"mass_relative": -0.1}}, "/tolerances/mass_relative"),
        ({"tolerances": {"mass": 0.1}}, "/tolerances/mass"),
    ],
)
def test_wrong_tolerances_are_refused_by_name(post: Post, changes: dict[str, Any], pointer: str) -> None:
    response = post("/v1/accuracy", json.dumps({"machine": twin(), **changes}))
    assert response.status_code == 422
    assert pointer in [error["pointer"] for error in response.json()["errors"]]


def test_the_command_names_the_worst_case() -> None:
    passage = json.dumps({"machine": twin(), "tolerances": BOTH, "repeats": 1}).encode()
    result = CliRunner().invoke(app, ["accuracy", "-"], input=passage)
    assert result.exit_code == 0
    for text in (
        "smallest worst case",
        "nominal optimum",
        "first order of the",
        "sampled angles, none: knows no scatter",
    ):
        assert text in result.stdout
