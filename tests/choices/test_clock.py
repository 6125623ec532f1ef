"""Searches end at the time asked: by a clock that moves as nodes are bounded, sums made and programs solved."""

from typing import Any

import numpy as np
import pytest

from optimizer.choices.clock import Clock, Pace
from optimizer.choices.discrete import ample, branch, halves, pairs, sums
from optimizer.choices.discrete.exchange import start
from optimizer.choices.discrete.options import EQUAL, Incumbent, Options
from optimizer.choices.discrete.pairs import Pairs
from optimizer.choices.semicontinuous import inside, search, tree
from optimizer.choices.semicontinuous.places import root
from optimizer.program.cuts.row_generation import FEW
from optimizer.program.methods.optima import optima
from optimizer.program.statement import Statement
from optimizer.solve import statuses
from tests.choices.sets import options_of
from tests.pairs.asking import ask
from tests.program.cases import random_statement

_LONG = 1e9
#: s, for what takes a tenth of it on a machine that is left alone
_ENOUGH_S = 2.0


class _Enough(BaseException):
    """As much was looked at as there is to see."""


class Seconds:
    """Time that passes when it is told to."""

    def __init__(self) -> None:
        self.now = 0.0

    def __call__(self) -> float:
        return self.now


def problem_of(webs: int) -> tuple[Statement, Options]:
    problem = random_statement(3, "sum", (1.0, 1.0), False, False, False, webs=webs)
    most = float(np.max(problem.limits.max_mass))
    return problem, options_of(problem, [0.1 * most, 0.2 * most, 0.3 * most], [30.0 * n for n in range(12)])


def begun(problem: Statement, options: Options) -> Incumbent:
    incumbent = Incumbent(problem, options, EQUAL * float(problem.at_rest))
    start(incumbent, np.zeros((1, options.slots), complex))
    return incumbent


def test_as_many_as_there_is_time_for() -> None:
    """Analytic: ten in a second, so a hundred in ten."""
    seconds = Seconds()
    pace = Pace(Clock(11.0, seconds))
    assert pace.most(1000) == 1000
    seconds.now = 1.0
    pace.took(10)
    assert (pace.most(1000), pace.most(100), pace.most(7)) == (100, 100, 7)
    seconds.now = 12.0
    pace.took(10)
    assert pace.most(1000) == 1


@pytest.mark.parametrize("limit_s", [5.0, 40.0, 300.0])
def test_a_tree_of_options_bounds_as_many_nodes_as_it_has_time_for(
    limit_s: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    problem, options = problem_of(12)
    seconds, bounded = Seconds(), branch.Work.bounded

    def slowly(work: Any, nodes: Any, *rest: Any) -> Any:
        seconds.now += len(nodes)
        return bounded(work, nodes, *rest)

    monkeypatch.setattr(branch.Work, "bounded", slowly)
    actual_tree = branch.branch(
        options, begun(problem, options), -np.inf, -1.0, lambda bound: False, Clock(limit_s, seconds), np.inf
    )
    # a node has two children
    assert limit_s <= actual_tree.nodes == seconds.now <= limit_s + 2


def test_sums_of_halves_that_there_is_no_time_for_are_not_made(monkeypatch: pytest.MonkeyPatch) -> None:
    """Analytic: 37 options on two slots of the first half, so 37 sums and then 1369; a second each."""
    problem, options = problem_of(4)
    every = [np.flatnonzero(some) for some in options.exists]
    distinct = sums._distinct
    for limit_s, values in ((1_000.0, [37]), (1e6, [37, 1369, 37])):
        seconds, sizes = Seconds(), list[int]()

        def slowly(some: Any, seconds: Seconds = seconds, sizes: list[int] = sizes) -> Any:
            sizes.append(some.code.size)
            seconds.now += some.code.size
            return distinct(some)

        monkeypatch.setattr(sums, "_distinct", slowly)
        pairs = halves.exhaust(options, every, begun(problem, options), 300_000, 3_000_000, Clock(limit_s, seconds))
        assert sizes[: len(values)] == values
        assert pairs == (limit_s > 1_000.0)


@pytest.mark.parametrize(("limit_s", "solved"), [(0.0, 8), (10.0, 16), (_LONG, None)])
def test_points_are_moved_to_tangents_until_the_time_is_over(
    limit_s: float, solved: int | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Programs are solved by eights, a second each."""
    problem, _ = problem_of(20)
    least = 0.9 * problem.limits.reach
    relaxed = optima(problem.alone(), 1e-6, False).unbalance[0]
    incumbent = inside.BestPoint(problem, root(least, problem.limits), 1e-9)
    seconds, count, solve = Seconds(), 0, inside.solved

    def slowly(programs: Any, *rest: Any) -> Any:
        nonlocal count
        many = programs.limits.max_mass.shape[0]
        assert many <= 8
        count, seconds.now = count + many, seconds.now + many
        return solve(programs, *rest)

    monkeypatch.setattr(inside, "solved", slowly)
    inside.sharing(incumbent, relaxed, Clock(limit_s, seconds))
    assert count == solved if solved is not None else count > 16
    assert incumbent.unbalance is not None


@pytest.mark.parametrize("limit_s", [5.0, 40.0])
def test_a_tree_of_leasts_bounds_as_many_nodes_as_it_has_time_for(
    limit_s: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    problem, _ = problem_of(8)
    incumbent = inside.BestPoint(problem, root(0.9 * problem.limits.reach, problem.limits), 1e-9)
    seconds, bounded = Seconds(), tree._bounded

    def slowly(incumbent: Any, statement: Any, places: Any, inherited: Any, *rest: Any) -> Any:
        seconds.now += inherited.size
        return bounded(incumbent, statement, places, inherited, *rest)

    monkeypatch.setattr(tree, "_bounded", slowly)
    ended = tree.branch(incumbent, -np.inf, -1.0, lambda bound: False, Clock(limit_s, seconds), problem)
    # a whole turn has four pieces, and nothing
    assert limit_s <= ended.nodes == seconds.now <= limit_s + 5


def test_a_tree_that_rounding_leaves_open_does_not_say_that_time_was_over(monkeypatch: pytest.MonkeyPatch) -> None:
    """Bounds of single points are as close as they are solved; below that nothing is left to divide."""
    problem, _ = problem_of(4)
    least = 0.9 * problem.limits.reach
    relaxed = optima(problem.alone(), 1e-6, False).unbalance[0]
    at_rest = float(problem.at_rest)
    goal = search.SearchGoal(1e-9 * at_rest, 0.0, at_rest, _LONG)
    monkeypatch.setattr(tree, "_bounded", lambda *_: (0.0, []))
    _, search_result = search.search(problem, least, relaxed, 0.0, goal)
    assert (search_result.ended, search_result.nodes) == ("rounding", 1)
    assert statuses.ended(search_result).startswith("The search has divided all that can be chosen")


def test_pairs_of_sums_are_compared_by_fewer_at_once_where_they_have_more_terms(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Between two looks at the time as many terms, whether pairs have four or hundreds, as over the turn."""
    batches, evaluated = list[int](), Pairs.evaluated

    def counting(compared: Any, i: np.ndarray, j: np.ndarray) -> None:
        batches.append(i.size * compared.terms.size)
        if len(batches) == 4:
            raise _Enough
        evaluated(compared, i, j)

    monkeypatch.setattr(Pairs, "evaluated", counting)
    # however slow the machine is
    with pytest.raises(_Enough):
        ask("twin", ["bending weight", "steps"], 30.0)
    # the last of a batch may be more than fill it
    assert max(batches) <= 1.5 * pairs._AT_ONCE


def test_light_sets_are_sought_near_an_optimum_of_few_rows(monkeypatch: pytest.MonkeyPatch) -> None:
    """Over the turn a program has hundreds of terms, and took seconds between two looks at the time."""
    terms, stages = list[int](), ample.stage_solutions

    def counting(statement: Statement, *rest: Any) -> Any:
        terms.append(statement.norms.constant.shape[-1] + statement.ceilings.norms.constant.shape[-1])
        return stages(statement, *rest)

    monkeypatch.setattr(ample, "stage_solutions", counting)
    assert ask("twin", ["bending alone", "own masses"]).kind == "answered"
    # a row has three terms at most
    assert 0 < max(terms) <= 2 * 3 * FEW
