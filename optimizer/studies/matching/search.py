"""Good assignments: swaps from many starts, all starts side by side, and then two swaps at once."""

import numpy as np

from optimizer.numerics.arrays import Complex, Real
from optimizer.studies.matching.bound import sorted_masses
from optimizer.studies.matching.problem import Minorants, Problem

_STARTS = 30
_ROUNDS = 60
#: numbers that a round of all starts may hold, and numbers that all rounds may come to
_NUMBERS = 2_000_000
_WORK = 40_000_000
#: pairs of which all pairs are tried
_PAIRS = 400
_SEED = 17


def searched(problem: Problem, minorants: Minorants, seeds: Real) -> Real:
    """Assignments (S, T), masses at places, that no swap of two parts makes better; the best first.

    Parameters
    ----------
    seeds : (N, T) assignments to begin with.
    """
    pairs = _pairs(problem)
    numbers = max(pairs.shape[1] * problem.start.size, 1)
    starts = int(np.clip(_NUMBERS // numbers, len(seeds) + 1, _STARTS))
    mass = np.concatenate([seeds, *_starts(problem, starts - len(seeds))])
    if pairs.shape[1]:
        mass = _swapped(problem, minorants, mass, pairs, int(np.clip(_WORK // (numbers * starts), 4, _ROUNDS)))
    mass = mass[np.argsort(minorants.at(problem.vectors(mass)), kind="stable")]
    if 1 < pairs.shape[1] <= _PAIRS:
        mass[0] = _doubly_swapped(problem, minorants, mass[0], pairs)
    return mass


def _pairs(problem: Problem) -> np.ndarray:
    """Two places of one class (2, P)."""
    results = [np.stack(np.triu_indices(part.stop - part.start, 1)) + part.start for part in problem.slices]
    return np.concatenate(results, axis=1)


def _starts(problem: Problem, count: int) -> list[Real]:
    """Assignments (1, T): sorted along the vectors as they are listed, and by chance."""
    input_order = problem.input_order
    results = [sorted_masses(problem, problem.vectors(input_order))[None]]
    rng = np.random.default_rng(_SEED)
    results += [
        np.concatenate([rng.permutation(input_order[part]) for part in problem.slices])[None] for _ in range(count - 1)
    ]
    return results[:count]


def _swapped(problem: Problem, minorants: Minorants, mass: Real, pairs: np.ndarray, rounds: int) -> Real:
    """Every assignment (S, T) as long as a swap makes it better, the best swap of a round."""
    i, k = pairs
    place = problem.of_place
    change = (place[:, i] - place[:, k]).T
    going = np.arange(len(mass))
    for _ in range(rounds):
        now = mass[going]
        v = problem.vectors(now)
        value = minorants.at(v)
        values = minorants.at(v[:, None, :] + (now[:, k] - now[:, i])[..., None] * change)
        best = np.argmin(values, axis=1)
        better = values[np.arange(best.size), best] < value
        going, best = going[better], best[better]
        if not going.size:
            break
        mass[going, i[best]], mass[going, k[best]] = mass[going, k[best]], mass[going, i[best]]
    return mass


def _doubly_swapped(problem: Problem, minorants: Minorants, mass: Real, pairs: np.ndarray) -> Real:
    """One assignment (T,) as long as two swaps at once of four different parts make it better."""
    i, k = pairs
    place = problem.of_place
    change: Complex = (place[:, i] - place[:, k]).T
    touches = np.zeros((i.size, mass.size), bool)
    touches[np.arange(i.size), i] = touches[np.arange(i.size), k] = True
    swap, second = np.nonzero(np.triu(touches.astype(int) @ touches.T.astype(int) == 0, 1))
    mass = mass.copy()
    for _ in range(_ROUNDS):
        v = problem.vectors(mass)
        shift = (mass[k] - mass[i])[:, None] * change
        values = minorants.at(v + shift[swap] + shift[second]) if swap.size else np.array([np.inf])
        best = int(np.argmin(values))
        if not values[best] < minorants.at(v):
            break
        for pair in (swap[best], second[best]):
            mass[i[pair]], mass[k[pair]] = mass[k[pair]], mass[i[pair]]
    return mass
