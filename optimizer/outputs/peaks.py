"""Peaks over the whole turn: bracketed whatever the samples, of one machine and of many designs."""

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import lru_cache
from itertools import accumulate, pairwise
from typing import NamedTuple

import numpy as np

from optimizer.formulation.simulation import Prepared
from optimizer.mechanics.curve_batch import CurveBatch
from optimizer.mechanics.indicated import TURN
from optimizer.mechanics.reading import Reading
from optimizer.mechanics.row_kinds import RowKinds
from optimizer.mechanics.shaft_curves import ShaftCurves
from optimizer.mechanics.whole_turn import TurnCurves, WholeTurn
from optimizer.numerics.arrays import Complex, Real, spread
from optimizer.responses.peak_table import Name, PeakList
from optimizer.responses.piecewise_cubics import NEARLY_NOTHING, Bracket, Index

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


class Search(NamedTuple):
    """Peaks of curves that an output shows.

    name : what says which they are, among all searches of one scene.
    """

    name: Name
    curves: TurnCurves
    number: Index  # (m,) which of the curves
    offset: Complex | Real  # (m,) what is added to each
    sign: Real  # (m,) as in :meth:`Pieces.peaks`
    group: Index | None = None  # (m,) from 0, where only the largest of each group is shown
    scale: float = 1.0  # of the peaks shown in units of the curves

    @property
    def peak_count(self) -> int:
        """Number of peaks."""
        return self.number.size if self.group is None else int(np.max(self.group, initial=-1)) + 1


def search(scene: Prepared, searches: Iterable[Search]) -> None:
    """Bracket the peaks of all searches of one machine at once, each as if it were alone, for its outputs to show."""
    every = list({item.name: item for item in searches}.values())
    if not every:
        return
    # what several outputs have in common stands there once
    curves = list({id(item.curves): item.curves for item in every}.values())
    batch = CurveBatch(tuple(curves))
    first = {id(curve): number for curve, number in zip(curves, batch.first.tolist(), strict=False)}
    counts, sizes = [item.peak_count for item in every], [item.number.size for item in every]
    ends = [0, *accumulate(counts)]
    # of all at once: small arrays cost by their number
    number = np.concatenate([item.number for item in every])
    number += np.array([first[id(item.curves)] for item in every]).repeat(sizes)
    offset = np.concatenate([item.offset for item in every])
    sign = np.concatenate([item.sign for item in every])
    group = np.concatenate([_numbers(item.number.size) if item.group is None else item.group for item in every])
    group += np.array(ends[:-1]).repeat(sizes)
    angle, value, lower, upper = batch.pieces.peaks(offset, TOLERANCE, number, group, sign, NEARLY_NOTHING)
    scale = np.array([item.scale for item in every]).repeat(counts)
    rows = {item.name: slice(*own) for item, own in zip(every, pairwise(ends), strict=True)}
    scene.peaks.add(rows, Bracket(_within_turns(scene, angle), value, lower * scale, upper * scale))


def peak_list(scene: Prepared, name: Name, curves: Callable[[], Search]) -> PeakList:
    """Peaks of one machine in plain numbers; searched now where they were not together with all else."""
    if name not in scene.peaks:
        search(scene, (curves(),))
    return scene.peaks.plain(name)


def rows_search(scene: Prepared, reading: Reading) -> Search:
    """Largest and smallest values of a force of every row; of the first of each kind alone, where there are kinds."""
    whole: WholeTurn = scene.results["whole_turn"]
    curves = whole.of_rows(reading)
    return Search(_rows_name(reading), curves, *_extrema(curves.weights.shape[0] * curves.weights.shape[1]))


def magnitudes_search(scene: Prepared, reading: Reading) -> Search:
    """Largest magnitudes of a force of every row likewise."""
    whole: WholeTurn = scene.results["whole_turn"]
    curves = whole.of_rows(reading)
    count = curves.weights.shape[0] * curves.weights.shape[1]
    return Search(_magnitudes_name(reading), curves, _numbers(count), unsigned(count), unsigned(count))


@lru_cache(maxsize=64)
def unsigned(count: int) -> Real:
    """Signs of so many curves of which the magnitude counts; nobody writes to them."""
    return np.zeros(count)


@lru_cache(maxsize=64)
def _numbers(count: int) -> Index:
    """The numbers from 0, to which nobody writes."""
    return np.arange(count)


@lru_cache(maxsize=16)
def _extrema(count: int) -> tuple[Index, Real, Real]:
    """Numbers of so many scalars, what is added to each, and signs: of their maxima and then of their minima."""
    number, sign = np.arange(2 * count), np.ones(2 * count)
    number[count:] -= count
    sign[count:] = -1.0
    return number, np.zeros(2 * count), sign


def _rows_name(reading: Reading) -> Name:
    return "rows", reading


def _magnitudes_name(reading: Reading) -> Name:
    return "magnitudes of rows", reading


def of_rows(scene: Prepared, reading: Reading) -> Extremes:
    """Of a force of every row, (..., rows)."""
    whole: WholeTurn = scene.results["whole_turn"]
    peaks = _brackets(scene, rows_search(scene, reading))
    return Extremes(*(_reshaped(scene, _of_every_row(whole.kinds, half)) for half in _halves(peaks)))


def of_row_magnitudes(scene: Prepared, reading: Reading) -> Bracket:
    """Largest magnitude of a force of every row, (..., rows)."""
    whole: WholeTurn = scene.results["whole_turn"]
    peaks = _brackets(scene, magnitudes_search(scene, reading))
    return _reshaped(scene, _of_every_row(whole.kinds, peaks))


def _brackets(scene: Prepared, of_rows: Search) -> Bracket:
    """What was searched together with all else, or is searched now."""
    name, curves, number, offset, sign, *_ = of_rows
    if name in scene.peaks:
        return scene.peaks.brackets(name)
    return curves.pieces.peaks(offset, TOLERANCE, number, None, sign, NEARLY_NOTHING)


def _of_every_row(kinds: RowKinds | None, peaks: Bracket) -> Bracket:
    """Peaks of the first row of each kind as those of all rows."""
    if kinds is None:
        return peaks
    kind = kinds.kind
    return Bracket(peaks.angle[kind] - kinds.ahead, peaks.value[kind], peaks.lower[kind], peaks.upper[kind])


def row_peaks(scene: Prepared, reading: Reading) -> list[PeakList]:
    """Largest values of a force of every row of one machine, and its smallest values negated."""
    peaks = peak_list(scene, _rows_name(reading), lambda: rows_search(scene, reading)).split(2)
    kinds = scene.results["whole_turn"].kinds
    return peaks if kinds is None else [half.at_places(kinds.kind.tolist(), kinds.ahead_deg) for half in peaks]


def row_magnitudes(scene: Prepared, reading: Reading) -> list[tuple[float, float]]:
    """Brackets of the largest magnitudes of a force of every row of one machine."""
    high, low = row_peaks(scene, reading)
    return list(zip(map(max, high.lower, low.lower), map(max, high.upper, low.upper), strict=True))


def row_largest(scene: Prepared, reading: Reading) -> list[float]:
    """The same of a force of which nothing else is shown, at least."""
    largest = peak_list(scene, _magnitudes_name(reading), lambda: magnitudes_search(scene, reading)).lower
    kinds = scene.results["whole_turn"].kinds
    return largest if kinds is None else [largest[kind] for kind in kinds.kind.tolist()]


def largest_of_rows(scene: Prepared, reading: Reading) -> Bracket:
    """Largest magnitude of a force of all rows, (...); 0 without rows."""
    whole: WholeTurn = scene.results["whole_turn"]
    if scene.layout.reciprocating.mass.shape[-1] == 0:
        nothing = np.zeros(scene.layout.omega.shape)
        return Bracket(nothing, nothing.astype(complex), nothing, nothing)
    curves = whole.of_rows(reading)
    designs = np.repeat(np.arange(len(whole.centre)), curves.weights.shape[1])
    peaks = curves.pieces.peaks(np.zeros(designs.size), TOLERANCE, None, designs, least=NEARLY_NOTHING)
    return _single(_reshaped(scene, peaks))


def torque_search(scene: Prepared, constant: Real | float = 0.0) -> Search:
    """Largest torque of all rows of one machine with a constant () N m, magnitude."""
    whole: WholeTurn = scene.results["whole_turn"]
    return Search(_torque_name(constant), whole.torque, _numbers(1), np.array([float(constant)]), unsigned(1))


def _torque_name(constant: Real | float) -> Name:
    return "torque", float(constant)


def torque_peak(scene: Prepared, constant: Real | float = 0.0) -> PeakList:
    """The same in plain numbers."""
    return peak_list(scene, _torque_name(constant), lambda: torque_search(scene, constant))


def of_torque(scene: Prepared, constant: Real | float = 0.0) -> Real:
    """Largest torque of all rows with a constant (...) N m, magnitude: (...)."""
    whole: WholeTurn = scene.results["whole_turn"]
    offset = spread(np.reshape(constant, -1), (len(whole.centre),))
    return whole.torque.pieces.peaks(offset, TOLERANCE, least=NEARLY_NOTHING).lower.reshape(scene.layout.omega.shape)


def of_shaft(scene: Prepared, curves: ShaftCurves, unbalance: Complex | None, group: Index | None = None) -> Bracket:
    """Peaks of loads [N] or moments [N m] without or with counterweights (..., webs) kg m: (..., C).

    Parameters
    ----------
    group : (C,) from 0, to search only the largest of each group: (..., groups).
    """
    pieces = curves.curves.pieces
    if group is not None:
        designs = np.arange(len(pieces.half) // group.size)
        group = (designs[:, None] * (np.max(group) + 1) + group).reshape(-1)
    peaks = pieces.peaks(curves.offsets(unbalance), TOLERANCE, None, group, least=NEARLY_NOTHING)
    return _times_square(scene, _reshaped(scene, peaks))


def shaft_search(scene: Prepared, unbalances: Sequence[Complex | None]) -> Search:
    """Peaks of loads [N] and moments [N m] of one machine with several sets of counterweights."""
    curves = scene.shaft_curves
    count, sets = curves.curves.weights.shape[1], len(unbalances)
    offset = np.concatenate([curves.offsets(unbalance) for unbalance in unbalances])
    number = np.concatenate([_numbers(count)] * sets)
    return Search(_SHAFT, curves.curves, number, offset, unsigned(count * sets), scale=scene.omega_squared)


def shaft_peaks(scene: Prepared, unbalances: Sequence[Complex | None]) -> list[PeakList]:
    """The same in plain numbers, set by set."""
    return peak_list(scene, _SHAFT, lambda: shaft_search(scene, unbalances)).split(len(unbalances))


def customary_search(scene: Prepared, customary: Complex) -> Search:
    """The largest load of a bearing, and the largest bending moment, of one machine with customary counterweights."""
    shaft, bearings = scene.shaft_curves, len(scene.machine.bearings)
    kind = np.minimum(_numbers(shaft.curves.weights.shape[1]) // bearings, 1)
    return Search(
        _CUSTOMARY,
        shaft.curves,
        _numbers(kind.size),
        shaft.offsets(customary),
        unsigned(kind.size),
        group=kind,
        scale=scene.omega_squared,
    )


def customary_peaks(scene: Prepared, customary: Callable[[], Complex]) -> list[float]:
    """The same [N, N m], of counterweights that are worked out where nothing was searched before."""
    return peak_list(scene, _CUSTOMARY, lambda: customary_search(scene, customary())).lower


def separate_groups(alone: int, together: int) -> Index:
    """Groups of curves of which some stand alone, and of the others only the largest counts."""
    return np.minimum(np.arange(alone + together), alone)


def _halves(peaks: Bracket) -> Iterator[Bracket]:
    """The first half and the second."""
    half = peaks.angle.size // 2
    return (Bracket._make(part[section] for part in peaks) for section in (slice(half), slice(half, None)))


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
    angle = _within_turns(scene, peaks.angle)
    return Bracket(
        angle.reshape(shape), peaks.value.reshape(shape), peaks.lower.reshape(shape), peaks.upper.reshape(shape)
    )


def _within_turns(scene: Prepared, angle: Real) -> Real:
    """Angles [rad] within the turns after which all repeats."""
    whole: WholeTurn = scene.results["whole_turn"]
    return np.mod(angle, TURN * whole.turns)
