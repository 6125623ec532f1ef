"""What answers say of themselves: optimal, infeasible, inaccurate, which limits; also where solvers fail or lie."""

from collections.abc import Callable
from dataclasses import replace
from importlib import import_module
from typing import Any

import numpy as np
import pytest

from optimizer.program.kernel import discs, interior_point
from optimizer.program.kernel.finer_numbers import PRECISIONS
from optimizer.program.methods import stage_ends
from optimizer.program.reference import solver
from optimizer.program.reference.assembled import NoPoint
from tests.optimize.asking import OMEGA_SQUARED, answer, single
from tests.optimize.machines import machine, random_machine, throw, web
from tests.verification.checking import optimized


def test_infeasible_names_the_ceiling_and_what_can_be_reached() -> None:
    optimum = answer(single([(90.0, 20.0)]), force_ceiling_N=100.0, moment_ceiling_Nm=1e6)
    assert optimum.status == "infeasible"
    assert optimum.counterweights == ()
    assert optimum.total_mass_kg is None
    assert optimum.certificate is None
    assert optimum.residual.after is None
    assert optimum.residual.before.force.peak_N > 0
    reached = optimum.infeasibility
    assert reached.conflict == ("force_ceiling_N",)
    half = 0.5 * 20.0 * 0.1 * OMEGA_SQUARED  # analytic
    assert reached.smallest_force_N == pytest.approx(half, rel=1e-9)
    assert reached.smallest_force_lower_bound_N == pytest.approx(half, rel=1e-8)
    assert reached.closest.first_order.force.peak_N == pytest.approx(half, rel=1e-6)


def test_ceilings_that_conflict_only_together_are_both_named() -> None:
    # one web between force and moment: u = 2 serves the force, u = 0 the moment (analytic)
    body = machine([throw(0.0, 0.0, [], rotating=20.0), throw(1.0, 0.0, [])], [web("a", 1.0)], reference_plane_m=0.0)
    force, moment = 2.0 * OMEGA_SQUARED, 2.0 * OMEGA_SQUARED
    assert answer(body, force_ceiling_N=0.6 * force, moment_ceiling_Nm=0.6 * moment).status == "optimal"
    optimum = answer(body, force_ceiling_N=0.4 * force, moment_ceiling_Nm=0.4 * moment)
    assert optimum.status == "infeasible"
    assert optimum.infeasibility.conflict == ("force_ceiling_N", "moment_ceiling_Nm")
    assert optimum.infeasibility.smallest_force_N == pytest.approx(0.0, abs=1e-6 * force)
    assert optimum.infeasibility.smallest_moment_Nm == pytest.approx(0.0, abs=1e-6 * moment)
    closest = optimum.infeasibility.closest.first_order
    # analytic, in units of the full force: (|1 - x| - 0.4) / 1 = (x - 0.4) / 0.4, each excess relative to the
    # larger of ceiling and response without counterweights
    share = 0.64 / 1.4  # 0.4 (0.6 - x) = x - 0.4
    assert closest.moment.peak_Nm == pytest.approx(share * moment, rel=1e-6)
    assert closest.force.peak_N == pytest.approx((1 - share) * force, rel=1e-6)


def test_active_limits_are_named() -> None:
    body = single([(90.0, 20.0)])
    small = body | {"webs": [web("a", -0.1, 2.0), web("b", 0.1, 3.0)]}
    assert {weight.active_limits for weight in answer(small).counterweights} == {("max_mass",)}
    assert answer(body | {"max_total_mass_kg": 4.0}).active_limits == ("max_total_mass",)
    ceiling = 0.7 * 20.0 * 0.1 * OMEGA_SQUARED
    held = answer(body, force_weight=0.0, moment_weight=1.0, force_ceiling_N=ceiling)
    assert held.active_limits == ("force_ceiling",)
    assert held.residual.after.force.peak_N <= ceiling * (1 + 1e-9)
    sector = {"centre_deg": 240.0, "half_angle_deg": 30.0}  # 180 would be best
    turned = body | {"webs": [web("a", 0.0, sector=sector)]}
    assert answer(turned).counterweights[0].active_limits == ("sector",)


def test_an_asked_gap_that_cannot_be_certified_is_called_inaccurate() -> None:
    request = {"machine": random_machine(3), "accuracy": {"relative_gap": 1e-12}, "objective": {"combine": "max"}}
    optimum = optimized(request)
    expected = "optimal" if optimum.certificate.relative_gap <= 1e-12 else "inaccurate"
    assert optimum.status == expected


def test_looser_and_tighter_gaps_are_reported_as_asked() -> None:
    for gap in (1e-3, 1e-6, 1e-8):
        request = {"machine": random_machine(1), "accuracy": {"relative_gap": gap}}
        optimum = optimized(request)
        assert optimum.status == "optimal"
        assert optimum.certificate.relative_gap <= gap


def broken(monkeypatch: pytest.MonkeyPatch, change: Callable[[dict[str, Any]], dict[str, Any]]) -> None:
    """Every interior point, in whatever numbers, hands out its arrays (points, cones, rows) with this change."""

    def changed(solve: Callable[..., Any]) -> Callable[..., Any]:
        def run(*arguments: Any) -> Any:
            v, cone, row, unit = solve(*arguments)
            variant = change({"v": v, "cone": cone, "row": row})
            return variant["v"], variant["cone"], variant["row"], unit

        return run

    # in finer numbers it is made from the compiled one, and once: before that is changed
    finer = {precision: changed(stage_ends.solve_in(precision)) for precision in PRECISIONS}
    for method in (discs, interior_point):
        monkeypatch.setattr(method, "solve", changed(method.solve))
    monkeypatch.setattr(stage_ends, "solve_in", finer.__getitem__)


def test_a_solver_that_fails_is_never_silent(monkeypatch: pytest.MonkeyPatch) -> None:
    body = single([(90.0, 20.0)])
    monkeypatch.setattr(solver, "solved", lambda *_, **__: NoPoint("broken"))
    broken(monkeypatch, lambda fields: {name: np.full_like(np.asarray(a, float), np.nan) for name, a in fields.items()})
    # the closed form would answer without any solver
    monkeypatch.setattr(solver, "cancelling", lambda statement, **_: np.zeros(statement.limits.radius.shape, complex))
    optimum = answer(body)
    assert optimum.status == "inaccurate"
    assert optimum.total_mass_kg == 0.0
    # analytic: nothing but the floor is proven, half of what there is
    assert optimum.certificate.relative_gap == pytest.approx(0.5, rel=1e-12)


def test_a_solver_that_lies_is_not_believed(monkeypatch: pytest.MonkeyPatch) -> None:
    honest = solver.solved

    def lying(*arguments: Any, **more: Any) -> Any:
        row = honest(*arguments, **more)
        if isinstance(row, NoPoint):
            return row
        of_solver = row.solution
        changes = {"x": 0.3 * of_solver.x, "row": -of_solver.row, "term": 5j * of_solver.term}
        return row._replace(solution=of_solver._replace(**changes))

    monkeypatch.setattr(solver, "solved", lying)
    broken(
        monkeypatch,
        lambda fields: {"v": 0.3 * fields["v"], "cone": 5.0 * fields["cone"][..., ::-1], "row": -fields["row"]},
    )
    optimum = answer(random_machine(1))
    assert optimum.status == "inaccurate"
    assert optimum.certificate.lower_bound <= optimum.certificate.objective
    assert optimum.certificate.relative_gap > 1e-6


def test_where_nothing_is_unbalanced_a_gap_still_counts(monkeypatch: pytest.MonkeyPatch) -> None:
    """The yardstick is then what the counterweights could change, and the relative gap stands for the gap."""
    whole = import_module("optimizer.program.optimum")

    opposed = [throw(-0.2, 0.0, [], rotating=10.0), throw(0.2, 180.0, [], rotating=10.0)]
    body = machine(opposed, [web("one", 0.3)])
    rest = answer(body).residual.before.moment.peak_Nm
    fields = {"moment_weight": 0.0, "moment_ceiling_Nm": 0.9 * rest}
    optimum = answer(body, **fields)
    # analytic: the force cancels at rest, and one web that lowers the couple makes one
    assert optimum.certificate.objective_without_counterweights == pytest.approx(0.0, abs=1e-9)
    assert optimum.certificate.objective == pytest.approx(0.1 * rest / 0.3, rel=1e-6)
    proof = optimum.certificate
    assert optimum.status == "optimal"
    assert proof.yardstick > proof.objective  # both what one web does to the force
    assert proof.relative_gap == pytest.approx(proof.gap / proof.yardstick)

    honest = whole.optima

    def modest(*arguments: Any) -> Any:
        best = honest(*arguments)
        return replace(best, lower_bound=0.5 * best.lower_bound)

    monkeypatch.setattr(whole, "optima", modest)
    assert answer(body, **fields).status == "inaccurate"
