"""The best set of options: what trying every set comes to (independent), by halves and by the tree alike."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from optimizer.choices.clock import Clock, Pace
from optimizer.choices.discrete import branch, halves, pairs, search, sums
from optimizer.choices.discrete.options import EQUAL, Incumbent, Options
from optimizer.choices.discrete.search import EXHAUSTED, TREE
from optimizer.choices.feasible_set import SearchResult
from optimizer.program.limits import Limits
from optimizer.program.methods.optima import optima
from optimizer.program.rows import combined, statement, weighted_peak
from optimizer.program.statement import Statement
from optimizer.program.verdict import yardstick
from optimizer.responses.response import Phasors, Response
from tests.choices.sets import every_set, options_of
from tests.night import part
from tests.program.cases import COMBINATIONS, random_statement

_LONG = 3600.0


def search_result_of(
    problem: Statement, options: Options, relative_gap: float = 1e-12, time_limit_s: float = _LONG
) -> tuple[np.ndarray, SearchResult]:
    relaxed = optima(problem.alone(), 1e-6, False)
    size = float(yardstick(problem.alone())[0])
    return search.search(
        problem, options, relaxed.unbalance[0], float(relaxed.lower_bound[0]), relative_gap, size, time_limit_s
    )


@pytest.fixture(params=["halves", "quarters", "tree"])
def method(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> str:
    if request.param == "quarters":
        # sums of halves that are not listed, however few they are
        monkeypatch.setattr(halves, "_LIST_SIZE", 0)
        monkeypatch.setattr(halves, "_FEW", 0)
        monkeypatch.setattr(pairs, "_FEWEST", 10)
        monkeypatch.setattr(pairs, "_SLAB", 7)
    if request.param == "tree":
        monkeypatch.setattr(search, "_SUMS", 0)
        monkeypatch.setattr(branch, "_SETS", 1)
        monkeypatch.setattr(search, "_SEARCHES", ((0, np.inf),))
    return str(request.param)


def check(problem: Statement, options: Options, method: str) -> None:
    (chosen, search_result), (sets, values) = search_result_of(problem, options), every_set(problem, options)
    assert search_result.method == (TREE if method == "tree" else EXHAUSTED)
    assert search_result.ended is None
    if not len(sets):
        assert not search_result.feasible
        assert search_result.lower_bound == np.inf
        return
    size, best = float(yardstick(problem.alone())[0]), float(np.min(values))
    u = options.of(options.unbalance, chosen)
    assert search_result.feasible
    assert search_result.proven
    assert best - 1e-12 * size <= float(problem.objective(u)) <= best + 1.001 * EQUAL * size
    assert best - 1e-12 * size <= search_result.lower_bound + 1e-12 * size
    assert search_result.lower_bound <= best + 1e-12 * size
    # of equals the lightest, then the least sum of |u|^2
    equal = sets[values <= best + EQUAL * size]
    masses = np.sum(options.of(options.mass, equal), axis=-1)
    mass = float(np.sum(options.of(options.mass, chosen)))
    assert mass <= np.min(masses) * (1.0 + 1e-8) + 1e-300
    squares = np.sum(np.abs(options.of(options.unbalance, equal)) ** 2, axis=-1)[masses <= np.min(masses) * (1 + 1e-12)]
    assert np.sum(np.abs(u) ** 2) <= np.min(squares) * (1.0 + 1e-8) + 1e-300


@pytest.mark.parametrize("number", part(2, range(0, len(COMBINATIONS), 2)))
def test_every_combination_of_limits(number: int, method: str) -> None:
    """Independent: three webs, three masses at six angles, of them all that keep the limits."""
    combine, weights, sectors, budget, ceilings = COMBINATIONS[number]
    problem = random_statement(number, combine, weights, sectors, budget, ceilings, webs=3)
    most = float(np.max(problem.limits.max_mass))
    angles = [0.0, 1.0, -1.5] if sectors else [0.0, 60.0, 120.0, 180.0, 240.0, 300.0]
    check(problem, options_of(problem, [0.11 * most, 0.3 * most, 0.7 * most], angles), method)


@settings(max_examples=25, deadline=None)
@given(
    seed=st.integers(0, 10_000),
    webs=st.integers(1, 4),
    fitted=st.none() | st.integers(0, 3),
    parts=st.none() | st.integers(1, 2),
    shares=st.lists(st.sampled_from([0.1, 0.25, 0.5, 0.5000001, 1.0]), min_size=1, max_size=3, unique=True),
)
def test_counts(seed: int, webs: int, fitted: int | None, parts: int | None, shares: list[float]) -> None:
    """Independent: at most so many counterweights, of at most so many part numbers."""
    combine, weights, sectors, budget, ceilings = COMBINATIONS[seed % len(COMBINATIONS)]
    problem = random_statement(seed, combine, weights, sectors, budget, ceilings, webs=webs)
    masses = [share * float(np.max(problem.limits.max_mass)) for share in shares]
    check(problem, options_of(problem, masses, [0.0, 120.0, 240.0][: 1 if sectors else 3], fitted, parts), "halves")


@pytest.mark.parametrize(("fitted", "parts"), [(2, None), (None, 1), (3, 2), (0, None)])
def test_counts_in_the_tree(fitted: int | None, parts: int | None, method: str) -> None:
    for seed in range(4):
        problem = random_statement(seed, "sum", (1.0, 1.0), False, seed % 2 == 1, False, webs=4)
        most = float(np.max(problem.limits.max_mass))
        masses = [0.1 * most, 0.3 * most, 0.5 * most]
        check(problem, options_of(problem, masses, [0.0, 90.0, 180.0, 270.0], fitted, parts), method)


def test_half_a_million_sets() -> None:
    """Independent: four webs, three masses at nine angles, 614,656 sets."""
    problem = random_statement(7, "sum", (1.0, 1.0), False, False, False, webs=4)
    most = float(np.max(problem.limits.max_mass))
    options = options_of(problem, [0.2 * most, 0.45 * most, 0.9 * most], [40.0 * n for n in range(9)])
    assert np.prod(np.sum(options.exists, axis=-1)) >= 1e5
    check(problem, options, "halves")


@pytest.mark.nightly
@pytest.mark.parametrize("seed", part(3, range(3)))
def test_ten_million_sets(seed: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """Independent: four webs, eleven masses at five angles, 9,834,496 sets one web after the other."""
    problem = random_statement(seed, "sum", (1.0, 1.0), False, False, False, webs=4)
    most = float(np.min(problem.limits.max_mass))
    options = options_of(problem, [most * n / 11.0 for n in range(1, 12)], [72.0 * n for n in range(5)])
    assert np.prod(np.sum(options.exists, axis=-1)) >= 9e6
    rest = np.stack(np.meshgrid(*[np.arange(options.mass.shape[1])] * 3, indexing="ij"), axis=-1).reshape(-1, 3)
    rest = rest[np.all(options.exists[np.arange(1, 4), rest], axis=-1)]
    best = np.inf
    for first in np.flatnonzero(options.exists[0]):
        sets = np.column_stack([np.full(len(rest), first), rest])
        best = min(best, float(np.min(problem.objective(options.of(options.unbalance, sets)))))
    size = float(yardstick(problem.alone())[0])
    for listed in (20_000, 0):
        monkeypatch.setattr(halves, "_LIST_SIZE", listed)
        chosen, search_result = search_result_of(problem, options)
        assert (search_result.method, search_result.proven) == (EXHAUSTED, True)
        assert abs(float(problem.objective(options.of(options.unbalance, chosen))) - best) <= EQUAL * size
        assert abs(search_result.lower_bound - best) <= EQUAL * size


def test_whole_masses_make_ties(method: str) -> None:
    """Analytic: 6 kg at one angle in one plane leave nothing; six of 1 kg, 3 of 2 kg: the least sum of |u|^2 wins."""
    force = Response("force", "N", Phasors(np.asarray(-6.0 + 0j), np.asarray(0j)), np.ones(4))
    ones = np.ones(4)
    limits = Limits(ones, 4.0 * ones, ones > 0, ones + 0j, 0.0 * ones, ones, np.asarray(np.inf))
    problem = statement(combined([weighted_peak(force, 1.0)], "sum"), [], limits)
    options = options_of(problem, [1.0, 2.0, 3.0, 4.0], [0.0])
    check(problem, options, method)
    chosen, _ = search_result_of(problem, options)
    assert sorted(options.of(options.mass, chosen)) == [1.0, 1.0, 2.0, 2.0]


@pytest.mark.parametrize(("fitted", "parts"), [(None, None), (2, 1)])
@pytest.mark.parametrize("webs", [1, 3])
def test_webs_that_change_nothing_stay_empty(webs: int, fitted: int | None, parts: int | None, method: str) -> None:
    """Analytic: where no web changes the objective all sets are equal, and nothing is the lightest."""
    moment = Response("moment", "N m", Phasors(np.asarray(3.0 + 1j), np.asarray(2j)), np.zeros(webs))
    ones = np.ones(webs)
    limits = Limits(ones, 4.0 * ones, ones > 0, ones + 0j, 0.0 * ones, ones, np.asarray(np.inf))
    problem = statement(combined([weighted_peak(moment, 1.0)], "sum"), [], limits)
    options = options_of(problem, [1.0, 2.0, 4.0], [0.0, 120.0, 240.0], fitted, parts)
    chosen, search_result = search_result_of(problem, options)
    assert search_result.feasible
    assert not np.any(chosen)
    assert search_result.lower_bound == pytest.approx(float(problem.objective(np.zeros(webs, complex))), rel=1e-12)
    if method == "halves":
        check(problem, options, method)


def test_a_search_that_is_out_of_time_says_so() -> None:
    problem = random_statement(3, "sum", (1.0, 1.0), False, False, False, webs=12)
    most = float(np.max(problem.limits.max_mass))
    options = options_of(problem, [0.1 * most, 0.2 * most, 0.3 * most], [30.0 * n for n in range(12)])
    chosen, search_result = search_result_of(problem, options, 1e-12, 0.0)
    size = float(yardstick(problem.alone())[0])
    assert search_result.ended == "time"
    assert search_result.feasible
    assert not search_result.proven
    objective = float(problem.objective(options.of(options.unbalance, chosen)))
    assert optima(problem.alone(), 1e-6, False).lower_bound[0] <= search_result.lower_bound + 1e-12 * size
    assert search_result.lower_bound <= objective


def test_the_asked_gap_ends_the_search() -> None:
    """The bound of a tree that ends early is below what trying every set comes to."""
    problem = random_statement(5, "max", (1.0, 0.3), False, False, False, webs=4)
    most = float(np.max(problem.limits.max_mass))
    options = options_of(problem, [0.15 * most, 0.5 * most], [60.0 * n for n in range(6)])
    best, size = float(np.min(every_set(problem, options)[1])), float(yardstick(problem.alone())[0])
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(search, "_SUMS", 0)
        patch.setattr(branch, "_SETS", 1)
        chosen, search_result = search_result_of(problem, options, 0.02)
    objective = float(problem.objective(options.of(options.unbalance, chosen)))
    assert search_result.ended is None
    assert search_result.lower_bound <= best + 1e-12 * size <= objective + 2e-12 * size
    assert objective - search_result.lower_bound <= 0.02 * size


def test_the_continuous_optimum_is_never_beaten() -> None:
    for seed in range(6):
        problem = random_statement(seed, "sum", (1.0, 1.0), True, False, False, webs=5)
        options = options_of(problem, [float(np.max(problem.limits.max_mass)) * share for share in (0.2, 0.6)], [0.0])
        chosen, _ = search_result_of(problem, options)
        objective = float(problem.objective(options.of(options.unbalance, chosen)))
        assert objective >= optima(problem.alone(), 1e-6, False).lower_bound[0] * (1.0 - 1e-12)


@pytest.mark.parametrize(
    ("fitted", "parts", "count"),
    # analytic: nothing; one of twelve on either web; one mass on both webs, at any of six angles each
    [(None, None, 13 * 13), (0, None, 1), (1, None, 1 + 2 * 12), (None, 1, 1 + 2 * 12 + 2 * 6 * 6)],
)
def test_halves_hold_no_sums_that_counts_rule_out(fitted: int | None, parts: int | None, count: int) -> None:
    problem = random_statement(7, "sum", (1.0, 0.7), False, False, False, webs=4)
    most = float(np.max(problem.limits.max_mass))
    # no two sums of these are the same
    options = options_of(problem, [0.11 * most, 0.37 * most], [0.0, 50.0, 110.0, 170.0, 230.0, 310.0], fitted, parts)
    every = [np.flatnonzero(some) for some in options.exists]
    _, effect = Incumbent(problem, options, 0.0).coordinates
    assert len(sums.sums_of(options, effect, every, (0, 1), Pace(Clock(_LONG))).code) == count
