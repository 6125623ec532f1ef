"""Peaks over the whole turn: bracketed whatever the samples, of one machine and of many designs."""

import math
from collections.abc import Callable, Hashable, Iterable, Iterator, Sequence
from functools import lru_cache
from itertools import accumulate, pairwise
from typing import NamedTuple

import numpy as np

from optimizer.formulation.simulation import Prepared
from optimizer.mechanics.curve_batch import CurveBatch
from optimizer.mechanics.indicated import TURN
from optimizer.mechanics.row_series import Reading
from optimizer.mechanics.shaft_curves import ShaftCurves
from optimizer.mechanics.whole_turn import TurnCurves, WholeTurn
from optimizer.numerics.arrays import Complex, Real, spread
from optimizer.responses.piecewise_cubics import Bracket, Index

#: of a bracket, relative to the peak; and of a floor
TOLERANCE, FLOOR_TOLERANCE = 1e-9, 1e-7

#: names of searches of which an answer has one
_SHAFT, _CUSTOMARY = ("shaft",), ("customary",)


class Extremes(NamedTuple):
    """Largest and smallest values of curves over the turn, (..., C)."""

    high: Bracket
    low: Bracket  # of the values negated

    @property
    def magnitude(self) -> Bracket:
        """Largest magnitude."""
        first = self.high.lower >= self.low.lower
        return Bracket(
            np.where(first, self.high.angle, self.low.angle),
            np.where(first, self.high.value, self.low.value),
            np.maximum(self.high.lower, self.low.lower),
            np.maximum(self.high.upper, self.low.upper),
        )


def bracket(peak: Bracket, *index: int) -> tuple[float, float]:
    """One bracket as an answer holds it: at least and at most."""
    return float(peak.lower[index]), float(peak.upper[index])


class Search(NamedTuple):
    """Peaks of curves that an output shows.

    name : what says which they are, among all searches of one scene.
    """

    name: tuple[Hashable, ...]
    curves: TurnCurves
    number: Index  # (m,) which of the curves
    offset: Complex | Real  # (m,) what is added to each
    sign: Real | float = 0.0  # (m,) as in :meth:`Pieces.peaks`
    group: Index | None = None  # (m,) from 0, where only the largest of each group is shown

    @property
    def peak_count(self) -> int:
        """How many peaks are found."""
        return self.number.size if self.group is None else int(np.max(self.group, initial=-1)) + 1

    @property
    def peaks(self) -> Bracket:
        """What is found of it alone."""
        return self.curves.pieces.peaks(self.offset, TOLERANCE, self.number, self.group, self.sign)


def searched(scene: Prepared, searches: Iterable[Search]) -> dict[tuple[Hashable, ...], Bracket]:
    """Brackets (m,), or (groups,), of all searches of one machine, each as if it were alone."""
    every = list({search.name: search for search in searches}.values())
    if not every:
        return {}
    # what several outputs have in common stands there once
    curves = list({id(search.curves): search.curves for search in every}.values())
    batch = CurveBatch(tuple(curves))
    first = {id(search): number for search, number in zip(curves, batch.first.tolist(), strict=False)}
    number = np.concatenate([search.number + first[id(search.curves)] for search in every])
    offset = np.concatenate([search.offset for search in every])
    sign = np.concatenate([np.zeros(search.number.size) + search.sign for search in every])
    groups = [np.arange(search.number.size) if search.group is None else search.group for search in every]
    ends = [0, *accumulate(search.peak_count for search in every)]
    group = np.concatenate([part + end for part, end in zip(groups, ends, strict=False)])
    peaks = _reshaped(scene, batch.pieces.peaks(offset, TOLERANCE, number, group, sign))
    return {
        search.name: Bracket._make(part[slice(*own)] for part in peaks)
        for search, own in zip(every, pairwise(ends), strict=True)
    }


def peaks_of(scene: Prepared, search: Search) -> Bracket:
    """What has been searched together with all else, or else is searched now."""
    peaks = scene.brackets.get(search.name)
    return _reshaped(scene, search.peaks) if peaks is None else peaks


def rows_search(scene: Prepared, reading: Reading) -> Search:
    """Largest and smallest values of a force of every row."""
    whole: WholeTurn = scene.results["whole_turn"]
    curves = whole.of_rows(reading)
    return Search(_rows_name(reading), curves, *_both_ways(curves.weights.shape[0] * curves.weights.shape[1]))


@lru_cache(maxsize=16)
def _both_ways(count: int) -> tuple[Index, Real, Real]:
    """Numbers of so many scalars, what is added to each, and signs: of their maxima and then of their minima."""
    number, sign = np.arange(2 * count), np.ones(2 * count)
    number[count:] -= count
    sign[count:] = -1.0
    return number, np.zeros(2 * count), sign


def _rows_name(reading: Reading) -> tuple[Hashable, ...]:
    return "rows", reading


def of_rows(scene: Prepared, reading: Reading) -> Extremes:
    """Of a force of every row, (..., rows)."""
    peaks = scene.brackets.get(_rows_name(reading))
    if peaks is not None:
        return Extremes(*_parts(peaks, 2))
    return Extremes(*(_reshaped(scene, part) for part in _parts(rows_search(scene, reading).peaks, 2)))


def largest_of_rows(scene: Prepared, reading: Reading) -> Bracket:
    """Largest magnitude of a force of all rows, (...); 0 without rows."""
    whole: WholeTurn = scene.results["whole_turn"]
    count = scene.layout.reciprocating.mass.shape[-1]
    if count == 0:
        nothing = np.zeros(scene.layout.omega.shape)
        return Bracket(nothing, nothing.astype(complex), nothing, nothing)
    designs = np.repeat(np.arange(len(whole.centre)), count)
    peaks = whole.of_rows(reading).pieces.peaks(np.zeros(designs.size), TOLERANCE, None, designs)
    return _single(_reshaped(scene, peaks))


def torque_search(scene: Prepared, constant: Real | float = 0.0) -> Search:
    """Largest torque of all rows with a constant (...), N m, magnitude."""
    whole: WholeTurn = scene.results["whole_turn"]
    offset = spread(np.reshape(constant, -1), (len(whole.centre),))
    return Search(("torque", offset.tobytes()), whole.torque, np.arange(offset.size), offset)


def of_torque(scene: Prepared, constant: Real | float = 0.0) -> Bracket:
    """The same: (...)."""
    return _single(peaks_of(scene, torque_search(scene, constant)))


def of_shaft(scene: Prepared, curves: ShaftCurves, unbalance: Complex | None, group: Index | None = None) -> Bracket:
    """Peaks of loads [N] or moments [N m] without or with counterweights (..., webs) kg m: (..., C).

    Parameters
    ----------
    group : (C,) from 0, where only the largest of each group is asked for: (..., groups).
    """
    pieces = curves.curves.pieces
    if group is not None:
        designs = np.arange(len(pieces.half) // group.size)
        group = (designs[:, None] * (np.max(group) + 1) + group).reshape(-1)
    return _times_square(scene, _reshaped(scene, pieces.peaks(curves.offsets(unbalance), TOLERANCE, None, group)))


def shaft_search(curves: ShaftCurves, unbalances: Sequence[Complex | None]) -> Search:
    """Peaks of loads and moments of one machine with several sets of counterweights."""
    count, sets = curves.curves.weights.shape[1], len(unbalances)
    offset = np.concatenate([curves.offsets(unbalance) for unbalance in unbalances])
    return Search(_SHAFT, curves.curves, np.tile(np.arange(count), sets), offset)


def of_shaft_sets(scene: Prepared, curves: ShaftCurves, unbalances: Sequence[Complex | None]) -> tuple[Bracket, ...]:
    """The same as :func:`of_shaft` with several sets of counterweights, all peaks searched together."""
    known = scene.brackets.get(_SHAFT)
    every = peaks_of(scene, shaft_search(curves, unbalances)) if known is None else known
    return tuple(_times_square(scene, part) for part in _parts(every, len(unbalances)))


def _parts(peaks: Bracket, number: int) -> Iterator[Bracket]:
    """So many parts of equal size, one after the other."""
    size = peaks.angle.size // number
    for k in range(number):
        yield Bracket._make(part[k * size : (k + 1) * size] for part in peaks)


def customary_search(scene: Prepared, customary: Complex) -> Search:
    """The largest load of a bearing, and the largest bending moment, of one machine with customary counterweights."""
    found, bearings = scene.shaft_curves, len(scene.machine.bearings)
    kind = np.minimum(np.arange(found.curves.weights.shape[1]) // bearings, 1)
    return Search(_CUSTOMARY, found.curves, np.arange(kind.size), found.offsets(customary), group=kind)


def of_customary(scene: Prepared, customary: Callable[[], Complex]) -> Real:
    """The same (2,) N, N m, of counterweights that are worked out where nothing was searched before."""
    known = scene.brackets.get(_CUSTOMARY)
    peaks = peaks_of(scene, customary_search(scene, customary())) if known is None else known
    return _times_square(scene, peaks).lower


def separate_groups(alone: int, together: int) -> Index:
    """Groups of curves of which some stand alone, and of the others only the largest counts."""
    return np.minimum(np.arange(alone + together), alone)


def _times_square(scene: Prepared, peaks: Bracket) -> Bracket:
    """Times omega^2."""
    angle, value, lower, upper = peaks
    square = scene.layout.omega[..., None] ** 2
    return Bracket(angle, value * square, lower * square, upper * square)


def _single(peaks: Bracket) -> Bracket:
    """Without the last axis, of length 1."""
    angle, value, lower, upper = peaks
    return Bracket(angle[..., 0], value[..., 0], lower[..., 0], upper[..., 0])


def _reshaped(scene: Prepared, peaks: Bracket) -> Bracket:
    """With the leading axes of the scene, and angles within the turns after which all repeats."""
    leading = scene.layout.omega.shape
    count = peaks.angle.size // max(math.prod(leading), 1)
    shape = (*leading, count)
    whole: WholeTurn = scene.results["whole_turn"]
    angle = np.mod(peaks.angle, TURN * whole.turns)
    return Bracket(
        angle.reshape(shape), peaks.value.reshape(shape), peaks.lower.reshape(shape), peaks.upper.reshape(shape)
    )
