"""Sets that cost no more than they may: what trying every set comes to (independent)."""

import itertools

import numpy as np
import pytest

from optimizer.choices.discrete.few import at_most, costs, offer_few
from optimizer.choices.discrete.options import Incumbent
from tests.choices.sets import every_set, options_of
from tests.program.cases import random_statement


def test_no_fewer_sets_are_counted_than_there_are() -> None:
    rng = np.random.default_rng(7)
    cost = rng.exponential(1.0, (5, 6, 4))
    cost[..., 0] = 0.0
    cost[rng.random(cost.shape) < 0.2] = np.inf
    cost[..., 0] = 0.0
    may = np.array([0.1, 0.5, 1.0, 3.0, 50.0])
    totals = np.array([[sum(taken) for taken in itertools.product(*slots)] for slots in cost])
    there = np.sum(totals <= may[:, None], axis=-1)
    counted = at_most(cost, may)
    assert np.all(counted >= there * (1.0 - 1e-12))
    # analytic: where all are cheap enough it is their number
    assert np.isclose(counted[-1], there[-1])


def test_the_best_of_the_cheap_ones_is_offered_and_what_all_others_cost_is_told() -> None:
    rng = np.random.default_rng(3)
    problem = random_statement(11, "max", (1.0, 0.7), False, False, False, webs=4)
    options = options_of(problem, [0.2, 0.5, 0.9], [0.0])
    forced = rng.uniform(2.0, 3.0, (1, *options.mass.shape))
    lowest, cost = costs(options.exists[None], forced)
    sets, objectives = every_set(problem, options)
    spent = np.sum(cost[0][np.arange(options.slots), sets], axis=-1)
    for may in (0.0, 0.3, 0.8, np.inf):
        incumbent = Incumbent(problem, options, 0.0)
        number = offer_few(problem, incumbent, cost[0], may)
        cheap = spent <= may
        assert np.isclose(incumbent.least, np.min(objectives[cheap], initial=np.inf), rtol=1e-12)
        assert number <= np.min(spent[~cheap], initial=np.inf) * (1.0 + 1e-12)
        assert number > may or not np.any(~cheap)
    assert lowest[0] < 3.0


def test_sets_are_counted_where_nothing_may_be_spent_or_no_set_is_known() -> None:
    """Analytic: with nothing to spend no fewer than the one that costs nothing, and all four where nothing is known.

    Regression: both warned of quotients that are no numbers.
    """
    cost = np.array([[[0.0, 3.0, np.inf], [0.0, 1.0, np.inf]]] * 2)
    counted = at_most(cost, np.array([0.0, np.inf]))
    assert 1.0 <= counted[0] <= 4.0 * (1.0 + 1e-12)
    assert counted[1] == pytest.approx(4.0)
