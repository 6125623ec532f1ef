"""The mean of counterweights over the symmetries of their program, compiled:
:mod:`optimizer.program.methods.symmetry`."""

from typing import NamedTuple

import numpy as np

from optimizer.numerics.arrays import Complex, Real
from optimizer.program.kernel.compiling import inner, kernel
from optimizer.program.kernel.lengths import length

#: data that agree this closely, relative, are the same
_SAME = 1e-12
#: a constant that is smaller than this share of what counterweights do to its term is none
_NOTHING = 1e-13
#: by which sizes may differ: rounding
_ROUNDING = 32 * float(np.finfo(float).eps)


class Alike(NamedTuple):
    """Limits of N programs by which webs are told apart, as in :class:`optimizer.program.limits.Limits`."""

    radius: Real  # (N, K)
    max_mass: Real  # (N, K)
    free: np.ndarray  # (N, K) bool
    centre: Complex  # (N, K)
    half_angle_sin: Real  # (N, K)


@kernel
def means(constant, influence, limits, kinds, u):  # type: ignore[no-untyped-def]
    """The mean of every program over its symmetries, and what it was where that is worse.

    Parameters
    ----------
    constant, influence : (N, Q) and (N, Q, K) of all that has a size.
    limits : Alike.
    kinds : (K,) webs of different numbers are never alike.
    u : (N, K) kg m.
    """
    number, terms, webs = influence.shape
    found = u.copy()
    relative, level = np.empty((terms, webs)), np.empty(terms)
    image = np.empty((webs, webs), np.bool_)
    own, counts, moved = np.empty(webs), np.empty(terms, np.bool_), np.empty(webs, np.complex128)
    ones = np.empty(terms)
    for q in range(terms):
        ones[q] = 1.0
    for n in range(number):
        _scaled(influence[n], relative, level)
        # most programs have hardly any, which is told at little cost
        straight = _partners(relative, ones, limits, kinds, n)
        turned_round = _partners(relative, level, limits, kinds, n)
        counted, changed = False, False
        for symmetry in range(4):
            # straight or from end to end, as they are or as mirror images
            signs = level if symmetry % 2 else ones
            least, most = turned_round if symmetry % 2 else straight
            if least == 0 or (symmetry == 0 and most == 1):
                for k in range(webs):
                    own[k] = 1.0 if symmetry == 0 else own[k]
                continue
            if not counted:
                counted = True
                for q in range(terms):
                    counts[q] = abs(constant[n, q]) > _NOTHING * _done(influence[n, q], u[n])
            turn, known = _turn(constant[n], counts, signs, symmetry > 1)
            _images(relative, signs, limits, kinds, n, turn, symmetry > 1, symmetry % 2 == 0 and most == 1, image)
            for k in range(webs):
                count = 0.0
                moved[k] = 0.0
                for other in range(webs):
                    if image[k, other]:
                        count += 1.0
                        moved[k] += np.conj(found[n, other]) if symmetry > 1 else found[n, other]
                if symmetry == 0:
                    own[k] = count
                known = known and count == own[k]
                moved[k] = turn * moved[k] / max(count, 1.0)
            if known:
                for k in range(webs):
                    found[n, k] = moved[k] if symmetry == 0 else 0.5 * (found[n, k] + moved[k])
                    changed = changed or found[n, k] != u[n, k]
        if changed and _worse(constant[n], influence[n], limits.radius[n], u[n], found[n]):
            for k in range(webs):
                found[n, k] = u[n, k]
    return found


@inner
def _scaled(influence, relative, level):  # type: ignore[no-untyped-def]
    """Influences (Q, K) in units of the largest of their term; -1 where they depend on the place of the web, else 1."""
    terms, webs = influence.shape
    for q in range(terms):
        size = 0.0
        for k in range(webs):
            size = max(size, abs(influence[q, k]))
        level[q] = 1.0
        for k in range(webs):
            relative[q, k] = influence[q, k] / (size if size > 0.0 else 1.0)
        for k in range(webs):
            # from end to end what depends on the place changes its sign
            if not abs(relative[q, k] - relative[q, 0]) <= _SAME:
                level[q] = -1.0


@inner
def _close(first, second):  # type: ignore[no-untyped-def]
    return first == second or abs(first - second) <= _SAME * abs(first)


@inner
def _same_limits(limits, kinds, n, k, other):  # type: ignore[no-untyped-def]
    """Whether two webs of program n have one radius, one largest mass and are of one kind."""
    return (
        kinds[k] == kinds[other]
        and _close(limits.radius[n, k], limits.radius[n, other])
        and _close(limits.max_mass[n, k], limits.max_mass[n, other])
    )


@inner
def _partners(relative, signs, limits, kinds, n):  # type: ignore[no-untyped-def]
    """How many webs are alike and have the influences of a web with these signs, itself among them, at least and at
    most."""
    terms, webs = relative.shape
    least, most = webs, 0
    for k in range(webs):
        count = 0
        for other in range(webs):
            # the last, a moment, tells most apart
            q = terms
            while q > 0 and abs(relative[q - 1, k] - signs[q - 1] * relative[q - 1, other]) <= _SAME:
                q -= 1
            if q == 0 and _same_limits(limits, kinds, n, k, other):
                count += 1
        least, most = min(least, count), max(most, count)
        if least == 0:
            break
    return least, most


@inner
def _images(relative, signs, limits, kinds, n, turn, mirrored, alone, image):  # type: ignore[no-untyped-def]
    """Which webs k may take what another has, turned or mirrored, and have its influences with these signs.

    Parameters
    ----------
    alone : no web has the influences of another.
    """
    terms, webs = relative.shape
    for k in range(webs):
        for other in range(webs):
            # most webs are told apart by what they do
            same = k == other or not alone
            for q in range(terms):
                same = same and abs(relative[q, k] - signs[q] * relative[q, other]) <= _SAME
            same = same and limits.free[n, k] == limits.free[n, other] and _same_limits(limits, kinds, n, k, other)
            if same and not limits.free[n, k]:
                there = np.conj(limits.centre[n, other]) if mirrored else limits.centre[n, other]
                apart = abs(limits.centre[n, k] - turn * there)
                opened = abs(limits.half_angle_sin[n, k] - limits.half_angle_sin[n, other])
                same = apart <= _SAME and opened <= _SAME
            image[k, other] = same


@inner
def _turn(constant, counts, signs, mirrored):  # type: ignore[no-untyped-def]
    """The turn that makes of every constant (Q,), times its sign, or of its mirror image, itself; and if there is one.

    Parameters
    ----------
    counts : (Q,) constants that are not 0.
    """
    turn, known = 1.0 + 0.0j, False
    for q in range(constant.size):
        if counts[q]:
            wanted = signs[q] + 0.0j
            if mirrored:
                unit = constant[q] / abs(constant[q])
                wanted = signs[q] * (unit * unit)
            if not known:
                turn, known = wanted, True
            elif not abs(wanted - turn) <= _SAME:
                return 1.0 + 0.0j, False
    return turn, known


@inner
def _size(constant, influence, u):  # type: ignore[no-untyped-def]
    """Size of a term c + H u."""
    vector = 0.0j
    for k in range(u.size):
        vector += influence[k] * u[k]
    return length(constant + vector)


@inner
def _done(influence, u):  # type: ignore[no-untyped-def]
    """What counterweights do to a term, one by one."""
    done = 0.0
    for k in range(u.size):
        done += abs(influence[k]) * length(u[k])
    return done


@inner
def _worse(constant, influence, radius, u, candidate):  # type: ignore[no-untyped-def]
    """Whether a term is larger than it was, or the mass, by more than rounding."""
    for q in range(constant.size):
        allowed = _ROUNDING * (_done(influence[q], candidate) + abs(constant[q]))
        if not _size(constant[q], influence[q], candidate) <= _size(constant[q], influence[q], u) + allowed:
            return True
    mass, before = 0.0, 0.0
    for k in range(u.size):
        mass += length(candidate[k]) / radius[k]
        before += length(u[k]) / radius[k]
    return not mass <= before * (1.0 + _ROUNDING)
