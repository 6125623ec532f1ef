"""What points come to, compiled: :meth:`optimizer.program.statement.Statement.objective` and what is asked beside it.

For objectives of one group of real influences.
"""

import numpy as np

from optimizer.program.kernel.compiling import in_place, inner

#: of a sum, in units of the sum of the magnitudes of its terms
ROUNDING = 4 * float(np.finfo(float).eps)


@inner
def value(u, owner, constant, influence, floor, cap, size, radius, rows):  # type: ignore[no-untyped-def]
    """Objective, mass, largest relative excess over a ceiling, and rounding of the objective, of one point.

    Parameters
    ----------
    u : (K,) kg m.
    owner : (J,) row of a term.
    constant, influence, floor : (J + I,), (J + I, K), (R,).
    cap, size : (I,) of the ceilings.
    rows : (R,) to be written to.
    """
    mass, rounding, excess, own = 0.0, 0.0, -np.inf, owner.size
    for k in range(u.size):
        long = abs(u[k])
        mass += long / radius[k]
        for j in range(own):
            rounding += abs(influence[j, k]) * long
    rows[:] = 0.0
    for j in range(constant.size):
        x, y = 0.0, 0.0
        for k in range(u.size):
            x, y = x + influence[j, k] * u[k].real, y + influence[j, k] * u[k].imag
        long = abs(complex(constant[j].real + x, constant[j].imag + y))
        if j < own:
            rounding += abs(constant[j])
            rows[owner[j]] += long
        else:
            over = (long - cap[j - own]) / size[j - own]
            # no number is larger than what is none
            excess = over if over > excess or over != over else excess
    objective = -np.inf
    for r in range(rows.size):
        row = floor[r] + rows[r]
        objective = row if row > objective or row != row else objective
    return objective, mass, excess, ROUNDING * rounding


@in_place
def values(u, owner, constant, influence, floor, cap, size, radius, rows, figures):  # type: ignore[no-untyped-def]
    """The same (4, M) of M = P N points of N programs, point m of program m % N, which all have a leading axis."""
    number = influence.shape[0]
    for m in range(figures.shape[1]):
        n = m % number
        figures[0, m], figures[1, m], figures[2, m], figures[3, m] = value(
            u[m], owner, constant[n], influence[n], floor[n], cap[n], size[n], radius[n], rows
        )
