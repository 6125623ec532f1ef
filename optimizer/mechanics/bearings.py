"""Main-bearing loads and bending moments of a crankshaft.

The shaft is a straight beam along z, the bearings are points on it, and the loads act across it in their planes.
The two planes through z do not know each other and obey the same formulas, so one complex number x + jy does both.
Crank throws take part through the planes of their loads alone.

Signs. A load is a force as the project counts it: on the frame, positive outward; the shaft carries it to the
bearings. A bearing load is the force of the shaft on the bearing (the bearing pushes back with its negative). So
at every instant the bearing loads have the sum of the loads and their couple about any plane. Both may be divided by
omega^2, as everywhere: kg m instead of N.

Two models: ``simple_spans`` needs statics alone, ``continuous_beam`` also that the shaft bends evenly and the bearings
do not give. With two bearings they are one. Both are linear in the loads; the influence matrices are what a response
needs. Every length is a difference of two places, so the origin of z costs no digits.

Shapes: B bearings, L loads, S stations, T shaft angles (or phasors); leading axes broadcast. Bearings and loads come
in any order. Source: S. Timoshenko, Strength of Materials, part I (overhanging beams; continuous beams and the
equation of three moments).
"""

from itertools import pairwise
from math import ulp
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from optimizer.numerics.arrays import Complex, Real, all_true, spread

#: bearings nearer to each other than this share of the bearings' extent are one bearing
_COINCIDENT = 1e-9


def simple_spans(bearing: Real, position: Real, load: Complex) -> Complex:
    """Bearing loads of a shaft hinged at every intermediate bearing: statically determinate.

    Each span carries its own loads to its two bearings by the lever rule. The end span carries loads beyond an
    outermost bearing as an overhanging beam: it presses on the outer bearing with more than the load and lifts the
    inner one.

    Parameters
    ----------
    bearing : (..., B) places of the bearings on z, m; B >= 2.
    position : (..., L) planes of the loads, m.
    load : (..., L, T) loads, N or kg m.

    Returns
    -------
    (..., B, T) bearing loads, in the unit of the loads and the order of ``bearing``.

    Raises
    ------
    ValueError
        with fewer than two bearings, or two in the same place.
    """
    return simple_spans_influence(bearing, position) @ load


def continuous_beam(bearing: Real, position: Real, load: Complex) -> Complex:
    """Bearing loads of a continuous shaft of uniform bending stiffness on rigid, aligned bearings.

    The stiffness itself cancels. The bearings hold both ways and have no clearance: where a load between other
    bearings lifts the shaft, it presses on the opposite shell.

    Parameters, returns and errors as for ``simple_spans``.
    """
    return continuous_beam_influence(bearing, position) @ load


def simple_spans_influence(bearing: Real, position: Real) -> Real:
    """Load on every bearing for one unit of load in every plane, shaft hinged at the intermediate bearings.

    Parameters
    ----------
    bearing : (..., B) m.
    position : (..., L) m.

    Returns
    -------
    (..., B, L) dimensionless; every column has the sum 1. Exactly 1 and 0 where a load sits at a bearing.
    """
    spans = _spans(bearing, position)
    return spans.by_bearing(_levers(spans))


def continuous_beam_influence(bearing: Real, position: Real) -> Real:
    """Load on every bearing for one unit of load in every plane, continuous shaft.

    The hinges of the simple spans are closed by the support moments M_i that take the kink out of the shaft over
    every intermediate bearing (equation of three moments, spans l_i from bearing i to i+1):

        l_{i-1} M_{i-1} + 2 (l_{i-1} + l_i) M_i + l_i M_{i+1} = -(kinks of the loads)

    Shapes as for ``simple_spans_influence``.
    """
    spans = _spans(bearing, position)
    moment = _support_moments(spans)
    outer = np.zeros_like(spans.carries[..., :1, :])
    # the moments of overhanging loads at the outer bearings are in the levers already
    tilt = np.diff(np.concatenate([outer, moment, outer], axis=-2), axis=-2) / spans.length
    return spans.by_bearing(_levers(spans) + _at_bearings(tilt, -tilt))


def bending_moment(bearing: Real, reaction: Complex, position: Real, load: Complex, station: Real) -> Complex:
    """Bending moment in the shaft, for bearing loads from either model.

    The moment about the station of everything on one side of it, M(s) = sum R |x - s| - sum P |z - s|. This is the
    couple sum (z - s) F of the part of smaller z, with the loads +P and the bearings' answers -R as the forces on the
    shaft. Positive sags: a load between two bearings gives a moment in its own direction, an overhanging load one
    against it. The complex number points to the side of the shaft that is in tension; the moment vector of the part
    of smaller z is j M. (Timoshenko, part I: bending moment and shearing force.)

    It does not jump: at loads and bearings its slope does, by -P and +R. It is zero beyond the last load or bearing
    at either end, and at the intermediate bearings of ``simple_spans``.

    Parameters
    ----------
    bearing : (..., B) m.
    reaction : (..., B, T) bearing loads, in balance with the loads, N or kg m.
    position : (..., L) m.
    load : (..., L, T) in the unit of the bearing loads.
    station : (..., S) places on z, m.

    Returns
    -------
    (..., S, T) N m, or kg m^2.
    """
    largest = (np.maximum.reduce(np.abs(force), axis=-1) for force in (reaction, load))
    of_bearings, of_loads = _arms(bearing, position, station, *largest)
    return of_bearings @ reaction - of_loads @ load


def unit_bending_moment(bearing: Real, reaction: Real, position: Real, station: Real) -> Real:
    """The same for one unit of load in every plane (..., S, L) m, of which bearings have (..., B, L)."""
    largest = np.maximum.reduce(np.abs(reaction), axis=-1)
    of_bearings, of_loads = _arms(bearing, position, station, largest, np.ones(position.shape))
    # what is no load adds nothing
    return of_bearings @ reaction - of_loads


def _arms(bearing: Real, position: Real, station: Real, reaction: Real, load: Real) -> tuple[Real, Real]:
    """Arms (..., S, B) and (..., S, L) m of bearing loads and loads about stations, on the side of each with smaller
    terms by magnitudes (..., B) and (..., L)."""
    station = np.asarray(station, dtype=float)
    arms, terms = [], []
    for place, force in ((bearing, reaction), (position, load)):
        distance = np.asarray(place, dtype=float)[..., None, :] - station[..., :, None]
        # on either side
        own = np.empty((2, *distance.shape))
        np.maximum(-distance, 0.0, out=own[0])
        np.maximum(distance, 0.0, out=own[1])
        arms.append(own)
        terms.append(own @ force[..., None])
    # both sides give the same, but one has the smaller terms, and no terms at all where the shaft ends
    size = terms[0] + terms[1]
    smaller = size[0] < size[1]
    of_bearings, of_loads = (np.where(smaller, own[0], own[1]) for own in arms)
    return of_bearings, of_loads


class _Spans(NamedTuple):
    """Loads on the spans between neighbouring bearings in rising z; an end span has its overhang with it."""

    rank: NDArray[np.intp] | None  # (..., B) rank of each bearing in rising z; None where all are in that order
    length: Real  # (..., B-1, 1) m
    carries: Real  # (..., B-1, L) 1 for the span that has the load, else 0
    #: (2, ..., B-1, L) m, from the load to the right bearing, and from the left bearing to the load; negative on the
    #: overhang of the one or the other
    distance: Real

    def by_bearing(self, influence: Real) -> Real:
        """Rows (..., B, L) in rising z, put into the order in which the bearings came."""
        return influence if self.rank is None else np.take_along_axis(influence, self.rank[..., None], axis=-2)


def _spans(bearing: Real, position: Real) -> _Spans:
    bearing, position = np.asarray(bearing, dtype=float), np.asarray(position, dtype=float)
    if bearing.ndim == 0 or bearing.shape[-1] < 2:
        raise ValueError("a shaft needs two bearings at least: one alone holds no couple")
    leading = np.broadcast_shapes(bearing.shape[:-1], position.shape[:-1])
    place, rank = spread(bearing, leading + bearing.shape[-1:]), None
    if not _rising(bearing):
        order = np.argsort(place, axis=-1)
        place, rank = np.take_along_axis(place, order, axis=-1), np.argsort(order, axis=-1)
    _refuse_coincident(place)
    place, load_plane = place[..., None], position[..., None, :]
    left, right = place[..., :-1, :], place[..., 1:, :]
    # a load at an intermediate bearing belongs to the span on its right; its share of the left bearing is then 1
    beyond = np.empty((*leading, place.shape[-2], position.shape[-1]))
    beyond[..., 0, :], beyond[..., -1, :] = 1.0, 0.0
    beyond[..., 1:-1, :] = load_plane >= place[..., 1:-1, :]
    carries = beyond[..., :-1, :] - beyond[..., 1:, :]
    distance = np.empty((2, *carries.shape))
    np.subtract(right, load_plane, out=distance[0])
    np.subtract(load_plane, left, out=distance[1])
    return _Spans(rank, right - left, carries, distance)


def _refuse_coincident(place: Real) -> None:
    """Refuse bearings (..., B) in rising z that rounding cannot tell apart; nan is refused as well."""
    if place.ndim == 1:
        numbers = place.tolist()
        low, high = numbers[0], numbers[-1]
        least = max(_COINCIDENT * (high - low), 4.0 * ulp(max(abs(low), abs(high))))
        apart = all(upper - lower > least for lower, upper in pairwise(numbers))
    else:
        first, last = place[..., :1], place[..., -1:]
        resolution = 4.0 * np.spacing(np.maximum(np.abs(first), np.abs(last)))
        shortest = np.maximum(_COINCIDENT * (last - first), resolution)
        apart = all_true(place[..., 1:] - place[..., :-1] > shortest)
    if not apart:
        raise ValueError("two bearings are in the same place: every bearing needs a place of its own on the shaft")


def _rising(place: Real) -> bool:
    """Whether bearings (..., B) come in rising z, in all designs."""
    if place.ndim == 1:
        return all(lower < upper for lower, upper in pairwise(place.tolist()))
    return all_true(place[..., 1:] > place[..., :-1])


def _levers(spans: _Spans) -> Real:
    """Lever rule in every span; on an overhang one share is negative and the other above 1. (..., B, L)."""
    # each share from its own distance, not as 1 minus the other: exact at a bearing
    shares = spans.carries * (spans.distance / spans.length)
    return _at_bearings(shares[0], shares[1])


def _at_bearings(left: Real, right: Real) -> Real:
    """What the spans (..., B-1, L) put on their left and right bearings, summed at each bearing: (..., B, L)."""
    *leading, count, loads = left.shape
    result = np.zeros((*leading, count + 1, loads))
    result[..., :-1, :] = left
    result[..., 1:, :] += right
    return result


def _support_moments(spans: _Spans) -> Real:
    """Bending moment over every intermediate bearing for a unit load in every plane: (..., B-2, L), m.

    Symmetric, with twice as much on the diagonal as beside it, so well conditioned for any spans.
    """
    length = spans.length[..., 0]
    index = np.arange(length.shape[-1] - 1)
    matrix = np.zeros((*length.shape[:-1], index.size, index.size))
    matrix[..., index, index] = 2.0 * (length[..., :-1] + length[..., 1:])
    matrix[..., index[:-1], index[1:]] = matrix[..., index[1:], index[:-1]] = length[..., 1:-1]
    left, right = _kinks(spans)
    return np.asarray(np.linalg.solve(matrix, -(right[..., :-1, :] + left[..., 1:, :])), dtype=float)


def _kinks(spans: _Spans) -> Real:
    """Slopes 6 E I phi at both ends of a simple span for unit loads at distances a from the other end:
    (2, ..., B-1, L), m^2.

    a (l^2 - a^2) / l inside the span. A load overhanging the other end (a < 0) bends the span by its moment a there and
    by nothing else. The slope is a l: the same expression without the a in the bracket.
    """
    inside = np.maximum(spans.distance, 0.0)
    return spans.carries * spans.distance * (spans.length - inside) * (spans.length + inside) / spans.length
