"""Force and moment of all orders on the frame, where they are what the objective looks at."""

import numpy as np

from optimizer.formulation.simulation import Prepared
from optimizer.mechanics.layout import Layout
from optimizer.mechanics.shaft_curves import shaking
from optimizer.mechanics.whole_turn import WholeTurn
from optimizer.numerics.arrays import Complex
from optimizer.responses.curve import peaks
from optimizer.solve.whole_turn import whole_turn_of
from schemas.answer.first_order import Residual, TurnPeaks, TurnResidual

#: relative width of the brackets
_WIDTH = 1e-8


def with_turn(residual: Residual, scene: Prepared, unbalance: Complex | None) -> Residual:
    """The residual with the peaks of all orders.

    Parameters
    ----------
    unbalance : (K + S,) kg m, of the counterweights that were chosen and, behind them, on the balance shafts; None
        where there are none to show.
    """
    turn = whole_turn_of(scene)
    after = None if unbalance is None else _peaks(turn, scene.laden, unbalance)
    return residual.model_copy(update={"turn": TurnResidual(before=_peaks(turn, scene.layout), after=after)})


def _peaks(turn: WholeTurn, layout: Layout, unbalance: Complex | None = None) -> TurnPeaks:
    """Of one machine with the weights that are in its layout."""
    responses = shaking(turn, layout)
    u = np.zeros(responses[0].influence.shape, complex) if unbalance is None else unbalance
    force, moment = (peaks(responses, u, _WIDTH).lower * layout.omega**2).tolist()
    return TurnPeaks(force_peak_N=force, moment_peak_Nm=moment)
