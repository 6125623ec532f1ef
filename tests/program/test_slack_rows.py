"""Even layouts, whose force is nothing to begin with: least masses are proven by the compiled interior point."""

from typing import Any

import numpy as np
import pytest

from optimizer.formulation.formulate import responses
from optimizer.formulation.goals import cone_program
from optimizer.formulation.task import Task
from optimizer.mechanics.inertia import reciprocating, rotating
from optimizer.mechanics.layout import layout
from optimizer.program.certificate import mass_lower_bound, objective_lower_bound
from optimizer.program.kernel.finer_numbers import FIFTY_DIGITS
from optimizer.program.methods.cascade import _in_finer_numbers
from optimizer.program.methods.compiled import stage_solutions
from optimizer.program.methods.inactive_rows import ActiveRows, near_rows, settle_without_slack_rows
from optimizer.program.methods.single import Target, interior_point
from optimizer.program.rows import combined, statement, weighted_peak
from optimizer.program.solution import INTERIOR_POINT, evaluated
from optimizer.program.statement import Statement
from optimizer.program.verdict import yardstick
from optimizer.responses.response import Phasors, Response
from optimizer.solve.certify import certified
from schemas.base.rules import Path
from schemas.base.variation import with_fields
from schemas.request.objective import Objective
from schemas.request.requests import OptimizeRequest
from tests.studies.accuracy.problems import free_limits

THROWS, ORDERS = 9, 120


def even(most: float) -> OptimizeRequest:
    """Orders of nine even throws with two webs each, in columns, the larger of force and moment."""
    throws = [
        {"position_m": 0.2 * t, "crank_radius_m": 0.1, "crank_angle_deg": 0.0, "rotating_mass_kg": 10,
         "rows": [{"axis_deg": 90, "reciprocating_mass_kg": 10}]}
        for t in range(THROWS)
    ]  # fmt: skip
    webs = [
        {"name": f"{t}{side}", "position_m": 0.2 * t + off, "counterweight_radius_m": 0.15, "max_mass_kg": most}
        for t in range(THROWS)
        for side, off in (("a", -0.06), ("b", 0.06))
    ]
    machine = {"kind": "reciprocating", "speed_rpm": 600, "throws": throws, "webs": webs}
    base = OptimizeRequest.model_validate({"machine": machine, "objective": {"combine": "max"}})
    random = np.random.default_rng(1)
    orders = np.array([[0, *(1 + random.permutation(THROWS - 1))] for _ in range(ORDERS)])
    columns: dict[Path, Any] = {
        ("machine", "throws", t, "crank_angle_deg"): 360.0 / THROWS * orders[:, t] for t in range(THROWS)
    }
    varied = with_fields(base, columns)
    assert isinstance(varied, OptimizeRequest)
    return varied


@pytest.mark.parametrize("most", [0.3, 1.0])
def test_least_masses_of_even_layouts_are_proven_without_another_solver(most: float) -> None:
    request = even(most)
    shaft = layout(request.machine)
    square = np.broadcast_to(shaft.omega**2, (ORDERS,))
    quantities = responses(shaft, rotating(shaft).plus(reciprocating(shaft, 1)), Objective())
    best = certified(request.machine, request.objective, quantities, square, Task.of(request).demand)
    assert set(best.optima.method) == {INTERIOR_POINT}
    assert set(best.status) == {"optimal"}
    # the same program as both stages leave it: some of its masses are not proven
    program = cone_program(request.machine, request.objective, quantities, square)
    share = 1e-6 * yardstick(program)
    stages = stage_solutions(program, share, share, True)
    left = np.flatnonzero(~stages.certified)
    assert left.size
    low = stages.mass_lower_bound[left].copy()
    settle_without_slack_rows(program, share, share, True, stages)
    assert np.all(stages.certified)
    assert np.all(stages.mass_lower_bound[left] >= low)
    # what is proven is proven by the multipliers of the whole program
    assert objective_lower_bound(program, stages.multipliers) == pytest.approx(stages.lower_bound, rel=1e-12)
    proven = mass_lower_bound(program, stages.mass_multipliers, stages.mass_target)
    assert proven == pytest.approx(stages.mass_lower_bound, rel=1e-12)
    assert np.all(program.objective(stages.unbalance) <= stages.lower_bound + share * (1 + 1e-9))


def _two_rows() -> Statement:
    """The larger of |10 u - 10| and |u + 3|, of one web that reaches 2 kg m."""
    peaks = [
        weighted_peak(Response(name, "N", Phasors(np.asarray(co + 0j), np.asarray(0j)), np.array([influence])), 1.0)
        for name, co, influence in (("steep", -10.0, 10.0), ("flat", 3.0, 1.0))
    ]
    return statement(combined(peaks, "max"), [], free_limits([2.0]))


@pytest.mark.parametrize("u", [-1.0, 0.9, 7 / 11, -3.0])
def test_a_row_that_becomes_the_largest_is_taken_back(u: float) -> None:
    """Analytic: both rows are 40/11 at u = 7/11, wherever rows were left out first."""
    program, target = _two_rows(), Target(1e-6, 1e-6, False)
    begun = evaluated(program, np.array([u + 0j]))
    best = _in_finer_numbers(program, target, begun, FIFTY_DIGITS, None)
    assert best.objective == pytest.approx(40 / 11, rel=1e-6)
    assert best.lower_bound == pytest.approx(40 / 11, rel=1e-6)
    assert float(objective_lower_bound(program, best.multipliers)) == pytest.approx(best.lower_bound, rel=1e-12)
    assert best.unbalance[0] == pytest.approx(7 / 11, rel=1e-6)


def test_what_is_proven_of_some_rows_is_proven_of_all() -> None:
    """Property: multipliers of rows that are left out are 0, and the point is judged by all rows."""
    program, target = _two_rows(), Target(1e-6, 1e-6, False)
    assert near_rows(program, np.array([-1.0 + 0j])).tolist() == [True, False]
    assert near_rows(program, np.array([7 / 11 + 0j])).tolist() == [True, True]
    active = ActiveRows.of(program, np.array([True, False]))
    part = interior_point(active.program, target).smallest
    whole = active.over_all(program, part)
    assert part.objective == pytest.approx(0.0, abs=1e-6)
    assert whole.objective == pytest.approx(4.0, rel=1e-6)
    assert whole.multipliers.row.tolist() == pytest.approx([1.0, 0.0])
    assert float(objective_lower_bound(program, whole.multipliers)) == pytest.approx(part.lower_bound, abs=1e-12)
    every = ActiveRows.of(program, np.ones(2, bool))
    assert every.program is program
