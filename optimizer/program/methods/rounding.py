"""Counterweights that nearly vanish, or nearly touch a limit, exactly there: no dust, and limits to the last digit.

An interior point ends inside all limits. What is small beside the other counterweights is taken away, what is next to
a limit is put there, and the counterweights between their limits make up for it: by the least change, relative to
their size, that leaves every term of the objective and every response under a ceiling as it was.
"""

import numpy as np

from optimizer.numerics.arrays import Complex, Real, mapped
from optimizer.program.equal_castings import Alike
from optimizer.program.limits import Limits
from optimizer.program.points import Points, points_at
from optimizer.program.scaling import least_change
from optimizer.program.solution import CEILING_ROUNDING
from optimizer.program.statement import Statement

#: how near to nothing, or to a limit, as a share of the largest mass or of the limit: the next where one is too much
NEAR = (1e-4, 1e-6, 1e-8)
#: one after the other: of dust, of limits, and the next one where that did no harm, or nothing
_RUNGS = np.array(
    [
        (NEAR[0], NEAR[0], 2 * len(NEAR)),
        *((dust, 0.0, len(NEAR)) for dust in NEAR[1:]),
        *((0.0, touched, 2 * len(NEAR)) for touched in NEAR),
    ]
)
#: relative gap of the least mass that may be left
HEAVIER = 1e-5


def settled(statement: Statement, points: Points, target: Real, mass_bound: Real | None) -> Points:
    """The same without dust, and at the limits that they touch, where they are no worse for it.

    Parameters
    ----------
    statement : programs of one leading axis (N,).
    points : within the limits.
    target : (N,) largest objective of an optimum; the points may be above it.
    mass_bound : (N,) kg, no optimum is lighter; None where the mass does not count.
    """
    heaviest = np.full(target.shape, np.inf) if mass_bound is None else mass_bound / (1.0 - HEAVIER)
    flat = statement.flat
    if flat is not None and flat.leading == target.shape:
        u, found = points.unbalance.copy(), np.array(points[1:])
        flat.settle(u, found, target, heaviest, CEILING_ROUNDING, _RUNGS)
        return Points(u, *found)
    every = np.arange(target.size)

    def attempt(points: Points, programs: np.ndarray, dust: float, touched: float) -> tuple[Points, np.ndarray]:
        part = statement if programs is every else statement.chosen(programs)
        old = points if programs is every else points.chosen(programs)
        unbalance, moved = brought(part.limits, part.every_influence, old.unbalance, dust, touched)
        if not moved.size:
            return points, moved
        new = points_at(part, unbalance)
        kept = new.objective <= np.maximum(target[programs], old.objective) + new.rounding
        kept &= new.excess <= np.maximum(old.excess, CEILING_ROUNDING)
        kept &= new.mass <= np.maximum(old.mass, heaviest[programs])
        return points.put(programs, new.where(kept, old)), programs[moved][~kept[moved]]

    points, undone = attempt(points, every, NEAR[0], NEAR[0])
    for ladder in ([(dust, 0.0) for dust in NEAR[1:]], [(0.0, touched) for touched in NEAR]):
        left = undone
        for dust, touched in ladder:
            if left.size:
                points, left = attempt(points, left, dust, touched)
    return points


def dust(mass: Real) -> np.ndarray:
    """Which masses (..., K) are next to nothing beside the largest of theirs (..., K) bool."""
    most = np.maximum.reduce(mass, axis=-1, keepdims=True, initial=0.0)
    return np.asarray((mass > 0) & (mass <= NEAR[0] * most))


def has_dust(limits: Limits, u: Complex) -> np.ndarray:
    """Whether some counterweights (..., K) kg m are next to nothing beside the largest of theirs (...)."""
    return np.asarray(dust(np.abs(u) / limits.radius).any(axis=-1))


def brought(
    limits: Limits, influence: Real | Complex, u: Complex, dust: float, touched: float
) -> tuple[Complex, np.ndarray]:
    """The points within the limits where all that is near enough is settled, and the programs (n,) that differ.

    Parameters
    ----------
    influence : (N, J, K) on what is to stay as it is.
    u : (N, K) kg m.
    dust : share of the largest mass that is next to nothing.
    touched : share of a limit that is next to it.
    """
    size = np.abs(u)
    mass = size / limits.radius
    none = (mass > 0) & (mass <= dust * np.maximum.reduce(mass, axis=-1, keepdims=True, initial=0.0))
    next_to = mass >= limits.max_mass * (1.0 - touched)
    full = ~none & next_to & (mass < limits.max_mass)
    put = np.where(none, 0.0, u)
    put = np.where(full, limits.radius * limits.max_mass / np.where(full, size, 1.0) * u, put)
    edge = np.zeros_like(none)
    if not limits.free.all():
        edge = ~none & at_edge(limits, u, touched)
        side = limits.half_angle_cos + 1j * np.copysign(limits.half_angle_sin, (u * np.conj(limits.centre)).imag)
        put = np.where(edge, np.abs(put) * side * limits.centre, put)
    moved = np.flatnonzero((put != u).any(axis=-1))
    if not moved.size:
        return u, moved
    between = np.where(none | edge | next_to, 0.0, size)
    part = slice(None) if moved.size == len(u) else moved
    change = np.add.reduce(influence[part] * (put - u)[part][:, None, :], axis=-1)
    within = mapped(limits, lambda array: array[part])
    put[part] += made_up(within.alike, influence[part], between[part], change)
    put[part] = within.into(put[part])
    return put, moved


def at_edge(limits: Limits, u: Complex, touched: float) -> np.ndarray:
    """Which counterweights (..., K) kg m are next to an edge of their sector (..., K) bool."""
    v, size = u * np.conj(limits.centre), np.abs(u)
    inwards = v.real * limits.half_angle_sin - np.abs(v.imag) * limits.half_angle_cos
    return np.asarray(~limits.free & (size > 0) & (inwards <= touched * limits.half_angle_sin * size))


def made_up(alike: Alike | None, influence: Real | Complex, room: Real, change: Complex) -> Complex:
    """The least change (N, K), relative to a room (N, K), that takes back a change (N, J); of alike webs alike."""
    if alike is None:
        return room * least_change(influence * room[:, None, :], change)
    # mirror images are no complex multiples: in real and imaginary parts of what the first webs carry
    first: Complex = room[:, alike.first].astype(complex)
    parts = [alike.summed(influence * alike.carried(each)[:, None, :]) for each in (first, 1j * first)]
    both = np.concatenate(parts, axis=-1)
    rows, wanted = (np.concatenate([every.real, every.imag], axis=1) for every in (both, change))
    along, across = np.split(least_change(rows, wanted.astype(complex)).real, 2, axis=-1)
    found: Complex = first * (along + 1j * across)
    return alike.carried(found)
