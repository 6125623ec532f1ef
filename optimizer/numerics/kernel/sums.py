"""Sums of forces and of their couples, compiled: :func:`optimizer.numerics.sums.force_and_couple`."""

from optimizer.numerics.arrays import ROUNDING, SMALLEST
from optimizer.numerics.compiling import in_place, inner

#: a bound that is cheap to find is this much above what it bounds, for its own rounding
_ABOVE = 1.0 + 1e-9


@in_place
def force_and_couple(forces, arm, sums):  # type: ignore[no-untyped-def]
    """Sums of forces (N, m, n), and of these times their arms (N, n), to be written to sums (2, N, m).

    Exactly 0 where the terms cancel up to rounding, as of :func:`optimizer.numerics.arrays.total`, to the last digit.
    """
    number, many, _ = forces.shape
    for n in range(number):
        for i in range(many):
            for couple in range(2):
                value, bound = _sum(forces[n, i], arm[n], couple == 1)
                noise = max(ROUNDING * bound, SMALLEST)
                # most sums are far above what rounding could make of nothing
                if not max(abs(value.real), abs(value.imag)) > noise * _ABOVE:
                    size = 0.0
                    for k in range(arm.shape[1]):
                        size += abs(_term(forces[n, i, k], arm[n, k], couple == 1))
                    if abs(value) <= max(ROUNDING * size, SMALLEST):
                        value = 0.0j
                sums[couple, n, i] = value


@inner
def _term(force, arm, couple):  # type: ignore[no-untyped-def]
    """A force, or its couple as numpy multiplies."""
    if not couple:
        return force
    return complex(arm * force.real - 0.0 * force.imag, arm * force.imag + 0.0 * force.real)


@inner
def _sum(forces, arm, couple):  # type: ignore[no-untyped-def]
    """The sum of terms (n,), in the order in which numpy adds up to 64 of them, and a bound of their magnitudes."""
    terms = forces.size
    whole = terms - terms % 4
    first, second, third, fourth, bound = 0.0j, 0.0j, 0.0j, 0.0j, 0.0
    for k in range(0, whole, 4):
        a, b = _term(forces[k], arm[k], couple), _term(forces[k + 1], arm[k + 1], couple)
        c, d = _term(forces[k + 2], arm[k + 2], couple), _term(forces[k + 3], arm[k + 3], couple)
        first, second, third, fourth = first + a, second + b, third + c, fourth + d
        bound += abs(a.real) + abs(a.imag) + abs(b.real) + abs(b.imag)
        bound += abs(c.real) + abs(c.imag) + abs(d.real) + abs(d.imag)
    value = (first + second) + (third + fourth)
    for k in range(whole, terms):
        term = _term(forces[k], arm[k], couple)
        value += term
        bound += abs(term.real) + abs(term.imag)
    return value, bound
