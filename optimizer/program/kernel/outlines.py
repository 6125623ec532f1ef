"""What sums of vectors come to at worst where all are turned, or all are longer or shorter; compiled.

What for: :mod:`optimizer.program.misplacement`.
"""

import numpy as np

from optimizer.program.kernel.compiling import kernel


@kernel
def worst_turned(vectors, fixed, angle, worst):  # type: ignore[no-untyped-def]
    """Largest |fixed + sum_k v_k e^{j psi_k}|, |psi_k| <= angle below pi/2.

    Along direction phi a vector v gives |v| cos(max(|phi - arg v| - angle, 0)). While phi grows from -pi every vector
    is turned ahead, not at all or back as phi is behind, near or ahead of it; between two of the angles at which that
    changes the projection is |vector| cos(phi - arg vector) + flat.

    Parameters
    ----------
    vectors, fixed : (M, K) and (M,) complex.
    worst : (M,) what is found.
    """
    number, webs = vectors.shape
    turn = 2.0 * np.pi
    start, level = np.empty(3 * webs), np.empty(3 * webs)
    turned, order = np.empty(3 * webs, np.complex128), np.empty(3 * webs, np.int64)
    to_ahead, to_behind = np.exp(1j * angle), np.exp(-1j * angle)
    for m in range(number):
        vector, flat = fixed[m], 0.0
        for k in range(webs):
            v = vectors[m, k]
            size, towards = abs(v), np.arctan2(v.imag, v.real)
            ahead, behind = v * to_ahead, v * to_behind
            start[k], turned[k], level[k] = towards - angle, -behind, size
            start[webs + k], turned[webs + k], level[webs + k] = towards + angle, ahead, -size
            start[2 * webs + k], turned[2 * webs + k], level[2 * webs + k] = towards + np.pi, behind - ahead, 0.0
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
        worst[m], begin = -np.inf, -np.pi
        for at in range(3 * webs + 1):
            end = start[order[at]] if at < 3 * webs else np.pi
            best = np.arctan2(vector.imag, vector.real)
            along = 1.0 if begin <= best <= end else max(np.cos(begin - best), np.cos(end - best))
            worst[m] = max(worst[m], abs(vector) * along + flat)
            if at < 3 * webs:
                vector += turned[order[at]]
                flat += level[order[at]]
            begin = end


@kernel
def worst_scaled(vectors, middle, share, worst):  # type: ignore[no-untyped-def]
    """Largest |middle + sum_k e_k v_k|, |e_k| <= share: at a corner of all such sums.

    Around half of their outline the vectors, all of which point ahead, change sign one after the other.

    Parameters
    ----------
    vectors, middle : (M, K) and (M,) complex.
    worst : (M,) what is found.
    """
    number, webs = vectors.shape
    ahead, towards, order = np.empty(webs, np.complex128), np.empty(webs), np.empty(webs, np.int64)
    for m in range(number):
        corner = 0j
        for k in range(webs):
            v = vectors[m, k]
            ahead[k] = -v if v.imag < 0.0 or (v.imag == 0.0 and v.real < 0.0) else v
            towards[k] = np.arctan2(ahead[k].imag, ahead[k].real)
            corner += ahead[k]
            at = k
            while at > 0 and towards[order[at - 1]] > towards[k]:
                order[at] = order[at - 1]
                at -= 1
            order[at] = k
        worst[m] = max(abs(middle[m] + share * corner), abs(middle[m] - share * corner))
        for at in range(webs):
            corner -= 2.0 * ahead[order[at]]
            worst[m] = max(worst[m], abs(middle[m] + share * corner), abs(middle[m] - share * corner))
