"""The most symmetric of equally good counterweights: the mean over what leaves the program as it is.

Such a symmetry sends the unbalances to g u_p(k), or to their mirror images g conj(u)_p(k), with a permutation p of the
webs and a turn g: among webs in one place, from end to end, and at the plane in which everything stands. Every term
keeps its size and every counterweight its mass; sizes are convex, so that of the mean no term is larger, and neither is
the mass (docs/mathematics.md section 9).
"""

from typing import NamedTuple

import numpy as np

from optimizer.arrays import Complex, Real
from optimizer.program.limits import Limits
from optimizer.program.statement import Statement

#: data that agree this closely, relative, are the same
_SAME = 1e-12
#: a constant that is smaller than this share of what counterweights do to its term is none
_NOTHING = 1e-13
#: by which sizes may differ: rounding
_ROUNDING = 32 * np.finfo(float).eps
#: pairs of webs times terms that are compared at once, which bounds the memory
_AT_ONCE = 4_000_000


def symmetric(statement: Statement, u: Complex, kinds: np.ndarray | None = None) -> Complex:
    """Counterweights that are no worse in any term, no heavier, and alike where the program is.

    Parameters
    ----------
    statement : programs of one leading axis (N,).
    u : (N, K) kg m, within the limits.
    kinds : (K,) webs of different numbers are never alike, whatever their limits; None where the limits tell all.
    """
    influence = np.concatenate([statement.norms.influence, statement.ceilings.norms.influence], axis=-2)
    if u.shape[-1] < 2 or not u.size or np.iscomplexobj(influence):
        return u
    constant = np.concatenate([statement.norms.constant, statement.ceilings.norms.constant], axis=-1)
    step = max(1, _AT_ONCE // (influence.shape[-2] * u.shape[-1] ** 2))
    parts = []
    for first in range(0, len(u), step):
        some = np.arange(first, min(first + step, len(u)))
        limits = statement.limits if some.size == len(u) else statement.chosen(some).limits
        parts.append(_mean(_Terms(constant[some], influence[some]), limits, u[some], kinds))
    return np.concatenate(parts)


class _Terms(NamedTuple):
    """What has a size, c + H u: terms of the objective and responses under ceilings."""

    constant: Complex  # (N, Q)
    influence: Real  # (N, Q, K)

    def sizes(self, u: Complex) -> Real:
        return np.abs(self.constant + np.sum(self.influence * u[..., None, :], axis=-1))

    def done(self, u: Complex) -> Real:
        """What counterweights do, one by one (N, Q)."""
        return np.sum(np.abs(self.influence) * np.abs(u)[..., None, :], axis=-1)


def _mean(terms: _Terms, limits: Limits, u: Complex, kinds: np.ndarray | None) -> Complex:
    scale = np.max(np.abs(terms.influence), axis=-1)
    relative = terms.influence / np.where(scale > 0, scale, 1.0)[..., None]
    # from end to end what depends on the place changes its sign
    level = np.all(np.abs(relative - relative[..., :1]) <= _SAME, axis=-1)
    straight, turned = np.ones(level.shape), np.where(level, 1.0, -1.0)
    alike = _alike(limits.radius) & _alike(limits.max_mass)
    if kinds is not None:
        alike &= kinds[:, None] == kinds
    counts = np.abs(terms.constant) > _NOTHING * terms.done(u)
    own = np.sum(alike & _to(relative, straight) & _in_sectors(limits, np.ones(len(u), complex), False), axis=-1)
    found = u
    for ends, mirrored in ((straight, False), (turned, False), (straight, True), (turned, True)):
        turn, known = _turn(terms.constant, counts, ends, mirrored)
        image = alike & _to(relative, ends) & _in_sectors(limits, turn, mirrored)
        count = np.sum(image, axis=-1)
        known &= np.all(count == own, axis=-1)
        if not np.any(known):
            continue
        from_there = np.conj(found) if mirrored else found
        moved = turn[:, None] * np.sum(image * from_there[:, None, :], axis=-1) / np.maximum(count, 1)
        mean = moved if ends is straight and not mirrored else 0.5 * (found + moved)
        found = np.where(known[:, None], mean, found)
    allowed = _ROUNDING * (terms.done(u) + np.abs(terms.constant))
    no_worse = np.all(terms.sizes(found) <= terms.sizes(u) + allowed, axis=-1)
    mass, before = (np.sum(np.abs(each) / limits.radius, axis=-1) for each in (found, u))
    no_worse &= mass <= before * (1.0 + _ROUNDING)
    return np.where(no_worse[:, None], found, u)


def _alike(values: Real) -> np.ndarray:
    """Which of (N, K) agree, (N, K, K)."""
    one, other = values[..., :, None], values[..., None, :]
    with np.errstate(invalid="ignore"):
        return (one == other) | (np.abs(one - other) <= _SAME * np.abs(one))


def _to(relative: Real, signs: Real) -> np.ndarray:
    """Which webs (N, K, K) have the influences of another with these signs (N, Q)."""
    same = np.abs(relative[..., :, None] - signs[..., None, None] * relative[..., None, :]) <= _SAME
    return np.all(same, axis=-3)


def _in_sectors(limits: Limits, turn: Complex, mirrored: bool) -> np.ndarray:
    """Whether a web (N, K, 1) may take what another (N, 1, K) may take, turned or mirrored."""
    if np.all(limits.free):
        return np.ones((*limits.free.shape, limits.free.shape[-1]), dtype=bool)
    there = np.conj(limits.centre) if mirrored else limits.centre
    apart = np.abs(limits.centre[..., :, None] - turn[..., None, None] * there[..., None, :])
    opened = np.abs(limits.half_angle_sin[..., :, None] - limits.half_angle_sin[..., None, :])
    both = limits.free[..., :, None] & limits.free[..., None, :]
    neither = ~limits.free[..., :, None] & ~limits.free[..., None, :]
    return both | (neither & (apart <= _SAME) & (opened <= _SAME))


def _turn(constant: Complex, counts: np.ndarray, signs: Real, mirrored: bool) -> tuple[Complex, np.ndarray]:
    """The turn g (N,) that makes of every constant, times its sign, or of its mirror image, itself; where there is one.

    Parameters
    ----------
    counts : (N, Q) constants that are not 0.
    """
    size = np.abs(constant)
    unit = np.where(counts, constant / np.where(size > 0, size, 1.0), 0.0)
    wanted = signs * (np.square(unit) if mirrored else np.where(counts, 1.0, 0.0))
    first = np.argmax(counts, axis=-1)[:, None]
    turn = np.take_along_axis(wanted, first, axis=-1)[:, 0].astype(complex)
    known = np.any(counts, axis=-1) & np.all(~counts | (np.abs(wanted - turn[:, None]) <= _SAME), axis=-1)
    return np.where(known, turn, 1.0), known
