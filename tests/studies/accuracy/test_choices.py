"""The ladder of counterweights as a workshop makes them: gap, mass and pieces against time."""

import itertools
import json
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from typer.testing import CliRunner

from optimizer.optimize import optimize
from optimizer.studies.accuracy.choices import LIMITS_S
from optimizer.studies.accuracy.measure import accuracy
from schemas.request.accuracy import AccuracyAnswer, ChoiceRow
from service.cli import app
from service.report.accuracy_picture import draw
from tests.night import part

Post = Callable[..., Any]
Machine = dict[str, Any]


def twin(**changes: Any) -> Machine:
    """Two throws at right angles with a web on either side of each, which cannot carry all that is wanted."""
    throws = [
        {"position_m": z, "crank_radius_m": 0.1, "crank_angle_deg": angle, "rotating_mass_kg": 9.0,
         "rows": [{"axis_deg": 0.0, "reciprocating_mass_kg": 14.0}]}
        for z, angle in ((-0.3, 0.0), (0.3, 90.0))
    ]  # fmt: skip
    webs = [
        {"name": f"{n}{side}", "throw": n, "position_m": z + off, "counterweight_radius_m": 0.15, "max_mass_kg": 9.0}
        for n, z in ((0, -0.3), (1, 0.3))
        for side, off in (("a", -0.1), ("b", 0.1))
    ]
    return {"kind": "reciprocating", "speed_rpm": 600, "throws": throws, "webs": webs, **changes}


CHOSEN = {"catalogue": {"masses_kg": [3.0, 5.0, 8.0], "angle_step_deg": 60}}
ALIKE = {"web_groups": [{"name": "ends", "webs": ["0a", "1b"]}, {"name": "inner", "webs": ["0b", "1a"]}]}


def heavy(machine: Machine) -> Machine:
    for web in machine["webs"]:
        web["min_fitted_mass_kg"] = 7.0
    return machine


def cut(machine: Machine) -> Machine:
    for web in machine["webs"]:
        del web["counterweight_radius_m"], web["max_mass_kg"]
        web["envelope"] = {"shape": "sector", "inner_radius_m": 0.06, "outer_radius_m": 0.16, "thickness_m": 0.03}
    return machine


MADE: dict[str, Callable[[], Machine]] = {
    "a catalogue": lambda: twin(**CHOSEN),
    "two sizes of steps": lambda: twin(
        catalogue={"mass_step_kg": 1.0, "angle_step_deg": 30, "max_part_numbers": 1}, max_counterweights=2
    ),
    "groups": lambda: twin(**ALIKE),
    "a catalogue in groups": lambda: twin(**CHOSEN, **ALIKE),
    "minimum masses": lambda: heavy(twin()),
    "minimum masses in groups": lambda: heavy(twin(**ALIKE)),
    "plates": lambda: cut(twin()),
    "plates in groups, under a budget": lambda: cut(twin(**ALIKE, max_total_mass_kg=20.0)),
}


#: half a minute
LONG = ("minimum masses in groups",)


def measured(machine: Machine, **more: Any) -> AccuracyAnswer:
    return accuracy({"machine": machine, "repeats": 1, **more})


def answered(rows: tuple[ChoiceRow, ...]) -> list[ChoiceRow]:
    return [row for row in rows if row.skipped is None]


@pytest.mark.parametrize(
    "kind", part(2, [pytest.param(kind, marks=pytest.mark.nightly) if kind in LONG else kind for kind in MADE])
)
def test_every_kind_has_rows_that_agree_with_the_service(kind: str) -> None:
    """Each row is what /v1/optimize answers to that gap or time (independent), and no bound is above a value."""
    machine = MADE[kind]()
    measurement = measured(machine)
    assert measurement.status == "measured"
    assert measurement.ladder == ()
    reference, rows = measurement.reference, measurement.choices_ladder
    assert reference is not None
    assert reference.objective_of_any_mass is not None
    assert reference.lower_bound <= reference.objective
    rest = reference.objective_without_counterweights
    for row, gap in zip(rows[:3], (1e-2, 1e-3, 1e-4), strict=True):
        assert row.setting == f"relative gap {gap:.0e}"
        answer = optimize({"machine": machine, "accuracy": {"relative_gap": gap}})
        assert answer.certificate is not None
        assert row.status == answer.status == "optimal"
        assert row.limits_kept
        assert row.objective == pytest.approx(answer.certificate.objective, rel=1e-12)
        assert row.lower_bound == pytest.approx(answer.certificate.lower_bound, rel=1e-12)
        assert row.total_mass_kg == pytest.approx(answer.total_mass_kg, rel=1e-12)
        assert row.pieces == sum(1 for counterweight in answer.counterweights if counterweight.mass_kg > 0.0)
        assert row.certified_gap is not None
        assert row.certified_gap <= gap
    for row in answered(rows):
        assert row.objective is not None
        assert row.relative_error == pytest.approx((row.objective - reference.lower_bound) / rest, abs=1e-12)
        if row.limits_kept:
            assert row.objective >= reference.lower_bound - 1e-9 * rest
    assert any(row.on_frontier for row in rows)
    searched = "catalogue" in machine or "min_fitted_mass_kg" in machine["webs"][0]
    assert any(row.setting == "0.1 s" for row in rows) == searched
    assert any(row.method == "rounding" for row in rows) == ("plates" not in kind)


def test_the_reference_is_the_best_of_all_sets() -> None:
    """A catalogue of 19 options on each of two webs, by brute force (independent)."""
    machine = twin(**CHOSEN)
    machine["webs"] = machine["webs"][::3]
    answer = measured(machine)
    assert answer.reference is not None
    lever, square = np.array([-0.4, 0.4]), (600 * np.pi / 30) ** 2
    options = [0.0, *(m * 0.15 * np.exp(1j * np.pi / 3 * n) for m in (3.0, 5.0, 8.0) for n in range(6))]
    crank, z = np.array([1.0, 1j]), np.array([-0.3, 0.3])
    turning, counter = 0.1 * (9.0 + 7.0) * crank, 0.1 * 7.0 * np.conj(crank)
    weight = 1.0 / (lever[1] - lever[0])

    def value(first: complex, second: complex) -> float:
        u = np.array([first, second * 1j])
        force = abs(np.sum(turning) + np.sum(u)) + abs(np.sum(counter))
        moment = abs(np.sum(z * turning) + np.sum(lever * u)) + abs(np.sum(z * counter))
        return float(square * (force + weight * moment))

    best = min(value(*pair) for pair in itertools.product(options, repeat=2))
    assert answer.reference.objective == pytest.approx(best, rel=1e-9)
    assert answer.reference.lower_bound == pytest.approx(best, rel=1e-6)


def by_hand(machine: Machine) -> ChoiceRow:
    rows = measured(machine, objective={"least_mass": False}).choices_ladder
    return next(row for row in rows if row.method == "rounding")


def test_rounding_is_the_nearest_of_every_web() -> None:
    """Steps by which the optimum of any masses is missed (independent: rounded here), and limits that it breaks."""
    machine = twin(catalogue={"masses_kg": [2.0, 4.0, 6.0, 8.0], "angle_step_deg": 45})
    free = optimize({"machine": twin(), "objective": {"least_mass": False}})
    rounded = next(
        row for row in measured(machine, objective={"least_mass": False}).choices_ladder if row.method == "rounding"
    )
    mass = []
    for counterweight in free.counterweights:
        u = counterweight.mass_kg * np.exp(1j * np.radians(counterweight.angle_deg))
        held = [0.0, *(m * np.exp(1j * np.pi / 4 * n) for m in (2.0, 4.0, 6.0, 8.0) for n in range(8))]
        mass.append(abs(min(held, key=lambda option: abs(u - option))))
    assert rounded.total_mass_kg == pytest.approx(sum(mass), rel=1e-9)
    assert rounded.limits_kept
    assert rounded.lower_bound is None
    broken = by_hand({**machine, "max_counterweights": 1})
    assert not broken.limits_kept
    assert not broken.on_frontier


def test_the_longest_limit_is_that_of_the_request() -> None:
    """And a shorter one that closes the gap leaves nothing to longer ones."""
    rows = measured(twin(**CHOSEN), accuracy={"time_limit_s": 0.5}).choices_ladder
    settings = [row.setting for row in rows if row.setting.endswith(" s")]
    assert settings == [f"{limit:g} s" for limit in (*(limit_s for limit_s in LIMITS_S if limit_s < 0.5), 0.5)]
    assert rows[-2].skipped == "0.1 s sufficed"


def test_a_gap_that_is_not_reached_ends_the_gaps() -> None:
    """Steps that no search of a thousandth of a second can compare: the time is respected, and the rows say so."""
    machine = twin(catalogue={"mass_step_kg": 0.1, "angle_step_deg": 2, "max_part_numbers": 2})
    rows = measured(machine, accuracy={"time_limit_s": 0.001}).choices_ladder
    late = [row for row in rows if row.status == "inaccurate"]
    assert late
    assert all(row.time_ms is not None and row.time_ms < 5000.0 for row in late)


def test_ceilings_that_no_choice_keeps() -> None:
    answer = measured(twin(**CHOSEN), objective={"force_ceiling_N": 1.0})
    assert answer.status == "infeasible"
    assert answer.choices_ladder == ()
    assert answer.reference is None


@pytest.mark.parametrize(
    ("machine", "status"),
    [
        (lambda: twin(**CHOSEN, max_counterweights=0), "measured"),
        (lambda: {**twin(**CHOSEN), "webs": []}, "nothing_to_choose"),
    ],
)
def test_nothing_to_choose(machine: Callable[[], Machine], status: str) -> None:
    assert measured(machine()).status == status


def test_route_command_and_picture(post: Post) -> None:
    body = json.dumps({"machine": twin(**CHOSEN), "repeats": 1})
    response = post("/v1/accuracy", body)
    assert response.status_code == 200
    answer = AccuracyAnswer.model_validate_json(response.content)
    assert [row.setting for row in answer.choices_ladder][-1] == "nearest"
    result = CliRunner().invoke(app, ["accuracy", "-"], input=body)
    assert result.exit_code == 0
    for text in ("counterweights as they are made", "rounding by hand", "relative gap 1e-04", "pieces", "sufficed"):
        assert text in result.stdout
    assert "rounding by hand" in draw("twin", answer)


@pytest.mark.parametrize(
    ("changes", "pointer"),
    [
        ({"alternatives": [0.01]}, "/alternatives"),
        ({"objective": {"priorities": [{"goal": "external"}, {"goal": "mass"}]}}, "/objective/priorities"),
        ({"scenarios": [{"name": "a"}, {"name": "a"}]}, "/scenarios/1/name"),
        ({"accuracy": {"time_limit_s": 31}}, "/accuracy/time_limit_s"),
        ({"machine": twin(catalogue={"masses_kg": [3.0], "angle_step_deg": 7})}, "/machine/catalogue/angle_step_deg"),
        ({"machine": heavy(twin(web_groups=[{"name": "g", "webs": ["0a", "9"]}]))}, "/machine/web_groups/0/webs/1"),
    ],
)  # fmt: skip
def test_what_does_not_go_names_its_field(post: Post, changes: dict[str, Any], pointer: str) -> None:
    response = post("/v1/accuracy", json.dumps({"machine": twin(**CHOSEN), "repeats": 1} | changes))
    assert response.status_code == 422
    assert pointer in [error["pointer"] for error in response.json()["errors"]]
