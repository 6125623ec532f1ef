"""Programs as compiled loops take them, and the loops' inputs and results.

An answer asks for a handful of numbers many times: a loop of simple operations takes a tenth of the time of arrays.
"""

import math
from functools import cache, lru_cache
from itertools import dropwhile
from types import ModuleType
from typing import NamedTuple

import numpy as np

from optimizer.numerics.arrays import Complex, Real, in_order, of_programs_of, single_axis, spread
from optimizer.numerics.records import record
from optimizer.program.kernel.programs import Programs, Region
from optimizer.program.limits import Limits

#: a limit this many times the unbalance that cancels everything is as far away as none
FAR = 1e3


class Minorants(NamedTuple):
    """Affine functions that are nowhere above an objective, Re(conj(slope_k) u_k) of the unbalances."""

    constant: Real  # (...) less its rounding, -inf where nothing is proven
    slope: Complex  # (..., K)
    rounding: Real  # (..., K) what the slopes may be off by
    spread: Real  # (..., K) what a kilogram metre raises them by because counterweights scatter, no more than it is
    support: Real  # (..., K) what a kilogram metre can lower them by within the sectors, or more


#: prices in proofs: of terms (..., J), of rows (..., R), of ceilings (..., I)
Dual = tuple[Complex, Real, Complex]


class Reaches(NamedTuple):
    """How large unbalances are that single vectors call for, beside the limits of the webs."""

    single: Real  # (...) kg m, the largest that one vector calls for by itself
    beyond: bool  # some web of some program has no limit, or one that is far beyond that
    idle: bool  # some web of some program can carry nothing


class Shares(NamedTuple):
    """By what points and proofs are judged; the first is of what optima may differ by, others of what they are."""

    target: float  # how far optima reach into what they may differ by
    enough: float  # largest gap of the first stage that is good enough, of what optima may differ by
    mass_enough: float  # relative gap of the mass that is
    heavier: float  # relative gap of the mass that may be left by what is settled
    rounding: float  # excess over a ceiling that rounding alone may make
    tolerance: float  # excess up to which it counts as kept


class Judgement(NamedTuple):
    """Of two points of each of N programs the ones to take, with their proofs."""

    smallest: Complex  # (N, K) kg m, the smallest objective
    unbalance: Complex  # (N, K) kg m, the lightest that is an optimum, settled
    figures: Real  # (4, N) what that comes to, as of :meth:`Flat.values`
    proof: Dual  # of the objective
    lower_bound: Real  # (N,)
    mass_lower_bound: Real  # (N,) kg
    mass_target: Real  # (N,) largest objective that this bound counts as an optimum
    certified: np.ndarray  # (N,) bool
    clean: np.ndarray  # (N,) bool: no counterweight is next to nothing beside the largest


@record(frozen=True)
class Flat:
    """Programs of some leading axes, of which loops make one."""

    leading: tuple[int, ...]
    programs: Programs

    def values(self, u: Complex) -> Real:
        """What points (..., *leading, K) come to (4, ..., *leading).

        Objective, mass, largest relative excess over a ceiling (-inf without ceilings), rounding of the objective.
        """
        leading = self._of(u.shape[:-1])
        many = math.prod(leading)
        result = np.empty((4, many))
        _values().values(*_rows(leading, u), result, *self.programs.arrays)
        return result.reshape(4, *leading)

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
        result = np.empty(math.prod(leading))
        most = programs.region.budget if target is None else in_order(spread(target, leading)).reshape(-1)
        cap = programs.cap if target is None else programs.tolerant_cap
        bounds(0.0 if target is None else 1.0, most, *_rows(leading, term, row, ceiling), programs, cap, result)
        return result.reshape(leading)

    def minorants(self, term: Complex, row: Real, ceiling: Complex, with_tolerance: bool, normal: bool) -> Minorants:
        """What multipliers prove for all counterweights (..., *leading).

        Parameters
        ----------
        with_tolerance : for all that counts as keeping the ceilings.
        normal : with rows that sum to 1, of the objective itself.
        """
        from optimizer.program.kernel.bounds import minorants

        programs, leading = self.programs, self._of(row.shape[:-1])
        many, webs = math.prod(leading), programs.influence.shape[-1]
        constant, slope, of_webs = np.empty(many), np.empty((many, webs), complex), np.empty((3, many, webs))
        cap = programs.tolerant_cap if with_tolerance else programs.cap
        minorants(normal, *_rows(leading, term, row, ceiling), programs, cap, constant, slope, of_webs)
        return Minorants(constant.reshape(leading), slope.reshape(*leading, webs), *of_webs.reshape(3, *leading, webs))

    def printed(self, priced: np.ndarray, factor: Real, inside: float, dual: Dual) -> None:
        """Multipliers (..., *leading, n) as they are printed, in place: :func:`optimizer.program.kernel.units.printed`.

        Parameters
        ----------
        priced, factor : (..., *leading).
        """
        programs, many = self.programs, factor.size
        _units().printed(
            priced.reshape(many),
            factor.reshape(many),
            inside,
            programs.owner,
            programs.group,
            programs.floor,
            programs.scalar,
            programs.numbers[0],
            *(part.reshape(many, part.shape[-1]) for part in dual),
        )

    def least_masses(self, objective: Real) -> Real:
        """Least masses (*leading) kg that could cancel something, 0 where none does anything.

        Parameters
        ----------
        objective : (*leading, 1) size of the objective, or (*leading, rows) of its rows.
        """
        programs, region, least = self.programs, self.programs.region, np.empty(math.prod(self.leading))
        limits, size = (region.radius, region.max_mass, region.budget), single_axis(self.leading, objective, 1)
        rows = programs.floor.shape[1]
        _units().least_masses(programs.owner, rows, self._magnitude, *limits, size, programs.size, least)
        return least.reshape(self.leading)

    def single_reaches(self, sizes: Real) -> Reaches:
        """What vectors of some sizes (*leading, J + I) call for one by one."""
        region, reach = self.programs.region, np.empty(math.prod(self.leading))
        limits = region.radius, region.max_mass, region.budget
        flags = _units().single_reaches(single_axis(self.leading, sizes, 1), self._magnitude, *limits, FAR, reach)
        return Reaches(reach.reshape(self.leading), *flags)

    @property
    def _magnitude(self) -> Real:
        """Magnitudes of the influences (N, J + I, K), or real numbers of these."""
        return self.programs.magnitude if self.programs.across.size else self.programs.influence

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
            *settling_work(self.programs.region, terms, webs),
        )

    def judge(
        self,
        share: Real,
        demand: Real,
        sizes: Real,
        shares: Shares,
        ends: tuple[Complex, Complex],
        solver: Dual,
        mass_solver: Dual | None,
        rungs: Real,
    ) -> Judgement:
        """The points to take of N programs (one leading axis), as :func:`optimizer.program.kernel.judging.judge`.

        Parameters
        ----------
        sizes : (N, J + I) of the constants, to the last digit as of
            :func:`optimizer.program.multipliers.resting_multipliers`.
        ends : (N, K) where both stages ended.
        solver, mass_solver : what the interior point proves the objective and the mass by; None where that is free.
        """
        many, terms, webs = self.programs.influence.shape
        smallest, lightest = np.array(ends[0], order="C"), in_order(ends[1])
        points, figures, bounds = np.empty((many, webs), complex), np.empty((4, many)), np.empty((3, many))
        certified, clean, own = np.empty(many, bool), np.empty(many, bool), _in_order(solver)
        proof = np.empty_like(own[0]), np.empty_like(own[1]), np.empty_like(own[2])
        _judging().judge(
            in_order(share),
            in_order(demand),
            mass_solver is not None,
            *shares,
            smallest,
            lightest,
            *own,
            *(own if mass_solver is None else _in_order(mass_solver)),
            in_order(sizes),
            rungs,
            *settling_work(self.programs.region, terms, webs),
            points,
            figures,
            *proof,
            bounds,
            certified,
            clean,
            *self.programs.arrays,
        )
        return Judgement(smallest, points, figures, proof, bounds[0], bounds[1], bounds[2], certified, clean)

    def _of(self, axes: tuple[int, ...]) -> tuple[int, ...]:
        """Leading axes of what has these, which are those of the programs and others before them."""
        if axes[len(axes) - len(self.leading) :] == self.leading:
            return axes
        leading, own = np.broadcast_shapes(axes, self.leading), tuple(dropwhile(lambda n: n == 1, self.leading))
        if leading[len(leading) - len(own) :] != own:
            raise ValueError(f"programs of axes {self.leading} are not those of {axes}")
        return leading


def flat(
    place: tuple[np.ndarray, np.ndarray],
    scalar: np.ndarray,
    scatter: tuple[float, float],
    constant: Complex,
    influence: Real | Complex,
    floor: Real,
    ceilings: tuple[Real, Real, Real],
    limits: Limits,
) -> Flat:
    """Programs as loops take them.

    Parameters
    ----------
    place : (J,) row of a term, (rows,) group of a row.
    scalar : (J + I,) bool, of terms and of what is under ceilings, as are the next.
    scatter : of the terms, and of what is under ceilings.
    constant, influence : (..., J + I) and (..., J + I, K).
    floor : (..., rows).
    ceilings : (..., I) caps, caps up to which they count as kept, and sizes.
    """
    leading = floor.shape[:-1]
    leadings = constant.shape[:-1], influence.shape[:-2], limits.radius.shape[:-1]
    if leadings != (leading, leading, leading):
        leading = np.broadcast_shapes(leading, *leadings)
    (terms, webs), rows = influence.shape[-2:], floor.shape[-1]
    of_programs, none = of_programs_of(leading), np.empty((math.prod(leading), terms, 0))
    plain, (numbers, vectors, places) = influence.dtype == float, _work(terms, webs, rows)
    cap = of_programs(ceilings[0], 1)
    return Flat(
        leading,
        Programs(
            owner=in_order(place[0]),
            group=in_order(place[1]),
            scalar=scalar,
            scatter=np.array(scatter),
            constant=of_programs(constant, 1),
            influence=of_programs(influence if plain else influence.real, 2),
            across=none if plain else of_programs(influence.imag, 2),
            magnitude=none if plain else of_programs(np.abs(influence), 2),
            floor=of_programs(floor, 1),
            cap=cap,
            tolerant_cap=of_programs(ceilings[1], 1) if cap.size else cap,
            size=of_programs(ceilings[2], 1) if cap.size else cap,
            region=limits.region(leading),
            numbers=numbers,
            vectors=vectors,
            places=places,
        ),
    )


# kernels write to it and leave nothing there, so that programs of one shape may share it
@lru_cache(maxsize=64)
def _work(terms: int, webs: int, rows: int) -> tuple[Real, Complex, np.ndarray]:
    """Work of programs, the last three of :class:`Programs`."""
    numbers, vectors = np.empty((6, max(terms, webs, rows))), np.empty((4, max(terms, webs)), complex)
    return numbers, vectors, np.empty((2, webs), np.int64)


def settling_work(own: Region, terms: int, webs: int) -> tuple[Complex, Complex, Real]:
    """What :mod:`optimizer.program.kernel.settling` writes to where others make up for something."""
    return _settling_work(2 * terms, 2 * webs) if own.leader.size else _settling_work(terms, webs)


@lru_cache(maxsize=64)
def _settling_work(terms: int, webs: int) -> tuple[Complex, Complex, Real]:
    shape = terms, webs
    return np.empty((5, max(shape)), complex), np.empty((2, *shape), complex), np.empty((3, *shape))


def _in_order(dual: Dual) -> Dual:
    return in_order(dual[0]), in_order(dual[1]), in_order(dual[2])


def _rows(leading: tuple[int, ...], *parts: np.ndarray) -> tuple[np.ndarray, ...]:
    """Arrays (..., n) as (M, n), of what has these leading axes."""
    many = math.prod(leading)
    return tuple(in_order(spread(part, (*leading, part.shape[-1]))).reshape(many, part.shape[-1]) for part in parts)


# loads the compiler, a tenth of a second, and so at the first call; an import at each takes as long as a short loop
@cache
def _values() -> ModuleType:
    from optimizer.program.kernel import values

    return values


@cache
def _units() -> ModuleType:
    from optimizer.program.kernel import units

    return units


@cache
def _judging() -> ModuleType:
    from optimizer.program.kernel import judging

    return judging
