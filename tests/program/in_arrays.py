"""What loops prove, evaluate and settle, in arrays and in long doubles: written apart from them, for one program."""

import numpy as np

from optimizer.numerics.arrays import Complex, Real
from optimizer.program.certificate import Multipliers
from optimizer.program.limits import Limits
from optimizer.program.statement import Statement

_EPS = float(np.finfo(float).eps)


def objective_bound(program: Statement, multipliers: Multipliers) -> float:
    """As ``objective_lower_bound``, with slopes to more digits and nothing taken off for rounding."""
    row, term, ceiling = _admissible(program, multipliers)
    price = float(np.sum(row[program.group == 0]))
    if not 0.0 < price < np.inf:
        return -np.inf
    return _lowest(program, row / price, term / price, ceiling / price, program.ceilings.cap, 0.0)


def mass_bound(program: Statement, multipliers: Multipliers, target: float) -> float:
    """As ``mass_lower_bound``, likewise."""
    row, term, ceiling = _admissible(program, multipliers)
    charge = float(np.sum(row[program.group == 0])) * target
    return max(_lowest(program, row, term, ceiling, program.ceilings.tolerant_cap, 1.0) - charge, 0.0)


def size_of_slopes(program: Statement, multipliers: Multipliers) -> Real:
    """Sums of magnitudes of which the slopes are made (K,)."""
    _, term, ceiling = _admissible(program, multipliers)
    return np.abs(np.concatenate([term, ceiling])) @ np.abs(program.every_influence)


def _admissible(program: Statement, multipliers: Multipliers) -> tuple[Real, Complex, Complex]:
    """Rows no less than 0 and of one sum in every group, terms no larger than their row, scalars real."""
    row = np.maximum(multipliers.row, 0.0)
    sums = np.array([np.sum(row[program.group == g]) for g in range(program.group[-1] + 1)])
    for g, own in enumerate(sums):
        places = np.flatnonzero(program.group == g)
        row[places[np.argmax(program.floor[places])]] += np.max(sums) - own
    size, most = np.abs(multipliers.term), row[program.row]
    term = multipliers.term * np.where(size > most, most / np.where(size > 0, size, 1.0), 1.0)
    return row, program.norms.counting(term), program.ceilings.norms.counting(multipliers.ceiling)


def _lowest(program: Statement, row: Real, term: Complex, ceiling: Complex, cap: Real, mass_cost: float) -> float:
    """Least over the limits of mass_cost m + sum_r lam_r floor_r + sum_j Re(conj(y_j) a_j) + ...; a knapsack."""
    y, limits = np.concatenate([term, ceiling]), program.limits
    constant = np.sum(row * program.floor) + np.sum((np.conj(y) * program.every_constant).real)
    constant -= np.sum(np.abs(ceiling) * cap)
    slope = np.sum(np.conj(program.every_influence) * y.astype(np.clongdouble)[:, None], axis=0).astype(complex)
    norms, limited = program.norms, program.ceilings.norms
    spread = norms.scatter * (row[program.row] @ np.abs(norms.influence))
    spread = spread + limited.scatter * (np.abs(ceiling) @ np.abs(limited.influence))
    if limits.alike is not None:
        owner = limits.alike.owner
        spread = np.array([np.mean(spread[owner == own]) for own in owner])
    gain = limits.radius * (limits.support(-slope) - spread) - mass_cost
    left, gained = float(limits.max_total_mass), 0.0
    for k in np.argsort(-gain, kind="stable"):
        mass = min(limits.max_mass[k], left)
        gained, left = gained + max(gain[k], 0.0) * mass, left - mass
    return float(constant - gained)


def points(program: Statement, u: Complex) -> list[Real]:
    """As ``points_at``: objective, mass, excess, rounding."""
    over = program.ceilings.excess(u)
    excess = np.max(over, axis=-1, initial=-np.inf)
    return [program.objective(u), program.mass(u), excess, program.rounding(u)]


def into(limits: Limits, u: Complex) -> Complex:
    """As ``Limits.into``: alike, then into sectors, then no longer than may be, then within the budget."""
    u = u if limits.alike is None else limits.alike.nearest(u)
    v = u * np.conj(limits.centre)
    edge = limits.half_angle_cos + 1j * np.where(v.imag < 0, -1.0, 1.0) * limits.half_angle_sin
    along = np.maximum((v * np.conj(edge)).real, 0.0)
    inside = limits.free | (np.abs(v.imag) * limits.half_angle_cos <= v.real * limits.half_angle_sin)
    u = np.where(inside, u, along * edge * limits.centre)
    u = u * np.minimum(limits.reach / np.where(u != 0, np.abs(u), 1.0), 1.0)
    mass = np.sum(np.abs(u) / limits.radius, axis=-1, keepdims=True)
    return u * np.minimum(limits.max_total_mass / np.where(mass > 0, mass, 1.0), 1.0)


def near_limits(program: Statement, u: Complex, dust: float, touched: float) -> Complex:
    """As the first step of ``settled``: what is near to nothing or to a limit there, and the others made up for it."""
    limits, influence = program.limits, program.every_influence
    size = np.abs(u)
    mass = size / limits.radius
    none = (mass > 0) & (mass <= dust * np.max(mass))
    next_to = mass >= limits.max_mass * (1.0 - touched)
    put = np.where(none, 0.0, u)
    full = ~none & next_to & (mass < limits.max_mass)
    put = np.where(full, limits.radius * limits.max_mass / np.where(full, size, 1.0) * u, put)
    v = u * np.conj(limits.centre)
    inwards = v.real * limits.half_angle_sin - np.abs(v.imag) * limits.half_angle_cos
    edge = ~none & ~limits.free & (size > 0) & (inwards <= touched * limits.half_angle_sin * size)
    side = limits.half_angle_cos + 1j * np.copysign(limits.half_angle_sin, v.imag)
    put = np.where(edge, np.abs(put) * side * limits.centre, put)
    if np.array_equal(put, u):
        return u
    room, left = np.where(none | edge | next_to, 0.0, size), influence @ (put - u)
    if limits.alike is None:
        change = room * _least(influence * room, left)
    else:
        first = np.eye(len(room))[:, limits.alike.first] * room[limits.alike.first]
        ways = [influence @ limits.alike.carried(part * first.T[:, limits.alike.first]).T for part in (1.0, 1j)]
        both = np.hstack(ways)
        parts = _least(np.vstack([both.real, both.imag]), np.hstack([left.real, left.imag]))
        along, across = np.split(parts.real, 2)
        change = limits.alike.carried(room[limits.alike.first] * (along + 1j * across))
    return into(limits, put + change)


def _least(influence: Complex | Real, left: Complex | Real) -> Complex:
    """What takes back as much as can be, row after row, each by the least change that leaves those before it alone."""
    values, before = np.zeros(influence.shape[1], complex), np.zeros((0, influence.shape[1]), complex)
    for row, rest in zip(influence.astype(complex), left, strict=True):
        size = np.max(np.abs(row))
        if size > 0:
            apart = row / size - before.T @ (np.conj(before) @ (row / size))
            length = np.linalg.norm(apart)
            if length > 1e-13:
                values -= np.conj(apart) / length * ((rest + row @ values) / size / length)
                before = np.vstack([before, apart / length])
    return values
