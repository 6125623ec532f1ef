"""Curves over a period, piece by piece a cubic with a bound on what it leaves out, and their exact peaks.

Between the angles at which it jumps or has a kink a curve d is smooth. On a piece of half width h about its centre the
Taylor polynomial of degree 3 leaves out at most h^4/24 max|d''''|, the ``rest``. So the peak of |d + offset| over a
piece is at most sqrt(max |cubic + offset|^2) + rest, and a polynomial is nowhere above the largest of its Bernstein
coefficients, which close in on it fourfold with every halving. Pieces that cannot hold the peak are let go; those whose
rest is too coarse are expanded anew about more centres. So a peak is bracketed as narrowly as wished, also where
|d + offset| hardly changes over the turn, as it does at an optimum.

Shapes: J curves of P pieces each. A vector across the shaft is complex, x + jy; a scalar is real.
Source: R. T. Farouki, The Bernstein polynomial basis: a centennial retrospective, CAGD 29 (2012).
"""

from functools import cache
from types import ModuleType
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from optimizer.numerics.arrays import Complex, Real, Reals, all_true, in_order
from optimizer.numerics.memoization import cached_property
from optimizer.numerics.records import record
from optimizer.responses.floors import Floors

if TYPE_CHECKING:
    from optimizer.responses.kernel.motion import Motion
    from optimizer.responses.kernel.parts import Best, Cubics, Members

Index = NDArray[np.intp]
#: real for scalars, complex across the shaft
Vector = NDArray[Any]

#: no bracket is narrower than this share of what is added up in it
ROUNDING = 32 * np.finfo(float).eps
#: share of what is added up, below which a peak that is shown may be left as open as one of this share: where all but
#: rounding cancels, a bracket to a share of that takes ten times the parts
NEARLY_NOTHING = 1e-3
#: rad, by which an angle may be rounded within two turns
ANGLE_ROUNDING = 64 * np.finfo(float).eps


class Bracket(NamedTuple):
    """Peaks (...) and what is proven of them."""

    angle: Real  # rad, where ``lower`` is attained
    value: Complex  # of the curve there, without the offset; beside a jump the one-sided limit
    lower: Real
    upper: Real  # nothing over the whole period is above it

    def where(self, mask: NDArray[np.bool_]) -> "Bracket":
        """The same, nan outside a mask (...)."""
        return self if all_true(mask) else Bracket(*(np.where(mask, part, np.nan) for part in self))


class Source(Protocol):
    """What the pieces of curves are made from."""

    def cubics(self, curve: Index, piece: Index, centre: Real, half: Real) -> Complex:
        """Taylor polynomials (m, 4) about other centres (m,) rad within pieces."""

    def values(self, curve: Index, piece: Index, angle: Real) -> Complex:
        """Values (m,) at angles (m,) rad within pieces; at their ends the one-sided limits."""

    def search(self, cubics: "Cubics", members: "Members", best: "Best", motion: "Motion | None" = None) -> Complex:
        """Peaks of the curves, or of one of them in motion, from their pieces: the curves (peaks,) there, at rest.

        Parameters
        ----------
        best : so far, which it improves.
        """

    def circles(self, cubics: "Cubics", members: "Members", motion: "Motion | None" = None) -> Floors:
        """The smallest circles around the curves, or around one of them in motion, from their pieces.

        Parameters
        ----------
        members : which curves, and of each group of them only the largest circle counts; what of a radius may be left
            open (1,), and as rounding the size of what is added up in each.
        """


@record(frozen=True)
class Pieces:
    """J curves over one period.

    centre, half : (J, P) rad; half is 0 where two breaks coincide.
    cubic : (J, P, 4) coefficients of ((angle - centre) / half)^k; real for scalars.
    rest : (J, P) bounds on what they leave out, half^4/24 times the largest fourth derivative.
    size : (J,) of the terms that are added up in a curve: no bracket is narrower than their rounding.
    source : of finer ones.
    """

    centre: Real
    half: Real
    cubic: Complex
    rest: Real
    size: Real
    source: Source

    @cached_property
    def reach(self) -> Real:
        """How far the curves may be from the middle of their pieces, (J, P)."""
        return np.add.reduce(np.abs(self.cubic[..., 1:]), axis=-1) + self.rest

    def part(self, own: slice, source: Source) -> "Pieces":
        """Those of some of the curves, from a source of these alone."""
        return Pieces(self.centre[own], self.half[own], self.cubic[own], self.rest[own], self.size[own], source)

    @cached_property
    def cubics(self) -> "Cubics":
        """What is compiled takes them as."""
        centre, half, rest = (in_order(np.asarray(array, float)) for array in (self.centre, self.half, self.rest))
        cubics: Cubics = _parts().Cubics(centre, half, in_order(np.asarray(self.cubic, complex)), rest)
        return cubics

    def peaks(
        self,
        offset: Vector,
        tolerance: Reals,
        curve: Index | None = None,
        group: Index | None = None,
        sign: Reals = 0.0,
        least: float = 0.0,
    ) -> Bracket:
        """Peaks (m,) of |d + offset| over the period, each as if it were searched alone.

        Parameters
        ----------
        offset : (m,) in the unit of the curves; where it is nan there is no peak.
        tolerance : (m,) or one for all, of upper - lower, relative to lower; rounding sets a limit to it.
        curve : (m,) the curve of each peak, by default all in turn.
        group : (m,) from 0, to search only the largest of each group, which costs less: peaks (groups,).
        sign : (m,) or one for all, the same in a group: 0 for magnitudes; of scalars 1 for the largest value of
            d + offset, -1 for the smallest, negated.
        least : share of what is added up to which the tolerance is relative where a peak is smaller.
        """
        every = np.arange(offset.size)
        of_member, finite = every if curve is None else curve, np.isfinite(offset)
        magnitudes = not isinstance(sign, np.ndarray) and sign == 0.0
        if group is None and all_true(finite):
            scale = np.abs(offset)
            scale += self.size if curve is None else self.size[curve]
            share = np.empty(every.size)
            share[:] = tolerance
            signs = None if magnitudes else np.full(every.size, sign, float)
            return _brackets(self, offset, of_member, every, scale, share, signs, least)
        owner = every if group is None else group
        count = int(np.maximum.reduce(owner, initial=-1)) + 1
        scale, share, signs = np.zeros(count), np.zeros(count), None if magnitudes else np.zeros(count)
        if not all_true(finite):
            offset, of_member, owner = offset[finite], of_member[finite], owner[finite]
            tolerance, sign = (part[finite] if isinstance(part, np.ndarray) else part for part in (tolerance, sign))
        np.maximum.at(scale, owner, self.size[of_member] + np.abs(offset))
        if isinstance(tolerance, np.ndarray):
            np.maximum.at(share, owner, tolerance)
        else:
            share[owner] = tolerance
        if signs is not None:
            signs[owner] = sign
        mask = np.zeros(scale.size, dtype=bool)
        mask[owner] = True
        return _brackets(self, offset, of_member, owner, scale, share, signs, least).where(mask)


# it loads the compiler, and so at the first call; an import at each takes as long as a small array
@cache
def _parts() -> ModuleType:
    from optimizer.responses.kernel import parts

    return parts


def _brackets(
    pieces: Pieces,
    offset: Vector,
    of_member: Index,
    group: Index,
    scale: Real,
    share: Real,
    sign: Real | None,
    least: float,
) -> Bracket:
    """Brackets (count,), of no meaning where a peak has no member.

    Parts below the best value, or above it by less than the tolerance, are let go; the rest is looked at closer.

    Parameters
    ----------
    offset, of_member, group : (m,) of every member, its curve, and the peak to which it belongs.
    scale, share, sign : (count,) size of what is added up, tolerance and sign of each peak; None of magnitudes alone.
    least : share of the size to which tolerances are relative at least.
    """
    count, parts = scale.size, _parts()
    if not group.size:
        return Bracket(*(np.full(count, np.nan) for _ in range(4)))
    curve, peak = (in_order(np.asarray(part, np.int64)) for part in (of_member, group))
    open_, signs = np.maximum(share * least, ROUNDING) * scale, np.zeros(count) if sign is None else sign
    members = parts.Members(curve, peak, in_order(np.asarray(offset, complex)), share, open_, signs)
    lower, upper = np.empty(count), np.empty(count)
    lower.fill(np.nan)
    upper.fill(-np.inf)
    best = parts.Best(lower, upper, np.zeros(count), np.zeros(count, np.int64), np.zeros(count, np.int64))
    value = pieces.source.search(pieces.cubics, members, best)
    there = value + members.offset[best.member]
    lower = np.abs(there) if sign is None else np.where(sign == 0.0, np.abs(there), sign * there.real)
    return Bracket(best.angle, value, lower, best.upper + ROUNDING * scale)
