"""Programs for the interior point for discs (:mod:`optimizer.program.kernel.discs`): which, and in its form."""

from collections.abc import Sequence
from functools import cache, lru_cache
from types import ModuleType
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from optimizer.numerics.arrays import Real
from optimizer.numerics.memoization import remembered
from optimizer.program.statement import Statement

if TYPE_CHECKING:
    from optimizer.program.kernel.disc_starts import Discs

#: vectors at most: what a step has in common grows with the cube
_VECTORS = 6
#: sine of the half-angle below which sectors need coordinates of their own, as the method for any limits has them
_THINNEST = 1e-3
#: forms of programs: with a budget that can bind, with sectors, without the ceilings that they have
_BUDGET, _SECTORS, _BARE = 1, 2, 4


def suits_discs(statement: Statement, least_mass: bool = True) -> np.ndarray:
    """Whether the interior point for discs takes each of N programs (N,) bool.

    They have one row, of vectors that are multiples of two, as force and moment are, and what is below ceilings too.
    Without the least mass any optimum is one: that of the method for any limits is lighter where there are limits.
    """
    norms, ceilings, limits = statement.norms, statement.ceilings.norms, statement.limits
    terms, webs = norms.constant.shape[-1], limits.radius.shape[-1]
    simple = not (norms.scatter or ceilings.scatter or any(norms.scalar) or any(ceilings.scalar))
    simple = simple and not (norms.is_complex or ceilings.is_complex)
    vectors = terms + ceilings.constant.shape[-1]
    if not (statement.floor.shape[-1] == 1 and simple and 0 < terms <= vectors <= _VECTORS and webs > 0):
        return np.zeros(statement.floor.shape[:-1], bool)
    pair = _pair(statement)
    if pair is None or limits.alike is not None:
        return np.zeros(statement.floor.shape[:-1], bool)
    if not least_mass:
        plain_webs = limits.all_free or np.logical_and.reduce(limits.free, axis=-1)
        plain_webs = plain_webs & ~limits.budget_ends
        return plain_webs & bool(terms < 3 and not statement.ceilings.names)
    if limits.all_free:
        return pair.holds
    wide = np.logical_and.reduce(limits.free | (limits.half_angle_sin >= _THINNEST), axis=-1)
    return np.asarray(wide & pair.holds)


def discs_of(
    statement: Statement, reach: Real, unit: Real, margin: float, without_ceilings: np.ndarray | None = None
) -> Sequence[tuple[np.ndarray | None, bool, "Discs"]]:
    """N programs in parts of one form each: which they are, whether they have a budget, and in units of their own.

    Parameters are those of a method of :mod:`optimizer.program.methods.stage_ends`. Of one part alone which they are is
    None: all.

    Parameters
    ----------
    without_ceilings : (N,) bool, of which programs they are left out.
    """
    programs, pair = statement.flat.programs, _pair(statement)
    assert pair is not None
    (many, vectors, webs), region = programs.influence.shape, programs.region
    shapes = (many, vectors), (many, vectors, 2), (many, 2, webs), (many, webs), (many, webs), programs.cap.shape
    sectors = ~np.logical_and.reduce(region.free, axis=-1)
    edges = (many, 5, webs if np.count_nonzero(sectors) else 0)
    every, budgeted = tuple(map(np.empty, (*shapes, edges))), np.empty(many, bool)
    _disc_forms().forms(
        programs.constant,
        programs.influence if vectors < 3 else pair.influence,
        pair.multiple,
        statement.norms.constant.shape[-1],
        region.radius,
        region.budget,
        region.free,
        region.centre,
        region.cosine,
        region.sine,
        programs.cap,
        programs.size,
        margin,
        reach,
        unit,
        budgeted,
        *every,
    )
    kinds = _SECTORS * sectors + _BUDGET * budgeted
    if without_ceilings is not None:
        kinds = kinds + _BARE * without_ceilings
    if many == 1 or (kinds == kinds[0]).all():
        return [(None, *_form(int(kinds[0]), statement, pair.basis, every, _places(many)))]
    parts = []
    for part in np.unique(kinds).tolist():
        numbers = np.flatnonzero(kinds == part)
        parts.append((numbers, *_form(part, statement, pair.basis, every, numbers)))
    return parts


def _form(
    kind: int, statement: Statement, basis: np.ndarray, every: tuple[Real, ...], numbers: np.ndarray
) -> tuple[bool, "Discs"]:
    """Those programs that are of one form: whether they have a budget, and without what they do not have."""
    *arrays, cap, normals = every
    if kind & _BARE:
        basis, cap = basis[: statement.norms.constant.shape[-1]], cap[:, :0]
    if not kind & _SECTORS:
        # without any sector there is no place for edges
        normals = normals[..., :0]
    return bool(kind & _BUDGET), _disc_starts().Discs(basis, *arrays, cap, normals, numbers)


def disc_stages(
    statement: Statement,
    reach: Real,
    unit: Real,
    margin: float,
    *stages: Any,
    without_ceilings: np.ndarray | None = None,
) -> tuple[Any, ...]:
    """A method; without_ceilings (N,) bool, of which programs they are left out."""
    least_mass, share, tolerance, mass_tolerance = stages
    every: tuple[np.ndarray, ...] = ()
    vectors, webs = statement.constant_sizes.shape[-1], reach.shape[1]
    for numbers, budgeted, programs in discs_of(statement, reach, unit, margin, without_ceilings):
        demands = (share, tolerance) if numbers is None else (share[numbers], tolerance[numbers])
        v, p, price, mass_unit = _discs().solve(*programs, budgeted, least_mass, *demands, mass_tolerance)
        ends = v.view(complex)[..., 0], p, price, mass_unit
        if numbers is None and p.shape[2] == vectors:
            return ends
        # nothing is proven by what was left out
        every = every or _no_ends(share.size, webs, vectors)
        at = slice(None) if numbers is None else numbers
        every[0][:, at], every[1][:, at, : p.shape[2]], every[2][:, at], every[3][at] = ends
    return every


def _no_ends(many: int, webs: int, vectors: int) -> tuple[np.ndarray, ...]:
    """What a method finds of N programs, to be written to: points, multipliers of vectors, prices, units of mass."""
    stages = (2, many)
    return np.zeros((*stages, webs), complex), np.zeros((*stages, vectors, 2)), np.zeros((*stages, 1)), np.ones(many)


def _basis(statement: Statement) -> np.ndarray | None:
    """Which of two responses a vector is a multiple of (J + I,), None where there are more than two."""
    vectors = statement.every_constant.shape[-1]
    if vectors < 3:
        return _places(vectors)
    responses = [term.response for term in statement.names.terms] + list(statement.ceilings.names)
    if len(responses) != vectors:
        # the names cover more than these vectors
        return None
    two = list(dict.fromkeys(responses))
    return np.array([two.index(name) for name in responses]) if len(two) < 3 else None


class _Pair(NamedTuple):
    """Vectors of N programs as multiples of two, the largest of either response."""

    basis: np.ndarray  # (Q,) of which response
    multiple: Real  # (N, Q)
    holds: np.ndarray  # (N,) bool, whether the vectors are such multiples
    influence: Real  # (N, 2, K) of both; of fewer than three vectors these


@remembered
def _pair(statement: Statement) -> _Pair | None:
    """The same of a statement whose influences are real; None where there are more than two responses."""
    basis = _basis(statement)
    if basis is None:
        return None
    every = statement.flat.programs.influence
    number, vectors, webs = every.shape
    if vectors < 3:
        return _Pair(basis, *_by_themselves(number, vectors), every)
    multiple, two, holds = np.empty((number, vectors)), np.empty((number, 2, webs)), np.empty(number, bool)
    _disc_forms().pairs(every, basis, multiple, two, holds)
    return _Pair(basis, multiple, holds, two)


@lru_cache(maxsize=8)
def _places(many: int) -> np.ndarray:
    """Of vectors or programs in their order; nobody writes to it."""
    return np.arange(many)


@lru_cache(maxsize=8)
def _by_themselves(number: int, vectors: int) -> tuple[Real, np.ndarray]:
    """Multiples of programs whose vectors are the two themselves, and that they hold; nobody writes to these."""
    return np.ones((number, vectors)), np.ones(number, bool)


# loads the compiler, a tenth of a second, and so at the first call; an import at each takes as long as a short loop
@cache
def _disc_forms() -> ModuleType:
    from optimizer.program.kernel import disc_forms

    return disc_forms


@cache
def _disc_starts() -> ModuleType:
    from optimizer.program.kernel import disc_starts

    return disc_starts


@cache
def _discs() -> ModuleType:
    from optimizer.program.kernel import discs

    return discs
