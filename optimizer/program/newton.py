"""The linear algebra of one interior-point step, compiled, for the programs in all lanes at once.

The webs are eliminated one by one, so that what is factored has the size of the peaks only: two unknowns for
every term, one for every row, three for every ceiling and one for the budget. The blocks of the webs are inverted
as sums of squares, without cancellation, and the cones of the peaks stay in the system as they are: a norm may
vanish at the optimum. Slacks are kept consistent with the webs to rounding; what a step loses in complementarity
the next one repairs.

Notation, for one web: x the fraction of its reach, (a, b) the unbalance along and across its sector,
(x, a, s b) the slack of its cone; q the slacks 1 - x, a - c b and a + c b; s and c are sine and cosine
of the half-angle. A multiplier has the name of its slack with a z, a step that of its unknown with a d.
Sizes: L lanes, K webs, Q cones of the peaks (J terms, then ceilings), C = K + Q, R rows, n unknowns that are factored.
"""

from typing import NamedTuple

import numpy as np
from numba import njit

from optimizer.program.cones import (
    cholesky,
    cone_steps,
    corrector,
    multiplier_steps,
    scaling,
    substitute,
    targets,
)
from optimizer.response import Real


class Lanes(NamedTuple):
    """Programs of one shape side by side; lane t of web k is at k L + t, and so for cones."""

    row: np.ndarray  # (J,) row of each term
    floor: Real  # (R, L)
    cap: Real  # (Q - J, L)
    constant: Real  # (2, Q L)
    influence: Real  # (Q, K L)
    centre: Real  # (2, K L)
    sine: Real  # (K L,)
    cosine: Real  # (K L,)
    present: Real  # (3, K L) 1 where there is such a limit, else 0: full reach, which there always is, and the edges
    mass: Real  # (K L,) cost of full reach: 0 in the first stage
    budget: Real  # (K L,) mass at full reach relative to the budget; 0 without one
    target: Real  # (L,) least mass: largest value of a row


class State(NamedTuple):
    """Where the programs stand; cones of the webs come first."""

    v: Real  # (3, K L) x, a, b
    q: Real  # (3, K L)
    zq: Real  # (3, K L)
    s: Real  # (3, C L)
    z: Real  # (3, C L)
    rho: Real  # (R, L) slack of the rows
    z_rho: Real  # (R, L)
    rest: Real  # (3, L) slack of the budget, its multiplier, and the level above all rows


class Work(NamedTuple):
    """Arrays that a step is computed in."""

    a: Real  # (2, Q L) vectors of the peaks
    u: Real  # (2, K L) vectors of the webs
    rd: Real  # (3, K L) residual of the webs
    rp: Real  # (3, Q L) of the cones of the peaks
    rp_row: Real  # (R, L) of the rows
    primal: Real  # (L,) largest of these two
    dual: Real  # (L,) largest of the residuals of x
    gap: Real  # (L,)
    w: Real  # (3, C L)
    eta: Real  # (C L,)
    lam: Real  # (3, C L)
    f: Real  # (3, C L)
    ws: Real  # (3, C L)
    d: Real  # (3, C L) second-order parts
    ds: Real  # (3, C L)
    dz: Real  # (3, C L)
    each: Real  # (C L,) a value for every cone
    e: Real  # (3, K L) right sides, then steps of the webs
    kept: Real  # (3, K L)
    edges: Real  # (2, K L)
    fq: Real  # (3, K L)
    cq: Real  # (3, K L) second-order parts
    dq: Real  # (3, K L)
    dzq: Real  # (3, K L)
    block: Real  # (11, K L)
    m: Real  # (n, n, L)
    right: Real  # (n, L)
    border: Real  # (n, L)
    border_sum: Real  # (L,)
    c_rho: Real  # (R, L) second-order parts
    d_rho: Real  # (R, L)
    dz_rho: Real  # (R, L)
    c_rest: Real  # (1, L)
    d_rest: Real  # (3, L)
    nu: Real  # (L,) product of slack and multiplier that the step aims at
    keep: Real  # (L,) share of the residuals that the step removes
    step: Real  # (L,)
    where: np.ndarray  # (Q,) first unknown of every vector


@njit(cache=True, error_model="numpy")
def new_work(webs, cones, terms, rows, lanes):  # type: ignore[no-untyped-def]
    kl, ql, cl = webs * lanes, cones * lanes, (webs + cones) * lanes
    # unknowns: (y_x, y_y) of terms, rows, (mu, y_x, y_y) of ceilings, budget
    n = 2 * terms + rows + 3 * (cones - terms) + 1
    where = np.empty(cones, np.int64)
    for i in range(cones):
        where[i] = 2 * i if i < terms else 2 * terms + rows + 3 * (i - terms) + 1
    return Work(
        np.zeros((2, ql)),
        np.zeros((2, kl)),
        np.zeros((3, kl)),
        np.zeros((3, ql)),
        np.zeros((rows, lanes)),
        np.zeros(lanes),
        np.zeros(lanes),
        np.zeros(lanes),
        np.zeros((3, cl)),
        np.zeros(cl),
        np.zeros((3, cl)),
        np.zeros((3, cl)),
        np.zeros((3, cl)),
        np.zeros((3, cl)),
        np.zeros((3, cl)),
        np.zeros((3, cl)),
        np.zeros(cl),
        np.zeros((3, kl)),
        np.zeros((3, kl)),
        np.zeros((2, kl)),
        np.zeros((3, kl)),
        np.zeros((3, kl)),
        np.zeros((3, kl)),
        np.zeros((3, kl)),
        np.zeros((11, kl)),
        np.zeros((n, n, lanes)),
        np.zeros((n, lanes)),
        np.zeros((n, lanes)),
        np.zeros(lanes),
        np.zeros((rows, lanes)),
        np.zeros((rows, lanes)),
        np.zeros((rows, lanes)),
        np.zeros((1, lanes)),
        np.zeros((3, lanes)),
        np.zeros(lanes),
        np.zeros(lanes),
        np.zeros(lanes),
        where,
    )


@njit(cache=True, error_model="numpy")
def _spread(values, every):  # type: ignore[no-untyped-def]
    """The same values (L,) for every web or cone."""
    lanes = values.size
    for k in range(every.size // lanes):
        for t in range(lanes):
            every[k * lanes + t] = values[t]


@njit(cache=True, error_model="numpy")
def _gather(every, total):  # type: ignore[no-untyped-def]
    """Add every web's or cone's to its lane."""
    lanes = total.size
    for k in range(every.size // lanes):
        for t in range(lanes):
            total[t] += every[k * lanes + t]


@njit(cache=True, error_model="numpy")
def _add_products(one, other, total):  # type: ignore[no-untyped-def]
    lanes = total.size
    for k in range(one.size // lanes):
        for t in range(lanes):
            total[t] += one[k * lanes + t] * other[k * lanes + t]


@njit(cache=True, error_model="numpy")
def _raise_to_size(values, largest):  # type: ignore[no-untyped-def]
    lanes = largest.size
    for k in range(values.size // lanes):
        for t in range(lanes):
            largest[t] = max(largest[t], abs(values[k * lanes + t]))


@njit(cache=True, error_model="numpy")
def _peaks_of(influence, u, a):  # type: ignore[no-untyped-def]
    """Add the vectors sum_k H_ik u_k of the peaks (2, Q L) to a."""
    cones, every = influence.shape
    lanes = a.shape[1] // cones
    for i in range(cones):
        for k in range(0, every, lanes):
            for t in range(lanes):
                a[0, i * lanes + t] += influence[i, k + t] * u[0, k + t]
            for t in range(lanes):
                a[1, i * lanes + t] += influence[i, k + t] * u[1, k + t]


@njit(cache=True, error_model="numpy")
def _webs_of(influence, y, u):  # type: ignore[no-untyped-def]
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


@njit(cache=True, error_model="numpy")
def _turned(e, sine, centre, u):  # type: ignore[no-untyped-def]
    """Unbalances along and across the sectors (e, 3 rows, the first of which is left out) in the frame, (2, K L)."""
    for k in range(sine.size):
        along, across = e[1, k], sine[k] * e[2, k]
        u[0, k] = centre[0, k] * along - centre[1, k] * across
        u[1, k] = centre[1, k] * along + centre[0, k] * across


@njit(cache=True, error_model="numpy")
def _web_residuals(zb, mass, budget, sine, cosine, centre, p, z, zq, rd):  # type: ignore[no-untyped-def]
    for k in range(sine.size):
        rd[0, k] = mass[k] - z[0, k] + zq[0, k] + budget[k] * zb[k]
    for k in range(sine.size):
        along = z[1, k] + centre[0, k] * p[0, k] + centre[1, k] * p[1, k]
        across = z[2, k] - centre[1, k] * p[0, k] + centre[0, k] * p[1, k]
        rd[1, k] = -along - zq[1, k] - zq[2, k]
        rd[2, k] = -sine[k] * across + cosine[k] * (zq[1, k] - zq[2, k])


@njit(cache=True, error_model="numpy")
def residuals(least_mass, one, state, work):  # type: ignore[no-untyped-def]
    """Residuals of the conditions of optimality, their sizes, and the gap, which is the sum of the products."""
    rows, lanes = one.floor.shape
    terms, at_cones = one.row.size, one.sine.size
    s, z, rp, rp_row = state.s, state.z, work.rp, work.rp_row
    cones = one.influence.shape[0]
    level = one.target if least_mass else state.rest[2]
    for i in range(work.a.shape[1]):
        work.a[0, i], work.a[1, i] = z[1, at_cones + i], z[2, at_cones + i]
    _webs_of(one.influence, work.a, work.u)
    _spread(state.rest[1], work.each)
    _web_residuals(work.each, one.mass, one.budget, one.sine, one.cosine, one.centre, work.u, z, state.zq, work.rd)
    work.dual[:] = 0.0
    _raise_to_size(work.rd[0], work.dual)
    for i in range(work.a.shape[1]):
        work.a[0, i], work.a[1, i] = one.constant[0, i], one.constant[1, i]
    _turned(state.v, one.sine, one.centre, work.u)
    _peaks_of(one.influence, work.u, work.a)
    for r in range(rows):
        for t in range(lanes):
            rp_row[r, t] = state.rho[r, t] + one.floor[r, t] - level[t]
    for i in range(work.a.shape[1]):
        rp[0, i] = 0.0
        rp[1, i], rp[2, i] = s[1, at_cones + i] - work.a[0, i], s[2, at_cones + i] - work.a[1, i]
    for i in range(cones):
        for t in range(lanes):
            if i < terms:
                rp_row[one.row[i], t] += s[0, at_cones + i * lanes + t]
            else:
                rp[0, i * lanes + t] = s[0, at_cones + i * lanes + t] - one.cap[i - terms, t]
    work.primal[:] = 0.0
    for c in range(3):
        _raise_to_size(rp[c], work.primal)
    for r in range(rows):
        _raise_to_size(rp_row[r], work.primal)
    for t in range(lanes):
        work.gap[t] = state.rest[0, t] * state.rest[1, t]
    for c in range(3):
        _add_products(s[c], z[c], work.gap)
        _add_products(state.q[c], state.zq[c], work.gap)
    for r in range(rows):
        _add_products(state.rho[r], state.z_rho[r], work.gap)


@njit(cache=True, error_model="numpy")
def _eliminate_webs(w, eta, q, zq, sector, sine, cosine, centre, block):  # type: ignore[no-untyped-def]
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


@njit(cache=True, error_model="numpy")
def _web_steps(block, cosine, e, edges):  # type: ignore[no-untyped-def]
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


@njit(cache=True, error_model="numpy")
def _add_cone(first, at, eta, w0, w1, w2, m):  # type: ignore[no-untyped-def]
    """The block of a cone of a peak, eta^2 (2 w w' - J), with its size at ``first`` and its vector at ``at``."""
    lanes = eta.size
    # the lower triangle
    low_x, high_x = max(first, at), min(first, at)
    low_y, high_y = max(first, at + 1), min(first, at + 1)
    for t in range(lanes):
        e2 = eta[t] * eta[t]
        m[first, first, t] += e2 * (2.0 * w0[t] * w0[t] - 1.0)
        m[at, at, t] += e2 * (2.0 * w1[t] * w1[t] + 1.0)
        m[at + 1, at, t] += e2 * 2.0 * w1[t] * w2[t]
        m[at + 1, at + 1, t] += e2 * (2.0 * w2[t] * w2[t] + 1.0)
    for t in range(lanes):
        e2 = eta[t] * eta[t]
        m[low_x, high_x, t] += 2.0 * e2 * w0[t] * w1[t]
        m[low_y, high_y, t] += 2.0 * e2 * w0[t] * w2[t]


@njit(cache=True, error_model="numpy")
def _add_influence(influence, xx, xy, yy, where, m):  # type: ignore[no-untyped-def]
    """H T H', where T are the inverse blocks of the webs, to the block of the peaks."""
    cones, every = influence.shape
    lanes = m.shape[2]
    for i in range(cones):
        for j in range(i + 1):
            a, b = where[i], where[j]
            for k in range(0, every, lanes):
                for t in range(lanes):
                    both = influence[i, k + t] * influence[j, k + t]
                    m[a, b, t] += both * xx[k + t]
                    m[a + 1, b, t] += both * xy[k + t]
                    m[a + 1, b + 1, t] += both * yy[k + t]
                if i != j:
                    for t in range(lanes):
                        m[a, b + 1, t] += influence[i, k + t] * influence[j, k + t] * xy[k + t]


@njit(cache=True, error_model="numpy")
def factor(least_mass, one, state, work):  # type: ignore[no-untyped-def]
    """The matrix of the step, factored; and the solution for a level that rises by one."""
    rows, lanes = one.floor.shape
    cones, terms, at_cones = one.influence.shape[0], one.row.size, one.sine.size
    w, eta, block, m, where = work.w, work.eta, work.block, work.m, work.where
    scaling(state.s, state.z, w, eta, work.lam)
    _eliminate_webs(w, eta, state.q, state.zq, one.present[1], one.sine, one.cosine, one.centre, block)
    m[:] = 0.0
    at_row, at_budget = 2 * terms, m.shape[0] - 1
    for r in range(rows):
        for t in range(lanes):
            m[at_row + r, at_row + r, t] = state.rho[r, t] / state.z_rho[r, t]
    for i in range(cones):
        at, begin, end = where[i], at_cones + i * lanes, at_cones + (i + 1) * lanes
        first = at_row + one.row[i] if i < terms else at - 1
        _add_cone(first, at, eta[begin:end], w[0, begin:end], w[1, begin:end], w[2, begin:end], m)
    _add_influence(one.influence, block[6], block[7], block[8], where, m)
    # H^-1 (budget e_x): its own x, and what it is in the peaks
    e = work.e
    e[:] = 0.0
    for k in range(one.budget.size):
        e[0, k] = one.budget[k]
    _web_steps(block, one.cosine, e, work.edges)
    for t in range(lanes):
        m[at_budget, at_budget, t] = state.rest[0, t] / state.rest[1, t]
    _add_products(one.budget, e[0], m[at_budget, at_budget])
    _turned(e, one.sine, one.centre, work.u)
    work.a[:] = 0.0
    _peaks_of(one.influence, work.u, work.a)
    for i in range(cones):
        for t in range(lanes):
            m[at_budget, where[i], t] = work.a[0, i * lanes + t]
            m[at_budget, where[i] + 1, t] = work.a[1, i * lanes + t]
    cholesky(m)
    if not least_mass:
        border, border_sum = work.border, work.border_sum
        border[:] = 0.0
        border[at_row : at_row + rows] = 1.0
        substitute(m, border)
        border_sum[:] = 0.0
        for r in range(rows):
            for t in range(lanes):
                border_sum[t] += border[at_row + r, t]


@njit(cache=True, error_model="numpy")
def first_order(work):  # type: ignore[no-untyped-def]
    """No second-order parts: set, not multiplied away, for a lane may hold what the program before it left."""
    work.d[:], work.cq[:], work.c_rho[:], work.c_rest[:] = 0.0, 0.0, 0.0, 0.0


@njit(cache=True, error_model="numpy")
def _product(wanted, one, other, found):  # type: ignore[no-untyped-def]
    for k in range(found.size):
        found[k] = wanted[k] * one[k] * other[k]


@njit(cache=True, error_model="numpy")
def second_order(wanted, work):  # type: ignore[no-untyped-def]
    """What the products miss in the direction found last where ``wanted`` (L,) is 1; nothing where it is 0."""
    _spread(wanted, work.each)
    corrector(work.each, work.w, work.eta, work.ds, work.dz, work.d)
    for c in range(3):
        _product(work.each, work.dq[c], work.dzq[c], work.cq[c])
    for r in range(work.c_rho.shape[0]):
        _product(wanted, work.d_rho[r], work.dz_rho[r], work.c_rho[r])
    _product(wanted, work.d_rest[0], work.d_rest[1], work.c_rest[0])


@njit(cache=True, error_model="numpy")
def _web_targets(nu, present, c, q, zq, fq):  # type: ignore[no-untyped-def]
    for k in range(q.size):
        fq[k] = (present[k] * nu[k] - c[k]) / q[k] - zq[k]


@njit(cache=True, error_model="numpy")
def _web_right_sides(keep, rd, f, fq, sine, cosine, e):  # type: ignore[no-untyped-def]
    for k in range(sine.size):
        e[0, k] = -keep[k] * rd[0, k] + f[0, k] - fq[0, k]
    for k in range(sine.size):
        e[1, k] = -keep[k] * rd[1, k] + f[1, k] + fq[1, k] + fq[2, k]
        e[2, k] = -keep[k] * rd[2, k] + sine[k] * f[2, k] - cosine[k] * (fq[1, k] - fq[2, k])


@njit(cache=True, error_model="numpy")
def _with_peaks(dzb, budget, sine, centre, p, e):  # type: ignore[no-untyped-def]
    """What the multipliers of the peaks (p, turned to the webs) and of the budget add to the right sides."""
    for k in range(sine.size):
        e[0, k] -= budget[k] * dzb[k]
        e[1, k] += centre[0, k] * p[0, k] + centre[1, k] * p[1, k]
        e[2, k] += sine[k] * (centre[0, k] * p[1, k] - centre[1, k] * p[0, k])


@njit(cache=True, error_model="numpy")
def _web_slacks(e, edges, sine, ds, dq):  # type: ignore[no-untyped-def]
    for k in range(sine.size):
        ds[0, k], ds[1, k], ds[2, k] = e[0, k], e[1, k], sine[k] * e[2, k]
    for k in range(sine.size):
        dq[0, k], dq[1, k], dq[2, k] = -e[0, k], edges[0, k], edges[1, k]


@njit(cache=True, error_model="numpy")
def _web_multipliers(fq, zq, q, dq, dzq):  # type: ignore[no-untyped-def]
    for k in range(q.size):
        dzq[k] = fq[k] - zq[k] / q[k] * dq[k]


@njit(cache=True, error_model="numpy")
def _add_targets(ws, rp, keep, right):  # type: ignore[no-untyped-def]
    for t in range(keep.size):
        right[t] += ws[t] + keep[t] * rp[t]


@njit(cache=True, error_model="numpy")
def _size_of_terms(begin, terms_end, w, eta, f, dz, ds):  # type: ignore[no-untyped-def]
    """Steps of the sizes of the terms, from dZ = f - W^-2 dS."""
    for j in range(begin, terms_end):
        w0 = w[0, j]
        along = 2.0 * w0 * (w[1, j] * ds[1, j] + w[2, j] * ds[2, j])
        ds[0, j] = (eta[j] * eta[j] * (f[0, j] - dz[0, j]) + along) / (2.0 * w0 * w0 - 1.0)


@njit(cache=True, error_model="numpy")
def _solve(least_mass, one, work):  # type: ignore[no-untyped-def]
    """The steps of the multipliers of the peaks, the rows and the budget, and of the level."""
    right, d_level = work.right, work.d_rest[2]
    rows, lanes = one.floor.shape
    at_row = 2 * one.row.size
    substitute(work.m, right)
    d_level[:] = 0.0
    if not least_mass:
        for r in range(rows):
            for t in range(lanes):
                d_level[t] += right[at_row + r, t]
        for t in range(lanes):
            d_level[t] /= work.border_sum[t]
        for i in range(right.shape[0]):
            for t in range(lanes):
                right[i, t] -= d_level[t] * work.border[i, t]
    for r in range(rows):
        for t in range(lanes):
            work.dz_rho[r, t] = right[at_row + r, t]
    for t in range(lanes):
        work.d_rest[1, t] = -right[right.shape[0] - 1, t]


@njit(cache=True, error_model="numpy")
def direction(least_mass, one, state, work):  # type: ignore[no-untyped-def]
    """The step towards products ``nu`` that removes the share ``keep`` of the residuals."""
    rows, lanes = one.floor.shape
    cones, terms, at_cones = one.influence.shape[0], one.row.size, one.sine.size
    ds, dz, ws, rp, right, where, keep, e = (
        work.ds,
        work.dz,
        work.ws,
        work.rp,
        work.right,
        work.where,
        work.keep,
        work.e,
    )
    at_row, at_budget = 2 * terms, right.shape[0] - 1
    _spread(work.nu, work.each)
    targets(work.each, work.d, work.w, work.eta, work.lam, state.s, state.z, work.f, ws)
    for c in range(3):
        _web_targets(work.each, one.present[c], work.cq[c], state.q[c], state.zq[c], work.fq[c])
    _spread(keep, work.each)
    _web_right_sides(work.each, work.rd, work.f, work.fq, one.sine, one.cosine, e)
    for k in range(one.sine.size):
        work.kept[0, k], work.kept[1, k], work.kept[2, k] = e[0, k], e[1, k], e[2, k]
    _web_steps(work.block, one.cosine, work.kept, work.edges)
    _turned(work.kept, one.sine, one.centre, work.u)
    work.a[:] = 0.0
    _peaks_of(one.influence, work.u, work.a)
    right[:] = 0.0
    _add_products(one.budget, work.kept[0], right[at_budget])
    for t in range(lanes):
        target = (work.nu[t] - work.c_rest[0, t]) / state.rest[1, t]
        right[at_budget, t] = state.rest[0, t] - target - right[at_budget, t]
    for r in range(rows):
        for t in range(lanes):
            target = (work.nu[t] - work.c_rho[r, t]) / state.z_rho[r, t] - state.rho[r, t]
            right[at_row + r, t] = target + keep[t] * work.rp_row[r, t]
    for i in range(cones):
        at, begin, end = where[i], i * lanes, (i + 1) * lanes
        first = at_row + one.row[i] if i < terms else at - 1
        for t in range(lanes):
            right[at, t] = -work.a[0, begin + t]
            right[at + 1, t] = -work.a[1, begin + t]
        _add_targets(ws[0, at_cones + begin : at_cones + end], rp[0, begin:end], keep, right[first])
        _add_targets(ws[1, at_cones + begin : at_cones + end], rp[1, begin:end], keep, right[at])
        _add_targets(ws[2, at_cones + begin : at_cones + end], rp[2, begin:end], keep, right[at + 1])
    _solve(least_mass, one, work)
    # back to the webs
    for i in range(cones):
        at, begin = where[i], i * lanes
        first = at_row + one.row[i] if i < terms else at - 1
        for t in range(lanes):
            work.a[0, begin + t], work.a[1, begin + t] = right[at, t], right[at + 1, t]
        for t in range(lanes):
            dz[0, at_cones + begin + t] = right[first, t]
            dz[1, at_cones + begin + t], dz[2, at_cones + begin + t] = right[at, t], right[at + 1, t]
    _webs_of(one.influence, work.a, work.u)
    _spread(work.d_rest[1], work.each)
    _with_peaks(work.each, one.budget, one.sine, one.centre, work.u, e)
    _web_steps(work.block, one.cosine, e, work.edges)
    _web_slacks(e, work.edges, one.sine, ds, work.dq)
    for c in range(3):
        _web_multipliers(work.fq[c], state.zq[c], state.q[c], work.dq[c], work.dzq[c])
    multiplier_steps(one.sine.size, work.w, work.eta, work.f, ds, dz)
    d_left = work.d_rest[0]
    d_left[:] = 0.0
    _add_products(one.budget, work.dq[0], d_left)
    # the vectors of the peaks from the webs, which keeps them consistent
    _turned(e, one.sine, one.centre, work.u)
    work.a[:] = 0.0
    _peaks_of(one.influence, work.u, work.a)
    _spread(keep, work.each)
    for i in range(work.a.shape[1]):
        ds[0, at_cones + i] = -work.each[i] * rp[0, i]
        ds[1, at_cones + i] = work.a[0, i] - work.each[i] * rp[1, i]
        ds[2, at_cones + i] = work.a[1, i] - work.each[i] * rp[2, i]
    _size_of_terms(at_cones, at_cones + terms * lanes, work.w, work.eta, work.f, dz, ds)
    for r in range(rows):
        for t in range(lanes):
            work.d_rho[r, t] = work.d_rest[2, t] - keep[t] * work.rp_row[r, t]
    for i in range(terms):
        for t in range(lanes):
            work.d_rho[one.row[i], t] -= ds[0, at_cones + i * lanes + t]


@njit(cache=True, error_model="numpy")
def _lower(values, lowest):  # type: ignore[no-untyped-def]
    lanes = lowest.size
    for k in range(values.size // lanes):
        for t in range(lanes):
            lowest[t] = min(lowest[t], values[k * lanes + t])


@njit(cache=True, error_model="numpy")
def _until_zero(present, value, change, step):  # type: ignore[no-untyped-def]
    """Steps at which values reach 0 (n,)."""
    for k in range(value.size):
        reached = -value[k] / (change[k] if change[k] < 0.0 else 1.0)
        step[k] = reached if (change[k] < 0.0) & (present[k] > 0.0) else 1e300


@njit(cache=True, error_model="numpy")
def longest_step(one, state, work, longest):  # type: ignore[no-untyped-def]
    """The longest step in the direction that stays inside, at most ``longest``, into ``work.step``."""
    step, each = work.step, work.each
    webs = each[: one.sine.size]
    step[:] = longest
    cone_steps(state.s, work.ds, each)
    _lower(each, step)
    cone_steps(state.z, work.dz, each)
    _lower(each, step)
    for c in range(3):
        _until_zero(one.present[c], state.q[c], work.dq[c], webs)
        _lower(webs, step)
        _until_zero(one.present[c], state.zq[c], work.dzq[c], webs)
        _lower(webs, step)
    lane = each[: step.size]
    always = one.present[0]
    for r in range(state.rho.shape[0]):
        _until_zero(always, state.rho[r], work.d_rho[r], lane)
        _lower(lane, step)
        _until_zero(always, state.z_rho[r], work.dz_rho[r], lane)
        _lower(lane, step)
    for c in range(2):
        _until_zero(always, state.rest[c], work.d_rest[c], lane)
        _lower(lane, step)


@njit(cache=True, error_model="numpy")
def _move(step, change, value):  # type: ignore[no-untyped-def]
    for k in range(value.size):
        value[k] += step[k] * change[k]


@njit(cache=True, error_model="numpy")
def take_step(one, state, work):  # type: ignore[no-untyped-def]
    """Add the direction times ``work.step``."""
    step, each = work.step, work.each
    _spread(step, each)
    for c in range(3):
        _move(each, work.ds[c], state.s[c])
        _move(each, work.dz[c], state.z[c])
        _move(each, work.e[c], state.v[c])
        _move(each, work.dzq[c], state.zq[c])
        # without edges their slacks stay 1
        _product(each, one.present[c], work.dq[c], work.kept[c])
        for k in range(one.sine.size):
            state.q[c, k] += work.kept[c, k]
        _move(step, work.d_rest[c], state.rest[c])
    for r in range(state.rho.shape[0]):
        _move(step, work.d_rho[r], state.rho[r])
        _move(step, work.dz_rho[r], state.z_rho[r])
