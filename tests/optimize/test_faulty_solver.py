"""Objectives over the turn with a solver that fails or lies, or a bound that is wrong: what is answered is true."""

import logging
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from optimizer.analyze import analyze
from optimizer.optimize import optimize
from optimizer.program.cuts import proof as cut_proof
from optimizer.program.cuts import stage as cut_stage
from optimizer.program.reference.assembled import Assembled, NoPoint, solved
from optimizer.program.scaled_program import ScaledSolution
from optimizer.program.verdict import CONTRADICTED
from schemas.answer.answers import Certificate, OptimizeAnswer
from schemas.request.requests import AnalyzeRequest, OptimizeRequest
from tests.optimize.whole_turn import ALONE, request_of, single_throw
from tests.verification.every import unchecked

#: published for a rod ratio of 1/3: the largest load with and without the best counterweights, N
_SMALLEST, _AT_REST = 0.346038, 1.0 + 1.0 / 6.0
_EXTERNAL_FIRST = [{"goal": "external", "allowance": 0.5}, {"goal": "bearings"}]


def _answer(compute: Callable[[OptimizeRequest], OptimizeAnswer] = optimize, **objective: Any) -> OptimizeAnswer:
    return compute(request_of(single_throw(3.0), bearing_weight=1, **objective))


def _proof(answer: OptimizeAnswer) -> Certificate:
    assert answer.certificate is not None
    return answer.certificate


def _lying(monkeypatch: pytest.MonkeyPatch, change: Callable[[ScaledSolution], ScaledSolution]) -> None:
    def lying(*args: Any, **kwargs: Any) -> Assembled | NoPoint:
        solution = solved(*args, **kwargs)
        return solution if isinstance(solution, NoPoint) else solution._replace(solution=change(solution.solution))

    monkeypatch.setattr(cut_stage, "solved", lying)


@pytest.mark.parametrize("least_mass", [False, True])
@pytest.mark.parametrize("limit", [{}, {"bearing_ceiling_N": 0.9}])
def test_a_solver_that_finds_nothing_leaves_what_rest_proves(
    limit: dict[str, float], least_mass: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(cut_stage, "solved", lambda *_, **__: NoPoint("not solved within 5 s"))
    answer = _answer(least_mass=least_mass, **ALONE, **limit)
    assert answer.status == "inaccurate"
    assert answer.total_mass_kg == 0.0
    proof = _proof(answer)
    assert proof.objective == pytest.approx(_AT_REST, rel=1e-9)
    assert proof.lower_bound is not None
    assert 0.0 <= proof.lower_bound <= _SMALLEST


def test_a_ceiling_below_a_floor_needs_no_solver_to_be_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cut_stage, "solved", lambda *_, **__: NoPoint("not solved within 5 s"))
    # the smallest force and moment are as far from their bounds as that solver leaves them
    answer = _answer(unchecked(optimize), **ALONE, bearing_ceiling_N=0.1)
    assert answer.status == "infeasible"
    assert answer.infeasibility is not None
    assert answer.infeasibility.conflict == ("bearing_ceiling_N",)


def test_several_goals_need_no_solver_to_be_answered(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cut_stage, "solved", lambda *_, **__: NoPoint("not solved within 5 s"))
    proof = _proof(_answer(least_mass=False, priorities=_EXTERNAL_FIRST))
    (external,) = proof.goals
    assert external.lower_bound is not None
    assert 0.0 <= external.lower_bound <= external.value
    assert proof.objective == pytest.approx(_AT_REST, rel=1e-9)


def _elsewhere(solution: ScaledSolution) -> ScaledSolution:
    rng = np.random.default_rng(1)
    return solution._replace(x=rng.normal(size=solution.x.shape), y=rng.normal(size=solution.y.shape))


def _wrong_multipliers(solution: ScaledSolution) -> ScaledSolution:
    rng = np.random.default_rng(2)

    def fault(size: int) -> Any:
        return 1e3 * rng.normal(size=(size, 2)) @ [1, 1j]

    row = 1e3 * rng.uniform(size=solution.row.shape)
    return solution._replace(row=row, term=fault(solution.term.size), ceiling=fault(solution.ceiling.size))


@pytest.mark.parametrize("lie", [_elsewhere, _wrong_multipliers, lambda value: _wrong_multipliers(_elsewhere(value))])
def test_a_solver_that_lies_proves_nothing_false(
    lie: Callable[[ScaledSolution], ScaledSolution], monkeypatch: pytest.MonkeyPatch
) -> None:
    _lying(monkeypatch, lie)
    answer = _answer(**ALONE)
    assert answer.status == "inaccurate"
    proof = _proof(answer)
    assert proof.lower_bound is not None
    assert proof.lower_bound <= _SMALLEST + 1e-6
    # independent: the loads of what is returned, by the analysis of samples
    fitted = [
        counterweight.model_dump(include={"web", "mass_kg", "angle_deg"}) for counterweight in answer.counterweights
    ]
    body = {"machine": single_throw(3.0), "counterweights": fitted, "outputs": ["main_bearings"]}
    loads = analyze(AnalyzeRequest.model_validate(body)).main_bearings
    assert loads is not None
    peak = max((bearing.after or bearing.before).peak_N for bearing in loads.bearings)
    assert proof.objective == pytest.approx(peak, rel=1e-3)
    assert proof.objective >= _SMALLEST - 1e-6
    assert answer.total_mass_kg == pytest.approx(
        sum(counterweight.mass_kg for counterweight in answer.counterweights), rel=1e-12
    )


def _raised(monkeypatch: pytest.MonkeyPatch, wrong: Callable[..., bool]) -> None:
    """Bounds that are 1 too high, where they are wrong."""
    right = cut_proof.objective_lower_bound

    def bound(statement: Any, multipliers: Any) -> Any:
        return right(statement, multipliers) + wrong(statement)

    monkeypatch.setattr(cut_proof, "objective_lower_bound", bound)


@pytest.mark.parametrize(
    ("objective", "wrong"),
    [
        (ALONE, lambda statement: True),
        # only that of the first goal, which alone has no term of a bearing
        (
            {"priorities": _EXTERNAL_FIRST},
            lambda statement: not any("bearing" in term.response for term in statement.names.terms),
        ),
        # only that of the excess, as if the ceilings could not be kept
        (ALONE | {"bearing_ceiling_N": 0.9}, lambda statement: np.any(statement.floor < 0)),
    ],
)
def test_a_bound_above_its_value_is_a_fault_that_is_said(
    objective: dict[str, Any],
    wrong: Callable[..., bool],
    monkeypatch: pytest.MonkeyPatch,
    caplog: pytest.LogCaptureFixture,
) -> None:
    """Never clipped: nothing is proven, and it is logged, which is what counts faults."""
    _raised(monkeypatch, wrong)
    # the limit of a goal is counted from the wrong bound
    answer = _answer(unchecked(optimize), least_mass=False, **objective)
    assert (answer.status, answer.status_reason) == ("inaccurate", CONTRADICTED)
    proof = _proof(answer)
    assert proof.lower_bound is proof.gap is proof.relative_gap is None
    assert all(goal.lower_bound is None for goal in proof.goals)
    assert [record.levelno for record in caplog.records] == [logging.ERROR]


def test_the_time_of_bounds_is_measured() -> None:
    timing = _answer(**ALONE).timing
    assert 0.0 < timing.certificate_ms < timing.total_ms
    assert timing.solve_ms > 0.0
