"""Where counterweights may be, compiled: :mod:`optimizer.program.limits`, which says what is meant.

A region is a :class:`optimizer.program.kernel.programs.Region` of N programs.
"""

from optimizer.program.kernel.compiling import folded, in_place
from optimizer.program.kernel.lengths import length


@folded
def nearest(u, region, n, mean, result):  # type: ignore[no-untyped-def]
    """The nearest unbalances that are alike (K,) to others:
    :meth:`optimizer.program.equal_castings.Alike.nearest`.

    Parameters
    ----------
    mean : (K,) complex, to be written to.
    result : (K,), which may be ``u``.
    """
    for k in range(region.leader.size):
        mean[k] = 0.0
    for k in range(region.leader.size):
        back = u[k] * region.turn[n, k].conjugate()
        mean[region.leader[k]] += back.conjugate() if region.mirrored[k] else back
    for k in range(region.leader.size):
        first = mean[region.leader[k]] / region.members[k]
        result[k] = region.turn[n, k] * (first.conjugate() if region.mirrored[k] else first)


@folded
def support(pull, region, n, k):  # type: ignore[no-untyped-def]
    """Largest Re(conj(pull) v) over unit vectors v in sector k: :meth:`optimizer.program.limits.Limits.support`."""
    if not region.free[n, k]:
        centre, cosine, sine = region.centre[n, k], region.cosine[n, k], region.sine[n, k]
        along = pull.real * centre.real + pull.imag * centre.imag
        across = abs(pull.real * centre.imag - pull.imag * centre.real)
        if across * cosine > along * sine:
            return along * cosine + across * sine
    return length(pull)


@folded
def into(u, region, n, mean):  # type: ignore[no-untyped-def]
    """An unbalance (K,) within all limits, in place: :meth:`optimizer.program.limits.Limits.into`."""
    if region.leader.size:
        nearest(u, region, n, mean, u)
    mass, budget = 0.0, region.budget[n]
    for k in range(u.size):
        cosine, sine, radius = region.cosine[n, k], region.sine[n, k], region.radius[n, k]
        if not region.free[n, k]:
            v = u[k] * region.centre[n, k].conjugate()
            if abs(v.imag) * cosine > v.real * sine:
                edge = complex(cosine, -sine if v.imag < 0.0 else sine)
                u[k] = max((v * edge.conjugate()).real, 0.0) * edge * region.centre[n, k]
        size, largest = length(u[k]), radius * min(region.max_mass[n, k], budget)
        if size > largest:
            u[k] = complex(u[k].real * (largest / size), u[k].imag * (largest / size))
        mass += (size if size <= largest else length(u[k])) / radius
    if mass > budget:
        for k in range(u.size):
            u[k] = complex(u[k].real * (budget / mass), u[k].imag * (budget / mass))


@in_place
def bring(u, region, mean):  # type: ignore[no-untyped-def]
    """The same of M = P N unbalances (M, K) of N programs, unbalance m of program m % N."""
    for m in range(u.shape[0]):
        into(u[m], region, m % region.budget.size, mean)
