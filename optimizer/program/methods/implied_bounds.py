"""A finite reach where there is no limit: the mass within which some optimum lies, proven.

Where a web has no limit, or one far beyond any need, a bound would pay the rounding of its multipliers times that
limit. But counterweights matter only by what they add to the terms and ceilings, c = sum_k h_k u_k. The objective, or
a ceiling, bounds every response of an optimum, so c is bounded. Any c that the webs without a limit can carry they
can carry with little mass. So the lightest optimum is no heavier there (docs/mathematics.md section 5).
"""

from collections.abc import Iterator
from dataclasses import replace
from operator import itemgetter
from typing import NamedTuple

import numpy as np

from optimizer.numerics.arrays import SMALLEST, Complex, Real
from optimizer.program.ceilings import CEILING_TOLERANCE
from optimizer.program.compiled_evaluation import FAR
from optimizer.program.equal_unknowns import united
from optimizer.program.limits import Limits
from optimizer.program.norms import scalars
from optimizer.program.reference.solver import smallest_objective
from optimizer.program.scaling import natural_reach
from optimizer.program.statement import Statement

#: what every figure is raised by for its rounding
_MARGIN = 1.0 + 1e-9
#: rows whose influences agree to this many eps are one response; what they differ by is within the rounding of a bound
_SAME = 8 * np.finfo(float).eps
#: of one rounding
_EPS = float(np.finfo(float).eps)
#: rays that span a space by less than this share of their size do not span it
_FLAT = 1e-7
#: largest component of a vector that supports a cone
_STEEP = 1e6
#: where no reach is proven: the largest mass that any field may hold, kg
LARGEST = 1e15


def far_limits(statement: Statement) -> np.ndarray:
    """Webs without a limit, or with one as far away as none (..., K)."""
    limits = statement.limits
    # what one term calls for is no more than what all call for, and cheaper to tell
    if not statement.reaches.beyond:
        return np.zeros(statement.flat.leading + limits.radius.shape[-1:], bool)
    return np.isinf(limits.max_mass) | (limits.most > FAR * natural_reach(statement)[..., None] / limits.radius)


def within_reach(statement: Statement) -> Statement:
    """Programs (...) with a finite, proven limit wherever there is none, or one far beyond any need."""
    if not (statement.reaches.beyond and np.count_nonzero(webs := far_limits(statement))):
        return statement
    far = np.asarray(webs.any(axis=-1))
    if not far.ndim:
        return _within_reach(statement)
    most = statement.limits.max_mass.copy()
    nothing = np.zeros(statement.limits.radius.shape[-1:], complex)
    reached = far & np.all(statement.ceilings.excess(nothing) <= 0, axis=-1)
    if statement.limits.alike is None and np.any(reached):
        # all programs together in which the empty machine keeps the ceilings
        programs = statement.subset(reached)
        most[reached] = _finite(programs, level_above(programs, nothing))
        far = far & ~reached
    for place in np.argwhere(far).tolist():
        most[tuple(place)] = _within_reach(statement.subset(tuple(place))).limits.max_mass
    return replace(statement, limits=replace(statement.limits, max_mass=most))


def _within_reach(statement: Statement) -> Statement:
    """One program, its limits proven by a level that some point within the ceilings reaches."""
    point = np.zeros(statement.limits.radius.shape, complex)
    if np.any(statement.ceilings.excess(point) > 0):
        excess = statement.excess()
        excess = bounded(excess, float(level_above(excess, point)))
        nearest = smallest_objective(excess, 0.1 * CEILING_TOLERANCE)
        if nearest.lower_bound > 0:
            return replace(statement, limits=excess.limits)
        point = nearest.unbalance
        if nearest.objective > CEILING_TOLERANCE:
            return bounded(statement, np.inf)
    return bounded(statement, float(level_above(statement, point)))


def level_above(statement: Statement, point: Complex) -> Real:
    """A level (...) that leaves room for all that counts as an optimum, if this point may be reached."""
    value = statement.objective(point)
    return np.asarray(value + (value - np.add.reduce(-statement.largest(-statement.floor), axis=-1)))


def bounded(statement: Statement, level: float) -> Statement:
    """The program with a finite limit for every web, which changes neither its optimum nor its least mass.

    Parameters
    ----------
    statement : one program (no leading axes); a limit of inf is none.
    level : value of the objective at some point within limits and ceilings, or more. The reach holds for all that is
        no larger.
    """
    limits, alike = statement.limits, statement.limits.alike
    if alike is not None:
        if not alike.plain:
            # what one web of a pair can do alone says nothing
            return replace(statement, limits=replace(limits, max_mass=np.minimum(limits.max_mass, LARGEST)))
        together = united(statement, alike)
        proven = bounded(together, level).limits.max_mass
        mask = (proven != together.limits.max_mass)[alike.owner]
        max_mass = np.where(mask, (proven / alike.count)[alike.owner], limits.max_mass)
        return replace(statement, limits=replace(limits, max_mass=max_mass))
    max_mass = _finite(statement.alone(), np.array([level]))[0]
    return replace(statement, limits=replace(limits, max_mass=max_mass))


def _finite(statement: Statement, level: Real) -> Real:
    """Largest masses (N, K) kg of N programs, finite wherever webs were far."""
    limits, far = statement.limits, far_limits(statement)
    max_mass = limits.max_mass.copy()
    while np.any(far):
        for webs, programs in _alike(far):
            if not np.any(webs):
                continue
            part = statement.subset(programs)
            mass = np.minimum(_masses(part, webs, level[programs]), part.limits.max_total_mass[:, None])
            near = webs & (part.limits.max_mass < mass)
            final = ~np.any(near, axis=-1)
            max_mass[programs[final]] = np.where(webs, mass, part.limits.max_mass)[final]
            # webs whose limits are nearer than the proof stay as they are; the others are bounded anew
            far[programs] &= ~near & ~final[:, None]
    return max_mass


def _alike(patterns: np.ndarray) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Patterns (N, n), each once, with the numbers of those that have it."""
    if (patterns == patterns[:1]).all():
        yield patterns[0], np.arange(len(patterns))
        return
    different, inverse = np.unique(patterns, axis=0, return_inverse=True)
    for k, pattern in enumerate(different):
        yield pattern, np.flatnonzero(inverse.reshape(-1) == k)


def _masses(statement: Statement, far: np.ndarray, level: Real) -> Real:
    """Masses (N, K) kg with which far webs (K,) carry what they carry in the lightest optimum; of the others inf."""
    masses = np.full(statement.limits.radius.shape, np.inf)
    if statement.norms.scatter or statement.ceilings.norms.scatter:
        masses[:, far] = _scattered(statement, far, level)[:, None]
        return masses
    for group in responses(statement, far, level):
        limits = statement.subset(group.programs).limits.only(far)
        influence, most, scalar = group.influence * limits.radius[:, None, :], group.most, group.scalar
        together = carrying_mass(influence, limits, most, scalar)
        by_inverse = _masses_by_inverse(influence[:, ~scalar], most[:, ~scalar])
        bound = _MARGIN * np.minimum(together[:, None], by_inverse)
        bound = np.where(np.isfinite(bound), bound, LARGEST)
        # what changes nothing is of no use
        bound[~np.any(most, axis=-1)] = 0.0
        masses[np.ix_(group.programs, far)] = bound
    return masses


def carrying_mass(influence: Real, limits: Limits, most: Real, scalar: np.ndarray) -> Real:
    """Masses (N,) with which webs carry whatever they can with |c_s| <= most_s, kg; inf where none is proven.

    Parameters
    ----------
    influence : (N, s, n) of one kilogram.
    most : (N, s); inf where nothing bounds a response, as without a choice that keeps the ceilings.
    """
    plane = np.all(limits.free, axis=-1) if most.shape[-1] <= 2 and not np.any(scalar) else np.zeros(len(most), bool)
    masses = np.full(len(most), np.inf)
    # of nothing that can be changed there is nothing to carry
    plane &= np.any(most, axis=-1)
    if np.any(plane):
        masses[plane] = _in_planes(influence[plane], most[plane])
    for n in np.flatnonzero(~plane & np.any(most, axis=-1) & np.all(np.isfinite(most), axis=-1)).tolist():
        masses[n] = _in_sectors(influence[n], limits.mapped(itemgetter(n)), most[n], scalar)
    return masses


def _scattered(statement: Statement, far: np.ndarray, level: Real) -> Real:
    """The same (N,) where counterweights scatter by a share of themselves.

    Then a row, and a limited response, grows with the mass of every web that it feels, whichever way it points; a web
    that none feels is of no use.
    """
    norms, ceilings = statement.norms, statement.ceilings
    highest = statement.largest(statement.floor)
    rest = np.add.reduce(highest, axis=-1)[..., None] - highest
    left = level[:, None] - (statement.floor + rest[:, statement.group])
    growth = norms.scatter * (statement.membership @ np.abs(norms.influence))[..., far]
    growth = np.concatenate([growth, ceilings.norms.scatter * np.abs(ceilings.norms.influence)[..., far]], axis=-2)
    left = np.maximum(np.concatenate([left, ceilings.cap + CEILING_TOLERANCE * ceilings.size], axis=-1), 0.0)
    radius = statement.limits.radius[:, None, far]
    most = np.where(growth > 0, left[..., None] / np.where(growth > 0, growth, 1.0), np.inf) / radius
    of_webs = np.min(most, axis=-2)
    mass = _MARGIN * np.max(np.where(np.isfinite(of_webs), of_webs, 0.0), axis=-1)
    return np.asarray(np.minimum(mass, LARGEST))


class Responses(NamedTuple):
    """What the far webs of n programs can change, all of which have the same responses."""

    programs: np.ndarray  # (n,) their numbers
    influence: Real  # (n, s, far) of size 1
    most: Real  # (n, s) that each may change
    scalar: np.ndarray  # (s,) whether only its real part counts


def responses(statement: Statement, far: np.ndarray, level: Real) -> Iterator[Responses]:
    """What the far webs (K,) of N programs can change; level (N,)."""
    norms, ceilings, highest = statement.norms, statement.ceilings, statement.largest(statement.floor)
    # a term is no larger than what the objective leaves it, a limited response no larger than its cap
    rest = np.add.reduce(highest, axis=-1)[..., None] - highest
    floor = (statement.floor + rest[:, statement.group])[:, statement.row]
    within = np.concatenate([level[:, None] - floor, ceilings.cap + CEILING_TOLERANCE * ceilings.size], axis=-1)
    constant, influence = statement.every_constant, statement.every_influence
    near = np.where(far, 0.0, statement.limits.reach)
    allowed = np.abs(constant) + np.maximum(within, 0.0)
    allowed = allowed + np.add.reduce(np.abs(influence) * near[:, None, :], axis=-1)
    scalar = np.array([*scalars(norms), *scalars(ceilings.norms)], bool)
    rows = influence[..., far]
    largest = np.take_along_axis(rows, np.argmax(np.abs(rows), axis=-1)[..., None], axis=-1)[..., 0]
    size = np.abs(largest)
    is_nonzero = size > 0.0
    # a scalar in another direction is another one
    unit = np.where(is_nonzero, np.where(scalar, size, largest), 1.0)
    rows, allowed = rows / unit[..., None], allowed / np.where(is_nonzero, size, 1.0)
    for owner, programs in _alike(_owners(rows, is_nonzero, scalar)):
        first = np.flatnonzero(owner == np.arange(owner.size))
        most = [np.minimum.reduce(allowed[programs][:, owner == n], axis=-1) for n in first.tolist()]
        of_all = np.stack(most, axis=-1) if most else np.zeros((programs.size, 0))
        yield Responses(programs, rows[np.ix_(programs, first)], of_all * _MARGIN, scalar[first])


def _owners(rows: Real | Complex, is_nonzero: np.ndarray, scalar: np.ndarray) -> np.ndarray:
    """Numbers (N, R) of the first rows (N, R, far) that each is alike; -1 of a row that nothing changes."""
    owner = np.where(is_nonzero, np.arange(scalar.size), -1)
    for r in range(1, scalar.size):
        # the first of those that stand for themselves
        for n in np.flatnonzero((owner[:, :r] == np.arange(r)).any(axis=0) & (scalar[:r] == scalar[r]))[::-1].tolist():
            same = is_nonzero[:, r] & (owner[:, n] == n) & np.all(np.abs(rows[:, r] - rows[:, n]) <= _SAME, axis=-1)
            owner[same, r] = n
    return owner


def _masses_by_inverse(influence: Real | Complex, most: Real) -> Real:
    """Masses (N, n) of webs that are determined by the responses c, of which |c_s| <= most_s, kg; else inf.

    Each is G c, with G a left inverse of the influences, but for the error 1 - G A of that.

    Parameters
    ----------
    influence : (N, s, n) of one kilogram.
    """
    count, rows, webs = influence.shape
    if rows < webs:
        return np.full((count, webs), np.inf)
    least = np.min(np.where(most > 0, most, np.inf), axis=-1)
    matrix = influence / np.where(most > 0, most, np.where(np.isfinite(least), least, 1.0)[:, None])[..., None]
    size = np.max(np.abs(matrix), axis=-2)
    independent = np.isfinite(least) & np.all((size > SMALLEST) & np.isfinite(size), axis=-1)
    matrix, size = np.where(independent[:, None, None], matrix, 0.0), np.where(independent[:, None], size, 1.0)
    matrix = matrix / size[:, None, :]
    inverse = np.linalg.pinv(matrix)
    error = np.abs(np.eye(webs) - inverse @ matrix) + (4 + rows) * _EPS * (np.abs(inverse) @ np.abs(matrix))
    carried, lost = np.add.reduce(np.abs(inverse), axis=-1), np.add.reduce(error, axis=-1)
    most_lost, most_carried = np.max(lost, axis=-1), np.max(carried, axis=-1)
    independent &= most_lost < 0.5
    rest = np.where(independent, 1.0 - most_lost, 1.0)
    masses = (carried + lost * (most_carried / rest)[:, None]) / size
    return np.where(independent[:, None], masses, np.inf)


def _in_planes(influence: Real, most: Real) -> Real:
    """Masses (N,) kg that carry every c with |c_s| <= most_s on webs without sectors: on one, or in two planes.

    Parameters
    ----------
    influence : (N, s, n) of one kilogram, s at most 2.
    """
    if most.shape[-1] == 1:
        return np.asarray(most[:, 0] / np.max(np.abs(influence), axis=(-2, -1)))
    a, b = influence[:, 0], influence[:, 1]
    across, back = a[:, :, None] * b[:, None, :], b[:, :, None] * a[:, None, :]
    apart = np.abs(across - back) - 8 * _EPS * (np.abs(across) + np.abs(back))
    # a response that nothing bounds bounds a web only where that does not change it
    products = _product(np.abs(b), most[:, :1]) + _product(np.abs(a), most[:, 1:])
    pairs = products[:, :, None] + products[:, None, :]
    masses = np.where(apart > 0, pairs / np.where(apart > 0, apart, 1.0), np.inf)
    return np.asarray(np.min(masses, axis=(-2, -1)))


def _product(influence: Real, most: Real) -> Real:
    """|influence| * most, 0 where nothing is changed, though nothing bounds how much."""
    return np.where(influence > 0, np.where(influence > 0, influence, 1.0) * most, 0.0)


def _in_sectors(influence: Real, limits: Limits, most: Real, scalar: np.ndarray) -> float:
    """Mass that carries every c with |c_s| <= most_s that the sectors can carry at all, kg; inf where that fails.

    A sector is the cone of its edges and its middle, so what can be carried is the cone of these rays r_i in R^2s. Of a
    scalar only the real part counts. Rays whose opposites it holds too span its lineality space. A vector y is 0 on
    that and at least delta on all the others, so that those carry sum lam <= c.y/delta. What they leave lies in the
    lineality space, each direction of which is carried by the rays in it. Both come from linear programs, whose numbers
    are used as they turn out.
    """
    # takes longer to load than what every program needs, and few have sectors
    from scipy.optimize import linprog

    edge = limits.half_angle_cos + 1j * limits.half_angle_sin
    turns = [np.where(limits.free, step, turn) for step, turn in ((1, 1), (1j, edge), (-1j, np.conj(edge)), (-1, 1))]
    unit = np.concatenate([limits.centre * turn for turn in turns])
    rays = np.tile(influence / np.maximum(most, 1e-9 * np.max(most))[:, None], len(turns)) * unit
    rays = np.concatenate([rays.real, rays.imag[~scalar]]).T
    size = np.sqrt(np.sum(rays**2, axis=-1))
    rays, size = rays[size > 0] / size[size > 0, None], size[size > 0]
    reach = np.sqrt(len(most))  # of c, in these units
    n, d = rays.shape
    result = linprog(
        np.concatenate([np.zeros(d), -np.ones(n)]),
        A_ub=np.hstack([-rays, np.eye(n)]),
        b_ub=np.zeros(n),
        bounds=[(-_STEEP, _STEEP)] * d + [(0.0, 1.0)] * n,
    )
    if result.x is None:
        return np.inf
    outside = rays @ result.x[:d] > 0.5
    inside = rays[~outside]
    # the shortest that does the same
    directions = np.hstack([rays, -rays])
    result = linprog(np.ones(2 * d), A_ub=-directions, b_ub=np.where(outside, -1.0, 0.0))
    if result.x is None:
        return np.inf
    support = result.x[:d] - result.x[d:]
    along = rays @ support
    price = _price(inside)
    leak = max(0.0, -float(np.min(along[~outside], initial=0.0)))
    slack = float(np.min(along[outside], initial=1.0)) - leak * price
    if not slack > 0.0:
        return np.inf
    steep = float(np.linalg.norm(support))
    out = reach * (steep + leak * price) / slack if np.any(outside) else 0.0
    within = price * (reach + out)
    return out / np.min(size[outside], initial=np.inf) + within / np.min(size[~outside], initial=np.inf)


def _price(rays: Real) -> float:
    """sum lam that carries any unit vector of the space that the rays span; inf where they do not carry all of it."""
    from scipy.optimize import linprog

    if not rays.size:
        return 0.0
    _, values, basis = np.linalg.svd(rays, full_matrices=False)
    spanned = values > _FLAT * values[0]
    if np.any(values[~spanned] > _MARGIN * 1e-13 * values[0]):
        return np.inf
    basis = basis[spanned]
    price, rest = 0.0, 0.0
    for direction in basis:
        costs, errors = [], []
        for target in (direction, -direction):
            result = linprog(np.ones(len(rays)), A_eq=rays.T, b_eq=target)
            if result.x is None:
                return np.inf
            share = np.maximum(result.x, 0.0)
            costs.append(float(np.sum(share)))
            errors.append(float(np.linalg.norm(target - share @ rays)))
        price, rest = price + max(costs), rest + max(errors)
    # what a linear program leaves is carried in the same way
    return price / (1.0 - rest) if rest < 0.5 else np.inf
