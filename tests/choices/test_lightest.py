"""The lightest set within a level of the objective: what trying every set comes to (independent)."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from optimizer.choices.clock import Clock
from optimizer.choices.discrete.lightest import lighter, lightest
from tests.choices.sets import every_set, options_of
from tests.night import by_day
from tests.program.cases import COMBINATIONS, random_statement

_LONG = 3600.0


@by_day(20, 40)
@given(
    seed=st.integers(0, 10_000),
    webs=st.integers(1, 4),
    fitted=st.none() | st.integers(1, 3),
    parts=st.none() | st.integers(1, 2),
    share=st.sampled_from([1.0, 1.01, 1.2, 2.0, np.inf]),
)
def test_the_lightest_of_all_sets(seed: int, webs: int, fitted: int | None, parts: int | None, share: float) -> None:
    """Independent: at a level that some keep, or at none, the lightest of all sets, and the bound is its mass."""
    combine, weights, sectors, budget, ceilings = COMBINATIONS[seed % len(COMBINATIONS)]
    problem = random_statement(seed, combine, weights, sectors, budget, ceilings, webs=webs)
    most = float(np.max(problem.limits.max_mass))
    masses = [0.1 * most, 0.3 * most, 0.7 * most]
    options = options_of(problem, masses, [0.0, 120.0, 240.0][: 1 if sectors else 3], fitted, parts)
    sets, values = every_set(problem, options)
    if not len(sets):
        return
    level = share * float(np.min(values)) * (1.0 + 1e-9)
    array = sets[values <= level]
    mass = float(np.min(np.sum(options.of(options.mass, array), axis=-1)))
    every = [np.flatnonzero(some) for some in options.exists]
    largest = 2.0 * float(np.sum(np.max(options.mass, axis=-1)))
    bound = lightest(problem, options, every, level, (0.0, largest), Clock(_LONG))
    near = lighter(problem, options, every, level, largest, Clock(_LONG)).selection
    assert bound.selection is not None
    assert near is not None
    for chosen in (bound.selection, near):
        assert abs(float(np.sum(options.of(options.mass, chosen))) - mass) <= 1e-9 * most
        assert float(problem.objective(options.carried(chosen))) <= level
    assert abs(bound.lower_bound - mass) <= 1e-9 * most
    # nothing is lighter than the lightest
    none = lighter(problem, options, every, level, mass, Clock(_LONG))
    assert (none.selection, none.whole) == (None, True)
    assert lightest(problem, options, every, level, (0.0, mass), Clock(_LONG)).lower_bound >= mass * (1.0 - 1e-9)


def test_without_time_nothing_is_claimed() -> None:
    """Analytic: a clock that is spent proves no more than was known."""
    problem = random_statement(3, "sum", (1.0, 1.0), False, False, False, webs=3)
    options = options_of(problem, [0.2 * float(np.max(problem.limits.max_mass))], [0.0, 180.0])
    every = [np.flatnonzero(some) for some in options.exists]
    bound = lightest(problem, options, every, np.inf, (0.25, 10.0), Clock(0.0))
    assert (bound.selection, bound.lower_bound) == (None, 0.25)


def test_masses_in_steps_are_whole_multiples() -> None:
    """Analytic: of 10 and 15 kg every set weighs a multiple of 5; of masses without a unit nothing is known."""
    problem = random_statement(3, "sum", (1.0, 1.0), False, False, False, webs=3)
    share = float(np.min(problem.limits.max_mass)) / 20.0
    stepped = options_of(problem, [10.0 * share, 15.0 * share], [0.0, 180.0])
    assert abs(stepped.unit_kg - 5.0 * share) <= 1e-12 * share
    for least, expected in ((0.0, 0.0), (0.1, 5.0), (5.0, 5.0), (5.1, 10.0), (29.999, 30.0)):
        assert abs(stepped.next_mass(least * share) - expected * share) <= 1e-7 * share
    odd = options_of(problem, [10.0 * share, np.pi * share], [0.0, 180.0])
    assert (odd.unit_kg, odd.next_mass(1.25)) == (0.0, 1.25)
