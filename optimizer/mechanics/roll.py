"""Moment about the crankshaft with which the frame rolls: what the rows leave on it, and what balance shafts change.

A piston that presses on its guide, and one that is driven, leave s N h on the frame, which is s times the torque of
the row. The mean is what the machine takes up or gives, and only the rest shakes. An unbalance v of a shaft at
p = x + jy that turns rho times puts F = rho^2 v e^{j s rho theta} (over omega^2) on its bearings, and with it
Im(conj(p) F) about the crankshaft. What turns with the crankshaft has no lever. Counter-clockwise is positive.

Source: H. Nakamura, A low vibration engine with unique counter-balance shafts, SAE 760111 (1976).
"""

from dataclasses import replace

import numpy as np

from optimizer.mechanics.layout import BalanceWebs, Layout
from optimizer.mechanics.whole_turn import TurnCurves, WholeTurn
from optimizer.numerics.arrays import Complex, Real, side_by_side, spread, variant
from optimizer.responses.curve import TurnResponse


def roll(turn: WholeTurn, layout: Layout) -> TurnResponse:
    """Alternating moment about the crankshaft on the frame of one machine, N m.

    Gas and friction count. Webs of balance shafts stand behind those of the crankshaft, which do nothing.
    """
    (response,) = rolls(turn, layout)
    return response


def rolls(turn: WholeTurn, layout: Layout) -> list[TurnResponse]:
    """The same of N machines of one shape, of layouts (N,) or of one without leading axes."""
    curves, count = roll_curves(turn, layout), len(turn.centre)
    own = np.zeros(layout.webs.position.shape)
    influence: Real | Complex = own
    turning: Real = own
    shafts = layout.balance
    if shafts is not None:
        influence = side_by_side(own, -1j * np.conj(shafts.x + 1j * shafts.y) * shafts.ratio**2)
        turning = side_by_side(own, layout.sense[..., None] * shafts.ratio)
    pairs = (spread(of_webs, (count, of_webs.shape[-1])) for of_webs in (influence, turning))
    return [
        TurnResponse("roll", "N m", of_webs, curves, number, at, scalar=True)
        for number, (of_webs, at) in enumerate(zip(*pairs, strict=True))
    ]


def roll_curves(turn: WholeTurn, layout: Layout) -> TurnCurves:
    """What the rows of N designs leave on the frame, without its mean: N curves, kg m^2 (over omega^2)."""
    factor = layout.sense[..., None] * layout.reciprocating.crank_radius / layout.omega[..., None] ** 2
    weights = spread(factor, (*layout.omega.shape, turn.rows.crank_radius.shape[-1]))
    of_rows = turn.curves("tangential", weights.reshape(len(turn.centre), 1, -1))
    return variant(of_rows, constant=-of_rows.mean[:, None])


def mirrored(response: TurnResponse, shafts: BalanceWebs) -> TurnResponse:
    """The same scalar where webs of shafts at -1 stand for their mirror image at the x axis, as in the first order.

    Re(h v) is Re(conj(h) conj(v)), so that it is affine in the one as in the other.
    """
    assert response.scalar  # of a vector it is not
    own = response.influence.size - shafts.ratio.size
    back = np.concatenate([np.zeros(own, dtype=bool), shafts.ratio == -1.0])
    return replace(
        response,
        influence=np.where(back, np.conj(response.influence), response.influence),
        turning=None if response.turning is None else np.where(back, -response.turning, response.turning),
    )
