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
    given, classes = machine(cranks, axes), parts(len(cranks), *counts)
    moment_weight = 2.0 if combined else 0.0
    body = {"machine": given, "parts": classes, "objective": {"moment_weight": moment_weight}}
    found = matched(body | {"accuracy": {"relative_gap": 1e-9}})
    values = objective(given, every(classes, len(cranks)), moment_weight)
    assert found.status == "optimal"
    assert found.certificate.method == "exhaustion"
    assert found.certificate.objective == pytest.approx(np.min(values), abs=1e-9 * np.max(values))
    assert found.certificate.objective_as_listed == pytest.approx(values[0], rel=1e-9, abs=1e-9)
    row_masses = np.array([row.reciprocating_mass_kg for row in found.rows])
    assert objective(given, row_masses, moment_weight) == pytest.approx(np.min(values), abs=1e-9 * np.max(values))


def test_two_classes_of_six_are_the_best_of_all() -> None:
    """Independent: for every order of one class the best of the other, 720 squared."""
    given, classes = machine(mirrored(6), [90.0] * 6), parts(3, 6, 6)
    found = matched({"machine": given, "parts": classes, "accuracy": {"relative_gap": 1e-9}})
    orders = [np.array(list(permutations(one["masses_kg"]))) for one in classes]
    sums = [objective_vectors(given, some) for some in orders]
    base = objective_vectors(given, np.full(6, 12.0))
    least = min(float(np.min(np.sum(np.abs(base + sums[0] + one), axis=-1) * 2.0)) for one in sums[1])
    assert found.certificate.objective == pytest.approx(least * RADIUS * OMEGA**2, rel=1e-9)
    assert found.certificate.method == "exhaustion"


def objective_vectors(given: Any, row_masses: np.ndarray) -> np.ndarray:
    """Force and moment over the span of 1.5 m turning with the shaft; on vertical axes the counterpart is as long."""
    crank = np.exp(1j * np.deg2rad([one["crank_angle_deg"] for one in given["throws"]]))
    place = np.array([one["position_m"] for one in given["throws"]])
    return np.stack([row_masses @ (0.5 * crank), row_masses @ (0.5 * crank * place / 1.5)], axis=-1)


@pytest.mark.parametrize("largest", [False, True])
def test_unequal_directions_and_the_larger_peak(largest: bool) -> None:
    """Independent: every assignment, each evaluated as a machine of its own."""
    goal: dict[str, Any] = {"combine": "max"} if largest else {"direction_weights": {"x": 1.0, "y": 0.2}}
    given, classes = machine([0.0, 120.0, 240.0, 60.0], [30.0, 90.0, 150.0, 0.0]), parts(8, 4)
    found = matched({"machine": given, "parts": classes, "objective": goal})
    best = np.inf
    for row_masses in every(classes, 4).tolist():
        throws = [
            one | {"rows": [one["rows"][0] | {"reciprocating_mass_kg": mass}]}
            for one, mass in zip(given["throws"], row_masses, strict=True)
        ]
        asked = OptimizeRequest.model_validate({"machine": given | {"throws": throws}, "objective": goal})
        certificate = optimize(asked).certificate
        assert certificate is not None
        best = min(best, certificate.objective)
    assert found.certificate.objective == pytest.approx(best, rel=1e-9)


def test_a_search_that_has_no_time_says_its_gap() -> None:
    """Nothing but the assignment as listed is solved, and what is proven holds for the best of all."""
    given, classes = machine([0.0, 90.0, 180.0, 270.0], [45.0, 135.0] * 2, (-0.7, 0.7), 0.2), parts(2, 4)
    body = {"machine": given, "parts": classes, "choose_counterweights": True}
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
    given, classes = machine([0.0, 90.0, 180.0, 270.0], [45.0, 135.0] * 2, (-0.7, 0.7), most), parts(2, 4)
    found = matched(
        {"machine": given, "parts": classes, "choose_counterweights": True, "accuracy": {"relative_gap": 1e-5}}
    )
    bodies_ = []
    for row_masses in every(classes, 4).tolist():
        throws = [
            one | {"rows": [one["rows"][0] | {"reciprocating_mass_kg": mass}]}
            for one, mass in zip(given["throws"], row_masses, strict=True)
        ]
        bodies_.append({"machine": given | {"throws": throws}})
    answers = [optimize(OptimizeRequest.model_validate(body)).certificate for body in bodies_]
    best = min(one.objective for one in answers if one is not None)
    assert found.status == "optimal"
    assert found.certificate.lower_bound is not None
    assert found.certificate.lower_bound <= best * (1 + 1e-9)
    assert found.certificate.objective == pytest.approx(best, abs=2e-6 * found.certificate.yardstick)
    assert {one.web for one in found.counterweights} == {"w0", "w1"}


def test_the_residual_force_of_the_2d12_is_a_difference_of_masses() -> None:
    """Published: its rows differ by 26.07 kg (the design calculation of the 2D12-90/2-20); analytic: m r omega^2."""
    body = bodies("match")["2d12"]
    for throw, mass in zip(body["machine"]["throws"], (277.79, 251.72), strict=True):
        throw["rows"][0]["reciprocating_mass_kg"] = mass
    body = {**body, "parts": [], "balance_nuts_kg": [25, 26, 27], "objective": {"moment_weight": 0}}
    found = matched(body)
    kilogram = 0.14 * (500 * np.pi / 30) ** 2
    assert found.residual.before.force.peak_N == pytest.approx(26.07 * kilogram, rel=1e-9)
    assert found.residual.after.force.peak_N == pytest.approx(0.07 * kilogram, rel=1e-9)
    assert [(one.throw, one.kind, one.mass_kg) for one in found.assignments] == [(1, "balance_nut", 26.0)]
    assert [one.part for one in found.spares] == ["1", "3"]


def test_equal_masses_leave_nothing_to_match() -> None:
    """Analytic: mirrored cranks all around balance equal rows; the parts go where they are listed."""
    given = machine(mirrored(8), [90.0] * 8)
    found = matched({"machine": given, "parts": parts(1, 8, scatter=0.0)})
    assert found.residual.after.force.peak_N == 0.0
    assert found.residual.after.moment.peak_Nm == pytest.approx(0.0, abs=1e-9)
    assert (found.status, found.certificate.relative_gap) == ("optimal", 0.0)
    assert [one.part for one in found.assignments] == [f"0.{k}" for k in range(8)]


def test_each_part_goes_on_one_row() -> None:
    given, classes = machine(mirrored(6), [90.0] * 6), parts(4, 6, 3)
    classes[1]["rows"] = [{"throw": t, "row": 0} for t in (4, 1, 2)]
    found = matched({"machine": given, "parts": classes, "balance_nuts_kg": [0.5, 0.5, 1.0]})
    for one in classes:
        taken = [each for each in found.assignments if each.kind == one["class"]]
        assert sorted(each.part for each in taken) == sorted(one["names"])
        assert {each.part: each.mass_kg for each in taken} == dict(zip(one["names"], one["masses_kg"], strict=True))
        assert len({(each.throw, each.row) for each in taken}) == len(taken)
    assert {each.throw for each in found.assignments if each.kind == "class 1"} == {1, 2, 4}
    nuts = [each for each in found.assignments if each.kind == "balance_nut"]
    assert len({each.throw for each in nuts}) == len(nuts)
    assert sorted([each.part for each in nuts] + [each.part for each in found.spares]) == ["1", "2", "3"]
    for row in found.rows:
        on = sum(each.mass_kg for each in found.assignments if (each.throw, each.row) == (row.throw, row.row))
        assert row.reciprocating_mass_kg == pytest.approx(12.0 + on, rel=1e-12)


def test_the_order_of_the_list_changes_nothing() -> None:
    """Metamorphic: the same parts in another order, and one class after the other way round."""
    given, classes = machine(mirrored(6), [60.0] * 6), parts(6, 6, 6)
    turned = [one | {"names": one["names"][::-1], "masses_kg": one["masses_kg"][::-1]} for one in reversed(classes)]
    close = {"accuracy": {"relative_gap": 1e-9}, "machine": given}
    one, other = matched({**close, "parts": classes}), matched({**close, "parts": turned})
    assert one.certificate.objective == pytest.approx(other.certificate.objective, rel=1e-9)
    assert one.certificate.method == other.certificate.method == "exhaustion"


def test_counterweights_that_are_there() -> None:
    """Analytic: one row in line and its counterpart; the counterweight takes the place of what it weighs."""
    given = machine([0.0, 180.0], [0.0, 180.0], (0.0,))
    parts_ = [{"class": "rod", "names": ["a", "b"], "masses_kg": [10.0, 14.0]}]
    goal = {"moment_weight": 0}
    fitted = [{"web": "w0", "mass_kg": 2.4, "angle_deg": 180.0}]
    found = matched({"machine": given, "parts": parts_, "counterweights": fitted, "objective": goal})
    # the heavier on throw 1, 4 kg at 0.12 m: half of it turns with the shaft, 0.24 kg m, and is taken away
    assert found.residual.after.force.co_rotating_N == pytest.approx(0.0, abs=1e-9)
    assert [one.part for one in found.assignments] == ["b", "a"]
    assert found.total_mass_kg == 2.4


@pytest.mark.parametrize("name", bodies("match"))
def test_the_bound_holds(name: str) -> None:
    """Metamorphic: what a random assignment comes to is no less than the bound, nor than the answer."""
    body = bodies("match")[name]
    found = matched(body)
    rng = np.random.default_rng(1)
    for one in body["parts"]:
        one["masses_kg"] = rng.permutation(one["masses_kg"]).tolist()
    other = matched({**body, "accuracy": {"relative_gap": 1.0}})
    assert found.certificate.lower_bound is not None
    assert found.certificate.lower_bound <= found.certificate.objective
    assert found.certificate.objective <= other.certificate.objective_as_listed


def test_sixteen_rows_are_far_better_than_listed_and_say_their_gap() -> None:
    """Analytic: no less than nothing is the bound, as equal masses leave nothing."""
    given = machine(mirrored(16), [90.0] * 16)
    found = matched({"machine": given, "parts": parts(1, 16, 16)})
    certificate = found.certificate
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
