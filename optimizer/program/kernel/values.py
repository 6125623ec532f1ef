"""Values of points, compiled: :meth:`optimizer.program.statement.Statement.objective` and figures beside it.

Programs are :class:`optimizer.program.kernel.programs.Programs`.
"""

import numpy as np

from optimizer.program.kernel.compiling import folded, in_place
from optimizer.program.kernel.lengths import length
from optimizer.program.kernel.programs import Programs, Region

#: of a sum, in units of the sum of the magnitudes of its terms
ROUNDING = 4 * float(np.finfo(float).eps)


@folded
def programs_of(parts):  # type: ignore[no-untyped-def]
    """Programs of their arrays one by one, as :attr:`Programs.arrays` has them."""
    return Programs(*parts[:12], Region(*parts[12:23]), *parts[23:])  # type: ignore[call-arg]


@folded
def value(u, programs, n):  # type: ignore[no-untyped-def]
    """Objective, mass, largest relative excess over a ceiling, and rounding of the objective, of one point.

    Parameters
    ----------
    u : (K,) kg m.
    """
    rows = programs.numbers[0]
    influence, across, magnitude = programs.influence, programs.across, programs.magnitude
    mass, rounding, excess, own = 0.0, 0.0, -np.inf, programs.owner.size
    webs, is_complex = u.size, across.shape[2] > 0
    for k in range(webs):
        long = length(u[k])
        mass += long / programs.region.radius[n, k]
        for j in range(own):
            rounding += (magnitude[n, j, k] if is_complex else abs(influence[n, j, k])) * long
    # what scatters is off as well
    rounding *= 1.0 + programs.scatter[0]
    for r in range(programs.floor.shape[1]):
        rows[r] = 0.0
    for j in range(programs.constant.shape[1]):
        x, y, constant = 0.0, 0.0, programs.constant[n, j]
        if is_complex:
            for k in range(webs):
                x += influence[n, j, k] * u[k].real - across[n, j, k] * u[k].imag
                y += influence[n, j, k] * u[k].imag + across[n, j, k] * u[k].real
        else:
            for k in range(webs):
                x, y = x + influence[n, j, k] * u[k].real, y + influence[n, j, k] * u[k].imag
        long = abs(constant.real + x) if programs.scalar[j] else length(complex(constant.real + x, constant.imag + y))
        share = programs.scatter[0 if j < own else 1]
        if share > 0.0:
            off = 0.0
            for k in range(webs):
                off += (magnitude[n, j, k] if is_complex else abs(influence[n, j, k])) * abs(u[k])
            long += share * off
        if j < own:
            rounding += length(constant)
            rows[programs.owner[j]] += long
        else:
            over = (long - programs.cap[n, j - own]) / programs.size[n, j - own]
            # no number is larger than what is none
            excess = over if over > excess or over != over else excess
    objective, largest = 0.0, -np.inf
    for r in range(programs.floor.shape[1]):
        if r > 0 and programs.group[r] != programs.group[r - 1]:
            objective, largest = objective + largest, -np.inf
        row = programs.floor[n, r] + rows[r]
        largest = row if row > largest or row != row else largest
    return objective + largest, mass, excess, ROUNDING * rounding


@in_place
def values(u, figures, *parts):  # type: ignore[no-untyped-def]
    """The same (4, M) of M = P N points of N programs, point m of program m % N, which all have a leading axis.

    Parameters
    ----------
    parts : of :func:`programs_of`.
    """
    programs = programs_of(parts)
    for m in range(figures.shape[1]):
        n = m % programs.floor.shape[0]
        figures[0, m], figures[1, m], figures[2, m], figures[3, m] = value(u[m], programs, n)
