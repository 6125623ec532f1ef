"""Both stages of the interior point: programs in units of their own, then points and multipliers in SI units."""

from collections.abc import Callable
from functools import cache
from types import ModuleType
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optimizer.numerics.arrays import Complex, Real, in_order, mapped, parts, plain
from optimizer.numerics.records import record
from optimizer.program.certificate import Multipliers, nothing_proven
from optimizer.program.compiled_evaluation import Dual
from optimizer.program.kernel.finer_numbers import Precision, solve_in
from optimizer.program.points import points_at
from optimizer.program.scaling import cancelling
from optimizer.program.solution import CEILING_ROUNDING
from optimizer.program.statement import Statement

if TYPE_CHECKING:
    from optimizer.program.kernel.interior_point import Programs

#: both stages, as :func:`optimizer.program.kernel.interior_point.solve`, of programs in units of their own
Method = Callable[..., tuple[Any, ...]]


class Tolerances(NamedTuple):
    """Gaps at which the stages end."""

    sharpness: float  # first stage, as a share of what optima may differ by, between finest and coarsest
    finest: float
    coarsest: float
    mass: float  # second stage, relative to the mass
    ceilings: float  # share of their size by which ceilings are lowered, so that the answer keeps them


@record(frozen=True)
class StageEnds:
    """Where the stages of N programs ended."""

    smallest: Complex  # (N, K) kg m, the end of the first stage
    lightest: Complex  # (N, K) kg m, the end of the second one
    proof: Multipliers  # (N, ...), of the objective
    mass_proof: Multipliers  # (N, ...), of the mass

    def subset(self, programs: np.ndarray) -> "StageEnds":
        """Some of the programs, by number or mask."""
        return mapped(self, lambda array: array[programs])

    def put(self, programs: np.ndarray, rivals: "StageEnds") -> None:
        """Others in place of some."""
        self.smallest[programs], self.lightest[programs] = rivals.smallest, rivals.lightest
        self.proof.put(programs, rivals.proof)
        self.mass_proof.put(programs, rivals.mass_proof)

    def pulled(self, statement: Statement, inside: Complex) -> "StageEnds":
        """Both points moved towards ones inside the ceilings, as :func:`pulled` moves them."""
        points = pulled(statement, self.smallest, inside), pulled(statement, self.lightest, inside)
        return StageEnds(*points, self.proof, self.mass_proof)


def solve_stages(
    statement: Statement,
    share: Real,
    least_mass: bool,
    tolerances: Tolerances,
    method: Method | None = None,
    at_least: Real | float = 0.0,
) -> StageEnds:
    """Both stages of N statements of one shape, without a verdict.

    Parameters
    ----------
    share : (N,) how far above the smallest objective an optimum may be, in units of the objective.
    method : that solves them; by default the interior point for any limits.
    at_least : (N,) lower bound of the objective under the ceilings.
    """
    if statement.limits.radius.shape[-1] == 0:
        # nothing to choose
        nothing, proof = np.zeros(statement.limits.radius.shape, complex), nothing_proven(statement)
        return StageEnds(nothing, nothing, proof, proof)
    reach, unit, demands = _scales(statement, share, tolerances, at_least)
    result = (method or _by_interior_point)(
        statement, reach, unit, tolerances.ceilings, least_mass, demands[0], demands[1], tolerances.mass
    )
    points, (term, row, ceiling) = _physical(statement, (reach, unit), *result)
    proofs = Multipliers(term[0], row[0], ceiling[0]), Multipliers(term[1], row[1], ceiling[1])
    return StageEnds(points[0], points[1], *proofs)


def _physical(
    statement: Statement, scales: tuple[Real, Real], v: Complex, cone: Real, row: Real, mass_unit: Real
) -> tuple[Complex, Dual]:
    """Points (2, N, K) kg m within all limits, and multipliers (2, N, ...), where both stages ended.

    Parameters
    ----------
    scales : of :func:`_scales`.
    v, cone, row, mass_unit : as a method finds them.
    """
    programs, points, stages = statement.flat.programs, np.empty(v.shape, complex), v.shape[:2]
    terms, ceilings = programs.owner.size, programs.size.shape[1]
    proof = np.empty((*stages, terms), complex), np.empty(row.shape), np.empty((*stages, ceilings), complex)
    arrays = in_order(v), in_order(cone), in_order(row), in_order(mass_unit)
    _units().physical(*arrays, *scales, programs.size, programs.vectors[0], points, *proof, *programs.region)
    return points, proof


def _scales(
    statement: Statement, share: Real, tolerances: Tolerances, at_least: Real | float
) -> tuple[Real, Real, Real]:
    """How far webs reach (N, K), the unit of the objective (N,), and in that the share and the target gap (2, N)."""
    region, influence = statement.flat.programs.region, in_order(statement.norms.influence)
    many, _, webs = influence.shape
    reach, unit, demands = np.empty((many, webs)), np.empty(many), np.empty((2, many))
    _disc_forms().scales(
        in_order(statement.constant_sum),
        influence,
        np.abs(cancelling(statement)),
        in_order(statement.single_reach),
        region.radius,
        region.max_mass,
        region.budget,
        at_least if isinstance(at_least, np.ndarray) else np.full(many, at_least),
        in_order(share),
        tolerances.sharpness,
        tolerances.finest,
        tolerances.coarsest,
        reach,
        unit,
        demands,
    )
    return reach, unit, demands


def pulled(statement: Statement, u: Complex, inside: Complex) -> Complex:
    """Points above a ceiling, moved towards ones below it just so far; excesses are convex (..., K)."""
    above, below = points_at(statement, np.array([u, inside])).excess
    needed = above > CEILING_ROUNDING
    step = np.where(needed, above / np.where(needed, above - np.minimum(below, 0.0), 1.0), 0.0)
    return u + step[..., None] * (inside - u)


def _by_interior_point(statement: Statement, reach: Real, unit: Real, margin: float, *stages: Any) -> tuple[Any, ...]:
    # the compiler is loaded at its first use
    from optimizer.program.kernel.interior_point import solve

    return _in_frame(statement, *solve(_programs(statement, reach, unit, margin), *stages))


def in_finer_numbers(precision: Precision, until: float) -> Method:
    """Interpreted, in finer numbers, which warn where compiled ones end in a NaN, and the search with it.

    Parameters
    ----------
    until : time.thread_time() after which they raise :class:`OutOfTime`.
    """

    def method(statement: Statement, reach: Real, unit: Real, margin: float, *stages: Any) -> tuple[Any, ...]:
        with np.errstate(all="ignore"):
            arrays = solve_in(precision)(until, _programs(statement, reach, unit, margin), *stages)
        return _in_frame(statement, *(np.asarray(values, dtype=float) for values in arrays))

    return method


def _in_frame(statement: Statement, v: Real, *rest: Any) -> tuple[Any, ...]:
    """Unbalances along and across the sectors (2, N, 3, K), after the sizes, as vectors."""
    limits = statement.limits
    return limits.centre * (v[:, :, 1] + 1j * limits.half_angle_sin * v[:, :, 2]), *rest


def _programs(statement: Statement, reach: Real, unit: Real, margin: float) -> "Programs":
    from optimizer.program.kernel.interior_point import Programs

    limits, norms, ceilings = statement.limits, statement.norms, statement.ceilings
    constant = np.concatenate([norms.constant / unit[:, None], ceilings.norms.constant / ceilings.size], axis=-1)
    influence = np.concatenate(
        [norms.influence / unit[:, None, None], ceilings.norms.influence / ceilings.size[..., None]], axis=-2
    )
    cap = ceilings.cap / ceilings.size
    mass = reach / limits.radius
    highest = np.maximum.reduce(statement.floor, axis=-1)
    budget = limits.max_total_mass[:, None]
    # where nothing is left no web reaches anything
    over = np.add.reduce(mass, axis=-1, keepdims=True) > budget
    programs = Programs(
        row=statement.row.astype(np.int64),
        floor=(statement.floor - highest[:, None]) / unit[:, None],
        cap=cap - np.clip(cap, 0.0, margin),
        constant=parts(constant),
        influence=influence * reach[:, None, :],
        centre=parts(limits.centre),
        sine=limits.half_angle_sin,
        cosine=limits.half_angle_cos,
        sector=np.where(limits.free, 0.0, 1.0),
        mass=mass,
        budget=mass / np.where(over, budget, np.inf),
    )
    return Programs(*(plain(values) for values in programs))


# loads the compiler, a tenth of a second, and so at the first call; an import at each takes as long as a short loop
@cache
def _disc_forms() -> ModuleType:
    from optimizer.program.kernel import disc_forms

    return disc_forms


@cache
def _units() -> ModuleType:
    from optimizer.program.kernel import units

    return units
