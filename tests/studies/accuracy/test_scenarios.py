"""The ladder of several machines that one set of counterweights is to suit, with tolerances or without."""

import json
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from typer.testing import CliRunner

from optimizer.optimize import optimize
from optimizer.studies.accuracy import measure, uncertain
from optimizer.studies.accuracy.measure import accuracy
from schemas.request.accuracy import AccuracyAnswer
from service.cli import app
from tests.night import part
from tests.studies.accuracy.problems import body
from tests.studies.accuracy.test_choices import ALIKE, CHOSEN, cut, twin
from tests.studies.accuracy.test_tolerances import BOTH, COUNTERWEIGHTS, MASSES, MAX, by_name, measured, turning

Post = Callable[..., Any]


def several(machine: dict[str, Any]) -> list[dict[str, Any]]:
    """The unchanged machine, one that is faster with a heavier row, and a light one that decides nothing."""
    mass = machine["throws"][0]["rows"][0]["reciprocating_mass_kg"]
    row = "/machine/throws/0/rows/0/reciprocating_mass_kg"
    faster = {"path": "/machine/speed_rpm", "value": 1.1 * machine["speed_rpm"]}
    return [
        {"name": "as it is"},
        {"name": "fast", "weight": 0.6, "changes": [faster, {"path": row, "value": 1.3 * mass}]},
        {"name": "light", "weight": 0.5, "changes": [{"path": row, "value": 0.7 * mass}]},
    ]


def _speeds(*factors: float) -> list[dict[str, Any]]:
    return [
        {"name": f"x{n}", "changes": [{"path": "/machine/throws/0/rotating_mass_kg", "value": 20.0 * factor}]}
        for n, factor in enumerate(factors)
    ]


def test_between_two_turning_masses_each_is_off_by_half() -> None:
    """Analytic: with a = 2 kg m |a - u| and |3a - u| are least in the middle, a omega^2; alone each is 0."""
    measurement = measured(turning(), scenarios=_speeds(1.0, 3.0))
    assert measurement.status == "measured"
    assert measurement.reference is not None
    assert measurement.reference.objective == pytest.approx(200.0, rel=1e-9)
    assert measurement.reference.objective_without_counterweights == pytest.approx(600.0, rel=1e-12)
    rows = by_name(measurement)
    for setting in ("scenario x0", "scenario x1"):
        # it sees 0, and comes to the difference of both in the other
        assert rows["one_scenario", setting].claim_error == pytest.approx(-2.0 / 3.0, rel=1e-6)
        assert rows["one_scenario", setting].certified_gap == pytest.approx(2.0 / 3.0, rel=1e-6)
    # the round that knows the heavy one alone, then both
    assert rows["worst_scenarios", "1 round"].relative_error == pytest.approx(1.0 / 3.0, rel=1e-6)
    assert rows["worst_scenarios", "2 rounds"].certified_gap == pytest.approx(0.0, abs=1e-9)


def test_the_nominal_optimum_proves_nothing_beside_scenarios() -> None:
    """Analytic: the unchanged machine is none of two heavier ones, and its optimum may be above theirs."""
    measurement = measured(turning(max_mass_kg=5.0), scenarios=_speeds(0.1, 0.2))
    nominal = by_name(measurement)["nominal", "nothing off"]
    assert nominal.claim_error is not None
    # it promises 150 N where 30 can be had without any counterweight in the worst scenario
    assert nominal.claim_error > 0.0
    assert nominal.certified_gap is None
    assert measurement.status == "measured"


@pytest.mark.parametrize("tolerances", part(2, [None, COUNTERWEIGHTS, MASSES, BOTH]))
@pytest.mark.parametrize("goal", part(2, [{}, MAX]))
def test_the_ladder_stands_on_the_worst_scenario_of_the_service(
    tolerances: dict[str, float] | None, goal: dict[str, Any]
) -> None:
    """Independent: the smallest worst case is what /v1/optimize answers, and clarabel finds it from all corners."""
    machine = body("2d12")["machine"]
    payload = {"machine": machine, "scenarios": several(machine), "tolerances": tolerances, "objective": goal}
    measurement, best = measured(**payload), optimize({**payload, "accuracy": {"relative_gap": 1e-9}})
    assert measurement.status == "measured"
    reference = measurement.reference
    assert reference is not None
    assert best.certificate is not None
    assert reference.objective == pytest.approx(best.certificate.objective, rel=1e-8)
    assert reference.objective_without_counterweights == pytest.approx(
        best.certificate.objective_without_counterweights, rel=1e-9
    )
    rows = by_name(measurement)
    for row in measurement.ladder:
        if row.skipped is None:
            assert row.relative_error is not None
            assert row.relative_error >= -1e-14, row
            assert row.certified_gap is None or row.certified_gap >= row.relative_error - 1e-14
    for gap in (1e-3, 1e-6, 1e-9):
        served = rows["service", f"relative gap {gap:.0e}"].certified_gap
        assert served is not None
        assert served <= gap
    exact = rows["cone_program_matrices", "tolerance 1e-10"]
    assert exact.relative_error is not None
    assert exact.relative_error <= 1e-8
    assert exact.certified_gap is not None
    assert exact.certified_gap <= 1e-8


def test_each_step_of_scenarios_stands_where_it_says_something() -> None:
    def steps(scenarios: list[dict[str, Any]], tolerances: dict[str, float] | None = None) -> list[str]:
        answer = measured(twin(), scenarios=scenarios, tolerances=tolerances)
        names = dict.fromkeys(row.method for row in answer.ladder if row.skipped is None)
        own = ("nominal", "one_scenario", "worst_scenarios", "partly_off", "first_order", "corners", "service")
        return [name for name in names if name in own]

    three = several(twin())
    assert steps(three[:1]) == ["nominal", "service"]
    assert steps(three) == ["nominal", "one_scenario", "worst_scenarios", "service"]
    assert steps(three, COUNTERWEIGHTS) == ["nominal", "one_scenario", "worst_scenarios", "partly_off", "service"]
    everything = ["nominal", "one_scenario", "worst_scenarios", "partly_off", "first_order", "corners", "service"]
    assert steps(three, MASSES) == everything


def test_methods_that_know_no_scenarios_are_left_out_by_name() -> None:
    """Without scatter the largest of several sums is a program of most methods; those of angles see one machine."""
    rows = measured(twin(), scenarios=several(twin())[:2]).ladder
    absent = {row.method: row.skipped or "" for row in rows if row.skipped}
    assert absent.keys() == {"sampled_angles"}
    assert "knows no scenarios" in absent["sampled_angles"]
    exact = [
        row for row in rows if row.method in ("interior_point", "cone_program") and row.setting.endswith(("9", "10"))
    ]
    assert len(exact) == 2
    assert all(row.relative_error is not None and row.relative_error <= 1e-8 for row in exact)


def test_sums_of_too_many_rows_are_a_row_that_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    """Property: the judge goes without a row for each corner with each other one, and so does the service."""
    monkeypatch.setattr("optimizer.studies.accuracy.judge.MANY", 3)
    measurement = measured(twin(), scenarios=several(twin()), tolerances=MASSES)
    assert measurement.status == "measured"
    absent = {row.method: row.skipped or "" for row in measurement.ladder if row.skipped}
    assert absent["cone_program_matrices"].startswith("too large")
    served = by_name(measurement)["service", "relative gap 1e-09"].certified_gap
    assert served is not None
    assert served <= 1e-9


def test_the_worst_case_is_solved_once_at_each_gap(monkeypatch: pytest.MonkeyPatch) -> None:
    """Property: the optimum that all is measured by is the first run of its row, and rounds repeat it."""
    gaps = list[float]()
    own = uncertain.Steps.whole

    def counted(worst: uncertain.Robust) -> Any:
        gaps.append(worst.demand.relative_gap)
        return own(worst)

    monkeypatch.setattr(uncertain.Steps, "whole", staticmethod(counted))
    measurement = accuracy({"machine": twin(), "tolerances": COUNTERWEIGHTS, "repeats": 1})
    assert measurement.status == "measured"
    # once before the round and once in it
    assert sorted(gaps) == [1e-9, 1e-9, 1e-6, 1e-6, 1e-3, 1e-3]
    first = by_name(measurement)["service", f"relative gap {measure.SHARPEST:.0e}"].first_ms
    assert first is not None
    assert first > 0.0


def test_a_ceiling_is_kept_in_every_scenario() -> None:
    """Property: what keeps a ceiling in one scenario exceeds it in another, and its row says so."""
    scenarios = several(twin())[:2]
    free = optimize({"machine": twin(), "scenarios": scenarios, "objective": {"moment_weight": 0.0}})
    least = optimize({"machine": twin(), "scenarios": scenarios, "objective": {"force_weight": 0.0}})
    assert free.worst_case is not None
    assert least.worst_case is not None
    # between the smallest moment and that of the smallest force
    most = 0.5 * (free.worst_case.moment_peak_Nm + least.worst_case.moment_peak_Nm)
    goal = {"moment_weight": 0.0, "moment_ceiling_Nm": most}
    measurement = measured(twin(), scenarios=scenarios, objective=goal)
    assert measurement.status == "measured"
    rows = by_name(measurement)
    assert (rows["one_scenario", "scenario as it is"].excess or 0.0) > 1e-6
    assert (rows["worst_scenarios", "2 rounds"].excess or 0.0) <= 1e-9
    assert (rows["service", "relative gap 1e-09"].excess or 0.0) <= 1e-9
    impossible = measured(twin(), scenarios=scenarios, objective={"moment_ceiling_Nm": 1.0})
    assert impossible.status == "infeasible"
    assert impossible.ladder == ()


@pytest.mark.parametrize("kind", part(2, ["a catalogue", "groups", "plates"]))
@pytest.mark.parametrize("tolerances", part(1, [None, BOTH]))
def test_counterweights_as_they_are_made_are_judged_in_the_worst_scenario(
    kind: str, tolerances: dict[str, float] | None
) -> None:
    """Independent: the service row is the worst case that /v1/optimize answers, and rounding comes to no less."""
    machine = {"a catalogue": lambda: twin(**CHOSEN), "groups": lambda: twin(**ALIKE), "plates": lambda: cut(twin())}[
        kind
    ]()
    scenarios = several(machine)
    measurement = measured(machine, scenarios=scenarios, tolerances=tolerances)
    assert measurement.status == "measured"
    reference = measurement.reference
    assert reference is not None
    gap = {"relative_gap": 1e-2}
    best = optimize({"machine": machine, "scenarios": scenarios, "tolerances": tolerances, "accuracy": gap})
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


@pytest.mark.parametrize(
    ("scenarios", "pointer"),
    [
        ([{"name": "a"}, {"name": "a"}], "/scenarios/1/name"),
        ([{"name": "a", "weight": -1.0}], "/scenarios/0/weight"),
        ([{"name": "a", "changes": [{"path": "/machine/nothing", "value": 1.0}]}], "/scenarios/0/changes/0/path"),
        ([{"name": "a", "changes": [{"path": "/machine/speed_rpm", "value": -1.0}]}], "/scenarios/0/changes/0/value"),
        ([{"name": "a", "changes": [{"path": "/repeats", "value": 1}]}], "/scenarios/0/changes/0/path"),
    ],
)
def test_wrong_scenarios_are_refused_by_name(post: Post, scenarios: list[dict[str, Any]], pointer: str) -> None:
    response = post("/v1/accuracy", json.dumps({"machine": twin(), "scenarios": scenarios}))
    assert response.status_code == 422
    assert pointer in [error["pointer"] for error in response.json()["errors"]]


def test_the_command_and_its_picture_name_the_scenarios(tmp_path: Any) -> None:
    scenarios = [*several(twin())[:1], {**several(twin())[1], "name": " "}]
    passage = json.dumps({"machine": twin(), "scenarios": scenarios, "repeats": 1}).encode()
    picture = tmp_path / "ladder.svg"
    result = CliRunner().invoke(app, ["accuracy", "-", "--picture", str(picture)], input=passage)
    assert result.exit_code == 0, result.output
    for text in ("smallest worst case", "one scenario alone", "scenario as it is", "worst scenarios by"):
        assert text in result.stdout
    assert "one scenario alone" in picture.read_text()


def test_the_judge_takes_the_largest_sum(monkeypatch: pytest.MonkeyPatch) -> None:
    """Independent: every figure of the ladder from sums of all corners one by one."""
    judges = list[Any]()
    own = measure.uncertain_methods

    def seen(steps: Any, judge: Any) -> Any:
        judges.append(judge)
        return own(steps, judge)

    monkeypatch.setattr(measure, "uncertain_methods", seen)
    answer: AccuracyAnswer = measured(twin(), scenarios=several(twin()), tolerances=MASSES)
    assert answer.status == "measured"
    (judge,) = judges
    assert judge.sums is not None
    single = judge.single_sum
    rng = np.random.default_rng(3)
    webs = judge.statement.limits.radius.size
    for scale in (0.0, 0.1, 1.0):
        u = scale * (rng.normal(size=webs) + 1j * rng.normal(size=webs))
        assert judge.objective(u) == pytest.approx(float(single.objective(u)), rel=1e-13)
