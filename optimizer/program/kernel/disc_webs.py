"""The webs' part of a step of the interior point for discs, compiled: :mod:`optimizer.program.kernel.discs`.

Slack S and multiplier Z of every cone are joined by their product S o Z = (<S, Z>, s0 z + z0 s) of Jordan, as they are:
no scaling, no roots. Linearised, it gives for a web, with v its unbalance, x its size, p its multiplier and z the size
of that, q = 1 - x and zq = z - price x cost,

    x dz + <v, dp> + z dx + <p, dv> = r_0,   x dp + v dz + z dv + p dx = r,   q dz - zq dx = r_q + q cost dprice

which is solved for (dx, dz, dv) by one division: the determinant A zq + D q, A = x z - <v, p>, D = z^2 - |p|^2, has no
terms of opposite sign. So z dv = y - S dp, S = x + u m' of 2 x 2, with u = (zq v + q p) / (A zq + D q), m = x p - z v.
Without x in the program it stays 1: q = 0, zq = 1.

At the edges of a sector, with normals n_e, slacks e = <n_e, v> and multipliers g, p = -sum_j h_j w_j - sum_e g n_e. So
dp = dp_0 + E dv, with E = sum_e (g / e) n_e n_e', and

    dv = (z + S E)^-1 (y - S dp_0),   (z + S E)^-1 = (z + adj(E) adj(S)) / (z^2 + z tr(S E) + det(S) det(E))

where again nothing is subtracted that could cancel: det(S) = x z (zq (x^2 - |v|^2) + q A) / (A zq + D q). This inverse
and its product with S, by which v follows p, are for predictor and corrector; all else of a step follows from dv.

Numbers of a web stand at ``k WEB + NAME + t`` of ``web``, t the lane, those of its edges at ``k EDGE + NAME + t`` of
``edge`` (None without sectors), those of a program at ``NAME + t`` of ``own``. The compiler knows all offsets. It makes
vectors of the lanes. There are as many lanes however few programs, so that none depends on their number.
"""

import numpy as np

from optimizer.program.kernel.compiling import fused, fused_inlined

#: programs side by side: what a step needs of eight webs stays in the nearest cache
LANES = 16
(
    H1, H2, COST,  # influence on force and moment, mass at full reach
    VX, VY, X, Z, PX, PY,  # where the web stands
    PER_DET, PER,  # 1 / (A zq + D q), 1 / z or, with edges, 1 over their determinant
    R0, RX, RY, RQ,  # right sides: z r_0 - <p, r>, r, r_q
    DVX, DVY, DX, DZ, DPX, DPY,  # the step
    WEB,  # numbers of a web
) = range(0, 22 * LANES, LANES)  # fmt: skip

(
    N1X, N1Y, N2X, N2Y, PRESENT,  # normals of the edges; 1 where there are any, else 0
    E1, E2, G1, G2,  # slacks and multipliers
    PER1, PER2, PAIR1, PAIR2, PER_SIZES,  # 1 / e, 1 / (e g), and 1 / (z q + x zq)
    MXX, MXY, MYX, MYY,  # (z + S E)^-1
    TXX, TXY, TYX, TYY,  # (z + S E)^-1 S
    BX, BY,  # step of v by the price of the budget
    RS, Q1, Q2,  # right sides: r_0, and those of the edges over e g
    GX, GY,  # step of v where no multiplier of force, moment or budget changes
    DE1, DE2, DG1, DG2,  # the step, that of the multipliers over them
    EDGE,  # numbers of the edges of a web
) = range(0, 34 * LANES, LANES)  # fmt: skip

(
    U,  # what the webs add to force and moment, two numbers each
    N,  # sum_k h_i T h_j of (1, 1), (1, 2) and (2, 2), four numbers each
    G,  # sum_k h_j g_k, the steps of the webs where no multiplier of force, moment or budget changes
    DW, DU,  # the step
    TOLL, GIVE,  # what the price of the budget adds to the step of both, and they to that of the mass in it
    TOLL_MASS, OWN_MASS,  # what that price adds to that of the mass, and the webs by themselves
    BUDGET, D_BUDGET,  # price of the budget
    PRICE, D_PRICE,  # price of the objective
    MOST, LEFT,  # second stage: largest sum of the sizes, and what is left up to it; else what is left of the budget
    R_LEFT,
    GAP, MASS, CHANGE,  # sum of the products, mass, and what the step adds to the mass
    RISE,  # what the step adds to the sizes
    PRIMAL, DUAL,  # 1 over the longest steps, then the steps
    AIM,  # product of slack and multiplier that the step aims at
    KEEP,  # share of what is over the ceilings that the step takes away
    BOTH,  # 1 where the step allows for the second order, else 0
    OWN,  # numbers of a program
) = (LANES * row for row in (0, 4, 16, 20, 24, 28, 32, *range(36, 55)))  # fmt: skip


@fused_inlined
def _larger(first, second):  # type: ignore[no-untyped-def]
    return first if first > second else second


@fused_inlined
def determinant(s0, s1, s2):  # type: ignore[no-untyped-def]
    return s0 * s0 - s1 * s1 - s2 * s2


@fused_inlined
def crossing(det, s0, s1, s2, d0, d1, d2):  # type: ignore[no-untyped-def]
    """det S over the longest step with S + step D in the cone |(s1, s2)| <= s0, for S inside; at most 0: any step.

    It is det S times the larger eigenvalue of -D, seen from S. Both are real but for rounding.
    """
    b = s0 * d0 - s1 * d1 - s2 * d2
    disc = b * b - (d0 * d0 - d1 * d1 - d2 * d2) * det
    return np.sqrt(disc if disc > 0.0 else 0.0) - b


@fused
def clear(values, begin, end):  # type: ignore[no-untyped-def]
    for i in range(begin, end):
        values[i] = 0.0


@fused_inlined
def _add_vector(own, at, h1, h2, x, y):  # type: ignore[no-untyped-def]
    """A vector of a web, to what the webs add to force and moment."""
    own[at] += h1 * x
    own[at + LANES] += h1 * y
    own[at + 2 * LANES] += h2 * x
    own[at + 3 * LANES] += h2 * y


@fused_inlined
def _add_block(own, at, h, xx, xy, yx, yy):  # type: ignore[no-untyped-def]
    """A matrix of 2 x 2 of a web, likewise."""
    own[at] += h * xx
    own[at + LANES] += h * xy
    own[at + 2 * LANES] += h * yx
    own[at + 3 * LANES] += h * yy


@fused_inlined
def _hold_by_edges(sized, web, edge, own, at, on, t):  # type: ignore[no-untyped-def]
    """What the step of a web with edges is made of; apart, for its numbers fill the registers of the processor."""
    vx, vy, x, z, px, py = web[at + VX], web[at + VY], web[at + X], web[at + Z], web[at + PX], web[at + PY]
    n1x, n1y, n2x, n2y = edge[on + N1X], edge[on + N1Y], edge[on + N2X], edge[on + N2Y]
    e1, e2, g1, g2 = edge[on + E1], edge[on + E2], edge[on + G1], edge[on + G2]
    q = 1.0 - x if sized else 0.0
    zq = z - own[t + BUDGET] * web[at + COST] if sized else 1.0
    a, d = x * z - (vx * px + vy * py), z * z - px * px - py * py
    e12, g12, sizes, det = e1 * e2, g1 * g2, z * q + x * zq, a * zq + d * q
    own_det, own_edges = det * sizes, e12 * g12
    inverse = 1.0 / (own_det * own_edges)
    per_own, per_edges = inverse * own_edges, inverse * own_det
    per_det, per_e, per_g = per_own * sizes, per_edges * g12, per_edges * e12
    per1, per2 = per_e * e2, per_e * e1
    edge[on + PER1], edge[on + PER2], edge[on + PER_SIZES] = per1, per2, per_own * det
    edge[on + PAIR1], edge[on + PAIR2] = per1 * g2 * per_g, per2 * g1 * per_g
    k1, k2 = g1 * per1, g2 * per2
    exx, eyy = k1 * n1x * n1x + k2 * n2x * n2x, k1 * n1y * n1y + k2 * n2y * n2y
    exy, cross = k1 * n1x * n1y + k2 * n2x * n2y, n1x * n2y - n1y * n2x
    det_s = x * z * (zq * (x * x - vx * vx - vy * vy) + q * a) * per_det
    mx, my = x * px - z * vx, x * py - z * vy
    ux, uy = (vx * zq + px * q) * per_det, (vy * zq + py * q) * per_det
    sxx, sxy, syx, syy = x + ux * mx, ux * my, uy * mx, x + uy * my
    trace = sxx * exx + (sxy + syx) * exy + syy * eyy
    per = 1.0 / (z * z + z * trace + det_s * k1 * k2 * cross * cross)
    edge[on + TXX], edge[on + TYY] = per * (z * sxx + det_s * eyy), per * (z * syy + det_s * exx)
    edge[on + TXY], edge[on + TYX] = per * (z * sxy - det_s * exy), per * (z * syx - det_s * exy)
    edge[on + MXX], edge[on + MYY] = per * (z + eyy * syy + exy * syx), per * (z + exx * sxx + exy * sxy)
    edge[on + MXY], edge[on + MYX] = -per * (eyy * sxy + exy * sxx), -per * (exx * syx + exy * syy)
    web[at + PER_DET], web[at + PER] = per_det, per


@fused_inlined
def _alone_at_edges(yx, yy, q1, q2, edge, on):  # type: ignore[no-untyped-def]
    """Step of v, kept too, where no multiplier of force, moment or budget changes; normals are 0 where no edge is."""
    q1, q2 = q1 * edge[on + G1], q2 * edge[on + G2]
    ex, ey = edge[on + N1X] * q1 + edge[on + N2X] * q2, edge[on + N1Y] * q1 + edge[on + N2Y] * q2
    gx = edge[on + MXX] * yx + edge[on + MXY] * yy + edge[on + TXX] * ex + edge[on + TXY] * ey
    gy = edge[on + MYX] * yx + edge[on + MYY] * yy + edge[on + TYX] * ex + edge[on + TYY] * ey
    edge[on + GX], edge[on + GY] = gx, gy
    return gx, gy


@fused
def look_at_webs(sized, webs, web, edge, own):  # type: ignore[no-untyped-def]
    """Where the webs stand: what the matrix is made of, their gap, and the right sides of a step to products of 0."""
    clear(own, U, DW)
    clear(own, GAP, CHANGE)
    for k in range(webs):
        if edge is not None:
            for t in range(LANES):
                _hold_by_edges(sized, web, edge, own, k * WEB + t, k * EDGE + t, t)
        for t in range(LANES):
            at = k * WEB + t
            h1, h2, cost = web[at + H1], web[at + H2], web[at + COST]
            vx, vy, x, z, px, py = web[at + VX], web[at + VY], web[at + X], web[at + Z], web[at + PX], web[at + PY]
            q = 1.0 - x if sized else 0.0
            zq = z - own[t + BUDGET] * cost if sized else 1.0
            vp = vx * px + vy * py
            a, d = x * z - vp, z * z - px * px - py * py
            rx, ry, r0, rq = -(x * px + z * vx), -(x * py + z * vy), -x * d, -q * zq
            if edge is None:
                mx, my = x * px - z * vx, x * py - z * vy
                det = a * zq + d * q
                inverse = 1.0 / (det * z)
                per_det, per = inverse * z, inverse * det
                ux, uy = (vx * zq + px * q) * per_det, (vy * zq + py * q) * per_det
                txx, txy, tyx, tyy = per * (x + ux * mx), per * ux * my, per * uy * mx, per * (x + uy * my)
                dz, dx = (zq * r0 + d * rq) * per_det, (q * r0 - a * rq) * per_det
                gx, gy = (rx - vx * dz - px * dx) * per, (ry - vy * dz - py * dx) * per
            else:
                on = k * EDGE + t
                per_det, per = web[at + PER_DET], web[at + PER]
                txx, txy, tyx, tyy = edge[on + TXX], edge[on + TXY], edge[on + TYX], edge[on + TYY]
                dz, dx = (zq * r0 + d * rq) * per_det, (q * r0 - a * rq) * per_det
                present = edge[on + PRESENT]
                gx, gy = _alone_at_edges(rx - vx * dz - px * dx, ry - vy * dz - py * dx, -present, -present, edge, on)
                own[t + GAP] += present * (edge[on + E1] * edge[on + G1] + edge[on + E2] * edge[on + G2])
                edge[on + Q1], edge[on + Q2], edge[on + RS] = -present, -present, -(x * z + vp)
            _add_block(own, t + N, h1 * h1, txx, txy, tyx, tyy)
            _add_block(own, t + N + 4 * LANES, h1 * h2, txx, txy, tyx, tyy)
            _add_block(own, t + N + 8 * LANES, h2 * h2, txx, txy, tyx, tyy)
            _add_vector(own, t + G, h1, h2, gx, gy)
            _add_vector(own, t + U, h1, h2, vx, vy)
            own[t + GAP] += x * z + vp + q * zq
            own[t + MASS] += cost * x
            web[at + PER_DET], web[at + PER] = per_det, per
            web[at + R0], web[at + RX], web[at + RY], web[at + RQ] = r0, rx, ry, rq


@fused
def share_budget(webs, web, edge, own):  # type: ignore[no-untyped-def]
    """What the price of a budget and the webs do to each other: ``TOLL``, ``GIVE``, ``TOLL_MASS`` and, where no web has
    edges, ``OWN_MASS``."""
    clear(own, TOLL, BUDGET)
    for k in range(webs):
        for t in range(LANES):
            at = k * WEB + t
            h1, h2, cost = web[at + H1], web[at + H2], web[at + COST]
            vx, vy, x, z, px, py = web[at + VX], web[at + VY], web[at + X], web[at + Z], web[at + PX], web[at + PY]
            per_det, per, q = web[at + PER_DET], web[at + PER], 1.0 - x
            vp = vx * px + vy * py
            a, d, ahead = x * z - vp, z * z - px * px - py * py, cost * q * per_det
            mx, my = x * px - z * vx, x * py - z * vy
            # steps of v and of x by the price; of x by p
            bx, by, forth = -(vx * d - px * a), -(vy * d - py * a), -a * ahead
            if edge is None:
                bx, by, cx, cy = per * bx, per * by, mx, my
                own[t + TOLL_MASS] += cost * forth
                own[t + OWN_MASS] += cost * (q * web[at + R0] - a * web[at + RQ]) * per_det
            else:
                on = k * EDGE + t
                n1x, n1y, n2x, n2y = edge[on + N1X], edge[on + N1Y], edge[on + N2X], edge[on + N2Y]
                k1, k2 = edge[on + G1] * edge[on + PER1], edge[on + G2] * edge[on + PER2]
                bx, by = edge[on + MXX] * bx + edge[on + MXY] * by, edge[on + MYX] * bx + edge[on + MYY] * by
                edge[on + BX], edge[on + BY] = bx * ahead, by * ahead
                first, second = x * k1 * (n1x * my - n1y * mx), x * k2 * (n2x * my - n2y * mx)
                cx = z * per * (z * mx - n1y * first - n2y * second)
                cy = z * per * (z * my + n1x * first + n2x * second)
                # and of p by v
                first, second = k1 * (n1x * mx + n1y * my), k2 * (n2x * mx + n2y * my)
                along = first * (n1x * bx + n1y * by) + second * (n2x * bx + n2y * by)
                own[t + TOLL_MASS] += cost * (forth + q * per_det * along * ahead)
            bx, by, cx, cy = bx * ahead, by * ahead, -cx * ahead, -cy * ahead
            _add_vector(own, t + TOLL, h1, h2, bx, by)
            _add_vector(own, t + GIVE, h1, h2, cx, cy)


@fused_inlined
def _step_of_web(x, z, vx, vy, px, py, q, zq, a, d, per_det, per, r0, rx, ry, rq, dpx, dpy):  # type: ignore[no-untyped-def]
    """Steps (dx, dz, dvx, dvy) of a web without edges."""
    r = r0 + (x * px - z * vx) * dpx + (x * py - z * vy) * dpy
    dz, dx = (zq * r + d * rq) * per_det, (q * r - a * rq) * per_det
    return dx, dz, (rx - x * dpx - vx * dz - px * dx) * per, (ry - x * dpy - vy * dz - py * dx) * per


@fused_inlined
def _follow_edges(x, z, vx, vy, px, py, q, zq, per_sizes, rq, dpx, dpy, dvx, dvy, edge, on):  # type: ignore[no-untyped-def]
    """Steps (dx, dz, de1, de2, dg1, dg2, dpx, dpy) that follow from that of v; of dp what the edges add is missing."""
    n1x, n1y, n2x, n2y = edge[on + N1X], edge[on + N1Y], edge[on + N2X], edge[on + N2Y]
    de1, de2 = n1x * dvx + n1y * dvy, n2x * dvx + n2y * dvy
    dg1, dg2 = edge[on + Q1] - de1 * edge[on + PER1], edge[on + Q2] - de2 * edge[on + PER2]
    more1, more2 = edge[on + G1] * dg1, edge[on + G2] * dg2
    dpx, dpy = dpx - n1x * more1 - n2x * more2, dpy - n1y * more1 - n2y * more2
    # sizes from vectors: a web between its limits is off along itself by far more than rounding, and so is its size
    r = edge[on + RS] - vx * dpx - vy * dpy - px * dvx - py * dvy
    return (q * r - x * rq) * per_sizes, (zq * r + z * rq) * per_sizes, de1, de2, dg1, dg2, dpx, dpy


@fused
def add_own_mass(webs, web, edge, own):  # type: ignore[no-untyped-def]
    """``OWN_MASS`` of webs with edges, from their right sides."""
    clear(own, OWN_MASS, BUDGET)
    for k in range(webs):
        for t in range(LANES):
            at, on = k * WEB + t, k * EDGE + t
            x, z, cost = web[at + X], web[at + Z], web[at + COST]
            dx, _, _, _, _, _, _, _ = _follow_edges(
                x, z, web[at + VX], web[at + VY], web[at + PX], web[at + PY], 1.0 - x, z - own[t + BUDGET] * cost,
                edge[on + PER_SIZES], web[at + RQ], 0.0, 0.0, edge[on + GX], edge[on + GY], edge, on,
            )  # fmt: skip
            own[t + OWN_MASS] += cost * dx


@fused
def step_webs(sized, webs, web, edge, own):  # type: ignore[no-untyped-def]
    """The step of the webs, from that of the multipliers of force, moment and budget, and how long it may be."""
    clear(own, DU, TOLL)
    clear(own, CHANGE, AIM)
    for k in range(webs):
        for t in range(LANES):
            at = k * WEB + t
            h1, h2, cost = web[at + H1], web[at + H2], web[at + COST]
            vx, vy, x, z, px, py = web[at + VX], web[at + VY], web[at + X], web[at + Z], web[at + PX], web[at + PY]
            q = 1.0 - x if sized else 0.0
            zq = z - own[t + BUDGET] * cost if sized else 1.0
            a, d = x * z - (vx * px + vy * py), z * z - px * px - py * py
            rx, ry, r0, per_det, per = web[at + RX], web[at + RY], web[at + R0], web[at + PER_DET], web[at + PER]
            rq = web[at + RQ] + q * cost * own[t + D_BUDGET]
            dpx = -(h1 * own[t + DW] + h2 * own[t + DW + 2 * LANES])
            dpy = -(h1 * own[t + DW + LANES] + h2 * own[t + DW + 3 * LANES])
            if edge is None:
                dx, dz, dvx, dvy = _step_of_web(
                    x, z, vx, vy, px, py, q, zq, a, d, per_det, per, r0, rx, ry, rq, dpx, dpy
                )
            else:
                on = k * EDGE + t
                dvx = edge[on + GX] - edge[on + TXX] * dpx - edge[on + TXY] * dpy + edge[on + BX] * own[t + D_BUDGET]
                dvy = edge[on + GY] - edge[on + TYX] * dpx - edge[on + TYY] * dpy + edge[on + BY] * own[t + D_BUDGET]
                dx, dz, de1, de2, dg1, dg2, dpx, dpy = _follow_edges(
                    x, z, vx, vy, px, py, q, zq, edge[on + PER_SIZES], rq, dpx, dpy, dvx, dvy, edge, on
                )
                own[t + PRIMAL] = _larger(own[t + PRIMAL], _larger(-de1 * edge[on + PER1], -de2 * edge[on + PER2]))
                own[t + DUAL] = _larger(own[t + DUAL], _larger(-dg1, -dg2))
                edge[on + DE1], edge[on + DE2], edge[on + DG1], edge[on + DG2] = de1, de2, dg1, dg2
            dx = dx if sized else 0.0
            _add_vector(own, t + DU, h1, h2, dvx, dvy)
            own[t + CHANGE] += cost * dx
            # one division for all: they cost most here
            c = determinant(x, vx, vy)
            cd = c * d
            if sized:
                qz = q * zq
                per = 1.0 / (cd * qz)
                per_cd, per_qz = per * qz, per * cd
                free_x, free_z = dx * zq * per_qz, (own[t + D_BUDGET] * cost - dz) * q * per_qz
            else:
                per_cd, free_x, free_z = 1.0 / cd, 0.0, 0.0
            primal = _larger(crossing(c, x, vx, vy, dx, dvx, dvy) * d * per_cd, free_x)
            dual = _larger(crossing(d, z, px, py, dz, dpx, dpy) * c * per_cd, free_z)
            own[t + PRIMAL], own[t + DUAL] = _larger(own[t + PRIMAL], primal), _larger(own[t + DUAL], dual)
            web[at + DPX], web[at + DPY], web[at + DZ] = dpx, dpy, dz
            web[at + DX], web[at + DVX], web[at + DVY] = dx, dvx, dvy


@fused
def correct_webs(sized, webs, web, edge, own):  # type: ignore[no-untyped-def]
    """Right sides of a step to products ``AIM``, corrected by the second-order products of the last direction."""
    clear(own, G, DW)
    clear(own, OWN_MASS, BUDGET)
    for k in range(webs):
        for t in range(LANES):
            at = k * WEB + t
            h1, h2, cost, aim = web[at + H1], web[at + H2], web[at + COST], own[t + AIM]
            vx, vy, x, z, px, py = web[at + VX], web[at + VY], web[at + X], web[at + Z], web[at + PX], web[at + PY]
            dpx, dpy, dz, coupling = web[at + DPX], web[at + DPY], web[at + DZ], own[t + BOTH]
            dvx, dvy, dx = coupling * web[at + DVX], coupling * web[at + DVY], coupling * web[at + DX]
            more_x, more_y = -(dx * dpx + dz * dvx), -(dx * dpy + dz * dvy)
            q = 1.0 - x if sized else 0.0
            zq = z - own[t + BUDGET] * cost if sized else 1.0
            a, d = x * z - (vx * px + vy * py), z * z - px * px - py * py
            r0 = web[at + R0] + z * (aim - dx * dz - dvx * dpx - dvy * dpy) - px * more_x - py * more_y
            rx, ry = web[at + RX] + more_x, web[at + RY] + more_y
            rq = web[at + RQ] + aim + dx * (dz - own[t + D_BUDGET] * cost) if sized else 0.0
            per_det, per = web[at + PER_DET], web[at + PER]
            if edge is None:
                dx, dz, gx, gy = _step_of_web(x, z, vx, vy, px, py, q, zq, a, d, per_det, per, r0, rx, ry, rq, 0.0, 0.0)
            else:
                on = k * EDGE + t
                present, per1, per2 = edge[on + PRESENT], edge[on + PER1], edge[on + PER2]
                edge[on + RS] += aim - dx * dz - dvx * dpx - dvy * dpy
                q1 = (aim * edge[on + PAIR1] - coupling * edge[on + DE1] * edge[on + DG1] * per1 - 1.0) * present
                q2 = (aim * edge[on + PAIR2] - coupling * edge[on + DE2] * edge[on + DG2] * per2 - 1.0) * present
                edge[on + Q1], edge[on + Q2] = q1, q2
                dz, dx = (zq * r0 + d * rq) * per_det, (q * r0 - a * rq) * per_det
                gx, gy = _alone_at_edges(rx - vx * dz - px * dx, ry - vy * dz - py * dx, q1, q2, edge, on)
            _add_vector(own, t + G, h1, h2, gx, gy)
            own[t + OWN_MASS] += cost * dx
            web[at + R0], web[at + RX], web[at + RY], web[at + RQ] = r0, rx, ry, rq


@fused
def move_webs(sized, webs, web, own):  # type: ignore[no-untyped-def]
    """Slacks by ``PRIMAL``, multipliers by ``DUAL``; and their gap and mass then."""
    clear(own, GAP, CHANGE)
    for k in range(webs):
        for t in range(LANES):
            at, primal, dual = k * WEB + t, own[t + PRIMAL], own[t + DUAL]
            vx, vy = web[at + VX] + primal * web[at + DVX], web[at + VY] + primal * web[at + DVY]
            x, z = web[at + X] + primal * web[at + DX], web[at + Z] + dual * web[at + DZ]
            # moved with the others, not summed anew: sums of large multipliers may all but cancel
            px, py = web[at + PX] + dual * web[at + DPX], web[at + PY] + dual * web[at + DPY]
            web[at + VX], web[at + VY], web[at + X], web[at + Z], web[at + PX], web[at + PY] = vx, vy, x, z, px, py
            cost = web[at + COST]
            price = own[t + BUDGET] + dual * own[t + D_BUDGET]
            free = (1.0 - x) * (z - price * cost) if sized else 0.0
            own[t + GAP] += x * z + (vx * px + vy * py) + free
            own[t + MASS] += cost * x


@fused
def move_edges(webs, edge, own):  # type: ignore[no-untyped-def]
    """The same of the edges."""
    for k in range(webs):
        for t in range(LANES):
            on, primal, dual = k * EDGE + t, own[t + PRIMAL], own[t + DUAL]
            e1, e2 = edge[on + E1] + primal * edge[on + DE1], edge[on + E2] + primal * edge[on + DE2]
            g1, g2 = edge[on + G1] * (1.0 + dual * edge[on + DG1]), edge[on + G2] * (1.0 + dual * edge[on + DG2])
            edge[on + E1], edge[on + E2], edge[on + G1], edge[on + G2] = e1, e2, g1, g2
            own[t + GAP] += edge[on + PRESENT] * (e1 * g1 + e2 * g2)
