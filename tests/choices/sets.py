"""Slots with options for random programs, and what trying every set comes to."""

from collections.abc import Sequence

import numpy as np

from optimizer.choices.discrete.options import Options
from optimizer.mechanics.angles import direction
from optimizer.numerics.arrays import Real
from optimizer.program.ceilings import CEILING_TOLERANCE
from optimizer.program.statement import Statement


def options_of(
    problem: Statement,
    masses_kg: Sequence[float],
    angles_deg: Sequence[float],
    most_fitted: int | None = None,
    most_parts: int | None = None,
) -> Options:
    """Nothing, or every mass that a web can carry at every angle from the middle of its sector."""
    limits, values = problem.limits, []
    for k in range(limits.radius.size):
        some = [(part, mass) for part, mass in enumerate(masses_kg) if mass <= limits.max_mass[k]]
        ways = limits.centre[k] * direction(np.array(angles_deg))
        held = [(-1, 0.0, 0j), *((part, mass, mass * limits.radius[k] * way) for part, mass in some for way in ways)]
        values.append(held)
    most = max(len(held) for held in values)
    filled = [held + [(-1, 0.0, 0j)] * (most - len(held)) for held in values]
    parts, masses, unbalances = (np.array([[entry[n] for entry in held] for held in filled]) for n in range(3))
    exists = np.arange(most) < np.array([len(held) for held in values])[:, None]
    return Options(unbalances, masses, parts, exists, most_fitted, most_parts)


def every_set(problem: Statement, options: Options) -> tuple[np.ndarray, Real]:
    """All sets (n, K) that keep every limit, one after the other as a loop would, and their objectives (n,)."""
    sets = np.stack(np.meshgrid(*[np.flatnonzero(some) for some in options.exists], indexing="ij"), axis=-1)
    sets = sets.reshape(-1, options.slots)
    mass = options.mass[np.arange(options.slots), sets]
    part = options.part[np.arange(options.slots), sets]
    mask = np.sum(mass, axis=-1) <= problem.limits.max_total_mass * (1.0 + 1e-12)
    if options.most_fitted is not None:
        mask &= np.count_nonzero(sets, axis=-1) <= options.most_fitted
    if options.most_parts is not None:
        used = sum((np.any(part == index, axis=-1).astype(int) for index in range(options.part.max() + 1)), start=0)
        mask &= used <= options.most_parts
    sets = sets[mask]
    u = options.unbalance[np.arange(options.slots), sets]
    within = np.all(problem.ceilings.excess(u) <= CEILING_TOLERANCE, axis=-1)
    return sets[within], problem.objective(u[within])
