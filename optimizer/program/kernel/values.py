"""What points come to, compiled: :meth:`optimizer.program.statement.Statement.objective` and what is asked beside it.

For objectives of one group of real influences.
"""

import numpy as np

from optimizer.program.kernel.compiling import in_place

#: of a sum, in units of the sum of the magnitudes of its terms
ROUNDING = 4 * float(np.finfo(float).eps)


@in_place
def values(u, owner, constant, influence, floor, cap, size, radius, rows, found):  # type: ignore[no-untyped-def]
    """Objective, mass, largest relative excess over a ceiling, and rounding of the objective (4, M).

    Parameters
    ----------
    u : (M, K) kg m, M = P N points, point m of program m % N.
    owner : (J,) row of a term.
    constant, influence, floor : (N, J + I), (N, J + I, K), (N, R).
    cap, size : (N, I) of the ceilings.
    rows : (R,) to be written to.
    """
    number, terms, webs = influence.shape
    own = owner.size
    for m in range(found.shape[1]):
        n = m % number
        mass, rounding, excess = 0.0, 0.0, -np.inf
        for k in range(webs):
            long = abs(u[m, k])
            mass += long / radius[n, k]
            for j in range(own):
                rounding += abs(influence[n, j, k]) * long
        rows[:] = 0.0
        for j in range(terms):
            x, y = 0.0, 0.0
            for k in range(webs):
                x, y = x + influence[n, j, k] * u[m, k].real, y + influence[n, j, k] * u[m, k].imag
            long = abs(complex(constant[n, j].real + x, constant[n, j].imag + y))
            if j < own:
                rounding += abs(constant[n, j])
                rows[owner[j]] += long
            else:
                over = (long - cap[n, j - own]) / size[n, j - own]
                # no number is larger than what is none
                excess = over if over > excess or over != over else excess
        objective = -np.inf
        for r in range(rows.size):
            row = floor[n, r] + rows[r]
            objective = row if row > objective or row != row else objective
        found[0, m], found[1, m], found[2, m], found[3, m] = objective, mass, excess, ROUNDING * rounding
