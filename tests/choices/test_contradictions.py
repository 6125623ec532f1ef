"""A bound of any masses that is above the best choice contradicts it: no search takes it down to what it found."""

from dataclasses import replace

import numpy as np
import pytest

from optimizer.choices.discrete import search as discrete
from optimizer.choices.mixed import search as mixed
from optimizer.choices.mixed.free_webs import FreeWebs
from optimizer.choices.semicontinuous import search as semicontinuous
from optimizer.choices.semicontinuous.search import SearchGoal
from optimizer.program.methods.optima import optima
from optimizer.program.statement import Statement
from optimizer.program.verdict import yardstick
from tests.choices.sets import options_of
from tests.program.cases import random_statement

_WEBS = 3
#: a bound of this many yardsticks is above whatever a choice comes to
_FALSE, _SEED = 2.0, 4
_METHODS = ["castings", "castings by a tree", "minimum masses", "castings beside others"]


def _problem() -> tuple[Statement, float]:
    problem = random_statement(_SEED, "sum", (1.0, 1.0), False, False, False, webs=_WEBS)
    return problem, float(yardstick(problem.alone())[0])


def _bounds(method: str, at_least: float | None) -> tuple[float, float]:
    """What a search says that nothing is below, and what it found."""
    problem, size = _problem()
    any_mass = optima(problem.alone(), 1e-6, False)
    relaxed, reference = any_mass.unbalance[0], float(any_mass.lower_bound[0])
    bound = reference if at_least is None else at_least
    most = float(np.max(problem.limits.max_mass))
    if method in {"castings", "castings by a tree"}:
        options = options_of(problem, [0.3 * most, 0.7 * most], [0.0, 120.0, 240.0], None, None)
        chosen, result = discrete.search(problem, options, relaxed, bound, 1e-6, size, 60.0)
        u = options.of(options.unbalance, chosen)
    elif method == "minimum masses":
        least = 0.2 * problem.limits.reach
        u, result = semicontinuous.search(problem, least, relaxed, bound, SearchGoal(1e-6 * size, size, 0.0, 60.0))
    else:
        first, mask = np.arange(_WEBS) < 2, np.arange(_WEBS) >= 2
        webs = replace(problem, norms=problem.norms.only(first), limits=problem.limits.only(first))
        options = options_of(webs, [0.3 * most, 0.7 * most], [0.0, 120.0, 240.0], None, None)
        beside = FreeWebs(problem.limits.only(mask), np.zeros(1))
        options = replace(options, beside=beside)
        goal = SearchGoal(1e-6 * size, size, 0.0, 60.0)
        choice = mixed.search(problem, options, beside, relaxed[None], bound, goal)
        u, result = np.concatenate([options.carried(choice.selection), choice.beside]), choice.result
    assert result.feasible
    return result.lower_bound, float(problem.objective(u))


def _through_a_tree(method: str, monkeypatch: pytest.MonkeyPatch) -> None:
    if method == "castings by a tree":
        monkeypatch.setattr(discrete, "_SUMS", 0)


@pytest.mark.parametrize("method", _METHODS)
def test_a_false_bound_of_any_masses_stays_above_what_was_found(method: str, monkeypatch: pytest.MonkeyPatch) -> None:
    _through_a_tree(method, monkeypatch)
    _, size = _problem()
    bound, optimum = _bounds(method, _FALSE * size)
    assert optimum < bound == _FALSE * size


@pytest.mark.parametrize("method", _METHODS)
def test_a_tree_that_ends_above_what_was_found_contradicts_nothing(
    method: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What was offered is in no node, so that what is left may come to more."""
    _through_a_tree(method, monkeypatch)
    _, size = _problem()
    bound, optimum = _bounds(method, None)
    assert optimum - 2e-6 * size <= bound <= optimum * (1.0 + 1e-12)
