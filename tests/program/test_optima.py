"""The optimum, its proof, and every limit feasible, active and infeasible."""

import warnings
from dataclasses import replace

import cvxpy as cp
import numpy as np
import pytest

from optimizer.program.ceilings import CEILING_TOLERANCE
from optimizer.program.certificate import objective_lower_bound
from optimizer.program.limits import Limits
from optimizer.program.methods.implied_bounds import within_reach
from optimizer.program.rows import combined, statement, weighted_peak
from optimizer.program.solution import ConeSolution
from optimizer.program.statement import Statement
from optimizer.responses.response import Phasors, Response
from tests.night import part
from tests.program.cases import COMBINATIONS, optimum, random_statement


def solve(problem: Statement, gap: float = 1e-6, least_mass: bool = True) -> ConeSolution:
    solution = optimum(problem, gap, least_mass)
    assert isinstance(solution, ConeSolution)
    return solution


def reference(problem: Statement, *targets: float) -> list[float]:
    """The program once more, written plainly in cvxpy with complex variables (independent).

    Returns
    -------
    its optimum or, where targets are given, the least masses that reach them.
    """
    limits = problem.limits
    u, mass = cp.Variable(limits.radius.size, complex=True), cp.Variable(limits.radius.size)
    terms = cp.abs(problem.norms.constant + problem.norms.influence @ u)
    constraints = [cp.abs(u) <= cp.multiply(limits.radius, mass), mass >= 0, mass <= limits.max_mass]
    if np.isfinite(limits.max_total_mass):
        constraints.append(cp.sum(mass) <= limits.max_total_mass)
    for k in np.flatnonzero(~limits.free):
        turned = u[k] * np.conj(limits.centre[k])
        across = cp.abs(cp.imag(turned)) * limits.half_angle_cos[k]
        constraints.append(across <= cp.real(turned) * limits.half_angle_sin[k])
    ceilings = problem.ceilings
    if ceilings.names:
        constraints.append(cp.abs(ceilings.norms.constant + ceilings.norms.influence @ u) <= ceilings.cap)
    rows = [floor + cp.sum(terms[problem.row == r]) for r, floor in enumerate(problem.floor)]
    objective = cp.maximum(*rows) if len(rows) > 1 else rows[0]
    if not targets:
        return [_value(cp.Problem(cp.Minimize(objective), constraints))]
    # a parameter, as to make a model takes longer than to solve it
    target = cp.Parameter()
    goal = cp.Problem(cp.Minimize(cp.sum(mass)), [*constraints, objective <= target])
    values = []
    for target.value in targets:
        values.append(_value(goal))
    return values


def _value(goal: cp.Problem) -> float:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # the plain model stops where its scaling lets it
        goal.solve(solver=cp.CLARABEL, tol_gap_abs=1e-11, tol_gap_rel=1e-11, tol_feas=1e-11)
    assert goal.status in (cp.OPTIMAL, cp.OPTIMAL_INACCURATE)
    return float(goal.value)


@pytest.mark.parametrize("seed", part(3, range(3)))
@pytest.mark.parametrize("case", part(2, COMBINATIONS))
def test_optimum_is_certified_and_agrees_with_a_plain_model(seed: int, case: tuple) -> None:
    problem = random_statement(100 + seed, *case)
    rest = float(problem.objective(np.zeros(problem.limits.radius.size, complex)))
    [plain] = reference(problem)

    sharp = solve(problem, least_mass=False)
    assert sharp.gap <= 1e-9 * rest
    assert sharp.objective == pytest.approx(plain, abs=1e-6 * rest)

    least = solve(problem)
    assert least.gap <= 1e-6 * rest
    assert least.excess <= CEILING_TOLERANCE
    assert least.mass <= sharp.mass * (1 + 1e-9)
    assert least.mass - least.mass_lower_bound <= 1e-5 * least.mass
    # the plain model, asked for a little more and a little less than it can resolve, encloses the mass
    tighter, looser = reference(problem, *(sharp.objective + share * rest for share in (0.9e-6, 1.1e-6)))
    assert looser * (1 - 1e-6) - 1e-9 <= least.mass <= tighter * (1 + 1e-5) + 1e-9


@pytest.mark.parametrize(("gap", "share"), [(1e-3, 1e-6), (1e-8, 1e-8)])
def test_the_least_mass_is_among_optima_whatever_gap_is_enough(gap: float, share: float) -> None:
    """Property: it costs a millionth of the objective without counterweights, or the gap where that is smaller."""
    problem = random_statement(100, *COMBINATIONS[0])
    rest = float(problem.objective(np.zeros(problem.limits.radius.size, complex)))
    sharp, solution = solve(problem, least_mass=False), solve(problem, gap)
    assert solution.mass < sharp.mass
    assert 0.1 * share * rest <= solution.objective - sharp.objective <= 1.001 * share * rest


@pytest.mark.parametrize("case", COMBINATIONS)
def test_answers_lie_within_the_limits(case: tuple) -> None:
    problem = random_statement(500, *case)
    u, limits = solve(problem).unbalance, problem.limits
    mass = np.abs(u) / limits.radius
    assert np.all(mass <= limits.max_mass * (1 + 1e-15))
    assert mass.sum() <= limits.max_total_mass * (1 + 1e-15)
    turned = u * np.conj(limits.centre)
    outside = np.abs(turned.imag) * limits.half_angle_cos - turned.real * limits.half_angle_sin
    assert np.all(outside[~limits.free] <= 1e-15)


def single_web(max_mass: float = 10.0, half_angle: float | None = None, budget: float = np.inf) -> Limits:
    ones = np.ones(1)
    half = np.deg2rad(90.0 if half_angle is None else half_angle)
    return Limits(ones, ones * max_mass, np.array([half_angle is None]), ones + 0j, ones * np.cos(half),
                  ones * np.sin(half), np.asarray(budget))  # fmt: skip


def force(co: complex, counter: complex = 0.0) -> Response:
    return Response("force", "N", Phasors(np.asarray(co + 0j), np.asarray(counter + 0j)), np.ones(1))


def single(co: complex, limits: Limits, ceiling: float | None = None, counter: complex = 0.0) -> Statement:
    response = force(co, counter)
    ceilings = [] if ceiling is None else [(response, ceiling)]
    return statement(combined([weighted_peak(response, 1.0)], "sum"), ceilings, limits)


# every expected number below is analytic: one web of radius 1, force -4 + u


def test_mass_limit_inactive_active_and_zero() -> None:
    assert solve(single(-4, single_web(10.0))).unbalance[0] == pytest.approx(4.0, rel=2e-6)
    active = solve(single(-4, single_web(3.0)))
    assert active.unbalance[0] == pytest.approx(3.0, rel=1e-5)
    assert active.objective == pytest.approx(1.0, abs=4e-6)
    nothing = solve(single(-4, single_web(0.0)))
    assert nothing.unbalance[0] == 0
    assert (nothing.objective, nothing.gap) == (4.0, pytest.approx(0.0, abs=1e-13))


def test_budget_inactive_active_and_zero() -> None:
    assert solve(single(-4, single_web(budget=5.0))).objective == pytest.approx(0.0, abs=5e-6)
    assert solve(single(-4, single_web(budget=1.5))).objective == pytest.approx(2.5, abs=5e-6)
    assert solve(single(-4, single_web(budget=0.0))).objective == 4.0


@pytest.mark.parametrize("half_angle", [1e-6, 10.0, 60.0, 90.0])
def test_sector_inactive_active_and_turned_away(half_angle: float) -> None:
    # inside the sector (centre 0): complete; across it: distance to the edge; against it: nothing helps
    assert solve(single(-4, single_web(half_angle=half_angle))).objective == pytest.approx(0.0, abs=5e-6)
    across = solve(single(-4j, single_web(half_angle=half_angle)))
    assert across.objective == pytest.approx(4.0 * np.cos(np.deg2rad(half_angle)), abs=5e-6)
    against = solve(single(4, single_web(half_angle=half_angle)))
    assert against.objective == 4.0
    assert against.mass == 0.0


def test_ceiling_inactive_active_at_the_floor_and_below_it() -> None:
    # minimise |m| (a moment that wants u = 0) under a ceiling on the force |-4 + u| + 1
    def problem(ceiling: float, max_mass: float = 10.0) -> Statement:
        moment = Response("moment", "N m", Phasors(np.asarray(2.0 + 0j), np.asarray(0j)), np.ones(1))
        limits = single_web(max_mass)
        return statement(combined([weighted_peak(moment, 1.0)], "sum"), [(force(-4, 1), ceiling)], limits)

    assert solve(problem(9.0)).objective == pytest.approx(0.0, abs=5e-6)  # |-4 - 2| + 1 = 7 is below it
    active = solve(problem(3.0))  # |-4 + u| <= 2, so u = 2 and the moment is 4
    assert active.objective == pytest.approx(4.0, rel=1e-6)
    assert active.excess <= CEILING_TOLERANCE
    assert solve(problem(1.0)).objective == pytest.approx(6.0, rel=1e-6)  # u = 4 exactly
    below = optimum(problem(1.0 - 1e-9), 1e-6, True)
    assert below.conflict is not None
    assert objective_lower_bound(problem(1.0 - 1e-9).excess(), below.conflict) > 0
    short = optimum(problem(2.0, max_mass=2.9), 1e-6, True)  # needs u = 3
    assert short.conflict is not None
    assert short.unbalance[0] == pytest.approx(2.9, rel=1e-6)


def test_balanced_machines_take_no_iron() -> None:
    answer = solve(single(0, single_web(), counter=3.0))
    assert (answer.mass, answer.objective) == (0.0, 3.0)
    assert answer.gap <= 1e-13


def test_no_webs_at_all() -> None:
    problem = single(-4, single_web()).only(np.zeros(1, bool))
    answer = solve(problem)
    assert answer.unbalance.size == 0
    assert answer.objective == 4.0
    assert answer.gap <= 1e-13


def test_webs_so_unlike_that_only_the_weak_one_can_cancel() -> None:
    """Analytic: the strong web may only point the other way, and the weak one cancels the term by itself."""
    limits = replace(
        single_web(1e300),
        radius=np.array([1e-6, 4.3107748390726144e-08]),
        max_mass=np.array([1e300, 1e300]),
        free=np.array([False, True]),
        centre=np.exp(1j * np.deg2rad([158.68295482609085, 0.0])),
        half_angle_cos=np.cos(np.deg2rad([60.0, 90.0])),
        half_angle_sin=np.sin(np.deg2rad([60.0, 90.0])),
    )
    constant = 0.22317 * np.exp(1j * np.deg2rad(138.41393411405795 + 180.0))
    moment = Response(
        "moment", "N m", Phasors(np.asarray(constant), np.asarray(1.1e-7 + 0j)), np.array([-0.5, -7.83e-11])
    )
    problem = within_reach(statement(combined([weighted_peak(moment, 1.0)], "sum"), [], limits))
    solution = solve(problem, 1e-7, least_mass=False)
    assert solution.objective == pytest.approx(1.1e-7, rel=1e-6)
    assert solution.gap <= 1e-7 * float(problem.at_rest)
    assert solution.unbalance[0] == 0.0
    assert solution.unbalance[1] == pytest.approx(constant / 7.83e-11, rel=1e-9)


@pytest.mark.parametrize("largest", [1e12, 1e6])
def test_limits_far_beyond_need_do_not_spoil_the_proof(largest: float) -> None:
    problem = random_statement(4, "sum", (1.0, 1.0), False, False, False, webs=5)
    limits = replace(problem.limits, max_mass=np.array([largest, 1e-12, largest, 0.5, largest]))
    problem = replace(problem, limits=limits)
    answer = solve(problem)
    rest = float(problem.objective(np.zeros(5, complex)))
    assert answer.gap <= 1e-6 * rest
    assert answer.mass - answer.mass_lower_bound <= 1e-5 * answer.mass


def test_units_by_powers_of_two_leave_the_answer_the_same_to_the_last_bit() -> None:
    for case in COMBINATIONS:
        problem = random_statement(42, *case)
        bigger = _in_new_units(problem, 2.0**20, 2.0**-7)
        a, b = solve(problem), solve(bigger)
        assert np.array_equal(b.unbalance, a.unbalance * 2.0**20)
        assert b.objective == a.objective * 2.0**13


def _in_new_units(problem: Statement, mass_radius: float, weight: float) -> Statement:
    """Masses in another unit of mass-radius, the objective in another unit as well."""
    factor = mass_radius * weight
    norms = replace(problem.norms, constant=problem.norms.constant * factor, influence=problem.norms.influence * weight)
    ceilings = replace(
        problem.ceilings,
        norms=replace(problem.ceilings.norms, constant=problem.ceilings.norms.constant * mass_radius),
        cap=problem.ceilings.cap * mass_radius,
        size=problem.ceilings.size * mass_radius,
    )
    limits = replace(
        problem.limits,
        max_mass=problem.limits.max_mass * mass_radius,
        max_total_mass=problem.limits.max_total_mass * mass_radius,
    )
    return replace(problem, norms=norms, floor=problem.floor * factor, ceilings=ceilings, limits=limits)
