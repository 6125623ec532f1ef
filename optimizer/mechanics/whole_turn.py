"""Curves over the whole turn, piece by piece between the angles at which something jumps or has a kink.

A curve is a sum over the rows of one of their forces (:mod:`row_series`) times weights, and a constant: a rod force,
the torque, the load of a bearing as the shaft sees it. Its pieces are what :mod:`optimizer.responses.piecewise_cubics`
brackets peaks with.
"""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.polynomial.legendre import leggauss

from optimizer.mechanics.curve_series import CurveSeries, SeriesCurves, forces
from optimizer.mechanics.design_forces import ORDER, DesignForces
from optimizer.mechanics.indicated import SLIVER, TURN, Trace, entries, turns_of
from optimizer.mechanics.kinematics import angle_ahead, steep, steep_angles
from optimizer.mechanics.layout import Layout
from optimizer.mechanics.reading import Reading
from optimizer.mechanics.row_data import RowData, compact, shared
from optimizer.mechanics.row_kinds import RowKinds, row_kinds
from optimizer.mechanics.row_parts import RowParts
from optimizer.mechanics.row_series import AT_ONCE, RowSeries
from optimizer.mechanics.turn import Turn, panels
from optimizer.numerics.arrays import Complex, Real, all_true, spread
from optimizer.numerics.memoization import cached_property
from optimizer.numerics.records import record
from optimizer.responses.piecewise_cubics import Index, Pieces

#: rad, width of pieces that no break shortens
_WIDEST = np.deg2rad(5.0)
#: own crank angles at which rows reverse, rad
_DEAD_CENTRES = np.array([0.0, np.pi])
#: nodes of the quadrature in each part of a piece: exact for the square of a polynomial of one degree less
_GAUSS = 8
_NODES, _SHARES = leggauss(_GAUSS)
#: what such a polynomial leaves out of a part, as a share of the size of the curve, and the parts of a piece at most
_LEFT_OUT, _MOST_PARTS = 1e-11, 512.0
#: of a mean square, in units of the magnitudes of the terms that are added up in the curve
_ROUNDING = 16 * np.finfo(float).eps


def break_angles(layout: Layout, opens: tuple[Real, ...] = (), traces: Sequence[Trace] = ()) -> Real:
    """Shaft angles between which all is smooth, (..., B) rad; nan where a design has one less.

    Parameters
    ----------
    opens : (..., rows, n) own crank angles at which valves open; nan where they do not.
    traces : indicated pressures; the breaks are those of all turns after which they repeat.
    """
    ratio = layout.reciprocating.rod_ratio
    dead = spread(_DEAD_CENTRES, (*ratio.shape, 2))
    own = np.concatenate([*opens, dead, *([steep_angles(ratio)] if steep(ratio) else [])], axis=-1)
    ahead = angle_ahead(layout)
    angles = (own - ahead[..., None]).reshape(*ratio.shape[:-1], -1)
    designs = tuple(range(angles.ndim - 1))
    angles = angles[..., ~np.logical_and.reduce(np.isnan(angles), axis=designs)]
    apart = 0.0
    if traces:
        turns, apart = turns_of(traces), SLIVER
        again = [np.mod(angles + TURN * k, TURN * turns) for k in range(turns)]
        angles = np.concatenate([*again, entries(traces, ahead)], axis=-1)
    angles = np.sort(angles, axis=-1)
    # rows that reverse together, and tables that have the same entries, would only make panels without width
    same = np.zeros(angles.shape, dtype=bool)
    np.less_equal(angles[..., 1:] - angles[..., :-1], apart, out=same[..., 1:])
    return angles[..., ~np.logical_and.reduce(same, axis=designs)]


@record(frozen=True)
class WholeTurn:
    """The rows of N designs over P pieces of the turn.

    centre, half : (N, P) rad; half is 0 where breaks coincide.
    turns : of the shaft, after which all repeats.
    means : (N, R) N, of the tangential forces, where there is a closed form.
    squared : whether mean squares are computed: what bounds their quadratures bounds the pieces too.
    readings : of the forces of many designs, that columns will need.
    single : whether it is of a machine by itself. Designs of a sweep are worked out as beside others, however many.
    """

    rows: RowData
    centre: Real
    half: Real
    turns: int = 1
    means: Real | None = None
    squared: bool = False
    readings: tuple[Reading, ...] = ()
    single: bool = False

    def curves(self, reading: Reading, weights: Complex | Real, constant: Complex | Real | float = 0.0) -> "TurnCurves":
        """Sums of a force of the rows over weights (N, C, R), with constants (N, C): N C curves."""
        return TurnCurves(self, reading, weights, spread(np.asarray(constant), weights.shape[:2]))

    def of_designs(self, designs: slice) -> "WholeTurn":
        """The turn of some of the designs alone."""
        means = None if self.means is None else self.means[designs]
        rows = self.rows.of_designs(designs)
        return WholeTurn(rows, self.centre[designs], self.half[designs], self.turns, means, self.squared)

    def of_rows(self, reading: Reading) -> "TurnCurves":
        """A force of every row by itself; of the first row of each kind alone, where there are kinds."""
        if reading not in self._of_rows:
            alone = self._alone if self.kinds is None else self._alone[:, self.kinds.first]
            self._of_rows[reading] = self.curves(reading, alone)
        return self._of_rows[reading]

    def of_every_row(self, reading: Reading) -> "TurnCurves":
        """A force of every row by itself, those of one kind too."""
        return self.of_rows(reading) if self.kinds is None else self.curves(reading, self._alone)

    @cached_property
    def _alone(self) -> Real:
        """Weights (N, R, R) of each row by itself."""
        count = self.rows.crank_radius.shape[-1]
        return spread(np.eye(count), (len(self.centre), count, count))

    @cached_property
    def _of_rows(self) -> "dict[Reading, TurnCurves]":
        return {}

    @cached_property
    def torque(self) -> "TurnCurves":
        """Torque of all rows against rotation, N m."""
        radius = self.rows.crank_radius[:, None, :]
        return self.curves("tangential", spread(radius, (len(self.centre), *radius.shape[1:])))

    def tangential(self, turn: Turn) -> Real:
        """Tangential force of every row (N, R, n) N at the nodes of panels between breaks, which have leading axes."""
        nodes, middle = (array.reshape(-1, array.shape[-1]) for array in (turn.angle, turn.middle))
        places = shared(np.stack([nodes, middle], axis=1))
        series = RowSeries(self.rows, places[:, 0], None, places[:, 1], 0)
        return forces(series, "tangential")[..., 0].real

    @cached_property
    def forces(self) -> DesignForces | None:
        """Forces of the rows of many designs; None without a list of readings."""
        if len(self.centre) == 1 or self.squared or not self.readings:
            return None
        return DesignForces(self.rows, self.centre, self.half, self.readings)

    @cached_property
    def points(self) -> RowSeries:
        """Series about the centres of the pieces."""
        centre, _ = self._cut
        return RowSeries(self.rows, centre, None, centre, 3, kinds=self.kinds)

    @cached_property
    def kinds(self) -> RowKinds | None:
        """Of the rows of a single machine, where some do the same as others some pieces later."""
        if not self.single or self.centre.size * self.rows.crank_radius.shape[-1] > AT_ONCE:
            return None
        return row_kinds(self.rows, self.centre[0], self.half[0])

    @cached_property
    def bounds(self) -> RowSeries:
        """Series bounded over the pieces."""
        return self.higher_bounds.of_order(4) if self.squared else self._bounded(4)

    @cached_property
    def higher_bounds(self) -> RowSeries:
        """The same up to the order that quadratures leave out."""
        return self._bounded(_GAUSS)

    def _bounded(self, order: int) -> RowSeries:
        centre, half = self._cut
        return RowSeries(self.rows, centre, half, centre, order, kinds=self.kinds)

    @cached_property
    def _cut(self) -> tuple[Real, Real]:
        """Centres and half widths, once where all designs have the same."""
        centre, half = shared(self.centre), shared(self.half)
        return (centre, half) if len(centre) == len(half) else (self.centre, self.half)


def whole_turn(
    rows: RowData,
    breaks: Real,
    means: Real | None = None,
    squared: bool = False,
    readings: tuple[Reading, ...] = (),
    single: bool = False,
) -> WholeTurn:
    """The turn cut at breaks (..., B) rad and at regular angles; the leading axes become one.

    Parameters
    ----------
    means : (..., R) N, of the tangential forces, where there is a closed form.
    squared, readings, single : as of :class:`WholeTurn`.
    """
    turns = turns_of(rows.traces)
    turn = panels(breaks, _WIDEST, turns=turns)
    pieces = turn.width.shape[-1]
    half = 0.5 * turn.width.reshape(-1, pieces)
    centre = turn.start.reshape(half.shape) + half
    half = np.where(half > 0.5 * SLIVER, half, 0.0)
    # where breaks of all designs coincide there is no piece
    has_width = np.logical_or.reduce(half > 0.0, axis=0)
    centre, half = centre[:, has_width], half[:, has_width]
    shape = (rows.designs, half.shape[1])
    if means is not None:
        count = means.shape[-1]
        means = spread(means.reshape(math.prod(means.shape[:-1]), count), (rows.designs, count))
    return WholeTurn(rows, spread(centre, shape), spread(half, shape), turns, means, squared, readings, single)


@record(frozen=True)
class TurnCurves(SeriesCurves):
    """N C curves: sums of one force of the rows.

    reading : which.
    weights : (N, C, R).
    constant : (N, C).
    """

    whole: WholeTurn
    reading: Reading
    weights: Complex | Real
    constant: Complex | Real

    @property
    def period_deg(self) -> float:
        return 360.0 * self.whole.turns

    def of_designs(self, designs: slice) -> "TurnCurves":
        """The curves of some of the designs alone."""
        return TurnCurves(self.whole.of_designs(designs), self.reading, self.weights[designs], self.constant[designs])

    def first(self, count: int) -> "TurnCurves":
        """The first curves of each design alone."""
        result = TurnCurves(self.whole, self.reading, self.weights[:, :count], self.constant[:, :count])
        if len(self.weights) == 1 and ("pieces" in vars(self) or "_excerpt" in vars(self)):
            result.take(self.pieces, slice(0, count))
        return result

    def take(self, pieces: Pieces, own: slice) -> None:
        """Have those of a batch, where these curves have none yet."""
        vars(self).setdefault("_excerpt", (pieces, own))

    @cached_property
    def pieces(self) -> Pieces:
        """The curves piece by piece (N C, P)."""
        if "_excerpt" in vars(self):
            pieces, own = vars(self)["_excerpt"]
            return pieces.part(own, self)
        whole = self.whole
        if whole.forces is None:
            cubic, rest, size = self._series.over(whole.points, whole.bounds, whole.half)
        else:
            cubic, rest, size = self._series.of_forces(whole.forces.of(self.reading), ORDER, whole.half)
        centre, half = (array.repeat(self.weights.shape[1], axis=0) for array in (whole.centre, whole.half))
        return Pieces(centre, half, cubic, rest, size, source=self)

    @cached_property
    def parts(self) -> RowParts:
        """What the inertia of each row adds to the curves of one machine."""
        (weights,), (centre,), (half,) = self.weights, self.whole.centre, self.whole.half
        return RowParts(self.whole.rows, centre, half, self.reading, weights)

    @cached_property
    def mean(self) -> Complex:
        """Means over the turn (N C,)."""
        means = self.whole.means
        if self.reading == "tangential" and means is not None:
            closed: Complex = np.add.reduce(self.weights * means[:, None], axis=-1) + self.constant
            return closed.reshape(-1)
        return self._mean.reshape(-1)

    @cached_property
    def _mean(self) -> Complex:
        """The same by quadrature (N, C)."""
        values, shares, count = self._quadrature
        return _sums(values * shares, count)

    @cached_property
    def variance(self) -> Real:
        """Means of |curve - mean|^2 over the turn (N C,)."""
        values, shares, count = self._quadrature
        return _sums(np.abs(values - self._mean[..., None]) ** 2 * shares, count).reshape(-1)

    @cached_property
    def rms_error(self) -> Real:
        """What sqrt(variance + |mean + constant|^2) may be off by (N C,), for any constant.

        Both the root mean square and its quadrature are seminorms, alike for what is a polynomial on every part. So
        they differ by no more than both of what the polynomials leave out, which is at most the rest of the parts.
        """
        pieces = self.pieces
        rest = self._by_design(self._left_out) / self._parts[:, None] ** _GAUSS
        share = pieces.half / (np.pi * self.whole.turns)
        return 2.0 * np.sqrt(np.add.reduce(share * rest.reshape(share.shape) ** 2, axis=-1)) + _ROUNDING * pieces.size

    @cached_property
    def _left_out(self) -> Real:
        """What polynomials of the quadrature's degree leave out of the pieces at most (N C, P)."""
        return self._series.over(None, self.whole.higher_bounds, self.whole.half)[1]

    @cached_property
    def _parts(self) -> Real:
        """Number of equal parts of every piece (N, P) in the quadrature: the more, the more is left out there."""
        # the compiler is loaded at its first use
        from optimizer.mechanics.kernel.quadrature import equal_parts

        number, size = np.empty(self.whole.half.shape), self.pieces.size.reshape(self.weights.shape[:2])
        equal_parts(self._by_design(self._left_out), compact(size), _LEFT_OUT, _GAUSS, _MOST_PARTS, number)
        if self.whole.kinds is None:
            return number
        # as many where another row does the same
        period = math.gcd(number.size, *self.whole.kinds.later.tolist())
        most = np.maximum.reduce(number.reshape(-1, period), axis=0)
        return np.tile(most, number.size // period)[None]

    def _by_design(self, values: Real) -> Real:
        """Values (N C, P) as (N, C, P)."""
        return values.reshape(*self.weights.shape[:2], -1)

    @cached_property
    def _quadrature(self) -> tuple[Complex, Real, Index]:
        """Values (N, C, n) at the Gauss nodes of all parts, the share of the turn for which each stands (N, 1, n), and
        how many nodes each design has (N,). Nodes beyond these do not count."""
        from optimizer.mechanics.kernel.quadrature import gauss_nodes

        whole, parts = self.whole, self._parts
        count = _GAUSS * np.add.reduce(parts, axis=-1).astype(np.intp)
        shape = len(count), int(np.maximum.reduce(count))
        angle, within, shares = np.empty(shape), np.empty(shape), np.empty(shape)
        weight = _SHARES / (TURN * whole.turns)
        gauss_nodes(compact(whole.centre), compact(whole.half), parts, _NODES, weight, angle, within, shares)
        kinds = whole.kinds
        if kinds is not None:
            at_once = kinds.first.size * within.size <= AT_ONCE
            before = (np.add.accumulate(parts[0]) - parts[0]).astype(np.intp)
            kinds = kinds.of_parts(before[kinds.later] * _GAUSS) if at_once else None
        return self._values(angle, within, kinds), shares[:, None], count

    def in_pieces(self, places: Real) -> Complex:
        """The curves (N C, P n) at places (n,) from -1 to 1 of every piece, at its ends the one-sided limits."""
        whole, count = self.whole, len(places)
        angle = whole.centre[..., None] + whole.half[..., None] * places
        within = np.repeat(whole.centre, count, axis=-1)
        return self._values(angle.reshape(within.shape), within).reshape(-1, within.shape[-1])

    def at(self, angle: Real) -> Complex:
        """The curves (N C, n) at shaft angles (n,) rad; at a jump one of its limits or their middle."""
        places = spread(angle, (len(self.weights), len(angle)))
        return self._values(places, places).reshape(-1, len(angle))

    def along(self, angle: Real) -> Complex:
        """The same (N, C, n) at shaft angles (N, n) rad of every design."""
        return self._values(angle, angle)

    def _values(self, angle: Real, within: Real, kinds: RowKinds | None = None) -> Complex:
        """The curves (N, C, n) at angles (N, n) within pieces that hold others."""
        series = RowSeries(self.whole.rows, angle, None, within, 0, kinds=kinds)
        return self._series.over(series, None, within)[0].reshape(*self.weights.shape[:2], angle.shape[-1])

    def crossings(self, level: Real) -> tuple[Real, Real]:
        """Shaft angles (N C, n) rad at which scalars cross levels (N C,), jumps included, and what the integral up to
        there may be off by (N C,). Where a curve has fewer than another its angles are 0."""
        return self._series.crossings(self.pieces.cubics, compact(level))

    @cached_property
    def _series(self) -> CurveSeries:
        whole, curves = self.whole, self.weights.shape[0] * self.weights.shape[1]
        weights, constant = self.weights.reshape(curves, self.weights.shape[2]), self.constant.reshape(curves)
        return CurveSeries(whole.rows, whole.centre, (self.reading,), weights, constant)


def _sums(values: Any, count: Index) -> Any:
    """Sums (N, C) of the first so many (N,) of values (N, C, n), each added up as of a design alone."""
    if len(count) == 1 or all_true(count == values.shape[-1]):
        return np.add.reduce(values, axis=-1)
    return np.array(
        [np.add.reduce(row[:, :number], axis=-1) for row, number in zip(values, count.tolist(), strict=True)]
    )
