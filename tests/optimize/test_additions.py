"""A response is added in one file of its own and a registration, and nothing else has to know it.

What knows the pair of the contract by name is listed here too.
"""

import re
from pathlib import Path

import cvxpy as cp
import numpy as np
import pytest

import optimizer
from optimizer.formulation.formulate import RESPONSES, Weighable, objective_ceilings
from optimizer.formulation.goals import cone_program
from optimizer.formulation.limits import limits
from optimizer.formulation.simulation import Prepared
from optimizer.mechanics.frame import Shares
from optimizer.mechanics.inertia import reciprocating
from optimizer.mechanics.layout import Layout
from optimizer.mechanics.slider_crank import acceleration_harmonic
from optimizer.outputs.registry import prepare
from optimizer.program.rows import combined, statement, weighted_peak
from optimizer.program.solution import ConeSolution
from optimizer.program.statement import Statement
from optimizer.program.verdict import claim, verdict
from optimizer.responses.response import Phasors, Response
from optimizer.studies.sweep.counterweights import optimal
from schemas.base.responses import RESPONSES as FIELDS
from schemas.base.responses import ResponseFields
from schemas.request.objective import Objective
from schemas.request.requests import OptimizeRequest
from tests.program.cases import optimum

#: plane of a bearing about which a couple shall be small as well, m; its weight [1/(N m)]
PLANE, WEIGHT = 0.7, 0.2
MACHINE = {
    "kind": "reciprocating",
    "speed_rpm": 900.0,
    "throws": [
        {
            "position_m": z,
            "crank_radius_m": 0.1,
            "crank_angle_deg": angle,
            "rotating_mass_kg": 4.0,
            "rows": [{"axis_deg": axis, "reciprocating_mass_kg": mass}],
        }
        for z, angle, axis, mass in ((-0.3, 0.0, 90.0, 9.0), (0.3, 110.0, 60.0, 12.0))
    ],
    "webs": [
        {"name": name, "position_m": z, "counterweight_radius_m": 0.15, "max_mass_kg": most}
        for name, z, most in (("a", -0.4, 3.0), ("b", 0.05, 20.0), ("c", 0.4, 20.0))
    ],
}
REQUEST = OptimizeRequest.model_validate({"machine": MACHINE})
#: where the pair of the contract may be named, and why
NAMED_IN = {
    "mechanics/inertia.py": "makes them",
    "mechanics/frame.py": "makes others of them",
    "formulation/formulate.py": "translates the fields of the contract",
    "outputs/first_order.py": "fields of the answer",
    "outputs/cautions.py": "warns of both",
    "outputs/stages.py": "figures of both",
    "outputs/stage_parts.py": "figures of both",
    "outputs/phasors.py": "fields of the answer",
    "outputs/rules_of_thumb.py": "figures of both",
    "outputs/balance_quality.py": "what turns with the shaft of both",
    "studies/pareto/counts.py": "fields of the answer",
    "studies/pareto/pareto.py": "a front is of these two: fields of its answer",
    "studies/pareto/choice_front.py": "weighs and limits one of these two: fields of its answer",
    "solve/worst_case.py": "fields of the answer",
    "studies/pareto/lines.py": "fields of the answer",
    "studies/pareto/choice_trades.py": "fields of the answer",
    # another force or torque altogether
    "effects/dynamics.py": "friction",
    "outputs/dynamics.py": "of the piston",
    # columns by their names
    "outputs/orders.py": "columns of sweeps",
    "outputs/details/first_order.py": "columns of sweeps",
    "mechanics/gas.py": "of the gas",
}


class _Objective(Objective):
    couple_weight: float = WEIGHT
    couple_ceiling_Nm: float | None = None


def _register(monkeypatch: pytest.MonkeyPatch, ceiling: float | None = None) -> OptimizeRequest:
    """The request whose objective weighs, and limits, the couple about the plane."""
    fields = ResponseFields("couple", "N m", "couple about a bearing")
    monkeypatch.setitem(FIELDS, fields.name, fields)
    # that about the reference plane, moved by the force
    couple = Weighable(fields, lambda layout, objective: Shares(layout.reference_plane - PLANE, 1.0))
    monkeypatch.setitem(RESPONSES, fields.name, couple)
    return REQUEST.model_copy(update={"objective": _Objective(couple_ceiling_Nm=ceiling)})


def _solved(request: OptimizeRequest) -> tuple[Prepared, Statement, ConeSolution]:
    scene = prepare(request, ("residual",))
    program = cone_program(request.machine, request.objective, scene.responses, scene.omega_squared)
    solution = optimum(program, 1e-6, True)
    assert isinstance(solution, ConeSolution)
    return scene, program, solution


def _by_hand(scene: Prepared, limit: float | None) -> float:
    """Independent: the smallest objective [N], masses summed by hand and posed in complex variables."""
    turning, rows = scene.layout.rotating, scene.layout.reciprocating
    u = cp.Variable(3, complex=True)
    z = np.array([web.position_m for web in scene.machine.webs])
    span = 0.8  # of throws and webs, m
    peaks = []
    for about in (None, float(scene.layout.reference_plane), PLANE):
        arm, own, web = (
            (lambda at, about=about: np.ones_like(at) if about is None else at - about)(position)
            for position in (turning.position, rows.position, z)
        )
        half = 0.5 * rows.mass * rows.crank_radius * own
        co = np.sum(turning.mass * turning.radius * turning.direction * arm) + np.sum(half * rows.crank_direction)
        counter = np.sum(half * np.conj(rows.crank_direction) * rows.axis**2)
        peaks.append(cp.abs(co + web @ u) + abs(counter))
    most = np.array([web.max_mass_kg * web.counterweight_radius_m for web in scene.machine.webs])
    rules = [cp.abs(u) <= most]
    if limit is not None:
        rules.append(peaks[2] <= limit / scene.omega_squared)
    goal = cp.Minimize(peaks[0] + peaks[1] / span + WEIGHT * peaks[2])
    return float(cp.Problem(goal, rules).solve(solver=cp.CLARABEL)) * scene.omega_squared


@pytest.mark.parametrize("limited", [False, True])
def test_a_response_is_weighed_limited_and_certified(monkeypatch: pytest.MonkeyPatch, limited: bool) -> None:
    request = _register(monkeypatch)
    scene, _, free = _solved(request)
    limit = None
    if limited:
        peak = combined([weighted_peak(scene.responses[2], 1.0)], "max")
        least = optimum(statement(peak, [], limits(request.machine)), 1e-6, False)
        assert isinstance(least, ConeSolution)
        # half-way from what it is to what it can be
        limit = 0.5 * (float(scene.responses[2].to(free.unbalance).peak) + least.objective) * scene.omega_squared
        request = _register(monkeypatch, limit)
        assert [(fields.response, most) for fields, most in objective_ceilings(request.objective)] == [
            ("couple", limit)
        ]
    scene, program, solution = _solved(request)
    assert program.names.terms[2].response == "couple"
    mass = np.asarray(program.mass(solution.unbalance))
    bound, of_mass = np.asarray(solution.lower_bound), np.asarray(solution.mass_lower_bound)
    judged = verdict(claim(program, solution.unbalance, mass, bound, solution.multipliers, of_mass), 1e-6)
    assert judged.status == "optimal", judged.reason
    # the objective is what its responses come to over the turn, sampled
    turned = np.linspace(0.0, 2.0 * np.pi, 20_000)
    peaks = [np.max(np.abs(response.over_turn(solution.unbalance, turned))) for response in scene.responses]
    assert solution.objective == pytest.approx(peaks[0] + peaks[1] / 0.8 + WEIGHT * peaks[2], rel=1e-6)
    rest = float(program.objective(np.zeros(3, complex))) * scene.omega_squared
    assert solution.objective * scene.omega_squared == pytest.approx(_by_hand(scene, limit), abs=1.01e-6 * rest)
    if limit is not None:
        assert peaks[2] * scene.omega_squared == pytest.approx(limit, rel=1e-6)
        # either is an optimum up to a millionth
        assert solution.objective > free.objective - 1e-6 * rest / scene.omega_squared


def _backwards(layout: Layout) -> Response:
    """Second order of the force, which unbalances on a shaft that turns backwards at twice the speed can change.

    The vector that turns with that shaft is the one against the crank; (2 omega)^2 is 4 omega^2.
    """
    force = reciprocating(layout, 2).force
    return Response("second", "N", Phasors(force.counter, force.co), 4.0 * np.ones(3), order=2, sense=-1)


def test_order_and_sense_say_how_a_response_turns(monkeypatch: pytest.MonkeyPatch) -> None:
    """Independent: force of the rows along their axes, and of the unbalances at -2 theta, sampled over the turn."""

    monkeypatch.setattr("optimizer.formulation.goals.weights", lambda *_: {"second": 1.0})
    throws = [
        {**throw, "rows": [{**row, "connecting_rod": {"length_m": 0.4}} for row in throw["rows"]]}
        for throw in MACHINE["throws"]
    ]
    request = OptimizeRequest.model_validate({"machine": {**MACHINE, "throws": throws}})
    scene = prepare(request, ("residual",))
    response = _backwards(scene.layout)
    program = cone_program(request.machine, request.objective, (response,), scene.omega_squared)
    solution = optimum(program, 1e-6, True)
    assert isinstance(solution, ConeSolution)
    assert solution.gap <= 1e-6 * float(program.at_rest)
    turned = np.linspace(0.0, 2.0 * np.pi, 3_601)
    rows = scene.layout.reciprocating
    axis, own = np.deg2rad([90.0, 60.0]), np.deg2rad([0.0 - 90.0, 110.0 - 60.0])
    size = rows.mass * rows.crank_radius * acceleration_harmonic(2, rows.rod_ratio)
    pushed = np.sum(size * np.exp(1j * axis) * np.cos(2.0 * (turned[:, None] + own)), axis=-1)
    force = pushed + 4.0 * np.sum(solution.unbalance) * np.exp(-2j * turned)
    np.testing.assert_allclose(response.over_turn(solution.unbalance, turned), force, atol=1e-12)
    assert np.max(np.abs(force)) == pytest.approx(solution.objective, rel=1e-5)
    # analytic: what turns with the crank at twice its speed is left
    assert solution.objective == pytest.approx(abs(reciprocating(scene.layout, 2).force.co), abs=2e-6 * program.at_rest)


def test_a_sweep_knows_the_response_as_well(monkeypatch: pytest.MonkeyPatch) -> None:
    request = _register(monkeypatch)
    scene, _, solution = _solved(request)
    columns, unbalance = optimal(request, 3)
    assert columns["status"].tolist() == ["optimal"] * 3
    np.testing.assert_allclose(columns["objective"], solution.objective * scene.omega_squared, rtol=1e-12)
    np.testing.assert_allclose(unbalance, np.tile(solution.unbalance, (3, 1)), rtol=1e-9, atol=1e-12)


def test_only_these_files_name_the_responses_of_the_contract() -> None:
    root = Path(optimizer.__file__).parent
    name = re.compile(r"""["'](force|moment)["']|\b(force|moment)_(weight|ceiling)|\.(force|moment)\b""")
    texts = {str(path.relative_to(root)) for path in root.rglob("*.py") if name.search(path.read_text("utf-8"))}
    assert texts == set(NAMED_IN)
