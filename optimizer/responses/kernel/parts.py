"""Parts of the pieces of curves that may hold peaks, narrowed by their polynomials; compiled.

A part is let go where its largest Bernstein coefficient, and what the polynomial leaves out, is no more than the best
value so far, but for what the bracket may leave open: then the bracket includes it. In a search for the largest of
several peaks all of these have one bracket.
"""

from typing import NamedTuple

import numpy as np

from optimizer.numerics.arrays import Complex, Real
from optimizer.numerics.compiling import inner, inner_with_arrays
from optimizer.numerics.kernel.circle import length
from optimizer.numerics.polynomials import shifts, to_bernstein

#: what may hold a peak is cut into so many parts: by its polynomial, or to be expanded anew, which leaves out 16^-4
_FINE, _FINER = 4, 16
#: a rest of this share of what the bracket may leave open is no longer what keeps it open
ENOUGH = 0.125
#: after so many cuts in a row the bracket stays as it is
MOST_CUTS = 39
#: and so it is where so many parts may hold peaks: what is so steep is not worth more time
MOST_PARTS = np.int64(50_000)
#: rad, by which an angle may be rounded within two turns
_ANGLE_ROUNDING = 64 * np.finfo(float).eps

_OF_SQUARES, _OF_CUBICS = to_bernstein(6), to_bernstein(3)
(_FINE_PLACES, _TO_FINE), (_FINER_PLACES, _TO_FINER) = shifts(_FINE), shifts(_FINER)
_CENTRE, _HALF, _REST, _FOURTH = range(4)


class Cubics(NamedTuple):
    """Pieces (J, P) of curves: as in :class:`optimizer.responses.piecewise_cubics.Pieces`, all complex."""

    centre: Real
    half: Real
    cubic: Complex
    rest: Real


class Members(NamedTuple):
    """M members of which peaks are sought, in G groups of which only the largest peak counts."""

    curve: np.ndarray  # (M,)
    group: np.ndarray  # (M,)
    offset: Complex  # (M,)
    share: Real  # (G,) of the peak that its bracket may leave open
    rounding: Real  # (G,) that no bracket has to be narrower than
    sign: Real  # (G,) 0 for magnitudes; of scalars 1 for their maxima, -1 for their minima, negated


class Best(NamedTuple):
    """The best value of each of G peaks, and an upper bound of all parts that were let go."""

    lower: Real
    upper: Real
    angle: Real
    piece: np.ndarray
    member: np.ndarray


class Parts(NamedTuple):
    """Parts (n,) of pieces that may hold peaks."""

    member: np.ndarray
    piece: np.ndarray
    place: Real  # (n, 4) centre, half width, what is left out, and that of an expansion about the centre over half^4
    cubic: Complex  # (n, 4), offset included


@inner_with_arrays
def _none(count):  # type: ignore[no-untyped-def]
    return Parts(
        np.empty(count, np.int64),
        np.empty(count, np.int64),
        np.empty((count, 4)),
        np.empty((count, 4), np.complex128),
    )


@inner
def _place(parts, n, centre, half, rest, fourth):  # type: ignore[no-untyped-def]
    place = parts.place
    place[n, _CENTRE], place[n, _HALF], place[n, _REST], place[n, _FOURTH] = centre, half, rest, fourth


@inner
def _allowed(members, best, group):  # type: ignore[no-untyped-def]
    """How wide a bracket may be."""
    return max(members.share[group] * abs(best.lower[group]), members.rounding[group])


@inner
def _open_above(members, best, group):  # type: ignore[no-untyped-def]
    """What has to be exceeded to be looked at closer."""
    return best.lower[group] + _allowed(members, best, group)


@inner
def _keep(best, group, value, angle, piece, member):  # type: ignore[no-untyped-def]
    """Keep a value where it beats the best."""
    if not value <= best.lower[group]:
        best.lower[group], best.angle[group] = value, angle
        best.piece[group], best.member[group] = piece, member


@inner
def _tell(best, group, most):  # type: ignore[no-untyped-def]
    """What is let go is in the bracket; nan too."""
    if most > best.upper[group] or most != most:
        best.upper[group] = most


@inner
def _length(value):  # type: ignore[no-untyped-def]
    """Magnitude; of a scalar for less."""
    return abs(value.real) if value.imag == 0.0 else abs(value)


@inner
def _size(value, sign):  # type: ignore[no-untyped-def]
    """What a peak is the largest of: a magnitude, or a value times a sign."""
    return _length(value) if sign == 0.0 else sign * value.real


@inner
def _extremes(cubic, sign, square):  # type: ignore[no-untyped-def]
    """What a polynomial is not above, and its values at both ends; by what it squares to (7,), which it overwrites."""
    if sign != 0.0:
        most = -np.inf
        for j in range(4):
            value = 0.0
            for k in range(4):
                value += sign * cubic[k].real * _OF_CUBICS[k, j]
            most = max(most, value)
            if j == 0:
                first = value
        return most, first, value
    square[:] = 0.0
    for i in range(4):
        for k in range(4):
            square[i + k] += cubic[i].real * cubic[k].real + cubic[i].imag * cubic[k].imag
    most = 0.0
    for j in range(7):
        value = 0.0
        for k in range(7):
            value += square[k] * _OF_SQUARES[k, j]
        value = max(value, 0.0)
        most = max(most, value)
        if j == 0:
            first = value
    return np.sqrt(most), np.sqrt(first), np.sqrt(value)


@inner_with_arrays
def first_open(cubics, members, best):  # type: ignore[no-untyped-def]
    """The pieces that may hold a peak above the best value at a centre, by how far a cubic may be from it."""
    most = np.empty((members.curve.size, cubics.half.shape[1]))
    # curves of a sweep differ by design and have no use for this memory, which is slow to get
    curves, pieces = cubics.half.shape
    reach = np.empty((curves if members.curve.size > curves else 0, pieces))
    reach[:, :1] = np.nan
    parts = _none(_write_bounds(cubics, members, best, reach, most))
    _begun(cubics, members, best, most, parts)
    return still_open(parts, members, best, MOST_PARTS)


@inner
def _write_bounds(cubics, members, best, reach, most):  # type: ignore[no-untyped-def]
    """Write what members (M,) are not above on pieces, (M, P); how many of these are open.

    Parameters
    ----------
    reach : (J, P) room for how far curves may be from the middles of their pieces, of which the first is nan where it
        is undetermined; (0, P) if no curve has two peaks.
    """
    number, pieces = most.shape
    for m in range(number):
        curve, group = members.curve[m], members.group[m]
        half, cubic, rest, bound = cubics.half[curve], cubics.cubic[curve], cubics.rest[curve], most[m]
        several = reach.shape[0] > 0
        first = several and reach[curve, 0] != reach[curve, 0]
        offset, sign, largest, place = members.offset[m], members.sign[group], best.lower[group], -1
        for p in range(pieces):
            bound[p] = -np.inf
            if half[p] > 0.0:
                middle = _size(cubic[p, 0] + offset, sign)
                far = reach[curve, p] if several and not first else _reach(cubic[p], rest[p])
                if first:
                    reach[curve, p] = far
                bound[p] = middle + far
                if not middle - rest[p] <= largest:
                    largest, place = middle - rest[p], p
        if place >= 0:
            _keep(best, group, largest, cubics.centre[curve, place], place, m)
    count = 0
    for m in range(number):
        group, bound = members.group[m], most[m]
        above, let_go = _open_above(members, best, group), -np.inf
        for p in range(pieces):
            if bound[p] > above:
                count += 1
            elif bound[p] > let_go or bound[p] != bound[p]:
                let_go = bound[p]
        _tell(best, group, let_go)
    return count


@inner
def _reach(cubic, rest):  # type: ignore[no-untyped-def]
    """How far a curve may be from the middle of a piece."""
    reach = rest
    for i in range(1, 4):
        term = cubic[i]
        reach += abs(term.real) if term.imag == 0.0 else length(term)
    return reach


@inner
def _begun(cubics, members, best, most, parts):  # type: ignore[no-untyped-def]
    """Write those that are open."""
    n = 0
    for m in range(most.shape[0]):
        curve, above = members.curve[m], _open_above(members, best, members.group[m])
        for p in range(most.shape[1]):
            if most[m, p] > above:
                half, rest = cubics.half[curve, p], cubics.rest[curve, p]
                parts.member[n], parts.piece[n] = m, p
                _place(parts, n, cubics.centre[curve, p], half, rest, rest / half**4)
                for i in range(4):
                    parts.cubic[n, i] = cubics.cubic[curve, p, i]
                parts.cubic[n, 0] += members.offset[m]
                n += 1


@inner_with_arrays
def still_open(parts, members, best, most_parts):  # type: ignore[no-untyped-def]
    """Parts that may hold a peak above the best value, and those that hold it, unless there are too many."""
    number = parts.member.size
    most, open_ = np.empty(number), np.empty(number, np.bool_)
    survivors = _none(_compared(parts, members, best, most_parts, most, open_, np.empty(7)))
    _sorted_out(parts, members, best, most, open_, survivors)
    return survivors


@inner
def _compared(parts, members, best, most_parts, most, open_, square):  # type: ignore[no-untyped-def]
    """Write what parts (n,) are not above, and which of them are open; how many are."""
    number = most.size
    for n in range(number):
        place, member = parts.place[n], parts.member[n]
        largest, first, last = _extremes(parts.cubic[n], members.sign[members.group[member]], square)
        most[n] = largest + place[_REST]
        angle = place[_CENTRE] - place[_HALF] if first >= last else place[_CENTRE] + place[_HALF]
        _keep(best, members.group[member], max(first, last) - place[_REST], angle, parts.piece[n], member)
    count = 0
    for n in range(number):
        open_[n] = most[n] > _open_above(members, best, members.group[parts.member[n]])
        count += open_[n]
    if count > most_parts:
        count = 0
        for n in range(number):
            open_[n] = False
    return count


@inner
def _sorted_out(parts, members, best, most, open_, survivors):  # type: ignore[no-untyped-def]
    """Write the parts that are open, and have what the others may be at most in the bracket."""
    k = 0
    for n in range(most.size):
        if open_[n]:
            survivors.member[k], survivors.piece[k] = parts.member[n], parts.piece[n]
            for i in range(4):
                survivors.place[k, i], survivors.cubic[k, i] = parts.place[n, i], parts.cubic[n, i]
            k += 1
        else:
            rounding = _ANGLE_ROUNDING * abs(parts.cubic[n, 1]) / parts.place[n, _HALF]
            _tell(best, members.group[parts.member[n]], most[n] + rounding)


@inner_with_arrays
def _cut(parts, mask, places, shift):  # type: ignore[no-untyped-def]
    """Some parts, each in so many as there are places, by the same polynomial."""
    count = 0
    for n in range(mask.size):
        count += mask[n]
    children = _none(places.size * count)
    _divided(parts, mask, places, shift, children)
    return children


@inner
def _divided(parts, mask, places, shift, children):  # type: ignore[no-untyped-def]
    """Write the pieces of the parts in a mask."""
    share, k = places.size, 0
    for n in range(mask.size):
        if mask[n]:
            place = parts.place[n]
            for p in range(share):
                children.member[k], children.piece[k] = parts.member[n], parts.piece[n]
                centre, half = place[_CENTRE] + place[_HALF] * places[p], place[_HALF] / share
                _place(children, k, centre, half, place[_REST], place[_FOURTH])
                for i in range(4):
                    value = 0j
                    for j in range(i, 4):
                        value += parts.cubic[n, j] * shift[p, j, i]
                    children.cubic[k, i] = value
                k += 1


@inner_with_arrays
def narrowed(parts, members, best, cuts):  # type: ignore[no-untyped-def]
    """Cut what may hold peaks until none is left or some would have to be expanded anew: (cut, to be expanded, cuts).

    Most of the latter are let go without an expansion, which costs far more.
    """
    while parts.member.size > 0 and cuts < MOST_CUTS:
        coarse, any_coarse = np.empty(parts.member.size, np.bool_), False
        for n in range(coarse.size):
            group = members.group[parts.member[n]]
            coarse[n] = parts.place[n, _REST] > ENOUGH * _allowed(members, best, group)
            any_coarse = any_coarse or coarse[n]
        fine = _cut(parts, ~coarse, _FINE_PLACES, _TO_FINE)
        cuts += 1
        if any_coarse:
            coarser = _cut(parts, coarse, _FINER_PLACES, _TO_FINER)
            return fine, still_open(coarser, members, best, coarser.member.size), cuts
        parts = still_open(fine, members, best, MOST_PARTS if cuts < MOST_CUTS else 0)
    return parts, _none(0), cuts
