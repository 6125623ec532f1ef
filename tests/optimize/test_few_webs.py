"""Sets on few webs, which are compared outright and made lighter."""

import numpy as np
import pytest

from optimizer.choices.clock import Clock
from optimizer.solve.few_webs import lightened
from tests.choices.sets import every_set, options_of
from tests.program.cases import random_statement

_LONG = 3600.0


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("share", [1.05, 1.5])
def test_none_on_the_same_webs_is_lighter(seed: int, share: float) -> None:
    """Independent: all sets on these webs within the level; all options are near, as there are few."""
    problem = random_statement(seed, "sum", (1.0, 0.7), False, False, False, webs=4)
    most = float(np.max(problem.limits.max_mass))
    options = options_of(problem, [0.1 * most, 0.3 * most, 0.6 * most], [0.0, 90.0, 180.0, 270.0])
    sets, values = every_set(problem, options)
    three = np.count_nonzero(sets, axis=-1) == 3
    best = sets[three][np.argmin(values[three])]
    level = share * float(np.min(values[three]))
    within = sets[(values <= level) & np.all((sets > 0) <= (best > 0), axis=-1)]
    light = lightened(problem, options, best, level, Clock(_LONG))
    assert float(problem.objective(options.carried(light))) <= level
    mass = float(np.sum(options.of(options.mass, light)))
    assert mass == pytest.approx(float(np.min(np.sum(options.of(options.mass, within), axis=-1))), rel=1e-9)
    assert not np.any(light[best == 0])
    # without time it stays
    assert np.array_equal(lightened(problem, options, best, level, Clock(0.0)), best)
