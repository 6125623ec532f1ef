"""Rounds, frontier and judgement of the ladder."""

import time
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from optimizer.optimize import optimize
from optimizer.program.certificate import nothing_proven
from optimizer.studies.accuracy import ladder, measure
from optimizer.studies.accuracy.ladder import Clock, frontier, survey, time_rounds
from optimizer.studies.accuracy.measure import Best, _judged, accuracy
from optimizer.studies.accuracy.methods import GAPS, POSITIONS, LadderProgram, Method, MethodResult, Run, methods
from schemas.request.accuracy import AccuracyAnswer, AccuracyRequest
from schemas.request.requests import OptimizeRequest
from tests.night import part
from tests.studies.accuracy.problems import body, random_task, request, single

NAMES = ("single-horizontal", "2d12", "v8-cross-plane", "m-type-four")


@pytest.fixture(scope="module", params=part(4, NAMES))
def answer(request: pytest.FixtureRequest) -> AccuracyAnswer:
    return accuracy(AccuracyRequest.model_validate({**body(request.param), "repeats": 1}))


def test_every_method_is_a_row(answer: AccuracyAnswer) -> None:
    assert [(row.method, row.setting) for row in answer.ladder] == [
        (method.name, method.setting) for method in methods()
    ]
    assert answer.status == "measured"
    assert all(row.skipped is None and row.runs == 1 and row.first_ms for row in answer.ladder)


def test_a_certified_gap_is_never_below_the_true_error(answer: AccuracyAnswer) -> None:
    for row in answer.ladder:
        assert row.relative_error is not None
        assert row.certified_gap is not None
        assert 0.0 <= row.relative_error <= row.certified_gap + 1e-15, row
        assert row.as_drawn_error is not None
        assert row.as_drawn_error <= row.relative_error, row
        assert row.excess is None


def test_the_service_is_exact_and_digits_cost_what_they_should(answer: AccuracyAnswer) -> None:
    """The service meets the gap of its setting; the exact program its tolerance, twenty-fold."""
    for row in answer.ladder:
        kind, _, value = row.setting.rpartition(" ")
        assert row.relative_error is not None
        if kind == "relative gap":
            assert row.certified_gap is not None
            # without what the service does next, double precision may end before the last digits
            assert row.certified_gap <= (float(value) if row.method == "service" else max(float(value), 1e-8))
        if value == "digits":
            assert row.relative_error <= 1e-13
        if kind == "tolerance":
            assert row.relative_error <= 20.0 * float(value)
        # analytic: P_n <= P* and P(u_n) <= P_n / cos(pi/n)
        if value == "angles":
            assert row.relative_error <= 1.0 / np.cos(np.pi / float(kind)) - 1.0 + 1e-7


def test_the_frontier_of_an_answer_is_not_dominated(answer: AccuracyAnswer) -> None:
    assert answer.reference is not None
    places = {
        (row.method, row.setting): (row.time_ms or 0.0, max(row.relative_error or 0.0, answer.reference.resolution))
        for row in answer.ladder
        if row.programs == 1
    }
    assert len(answer.ladder) - len(places) == len(GAPS)
    best = {(row.method, row.setting) for row in answer.ladder if row.on_frontier}
    assert best
    for name, (taken, error) in places.items():
        beaten = any(place != (taken, error) and place[0] <= taken and place[1] <= error for place in places.values())
        assert beaten == (name not in best)


@given(st.lists(st.none() | st.tuples(st.integers(0, 6).map(float), st.integers(0, 6).map(float)), max_size=12))
def test_the_frontier_is_the_set_that_nothing_dominates(points: list[tuple[float, float] | None]) -> None:
    """Property: beside every other point stands one on the frontier that is as good in both."""
    actual_frontier = frontier(points, 2.0)
    level = [None if point is None else (point[0], max(point[1], 2.0)) for point in points]
    best = [pair for pair, on in zip(level, actual_frontier, strict=True) if on and pair is not None]
    for pair, on in zip(level, actual_frontier, strict=True):
        if pair is None:
            assert not on
        elif on:
            assert not any(o[0] <= pair[0] and o[1] <= pair[1] and o != pair for o in best)
        else:
            assert any(o[0] <= pair[0] and o[1] <= pair[1] and o != pair for o in best)


def test_rounds_take_turns_and_run_at_the_position_of_the_largest_error() -> None:
    task, calls = single(2.0, 1.0, 0.5), list[tuple[str, float]]()

    def method(name: str) -> Method:
        def run(_: LadderProgram, position: float, __: float) -> MethodResult:
            calls.append((name, position))
            # the further from the optimum the larger the position
            return MethodResult(np.array([-0.5 + 0.4 * position + 0j]), None, lambda: -np.inf)

        def prepare() -> Run:
            return run

        return Method(name, "", prepare, POSITIONS)

    trials = survey(task, [method("a"), method("b")], Clock.of(60.0))
    assert calls == [(name, position) for name in "ab" for position in POSITIONS]
    calls.clear()
    time_rounds(task, trials, 3, Clock.of(60.0))
    assert calls == [("a", 0.75), ("b", 0.75)] * 3
    assert [len(trial.times_s) for trial in trials] == [3, 3]


def test_times_are_for_one_of_the_programs_of_a_run() -> None:
    """Analytic: a run of 50 ms for ten programs takes 5 ms for each."""
    task = single(2.0, 1.0, 0.5)

    def run(_: LadderProgram, position: float, __: float) -> MethodResult:
        time.sleep(0.05)
        return MethodResult(np.array([-0.5 + 0j]), None, lambda: 2.5)

    trials = survey(task, [Method("m", "", lambda: run, programs=10)], Clock.of(60.0))
    time_rounds(task, trials, 3, Clock.of(60.0))
    best = Best(np.array([-0.5 + 0j]), 2.5, 2.5, -np.inf, task.statement, nothing_proven(task.statement))
    reference, (row,) = _judged(task, trials, best, 3.0, 1.0)
    assert reference is not None
    assert row.time_ms is not None
    assert row.first_ms is not None
    assert 5.0 <= row.time_ms < 50.0
    assert 5.0 <= row.first_ms < 50.0
    assert (row.programs, row.relative_error, row.on_frontier) == (10, 0.0, False)
    assert reference.objective == 2.5


def test_broken_ceilings_are_worse_than_any_objective() -> None:
    task = random_task(4, "sum", (1.0, 1.0), False, False, True)

    def run(_: LadderProgram, position: float, __: float) -> MethodResult:
        # far beyond the ceilings at one position only
        factor = 1e3 if position == 0.25 else 0.0
        return MethodResult(np.full(task.statement.limits.radius.size, factor + 0j), None, lambda: -np.inf)

    (trial,) = survey(task, [Method("m", "", lambda: run, POSITIONS)], Clock.of(60.0))
    assert trial.worst.position == 0.25
    assert trial.worst.excess > 1.0


def test_what_is_too_large_or_too_late_is_skipped_and_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(ladder, "MAX_ENTRIES", 1000)
    answer = accuracy(request("2d12"))
    skipped = {row.setting: row for row in answer.ladder if row.skipped}
    assert "720 angles" in skipped
    assert "256 sides" in skipped
    assert "4 sides" not in skipped
    for row in skipped.values():
        assert row.skipped is not None
        assert row.skipped.startswith("too large: ")
        assert row.time_ms is row.first_ms is row.relative_error is row.certified_gap is None
        assert not row.on_frontier
    (late,) = survey(single(2.0, 1.0, 0.5), list(methods())[:1], Clock.of(-1.0))
    assert late.skipped is not None
    assert "used up" in late.skipped


@pytest.mark.nightly
def test_a_machine_of_500_webs_is_measured_within_its_bounds(monkeypatch: pytest.MonkeyPatch) -> None:
    """What is not skipped is bounded in size; here the bound is lowered, to keep the test short."""
    monkeypatch.setattr(ladder, "MAX_ENTRIES", 10_000)
    payload = body("2d12")
    payload["machine"]["webs"] = [
        {"name": str(k), "position_m": k / 499 - 0.5, "counterweight_radius_m": 0.25, "max_mass_kg": 0.5}
        for k in range(500)
    ]
    answer = accuracy(AccuracyRequest.model_validate({**payload, "repeats": 1}))
    assert answer.size.webs == 500
    answered = [row for row in answer.ladder if not row.skipped]
    assert {"service", "cone_program", "cone_program_matrices"} <= {row.method for row in answered}
    assert all(row.relative_error is not None and row.relative_error < 0.2 for row in answered)
    assert any(row.skipped for row in answer.ladder)


def test_sampled_ceilings_that_are_broken_keep_a_row_off_the_frontier() -> None:
    """The true peak is above what six angles see: the ceiling holds at those only, and the objective is too good."""
    reply = accuracy(request("two-rows-90", direction_weights={"x": 1, "y": 0.2}, moment_ceiling_Nm=4016.5))
    assert reply.status == "measured"
    rows = {(row.method, row.setting): row for row in reply.ladder}
    broken = rows["sampled_angles", "6 angles"]
    assert broken.excess is not None
    assert broken.relative_error is not None
    # regression figures, rounded down: the excess is near four percent, the objective three percent too good
    assert broken.excess > 0.03
    assert broken.relative_error < -0.02
    assert not broken.on_frontier
    for row in reply.ladder:
        if row.method in ("service", "polygonal_cones"):
            assert row.excess is not None
            assert row.excess <= 1e-9, row
            assert row.relative_error is not None
            assert row.relative_error >= 0.0


def test_no_ladder_where_there_is_nothing_to_choose_or_nothing_feasible() -> None:
    balanced = accuracy(request("opposed-triple"))
    assert balanced.status == "nothing_to_choose"
    assert balanced.ladder == ()
    assert balanced.reference is not None
    bare = body("2d12")
    bare["machine"]["webs"] = []
    assert accuracy(AccuracyRequest.model_validate(bare)).status == "nothing_to_choose"
    impossible = accuracy(request("2d12", force_ceiling_N=1.0))
    assert impossible.status == "infeasible"
    assert impossible.ladder == ()
    assert impossible.reference is None
    # effects need no counterweights
    assert impossible.effects_ladder


def test_a_bound_that_a_value_contradicts_is_said_and_measures_nothing(
    monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    honest = measure.optima

    def too_sharp(*arguments: Any) -> Any:
        optima = honest(*arguments)
        return replace(optima, lower_bound=optima.lower_bound * (1.0 + 1e-6))

    monkeypatch.setattr(measure, "optima", too_sharp)
    reply = accuracy(request("2d12"))
    assert (reply.status, reply.reference, reply.ladder) == ("contradicted", None, ())
    assert "a lower bound is above the value of an answer" in caplog.text
    assert reply.effects_ladder


@pytest.mark.parametrize("limit", part(2, [None, 1e300]))
def test_a_web_without_a_limit_is_measured(limit: float | None) -> None:
    free = body("single-horizontal")
    for web in free["machine"]["webs"]:
        web["max_mass_kg"] = limit
    reply = accuracy(AccuracyRequest.model_validate({**free, "repeats": 1}))
    assert reply.status == "measured"
    assert reply.reference is not None
    # independent: what the service answers, which is within a millionth for the least mass
    answer = optimize(OptimizeRequest.model_validate(free))
    assert answer.certificate is not None
    certificate = answer.certificate
    assert reply.reference.objective == pytest.approx(certificate.objective, rel=0, abs=2e-6 * certificate.yardstick)
    assert all(row.skipped is not None or row.relative_error is not None for row in reply.ladder)
