"""Sums of four lists that all but cancel: enumeration, and what must not change."""

import numpy as np
import pytest

from optimizer.numerics.kernel.meeting import met
from optimizer.studies.matching.four_lists import near_to_nothing
from optimizer.studies.matching.match import match
from optimizer.studies.matching.problem import stated
from schemas.match.request import MatchRequest
from tests.studies.matching.cases import every, machine, mirrored, objective, parts


def never() -> bool:
    return False


@pytest.mark.parametrize("side", [0.2, 3.0, np.inf])
def test_pairs_are_those_in_the_same_cell(side: float) -> None:
    """Independent: every pair."""
    first, second = np.random.default_rng(0).standard_normal((2, 60, 3))
    value = met(first, second, side, 10_000)
    same = np.all(np.floor(first / side)[:, None] == np.floor(second / side), axis=-1)
    assert sorted(zip(*value.tolist(), strict=True)) == sorted(
        zip(*(k.tolist() for k in np.nonzero(same)), strict=True)
    )
    assert met(first, second, np.inf, 7).shape == (2, 7)


def test_two_classes_of_four_rows_come_to_the_best_there_is() -> None:
    """Independent: all assignments; four lists of two places each are dealt anew until nothing is better."""
    design, classes = machine(mirrored(4), [90.0] * 4), parts(3, 4, 4)
    request = MatchRequest.model_validate({"machine": design, "parts": classes})
    problem = stated(request, request.machine, np.zeros(0), np.zeros(0))
    near_values = near_to_nothing(problem, problem.input_order, 0.0, never)
    assert all(sorted(near_values[part]) == sorted(problem.input_order[part]) for part in problem.slices)
    best = np.min(objective(design, every(classes, 4), 1.0))
    assert objective(design, 12.0 + problem.row_masses(near_values), 1.0) == pytest.approx(best, rel=1e-9)


def test_one_class_of_few_rows_is_left_as_it_is_where_nothing_is_better() -> None:
    request = MatchRequest.model_validate({"machine": machine([0.0, 180.0], [90.0] * 2), "parts": parts(3, 2)})
    problem = stated(request, request.machine, np.zeros(0), np.zeros(0))
    assert sorted(near_to_nothing(problem, problem.input_order, 0.0, never)) == sorted(problem.input_order)


def test_a_class_of_one_row_ends_nothing() -> None:
    """Regression: groups without places were among the four that are dealt, and nothing was tried."""
    rows = [{"throw": k, "row": 0} for k in range(17)]
    classes = parts(3, 1, 16)
    classes[0]["rows"], classes[1]["rows"] = rows[:1], rows[1:]
    design = machine([360.0 * k / 17 for k in range(17)], [90.0] * 17)
    body = {"machine": design, "parts": classes, "objective": {"moment_weight": 0}}
    request = MatchRequest.model_validate(body)
    problem = stated(request, request.machine, np.zeros(0), np.zeros(0))
    near_values = near_to_nothing(problem, problem.input_order, 0.0, never)
    before, after = (float(problem.peaks.at(problem.vectors(mass))) for mass in (problem.input_order, near_values))
    assert after < 1e-2 * before


def test_two_classes_of_sixteen_rows_are_matched_to_the_asked_gap() -> None:
    """Regression: exchanges of one class at a time ended at 2.8e-4 of what is listed."""
    body = {"machine": machine(mirrored(16), [90.0] * 16), "parts": parts(3, 16, 16, scatter=0.01)}
    answer = match(MatchRequest.model_validate(body | {"accuracy": {"relative_gap": 1e-4, "time_limit_s": 30}}))
    assert answer.status == "optimal"
    assert answer.certificate.objective <= 1e-4 * answer.certificate.objective_as_listed
