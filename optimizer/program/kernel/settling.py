"""Counterweights without dust and at the limits that they touch, compiled:
:mod:`optimizer.program.methods.rounding`."""

import numpy as np

from optimizer.program.kernel.cancelling import change
from optimizer.program.kernel.compiling import in_place, inner
from optimizer.program.kernel.values import value


@inner
def into(u, radius, max_mass, budget, free, centre, cosine, sine):  # type: ignore[no-untyped-def]
    """An unbalance (K,) within all limits, in place: :meth:`optimizer.program.limits.Limits.into`."""
    mass = 0.0
    for k in range(u.size):
        if not free[k]:
            v = u[k] * np.conj(centre[k])
            if abs(v.imag) * cosine[k] > v.real * sine[k]:
                edge = complex(cosine[k], -sine[k] if v.imag < 0.0 else sine[k])
                u[k] = max((v * np.conj(edge)).real, 0.0) * edge * centre[k]
        size, largest = abs(u[k]), radius[k] * min(max_mass[k], budget)
        if size > largest:
            u[k] = complex(u[k].real * (largest / size), u[k].imag * (largest / size))
        mass += abs(u[k]) / radius[k]
    if mass > budget:
        for k in range(u.size):
            u[k] = complex(u[k].real * (budget / mass), u[k].imag * (budget / mass))


@in_place
def bring(u, radius, max_mass, budget, free, centre, cosine, sine):  # type: ignore[no-untyped-def]
    """The same of M = P N unbalances (M, K) of N programs, unbalance m of program m % N."""
    for m in range(u.shape[0]):
        n = m % budget.size
        into(u[m], radius[n], max_mass[n], budget[n], free[n], centre[n], cosine[n], sine[n])


@inner
def put(u, dust, touched, radius, max_mass, free, centre, cosine, sine, room, settled):  # type: ignore[no-untyped-def]
    """What is next to nothing, or to a limit, there (K,); whether anything was, and the room of the others (K,)."""
    most, moved = 0.0, False
    for k in range(u.size):
        most = max(most, abs(u[k]) / radius[k])
    for k in range(u.size):
        size = abs(u[k])
        mass, settled[k], edge = size / radius[k], u[k], False
        none = mass > 0.0 and mass <= dust * most
        next_to = mass >= max_mass[k] * (1.0 - touched)
        if none:
            settled[k] = 0.0
        elif next_to and mass < max_mass[k]:
            settled[k] = radius[k] * max_mass[k] / size * u[k]
        if not (free[k] or none) and size > 0.0:
            v = u[k] * np.conj(centre[k])
            edge = v.real * sine[k] - abs(v.imag) * cosine[k] <= touched * sine[k] * size
            if edge:
                side = complex(cosine[k], np.copysign(sine[k], v.imag))
                settled[k] = abs(settled[k]) * side * centre[k]
        moved = moved or settled[k] != u[k]
        room[k] = 0.0 if none or edge or next_to else size
    return moved


@in_place
def settle(  # type: ignore[no-untyped-def]
    u,
    figures,
    target,
    heaviest,
    rounding,
    rungs,
    owner,
    constant,
    influence,
    floor,
    cap,
    size,
    radius,
    max_mass,
    budget,
    free,
    centre,
    cosine,
    sine,
    rows,
    room,
    work,
    scaled,
):
    """N points and what they come to, in place.

    Parameters
    ----------
    u, figures : (N, K) kg m, and (4, N) as :func:`optimizer.program.kernel.values.values` tells.
    target, heaviest : (N,) largest objective and mass that are no worse.
    rounding : of an excess over the ceilings.
    rungs : (n, 3) share of the largest mass that is next to nothing, share of a limit that is next to it, and which
        rung is next where this one moved something, and was no worse, or nothing: the last is n.
    rows, room, work, scaled : (R,), (K,), (4, max(J + I, K)) and (2, J + I, K) complex, to be written to.
    """
    number, terms, webs = influence.shape
    new, made, row, left = work[0, :webs], work[1, :webs], work[2, :webs], work[3, :terms]
    for n in range(number):
        rung = 0
        while rung < rungs.shape[0]:
            dust, touched, after = rungs[rung, 0], rungs[rung, 1], int(rungs[rung, 2])
            rung += 1
            moved = put(u[n], dust, touched, radius[n], max_mass[n], free[n], centre[n], cosine[n], sine[n], room, new)
            if moved:
                for j in range(terms):
                    left[j] = 0.0
                    for k in range(webs):
                        left[j] += influence[n, j, k] * (new[k] - u[n, k])
                        scaled[0, j, k] = influence[n, j, k] * room[k]
                made[:] = 0.0
                change(scaled[0], left, 1, row, scaled[1], made)
                for k in range(webs):
                    new[k] += room[k] * made[k]
                into(new, radius[n], max_mass[n], budget[n], free[n], centre[n], cosine[n], sine[n])
                objective, mass, excess, off = value(
                    new, owner, constant[n], influence[n], floor[n], cap[n], size[n], radius[n], rows
                )
                no_worse = objective <= max(target[n], figures[0, n]) + off
                no_worse = (
                    no_worse and excess <= max(figures[2, n], rounding) and mass <= max(figures[1, n], heaviest[n])
                )
                if not no_worse:
                    continue
                for k in range(webs):
                    u[n, k] = new[k]
                figures[0, n], figures[1, n], figures[2, n], figures[3, n] = objective, mass, excess, off
            rung = after
