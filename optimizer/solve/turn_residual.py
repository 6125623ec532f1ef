"""Force and moment of all orders on the frame, where they are what the objective looks at."""

from collections.abc import Mapping, Sequence

import numpy as np

from optimizer.formulation.formulate import of_all_orders
from optimizer.formulation.simulation import Prepared
from optimizer.mechanics.layout import Layout
from optimizer.numerics.arrays import Complex, Real
from optimizer.responses.curve import TurnResponse, peaks
from optimizer.solve.whole_turn import whole_turn_of
from schemas.answer.first_order import Residual, TurnPeaks, TurnResidual
from schemas.base.responses import PAIR, RESPONSES

#: relative width of the brackets
_WIDTH = 1e-8


def with_turn(residual: Residual, scene: Prepared, unbalance: Complex | None) -> Residual:
    """The residual with the peaks of all orders.

    Parameters
    ----------
    unbalance : (K + S,) kg m, of the counterweights of the answer and, behind them, on the balance shafts; None
        where there are none to show.
    """
    turn, goal = whole_turn_of(scene, scene.objective), scene.objective
    before = _peaks(of_all_orders(turn, scene.layout, goal), scene.layout)
    after = None if unbalance is None else _peaks(of_all_orders(turn, scene.laden, goal), scene.laden, unbalance)
    changes = tuple(
        response.model_copy(
            update={
                "turn_before": before[response.response],
                "turn_after": None if after is None else after[response.response],
            }
        )
        for response in residual.responses
    )
    pair = TurnResidual(before=_pair(before), after=None if after is None else _pair(after))
    return residual.model_copy(update={"turn": pair, "responses": changes})


def _pair(peak: Mapping[str, float]) -> TurnPeaks:
    return TurnPeaks.model_validate({RESPONSES[name].peak: peak[name] for name in PAIR})


def _peaks(responses: Sequence[TurnResponse], layout: Layout, unbalance: Complex | None = None) -> dict[str, float]:
    """Of one machine with the weights that are in its layout, by name."""
    u = np.zeros(responses[0].influence.shape, complex) if unbalance is None else unbalance
    values: Real = peaks(responses, u, _WIDTH).lower * layout.omega**2
    return dict(zip((response.name for response in responses), values.tolist(), strict=True))
