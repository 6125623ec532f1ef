"""Responses on the frame: force, couple, and what is made of both in fixed shares, of the first order and of all.

A rigid frame feels the forces in planes z by their sum and by their couple about one plane. Any response that is linear
in them is R = a F + b M, so that a unit of force in plane z adds a + b (z - z_ref). A couple about another plane p has
a = z_ref - p and b = 1. What a support at z_1 carries beside one at z_2 has a = (z_2 - z_ref)/(z_2 - z_1) and b =
-1/(z_2 - z_1). Source: statics of a rigid body.
"""

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from optimizer.mechanics.balance_shafts import with_balance_shafts
from optimizer.mechanics.inertia import Wrench
from optimizer.mechanics.layout import Layout
from optimizer.mechanics.shaft_curves import planes, shaft_curves
from optimizer.mechanics.whole_turn import WholeTurn
from optimizer.numerics.arrays import Complex, Real, Reals, total
from optimizer.responses.curve import TurnResponse
from optimizer.responses.response import Phasors, Response


class Shares(NamedTuple):
    """What a response has of force and moment about the reference plane, numbers or columns (...).

    force : of the force; in m where the response is a moment.
    moment : of the moment; in 1/m where the response is a force.
    """

    force: Reals
    moment: Reals


#: themselves, of which nothing is added to rounding
FORCE, MOMENT = Shares(1.0, 0.0), Shares(0.0, 1.0)


def phasors(shares: Shares, wrench: Wrench) -> Phasors:
    """A response of one order, with the factor that its force and moment have."""
    if shares is FORCE:
        return wrench.force
    if shares is MOMENT:
        return wrench.moment
    force, moment = (pair * np.asarray(share) for pair, share in zip(wrench, shares, strict=True))
    # what cancels to rounding is nothing, as in the sums of force and moment themselves
    return Phasors(_sum(force.co, moment.co), _sum(force.counter, moment.counter))


def _sum(first: Complex, second: Complex) -> Complex:
    return total(np.stack(np.broadcast_arrays(first, second), axis=-1))


def first_order(name: str, unit: str, shares: Shares, force: Response, moment: Response) -> Response:
    """A response to counterweights from those of force and moment."""
    if shares is FORCE:
        return force
    if shares is MOMENT:
        return moment
    of_force, of_moment = (np.asarray(share)[..., None] for share in shares)
    against = None
    if force.counter_influence is not None and moment.counter_influence is not None:
        against = of_force * force.counter_influence + of_moment * moment.counter_influence
    return Response(
        name,
        unit,
        phasors(shares, Wrench(force.baseline, moment.baseline)),
        of_force * force.influence + of_moment * moment.influence,
        counter_influence=against,
    )


def shaking(
    turn: WholeTurn, layout: Layout, shares_by_name: Mapping[str, tuple[str, Shares]]
) -> tuple[TurnResponse, ...]:
    """Responses of all orders on the frame, seen from the shaft, which leaves their size alone.

    Gas and friction are internal forces and no part of them.

    Parameters
    ----------
    turn, layout : of one machine.
    shares_by_name : unit and shares by name.
    """
    return tuple(_of_all_orders(turn, layout, name, unit, shares) for name, (unit, shares) in shares_by_name.items())


def _of_all_orders(turn: WholeTurn, layout: Layout, name: str, unit: str, shares: Shares) -> TurnResponse:
    def per_unit(arm: Real) -> Real:
        if shares is FORCE:
            return np.ones_like(arm)
        return arm if shares is MOMENT else shares.force + shares.moment * arm

    influence = per_unit(planes(layout) - layout.reference_plane)
    (own,) = shaft_curves(turn, layout, influence[None], "on_frame").responses([name], unit)
    if layout.balance is None:
        return own
    return with_balance_shafts(layout, own, per_unit(layout.balance.position - layout.reference_plane))
