"""Loads of the main bearings and bending moments of the shaft over the whole turn.

All of them are responses to counterweights.

Seen from the shaft the load of bearing j is a fixed curve and a constant, d_j(theta) + sum_k B_jk u_k, with B the real
influence of :mod:`bearings` and the loads of the rows as the shaft sees them (:mod:`whole_turn`). The bending moment is
linear in loads and bearing loads, and between their planes linear in z. So the largest is at one of the planes:
finitely many responses, and no error. Everything is over omega^2.
"""

from collections.abc import Callable, Sequence

import numpy as np

from optimizer.mechanics.balance_shafts import beside
from optimizer.mechanics.bearings import unit_bending_moment
from optimizer.mechanics.layout import Layout
from optimizer.mechanics.reading import Reading
from optimizer.mechanics.whole_turn import TurnCurves, WholeTurn
from optimizer.numerics.arrays import Complex, Real, side_by_side, spread
from optimizer.numerics.memoization import remembered
from optimizer.numerics.records import record
from optimizer.responses.curve import TurnResponse

#: bearing loads for unit loads: (..., B) and (..., L) m to (..., B, L)
Influence = Callable[[Real, Real], Real]


@record(frozen=True)
class ShaftCurves:
    """C curves of each of N designs: loads of bearings, kg m, or bending moments, kg m^2.

    curves : N C curves without counterweights, designs first.
    webs : (..., C, K) what one kg m on each web adds.
    """

    curves: TurnCurves
    webs: Real

    def offsets(self, unbalance: Complex | None) -> Complex:
        """What counterweights (..., K) kg m, or none, add to the curves, (N C,)."""
        if unbalance is None:
            return np.zeros(self.webs.shape[:-1], dtype=complex).reshape(-1)
        return np.add.reduce(self.webs * unbalance[..., None, :], axis=-1).reshape(-1)

    def first(self, count: int) -> "ShaftCurves":
        """The first curves of each design alone."""
        return ShaftCurves(self.curves.first(count), self.webs[..., :count, :])

    def responses(self, names: Sequence[str], unit: str) -> tuple[TurnResponse, ...]:
        """The curves of one machine as responses."""
        return tuple(TurnResponse(name, unit, self.webs[n], self.curves, n) for n, name in enumerate(names))


def bearing_loads(
    turn: WholeTurn, layout: Layout, names: Sequence[str], places: Real, influence: Influence
) -> tuple[TurnResponse, ...]:
    """Load of every main bearing, shaft on bearing, N.

    Parameters
    ----------
    turn, layout : of one machine.
    places : (B,) m.
    influence : of the shaft, :func:`bearings.simple_spans_influence` or :func:`bearings.continuous_beam_influence`.
    """
    return beside(layout, shaft_curves(turn, layout, influence(places, planes(layout))).responses(names, "N"))


def bending_moments(turn: WholeTurn, layout: Layout, places: Real, influence: Influence) -> tuple[TurnResponse, ...]:
    """Bending moment at every plane of a load, a counterweight or a bearing, in rising z, N m.

    Where it is always 0 there is none, unless it is 0 in all planes: then that of the first one stands for all.

    Parameters as for :func:`bearing_loads`.
    """
    corners = stations(layout, places)
    moment = bending_influence(layout, places, influence(places, planes(layout)), corners)
    mask = np.any(np.abs(moment) > 0.0, axis=-1)
    if not np.any(mask):
        # every load sits on a bearing of its own
        mask[..., 0] = True
    names = [f"bending:{station!r}" for station in corners[mask].tolist()]
    return beside(layout, shaft_curves(turn, layout, moment[mask]).responses(names, "N m"))


def stations(layout: Layout, places: Real) -> Real:
    """Planes in which the bending moment along the shaft has a corner, and so its maximum, in rising z (..., S) m.

    Those that coincide in all designs count once.

    Parameters
    ----------
    places : (..., B) of the bearings, m.
    """
    load_planes = planes(layout)
    supported = spread(places, (*load_planes.shape[:-1], places.shape[-1]))
    every = np.sort(np.concatenate([load_planes, supported], axis=-1), axis=-1)
    apart = np.ones(every.shape, dtype=bool)
    np.greater(every[..., 1:], every[..., :-1], out=apart[..., 1:])
    return every[..., np.logical_or.reduce(apart, axis=tuple(range(every.ndim - 1)))]


def bending_influence(layout: Layout, places: Real, reaction: Real, corners: Real) -> Real:
    """Bending moments at corners (..., S) m for one unit of load in every plane, (..., S, L) m.

    Parameters
    ----------
    reaction : (..., B, L) of the bearings at places (..., B) m, for the same loads.
    """
    return unit_bending_moment(places, reaction, planes(layout), corners)


@remembered
def planes(layout: Layout) -> Real:
    """Planes of rows, rotating masses and webs (..., L) m."""
    return side_by_side(layout.reciprocating.position, layout.rotating.position, layout.webs.position)


def shaft_curves(turn: WholeTurn, layout: Layout, influence: Real, reading: Reading = "on_shaft") -> ShaftCurves:
    """Curves by their influences (..., C, L) of unit loads in the planes, of what the rows put on shaft or frame."""
    rows, masses, designs = layout.reciprocating, layout.rotating, layout.omega.shape
    row_count, mass_count, count = rows.mass.shape[-1], masses.mass.shape[-1], influence.shape[-2]
    of_rows, of_masses = influence[..., :row_count], influence[..., row_count : row_count + mass_count]
    of_webs = influence[..., row_count + mass_count :]
    weights = of_rows * (rows.crank_direction / layout.omega[..., None] ** 2)[..., None, :]
    still = np.add.reduce(of_masses * (masses.mass * masses.radius * masses.direction)[..., None, :], axis=-1)
    total = len(turn.centre)
    return ShaftCurves(
        turn.curves(
            reading,
            spread(weights, (*designs, count, row_count)).reshape(total, count, row_count),
            spread(still, (*designs, count)).reshape(total, count),
        ),
        of_webs,
    )
