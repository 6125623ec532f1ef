"""Sums of forces and of their couples: by arrays of one machine, by a compiled loop of many."""

import math
import sys
from collections.abc import Callable
from functools import cache
from operator import mul

import numpy as np

from optimizer.numerics.arrays import ROUNDING, SMALLEST, Complex, Real, in_order, spread, total

#: so many forces are a loop's work; of fewer the compiler is not loaded
MANY = 4096
#: terms up to which the loop adds in the order in which numpy does
_IN_ONE_ORDER = 64
#: so many terms numpy adds in pairs, and those from the next on one by one, if they are less than two times as many
_PAIRED = 4
#: so many lists of forces of one machine are summed sooner in plain numbers than by arrays
_FEW = 8


def force_and_couple(forces: Complex, arm: Real) -> tuple[Complex, Complex]:
    """Sum of forces and of their couples, at once: small sums cost by their number.

    Exactly zero where the terms cancel up to rounding, as of :func:`optimizer.numerics.arrays.total`.

    Parameters
    ----------
    forces : (..., n), or (..., m, n) beside arms (..., 1, n).
    arm : (..., n) m.

    Returns
    -------
    Two arrays (...), or (..., m).
    """
    if forces.ndim > 1 and forces.size >= MANY and forces.shape[-1] <= _IN_ONE_ORDER:
        return _in_a_loop(forces, arm)
    if arm.size <= _IN_ONE_ORDER and _single_machine(forces, arm):
        if _compiler_is_loaded():
            return _of_machine(forces, arm)
        if arm.size < 2 * _PAIRED and forces.size <= _FEW * arm.size:
            return _in_plain_numbers(forces, arm)
    couples = arm * forces
    terms = np.empty((2, *couples.shape), complex)
    terms[0], terms[1] = forces, couples
    sums = total(terms)
    # numbers where there are no more axes: arithmetic of arrays without axes takes several times as long
    return sums[0], sums[1]


def _single_machine(forces: Complex, arm: Real) -> bool:
    return arm.size == forces.shape[-1] and arm.ndim <= forces.ndim <= 2


def _compiler_is_loaded() -> bool:
    """Whether a loop is at hand: to load the compiler takes longer than an analysis that needs no other loop."""
    return "numba" in sys.modules


def _of_machine(forces: Complex, arm: Real) -> tuple[Complex, Complex]:
    """Those of one machine, (n,) or (m, n) beside arms (n,), by the loop: a fifth of the time of any other way."""
    vectors = in_order(forces)[None]
    if forces.ndim == 1:
        sums = np.empty((2, 1, 1), complex)
        _loop()(vectors[None], in_order(arm)[None], sums)
        return sums[0, 0, 0], sums[1, 0, 0]
    sums = np.empty((2, 1, vectors.shape[1]), complex)
    _loop()(vectors, in_order(arm).reshape(1, arm.size), sums)
    return sums[0, 0], sums[1, 0]


def _in_plain_numbers(forces: Complex, arm: Real) -> tuple[Complex, Complex]:
    """Those of one machine, (n,) or (m, n) beside arms (n,), in the order in which numpy adds: four terms in pairs."""
    arms = arm.ravel().tolist()
    count, alone = len(arms), forces.ndim == 1
    vectors: list[list[complex]] = [forces.tolist()] if alone else forces.tolist()
    sums: list[complex] = []
    for terms in (*vectors, *[list(map(mul, arms, own)) for own in vectors]):
        most = ROUNDING * sum(map(abs, terms))
        if count >= _PAIRED:
            terms = [(terms[0] + terms[1]) + (terms[2] + terms[3]), *terms[_PAIRED:]]
        value = sum(terms, 0j)
        size = abs(value)
        sums.append(0j if size <= most or size <= SMALLEST else value)
    pair = np.array(sums, complex)
    return (pair[0], pair[1]) if alone else (pair[: len(vectors)], pair[len(vectors) :])


def _in_a_loop(forces: Complex, arm: Real) -> tuple[Complex, Complex]:
    shape = np.broadcast_shapes(forces.shape, arm.shape)
    # forces of one machine beside one another have the same arms
    many = shape[-2] if arm.ndim == len(shape) and arm.shape[-2] == 1 else 1
    leading, terms = (shape[:-2] if many > 1 else shape[:-1]), shape[-1]
    number = math.prod(leading)
    columns = in_order(spread(forces, shape)).reshape(number, many, terms)
    arms = arm[..., 0, :] if many > 1 else arm
    own = in_order(spread(arms, (*leading, terms))).reshape(number, terms)
    sums = np.empty((2, number, many), complex)
    _loop()(columns, own, sums)
    pair = sums.reshape(2, *shape[:-1])
    return pair[0, ...], pair[1, ...]


# loads the compiler, a tenth of a second, and so at the first call; an import at each takes as long as a short loop
@cache
def _loop() -> Callable[..., None]:
    from optimizer.numerics.kernel.sums import force_and_couple as loop

    return loop
