"""What sums of vectors come to at worst where all are turned, or all are longer or shorter; compiled.

What for: :mod:`optimizer.program.misplacement`.
"""

import numpy as np

from optimizer.program.kernel.compiling import inner, kernel


@inner
def farthest_rotation(vectors, fixed, angle, numbers, jumps, order):  # type: ignore[no-untyped-def]
    """Largest |fixed + sum_k v_k e^{j psi_k}| of vectors (K,), |psi_k| <= angle below pi/2.

    Along direction phi a vector v gives |v| cos(max(|phi - arg v| - angle, 0)). While phi grows from -pi every vector
    is turned ahead, not at all or back as phi is behind, near or ahead of it; between two of the angles at which that
    changes the projection is |vector| cos(phi - arg vector) + flat.

    Parameters
    ----------
    numbers, jumps, order : (2, 3 K) real, (3 K,) complex and (3 K,) integers, to be written to.
    """
    webs, turn, start, level = vectors.size, 2.0 * np.pi, numbers[0], numbers[1]
    to_ahead, to_behind = np.exp(1j * angle), np.exp(-1j * angle)
    vector, flat = fixed, 0.0
    for k in range(webs):
        v = vectors[k]
        size, towards = abs(v), np.arctan2(v.imag, v.real)
        ahead, behind = v * to_ahead, v * to_behind
        start[k], jumps[k], level[k] = towards - angle, -behind, size
        start[webs + k], jumps[webs + k], level[webs + k] = towards + angle, ahead, -size
        start[2 * webs + k], jumps[2 * webs + k], level[2 * webs + k] = towards + np.pi, behind - ahead, 0.0
        for event in range(k, 3 * webs, webs):
            start[event] = (start[event] + np.pi) % turn - np.pi
        # what comes first tells what was before, whichever way a vector along the axis rounds
        if start[webs + k] < start[k] and start[webs + k] < start[2 * webs + k]:
            flat += size
        else:
            vector += behind if start[k] < start[2 * webs + k] else ahead
    for event in range(3 * webs):
        # few, and a sort of numpy's takes longer to compile than all else
        at = event
        while at > 0 and start[order[at - 1]] > start[event]:
            order[at] = order[at - 1]
            at -= 1
        order[at] = event
    worst, begin = -np.inf, -np.pi
    for at in range(3 * webs + 1):
        end = start[order[at]] if at < 3 * webs else np.pi
        best = np.arctan2(vector.imag, vector.real)
        along = 1.0 if begin <= best <= end else max(np.cos(begin - best), np.cos(end - best))
        worst = max(worst, abs(vector) * along + flat)
        if at < 3 * webs:
            vector += jumps[order[at]]
            flat += level[order[at]]
        begin = end
    return worst


@inner
def farthest_scaled(vectors, middle, share, towards, ahead, order):  # type: ignore[no-untyped-def]
    """Largest |middle + sum_k e_k v_k| of vectors (K,), |e_k| <= share: at a corner of all such sums.

    Around half of their outline the vectors, all of which point ahead, change sign one after the other.

    Parameters
    ----------
    towards, ahead, order : (K,) or more, real, complex and integers, to be written to.
    """
    corner, webs = 0j, vectors.size
    for k in range(webs):
        v = vectors[k]
        ahead[k] = -v if v.imag < 0.0 or (v.imag == 0.0 and v.real < 0.0) else v
        towards[k] = np.arctan2(ahead[k].imag, ahead[k].real)
        corner += ahead[k]
        at = k
        while at > 0 and towards[order[at - 1]] > towards[k]:
            order[at] = order[at - 1]
            at -= 1
        order[at] = k
    worst = max(abs(middle + share * corner), abs(middle - share * corner))
    for at in range(webs):
        corner -= 2.0 * ahead[order[at]]
        worst = max(worst, abs(middle + share * corner), abs(middle - share * corner))
    return worst


@kernel
def worst_rotation(vectors, fixed, angle, worst):  # type: ignore[no-untyped-def]
    """What :func:`farthest_rotation` finds (M,) of vectors (M, K) beside fixed ones (M,)."""
    number, webs = vectors.shape
    numbers, jumps, order = np.empty((2, 3 * webs)), np.empty(3 * webs, np.complex128), np.empty(3 * webs, np.int64)
    for m in range(number):
        worst[m] = farthest_rotation(vectors[m], fixed[m], angle, numbers, jumps, order)


@kernel
def worst_scaled(vectors, middle, share, worst):  # type: ignore[no-untyped-def]
    """What :func:`farthest_scaled` finds (M,) of vectors (M, K) about middles (M,)."""
    number, webs = vectors.shape
    ahead, towards, order = np.empty(webs, np.complex128), np.empty(webs), np.empty(webs, np.int64)
    for m in range(number):
        worst[m] = farthest_scaled(vectors[m], middle[m], share, towards, ahead, order)


@kernel
def objectives(owner, group, floor, scalar, constant, influence, across, u, angle, share, objective):  # type: ignore[no-untyped-def]
    """What the objectives of N programs come to as they are, where all counterweights are turned, and where all are
    longer or shorter; of a sum of peaks no less than they come to together.

    Parameters
    ----------
    owner, group, floor : (J,), (R,) and (N, R) of :class:`optimizer.program.kernel.programs.Programs`.
    scalar : (J,) bool or more.
    constant, influence : (N, J) and (N, J, K), the real part of the latter, or more.
    across : (N, J, K) its imaginary part; (N, J, 0) where all are real.
    u : (N, K) kg m.
    angle, share : what each may be off by.
    objective : (3, N), to be written to.
    """
    number, webs = u.shape
    sums, vectors = np.empty((3, floor.shape[1])), np.empty(webs, np.complex128)
    numbers, jumps, order = np.empty((2, 3 * webs)), np.empty(3 * webs, np.complex128), np.empty(3 * webs, np.int64)
    for n in range(number):
        sums[:] = 0.0
        for j in range(owner.size):
            middle = constant[n, j]
            for k in range(webs):
                answer = complex(influence[n, j, k], across[n, j, k] if across.shape[2] else 0.0)
                vectors[k] = answer * u[n, k]
                middle += vectors[k]
            if scalar[j]:
                middle = complex(middle.real, 0.0)
            row = owner[j]
            sums[0, row] += abs(middle)
            sums[1, row] += farthest_rotation(vectors, constant[n, j], angle, numbers, jumps, order)
            sums[2, row] += farthest_scaled(vectors, middle, share, numbers[0], jumps, order)
        for way in range(3):
            objective[way, n], largest = 0.0, -np.inf
            for r in range(floor.shape[1]):
                if r > 0 and group[r] != group[r - 1]:
                    objective[way, n], largest = objective[way, n] + largest, -np.inf
                largest = max(largest, floor[n, r] + sums[way, r])
            objective[way, n] += largest
