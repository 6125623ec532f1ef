"""The least change that cancels some terms, compiled: :func:`optimizer.program.scaling.least_change`."""

import numpy as np

from optimizer.program.kernel.compiling import in_place, inner
from optimizer.program.kernel.lengths import length

#: a term whose influence is this close to those before it is not cancelled on its own
_DEPENDENT = 1e-13


@in_place
def least_changes(influence, constant, passes, row, basis, changes):  # type: ignore[no-untyped-def]
    """The least u for which constant (N, J) + influence (N, J, K) u is 0, as far as can be, added to changes (N, K).

    Parameters
    ----------
    row, basis : (K,) and (J, K) as the influence, to be written to.
    """
    for n in range(influence.shape[0]):
        change(influence[n], constant[n], passes, row, basis, changes[n])


@in_place
def least_changes_of_real(influence, constant, passes, row, basis, changes):  # type: ignore[no-untyped-def]
    """The same to the last digit where influences are real, in a third of the time."""
    for n in range(influence.shape[0]):
        change_of_real(influence[n], constant[n], passes, row, basis, changes[n])


@inner
def change_of_real(influence, constant, passes, row, basis, u):  # type: ignore[no-untyped-def]
    """The same of one program, added to u (K,) complex; row (K,) and basis (J, K) are real, and to be written to."""
    terms, webs = influence.shape
    for _ in range(passes):
        for j in range(terms):
            size = 0.0
            for k in range(webs):
                size = max(size, abs(influence[j, k]))
            left = _over(constant[j], size) if size > 0.0 else 0.0j
            for k in range(webs):
                row[k] = influence[j, k] / (size if size > 0.0 else 1.0)
                left += complex(row[k] * u[k].real, row[k] * u[k].imag)
            for before in range(j * passes):
                column, share = before % j, 0.0
                for k in range(webs):
                    share += row[k] * basis[column, k]
                for k in range(webs):
                    row[k] -= share * basis[column, k]
            square = 0.0
            for k in range(webs):
                square += row[k] * row[k]
            size_left = np.sqrt(square)
            new = size_left > _DEPENDENT
            left = _over(left, size_left) if new else left
            for k in range(webs):
                basis[j, k] = row[k] / size_left if new else 0.0
                u[k] -= complex(basis[j, k] * left.real, basis[j, k] * left.imag)


@inner
def change(influence, constant, passes, row, basis, u):  # type: ignore[no-untyped-def]
    """The same where influences are complex."""
    terms, webs = influence.shape
    for _ in range(passes):
        for j in range(terms):
            size = 0.0
            for k in range(webs):
                size = max(size, length(influence[j, k]))
            left = _over(constant[j], size) if size > 0.0 else 0.0j
            for k in range(webs):
                row[k] = _over(influence[j, k], size if size > 0.0 else 1.0)
                left += row[k] * u[k]
            for before in range(j * passes):
                vector = basis[before % j]
                share = 0.0j
                for k in range(webs):
                    share += row[k] * np.conj(vector[k])
                for k in range(webs):
                    row[k] -= share * vector[k]
            square = 0.0
            for k in range(webs):
                square += row[k].real * row[k].real + row[k].imag * row[k].imag
            size_left = np.sqrt(square)
            new = size_left > _DEPENDENT
            for k in range(webs):
                basis[j, k] = _over(row[k], size_left) if new else 0.0
                u[k] -= np.conj(basis[j, k]) * (_over(left, size_left) if new else left)


@inner
def _over(number, size):  # type: ignore[no-untyped-def]
    """What is complex by what is real, without the steps of a division by what is complex."""
    return complex(number.real / size, number.imag / size)
