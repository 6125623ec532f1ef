"""Which part goes on which row: enumeration, machines with a known answer, and what must not change anything."""

from itertools import permutations
from typing import Any

import numpy as np
import pytest

from optimizer.optimize import optimize
from optimizer.studies.matching.match import match
from optimizer.studies.matching.problem import stated
from schemas.match.request import MatchRequest
from schemas.request.requests import OptimizeRequest
from service.documents.examples import bodies
from tests.night import part
from tests.studies.matching.cases import OMEGA, RADIUS, every, machine, matched, mirrored, objective, parts


@pytest.mark.parametrize(
    ("cranks", "axes", "counts"),
    part(
        2,
        [
            (mirrored(4), [90.0] * 4, (4, 4)),
            ([0.0, 120.0, 240.0], [90.0] * 3, (3, 3, 3)),
            (mirrored(6), [90.0] * 6, (6,)),
            ([0.0, 120.0, 240.0, 240.0, 120.0], [45.0, 135.0] * 2 + [45.0], (5, 5)),
            (mirrored(8), [90.0] * 8, (8,)),
            (mirrored(8), [45.0, 135.0] * 4, (8,)),
        ],
        rows=True,
    ),
)
@pytest.mark.parametrize("combined", [False, True])
def test_it_is_the_best_of_all(cranks: list[float], axes: list[float], counts: tuple[int, ...], combined: bool) -> None:
    """Independent: every assignment by hand, to 8! of them."""
    design, classes = machine(cranks, axes), parts(len(cranks), *counts)
    moment_weight = 2.0 if combined else 0.0
    body = {"machine": design, "parts": classes, "objective": {"moment_weight": moment_weight}}
    answer = matched(body | {"accuracy": {"relative_gap": 1e-9}})
    values = objective(design, every(classes, len(cranks)), moment_weight)
    assert answer.status == "optimal"
    assert answer.certificate.method == "exhaustion"
    assert answer.certificate.objective == pytest.approx(np.min(values), abs=1e-9 * np.max(values))
    assert answer.certificate.objective_as_listed == pytest.approx(values[0], rel=1e-9, abs=1e-9)
    row_masses = np.array([row.reciprocating_mass_kg for row in answer.rows])
    assert objective(design, row_masses, moment_weight) == pytest.approx(np.min(values), abs=1e-9 * np.max(values))


def test_two_classes_of_six_are_the_best_of_all() -> None:
    """Independent: for every order of one class the best of the other, 720 squared."""
    design, classes = machine(mirrored(6), [90.0] * 6), parts(3, 6, 6)
    answer = matched({"machine": design, "parts": classes, "accuracy": {"relative_gap": 1e-9}})
    orders = [np.array(list(permutations(single_class["masses_kg"]))) for single_class in classes]
    sums = [objective_vectors(design, some) for some in orders]
    base = objective_vectors(design, np.full(6, 12.0))
    least = min(float(np.min(np.sum(np.abs(base + sums[0] + sums_of_half), axis=-1) * 2.0)) for sums_of_half in sums[1])
    assert answer.certificate.objective == pytest.approx(least * RADIUS * OMEGA**2, rel=1e-9)
    assert answer.certificate.method == "exhaustion"


def objective_vectors(design: Any, row_masses: np.ndarray) -> np.ndarray:
    """Force and moment over the span of 1.5 m turning with the shaft; on vertical axes the counterpart is as long."""
    crank = np.exp(1j * np.deg2rad([throw["crank_angle_deg"] for throw in design["throws"]]))
    place = np.array([throw["position_m"] for throw in design["throws"]])
    return np.stack([row_masses @ (0.5 * crank), row_masses @ (0.5 * crank * place / 1.5)], axis=-1)


@pytest.mark.parametrize("largest", [False, True])
def test_unequal_directions_and_the_larger_peak(largest: bool) -> None:
    """Independent: every assignment, each evaluated as a machine of its own."""
    goal: dict[str, Any] = {"combine": "max"} if largest else {"direction_weights": {"x": 1.0, "y": 0.2}}
    design, classes = machine([0.0, 120.0, 240.0, 60.0], [30.0, 90.0, 150.0, 0.0]), parts(8, 4)
    answer = matched({"machine": design, "parts": classes, "objective": goal})
    best = np.inf
    for row_masses in every(classes, 4).tolist():
        throws = [
            throw | {"rows": [throw["rows"][0] | {"reciprocating_mass_kg": mass}]}
            for throw, mass in zip(design["throws"], row_masses, strict=True)
        ]
        body = OptimizeRequest.model_validate({"machine": design | {"throws": throws}, "objective": goal})
        certificate = optimize(body).certificate
        assert certificate is not None
        best = min(best, certificate.objective)
    assert answer.certificate.objective == pytest.approx(best, rel=1e-9)


def test_a_search_that_has_no_time_says_its_gap() -> None:
    """Nothing but the assignment as listed is solved, and what is proven holds for the best of all."""
    design, classes = machine([0.0, 90.0, 180.0, 270.0], [45.0, 135.0] * 2, (-0.7, 0.7), 0.2), parts(2, 4)
    body = {"machine": design, "parts": classes, "choose_counterweights": True}
    best = matched(body | {"accuracy": {"relative_gap": 1e-5}}).certificate
    ended = matched(body | {"accuracy": {"relative_gap": 1e-5, "time_limit_s": 1e-9}})
    assert ended.certificate.lower_bound is not None
    assert best.objective is not None
    assert ended.status == "inaccurate"
    assert ended.certificate.objective == pytest.approx(ended.certificate.objective_as_listed, rel=1e-5)
    assert ended.certificate.lower_bound <= best.objective * (1 + 1e-9) < ended.certificate.objective


@pytest.mark.parametrize("most", [0.2, 40.0])
def test_counterweights_chosen_with_the_parts(most: float) -> None:
    """Independent: every assignment with its own optimum, where counterweights are ample and where they are not."""
    design, classes = machine([0.0, 90.0, 180.0, 270.0], [45.0, 135.0] * 2, (-0.7, 0.7), most), parts(2, 4)
    answer = matched(
        {"machine": design, "parts": classes, "choose_counterweights": True, "accuracy": {"relative_gap": 1e-5}}
    )
    bodies_ = []
    for row_masses in every(classes, 4).tolist():
        throws = [
            throw | {"rows": [throw["rows"][0] | {"reciprocating_mass_kg": mass}]}
            for throw, mass in zip(design["throws"], row_masses, strict=True)
        ]
        bodies_.append({"machine": design | {"throws": throws}})
    answers = [optimize(OptimizeRequest.model_validate(body)).certificate for body in bodies_]
    best = min(certificate.objective for certificate in answers if certificate is not None)
    assert answer.status == "optimal"
    assert answer.certificate.lower_bound is not None
    assert answer.certificate.lower_bound <= best * (1 + 1e-9)
    assert answer.certificate.objective == pytest.approx(best, abs=2e-6 * answer.certificate.yardstick)
    assert {counterweight.web for counterweight in answer.counterweights} == {"w0", "w1"}


def test_the_residual_force_of_the_2d12_is_a_difference_of_masses() -> None:
    """Published: its rows differ by 26.07 kg (the design calculation of the 2D12-90/2-20); analytic: m r omega^2."""
    body = bodies("match")["2d12"]
    for throw, mass in zip(body["machine"]["throws"], (277.79, 251.72), strict=True):
        throw["rows"][0]["reciprocating_mass_kg"] = mass
    body = {**body, "parts": [], "balance_nuts_kg": [25, 26, 27], "objective": {"moment_weight": 0}}
    answer = matched(body)
    kilogram = 0.14 * (500 * np.pi / 30) ** 2
    assert answer.residual.before.force.peak_N == pytest.approx(26.07 * kilogram, rel=1e-9)
    assert answer.residual.after.force.peak_N == pytest.approx(0.07 * kilogram, rel=1e-9)
    assert [(assignment.throw, assignment.kind, assignment.mass_kg) for assignment in answer.assignments] == [
        (1, "balance_nut", 26.0)
    ]
    assert [spare.part for spare in answer.spares] == ["1", "3"]


def test_equal_masses_leave_nothing_to_match() -> None:
    """Analytic: mirrored cranks all around balance equal rows; the parts go where they are listed."""
    design = machine(mirrored(8), [90.0] * 8)
    answer = matched({"machine": design, "parts": parts(1, 8, scatter=0.0)})
    assert answer.residual.after.force.peak_N == 0.0
    assert answer.residual.after.moment.peak_Nm == pytest.approx(0.0, abs=1e-9)
    assert (answer.status, answer.certificate.relative_gap) == ("optimal", 0.0)
    assert [assignment.part for assignment in answer.assignments] == [f"0.{k}" for k in range(8)]


def test_each_part_goes_on_one_row() -> None:
    design, classes = machine(mirrored(6), [90.0] * 6), parts(4, 6, 3)
    classes[1]["rows"] = [{"throw": t, "row": 0} for t in (4, 1, 2)]
    answer = matched({"machine": design, "parts": classes, "balance_nuts_kg": [0.5, 0.5, 1.0]})
    for single_class in classes:
        taken = [assignment for assignment in answer.assignments if assignment.kind == single_class["class"]]
        assert sorted(assignment.part for assignment in taken) == sorted(single_class["names"])
        assert {assignment.part: assignment.mass_kg for assignment in taken} == dict(
            zip(single_class["names"], single_class["masses_kg"], strict=True)
        )
        assert len({(assignment.throw, assignment.row) for assignment in taken}) == len(taken)
    assert {assignment.throw for assignment in answer.assignments if assignment.kind == "class 1"} == {1, 2, 4}
    nuts = [assignment for assignment in answer.assignments if assignment.kind == "balance_nut"]
    assert len({nut.throw for nut in nuts}) == len(nuts)
    assert sorted([nut.part for nut in nuts] + [spare.part for spare in answer.spares]) == ["1", "2", "3"]
    for row in answer.rows:
        on = sum(
            assignment.mass_kg
            for assignment in answer.assignments
            if (assignment.throw, assignment.row) == (row.throw, row.row)
        )
        assert row.reciprocating_mass_kg == pytest.approx(12.0 + on, rel=1e-12)


def test_the_order_of_the_list_changes_nothing() -> None:
    """Metamorphic: the same parts in another order, and one class after the other way round."""
    design, classes = machine(mirrored(6), [60.0] * 6), parts(6, 6, 6)
    turned = [
        single_class | {"names": single_class["names"][::-1], "masses_kg": single_class["masses_kg"][::-1]}
        for single_class in reversed(classes)
    ]
    close = {"accuracy": {"relative_gap": 1e-9}, "machine": design}
    answer, second_answer = matched({**close, "parts": classes}), matched({**close, "parts": turned})
    assert answer.certificate.objective == pytest.approx(second_answer.certificate.objective, rel=1e-9)
    assert answer.certificate.method == second_answer.certificate.method == "exhaustion"


def test_counterweights_that_are_there() -> None:
    """Analytic: one row in line and its counterpart; the counterweight takes the place of what it weighs."""
    design = machine([0.0, 180.0], [0.0, 180.0], (0.0,))
    parts_ = [{"class": "rod", "names": ["a", "b"], "masses_kg": [10.0, 14.0]}]
    goal = {"moment_weight": 0}
    fitted = [{"web": "w0", "mass_kg": 2.4, "angle_deg": 180.0}]
    answer = matched({"machine": design, "parts": parts_, "counterweights": fitted, "objective": goal})
    # the heavier on throw 1, 4 kg at 0.12 m: half of it turns with the shaft, 0.24 kg m, and is taken away
    assert answer.residual.after.force.co_rotating_N == pytest.approx(0.0, abs=1e-9)
    assert [assignment.part for assignment in answer.assignments] == ["b", "a"]
    assert answer.total_mass_kg == 2.4


@pytest.mark.parametrize("name", bodies("match"))
def test_the_bound_holds(name: str) -> None:
    """Metamorphic: what a random assignment comes to is no less than the bound, nor than the answer."""
    body = bodies("match")[name]
    answer = matched(body)
    rng = np.random.default_rng(1)
    for first_part in body["parts"]:
        first_part["masses_kg"] = rng.permutation(first_part["masses_kg"]).tolist()
    second_answer = matched({**body, "accuracy": {"relative_gap": 1.0}})
    assert answer.certificate.lower_bound is not None
    assert answer.certificate.lower_bound <= answer.certificate.objective
    assert answer.certificate.objective <= second_answer.certificate.objective_as_listed


def test_sixteen_rows_are_far_better_than_listed_and_say_their_gap() -> None:
    """Analytic: no less than nothing is the bound, as equal masses leave nothing."""
    design = machine(mirrored(16), [90.0] * 16)
    answer = matched({"machine": design, "parts": parts(1, 16, 16)})
    certificate = answer.certificate
    assert certificate.method == "sorting"
    assert certificate.lower_bound == pytest.approx(0.0, abs=1e-6)
    assert certificate.objective < 0.02 * certificate.objective_as_listed
    assert certificate.relative_gap == pytest.approx(certificate.objective / certificate.yardstick, rel=1e-6)


@pytest.mark.parametrize("rows", [12, pytest.param(16, marks=pytest.mark.nightly)])
def test_a_rounding_of_the_request_is_none_of_the_answer(rows: int) -> None:
    """The answer is the same every time."""
    body = {"machine": machine(mirrored(rows), [45.0, 135.0] * (rows // 2)), "parts": parts(5, rows, rows)}
    first, second = (match(MatchRequest.model_validate(body)) for _ in range(2))
    assert first.assignments == second.assignments
    assert first.certificate == second.certificate


def test_a_heavy_nut_that_cancels_along_one_axis_is_rounded_as_what_it_is() -> None:
    """What turns with the shaft and against it cancels across the row, to the last digit of the nut."""
    nut = 1e13
    body = {
        "machine": machine([10.0, 200.0], [180.0, 75.0]),
        "parts": parts(1, 2),
        "balance_nuts_kg": [nut],
        "objective": {"combine": "sum", "direction_weights": {"x": 0.0, "y": 1.0}},
    }
    request = MatchRequest.model_validate(body)
    problem = stated(request, request.machine, np.zeros(0), np.zeros(0))
    # analytic: of half a nut on either side
    assert problem.rounding > np.finfo(float).eps * nut * RADIUS
    answer = matched(body)
    assert answer.certificate.lower_bound is not None
    assert answer.certificate.lower_bound <= answer.certificate.objective
