"""Balance shafts by themselves (analytic): each adds to the order, and to the sense, in which it turns."""

import numpy as np
import pytest

from optimizer.mechanics.balance_shafts import of_balance_shafts
from optimizer.mechanics.layout import layout
from schemas.machine.reciprocating import ReciprocatingMachine
from tests.optimize.shafts import shaft, single


def test_shafts_add_to_the_order_and_the_sense_in_which_they_turn() -> None:
    shafts = [shaft(str(ratio), ratio, place) for ratio, place in ((1, 0.1), (-1, 0.4), (2, 0.2), (-2, 0.7))]
    plan = layout(ReciprocatingMachine.model_validate(single(shafts)))
    assert plan.balance is not None
    place = np.array([0.1, 0.4, 0.2, 0.7]) - plan.reference_plane
    unbalance = np.array([1.0 + 2.0j, 3.0 - 1.0j, 0.5j, 2.0])
    for order, (ahead, back) in ((1, (0, 1)), (2, (2, 3))):
        wrench = of_balance_shafts(plan, plan.balance, unbalance, order)
        # forces go by the square of the speed
        size = order**2 * unbalance
        assert wrench.force.co == pytest.approx(size[ahead])
        assert wrench.force.counter == pytest.approx(size[back])
        assert wrench.moment.co == pytest.approx(place[ahead] * size[ahead])
        assert wrench.moment.counter == pytest.approx(place[back] * size[back])
