"""The cone program as matrices against the one in the modelling layer, its multipliers against the certificate."""

import numpy as np
import pytest

from optimizer.program.certificate import mass_lower_bound, objective_lower_bound
from optimizer.program.limits import Limits
from optimizer.program.reference.assembled import Assembled, GroupLimit, NoPoint, solved
from optimizer.program.rows import Row, statement, weighted_peak
from optimizer.program.scaling import natural_reach, scale
from optimizer.program.solution import ConeSolution
from optimizer.program.statement import Statement
from optimizer.responses.response import Phasors, Response
from tests.program.cases import COMBINATIONS, optimum, random_limits, random_point, random_statement


def _peaks(rng: np.random.Generator, webs: int) -> list[Row]:
    """Peaks of one and of two terms, one out of line with its counterweights."""
    rows = []
    for name, across in (("a", 1.0), ("b", 1.0), ("c", 0.4)):
        co, counter = rng.normal(size=(2, 2)) @ [1, 1j]
        influence = rng.uniform(-1.0, 1.0, webs) * (np.exp(1j * rng.uniform(0, 6, webs)) if name == "b" else 1.0)
        response = Response(name, "N", Phasors(np.asarray(co), np.asarray(counter)), influence)
        rows.append(Row(name, (weighted_peak(response, 1.0, 1.0, across),)))
    return rows


def _groups(seed: int) -> Statement:
    rng = np.random.default_rng(seed)
    rows = _peaks(rng, 4)
    return statement([rows[:1], rows[1:]], [], random_limits(rng, 4, bool(seed % 2), bool(seed // 2 % 2)))


def _solved(problem: Statement, stage: str, target: float = 0.0, mass_unit: float = 1.0) -> tuple[Assembled, object]:
    clip = min(10.0 * float(natural_reach(problem)), float(np.max(problem.limits.reach)))
    data, scaling = scale(problem, stage, clip, 0.0, target, mass_unit)  # type: ignore[arg-type]
    targets = (GroupLimit(np.ones(problem.group[-1] + 1, bool), float(data.target[0])),) if stage == "mass" else ()
    solution = solved(data, 1e-10, 5.0, targets=targets)
    assert isinstance(solution, Assembled)
    return solution, scaling


@pytest.mark.parametrize("seed", range(4))
def test_groups_reach_the_optimum_of_the_modelling_layer_and_prove_it(seed: int) -> None:
    problem = _groups(seed)
    expected = optimum(problem, 1e-8, False)
    assert isinstance(expected, ConeSolution)
    solution, scaling = _solved(problem, "objective")
    rest = float(problem.at_rest)
    u = problem.limits.into(scaling.unbalance(problem, solution.solution))  # type: ignore[attr-defined]
    assert float(problem.objective(u)) == pytest.approx(expected.objective, abs=1e-7 * rest)
    multipliers = scaling.multipliers(problem, solution.solution)  # type: ignore[attr-defined]
    bound = float(objective_lower_bound(problem, multipliers))
    assert expected.lower_bound - 1e-7 * rest <= bound <= float(problem.objective(u)) + 1e-12


@pytest.mark.parametrize("seed", range(4))
def test_the_least_mass_of_groups_is_proven_by_its_multipliers(seed: int) -> None:
    problem = _groups(seed)
    best = optimum(problem, 1e-8, False)
    assert isinstance(best, ConeSolution)
    target = 0.5 * (best.objective + float(problem.at_rest))
    solution, scaling = _solved(problem, "mass", target, best.mass)
    u = problem.limits.into(scaling.unbalance(problem, solution.solution))  # type: ignore[attr-defined]
    assert float(problem.objective(u)) <= target * (1 + 1e-7)
    multipliers = scaling.multipliers(problem, solution.solution)  # type: ignore[attr-defined]
    bound = float(mass_lower_bound(problem, multipliers, np.asarray(target)))
    mass = float(problem.mass(u))
    # what a solver's tolerance leaves of the target, and no more
    assert mass * (1 - 1e-5) <= bound <= mass * (1 + 1e-6)


@pytest.mark.parametrize("case", range(0, len(COMBINATIONS), 5))
def test_ceilings_and_limits_of_every_kind(case: int) -> None:
    problem = random_statement(case, *COMBINATIONS[case])
    expected = optimum(problem, 1e-8, False)
    assert isinstance(expected, ConeSolution)
    solution, scaling = _solved(problem, "objective")
    multipliers = scaling.multipliers(problem, solution.solution)  # type: ignore[attr-defined]
    bound = float(objective_lower_bound(problem, multipliers))
    assert bound == pytest.approx(expected.lower_bound, abs=1e-6 * float(problem.at_rest))


def test_a_target_for_one_group_prices_it() -> None:
    """Analytic: min |u - 3| with |u| <= 1 is 2 at u = 1, and a unit more of the target is worth 1."""
    ones, none = np.ones(1), np.asarray(np.inf)
    wide = Limits(ones, 9.0 * ones, np.ones(1, bool), ones + 0j, 0.0 * ones, ones, none)
    rows = [
        Row(name, (weighted_peak(Response(name, "N", Phasors(np.asarray(co), np.asarray(0j)), np.ones(1)), 1.0),))
        for name, co in (("goal", -3 + 0j), ("kept", 0j))
    ]
    problem = statement([rows[:1], rows[1:]], [], wide)
    data, scaling = scale(problem, "objective", 9.0)
    goal = np.array([True, False])
    solution = solved(data, 1e-10, 5.0, goal, [GroupLimit(~goal, 1.0 / scaling.objective)])
    assert isinstance(solution, Assembled)
    assert scaling.unbalance(problem, solution.solution)[0] == pytest.approx(1.0, abs=1e-7)
    assert solution.level * scaling.objective == pytest.approx([2.0, 1.0], abs=1e-7)
    assert solution.price == pytest.approx([1.0], abs=1e-7)
    # the rows of the group that is kept have the price of its target
    assert solution.solution.row == pytest.approx([1.0, 1.0], abs=1e-7)


def test_what_no_counterweights_keep_has_no_point() -> None:
    rng = np.random.default_rng(0)
    problem = _groups(0)
    data, _ = scale(problem, "mass", 1.0, target=0.0)
    solution = solved(data, 1e-8, 5.0, targets=[GroupLimit(np.ones(2, bool), -1.0)])
    assert isinstance(solution, NoPoint)
    assert "ceilings" in solution.reason
    assert problem.objective(random_point(rng, problem.limits)) > 0
