"""Programs as compiled loops take them, and what those loops are asked.

An answer asks for a handful of numbers many times: a loop of simple operations takes a tenth of the time of arrays.
"""

import math
from dataclasses import dataclass
from itertools import dropwhile
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from optimizer.numerics.arrays import Complex, Real, in_order, spread
from optimizer.numerics.records import record

if TYPE_CHECKING:
    from optimizer.program.limits import Limits
    from optimizer.program.statement import Statement


class Region(NamedTuple):
    """The limits of N programs in the usual order in memory."""

    radius: Real  # (N, K)
    max_mass: Real  # (N, K)
    budget: Real  # (N,)
    free: np.ndarray  # (N, K) bool
    centre: Complex  # (N, K)
    cosine: Real  # (N, K)
    sine: Real  # (N, K)
    turn: Complex  # (N, K) of webs that are alike; (N, 0) where none are, and so on
    leader: np.ndarray  # (K,) first web of the unit of each web
    mirrored: np.ndarray  # (K,) bool
    members: Real  # (K,) webs of that unit


class Programs(NamedTuple):
    """N programs in the usual order in memory. Their work is written to by whoever holds the interpreter."""

    owner: np.ndarray  # (J,) row of a term
    group: np.ndarray  # (R,)
    scalar: np.ndarray  # (J + I,) bool
    scatter: Real  # (2,) of the terms, and of what is under ceilings
    constant: Complex  # (N, J + I) of the terms, then of what is under ceilings
    influence: Real  # (N, J + I, K) real parts
    across: Real  # (N, J + I, K) imaginary parts; (N, J + I, 0) where all are real, and so is the next
    magnitude: Real  # (N, J + I, K)
    floor: Real  # (N, R)
    cap: Real  # (N, I)
    counted: Real  # (N, I) cap up to which a ceiling counts as kept
    size: Real  # (N, I)
    region: Region
    numbers: Real  # (6, ...) work, as are the next
    vectors: Complex  # (4, ...)
    places: np.ndarray  # (2, K)


class Minorants(NamedTuple):
    """Affine functions that are nowhere above an objective, Re(conj(slope_k) u_k) of the unbalances."""

    constant: Real  # (...) less its rounding, -inf where nothing is proven
    slope: Complex  # (..., K)
    rounding: Real  # (..., K) what the slopes may be off by
    spread: Real  # (..., K) what a kilogram metre raises them by because counterweights scatter, no more than it is
    support: Real  # (..., K) what a kilogram metre can lower them by within the sectors, or more


@record
@dataclass(frozen=True)
class Flat:
    """Programs of some leading axes, of which loops make one."""

    leading: tuple[int, ...]
    programs: Programs

    def values(self, u: Complex) -> Real:
        """What points (..., *leading, K) come to (4, ..., *leading).

        Objective, mass, largest relative excess over a ceiling (-inf without ceilings), rounding of the objective.
        """
        # the compiler is loaded when it is first needed
        from optimizer.program.kernel.values import values

        leading = self._of(u.shape[:-1])
        many = math.prod(leading)
        found = np.empty((4, many))
        values(*_rows(leading, u), self.programs, found)
        return found.reshape(4, *leading)

    def bounds(self, term: Complex, row: Real, ceiling: Complex, target: Real | None = None) -> Real:
        """Lower bounds (..., *leading) on the objective, or on the mass.

        Parameters
        ----------
        term, row, ceiling : the multipliers that prove them.
        target : (...) largest objective that counts, for a bound on the mass.
        """
        from optimizer.program.kernel.bounds import bounds

        programs = self.programs
        leading = self._of(np.broadcast_shapes(row.shape[:-1], () if target is None else target.shape))
        found = np.empty(math.prod(leading))
        most = programs.region.budget if target is None else in_order(spread(target, leading)).reshape(-1)
        cap = programs.cap if target is None else programs.counted
        bounds(0.0 if target is None else 1.0, most, *_rows(leading, term, row, ceiling), programs, cap, found)
        return found.reshape(leading)

    def minorants(self, term: Complex, row: Real, ceiling: Complex, counted: bool, normal: bool) -> Minorants:
        """What multipliers prove for all counterweights (..., *leading).

        Parameters
        ----------
        counted : for all that counts as keeping the ceilings.
        normal : with rows that sum to 1, of the objective itself.
        """
        from optimizer.program.kernel.bounds import minorants

        programs, leading = self.programs, self._of(row.shape[:-1])
        many, webs = math.prod(leading), programs.influence.shape[-1]
        constant, slope, of_webs = np.empty(many), np.empty((many, webs), complex), np.empty((3, many, webs))
        cap = programs.counted if counted else programs.cap
        minorants(normal, *_rows(leading, term, row, ceiling), programs, cap, constant, slope, of_webs)
        return Minorants(constant.reshape(leading), slope.reshape(*leading, webs), *of_webs.reshape(3, *leading, webs))

    def into(self, u: Complex) -> Complex:
        """Unbalances (..., *leading, K) within all limits, close to those that are nearly so."""
        return _into(u, self._of(u.shape[:-1]), self.programs.region)

    def settle(self, u: Complex, points: Real, target: Real, heaviest: Real, rounding: float, rungs: Real) -> None:
        """Points (*leading, K) without dust and at the limits that they touch, and what they come to, in place.

        As :func:`optimizer.program.kernel.settling.settle`.
        """
        from optimizer.program.kernel.settling import settle

        many, terms, webs = self.programs.influence.shape
        settle(
            u.reshape(many, webs),
            points.reshape(4, many),
            in_order(target).reshape(many),
            in_order(heaviest).reshape(many),
            rounding,
            rungs,
            self.programs,
            *_work(self.programs.region, terms, webs),
        )

    def _of(self, axes: tuple[int, ...]) -> tuple[int, ...]:
        """Leading axes of what has these, which are those of the programs and others before them."""
        if axes == self.leading:
            return axes
        leading, own = np.broadcast_shapes(axes, self.leading), tuple(dropwhile(lambda n: n == 1, self.leading))
        if leading[len(leading) - len(own) :] != own:
            raise ValueError(f"programs of axes {self.leading} are not those of {axes}")
        return leading


def flat(statement: "Statement") -> Flat:
    """Programs as loops take them."""
    norms, ceilings, limits = statement.norms, statement.ceilings, statement.limits
    constant, influence = statement.every_constant, statement.every_influence
    leading = statement.floor.shape[:-1]
    others = constant.shape[:-1], influence.shape[:-2], limits.radius.shape[:-1]
    if any(other != leading for other in others):
        leading = np.broadcast_shapes(leading, *others)
    many, (terms, webs), rows = math.prod(leading), influence.shape[-2:], statement.floor.shape[-1]
    across, large = np.empty((many, terms, 0)), np.empty((many, terms, 0))
    if influence.dtype != float:
        across = _of_programs(np.imag(influence), leading, 2)
        large = _of_programs(np.abs(influence), leading, 2)
        influence = np.real(influence)
    if any(norms.scalar) or any(ceilings.norms.scalar):
        every = [each.scalar or (False,) * each.constant.shape[-1] for each in (norms, ceilings.norms)]
        scalar = np.array([*every[0], *every[1]])
    else:
        scalar = np.zeros(terms, bool)
    counted = ceilings.counted if ceilings.names else ceilings.cap
    return Flat(
        leading,
        Programs(
            owner=in_order(statement.row),
            group=in_order(statement.group),
            scalar=scalar,
            scatter=np.array([norms.scatter, ceilings.norms.scatter]),
            constant=_of_programs(constant, leading, 1),
            influence=_of_programs(influence, leading, 2),
            across=across,
            magnitude=large,
            floor=_of_programs(statement.floor, leading, 1),
            cap=_of_programs(ceilings.cap, leading, 1),
            counted=_of_programs(counted, leading, 1),
            size=_of_programs(ceilings.size, leading, 1),
            region=region(limits, leading),
            numbers=np.empty((6, max(terms, webs, rows))),
            vectors=np.empty((4, max(terms, webs)), complex),
            places=np.empty((2, webs), np.int64),
        ),
    )


def region(limits: "Limits", leading: tuple[int, ...]) -> Region:
    """Limits of programs of these axes as loops take them."""
    alike, many = limits.alike, math.prod(leading)
    turn, leader = np.empty((many, 0), complex), np.empty(0, np.int64)
    mirrored, members = np.empty(0, bool), np.empty(0)
    if alike is not None:
        turn, leader = _of_programs(alike.turn, leading, 1), np.array(alike.leader, np.int64)
        mirrored, members = np.array(alike.mirrored, bool), alike.count[alike.owner].astype(float)
    return Region(
        radius=_of_programs(limits.radius, leading, 1),
        max_mass=_of_programs(limits.max_mass, leading, 1),
        budget=_of_programs(limits.max_total_mass, leading, 0),
        free=_of_programs(limits.free, leading, 1),
        centre=_of_programs(limits.centre, leading, 1),
        cosine=_of_programs(limits.half_angle_cos, leading, 1),
        sine=_of_programs(limits.half_angle_sin, leading, 1),
        turn=turn,
        leader=leader,
        mirrored=mirrored,
        members=members,
    )


def into(limits: "Limits", u: Complex) -> Complex:
    """Unbalances (..., K) within all limits, close to those that are nearly so."""
    axes = limits.radius.shape[:-1]
    leading = np.broadcast_shapes(axes, u.shape[:-1])
    # limits that are the same for some of the points are told once for each
    own = axes if leading[len(leading) - len(axes) :] == axes else leading
    return _into(u, leading, region(limits, own))


def _into(u: Complex, leading: tuple[int, ...], own: Region) -> Complex:
    from optimizer.program.kernel.regions import bring

    webs = u.shape[-1]
    found = np.array(spread(u, (*leading, webs)), complex, order="C")
    bring(found.reshape(math.prod(leading), webs), own, np.empty(webs, complex))
    return found


def near_limits(
    limits: "Limits", influence: Real | Complex, u: Complex, dust: float, touched: float
) -> tuple[Complex, np.ndarray]:
    """Points (N, K) with what is near enough to nothing, or to a limit, there, and whether anything was (N,) bool.

    What is between the limits makes up for it.

    Parameters
    ----------
    influence : (N, J, K) on what is to stay as it is.
    dust, touched : shares of the largest mass that is next to nothing, and of a limit that is next to it.
    """
    new = np.empty(u.shape, complex)
    moved = _rebalance(limits, influence, u, np.array([dust, touched]), np.empty(u.shape), new)
    return new, moved


def balanced(limits: "Limits", influence: Real | Complex, u: Complex, put: Complex, room: Real) -> Complex:
    """What is put (N, K) in place of points, with others that make up for it, within all limits.

    Parameters
    ----------
    influence : (N, J, K) on what is to stay as it is.
    room : (N, K) relative to which the change of the others is the least; of alike webs they change alike.
    """
    new = np.array(put, complex, order="C")
    _rebalance(limits, influence, u, np.array([-1.0, 0.0]), in_order(room), new)
    return new


def _rebalance(
    limits: "Limits", influence: Real | Complex, u: Complex, near: Real, room: Real, new: Complex
) -> np.ndarray:
    """As :func:`optimizer.program.kernel.settling.rebalance`: which points are others (N,) bool."""
    from optimizer.program.kernel.settling import rebalance

    many, terms, webs = influence.shape
    own, moved = region(limits, (many,)), np.empty(many, bool)
    rebalance(in_order(u), near, *_parts(influence, (many,)), own, room, *_work(own, terms, webs), new, moved)
    return moved


def _parts(influence: Real | Complex, leading: tuple[int, ...]) -> tuple[Real, Real]:
    """Real and imaginary parts (N, J, K), the latter (N, J, 0) where all are real."""
    many, terms = math.prod(leading), influence.shape[-2]
    across = np.empty((many, terms, 0)) if influence.dtype == float else _of_programs(influence.imag, leading, 2)
    return _of_programs(influence.real, leading, 2), across


def _work(own: Region, terms: int, webs: int) -> tuple[Complex, Complex]:
    """What is written to where others make up for something."""
    if own.leader.size:
        terms, webs = 2 * terms, 2 * webs
    return np.empty((5, max(terms, webs)), complex), np.empty((2, terms, webs), complex)


def _rows(leading: tuple[int, ...], *parts: np.ndarray) -> tuple[np.ndarray, ...]:
    """Arrays (..., n) as (M, n), of what has these leading axes."""
    many = math.prod(leading)
    return tuple(in_order(spread(each, (*leading, each.shape[-1]))).reshape(many, each.shape[-1]) for each in parts)


def _of_programs(array: np.ndarray, leading: tuple[int, ...], own: int) -> np.ndarray:
    """An array of these leading axes, or of none, with one axis in their place and its own ones."""
    last = array.shape[array.ndim - own :]
    return in_order(spread(array, (*leading, *last))).reshape(math.prod(leading), *last)
