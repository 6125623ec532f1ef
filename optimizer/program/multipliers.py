"""Better multipliers from the same solution: exact where the solver is exact only to its tolerance.

A limit that is not touched must not enter the bound. In the numbers it does, by the solver's
tolerance times the limit, which is much where the limit is far away.
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from optimizer.numerics.arrays import Complex, Real
from optimizer.program.certificate import Multipliers, spread
from optimizer.program.norms import scalars
from optimizer.program.statement import Statement

#: a limit is touched when it is nearer than this share of itself
TOUCHED = 1e-6


def resting_multipliers(statement: Statement) -> Iterator[Multipliers]:
    """Multipliers that need no solver: they prove the floor, and rest where rest is optimal."""
    norms = statement.norms
    size = np.abs(norms.constant)
    none = np.zeros_like(statement.ceilings.norms.constant)
    yield Multipliers(np.zeros_like(norms.constant), statement.where_largest(statement.floor), none)
    # the largest row of one is that one
    largest = statement.where_largest(statement.rows(size) if statement.floor.shape[-1] > 1 else statement.floor)
    direction = norms.constant / np.where(size > 0, size, 1.0)
    yield Multipliers(direction * largest[..., statement.row], largest, none)


def objective_multipliers(statement: Statement, u: Complex, solver: Multipliers) -> Iterator[Multipliers]:
    """The solver's multipliers, and the nearest ones that leave untouched webs out of the bound."""
    yield solver
    usable = solver.admissible(statement)
    interior = _interior(statement, u)
    if statement.mass(u) >= statement.limits.max_total_mass * (1.0 - TOUCHED) or not np.any(interior):
        return
    # sum_j conj(H_jk) y_j + sum_i conj(H_ik) p_i = 0 for every interior web k, at the least change
    influence = np.concatenate(
        [statement.norms.influence[:, interior], statement.ceilings.norms.influence[:, interior]]
    )
    stacked = np.concatenate([usable.term, usable.ceiling])
    more, worth = spread(statement, usable), np.zeros(int(np.sum(interior)), complex)
    if np.any(more):
        # where counterweights scatter, a kilogram metre gains what it costs: conj(H) y = -spread u/|u|
        towards = u[interior] / np.where(u[interior] != 0, np.abs(u[interior]), 1.0)
        worth = -np.broadcast_to(more, u.shape)[interior] * towards
    norms, limited = statement.norms, statement.ceilings.norms
    if any(norms.scalar) or any(limited.scalar):
        free = ~np.array([*scalars(norms), *scalars(limited)])
        stacked = _nearest_of_scalars(influence, stacked, worth, free)
    else:
        stacked = _nearest(influence, stacked, worth)
    terms = usable.term.size
    # a row whose terms have grown grows with them: what is left of rows that hardly count is no reason to shrink all
    row = usable.row.copy()
    np.maximum.at(row, statement.row, np.abs(stacked[:terms]))
    yield replace(usable, row=row, term=stacked[:terms], ceiling=stacked[terms:])


def _nearest(influence: Real | Complex, multipliers: Complex | Real, worth: Complex | Real) -> Complex:
    """The nearest multipliers (n,) with sum_j conj(H_jk) y_j = worth_k for all webs.

    Parameters
    ----------
    influence : (n, K).
    worth : (K,) that is 0, or so small that some multipliers are worth it.
    """
    scale = np.max(np.abs(influence), axis=1, keepdims=True)
    scale = np.where(scale > 0, scale, 1.0)
    basis, size, across = np.linalg.svd(influence / scale, full_matrices=False)
    mask = size > 1e-12 * size[0]
    basis = basis[:, mask]
    weighted = multipliers * scale[:, 0]
    result: Complex = (weighted - basis @ (np.conj(basis).T @ weighted)) / scale[:, 0]
    if np.any(worth):
        result = result + (basis @ ((across[mask] @ worth) / size[mask])) / scale[:, 0]
    return result


def _nearest_of_scalars(influence: Real | Complex, multipliers: Complex, worth: Complex, free: np.ndarray) -> Complex:
    """The same where multipliers are real: in their real parts and, of those that are ``free`` (n,), the imaginary."""
    rows = np.concatenate([influence, -1j * influence[free]])
    parts = np.concatenate([multipliers.real, multipliers.imag[free]])
    values = _nearest(np.hstack([rows.real, -rows.imag]), parts, np.concatenate([worth.real, worth.imag]))
    whole: Complex = values[: free.size].astype(complex)
    whole[free] += 1j * values[free.size :]
    return whole


def mass_multipliers(statement: Statement, u: Complex, solver: Multipliers) -> Iterator[Multipliers]:
    """The solver's multipliers, and the largest multiple at which no untouched web is worth more mass."""
    yield solver
    usable = solver.admissible(statement)
    norms, limited = statement.norms, statement.ceilings.norms
    slope = usable.term @ np.conj(norms.influence) + usable.ceiling @ np.conj(limited.influence)
    worth = statement.limits.radius * (statement.limits.support(-slope) - spread(statement, usable))
    untouched = np.abs(u) < statement.limits.reach * (1.0 - TOUCHED)
    most = float(np.max(worth[untouched], initial=0.0))
    if most > 1.0:
        yield usable.times(np.asarray((1.0 - 8 * np.finfo(float).eps) / most))


def supporting_multipliers(statement: Statement, u: Complex) -> Iterator[Multipliers]:
    """Multipliers of the least mass for which every counterweight inside its limits is worth its mass exactly.

    R_k w_k = -u_k / |u_k| for those webs, by least squares; w_k as in docs/mathematics.md section 5. First of terms
    and ceilings together, then of the ceilings alone, which are all that holds up a mass that they call for.
    """
    inside = _interior(statement, u) & (np.abs(u) > TOUCHED * np.max(np.abs(u), initial=0.0))
    if not np.any(inside):
        return
    terms = statement.norms.constant.size
    influence = np.concatenate([statement.norms.influence[:, inside], statement.ceilings.norms.influence[:, inside]])
    size = np.max(np.abs(influence), axis=1, initial=0.0)
    size = np.where(size > 0, size, 1.0)
    worth = -u[inside] / np.abs(u[inside]) / statement.limits.radius[inside]
    every = np.arange(size.size)
    for part in (every, every[terms:]) if statement.ceilings.names else (every,):
        prices = np.zeros(size.size, complex)
        prices[part] = np.linalg.lstsq(np.conj(influence[part] / size[part, None]).T, worth, rcond=None)[0] / size[part]
        row = np.zeros(statement.floor.size)
        np.maximum.at(row, statement.row, np.abs(prices[:terms]))
        yield Multipliers(prices[:terms], row, prices[terms:])


def _interior(statement: Statement, u: Complex) -> np.ndarray:
    """Webs that touch neither their mass limit nor an edge of their sector (K,)."""
    limits = statement.limits
    v = u * np.conj(limits.centre)
    margin = v.real * limits.half_angle_sin - np.abs(v.imag) * limits.half_angle_cos
    inside = limits.free | (margin > TOUCHED * np.abs(u))
    return (np.abs(u) < limits.reach * (1.0 - TOUCHED)) & inside
