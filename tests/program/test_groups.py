"""Objectives of several groups and complex influences: solved by the cone program, proven by the same bound."""

import cvxpy as cp
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from optimizer.program.certificate import Multipliers, mass_lower_bound, objective_lower_bound
from optimizer.program.methods.compiled import suits_kernel
from optimizer.program.methods.optima import optima
from optimizer.program.rows import Row, statement, weighted_peak
from optimizer.program.solution import CONE_PROGRAM, ConeSolution
from optimizer.program.statement import Statement
from optimizer.responses.response import Phasors, Response
from tests.program.cases import optimum, random_limits, random_point, stacked


def _single_web(name: str, co: complex, counter: complex = 0, influence: complex = 1) -> Response:
    phasors = Phasors(np.asarray(complex(co)), np.asarray(complex(counter)))
    return Response(name, "N", phasors, np.array([influence]))


def _groups(seed: int, ceiling: bool = False, complex_influence: bool = True) -> Statement:
    """A peak, and the largest of two more, of four webs; one response answers out of line."""
    rng = np.random.default_rng(seed)
    limits = random_limits(rng, 4, sectors=bool(seed % 2), budget=bool(seed // 2 % 2))
    responses = []
    for name in "abc":
        co, counter = rng.normal(size=(2, 2)) @ [1, 1j]
        influence = rng.uniform(-1.0, 1.0, 4) * (np.exp(1j * rng.uniform(0, 6, 4)) if complex_influence else 1.0)
        responses.append(Response(name, "N", Phasors(np.asarray(co), np.asarray(counter)), influence))
    first, *weighted_peaks = (weighted_peak(response, 1.0, 1.0, 0.7) for response in responses)
    groups = [[Row("a", (first,))], [Row(peak.name, (peak,)) for peak in weighted_peaks]]
    inside = random_point(rng, limits)
    limited = [(responses[1], 1.01 * float(responses[1].to(inside).peak))] if ceiling else []
    return statement(groups, limited, limits)


def _peak(response: Response, u: "cp.Variable"):  # type: ignore[no-untyped-def]
    return cp.abs(response.baseline.co + response.influence @ u) + abs(response.baseline.counter)


def test_the_objective_is_the_sum_of_the_largest_of_each_group() -> None:
    # analytic: |u - 3| 2 + max(|u - 1|, |u + 1|) at u = 2 is 2 + 3
    peaks = [weighted_peak(_single_web(n, c), w) for n, c, w in (("a", -3, 2.0), ("b", -1, 1.0), ("c", 1, 1.0))]
    rng = np.random.default_rng(0)
    limits = random_limits(rng, 1, sectors=False, budget=False)
    program = statement([[Row("a", (peaks[0],))], [Row(p.name, (p,)) for p in peaks[1:]]], [], limits)
    assert program.objective(np.array([2.0 + 0j])) == pytest.approx(5.0, rel=1e-15)
    assert program.group.tolist() == [0, 1, 1]
    assert not suits_kernel(program)


def test_two_groups_reach_their_analytic_optimum() -> None:
    # analytic: 2 |u - 3| falls twice as fast as max(|u - 1|, |u + 1|) = u + 1 rises, so that u goes as far as it may:
    # to 2 of 3, where the objective is 2 + 3
    peaks = [weighted_peak(_single_web(n, c), w) for n, c, w in (("a", -3, 2.0), ("b", -1, 1.0), ("c", 1, 1.0))]
    bounds = random_limits(np.random.default_rng(0), 1, sectors=False, budget=False)
    limits = type(bounds)(**{**vars(bounds), "radius": np.array([0.5]), "max_mass": np.array([4.0])})
    program = statement([[Row("a", (peaks[0],))], [Row(p.name, (p,)) for p in peaks[1:]]], [], limits)
    solution = optimum(program, 1e-6, True)
    assert isinstance(solution, ConeSolution)
    assert 5.0 <= solution.objective <= 5.0 + 7e-6
    assert solution.lower_bound == pytest.approx(5.0, rel=1e-6)
    assert solution.unbalance[0] == pytest.approx(2.0, rel=1e-5)
    # analytic: the objective falls by 1 per unit of unbalance from 7 at rest, and an optimum may be 7e-6 worse,
    # which is so near the largest mass that it is that
    assert solution.mass == 4.0
    assert solution.mass_lower_bound == pytest.approx((2.0 - 7e-6) / 0.5, rel=1e-7)
    assert solution.method == CONE_PROGRAM


def test_a_response_out_of_line_is_cancelled_at_a_right_angle() -> None:
    # analytic: |2 + j u| under |u| <= 1 is smallest, 1, where j u = -1, u = j
    limits = random_limits(np.random.default_rng(0), 1, sectors=False, budget=False)
    limits = type(limits)(**{**vars(limits), "radius": np.array([0.5]), "max_mass": np.array([2.0])})
    program = statement([[Row("a", (weighted_peak(_single_web("a", 2, influence=1j), 1.0),))]], [], limits)
    solution = optimum(program, 1e-6, True)
    assert isinstance(solution, ConeSolution)
    assert solution.method == CONE_PROGRAM
    assert solution.unbalance[0] == pytest.approx(1j, abs=1e-5)
    assert solution.objective == pytest.approx(1.0, rel=1e-5)
    assert 0 <= solution.gap <= 2e-6


@pytest.mark.parametrize("ceiling", [False, True])
@pytest.mark.parametrize("seed", range(4))
def test_groups_and_complex_influences_are_certified(seed: int, ceiling: bool) -> None:
    problem = _groups(seed, ceiling)
    solution = optimum(problem, 1e-6, True)
    assert isinstance(solution, ConeSolution)
    rest = float(problem.objective(np.zeros(4, complex)))
    assert 0 <= solution.gap <= 1e-6 * rest
    assert solution.keeps_ceilings
    assert solution.mass - solution.mass_lower_bound <= 1e-4 * solution.mass
    # independent: the same problem written down in complex variables
    limits, u, mass = problem.limits, cp.Variable(4, complex=True), cp.Variable(4)
    sizes = cp.abs(problem.norms.constant + problem.norms.influence @ u)
    rows = problem.floor + problem.membership @ sizes
    turned = cp.multiply(np.conj(limits.centre), u)
    across = cp.multiply(limits.half_angle_cos, cp.abs(cp.imag(turned)))
    within = across - cp.multiply(limits.half_angle_sin, cp.real(turned)) <= np.where(limits.free, 1e3, 0.0)
    rules = [cp.abs(u) <= cp.multiply(limits.radius, mass), mass <= limits.max_mass, within]
    if np.isfinite(limits.max_total_mass):
        rules.append(cp.sum(mass) <= limits.max_total_mass)
    limited = problem.ceilings
    if ceiling:
        rules.append(cp.abs(limited.norms.constant + limited.norms.influence @ u) <= limited.cap)
    expected = cp.Problem(cp.Minimize(rows[0] + cp.max(rows[1:])), rules).solve(solver=cp.CLARABEL)
    assert solution.objective == pytest.approx(expected, rel=2e-6)


def test_many_programs_of_several_groups_are_each_solved_as_if_alone() -> None:
    problems = [_groups(seed) for seed in (0, 4, 8)]
    bound = optima(stacked(problems), 1e-6, True)
    assert set(bound.method) == {CONE_PROGRAM}
    for n, problem in enumerate(problems):
        alone = optimum(problem, 1e-6, True)
        assert isinstance(alone, ConeSolution)
        np.testing.assert_array_equal(bound.unbalance[n], alone.unbalance)
        assert bound.lower_bound[n] == alone.lower_bound


@given(seed=st.integers(0, 10**6), empty=st.booleans())
def test_bounds_of_groups_never_exceed_the_value_of_an_admissible_point(seed: int, empty: bool) -> None:
    problem = _groups(seed)
    rng = np.random.default_rng(seed + 1)
    u = random_point(rng, problem.limits)
    objective = float(problem.objective(u))
    row = np.abs(rng.normal(size=3)) * np.where(np.arange(3) == 0, float(not empty), 1.0)
    # near the best ones for these rows, and far from them
    best = np.exp(1j * np.angle(problem.norms.at(u))) * row[problem.row]
    for term in (best, rng.normal(size=(best.size, 2)) @ [1, 1j]):
        multipliers = Multipliers(term, row, np.zeros(0, complex))
        assert objective_lower_bound(problem, multipliers) <= objective * (1 + 1e-12)
        bound = mass_lower_bound(
            problem, multipliers.times(np.asarray(10.0 ** rng.uniform(-3, 3))), np.asarray(objective)
        )
        assert bound <= float(problem.mass(u)) * (1 + 1e-12)


def test_a_group_without_multipliers_counts_with_its_highest_floor() -> None:
    problem = _groups(0, complex_influence=False)
    alone = Multipliers(np.zeros(problem.row.size, complex), np.array([1.0, 0.0, 0.0]), np.zeros(0, complex))
    floor = float(problem.floor[0] + np.max(problem.floor[1:]))
    assert objective_lower_bound(problem, alone) == pytest.approx(floor, abs=1e-12)
