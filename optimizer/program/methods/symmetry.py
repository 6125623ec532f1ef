"""The most symmetric of equally good counterweights: the mean over what leaves the program as it is.

Such a symmetry sends the unbalances to g u_p(k), or to their mirror images g conj(u)_p(k), with a permutation p of the
webs and a turn g. These are sought among webs in one place, from end to end, and at the plane in which everything
stands. Every term keeps its size and every counterweight its mass. Sizes are convex, so no term of the mean is larger,
and neither is the mass (docs/mathematics.md section 9).
"""

from functools import cache, lru_cache
from types import ModuleType

import numpy as np

from optimizer.numerics.arrays import Complex, in_order
from optimizer.program.equal_unknowns import apart, united
from optimizer.program.statement import Statement


def symmetric(statement: Statement, u: Complex, kinds: np.ndarray | None = None) -> Complex:
    """Counterweights that are no worse in any term, no heavier, and alike where the program is.

    Parameters
    ----------
    statement : programs of one leading axis (N,).
    u : (N, K) kg m, within the limits.
    kinds : (K,) webs of different numbers are never alike, whatever their limits; None where the limits tell all.
    """
    alike = statement.limits.alike
    if alike is not None and not alike.plain:
        return u
    if alike is not None:
        of_units = None if kinds is None else kinds[alike.first]
        return apart(symmetric(united(statement, alike), alike.means(u) * alike.count, of_units), alike)
    if u.shape[-1] < 2 or not u.size or statement.norms.is_complex or statement.ceilings.norms.is_complex:
        return u
    programs, region = statement.flat.programs, statement.flat.programs.region
    _, terms, webs = programs.influence.shape
    means: Complex = np.array(u, complex, order="C")
    _symmetries().means(
        programs.constant,
        programs.influence,
        region.radius,
        region.max_mass,
        region.free,
        region.centre,
        region.sine,
        _single_kind(webs) if kinds is None else kinds.astype(np.int64),
        in_order(u),
        *_work(terms, webs),
        means,
    )
    return means


@lru_cache(maxsize=64)
def _single_kind(webs: int) -> np.ndarray:
    """That all are of one kind (K,); nobody writes to it."""
    return np.zeros(webs, np.int64)


# the kernel writes to it and leaves nothing there
@lru_cache(maxsize=64)
def _work(terms: int, webs: int) -> tuple[np.ndarray, ...]:
    """Memory of the kernel, in its order."""
    numbers, own, places = np.empty((terms + 2, webs)), np.empty((2, terms)), np.empty((5, webs), np.int64)
    return (
        numbers[:terms], own[0], own[1], np.empty(terms, bool), numbers[terms], numbers[terms + 1],
        np.empty(webs, complex), places[0], places[1:3], places[3:],
    )  # fmt: skip


# loads the compiler, a tenth of a second, and so at the first call; an import at each takes as long as a short loop
@cache
def _symmetries() -> ModuleType:
    from optimizer.program.kernel import symmetries

    return symmetries
