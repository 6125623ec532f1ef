"""Counterweights without dust and at the limits that they touch, compiled:
:mod:`optimizer.program.methods.rounding`."""

import numpy as np

from optimizer.program.kernel.cancelling import change, change_of_real
from optimizer.program.kernel.compiling import folded, in_place
from optimizer.program.kernel.lengths import length
from optimizer.program.kernel.regions import into
from optimizer.program.kernel.values import value

#: passes; a number that is written out is a type of its own, for which all would be compiled once more
_ONCE = np.int64(1)


@folded
def copy(numbers, place):  # type: ignore[no-untyped-def]
    """Numbers (n,) in their place."""
    for k in range(place.size):
        place[k] = numbers[k]


@folded
def snap(u, dust, touched, region, n, room, new):  # type: ignore[no-untyped-def]
    """What is next to nothing, or to a limit, there (K,), and the room of the others (K,); whether anything was, and
    whether that was next to nothing."""
    most, is_new, dusty = 0.0, False, False
    for k in range(u.size):
        room[k] = length(u[k])
        most = max(most, room[k] / region.radius[n, k])
    for k in range(u.size):
        size, max_mass, sine = room[k], region.max_mass[n, k], region.sine[n, k]
        mass, new[k], edge = size / region.radius[n, k], u[k], False
        none = mass > 0.0 and mass <= dust * most
        next_to = mass >= max_mass * (1.0 - touched)
        if none:
            new[k] = 0.0
        elif next_to and mass < max_mass:
            new[k] = region.radius[n, k] * max_mass / size * u[k]
        if not (region.free[n, k] or none) and size > 0.0:
            cosine, centre = region.cosine[n, k], region.centre[n, k]
            v = u[k] * np.conj(centre)
            edge = v.real * sine - abs(v.imag) * cosine <= touched * sine * size
            if edge:
                side = complex(cosine, np.copysign(sine, v.imag))
                new[k] = length(new[k]) * side * centre
        is_new, dusty = is_new or new[k] != u[k], dusty or none
        room[k] = 0.0 if none or edge or next_to else size
    return is_new, dusty


@folded
def make_up(influence, across, region, n, room, left, work, complex_work, scaled, u):  # type: ignore[no-untyped-def]
    """Add to u (K,) the least change, relative to a room, that takes back what it changed; of alike webs alike.

    Parameters
    ----------
    influence, across : (J, K) real and imaginary parts, the latter (J, 0) where they are real.
    room : (K,).
    left : (J,) complex, what is to be taken back.
    work : (3, max(2 J, 2 K)) complex, to be written to, as are the next.
    complex_work : (2, J, K) complex.
    scaled : (3, J, K); of alike webs (3, 2 J, 2 K).
    """
    (terms, webs), row, correction, apart = influence.shape, work[0], work[1], not region.leader.size
    if apart and across.shape[1] > 0:
        for j in range(terms):
            for k in range(webs):
                complex_work[0, j, k] = complex(influence[j, k] * room[k], across[j, k] * room[k])
        correction[:webs] = 0.0
        change(complex_work[0], left, _ONCE, row[:webs], complex_work[1], correction[:webs])
    else:
        rows, unknowns = (terms, webs) if apart else (2 * terms, 2 * webs)
        if apart:
            for j in range(terms):
                work[2, j] = left[j]
                for k in range(webs):
                    scaled[0, j, k] = influence[j, k] * room[k]
        else:
            # mirror images are no complex multiples: in real and imaginary parts of what the first webs carry
            scaled[0] = 0.0
            for j in range(terms):
                for k in range(webs):
                    first, sign = region.leader[k], -1.0 if region.mirrored[k] else 1.0
                    imaginary = across[j, k] if across.shape[1] > 0 else 0.0
                    part = complex(influence[j, k], imaginary) * region.turn[n, k] * room[first]
                    scaled[0, j, first] += part.real
                    scaled[0, terms + j, first] += part.imag
                    scaled[0, j, webs + first] -= sign * part.imag
                    scaled[0, terms + j, webs + first] += sign * part.real
                work[2, j], work[2, terms + j] = left[j].real, left[j].imag
        correction[:unknowns] = 0.0
        change_of_real(scaled[0], work[2, :rows], _ONCE, scaled[2, 0], scaled[1], correction[:unknowns])
    for k in range(webs):
        if apart:
            u[k] += room[k] * correction[k]
        else:
            first = region.leader[k]
            load = room[first] * complex(correction[first].real, correction[webs + first].real)
            u[k] += region.turn[n, k] * (load.conjugate() if region.mirrored[k] else load)


@folded
def balance(u, influence, across, region, n, room, work, complex_work, scaled, new):  # type: ignore[no-untyped-def]
    """Make up for what differs between u and new (K,), which is written to, and bring it within all limits.

    Parameters
    ----------
    influence, across, room, complex_work, scaled : as of :func:`make_up`.
    work : (4, max(2 J, 2 K)) complex, to be written to.
    """
    left, terms = work[3], influence.shape[0]
    for j in range(terms):
        x, y = 0.0, 0.0
        for k in range(u.size):
            step = new[k] - u[k]
            x, y = x + influence[j, k] * step.real, y + influence[j, k] * step.imag
            if across.shape[1] > 0:
                x, y = x - across[j, k] * step.imag, y + across[j, k] * step.real
        left[j] = complex(x, y)
    make_up(influence, across, region, n, room, left[:terms], work, complex_work, scaled, new)
    into(new, region, n, work[0])


@in_place
def rebalance(u, near, influence, across, region, room, work, complex_work, scaled, new, is_new):  # type: ignore[no-untyped-def]
    """Of N points (N, K) what is near to nothing, or to a limit, there, and the others made up for it.

    Parameters
    ----------
    near : (2,) share of the largest mass that is next to nothing, and of a limit that is next to it; below 0 where
        ``new`` says what is put, and ``room`` which others there are.
    influence, across : (N, J, K) on what is to stay as it is, as of :func:`make_up`.
    room, new, is_new : (N, K), (N, K) and (N,) bool, the points and which of them are others, to be written to.
    """
    for n in range(u.shape[0]):
        is_new[n] = near[0] < 0.0
        if not is_new[n]:
            is_new[n], _ = snap(u[n], near[0], near[1], region, n, room[n], new[n])
        if is_new[n]:
            balance(u[n], influence[n], across[n], region, n, room[n], work, complex_work, scaled, new[n])


@folded
def settle_point(u, figures, target, heaviest, rounding, rungs, programs, n, work, complex_work, scaled):  # type: ignore[no-untyped-def]
    """A point (K,) of program n, and what it comes to (4, N), in place, parameters as of :func:`settle`."""
    webs, influence, across, region = u.size, programs.influence[n], programs.across[n], programs.region
    new, room, rung, in_vain = work[4, :webs], programs.numbers[1, :webs], 0, -1.0
    while rung < rungs.shape[0]:
        dust, touched, after = rungs[rung, 0], rungs[rung, 1], int(rungs[rung, 2])
        rung += 1
        if dust == 0.0 and touched == in_vain:
            continue
        is_new, dusty = snap(u, dust, touched, region, n, room, new)
        if is_new:
            balance(u, influence, across, region, n, room, work, complex_work, scaled, new)
            objective, mass, excess, off = value(new, programs, n)
            no_worse = objective <= max(target, figures[0, n]) + off
            no_worse = no_worse and excess <= max(figures[2, n], rounding) and mass <= max(figures[1, n], heaviest)
            if not no_worse:
                # without dust it comes to the same once more
                in_vain = in_vain if dusty else touched
                continue
            copy(new, u)
            figures[0, n], figures[1, n], figures[2, n], figures[3, n] = objective, mass, excess, off
            in_vain = -1.0
        rung = after


@in_place
def settle(u, figures, target, heaviest, rounding, rungs, programs, work, complex_work, scaled):  # type: ignore[no-untyped-def]
    """N points and what they come to, in place.

    Parameters
    ----------
    u, figures : (N, K) kg m, and (4, N) as :func:`optimizer.program.kernel.values.values` tells.
    target, heaviest : (N,) largest objective and mass that are no worse.
    rounding : of an excess over the ceilings.
    rungs : (n, 3) share of the largest mass that is next to nothing, share of a limit that is next to it, and which
        rung is next where this one moved something, and was no worse, or nothing: the last is n.
    work, complex_work, scaled : (5, ...) and others as of :func:`make_up`, to be written to.
    """
    for n in range(target.size):
        settle_point(u[n], figures, target[n], heaviest[n], rounding, rungs, programs, n, work, complex_work, scaled)
