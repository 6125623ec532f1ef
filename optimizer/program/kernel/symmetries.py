"""The mean of counterweights over the symmetries of their program, compiled:
:mod:`optimizer.program.methods.symmetry`."""

from typing import NamedTuple

import numpy as np

from optimizer.numerics.arrays import Complex, Real
from optimizer.program.kernel.compiling import in_place, inner
from optimizer.program.kernel.lengths import length

#: data that agree this closely, relative, are the same
_SAME = 1e-12
#: a constant that is smaller than this share of what counterweights do to its term is none
_NOTHING = 1e-13
#: by which sizes may differ: rounding
_ROUNDING = 32 * float(np.finfo(float).eps)


class Alike(NamedTuple):
    """Limits of N programs that distinguish webs, as in :class:`optimizer.program.limits.Limits`."""

    radius: Real  # (N, K)
    max_mass: Real  # (N, K)
    free: np.ndarray  # (N, K) bool
    centre: Complex  # (N, K)
    half_angle_sin: Real  # (N, K)


@in_place
def means(  # type: ignore[no-untyped-def]
    constant,
    influence,
    radius,
    max_mass,
    free,
    centre,
    half_angle_sin,
    kinds,
    u,
    relative,
    level,
    ones,
    counts,
    along,
    own,
    image,
    order,
    begin,
    end,
    middle,
):
    """The mean of every program over its symmetries, and what it was where that is worse.

    Parameters
    ----------
    constant, influence : (N, Q) and (N, Q, K) of all that has a size.
    radius, max_mass, free, centre, half_angle_sin : (N, K) as of :class:`Alike`.
    kinds : (K,) webs of different numbers are never alike.
    u : (N, K) kg m.
    relative, level, ones, counts : (Q, K), (Q,), (Q,) and (Q,) bool, memory to be written to, as is the next.
    along, own, image, order, begin, end : (K,), (K,), (K,) complex, (K,) and (2, K), (2, K) integers.
    middle : (N, K) the same as u, to be written to.
    """
    number, terms, webs = influence.shape
    limits = Alike(radius, max_mass, free, centre, half_angle_sin)
    for q in range(terms):
        ones[q] = 1.0
    for n in range(number):
        _scaled(influence[n], relative, level)
        # most programs have hardly any symmetry, and this check is cheap
        _in_line(relative, level, order, along)
        straight, reversal = (1, 1), (0, 0)
        if not _apart(along):
            _ranges(order, along, 1.0, begin[0], end[0])
            straight = _partners(relative, ones, limits, kinds, n, order, begin[0], end[0])
        else:
            for place in range(webs):
                begin[0, order[place]], end[0, order[place]] = place, place + 1
        # the web at either end has an image at the other
        if not abs(along[0] + along[webs - 1]) > 2.0 * _SAME:
            _ranges(order, along, -1.0, begin[1], end[1])
            reversal = _partners(relative, level, limits, kinds, n, order, begin[1], end[1])
        has_counts, changed = False, False
        for symmetry in range(4):
            # straight or from end to end, as they are or as mirror images
            signs = level if symmetry % 2 else ones
            least, most = reversal if symmetry % 2 else straight
            if least == 0 or (symmetry == 0 and most == 1):
                for k in range(webs):
                    own[k] = 1.0 if symmetry == 0 else own[k]
                continue
            if not has_counts:
                has_counts = True
                for q in range(terms):
                    counts[q] = abs(constant[n, q]) > _NOTHING * _effect_size(influence[n, q], u[n])
            turn, success = _turn(constant[n], counts, signs, symmetry > 1)
            if not success and symmetry > 0:
                continue
            first, last = begin[symmetry % 2], end[symmetry % 2]
            for k in range(webs):
                count = 0.0
                image[k] = 0.0
                for i in range(first[k], last[k]):
                    partner = order[i]
                    if _is_image(relative, signs, limits, kinds, n, turn, symmetry > 1, k, partner):
                        count += 1.0
                        image[k] += np.conj(middle[n, partner]) if symmetry > 1 else middle[n, partner]
                if symmetry == 0:
                    own[k] = count
                success = success and count == own[k]
                image[k] = turn * image[k] / max(count, 1.0)
            if success:
                for k in range(webs):
                    middle[n, k] = image[k] if symmetry == 0 else 0.5 * (middle[n, k] + image[k])
                    changed = changed or middle[n, k] != u[n, k]
        if changed and _worse(constant[n], influence[n], limits.radius[n], u[n], middle[n]):
            for k in range(webs):
                middle[n, k] = u[n, k]


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
def _same_limits(limits, kinds, n, k, partner):  # type: ignore[no-untyped-def]
    """Whether two webs of program n have one radius, one largest mass and are of one kind."""
    return (
        kinds[k] == kinds[partner]
        and _close(limits.radius[n, k], limits.radius[n, partner])
        and _close(limits.max_mass[n, k], limits.max_mass[n, partner])
    )


@inner
def _in_line(relative, level, order, along):  # type: ignore[no-untyped-def]
    """Webs in rising order of what tells most of them apart, the last influence that depends on the place of the web.

    Parameters
    ----------
    order, along : (K,) webs, and these influences, to be written to; all 0 if webs are indistinguishable.
    """
    terms, webs = relative.shape
    by = -1
    for q in range(terms):
        by = q if level[q] < 0.0 else by
    for k in range(webs):
        value, i = relative[by, k] if by >= 0 else 0.0, k
        # most machines have their webs in order already
        while i > 0 and along[i - 1] > value:
            order[i], along[i] = order[i - 1], along[i - 1]
            i -= 1
        order[i], along[i] = k, value


@inner
def _apart(along):  # type: ignore[no-untyped-def]
    """Whether no web in the line is an image of another, for all that rounding may do to their places."""
    apart = True
    for i in range(1, along.size):
        apart = apart and along[i] - along[i - 1] > 3.0 * _SAME
    return apart


@inner
def _ranges(order, along, sign, begin, end):  # type: ignore[no-untyped-def]
    """Places in the line (K,) of the first web that a web may be an image of, and of the one after the last."""
    webs = order.size
    first, last = 0, 0
    for i in range(webs):
        place = i if sign > 0.0 else webs - 1 - i
        target = sign * along[place]
        while first < webs and along[first] < target - 2.0 * _SAME:
            first += 1
        while last < webs and along[last] <= target + 2.0 * _SAME:
            last += 1
        begin[order[place]], end[order[place]] = first, last


@inner
def _alike(relative, signs, limits, kinds, n, k, partner):  # type: ignore[no-untyped-def]
    """Whether two webs of program n are alike, and have the same influences with these signs."""
    same = True
    for q in range(relative.shape[0]):
        same = same and abs(relative[q, k] - signs[q] * relative[q, partner]) <= _SAME
    return same and _same_limits(limits, kinds, n, k, partner)


@inner
def _partners(relative, signs, limits, kinds, n, order, begin, end):  # type: ignore[no-untyped-def]
    """How many webs are alike and have the influences of a web with these signs, itself among them, at least and at
    most."""
    webs = order.size
    least, most = webs, 0
    for k in range(webs):
        count = 0
        for i in range(begin[k], end[k]):
            count += 1 if _alike(relative, signs, limits, kinds, n, k, order[i]) else 0
        least, most = min(least, count), max(most, count)
        if least == 0:
            break
    return least, most


@inner
def _is_image(relative, signs, limits, kinds, n, turn, mirrored, k, partner):  # type: ignore[no-untyped-def]
    """Whether web k may take what another has, turned or mirrored, and has its influences with these signs."""
    if not _alike(relative, signs, limits, kinds, n, k, partner) or limits.free[n, k] != limits.free[n, partner]:
        return False
    if limits.free[n, k]:
        return True
    there = np.conj(limits.centre[n, partner]) if mirrored else limits.centre[n, partner]
    apart = abs(limits.centre[n, k] - turn * there)
    return apart <= _SAME and abs(limits.half_angle_sin[n, k] - limits.half_angle_sin[n, partner]) <= _SAME


@inner
def _turn(constant, counts, signs, mirrored):  # type: ignore[no-untyped-def]
    """The turn that makes of every constant (Q,), times its sign, or of its mirror image, itself; and if there is one.

    Parameters
    ----------
    counts : (Q,) constants that are not 0.
    """
    turn, success = 1.0 + 0.0j, False
    for q in range(constant.size):
        if counts[q]:
            quotient = signs[q] + 0.0j
            if mirrored:
                size = abs(constant[q])
                unit = complex(constant[q].real / size, constant[q].imag / size)
                quotient = signs[q] * (unit * unit)
            if not success:
                turn, success = quotient, True
            elif not abs(quotient - turn) <= _SAME:
                return 1.0 + 0.0j, False
    return turn, success


@inner
def _size(constant, influence, u):  # type: ignore[no-untyped-def]
    """Size of a term c + H u."""
    vector = 0.0j
    for k in range(u.size):
        vector += influence[k] * u[k]
    return length(constant + vector)


@inner
def _effect_size(influence, u):  # type: ignore[no-untyped-def]
    """What counterweights do to a term, one by one."""
    size = 0.0
    for k in range(u.size):
        size += abs(influence[k]) * length(u[k])
    return size


@inner
def _worse(constant, influence, radius, u, candidate):  # type: ignore[no-untyped-def]
    """Whether a term is larger than it was, or the mass, by more than rounding."""
    for q in range(constant.size):
        allowed = _ROUNDING * (_effect_size(influence[q], candidate) + abs(constant[q]))
        if not _size(constant[q], influence[q], candidate) <= _size(constant[q], influence[q], u) + allowed:
            return True
    mass, before = 0.0, 0.0
    for k in range(u.size):
        mass += length(candidate[k]) / radius[k]
        before += length(u[k]) / radius[k]
    return not mass <= before * (1.0 + _ROUNDING)
