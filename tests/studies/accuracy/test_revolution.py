"""The ladder of goals over a revolution: no grid of angles sees more than there is, and every bound is proven."""

import cmath
import itertools
import json
import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from typer.testing import CliRunner

from optimizer.formulation.task import Task
from optimizer.numerics.arrays import Complex
from optimizer.optimize import optimize
from optimizer.outputs.registry import prepare
from optimizer.outputs.requirements import effects_of_objective
from optimizer.program.cuts.semi_infinite import Problem
from optimizer.studies.accuracy.judge import judge_of
from optimizer.studies.accuracy.methods import ANGLES, LadderProgram, MethodResult
from optimizer.studies.accuracy.revolution import ORDERS, ROUNDS, revolution_methods
from optimizer.studies.accuracy.rivals.grid import angle_cuts, low_orders, order_cuts
from optimizer.studies.accuracy.rivals.sampled import OverTheTurn
from optimizer.studies.accuracy.uncertain import Steps, whole_problem
from schemas.request.accuracy import AccuracyAnswer, AccuracyRequest
from service.cli import app
from tests.night import at_night, part
from tests.optimize.shafts import shaft, single
from tests.studies.accuracy.problems import body
from tests.studies.accuracy.test_choices import ALIKE, CHOSEN, cut, heavy, twin
from tests.studies.accuracy.test_scenarios import several
from tests.studies.accuracy.test_tolerances import BOTH, COUNTERWEIGHTS, by_name, measured

Post = Callable[..., Any]
Machine = dict[str, Any]
EVERY_ORDER = {"orders": "all"}
BEARINGS = {"force_weight": 0.0, "moment_weight": 0.0, "bearing_weight": 1.0}


def with_rods(machine: Machine) -> Machine:
    for throw in machine["throws"]:
        for row in throw["rows"]:
            row["connecting_rod"] = {"length_m": 0.4}
    return machine


def program(machine: Machine, **objective: Any) -> tuple[Steps, LadderProgram]:
    """The ladder's program, with the limits that the search implies."""
    request = AccuracyRequest.model_validate({"machine": machine, "objective": objective})
    task = Task.of(request)
    scene = prepare(request, ("residual",), effects_of_objective(task.objective))
    problem = whole_problem(task, scene)
    steps = Steps(task, scene, np.ones(problem.limits.radius.shape, bool))
    problem = problem.changed(limits=steps.whole(steps.robust(1e-6, 5.0)).limits)
    return steps, LadderProgram(problem.begun, OverTheTurn((), "sum", ()), problem=problem)


def results(steps: Steps, task: LadderProgram) -> dict[tuple[str, str], MethodResult]:
    """Every method that takes part, at the first position of its grid."""
    runs = {(method.name, method.setting): method.prepare()(task, 0.0, 5.0) for method in revolution_methods(steps)}
    return {name: result for name, result in runs.items() if isinstance(result, MethodResult)}


def short_rod(max_mass_kg: float = 30.0) -> Machine:
    """One throw with a short rod, and a web in its plane: force alone."""
    row = {"axis_deg": 0.0, "reciprocating_mass_kg": 14.0, "connecting_rod": {"length_m": 0.3}}
    throws = [
        {"position_m": 0.0, "crank_radius_m": 0.1, "crank_angle_deg": 0.0, "rotating_mass_kg": 9.0, "rows": [row]}
    ]
    webs = [{"name": "a", "throw": 0, "position_m": 0.0, "counterweight_radius_m": 0.1, "max_mass_kg": max_mass_kg}]
    return {"kind": "reciprocating", "speed_rpm": 600, "throws": throws, "webs": webs}


def pushed(theta: float) -> complex:
    """Force of the row as the shaft sees it, over omega^2 [kg m], from the second derivative of the stroke."""
    lam, c, s = 0.1 / 0.3, math.cos(theta), math.sin(theta)
    w = 1.0 - (lam * s) ** 2
    along = c + lam * (c * c - s * s) / math.sqrt(w) + lam**3 * (c * s) ** 2 / w**1.5
    return (14.0 * 0.1 * along + 9.0 * 0.1 * cmath.exp(1j * theta)) * cmath.exp(-1j * theta)


def smallest_radius(points: Complex) -> float:
    """Of a circle around all points, from every pair and every three."""
    centres = [0.5 * (a + b) for a, b in itertools.combinations(points, 2)]
    for a, b, c in itertools.combinations(points, 3):
        d, e = b - a, c - a
        across = 2.0 * (d.real * e.imag - d.imag * e.real)
        if abs(across) > 1e-12:
            centres.append(a + 1j * (d * abs(e) ** 2 - e * abs(d) ** 2) / across)
    return float(np.min(np.max(np.abs(np.array(centres)[:, None] - points), axis=1)))


@pytest.mark.parametrize("angles", [6, 12])
@pytest.mark.parametrize("position", [0.0, 0.25])
def test_a_grid_sees_the_circle_around_its_samples(angles: int, position: float) -> None:
    """Independent: with one web the smallest peak of a grid is the radius of the circle around its samples."""
    steps, task = program(short_rod(), **EVERY_ORDER, moment_weight=0.0)
    (method,) = [entry for entry in revolution_methods(steps) if entry.setting == f"{angles} angles"]
    result = method.prepare()(task, position, 5.0)
    assert isinstance(result, MethodResult)
    grid = 2.0 * np.pi * (np.arange(angles) + position) / angles
    samples = np.array([pushed(theta) for theta in grid.tolist()])
    assert result.claimed == pytest.approx(smallest_radius(samples), rel=1e-8)
    assert result.prove() == pytest.approx(result.claimed, rel=1e-7)
    # the peak between the samples is not seen
    there = max(abs(pushed(theta) + result.unbalance[0]) for theta in np.linspace(0.0, 2.0 * np.pi, 20001).tolist())
    assert task.objective(result.unbalance) == pytest.approx(there, rel=1e-7)
    assert task.objective(result.unbalance) > result.claimed


@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_low_orders_are_those_of_the_frame(sense: float) -> None:
    """Analytic: of orders 1, -2 and 3.5 over two revolutions, as a shaft sees them that turns either way."""
    angle = 4.0 * np.pi * np.arange(96) / 96

    def seen(parts: dict[float, complex]) -> Complex:
        return np.array(sum(size * np.exp(1j * (order - sense) * angle) for order, size in parts.items()))

    every: dict[float, complex] = {1.0: 2.0, -2.0: 0.5j, 3.5: 0.25}
    for most, orders in ((1, [1.0]), (2, [1.0, -2.0]), (4, [1.0, -2.0, 3.5])):
        low = low_orders(seen(every), most, 720.0, sense)
        np.testing.assert_allclose(low, seen({order: every[order] for order in orders}), atol=1e-14)


def test_orders_up_to_two_are_the_row_cut_off() -> None:
    """Published: m r omega^2 (cos theta + lambda cos 2 theta) along the axis, to the third power of lambda."""
    machine = short_rod()
    steps, task = program(machine, **EVERY_ORDER, moment_weight=0.0)
    assert task.problem is not None
    (cuts,) = filter(None, order_cuts(task.problem, 2, 360, steps.senses))
    lam = 0.1 / 0.3
    for entry in cuts[::30]:
        assert entry.angle_deg is not None
        theta = math.radians(entry.angle_deg)
        along = math.cos(theta) + (lam + lam**3 / 4.0 + 15.0 * lam**5 / 128.0) * math.cos(2.0 * theta)
        expected = 1.4 * along * cmath.exp(-1j * theta) + 0.9
        assert entry.constant == pytest.approx(expected, abs=2e-4)


@pytest.mark.parametrize(
    "objective",
    part(
        3,
        [
            BEARINGS,
            {**BEARINGS, "bearing_measure": "rms"},
            {**BEARINGS, "bending_weight": 1.0, "combine": "max"},
            {"orders": "all", "bearing_weight": 0.5},
        ],
    ),
)
def test_no_bound_of_any_method_is_above_what_another_reached(objective: Machine) -> None:
    """Property: angles and cuts are relaxations; finer grids that hold the angles of coarser ones prove more."""
    steps, task = program(body("2d12")["machine"], **objective)
    rows = results(steps, task)
    reached = min(task.objective(result.unbalance) for result in rows.values())
    proven = {name: result.prove() for name, result in rows.items()}
    assert max(proven.values()) <= reached * (1.0 + 1e-9)
    assert proven["service", "relative gap 1e-09"] >= reached * (1.0 - 1e-8)
    grids = [proven["sampled_angles", f"{angles} angles"] for angles in ANGLES]
    if objective.get("bearing_measure") != "rms":
        assert all(finer >= coarser - 1e-6 * reached for coarser, finer in itertools.pairwise(grids))
    assert grids[-1] >= 0.98 * reached
    assert all(proven["orders", f"orders up to {most}"] == -math.inf for most in ORDERS)
    assert proven["cuts", f"{ROUNDS[-1]} rounds"] >= reached * (1.0 - 1e-4)


def test_cuts_of_a_grid_are_never_above_their_quantity() -> None:
    """Property: of peaks and of root mean squares, at any counterweights."""
    for measure in ("peak", "rms"):
        _, task = program(body("2d12")["machine"], **{**BEARINGS, "bearing_measure": measure})
        problem: Problem = task.problem  # type: ignore[assignment]
        cuts, rng = angle_cuts(problem, 24, 0.3), np.random.default_rng(5)
        judge = judge_of(problem)
        for scale in (0.0, 1.0, 10.0):
            u = scale * (rng.normal(size=4) + 1j * rng.normal(size=4))
            largest = max(cut.at(u, problem.scatter) for of_quantity in cuts for cut in of_quantity)
            assert 0.9 * judge.objective(u) <= largest <= judge.objective(u) * (1.0 + 1e-9)


@pytest.mark.parametrize(
    "changes",
    part(
        5,
        [
            {"objective": {**EVERY_ORDER, "force_ceiling_N": 9e3}},
            {"objective": EVERY_ORDER, "tolerances": BOTH},
            {"objective": BEARINGS, "tolerances": COUNTERWEIGHTS},
            {"objective": {"bending_weight": 1.0}, "tolerances": BOTH},
            {"objective": {**EVERY_ORDER, "combine": "max"}, "scenarios": several(body("2d12")["machine"])},
        ],
    ),
)
def test_the_ladder_stands_on_the_optimum_of_the_service(changes: Machine) -> None:
    """Independent: what /v1/optimize answers is the reference, and no row is below it."""
    payload = {"machine": body("2d12")["machine"], **changes}
    measurement, best = measured(**payload), optimize({**payload, "accuracy": {"relative_gap": 1e-9}})
    assert measurement.status == "measured"
    reference, proof = measurement.reference, best.certificate
    assert reference is not None
    assert proof is not None
    assert reference.objective == pytest.approx(proof.objective, rel=2e-8)
    assert reference.objective_without_counterweights == pytest.approx(proof.objective_without_counterweights, rel=1e-9)
    rows = by_name(measurement)
    for row in measurement.ladder:
        if row.skipped is None and not (row.excess or 0.0) > 1e-9:
            assert row.relative_error is not None
            assert row.relative_error >= -1e-12, row
            assert row.certified_gap is None or row.certified_gap >= row.relative_error - 1e-12
    sharp = rows["service", "relative gap 1e-09"].certified_gap
    assert sharp is not None
    assert sharp <= 1e-9
    absent = {row.method for row in measurement.ladder if "knows no revolution" in (row.skipped or "")}
    assert absent >= {"interior_point", "cone_program", "polygonal_cones"}


MADE: dict[str, Callable[[], Machine]] = {
    "groups": lambda: twin(**ALIKE),
    "a catalogue": lambda: twin(**CHOSEN),
    "minimum masses": lambda: heavy(twin()),
    "plates": lambda: cut(twin()),
}


@pytest.mark.parametrize("kind", part(4, MADE))
def test_choices_are_judged_over_the_revolution(kind: str) -> None:
    """Independent: objective and bound of the service, and rounding by hand is no better."""
    machine = with_rods(MADE[kind]())
    objective = {**EVERY_ORDER, "force_ceiling_N": 14e3}
    measurement: AccuracyAnswer = measured(machine, objective=objective)
    assert measurement.status == "measured"
    assert measurement.ladder == ()
    assert measurement.reference is not None
    best = optimize({"machine": machine, "objective": objective, "accuracy": {"relative_gap": 1e-2}})
    assert best.certificate is not None
    row = next(row for row in measurement.choices_ladder if row.setting == "relative gap 1e-02")
    assert row.objective == pytest.approx(best.certificate.objective, rel=1e-9)
    assert row.lower_bound == pytest.approx(best.certificate.lower_bound, rel=1e-9)
    rest = best.certificate.objective_without_counterweights
    assert measurement.reference.objective_without_counterweights == pytest.approx(rest, rel=1e-9)
    rounded = [row for row in measurement.choices_ladder if row.method == "rounding"]
    assert all((row.relative_error or 0.0) >= 0.0 for row in rounded if row.limits_kept)


def test_the_roll_of_balance_shafts_is_sampled_like_all_else() -> None:
    """Property: a response of one number at every angle, which shafts of either sense turn."""
    machine = with_rods(single([shaft("back", -1, max_mass=2.0)]))
    steps, task = program(machine, **EVERY_ORDER, roll_weight=1.0)
    rest = task.judge.at_rest
    for method in revolution_methods(steps):
        if method.setting in ("12 angles", "72 angles"):
            result, angles = method.prepare()(task, 0.25, 5.0), int(method.setting.split()[0])
            assert isinstance(result, MethodResult)
            gap = (task.objective(result.unbalance) - result.prove()) / rest
            assert 0.0 < gap < 50.0 / angles**2


def test_rest_and_ceilings_out_of_reach_are_answers() -> None:
    still = measured(short_rod(max_mass_kg=0.0), objective={**EVERY_ORDER, "moment_weight": 0.0})
    assert (still.status, still.ladder) == ("nothing_to_choose", ())
    low = measured(short_rod(), objective={**EVERY_ORDER, "force_ceiling_N": 10.0})
    assert (low.status, low.reference) == ("infeasible", None)


def test_a_large_grid_is_not_tried(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("optimizer.studies.accuracy.ladder.MAX_ENTRIES", 5_000)
    rows = by_name(measured(short_rod(), objective={**EVERY_ORDER, "moment_weight": 0.0}))
    assert "too large" in (rows["sampled_angles", "720 angles"].skipped or "")
    assert rows["sampled_angles", "36 angles"].skipped is None


@pytest.mark.parametrize(
    ("machine", "objective", "pointer"),
    [
        (twin(), EVERY_ORDER, "/machine/throws/0/rows/0/connecting_rod"),
        ({**body("2d12")["machine"], "bearings": []}, BEARINGS, "/machine/bearings"),
    ],
)
def test_what_is_missing_is_named(post: Post, machine: Machine, objective: Machine, pointer: str) -> None:
    response = post("/v1/accuracy", json.dumps({"machine": machine, "objective": objective}))
    assert response.status_code == 422
    assert pointer in [error["pointer"] for error in response.json()["errors"]]


def test_the_command_names_orders_and_cuts(tmp_path: Any) -> None:
    passage = json.dumps({"machine": short_rod(), "objective": EVERY_ORDER, "repeats": 1}).encode()
    picture = tmp_path / "ladder.svg"
    result = CliRunner().invoke(app, ["accuracy", "-", "--picture", str(picture)], input=passage)
    assert result.exit_code == 0, result.output
    for text in (
        "low orders alone",
        "orders up to 2",
        "cuts at peaks by",
        "polygonal cones, none: knows no revolution",
    ):
        assert text in result.stdout
    assert "low orders alone" in picture.read_text()


@at_night
@pytest.mark.parametrize("name", ["inline-four-engine", "v8-cross-plane", "lanchester-four"])
def test_ladders_of_examples_are_measured(name: str) -> None:
    """Property: with bearings where the machine has them, else with all orders."""
    document = body(name)
    objective = BEARINGS if document["machine"].get("bearings") else EVERY_ORDER
    measurement = measured(document["machine"], objective=objective)
    assert measurement.status == "measured"
    assert measurement.reference is not None
    assert measurement.reference.resolution <= 1e-8
