"""A primal-dual interior point for many scaled programs of one shape, compiled.

The program is that of :mod:`optimizer.program.cone`; about a dozen steps of Mehrotra's predictor and
corrector for each stage. The webs are eliminated one by one, so that what is factored has the size of
the peaks only: two unknowns for every term, one for every row, three for every ceiling and one for
the budget. The blocks of the webs are inverted as sums of squares, without cancellation, and the
cones of the peaks stay in the system as they are: a norm may vanish at the optimum. Slacks are kept
consistent with the webs to rounding; what a step loses in complementarity the next one repairs.

The least mass starts from the point of the first stage that lies in the middle of the optima: the
analytic centre of {P <= target} is on the path of the first stage, with multipliers in proportion.

Notation, for one web: x the fraction of its reach, (a, b) the unbalance along and across its sector,
(x, a, s b) the slack of its cone; q the slacks 1 - x, a - c b and a + c b; s and c are sine and cosine
of the half-angle. A multiplier has the name of its slack with a z.
"""

from typing import NamedTuple

import numpy as np
from numba import njit

from optimizer.program.cones import (
    cholesky,
    corrector,
    multiplier_steps,
    scaling,
    step_to_boundary,
    substitute,
    targets,
)
from optimizer.response import Real

#: share of the way to the boundary that a step goes
_STEP = 0.99
_MOST_STEPS = 60
#: of the share above the optimum, and of the gap of the first stage, what the least mass does not use
_KEPT_BACK, _OPEN = 1e-5, 4.0
#: product of slack and multiplier, in units of the mass, at which the least mass starts
_CENTRALITY = 5e-3


class Programs(NamedTuple):
    """N scaled programs of one shape: Q cones (J terms, then ceilings), R rows, K webs."""

    row: np.ndarray  # (J,) row of each term
    floor: Real  # (N, R)
    cap: Real  # (N, Q - J)
    constant: Real  # (N, Q, 2)
    influence: Real  # (N, Q, K)
    centre: Real  # (N, K, 2)
    sine: Real  # (N, K)
    cosine: Real  # (N, K)
    sector: Real  # (N, K) 1 where the web has a sector, else 0
    mass: Real  # (N, K) mass at full reach
    budget: Real  # (N, K) the same relative to the budget; 0 without one


class State(NamedTuple):
    """Where one program stands. C = K + Q cones, those of the webs first."""

    v: Real  # (3, K) x, a, b
    s: Real  # (3, C)
    z: Real  # (3, C)
    q: Real  # (3, K)
    zq: Real  # (3, K)
    rho: Real  # (R,) slack of the rows
    z_rho: Real  # (R,)
    rest: Real  # (3,) slack of the budget, its multiplier, and the level above all rows


@njit(cache=True, error_model="numpy")
def new_state(webs, cones, rows):  # type: ignore[no-untyped-def]
    count = webs + cones
    return State(
        np.zeros((3, webs)),
        np.zeros((3, count)),
        np.zeros((3, count)),
        np.ones((3, webs)),
        np.ones((3, webs)),
        np.ones(rows),
        np.ones(rows),
        np.ones(3),
    )


@njit(cache=True, error_model="numpy")
def copy_state(to, of):  # type: ignore[no-untyped-def]
    to.v[:], to.s[:], to.z[:], to.q[:], to.zq[:] = of.v, of.s, of.z, of.q, of.zq
    to.rho[:], to.z_rho[:], to.rest[:] = of.rho, of.z_rho, of.rest


@njit(cache=True, error_model="numpy")
def start(one, state):  # type: ignore[no-untyped-def]
    """A point inside all limits, and above all norms; ceilings may be violated."""
    cones, webs = one.influence.shape
    rows, terms = one.floor.size, one.row.size
    full = 0.0
    for k in range(webs):
        full += one.budget[k]
    x = 0.5 if full <= 1.0 else 0.5 / full
    for k in range(webs):
        a = one.sector[k] * 0.5 * x
        state.v[0, k], state.v[1, k], state.v[2, k] = x, a, 0.0
        state.s[0, k], state.s[1, k], state.s[2, k] = x, a, 0.0
        state.z[0, k], state.z[1, k], state.z[2, k] = 1.0, 0.0, 0.0
        state.q[0, k], state.zq[0, k] = 1.0 - x, 1.0
        for i in range(1, 3):
            state.q[i, k] = a if one.sector[k] > 0.0 else 1.0
            state.zq[i, k] = one.sector[k]
    state.rest[0], state.rest[1] = 1.0 - full * x, 1.0
    for r in range(rows):
        state.rho[r], state.z_rho[r] = one.floor[r], 1.0 / rows
    for i in range(cones):
        j = webs + i
        ax, ay = one.constant[i, 0], one.constant[i, 1]
        for k in range(webs):
            ax += one.influence[i, k] * one.centre[k, 0] * state.v[1, k]
            ay += one.influence[i, k] * one.centre[k, 1] * state.v[1, k]
        size = np.sqrt(ax * ax + ay * ay) + 0.5
        if i >= terms:
            size = max(size, one.cap[i - terms])
        else:
            state.rho[one.row[i]] += size
        state.s[0, j], state.s[1, j], state.s[2, j] = size, ax, ay
        state.z[0, j], state.z[1, j], state.z[2, j] = 1.0 / rows, 0.0, 0.0
    state.rest[2] = np.max(state.rho) + 0.5
    for r in range(rows):
        state.rho[r] = state.rest[2] - state.rho[r]


@njit(cache=True, error_model="numpy")
def restart(one, state, target):  # type: ignore[no-untyped-def]
    """From a point of the first stage to the second: every multiplier at the price of the objective."""
    price = _CENTRALITY / (
        state.s[0, 0] * state.z[0, 0] + state.s[1, 0] * state.z[1, 0] + state.s[2, 0] * state.z[2, 0]
    )
    for r in range(state.rho.size):
        state.rho[r] = max(target - state.rest[2] + state.rho[r], 0.1 * state.rho[r])
    state.z[:] *= price
    state.zq[:] *= price
    state.z_rho[:] *= price
    state.rest[1] *= price


@njit(cache=True, error_model="numpy")
def _eliminate_webs(webs, w, eta, q, zq, sector, sine, cosine, centre, block):  # type: ignore[no-untyped-def]
    """Inverse of every web's 3 x 3 block, as sums of squares.

    The inverse in (a, b) is T = A + P p p' + M m m' with p = (c, 1) and m = (-c, 1) along the edges.
    block rows: 0-2 A (11, 12, 22), 9-10 P and M, 3-4 slope g of x over
    (a, b), 5 1/H_xx, 6-8 T turned into the frame (xx, xy, yy).
    """
    for k in range(webs):
        w0, w1, w2, e2 = w[0, k], w[1, k], w[2, k], eta[k] * eta[k]
        size = w1 * w1 + w2 * w2
        if size < 1e-200:
            w1, w2, size = 1e-100, 0.0, 1e-200
        s, c = sine[k], cosine[k]
        theta = zq[0, k] / q[0, k] * e2
        over = 2.0 * size + 1.0 + theta
        # the cone's block after x is (t t' + n n' / epsilon) / eta^2, n along w and t across it
        stiff = (1.0 + theta + 2.0 * theta * size) / over  # 1 / epsilon
        n11, n12, n22 = w1 * w1 / size, w1 * w2 / size, w2 * w2 / size
        # its adjugate (n n' + t t' / epsilon) / eta^2 in (a, b)
        a11 = s * s * (n11 + n22 * stiff) / e2
        a12 = s * n12 * (1.0 - stiff) / e2
        a22 = (n22 + n11 * stiff) / e2
        det = s * s * stiff / (e2 * e2)
        dp, dm = sector[k] * zq[1, k] / q[1, k], sector[k] * zq[2, k] / q[2, k]
        det += dp * (a11 - 2.0 * c * a12 + c * c * a22) + dm * (a11 + 2.0 * c * a12 + c * c * a22)
        det += dp * dm * 4.0 * c * c
        t11 = (a11 + c * c * (dp + dm)) / det
        t12 = (a12 + c * (dp - dm)) / det
        t22 = (a22 + dp + dm) / det
        block[0, k], block[1, k], block[2, k] = a11 / det, a12 / det, a22 / det
        block[9, k], block[10, k] = dp / det, dm / det
        block[3, k], block[4, k] = 2.0 * w0 * w1 / over, 2.0 * w0 * w2 / over * s
        block[5, k] = e2 / over
        cr, ci = centre[k, 0], centre[k, 1]
        block[6, k] = cr * cr * t11 - 2.0 * cr * ci * s * t12 + ci * ci * s * s * t22
        block[7, k] = cr * ci * t11 + (cr * cr - ci * ci) * s * t12 - cr * ci * s * s * t22
        block[8, k] = ci * ci * t11 + 2.0 * cr * ci * s * t12 + cr * cr * s * s * t22


@njit(cache=True, error_model="numpy", inline="always")
def _web_step(block, k, c, ra, rb):  # type: ignore[no-untyped-def]
    """(a, b) = T (ra, rb) and the changes a -+ c b of the slacks at the edges, in which P or M cancels exactly."""
    first, second = block[0, k] * ra + block[1, k] * rb, block[1, k] * ra + block[2, k] * rb
    p, m = block[9, k] * (c * ra + rb), block[10, k] * (rb - c * ra)
    along, across = first + c * (p - m), second + p + m
    return along, across, first - c * second - 2.0 * c * m, first + c * second + 2.0 * c * p


@njit(cache=True, error_model="numpy")
def run(least_mass, one, target, tolerance, middle, state, best, way):  # type: ignore[no-untyped-def]
    """Steps from a state until the gap is at most ``tolerance``, or no longer falls.

    Parameters
    ----------
    least_mass : the stage.
    target : least mass: largest value of a row.
    middle : first stage: gap at which the point is kept in ``way``; 0 for nowhere.
    best : the state with the smallest gap and residual, written here.

    Returns
    -------
    Steps taken to the best, and its gap and residual.
    """
    row, floor, cap, constant, influence = one.row, one.floor, one.cap, one.constant, one.influence
    centre, sine, cosine, sector, mass, budget = one.centre, one.sine, one.cosine, one.sector, one.mass, one.budget
    cones, webs = influence.shape
    rows, terms, count = floor.size, row.size, webs + cones
    v, s, z, q, zq, rho, z_rho = state.v, state.s, state.z, state.q, state.zq, state.rho, state.z_rho
    left, zb, level = state.rest[0], state.rest[1], state.rest[2]
    ax, ay = np.empty(cones), np.empty(cones)
    on_way = middle > 0.0
    w, eta, lam = np.empty((3, count)), np.empty(count), np.empty((3, count))
    f, ws = np.empty((3, count)), np.empty((3, count))
    d, ds, dz = np.zeros((3, count)), np.zeros((3, count)), np.zeros((3, count))
    dq_corr, dq, dzq = np.zeros((3, webs)), np.zeros((3, webs)), np.zeros((3, webs))
    fq = np.empty((3, webs))
    block, e, rd = np.empty((11, webs)), np.empty((3, webs)), np.empty((3, webs))
    gx, gy = np.empty(webs), np.empty(webs)
    rp, rp_row = np.empty((3, cones)), np.empty(rows)
    ceilings = cones - terms
    # unknowns: (y_x, y_y) of terms, rows, (mu, y_x, y_y) of ceilings, budget
    at_row, at_ceiling = 2 * terms, 2 * terms + rows
    n = at_ceiling + 3 * ceilings + 1
    at_budget = n - 1
    where = np.empty(cones, np.int64)
    for i in range(cones):
        where[i] = 2 * i if i < terms else at_ceiling + 3 * (i - terms) + 1
    m, right, border = np.empty((n, n)), np.empty(n), np.empty(n)
    d_rho, dz_rho, corr_rho = np.zeros(rows), np.zeros(rows), np.zeros(rows)
    d_left, dzb, corr_b = 0.0, 0.0, 0.0
    barrier = 1.0 * webs * 2 + cones + rows + 1
    for k in range(webs):
        barrier += 2.0 * sector[k]

    steps, stalled, reached, cautious = 0, 0, np.inf, False
    for iteration in range(_MOST_STEPS):
        # residuals
        primal, dual, costs = 0.0, 0.0, 0.0
        for i in range(cones):
            ax[i], ay[i] = constant[i, 0], constant[i, 1]
        for k in range(webs):
            along, across = v[1, k], sine[k] * v[2, k]
            ux = centre[k, 0] * along - centre[k, 1] * across
            uy = centre[k, 1] * along + centre[k, 0] * across
            px, py = 0.0, 0.0
            for i in range(cones):
                h = influence[i, k]
                ax[i] += h * ux
                ay[i] += h * uy
                px += h * z[1, webs + i]
                py += h * z[2, webs + i]
            cost = mass[k] if least_mass else 0.0
            rd[0, k] = cost - z[0, k] + zq[0, k] + budget[k] * zb
            dual = max(dual, abs(rd[0, k]))
            costs = max(costs, cost)
            rd[1, k] = -z[1, k] - zq[1, k] - zq[2, k] - (centre[k, 0] * px + centre[k, 1] * py)
            rd[2, k] = -sine[k] * (z[2, k] - centre[k, 1] * px + centre[k, 0] * py) + cosine[k] * (zq[1, k] - zq[2, k])
        for r in range(rows):
            rp_row[r] = rho[r] + floor[r] - (target if least_mass else level)
        for i in range(cones):
            j = webs + i
            rp[1, i], rp[2, i] = s[1, j] - ax[i], s[2, j] - ay[i]
            if i < terms:
                rp[0, i] = 0.0
                rp_row[row[i]] += s[0, j]
            else:
                rp[0, i] = s[0, j] - cap[i - terms]
            primal = max(primal, abs(rp[0, i]), abs(rp[1, i]), abs(rp[2, i]))
        for r in range(rows):
            primal = max(primal, abs(rp_row[r]))
        gap = left * zb
        for i in range(count):
            gap += s[0, i] * z[0, i] + s[1, i] * z[1, i] + s[2, i] * z[2, i]
        for k in range(webs):
            gap += q[0, k] * zq[0, k] + q[1, k] * zq[1, k] + q[2, k] * zq[2, k]
        for r in range(rows):
            gap += rho[r] * z_rho[r]
        mu = gap / barrier
        scale = 1.0
        if least_mass:
            scale = 0.0
            for k in range(webs):
                scale += mass[k] * v[0, k]
            scale = max(scale, 1e-3)
        merit = gap / scale + primal
        state.rest[0], state.rest[1], state.rest[2] = left, zb, level
        # a gap means nothing before the multipliers have taken in the costs
        if iteration == 0 or (merit < reached and dual <= 0.1 * costs + 0.1):
            stalled = stalled if merit > 0.9 * reached else 0
            reached, steps = merit if iteration > 0 else np.inf, iteration
            copy_state(best, state)
        stalled += 1
        if on_way and gap <= middle:
            on_way = False
            copy_state(way, state)
        if reached <= tolerance or stalled > (3 if reached < 1e-6 else 20) or not np.isfinite(merit):
            break

        # factor
        scaling(s, z, w, eta, lam)
        _eliminate_webs(webs, w, eta, q, zq, sector, sine, cosine, centre, block)
        for i in range(n):
            for j in range(i + 1):
                m[i, j] = 0.0
        for r in range(rows):
            m[at_row + r, at_row + r] = rho[r] / z_rho[r]
        for i in range(cones):
            j, at = webs + i, where[i]
            e2 = eta[j] * eta[j]
            w0, w1, w2 = w[0, j], w[1, j], w[2, j]
            first = at_row + row[i] if i < terms else at - 1
            m[first, first] += e2 * (2.0 * w0 * w0 - 1.0)
            if first > at:
                m[first, at] += 2.0 * e2 * w0 * w1
                m[first, at + 1] += 2.0 * e2 * w0 * w2
            else:
                m[at, first] += 2.0 * e2 * w0 * w1
                m[at + 1, first] += 2.0 * e2 * w0 * w2
            m[at, at] += e2 * (2.0 * w1 * w1 + 1.0)
            m[at + 1, at] += e2 * 2.0 * w1 * w2
            m[at + 1, at + 1] += e2 * (2.0 * w2 * w2 + 1.0)
        for k in range(webs):
            # H^-1 e_x turned into the frame, and its own x
            g1, g2 = block[3, k], block[4, k]
            ga, gb, _, _ = _web_step(block, k, cosine[k], g1, g2)
            gx[k] = centre[k, 0] * ga - centre[k, 1] * sine[k] * gb
            gy[k] = centre[k, 1] * ga + centre[k, 0] * sine[k] * gb
            m[at_budget, at_budget] += budget[k] * budget[k] * (g1 * ga + g2 * gb + block[5, k])
        m[at_budget, at_budget] += left / zb
        for i in range(cones):
            for j in range(i + 1):
                xx, xy, yy = 0.0, 0.0, 0.0
                for k in range(webs):
                    h = influence[i, k] * influence[j, k]
                    xx += h * block[6, k]
                    xy += h * block[7, k]
                    yy += h * block[8, k]
                a, b = where[i], where[j]
                m[a, b] += xx
                m[a + 1, b] += xy
                m[a + 1, b + 1] += yy
                if i != j:
                    m[a, b + 1] += xy
            bx, by = 0.0, 0.0
            for k in range(webs):
                bx += influence[i, k] * budget[k] * gx[k]
                by += influence[i, k] * budget[k] * gy[k]
            m[at_budget, where[i]] += bx
            m[at_budget, where[i] + 1] += by
        cholesky(m, n)
        if not least_mass:
            for i in range(n):
                border[i] = 0.0
            for r in range(rows):
                border[at_row + r] = 1.0
            substitute(m, border, n)
            border_sum = 0.0
            for r in range(rows):
                border_sum += border[at_row + r]

        nu, keep = 0.0, 1.0
        step = 0.0
        for phase in range(2):
            # right side: predictor, then corrector
            if phase == 0 or cautious:
                d[:] = 0.0
                dq_corr[:] = 0.0
                corr_rho[:] = 0.0
                corr_b = 0.0
            else:
                corrector(w, eta, ds, dz, d)
                for k in range(webs):
                    for i in range(3):
                        dq_corr[i, k] = dq[i, k] * dzq[i, k]
                for r in range(rows):
                    corr_rho[r] = d_rho[r] * dz_rho[r]
                corr_b = d_left * dzb
            targets(nu, d, w, eta, lam, s, z, f, ws)
            for k in range(webs):
                fq[0, k] = (nu - dq_corr[0, k]) / q[0, k] - zq[0, k]
                fq[1, k] = (sector[k] * nu - dq_corr[1, k]) / q[1, k] - zq[1, k]
                fq[2, k] = (sector[k] * nu - dq_corr[2, k]) / q[2, k] - zq[2, k]
            fb = (nu - corr_b) / left - zb
            for i in range(n):
                right[i] = 0.0
            right[at_budget] = -fb * left / zb
            for k in range(webs):
                ex = -keep * rd[0, k] + f[0, k] - fq[0, k]
                ea = -keep * rd[1, k] + f[1, k] + fq[1, k] + fq[2, k]
                eb = -keep * rd[2, k] + sine[k] * f[2, k] - cosine[k] * (fq[1, k] - fq[2, k])
                e[0, k], e[1, k], e[2, k] = ex, ea, eb
                ra, rb = ea + block[3, k] * ex, eb + block[4, k] * ex
                da, db, _, _ = _web_step(block, k, cosine[k], ra, rb)
                ux = centre[k, 0] * da - centre[k, 1] * sine[k] * db
                uy = centre[k, 1] * da + centre[k, 0] * sine[k] * db
                for i in range(cones):
                    right[where[i]] -= influence[i, k] * ux
                    right[where[i] + 1] -= influence[i, k] * uy
                right[at_budget] -= budget[k] * (block[3, k] * da + block[4, k] * db + block[5, k] * ex)
            for r in range(rows):
                f_row = (nu - corr_rho[r]) / z_rho[r] - rho[r]
                right[at_row + r] += f_row + keep * rp_row[r]
            for i in range(cones):
                j = webs + i
                right[where[i]] += ws[1, j] + keep * rp[1, i]
                right[where[i] + 1] += ws[2, j] + keep * rp[2, i]
                if i < terms:
                    right[at_row + row[i]] += ws[0, j]
                else:
                    right[where[i] - 1] += ws[0, j] + keep * rp[0, i]
            substitute(m, right, n)
            d_level = 0.0
            if not least_mass:
                for r in range(rows):
                    d_level += right[at_row + r]
                d_level /= border_sum
                for i in range(n):
                    right[i] -= d_level * border[i]
            # back to the webs
            zeta = right[at_budget]
            dzb = -zeta
            d_left = 0.0
            for i in range(cones):
                j = webs + i
                dz[0, j] = right[at_row + row[i]] if i < terms else right[where[i] - 1]
                dz[1, j], dz[2, j] = right[where[i]], right[where[i] + 1]
            for k in range(webs):
                px, py = 0.0, 0.0
                for i in range(cones):
                    px += influence[i, k] * right[where[i]]
                    py += influence[i, k] * right[where[i] + 1]
                ex = e[0, k] + budget[k] * zeta
                ea = e[1, k] + centre[k, 0] * px + centre[k, 1] * py
                eb = e[2, k] + sine[k] * (centre[k, 0] * py - centre[k, 1] * px)
                ra, rb = ea + block[3, k] * ex, eb + block[4, k] * ex
                da, db, dq[1, k], dq[2, k] = _web_step(block, k, cosine[k], ra, rb)
                dx = block[3, k] * da + block[4, k] * db + block[5, k] * ex
                ds[0, k], ds[1, k], ds[2, k] = dx, da, sine[k] * db
                e[0, k], e[1, k], e[2, k] = dx, da, db
                d_left -= budget[k] * dx
                dq[0, k] = -dx
                for i in range(3):
                    dzq[i, k] = fq[i, k] - zq[i, k] / q[i, k] * dq[i, k]
            for i in range(cones):
                # the vectors from the webs, which keeps them consistent; their sizes from dZ = f - W^-2 dS
                j = webs + i
                ds[1, j], ds[2, j] = -keep * rp[1, i], -keep * rp[2, i]
                for k in range(webs):
                    h, across = influence[i, k], ds[2, k]
                    ds[1, j] += h * (centre[k, 0] * e[1, k] - centre[k, 1] * across)
                    ds[2, j] += h * (centre[k, 1] * e[1, k] + centre[k, 0] * across)
                if i < terms:
                    w0 = w[0, j]
                    along = 2.0 * w0 * (w[1, j] * ds[1, j] + w[2, j] * ds[2, j])
                    ds[0, j] = (eta[j] * eta[j] * (f[0, j] - dz[0, j]) + along) / (2.0 * w0 * w0 - 1.0)
                else:
                    ds[0, j] = -keep * rp[0, i]
            for r in range(rows):
                dz_rho[r] = right[at_row + r]
                d_rho[r] = d_level - keep * rp_row[r]
            for i in range(terms):
                d_rho[row[i]] -= ds[0, webs + i]
            multiplier_steps(webs, w, eta, f, ds, dz)
            # the longest step that stays inside
            step = 1.0 / _STEP
            for i in range(count):
                step = min(step, step_to_boundary(s[0, i], s[1, i], s[2, i], ds[0, i], ds[1, i], ds[2, i]))
                step = min(step, step_to_boundary(z[0, i], z[1, i], z[2, i], dz[0, i], dz[1, i], dz[2, i]))
            for k in range(webs):
                for i in range(3):
                    if i == 0 or sector[k] > 0.0:
                        if dq[i, k] < 0.0:
                            step = min(step, -q[i, k] / dq[i, k])
                        if dzq[i, k] < 0.0:
                            step = min(step, -zq[i, k] / dzq[i, k])
            for r in range(rows):
                if d_rho[r] < 0.0:
                    step = min(step, -rho[r] / d_rho[r])
                if dz_rho[r] < 0.0:
                    step = min(step, -z_rho[r] / dz_rho[r])
            if d_left < 0.0:
                step = min(step, -left / d_left)
            if dzb < 0.0:
                step = min(step, -zb / dzb)
            if phase == 0:
                sigma = (1.0 - min(step, 1.0)) ** 3
                if on_way and gap > middle and gap * sigma < 0.3 * middle:
                    # not past the middle of the optima in one step
                    sigma = 0.5 * middle / gap
                if cautious:
                    sigma = max(sigma, 0.5)
                nu, keep = mu * sigma, 1.0 - sigma
        step *= _STEP
        # after a short step back to the middle: without the second-order part, towards the centre
        cautious = step < 0.1
        total = 0.0
        for i in range(n):
            total += right[i]
        if not (np.isfinite(total) and step > 1e-8):
            break
        for i in range(count):
            for c in range(3):
                s[c, i] += step * ds[c, i]
                z[c, i] += step * dz[c, i]
        for k in range(webs):
            for c in range(3):
                v[c, k] += step * e[c, k]
                q[c, k] += step * dq[c, k]
                zq[c, k] += step * dzq[c, k]
            if sector[k] == 0.0:
                q[1, k] = q[2, k] = 1.0
        for r in range(rows):
            rho[r] += step * d_rho[r]
            z_rho[r] += step * dz_rho[r]
        left += step * d_left
        zb += step * dzb
        level += step * d_level
    return steps, reached


@njit(cache=True, error_model="numpy")
def solve(programs, least_mass, share, tolerance, mass_tolerance):  # type: ignore[no-untyped-def]
    """Both stages of N programs.

    Parameters
    ----------
    programs : Programs.
    least_mass : whether the second stage is wanted.
    share : (N,) how far above the smallest value an optimum may be, in units of the value.
    tolerance : (N,) gap at which the first stage ends.
    mass_tolerance : gap relative to the mass at which the second ends.

    Returns
    -------
    (x, a, b) (2, N, 3, K), multipliers of the cones (2, N, Q, 2) and of the rows (2, N, R), for the first
    and for the second stage; and the unit of mass of the second stage (N,), which is that of the first answer.
    """
    number, cones, webs = programs.influence.shape
    rows, terms = programs.floor.shape[1], programs.row.size
    v, p = np.zeros((2, number, 3, webs)), np.zeros((2, number, cones, 2))
    prices, mass_unit = np.zeros((2, number, rows)), np.ones(number)
    mass = np.empty(webs)
    state, best = new_state(webs, cones, rows), new_state(webs, cones, rows)
    way = new_state(webs, cones, rows)
    for n in range(number):
        one = Programs(
            programs.row,
            programs.floor[n],
            programs.cap[n],
            programs.constant[n],
            programs.influence[n],
            programs.centre[n],
            programs.sine[n],
            programs.cosine[n],
            programs.sector[n],
            mass,
            programs.budget[n],
        )
        mass[:] = 0.0
        start(one, state)
        copy_state(way, state)
        middle = 0.5 * share[n] if least_mass else 0.0
        _, reached = run(False, one, 0.0, tolerance[n], middle, state, best, way)
        _keep(best, v[0, n], p[0, n], prices[0, n])
        if not least_mass:
            continue
        total = 0.0
        for k in range(webs):
            total += programs.mass[n, k] * np.sqrt(best.s[1, k] ** 2 + best.s[2, k] ** 2)
        mass_unit[n] = total if total > 0.0 else 1.0
        mass[:] = programs.mass[n] / mass_unit[n]
        target = -np.inf
        for r in range(rows):
            value = one.floor[r]
            for i in range(terms):
                if one.row[i] == r:
                    value += np.sqrt(best.s[1, webs + i] ** 2 + best.s[2, webs + i] ** 2)
            target = max(target, value)
        # what the first stage leaves open is kept back, so that the lightest is an optimum for certain
        target += share[n] * (1.0 - _KEPT_BACK) - _OPEN * reached
        restart(one, way, target)
        run(True, one, target, mass_tolerance, 0.0, way, best, state)
        _keep(best, v[1, n], p[1, n], prices[1, n])
    return v, p, prices, mass_unit


@njit(cache=True, error_model="numpy")
def _keep(best, v, p, price):  # type: ignore[no-untyped-def]
    webs = v.shape[1]
    v[:] = best.v
    for i in range(p.shape[0]):
        p[i, 0], p[i, 1] = -best.z[1, webs + i], -best.z[2, webs + i]
    price[:] = best.z_rho
