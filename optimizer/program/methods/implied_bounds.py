"""A finite reach where there is no limit: the mass within which some optimum lies, proven.

Where a web has no limit, or one far beyond any need, a bound would pay the rounding of its multipliers times that
limit. But counterweights matter only by what they add to the terms and ceilings, c = sum_k h_k u_k. The objective, or
a ceiling, bounds every response of an optimum, so c is bounded; and any c that the webs without a limit can carry they
can carry with little mass. So the lightest optimum is no heavier there (docs/mathematics.md section 5).
"""

from dataclasses import replace

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
    most = statement.limits.max_mass.copy()
    for place in np.ndindex(far.shape):
        if far[place]:
            most[place] = _within_reach(statement.chosen(place)).limits.max_mass
    return replace(statement, limits=replace(statement.limits, max_mass=most))


def _within_reach(statement: Statement) -> Statement:
    """One program, its limits proven by what is known to be reached within the ceilings."""
    point = np.zeros(statement.limits.radius.shape, complex)
    if np.any(statement.ceilings.excess(point) > 0):
        excess = statement.excess()
        excess = bounded(excess, level_above(excess, point))
        nearest = smallest_objective(excess, 0.1 * CEILING_TOLERANCE)
        if nearest.lower_bound > 0:
            return replace(statement, limits=excess.limits)
        point = nearest.unbalance
        if nearest.objective > CEILING_TOLERANCE:
            return bounded(statement, np.inf)
    return bounded(statement, level_above(statement, point))


def level_above(statement: Statement, point: Complex) -> float:
    """A level that leaves room for all that counts as an optimum, if this point may be reached."""
    value = float(statement.objective(point))
    return value + (value - float(np.sum(-statement.largest(-statement.floor))))


def bounded(statement: Statement, level: float) -> Statement:
    """The program with a finite limit for every web, which changes neither its optimum nor its least mass.

    Parameters
    ----------
    statement : one program (no leading axes); a limit of inf is none.
    level : what the objective is known to reach within limits and ceilings, or more. The reach holds for all that is
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
    far = far_limits(statement)
    while np.any(far):
        mass = np.minimum(_masses(statement, far, level), limits.max_total_mass)
        near = far & (limits.max_mass < mass)
        if not np.any(near):
            return replace(statement, limits=replace(limits, max_mass=np.where(far, mass, limits.max_mass)))
        far = far & ~near
    return statement


def _masses(statement: Statement, far: np.ndarray, level: float) -> Real:
    """Masses (K,) with which the far webs carry whatever they carry in the lightest optimum, kg; of the others inf."""
    limits, masses = statement.limits.only(far), np.full(far.shape, np.inf)
    scattered = _scattered(statement, far, level)
    if scattered is not None:
        masses[far] = scattered
        return masses
    rows, most, scalar = responses(statement, far, level)
    if not np.any(most):
        masses[far] = 0.0
        return masses
    influence = rows * limits.radius
    together = carrying_mass(influence, limits, most, scalar)
    bound = _MARGIN * np.minimum(together, _masses_by_inverse(influence[~scalar], most[~scalar]))
    masses[far] = np.where(np.isfinite(bound), bound, LARGEST)
    return masses


def carrying_mass(influence: Real, limits: Limits, most: Real, scalar: np.ndarray) -> float:
    """Mass with which webs carry whatever they can with |c_s| <= most_s, kg; inf where none is proven.

    Parameters
    ----------
    influence : (s, n) of one kilogram.
    most : (s,); inf where nothing bounds a response, as while no choice is known to keep the ceilings.
    """
    if np.all(limits.free) and len(most) <= 2 and not np.any(scalar):
        return _in_planes(influence, most)
    return _in_sectors(influence, limits, most, scalar) if np.all(np.isfinite(most)) else np.inf


def _scattered(statement: Statement, far: np.ndarray, level: float) -> float | None:
    """The same where counterweights scatter by a share of themselves, None where they do not.

    Then a row, and a limited response, grows with the mass of every web that it feels, whichever way it points; a web
    that none feels is of no use.
    """
    norms, ceilings = statement.norms, statement.ceilings
    if not norms.scatter and not ceilings.norms.scatter:
        return None
    highest = statement.largest(statement.floor)
    others = np.sum(highest) - highest
    left = level - (statement.floor + others[statement.group])
    growth = norms.scatter * (statement.membership @ np.abs(norms.influence))[:, far]
    growth = np.concatenate([growth, ceilings.norms.scatter * np.abs(ceilings.norms.influence)[:, far]])
    left = np.maximum(np.concatenate([left, ceilings.cap + CEILING_TOLERANCE * ceilings.size]), 0.0)
    most = (
        np.where(growth > 0, left[:, None] / np.where(growth > 0, growth, 1.0), np.inf) / statement.limits.radius[far]
    )
    of_webs = np.min(most, axis=0)
    mass = _MARGIN * float(np.max(of_webs[np.isfinite(of_webs)], initial=0.0))
    return min(mass, LARGEST)


def responses(statement: Statement, far: np.ndarray, level: float) -> tuple[Real, Real, np.ndarray]:
    """What the far webs can change: rows of influence (s, far) of size 1, the most that each may change (s,).

    And whether only its real part counts (s,).
    """
    norms, ceilings, highest = statement.norms, statement.ceilings, statement.largest(statement.floor)
    # a term is no larger than what the objective leaves it, a limited response no larger than its cap
    others = np.sum(highest) - highest
    floor = (statement.floor + others[statement.group])[statement.row]
    within = np.concatenate([level - floor, ceilings.cap + CEILING_TOLERANCE * ceilings.size])
    constant, influence = statement.every_constant, statement.every_influence
    near = np.where(far, 0.0, statement.limits.reach)
    allowed = np.abs(constant) + np.maximum(within, 0.0) + np.sum(np.abs(influence) * near, axis=-1)
    every = np.array([*scalars(norms), *scalars(ceilings.norms)])
    rows: list[Real] = []
    most: list[float] = []
    kinds: list[bool] = []
    for row, limit, scalar in zip(influence[:, far], allowed, every, strict=True):
        largest = row[np.argmax(np.abs(row))]
        if largest == 0.0:
            continue
        # a scalar in another direction is another one
        row, limit = row / (abs(largest) if scalar else largest), limit / abs(largest)
        alike = ((n, other) for n, other in enumerate(rows) if kinds[n] == scalar)
        same = [n for n, other in alike if np.all(np.abs(row - other) <= _SAME)]
        if same:
            most[same[0]] = min(most[same[0]], limit)
        else:
            rows.append(row)
            most.append(limit)
            kinds.append(bool(scalar))
    return np.array(rows), np.array(most) * _MARGIN, np.array(kinds)


def _masses_by_inverse(influence: Real | Complex, most: Real) -> Real:
    """Masses (n,) of webs that are told by what they change, of which every c has |c_s| <= most_s, kg; else inf.

    Each is G c, with G a left inverse of the influences, but for the error 1 - G A of that.

    Parameters
    ----------
    influence : (s, n) of one kilogram.
    """
    rows, webs = influence.shape
    if rows < webs or not np.any(most):
        return np.full(webs, np.inf)
    matrix = influence / np.where(most > 0, most, np.min(most[most > 0]))[:, None]
    size = np.max(np.abs(matrix), axis=0)
    if not np.all((size > SMALLEST) & np.isfinite(size)):
        return np.full(webs, np.inf)
    matrix = matrix / size
    inverse = np.linalg.pinv(matrix)
    error = np.abs(np.eye(webs) - inverse @ matrix) + (4 + rows) * _EPS * (np.abs(inverse) @ np.abs(matrix))
    carried, lost = np.sum(np.abs(inverse), axis=1), np.sum(error, axis=1)
    if not np.max(lost) < 0.5:
        return np.full(webs, np.inf)
    return (carried + lost * np.max(carried) / (1.0 - np.max(lost))) / size


def _in_planes(influence: Real, most: Real) -> float:
    """Mass that carries every c with |c_s| <= most_s on webs without sectors: on one of them, or on two planes, kg.

    Parameters
    ----------
    influence : (s, n) of one kilogram, s at most 2.
    """
    if len(most) == 1:
        return float(most[0] / np.max(np.abs(influence)))
    a, b = influence
    apart = np.abs(a[:, None] * b - b[:, None] * a)
    apart = apart - 8 * _EPS * (np.abs(a[:, None] * b) + np.abs(b[:, None] * a))
    # a response that nothing bounds bounds a web only where that does not change it
    products = _product(np.abs(b), most[0]) + _product(np.abs(a), most[1])
    pairs = products[:, None] + products
    return float(np.min(np.where(apart > 0, pairs / np.where(apart > 0, apart, 1.0), np.inf)))


def _product(influence: Real, most: float) -> Real:
    """|influence| * most, 0 where nothing is changed, though nothing bounds how much."""
    return np.where(influence > 0, np.where(influence > 0, influence, 1.0) * most, 0.0)


def _in_sectors(influence: Real, limits: Limits, most: Real, scalar: np.ndarray) -> float:
    """Mass that carries every c with |c_s| <= most_s that the sectors can carry at all, kg; inf where that fails.

    A sector is the cone of its edges and its middle, so what can be carried is the cone of these rays r_i in R^2s;
    of a scalar only the real part counts.
    Rays whose opposites it holds too span its lineality space; a vector y is 0 on that and at least delta on all the
    others, so that those carry sum lam <= c.y/delta. What they leave lies in the lineality space, each direction of
    which is carried by the rays in it. Both come from linear programs, whose numbers are used as they turn out.
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
    both = np.hstack([rays, -rays])
    result = linprog(np.ones(2 * d), A_ub=-both, b_ub=np.where(outside, -1.0, 0.0))
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
        for wanted in (direction, -direction):
            result = linprog(np.ones(len(rays)), A_eq=rays.T, b_eq=wanted)
            if result.x is None:
                return np.inf
            share = np.maximum(result.x, 0.0)
            costs.append(float(np.sum(share)))
            errors.append(float(np.linalg.norm(wanted - share @ rays)))
        price, rest = price + max(costs), rest + max(errors)
    # what a linear program leaves is carried in the same way
    return price / (1.0 - rest) if rest < 0.5 else np.inf
