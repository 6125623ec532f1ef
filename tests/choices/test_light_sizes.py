"""Light sets of few part numbers: their limits by trying every set (independent), and what is known stays."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from optimizer.choices.clock import Clock
from optimizer.choices.discrete.light_sizes import LightSizes
from tests.choices.sets import every_set, options_of
from tests.program.cases import COMBINATIONS, random_statement

_LONG = 3600.0


@settings(max_examples=30, deadline=None)
@given(
    seed=st.integers(0, 10_000),
    webs=st.integers(1, 4),
    parts=st.integers(1, 2),
    share=st.sampled_from([1.0, 1.05, 1.5, 4.0]),
)
def test_lighter_and_within_all_limits(seed: int, webs: int, parts: int, share: float) -> None:
    """Independent: no lighter than the lightest of all sets, no heavier than a known one, and of few sizes."""
    combine, weights, sectors, budget, ceilings = COMBINATIONS[seed % len(COMBINATIONS)]
    problem = random_statement(seed, combine, weights, sectors, budget, ceilings, webs=webs)
    most = float(np.max(problem.limits.max_mass))
    options = options_of(problem, [0.1 * most, 0.3 * most, 0.7 * most], [0.0, 120.0, 240.0], None, parts)
    sets, values = every_set(problem, options)
    if not len(sets):
        return
    mass = np.sum(options.of(options.mass, sets), axis=-1)
    level = share * float(np.min(values)) * (1.0 + 1e-9)
    indices = np.flatnonzero(values <= level)
    heaviest = sets[indices[np.argmax(mass[indices])]]
    light = np.random.default_rng(seed).uniform(0.1, 1.0, webs) * most * problem.limits.radius + 0j
    sizes = LightSizes(problem, options, light, list(range(webs)))
    for incumbent in (None, heaviest, None):
        array = sizes.below(incumbent, level, Clock(_LONG))
        if array is None:
            assert incumbent is None
            continue
        assert array.tolist() in sets[indices].tolist()
        weighs = float(np.sum(options.of(options.mass, array)))
        assert weighs >= np.min(mass[indices]) - 1e-9 * most
        assert weighs <= float(np.sum(options.of(options.mass, heaviest))) + 1e-9 * most


def test_what_is_above_a_lower_limit_is_forgotten() -> None:
    """Analytic: a set that was within the limit before is no answer below it."""
    problem = random_statement(3, "sum", (1.0, 1.0), False, False, False, webs=3)
    options = options_of(problem, [0.2 * float(np.max(problem.limits.max_mass))], [0.0, 180.0], None, 0)
    nothing = np.zeros(3, int)
    objective = float(problem.objective(options.carried(nothing)))
    sizes = LightSizes(problem, options, problem.limits.radius + 0j, [0, 1, 2])
    assert sizes.below(nothing, objective, Clock(_LONG)) is nothing
    assert sizes.below(None, 0.5 * objective, Clock(0.0)) is None
