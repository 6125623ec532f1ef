"""The webs' part of an interior-point step, compiled: every web is eliminated by itself.

Their blocks are inverted as sums of squares, without cancellation. Arrays are (..., K L), lane t of web k at k L + t;
those of the peaks (..., Q L). Notation as in :mod:`optimizer.program.kernel.newton`.
"""

from optimizer.program.kernel.compiling import inner


@inner
def peaks_of(influence, u, a):  # type: ignore[no-untyped-def]
    """Add the vectors sum_k H_ik u_k of the peaks (2, Q L) to a."""
    cones, every = influence.shape
    lanes = a.shape[1] // cones
    for i in range(cones):
        for k in range(0, every, lanes):
            for t in range(lanes):
                a[0, i * lanes + t] += influence[i, k + t] * u[0, k + t]
            for t in range(lanes):
                a[1, i * lanes + t] += influence[i, k + t] * u[1, k + t]


@inner
def webs_of(influence, y, u):  # type: ignore[no-untyped-def]
    """The vectors sum_i H_ik y_i of the webs (2, K L)."""
    cones, every = influence.shape
    lanes = y.shape[1] // cones
    u[:] = 0.0
    for i in range(cones):
        for k in range(0, every, lanes):
            for t in range(lanes):
                u[0, k + t] += influence[i, k + t] * y[0, i * lanes + t]
            for t in range(lanes):
                u[1, k + t] += influence[i, k + t] * y[1, i * lanes + t]


@inner
def in_frame(e, sine, centre, u):  # type: ignore[no-untyped-def]
    """Unbalances along and across the sectors (e, 3 rows, the first of which is left out) in the frame, (2, K L)."""
    for k in range(sine.size):
        along, across = e[1, k], sine[k] * e[2, k]
        u[0, k] = centre[0, k] * along - centre[1, k] * across
        u[1, k] = centre[1, k] * along + centre[0, k] * across


@inner
def web_residuals(zb, mass, budget, sine, cosine, centre, p, z, zq, rd):  # type: ignore[no-untyped-def]
    for k in range(sine.size):
        rd[0, k] = mass[k] - z[0, k] + zq[0, k] + budget[k] * zb[k]
    for k in range(sine.size):
        along = z[1, k] + centre[0, k] * p[0, k] + centre[1, k] * p[1, k]
        across = z[2, k] - centre[1, k] * p[0, k] + centre[0, k] * p[1, k]
        rd[1, k] = -along - zq[1, k] - zq[2, k]
        rd[2, k] = -sine[k] * across + cosine[k] * (zq[1, k] - zq[2, k])


@inner
def eliminate_webs(w, eta, q, zq, sector, sine, cosine, centre, block):  # type: ignore[no-untyped-def]
    """Inverse of every web's 3 x 3 block, as sums of squares; all arrays (..., K L).

    The inverse in (a, b) is T = A + P p p' + M m m' with p = (c, 1) and m = (-c, 1) along the edges.
    block rows: 0-2 A (11, 12, 22), 9-10 P and M, 3-4 slope g of x over
    (a, b), 5 1/H_xx, 6-8 T turned into the frame (xx, xy, yy).
    """
    for k in range(sine.size):
        w0, w1, w2, e2, s = w[0, k], w[1, k], w[2, k], eta[k] * eta[k], sine[k]
        none = w1 * w1 + w2 * w2 < 1e-200
        w1, w2 = 1e-100 if none else w1, 0.0 if none else w2
        size = 1e-200 if none else w1 * w1 + w2 * w2
        theta = zq[0, k] / q[0, k] * e2
        over = 1.0 / (2.0 * size + 1.0 + theta)
        per_size, per_e2 = 1.0 / size, 1.0 / e2
        # the cone's block after x is (t t' + n n' / epsilon) / eta^2, n along w and t across it
        stiff = (1.0 + theta + 2.0 * theta * size) * over  # 1 / epsilon
        n11, n12, n22 = w1 * w1 * per_size, w1 * w2 * per_size, w2 * w2 * per_size
        # its adjugate (n n' + t t' / epsilon) / eta^2 in (a, b)
        block[0, k] = s * s * (n11 + n22 * stiff) * per_e2
        block[1, k] = s * n12 * (1.0 - stiff) * per_e2
        block[2, k] = (n22 + n11 * stiff) * per_e2
        block[6, k] = s * s * stiff * per_e2 * per_e2
        block[3, k], block[4, k] = 2.0 * w0 * w1 * over, 2.0 * w0 * w2 * over * s
        block[5, k] = e2 * over
    for k in range(sine.size):
        a11, a12, a22, det, c = block[0, k], block[1, k], block[2, k], block[6, k], cosine[k]
        dp, dm = sector[k] * zq[1, k] / q[1, k], sector[k] * zq[2, k] / q[2, k]
        det += dp * (a11 - 2.0 * c * a12 + c * c * a22) + dm * (a11 + 2.0 * c * a12 + c * c * a22)
        det += dp * dm * 4.0 * c * c
        per_det = 1.0 / det
        block[0, k], block[1, k], block[2, k] = a11 * per_det, a12 * per_det, a22 * per_det
        block[9, k], block[10, k] = dp * per_det, dm * per_det
    for k in range(sine.size):
        s, c, p, m, cr, ci = sine[k], cosine[k], block[9, k], block[10, k], centre[0, k], centre[1, k]
        t11 = block[0, k] + c * c * (p + m)
        t12 = s * (block[1, k] + c * (p - m))
        t22 = s * s * (block[2, k] + p + m)
        block[6, k] = cr * cr * t11 - 2.0 * cr * ci * t12 + ci * ci * t22
        block[7, k] = cr * ci * (t11 - t22) + (cr * cr - ci * ci) * t12
        block[8, k] = ci * ci * t11 + 2.0 * cr * ci * t12 + cr * cr * t22


@inner
def web_steps(block, cosine, e, edges):  # type: ignore[no-untyped-def]
    """Right sides e (3, K L) into steps (x, a, b), and the changes a -+ c b of the slacks at the edges (2, K L).

    In those P or M cancels exactly.
    """
    for k in range(cosine.size):
        ex, g1, g2, c = e[0, k], block[3, k], block[4, k], cosine[k]
        ra, rb = e[1, k] + g1 * ex, e[2, k] + g2 * ex
        first = block[0, k] * ra + block[1, k] * rb
        second = block[1, k] * ra + block[2, k] * rb
        p, m = block[9, k] * (c * ra + rb), block[10, k] * (rb - c * ra)
        along, across = first + c * (p - m), second + p + m
        e[0, k] = g1 * along + g2 * across + block[5, k] * ex
        e[1, k], e[2, k] = along, across
        edges[0, k] = first - c * second - 2.0 * c * m
        edges[1, k] = first + c * second + 2.0 * c * p


@inner
def web_targets(nu, present, c, q, zq, fq):  # type: ignore[no-untyped-def]
    for k in range(q.size):
        fq[k] = (present[k] * nu[k] - c[k]) / q[k] - zq[k]


@inner
def web_right_sides(keep, rd, f, fq, sine, cosine, e):  # type: ignore[no-untyped-def]
    for k in range(sine.size):
        e[0, k] = -keep[k] * rd[0, k] + f[0, k] - fq[0, k]
    for k in range(sine.size):
        e[1, k] = -keep[k] * rd[1, k] + f[1, k] + fq[1, k] + fq[2, k]
        e[2, k] = -keep[k] * rd[2, k] + sine[k] * f[2, k] - cosine[k] * (fq[1, k] - fq[2, k])


@inner
def with_peaks(dzb, budget, sine, centre, p, e):  # type: ignore[no-untyped-def]
    """What the multipliers of the peaks (p, turned to the webs) and of the budget add to the right sides."""
    for k in range(sine.size):
        e[0, k] = -budget[k] * dzb[k]
        e[1, k] = centre[0, k] * p[0, k] + centre[1, k] * p[1, k]
        e[2, k] = sine[k] * (centre[0, k] * p[1, k] - centre[1, k] * p[0, k])


@inner
def lengths(own, response, v, q, e, edges):  # type: ignore[no-untyped-def]
    """Steps e (3, K L) of the webs and of their edges (2, K L), as long as the multipliers have taken them to be.

    A web between its limits that a budget or the mass has a price for gives way along itself by 1e9 times the rounding
    of that price. The multipliers come from the sum of two large steps; e is more accurate in all but
    its length.
    """
    for k in range(v.shape[1]):
        longer = (own[0, k] + response[0, k] - e[0, k]) / v[0, k]
        for c in range(3):
            e[c, k] += longer * v[c, k]
        edges[0, k] += longer * q[1, k]
        edges[1, k] += longer * q[2, k]


@inner
def web_slacks(e, edges, sine, ds, dq):  # type: ignore[no-untyped-def]
    for k in range(sine.size):
        ds[0, k], ds[1, k], ds[2, k] = e[0, k], e[1, k], sine[k] * e[2, k]
    for k in range(sine.size):
        dq[0, k], dq[1, k], dq[2, k] = -e[0, k], edges[0, k], edges[1, k]


@inner
def web_multipliers(fq, zq, q, dq, dzq):  # type: ignore[no-untyped-def]
    for k in range(q.size):
        dzq[k] = fq[k] - zq[k] / q[k] * dq[k]
