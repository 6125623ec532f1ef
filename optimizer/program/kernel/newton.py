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

from optimizer.program.kernel.compiling import inner
from optimizer.program.kernel.cones import (
    backward,
    cholesky,
    cone_steps,
    corrector,
    forward,
    multiplier_steps,
    scaling,
    targets,
)
from optimizer.program.kernel.lanes import add_products, move, product, raise_to_size, spread
from optimizer.program.kernel.webs import (
    eliminate_webs,
    in_frame,
    lengths,
    peaks_of,
    web_multipliers,
    web_residuals,
    web_right_sides,
    web_slacks,
    web_steps,
    web_targets,
    webs_of,
    with_peaks,
)


@inner
def residuals(least_mass, batch, state, work):  # type: ignore[no-untyped-def]
    """Residuals of the conditions of optimality, their sizes, and the gap, which is the sum of the products."""
    rows, lanes = batch.floor.shape
    terms, at_cones = batch.row.size, batch.sine.size
    s, z, rp, rp_row = state.s, state.z, work.rp, work.rp_row
    cones = batch.influence.shape[0]
    level = batch.target if least_mass else state.rest[2]
    for i in range(work.a.shape[1]):
        work.a[0, i], work.a[1, i] = z[1, at_cones + i], z[2, at_cones + i]
    webs_of(batch.influence, work.a, work.u)
    spread(state.rest[1], work.per_cone)
    web_residuals(
        work.per_cone, batch.mass, batch.budget, batch.sine, batch.cosine, batch.centre, work.u, z, state.zq, work.rd
    )
    work.dual[:] = 0.0
    raise_to_size(work.rd[0], work.dual)
    for i in range(work.a.shape[1]):
        work.a[0, i], work.a[1, i] = batch.constant[0, i], batch.constant[1, i]
    in_frame(state.v, batch.sine, batch.centre, work.u)
    peaks_of(batch.influence, work.u, work.a)
    for r in range(rows):
        for t in range(lanes):
            rp_row[r, t] = state.rho[r, t] + batch.floor[r, t] - level[t]
    for i in range(work.a.shape[1]):
        rp[0, i] = 0.0
        rp[1, i], rp[2, i] = s[1, at_cones + i] - work.a[0, i], s[2, at_cones + i] - work.a[1, i]
    for i in range(cones):
        for t in range(lanes):
            if i < terms:
                rp_row[batch.row[i], t] += s[0, at_cones + i * lanes + t]
            else:
                rp[0, i * lanes + t] = s[0, at_cones + i * lanes + t] - batch.cap[i - terms, t]
    work.primal[:] = 0.0
    for c in range(3):
        raise_to_size(rp[c], work.primal)
    for r in range(rows):
        raise_to_size(rp_row[r], work.primal)
    for t in range(lanes):
        work.gap[t] = state.rest[0, t] * state.rest[1, t]
    for c in range(3):
        add_products(s[c], z[c], work.gap)
        add_products(state.q[c], state.zq[c], work.gap)
    for r in range(rows):
        add_products(state.rho[r], state.z_rho[r], work.gap)


@inner
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


@inner
def _add_influence(influence, xx, xy, yy, where, m):  # type: ignore[no-untyped-def]
    """H T H', where T are the inverse blocks of the webs, to the block of the peaks."""
    cones, every = influence.shape
    lanes = m.shape[2]
    for i in range(cones):
        for j in range(i + 1):
            a, b = where[i], where[j]
            for k in range(0, every, lanes):
                for t in range(lanes):
                    weight = influence[i, k + t] * influence[j, k + t]
                    m[a, b, t] += weight * xx[k + t]
                    m[a + 1, b, t] += weight * xy[k + t]
                    m[a + 1, b + 1, t] += weight * yy[k + t]
                if i != j:
                    for t in range(lanes):
                        m[a, b + 1, t] += influence[i, k + t] * influence[j, k + t] * xy[k + t]


@inner
def factor(least_mass, batch, state, work):  # type: ignore[no-untyped-def]
    """The matrix of the step, factored; and what a level that rises by one asks of the rows."""
    rows, lanes = batch.floor.shape
    cones, terms, at_cones = batch.influence.shape[0], batch.row.size, batch.sine.size
    w, eta, block, m, least, where = work.w, work.eta, work.block, work.m, work.least, work.where
    scaling(state.s, state.z, w, eta, work.lam)
    eliminate_webs(w, eta, state.q, state.zq, batch.present[1], batch.sine, batch.cosine, batch.centre, block)
    m[:] = 0.0
    at_row = m.shape[0] - rows
    at_budget = at_row - 1
    for r in range(rows):
        for t in range(lanes):
            least[at_row + r, t] = m[at_row + r, at_row + r, t] = state.rho[r, t] / state.z_rho[r, t]
    for i in range(cones):
        at, begin, end = where[i], at_cones + i * lanes, at_cones + (i + 1) * lanes
        first = at_row + batch.row[i] if i < terms else at - 1
        _add_cone(first, at, eta[begin:end], w[0, begin:end], w[1, begin:end], w[2, begin:end], m)
    _add_influence(batch.influence, block[6], block[7], block[8], where, m)
    # H^-1 (budget e_x): its own x, and what it is in the peaks
    e = work.e
    e[:] = 0.0
    for k in range(batch.budget.size):
        e[0, k] = batch.budget[k]
    web_steps(block, batch.cosine, e, work.edges)
    for t in range(lanes):
        least[at_budget, t] = m[at_budget, at_budget, t] = state.rest[0, t] / state.rest[1, t]
    add_products(batch.budget, e[0], m[at_budget, at_budget])
    in_frame(e, batch.sine, batch.centre, work.u)
    work.a[:] = 0.0
    peaks_of(batch.influence, work.u, work.a)
    for i in range(cones):
        for t in range(lanes):
            m[at_budget, where[i], t] = work.a[0, i * lanes + t]
            m[at_budget, where[i] + 1, t] = work.a[1, i * lanes + t]
    cholesky(m, least)
    if not least_mass:
        work.border[:] = 1.0
        forward(m, at_row, work.border)
        work.border_square[:] = 0.0
        for r in range(rows):
            add_products(work.border[r], work.border[r], work.border_square)


@inner
def first_order(work):  # type: ignore[no-untyped-def]
    """No second-order parts: set, not multiplied away, for a lane may hold what the program before it left."""
    work.d[:], work.cq[:], work.c_rho[:], work.c_rest[:] = 0.0, 0.0, 0.0, 0.0


@inner
def second_order(share, work):  # type: ignore[no-untyped-def]
    """Second-order products of the last direction where ``share`` (L,) is 1; nothing where it is 0."""
    spread(share, work.per_cone)
    corrector(work.per_cone, work.w, work.eta, work.ds, work.dz, work.d)
    for c in range(3):
        product(work.per_cone, work.dq[c], work.dzq[c], work.cq[c])
    for r in range(work.c_rho.shape[0]):
        product(share, work.d_rho[r], work.dz_rho[r], work.c_rho[r])
    product(share, work.d_rest[0], work.d_rest[1], work.c_rest[0])


@inner
def _add_targets(ws, rp, keep, right):  # type: ignore[no-untyped-def]
    for t in range(keep.size):
        right[t] += ws[t] + keep[t] * rp[t]


@inner
def _size_of_terms(begin, terms_end, w, eta, f, dz, ds):  # type: ignore[no-untyped-def]
    """Steps of the sizes of the terms, from dZ = f - W^-2 dS."""
    for j in range(begin, terms_end):
        w0 = w[0, j]
        along = 2.0 * w0 * (w[1, j] * ds[1, j] + w[2, j] * ds[2, j])
        ds[0, j] = (eta[j] * eta[j] * (f[0, j] - dz[0, j]) + along) / (2.0 * w0 * w0 - 1.0)


@inner
def _solve(least_mass, batch, work):  # type: ignore[no-untyped-def]
    """The steps of the multipliers of the peaks, the rows and the budget, and of the level."""
    right, d_level = work.right, work.d_rest[2]
    rows, lanes = batch.floor.shape
    at_row = right.shape[0] - rows
    forward(work.m, 0, right)
    d_level[:] = 0.0
    if not least_mass:
        # half-way, where no more than the multipliers of the rows has to add up
        for r in range(rows):
            add_products(right[at_row + r], work.border[r], d_level)
        for t in range(lanes):
            d_level[t] /= work.border_square[t]
        for r in range(rows):
            for t in range(lanes):
                right[at_row + r, t] -= d_level[t] * work.border[r, t]
    backward(work.m, right)
    for r in range(rows):
        for t in range(lanes):
            work.dz_rho[r, t] = right[at_row + r, t]
    for t in range(lanes):
        work.d_rest[1, t] = -right[at_row - 1, t]


@inner
def direction(least_mass, batch, state, work):  # type: ignore[no-untyped-def]
    """The step towards products ``nu`` that removes the share ``keep`` of the residuals."""
    rows, lanes = batch.floor.shape
    cones, terms, at_cones = batch.influence.shape[0], batch.row.size, batch.sine.size
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
    at_row = right.shape[0] - rows
    at_budget = at_row - 1
    spread(work.nu, work.per_cone)
    targets(work.per_cone, work.d, work.w, work.eta, work.lam, state.s, state.z, work.f, ws)
    for c in range(3):
        web_targets(work.per_cone, batch.present[c], work.cq[c], state.q[c], state.zq[c], work.fq[c])
    spread(keep, work.per_cone)
    web_right_sides(work.per_cone, work.rd, work.f, work.fq, batch.sine, batch.cosine, e)
    for k in range(batch.sine.size):
        work.own[0, k], work.own[1, k], work.own[2, k] = e[0, k], e[1, k], e[2, k]
    web_steps(work.block, batch.cosine, work.own, work.edges)
    in_frame(work.own, batch.sine, batch.centre, work.u)
    work.a[:] = 0.0
    peaks_of(batch.influence, work.u, work.a)
    right[:] = 0.0
    add_products(batch.budget, work.own[0], right[at_budget])
    for t in range(lanes):
        target = (work.nu[t] - work.c_rest[0, t]) / state.rest[1, t]
        right[at_budget, t] = state.rest[0, t] - target - right[at_budget, t]
    for r in range(rows):
        for t in range(lanes):
            target = (work.nu[t] - work.c_rho[r, t]) / state.z_rho[r, t] - state.rho[r, t]
            right[at_row + r, t] = target + keep[t] * work.rp_row[r, t]
    for i in range(cones):
        at, begin, end = where[i], i * lanes, (i + 1) * lanes
        first = at_row + batch.row[i] if i < terms else at - 1
        for t in range(lanes):
            right[at, t] = -work.a[0, begin + t]
            right[at + 1, t] = -work.a[1, begin + t]
        _add_targets(ws[0, at_cones + begin : at_cones + end], rp[0, begin:end], keep, right[first])
        _add_targets(ws[1, at_cones + begin : at_cones + end], rp[1, begin:end], keep, right[at])
        _add_targets(ws[2, at_cones + begin : at_cones + end], rp[2, begin:end], keep, right[at + 1])
    _solve(least_mass, batch, work)
    # back to the webs
    for i in range(cones):
        at, begin = where[i], i * lanes
        first = at_row + batch.row[i] if i < terms else at - 1
        for t in range(lanes):
            work.a[0, begin + t], work.a[1, begin + t] = right[at, t], right[at + 1, t]
        for t in range(lanes):
            dz[0, at_cones + begin + t] = right[first, t]
            dz[1, at_cones + begin + t], dz[2, at_cones + begin + t] = right[at, t], right[at + 1, t]
    webs_of(batch.influence, work.a, work.u)
    spread(work.d_rest[1], work.per_cone)
    with_peaks(work.per_cone, batch.budget, batch.sine, batch.centre, work.u, work.response)
    for c in range(3):
        for k in range(batch.sine.size):
            e[c, k] += work.response[c, k]
    web_steps(work.block, batch.cosine, work.response, work.edges)
    web_steps(work.block, batch.cosine, e, work.edges)
    lengths(work.own, work.response, state.v, state.q, e, work.edges)
    web_slacks(e, work.edges, batch.sine, ds, work.dq)
    for c in range(3):
        web_multipliers(work.fq[c], state.zq[c], state.q[c], work.dq[c], work.dzq[c])
    multiplier_steps(batch.sine.size, work.w, work.eta, work.f, ds, dz)
    d_left = work.d_rest[0]
    d_left[:] = 0.0
    add_products(batch.budget, work.dq[0], d_left)
    # the vectors of the peaks from the webs, which keeps them consistent
    in_frame(e, batch.sine, batch.centre, work.u)
    work.a[:] = 0.0
    peaks_of(batch.influence, work.u, work.a)
    spread(keep, work.per_cone)
    for i in range(work.a.shape[1]):
        ds[0, at_cones + i] = -work.per_cone[i] * rp[0, i]
        ds[1, at_cones + i] = work.a[0, i] - work.per_cone[i] * rp[1, i]
        ds[2, at_cones + i] = work.a[1, i] - work.per_cone[i] * rp[2, i]
    _size_of_terms(at_cones, at_cones + terms * lanes, work.w, work.eta, work.f, dz, ds)
    for r in range(rows):
        for t in range(lanes):
            work.d_rho[r, t] = work.d_rest[2, t] - keep[t] * work.rp_row[r, t]
    for i in range(terms):
        for t in range(lanes):
            work.d_rho[batch.row[i], t] -= ds[0, at_cones + i * lanes + t]


@inner
def _stay_positive(present, value, change, step):  # type: ignore[no-untyped-def]
    """Steps (L,) that are no longer than those at which values (n L,) reach 0."""
    lanes = step.size
    for k in range(0, value.size, lanes):
        for t in range(lanes):
            falls = change[k + t] < 0.0
            reached = -value[k + t] / (change[k + t] if falls else 1.0)
            step[t] = min(step[t], reached if falls & (present[k + t] > 0.0) else 1e300)


@inner
def longest_step(batch, state, work, longest):  # type: ignore[no-untyped-def]
    """The longest step in the direction that stays inside, at most ``longest``, into ``work.step``."""
    step = work.step
    step[:] = longest
    cone_steps(state.s, work.ds, step)
    cone_steps(state.z, work.dz, step)
    for c in range(3):
        _stay_positive(batch.present[c], state.q[c], work.dq[c], step)
        _stay_positive(batch.present[c], state.zq[c], work.dzq[c], step)
    for r in range(state.rho.shape[0]):
        _stay_positive(work.always, state.rho[r], work.d_rho[r], step)
        _stay_positive(work.always, state.z_rho[r], work.dz_rho[r], step)
    for c in range(2):
        _stay_positive(work.always, state.rest[c], work.d_rest[c], step)


@inner
def take_step(batch, state, work):  # type: ignore[no-untyped-def]
    """Add the direction times ``work.step``."""
    step, cones = work.step, work.per_cone
    spread(step, cones)
    for c in range(3):
        move(cones, work.ds[c], state.s[c])
        move(cones, work.dz[c], state.z[c])
        move(cones, work.e[c], state.v[c])
        move(cones, work.dzq[c], state.zq[c])
        # without edges their slacks stay 1
        product(cones, batch.present[c], work.dq[c], work.own[c])
        for k in range(batch.sine.size):
            state.q[c, k] += work.own[c, k]
        move(step, work.d_rest[c], state.rest[c])
    for r in range(state.rho.shape[0]):
        move(step, work.d_rho[r], state.rho[r])
        move(step, work.dz_rho[r], state.z_rho[r])
