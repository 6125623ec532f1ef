"""Second-order cones of three dimensions, compiled: scaling, products, steps; and a small Cholesky factorisation.

Arrays of cones are (3, n): the size first, then the vector. W is the Nesterov-Todd scaling of slack s
and multiplier z, W z = s / W = lam, kept as w and eta with W^2 = eta^2 (2 w w' - J), J = diag(1, -1, -1)
(Vandenberghe, "The CVXOPT linear and quadratic cone program solvers", 2010, section 4).

Matrices are (n, n, L), one for each of L lanes. Loops end on the longest contiguous axis and do not branch, so that
the compiler turns them into vector instructions.
"""

import numpy as np

from optimizer.program.kernel.compiling import inlined, inner


@inlined
def step_to_boundary(s0, s1, s2, d0, d1, d2):  # type: ignore[no-untyped-def]
    """Largest step in [0, inf) with S + step D in the cone |(s1, s2)| <= s0, for S inside."""
    a = d0 * d0 - d1 * d1 - d2 * d2
    b = s0 * d0 - s1 * d1 - s2 * d2
    r = np.sqrt(s1 * s1 + s2 * s2)
    c = (s0 - r) * (s0 + r)
    # a t^2 + 2 b t + c = 0, the smallest positive root
    disc = b * b - a * c
    root = np.sqrt(disc if disc > 0.0 else 0.0)
    falling = c / (root - b if b < 0.0 else 1.0)
    rising = -(b + root) / (a if a < 0.0 else 1.0)
    crossing = falling if b < 0.0 else rising
    leaving = -s0 / (d0 if d0 < 0.0 else 1.0) if d0 < 0.0 else 1e300
    inside = 1e300 if disc < 0.0 else leaving
    return inside if (disc < 0.0) | ((a >= 0.0) & (b >= 0.0)) else crossing


@inner
def cholesky(matrix, least):  # type: ignore[no-untyped-def]
    """In place, lower triangle with the diagonal inverted.

    Pivots are no smaller than ``least`` (n, L), diagonals to which the rest of the matrix only adds; those that
    rounding has spoiled all the same become infinite.
    """
    n, lanes = matrix.shape[1:]
    for i in range(n):
        for j in range(i):
            for k in range(j):
                for t in range(lanes):
                    matrix[i, j, t] -= matrix[i, k, t] * matrix[j, k, t]
            for t in range(lanes):
                matrix[i, j, t] *= matrix[j, j, t]
        for k in range(i):
            for t in range(lanes):
                matrix[i, i, t] -= matrix[i, k, t] * matrix[i, k, t]
        for t in range(lanes):
            pivot = max(matrix[i, i, t], least[i, t])
            matrix[i, i, t] = 1.0 / np.sqrt(pivot) if pivot > 0.0 else 1e-100


@inner
def forward(factor, begin, vector):  # type: ignore[no-untyped-def]
    """The first half of a solution in place, (n - begin, L), of a right side that is 0 before ``begin``."""
    n, lanes = vector.shape
    for i in range(n):
        for k in range(i):
            for t in range(lanes):
                vector[i, t] -= factor[begin + i, begin + k, t] * vector[k, t]
        for t in range(lanes):
            vector[i, t] *= factor[begin + i, begin + i, t]


@inner
def backward(factor, vector):  # type: ignore[no-untyped-def]
    """The second half, (n, L)."""
    n, lanes = vector.shape
    for i in range(n - 1, -1, -1):
        for k in range(i + 1, n):
            for t in range(lanes):
                vector[i, t] -= factor[k, i, t] * vector[k, t]
        for t in range(lanes):
            vector[i, t] *= factor[i, i, t]


@inner
def scaling(s, z, w, eta, lam):  # type: ignore[no-untyped-def]
    """Nesterov-Todd scaling W = eta (2 w w' - J)^(1/2) of every cone, and lam = W Z = S / W."""
    for i in range(s.shape[1]):
        rs = np.sqrt(s[1, i] * s[1, i] + s[2, i] * s[2, i])
        rz = np.sqrt(z[1, i] * z[1, i] + z[2, i] * z[2, i])
        ds = np.sqrt((s[0, i] - rs) * (s[0, i] + rs))
        dz = np.sqrt((z[0, i] - rz) * (z[0, i] + rz))
        # one division serves several: they cost most here
        unit_s, unit_z = 1.0 / ds, 1.0 / dz
        s0, s1, s2 = s[0, i] * unit_s, s[1, i] * unit_s, s[2, i] * unit_s
        z0, z1, z2 = z[0, i] * unit_z, z[1, i] * unit_z, z[2, i] * unit_z
        gamma = np.sqrt(0.5 * (1.0 + s0 * z0 + s1 * z1 + s2 * z2))
        half = 0.5 / gamma
        w1, w2 = (s1 - z1) * half, (s2 - z2) * half
        w[0, i] = np.sqrt(1.0 + w1 * w1 + w2 * w2)
        w[1, i] = w1
        w[2, i] = w2
        eta[i] = np.sqrt(ds * unit_z)
        size = np.sqrt(ds * dz)
        share = size / (s0 + z0 + 2.0 * gamma)
        lam[0, i] = size * gamma
        lam[1, i] = share * ((gamma + z0) * s1 + (gamma + s0) * z1)
        lam[2, i] = share * ((gamma + z0) * s2 + (gamma + s0) * z2)


@inner
def targets(nu, d, w, eta, lam, s, z, f, ws):  # type: ignore[no-untyped-def]
    """f = -Z + W^-1 (lam \\ (nu e - d)) and W^2 f = -S + W (lam \\ (nu e - d)), of every cone; nu (n,)."""
    for i in range(s.shape[1]):
        d0, d1, d2 = nu[i] - d[0, i], -d[1, i], -d[2, i]
        l0, l1, l2 = lam[0, i], lam[1, i], lam[2, i]
        r = np.sqrt(l1 * l1 + l2 * l2)
        y0 = (l0 * d0 - l1 * d1 - l2 * d2) / ((l0 - r) * (l0 + r))
        unit, scale = 1.0 / l0, 1.0 / eta[i]
        y1, y2 = (d1 - y0 * l1) * unit, (d2 - y0 * l2) * unit
        along = w[1, i] * y1 + w[2, i] * y2
        shift = along / (1.0 + w[0, i])
        f[0, i] = (w[0, i] * y0 - along) * scale - z[0, i]
        f[1, i] = (y1 + w[1, i] * (shift - y0)) * scale - z[1, i]
        f[2, i] = (y2 + w[2, i] * (shift - y0)) * scale - z[2, i]
        ws[0, i] = (w[0, i] * y0 + along) * eta[i] - s[0, i]
        ws[1, i] = (y1 + w[1, i] * (shift + y0)) * eta[i] - s[1, i]
        ws[2, i] = (y2 + w[2, i] * (shift + y0)) * eta[i] - s[2, i]


@inner
def corrector(factor, w, eta, ds, dz, d):  # type: ignore[no-untyped-def]
    """Second-order part (W^-1 dS) o (W dZ) of every cone, times ``factor`` (n,), 1 or 0."""
    for i in range(ds.shape[1]):
        w0, w1, w2 = w[0, i], w[1, i], w[2, i]
        along = w1 * ds[1, i] + w2 * ds[2, i]
        half = 1.0 / (1.0 + w0)
        shift = along * half - ds[0, i]
        a0, a1, a2 = w0 * ds[0, i] - along, ds[1, i] + w1 * shift, ds[2, i] + w2 * shift
        along = w1 * dz[1, i] + w2 * dz[2, i]
        shift = along * half + dz[0, i]
        b0, b1, b2 = w0 * dz[0, i] + along, dz[1, i] + w1 * shift, dz[2, i] + w2 * shift
        d[0, i] = factor[i] * (a0 * b0 + a1 * b1 + a2 * b2)
        d[1, i] = factor[i] * (a0 * b1 + b0 * a1)
        d[2, i] = factor[i] * (a0 * b2 + b0 * a2)


@inner
def multiplier_steps(count, w, eta, f, ds, dz):  # type: ignore[no-untyped-def]
    """dz = f - W^-2 ds of the first cones."""
    for i in range(count):
        w0, w1, w2 = w[0, i], w[1, i], w[2, i]
        along = 2.0 * (w0 * ds[0, i] - w1 * ds[1, i] - w2 * ds[2, i])
        scale = 1.0 / (eta[i] * eta[i])
        dz[0, i] = f[0, i] - scale * (w0 * along - ds[0, i])
        dz[1, i] = f[1, i] - scale * (-w1 * along + ds[1, i])
        dz[2, i] = f[2, i] - scale * (-w2 * along + ds[2, i])


@inner
def cone_steps(s, ds, step):  # type: ignore[no-untyped-def]
    """Steps (L,) that are no longer than those of every cone."""
    lanes = step.size
    for k in range(0, s.shape[1], lanes):
        for t in range(lanes):
            i = k + t
            longest = step_to_boundary(s[0, i], s[1, i], s[2, i], ds[0, i], ds[1, i], ds[2, i])
            step[t] = min(step[t], longest)
