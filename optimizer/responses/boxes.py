"""Cells of shaft angles and directions in which a vector may be as large as masses make it.

What :mod:`optimizer.responses.worst_masses` searches: how a cell is cut, and what vectors in it come to at most and at
least.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from optimizer.numerics.arrays import Complex, Real
from optimizer.numerics.polynomials import bernstein, shifts, squared
from optimizer.responses.piecewise_cubics import ANGLE_ROUNDING, Index

#: places of a cell that are looked at
_PLACES = np.array([0.0, -1.0, 1.0])
_POWERS = _PLACES[:, None] ** np.arange(4)
#: parts of a range of directions
_DIRECTIONS = 2


class Cells(NamedTuple):
    """Cells of angle and direction that may hold a peak, (n,)."""

    member: Index  # whose peak
    piece: Index
    centre: Real  # rad
    half: Real
    cubic: Complex  # (n, 4) of the curve, offset included
    parts: Complex  # (n, R, 4) of the rows, for the whole share
    rest: Real  # what the cubics leave out
    rests: Real  # (n, R)
    towards: Real  # rad, middle of the directions
    width: Real  # rad, half of their range
    signs: Real  # (n, R) of masses that are decided, whose parts are in the cubic; 0 of the others

    def subset(self, keep: NDArray[np.bool_] | Index) -> "Cells":
        return Cells._make(array[keep] for array in self)

    def cut(self, count: int) -> "Cells":
        """Each in so many parts of its angles, by the same polynomials."""
        places, shift = shifts(count)
        again = self.subset(np.repeat(np.arange(self.member.size), count))
        return again._replace(
            centre=(self.centre[:, None] + self.half[:, None] * places).reshape(-1),
            half=again.half / count,
            cubic=np.einsum("nk,pki->npi", self.cubic, shift).reshape(-1, 4),
            parts=np.einsum("nrk,pki->npri", self.parts, shift).reshape(-1, *self.parts.shape[1:]),
        )

    def direction_halves(self) -> "Cells":
        """Each in halves of its directions."""
        again = self.subset(np.repeat(np.arange(self.member.size), _DIRECTIONS))
        width = 0.5 * again.width
        side = np.tile([-1.0, 1.0], self.member.size)
        return again._replace(towards=again.towards + side * width, width=width)

    def decided(self, bounds: "CellBounds") -> "Cells":
        """With every sign of the masses that are still open, each for all directions."""
        count = np.count_nonzero(bounds.open, axis=-1)
        again = self.subset(np.repeat(np.arange(self.member.size), 2**count))
        first = np.cumsum(2**count) - 2**count
        # the numbers from 0 of the ways, as signs of the rows that are open
        way = (np.arange(again.member.size) - np.repeat(first, 2**count))[:, None]
        open_, sign = (np.repeat(array, 2**count, axis=0) for array in (bounds.open, bounds.signs))
        digit = np.where(open_, np.cumsum(open_, axis=-1) - 1, 0)
        signs = np.where(open_, 2.0 * (way >> digit & 1) - 1.0, sign)
        return again._replace(
            cubic=again.cubic + np.sum(signs[..., None] * again.parts, axis=1),
            parts=np.zeros_like(again.parts),
            rest=again.rest + np.sum(again.rests, axis=-1),
            rests=np.zeros_like(again.rests),
            width=np.full(again.member.size, np.pi),
            signs=np.where(again.signs != 0.0, again.signs, signs),
        )


class CellBounds(NamedTuple):
    """Bounds of cells."""

    most: Real
    rounding: Real  # of angles, which no finer cell has less of; ``most`` holds it
    by_direction: NDArray[np.bool_]  # what is open is so for the range of directions more than for that of angles
    rest: Real  # of all polynomials that count
    towards: Real  # where the direction of a peak can be
    width: Real
    open: NDArray[np.bool_]  # (n, R) rows of either sign
    signs: Real  # (n, R) of those of one sign
    lower: Real  # that is attained
    angle: Real
    there: Real  # (n, R) signs of the masses there


def worst_masses(value: Complex, parts: Complex) -> Real:
    """Signs (n, R) of changes of the masses that make vectors (n,) about as large as they may be."""
    signs = _along(parts, value)
    return _along(parts, value + np.sum(signs * parts, axis=-1))


def look(cells: Cells) -> CellBounds:
    """Upper bounds of cells, and values that they reach."""
    middle = cells.parts[..., 0]
    size, reach = np.abs(middle), np.sum(np.abs(cells.parts[..., 1:]), axis=-1) + cells.rests
    along = (np.exp(-1j * cells.towards)[:, None] * middle).real
    turning = size * (2.0 * np.sin(0.5 * np.minimum(cells.width, np.pi)))[:, None]
    certain = np.abs(along) > turning + reach
    signs = np.where(certain, np.sign(along), 0.0)
    # what rows of either sign may come to, along the directions of the cell and along any
    loose = np.where(certain, 0.0, np.minimum(size + reach, np.abs(along) + turning + reach))
    undirected = np.sum(np.where(certain, 0.0, size + reach), axis=-1)
    whole = cells.cubic + np.sum(signs[..., None] * cells.parts, axis=1)
    rest = cells.rest + np.sum(np.where(certain, cells.rests, 0.0), axis=-1)
    largest = np.sqrt(np.maximum(np.max(bernstein(squared(whole)), axis=-1), 0.0))
    travel = np.sum(np.abs(whole[:, 1:]), axis=-1) + rest
    towards, width, beside = _directions(cells, whole[:, 0], travel, travel + undirected)
    most = largest * np.cos(np.minimum(beside, 0.5 * np.pi)) + rest + np.sum(loose, axis=-1)
    rounding = ANGLE_ROUNDING * np.abs(whole[:, 1]) / cells.half
    most += rounding
    free = ~certain & (size + reach > 0.0)
    by_direction = np.sum(np.where(free, turning, 0.0), axis=-1) > np.sum(np.where(free, reach, 0.0), axis=-1)
    upper = np.where(width >= 0.0, most, -np.inf)
    return CellBounds(upper, rounding, by_direction, rest, towards, width, free, signs, *_attained(cells, signs))


def _directions(cells: Cells, centre: Complex, travel: Real, off: Real) -> tuple[Real, Real, Real]:
    """Middle and half width of the directions of a cell that a peak in it can have, and how far they are beside the
    vectors of the rows that are certain. The width is negative where there are none.

    Parameters
    ----------
    centre : (n,) about which the vectors of these rows are no farther than ``travel``, and those of all than ``off``.
    """
    size = np.abs(centre)

    def spread(radius: Real) -> Real:
        inside = radius < size
        ratio = np.where(inside, radius / np.where(inside, size, 1.0), 0.0)
        return np.where(inside, np.arcsin(ratio), np.pi)

    def principal(angle: Real) -> Real:
        return np.remainder(angle + np.pi, 2.0 * np.pi) - np.pi

    apart = principal(np.angle(centre) - cells.towards)
    beside = np.maximum(np.abs(apart) - cells.width - spread(travel), 0.0)
    reach = spread(off)
    # where both ranges are short enough to meet once
    once = cells.width + reach < np.pi
    least = np.where(once, np.maximum(-cells.width, apart - reach), -cells.width)
    most = np.where(once, np.minimum(cells.width, apart + reach), cells.width)
    narrower = ~once & (reach < cells.width)
    least, most = np.where(narrower, apart - reach, least), np.where(narrower, apart + reach, most)
    return cells.towards + 0.5 * (least + most), 0.5 * (most - least), beside


def _attained(cells: Cells, signs: Real) -> tuple[Real, Real, Real]:
    """What is attained in cells, at which angle and with which signs of the masses (n, R)."""
    curve = cells.cubic @ _POWERS.T
    parts = np.einsum("nrk,pk->nrp", cells.parts, _POWERS)
    places = []
    for k in range(_PLACES.size):
        trial_signs = np.where(signs != 0.0, signs, worst_masses(curve[:, k], parts[..., k]))
        value = np.abs(curve[:, k] + np.sum(trial_signs * parts[..., k], axis=-1))
        places.append((value, trial_signs))
    value, trial_signs = (np.stack(array) for array in zip(*places, strict=True))
    best = np.argmax(value, axis=0)
    every = np.arange(best.size)
    rest = cells.rest + np.sum(cells.rests, axis=-1)
    there = np.where(cells.signs != 0.0, cells.signs, trial_signs[best, every])
    return value[best, every] - rest, cells.centre + _PLACES[best] * cells.half, there


def _along(parts: Complex, vector: Complex) -> Real:
    """Signs (n, R) with which parts (n, R) go along vectors (n,)."""
    return np.where((np.conj(vector)[:, None] * parts).real >= 0.0, 1.0, -1.0)
