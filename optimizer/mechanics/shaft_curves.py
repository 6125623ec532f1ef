"""Loads of the main bearings and bending moments of the shaft over the whole turn, as responses to counterweights.

Seen from the shaft the load of bearing j is a fixed curve and a constant: d_j(theta) + sum_k B_jk u_k, with B the real
influence of :mod:`bearings` and the loads of the rows as the shaft sees them (:mod:`whole_turn`). The bending moment is
linear in loads and bearing loads, and between their planes linear in z, so that the largest is at one of the planes:
finitely many responses, and no error. Everything is over omega^2.
"""

from collections.abc import Callable, Sequence

import numpy as np

from optimizer.arrays import Real
from optimizer.curve import TurnResponse
from optimizer.mechanics.bearings import bending_moment
from optimizer.mechanics.layout import Layout
from optimizer.mechanics.whole_turn import WholeTurn

#: bearing loads for unit loads: (B,) and (L,) m to (B, L)
Influence = Callable[[Real, Real], Real]


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
    return _responses(turn, layout, names, "N", influence(places, _planes(layout)))


def bending_moments(turn: WholeTurn, layout: Layout, places: Real, influence: Influence) -> tuple[TurnResponse, ...]:
    """Bending moment at every plane of a load, a counterweight or a bearing, in rising z, N m; where it is always 0
    there is none.

    Parameters as for :func:`bearing_loads`.
    """
    planes = _planes(layout)
    stations = np.unique(np.concatenate([planes, places]))
    unit = np.eye(planes.size, dtype=complex)
    reaction = influence(places, planes).astype(complex)
    moment = bending_moment(places, reaction, planes, unit, stations).real
    some = np.any(np.abs(moment) > 0.0, axis=-1)
    names = [f"bending at {station!r} m" for station in stations[some].tolist()]
    return _responses(turn, layout, names, "N m", moment[some])


def _planes(layout: Layout) -> Real:
    """Planes of rows, rotating masses and webs (L,) m."""
    return np.concatenate([layout.reciprocating.position, layout.rotating.position, layout.webs.position])


def _responses(
    turn: WholeTurn, layout: Layout, names: Sequence[str], unit: str, influence: Real
) -> tuple[TurnResponse, ...]:
    """Responses by their influence (C, L) of unit loads."""
    rows, masses = layout.reciprocating, layout.rotating
    of_rows, of_masses, of_webs = np.split(influence, np.cumsum([rows.position.size, masses.position.size]), axis=-1)
    still = of_masses @ (masses.mass * masses.radius * masses.direction)
    weights = of_rows * rows.crank_direction / layout.omega**2
    curves = turn.curves("on_shaft", weights[None], still[None])
    return tuple(TurnResponse(name, unit, of_webs[n], curves, n) for n, name in enumerate(names))
