"""Steps of the interior point for webs without sector or budget, compiled: :mod:`optimizer.program.kernel.discs`.

Slack S and multiplier Z of every cone are joined by their product S o Z = (<S, Z>, s0 z + z0 s) of Jordan, as they are:
no scaling, no roots. Linearised, it gives for a web, with v its unbalance, x its size, p its multiplier and z the size
of that, q = 1 - x and zq = z - cost,

    x dz + <v, dp> + z dx + <p, dv> = r_0,   x dp + v dz + z dv + p dx = r,   q dz - zq dx = r_q

which is solved for (dx, dz, dv) by one division: the determinant A zq + D q, A = x z - <v, p>, D = z^2 - |p|^2, has no
terms of opposite sign. So dv = g - T dp with T of 2 x 2, and as p_k = -sum_j H_jk y_j what is left are the y of both
terms, and in the second stage the price of the objective. In the first stage x stays 1: q = 0, zq = 1.

A number of a web stands at ``k WEB + NAME + t`` of ``web``, t the lane; one of a program at ``NAME + t`` of ``own``; an
entry of the matrix at ``(5 i + j) LANES + t``; one of the unknowns (y_1, y_2, price) at ``i LANES + t`` of ``step``.
All offsets are known to the compiler, which thus sees that nothing overlaps and turns every loop over the lanes into
vector instructions. There are as many lanes however few programs are solved, so that what becomes of a program does
not depend on their number.
"""

import numpy as np

from optimizer.program.kernel.compiling import inlined, inner

#: programs side by side: what a step needs of eight webs stays in the nearest cache
LANES = 16

(
    H1, H2, COST,  # influence on both terms, mass at full reach
    VX, VY, X, Z,  # where the web stands
    PX, PY, PER_DET, PER_Z,  # its multiplier, 1 / (A zq + D q), 1 / z
    R0, RX, RY, RQ,  # right sides: z r_0 - <p, r>, r, r_q
    DVX, DVY, DX, DZ, DPX, DPY,  # the step
    WEB,  # numbers of a web
) = range(0, 22 * LANES, LANES)  # fmt: skip

(
    C1X, C1Y, C2X, C2Y,  # constants of both terms
    Y1X, Y1Y, Y2X, Y2Y, T1, T2, PRICE,  # multipliers and sizes of the terms, price of the objective
    MOST,  # second stage: largest sum of the sizes
    A1X, A1Y, A2X, A2Y, LEFT,  # vectors of the terms, what is left up to the largest sum
    N11, N12, N22,  # sum_k H_ik T_k H_jk, four numbers each
    G1X, G1Y, G2X, G2Y,  # sum_k H_jk g_k
    DA1X, DA1Y, DA2X, DA2Y, DT1, DT2,  # the step
    R1, R1X, R1Y, R2, R2X, R2Y, R_LEFT,  # right sides of the terms and of what is left
    GAP, MASS, CHANGE,  # sum of the products, mass, and what the step adds to what is minimised
    PRIMAL, DUAL,  # 1 over the longest steps, then the steps
    AIM,  # product of slack and multiplier that the step aims at
    OWN,  # numbers of a program
) = (LANES * row for row in (*range(18), 21, 25, *range(29, 53)))  # fmt: skip


@inlined
def _larger(first, second):  # type: ignore[no-untyped-def]
    return first if first > second else second


@inlined
def _inverse_step(s0, s1, s2, d0, d1, d2):  # type: ignore[no-untyped-def]
    """1 over the longest step with S + step D in the cone |(s1, s2)| <= s0, for S inside; at most 0: any step."""
    a = d0 * d0 - d1 * d1 - d2 * d2
    b = s0 * d0 - s1 * d1 - s2 * d2
    c = s0 * s0 - s1 * s1 - s2 * s2
    disc = b * b - a * c
    crossing = (np.sqrt(disc if disc > 0.0 else 0.0) - b) / c
    crossing = crossing if disc >= 0.0 else 0.0
    leaving = -d0 / s0
    return crossing if crossing > leaving else leaving


@inner
def _clear(values, begin, end):  # type: ignore[no-untyped-def]
    for i in range(begin, end):
        values[i] = 0.0


@inner
def look(least_mass, webs, web, own):  # type: ignore[no-untyped-def]
    """Where the programs stand: what the matrix is made of, the gap, and the right sides of a step to products of 0."""
    _clear(own, N11, DA1X)
    _clear(own, GAP, CHANGE)
    for t in range(LANES):
        own[t + A1X], own[t + A1Y] = own[t + C1X], own[t + C1Y]
        own[t + A2X], own[t + A2Y] = own[t + C2X], own[t + C2Y]
    for k in range(webs):
        first = k * WEB
        for t in range(LANES):
            at = first + t
            h1, h2, cost = web[at + H1], web[at + H2], web[at + COST]
            vx, vy, x, z = web[at + VX], web[at + VY], web[at + X], web[at + Z]
            px = -(h1 * own[t + Y1X] + h2 * own[t + Y2X])
            py = -(h1 * own[t + Y1Y] + h2 * own[t + Y2Y])
            q = 1.0 - x if least_mass else 0.0
            zq = z - cost if least_mass else 1.0
            vp = vx * px + vy * py
            a, d = x * z - vp, z * z - px * px - py * py
            det = a * zq + d * q
            both = 1.0 / (det * z)
            per_det, per_z = both * z, both * det
            # T
            mx, my = x * px - z * vx, x * py - z * vy
            nx, ny = (vx * zq + px * q) * per_det, (vy * zq + py * q) * per_det
            txx, txy, tyx, tyy = per_z * (x + nx * mx), per_z * nx * my, per_z * ny * mx, per_z * (x + ny * my)
            h11, h12, h22 = h1 * h1, h1 * h2, h2 * h2
            own[t + N11] += h11 * txx
            own[t + N11 + LANES] += h11 * txy
            own[t + N11 + 2 * LANES] += h11 * tyx
            own[t + N11 + 3 * LANES] += h11 * tyy
            own[t + N12] += h12 * txx
            own[t + N12 + LANES] += h12 * txy
            own[t + N12 + 2 * LANES] += h12 * tyx
            own[t + N12 + 3 * LANES] += h12 * tyy
            own[t + N22] += h22 * txx
            own[t + N22 + LANES] += h22 * txy
            own[t + N22 + 2 * LANES] += h22 * tyx
            own[t + N22 + 3 * LANES] += h22 * tyy
            # g
            rx, ry, r0, rq = -(x * px + z * vx), -(x * py + z * vy), -x * d, -q * zq
            dz, dx = (zq * r0 + d * rq) * per_det, (q * r0 - a * rq) * per_det
            gx, gy = (rx - vx * dz - px * dx) * per_z, (ry - vy * dz - py * dx) * per_z
            own[t + G1X] += h1 * gx
            own[t + G1Y] += h1 * gy
            own[t + G2X] += h2 * gx
            own[t + G2Y] += h2 * gy
            own[t + A1X] += h1 * vx
            own[t + A1Y] += h1 * vy
            own[t + A2X] += h2 * vx
            own[t + A2Y] += h2 * vy
            own[t + GAP] += x * z + vp + q * zq
            own[t + MASS] += cost * x
            web[at + PX], web[at + PY], web[at + PER_DET], web[at + PER_Z] = px, py, per_det, per_z
            web[at + R0], web[at + RX], web[at + RY], web[at + RQ] = r0, rx, ry, rq
    for t in range(LANES):
        price, t1, t2 = own[t + PRICE], own[t + T1], own[t + T2]
        ax, ay, bx, by = own[t + A1X], own[t + A1Y], own[t + A2X], own[t + A2Y]
        yx, yy, wx, wy = own[t + Y1X], own[t + Y1Y], own[t + Y2X], own[t + Y2Y]
        left = own[t + MOST] - t1 - t2 if least_mass else 0.0
        r1, r2, r_left = -(t1 * price + ax * yx + ay * yy), -(t2 * price + bx * wx + by * wy), -left * price
        own[t + GAP] -= r1 + r2 + r_left
        own[t + LEFT], own[t + R1], own[t + R2], own[t + R_LEFT] = left, r1, r2, r_left
        own[t + R1X], own[t + R1Y] = -(t1 * yx + price * ax), -(t1 * yy + price * ay)
        own[t + R2X], own[t + R2Y] = -(t2 * wx + price * bx), -(t2 * wy + price * by)


@inner
def eliminate(least_mass, own, matrix):  # type: ignore[no-untyped-def]
    """The equations of y_1, y_2 and the price, as L and U in place, the diagonal inverted.

    Of a term (price^2 - y y') (G + N dy) + (price at - y a') dy + (price a - at y) dprice, of the price what the sizes
    change by.
    """
    for t in range(LANES):
        price, t1, t2 = own[t + PRICE], own[t + T1], own[t + T2]
        ax, ay, bx, by = own[t + A1X], own[t + A1Y], own[t + A2X], own[t + A2Y]
        yx, yy, wx, wy = own[t + Y1X], own[t + Y1Y], own[t + Y2X], own[t + Y2Y]
        square = price * price
        k, m, n, o = (own[t + N11], own[t + N11 + LANES], own[t + N11 + 2 * LANES], own[t + N11 + 3 * LANES])
        e, f, g, h = (own[t + N12], own[t + N12 + LANES], own[t + N12 + 2 * LANES], own[t + N12 + 3 * LANES])
        p, q, r, s = (own[t + N22], own[t + N22 + LANES], own[t + N22 + 2 * LANES], own[t + N22 + 3 * LANES])
        ya, yb, yd = square - yx * yx, -yx * yy, square - yy * yy
        wa, wb, wd = square - wx * wx, -wx * wy, square - wy * wy
        matrix[t] = ya * k + yb * n + price * t1 - yx * ax
        matrix[t + LANES] = ya * m + yb * o - yx * ay
        matrix[t + 2 * LANES] = ya * e + yb * g
        matrix[t + 3 * LANES] = ya * f + yb * h
        matrix[t + 5 * LANES] = yb * k + yd * n - yy * ax
        matrix[t + 6 * LANES] = yb * m + yd * o + price * t1 - yy * ay
        matrix[t + 7 * LANES] = yb * e + yd * g
        matrix[t + 8 * LANES] = yb * f + yd * h
        matrix[t + 10 * LANES] = wa * e + wb * g
        matrix[t + 11 * LANES] = wa * f + wb * h
        matrix[t + 12 * LANES] = wa * p + wb * r + price * t2 - wx * bx
        matrix[t + 13 * LANES] = wa * q + wb * s - wx * by
        matrix[t + 15 * LANES] = wb * e + wd * g
        matrix[t + 16 * LANES] = wb * f + wd * h
        matrix[t + 17 * LANES] = wb * p + wd * r - wy * bx
        matrix[t + 18 * LANES] = wb * q + wd * s + price * t2 - wy * by
        if least_mass:
            matrix[t + 4 * LANES], matrix[t + 9 * LANES] = price * ax - t1 * yx, price * ay - t1 * yy
            matrix[t + 14 * LANES], matrix[t + 19 * LANES] = price * bx - t2 * wx, price * by - t2 * wy
            matrix[t + 20 * LANES] = ax + yx * k + yy * n + wx * e + wy * g
            matrix[t + 21 * LANES] = ay + yx * m + yy * o + wx * f + wy * h
            matrix[t + 22 * LANES] = bx + yx * e + yy * g + wx * p + wy * r
            matrix[t + 23 * LANES] = by + yx * f + yy * h + wx * q + wy * s
            matrix[t + 24 * LANES] = t1 + t2 + own[t + LEFT]
    unknowns = 5 if least_mass else 4
    for i in range(unknowns):
        pivot = 6 * i * LANES
        for t in range(LANES):
            matrix[pivot + t] = 1.0 / matrix[pivot + t]
        for j in range(i + 1, unknowns):
            below = (5 * j + i) * LANES
            for t in range(LANES):
                matrix[below + t] *= matrix[pivot + t]
            for k in range(i + 1, unknowns):
                for t in range(LANES):
                    matrix[(5 * j + k) * LANES + t] -= matrix[below + t] * matrix[(5 * i + k) * LANES + t]


@inner
def _solve(least_mass, own, matrix, step):  # type: ignore[no-untyped-def]
    """Steps of y_1, y_2 and the price."""
    for t in range(LANES):
        price = own[t + PRICE]
        square = price * price
        yx, yy, gx, gy = own[t + Y1X], own[t + Y1Y], own[t + G1X], own[t + G1Y]
        wx, wy, hx, hy = own[t + Y2X], own[t + Y2Y], own[t + G2X], own[t + G2Y]
        first, second = yx * gx + yy * gy - own[t + R1], wx * hx + wy * hy - own[t + R2]
        step[t] = price * own[t + R1X] - square * gx + yx * first
        step[t + LANES] = price * own[t + R1Y] - square * gy + yy * first
        step[t + 2 * LANES] = price * own[t + R2X] - square * hx + wx * second
        step[t + 3 * LANES] = price * own[t + R2Y] - square * hy + wy * second
        step[t + 4 * LANES] = own[t + R_LEFT] - first - second
    unknowns = 5 if least_mass else 4
    for i in range(unknowns):
        for j in range(i):
            for t in range(LANES):
                step[i * LANES + t] -= matrix[(5 * i + j) * LANES + t] * step[j * LANES + t]
    for i in range(unknowns - 1, -1, -1):
        for j in range(i + 1, unknowns):
            for t in range(LANES):
                step[i * LANES + t] -= matrix[(5 * i + j) * LANES + t] * step[j * LANES + t]
        for t in range(LANES):
            step[i * LANES + t] *= matrix[6 * i * LANES + t]
    if not least_mass:
        _clear(step, 4 * LANES, 5 * LANES)


@inner
def find_step(least_mass, webs, web, own, matrix, step):  # type: ignore[no-untyped-def]
    """The step of all unknowns, and how long it may be for slacks (``PRIMAL``) and multipliers (``DUAL``)."""
    _solve(least_mass, own, matrix, step)
    _clear(own, DA1X, DT1)
    _clear(own, CHANGE, AIM)
    for k in range(webs):
        first = k * WEB
        for t in range(LANES):
            at = first + t
            h1, h2, cost = web[at + H1], web[at + H2], web[at + COST]
            vx, vy, x, z, px, py = web[at + VX], web[at + VY], web[at + X], web[at + Z], web[at + PX], web[at + PY]
            q = 1.0 - x if least_mass else 0.0
            zq = z - cost if least_mass else 1.0
            a, d = x * z - (vx * px + vy * py), z * z - px * px - py * py
            per_det, per_z, rq = web[at + PER_DET], web[at + PER_Z], web[at + RQ]
            dpx = -(h1 * step[t] + h2 * step[t + 2 * LANES])
            dpy = -(h1 * step[t + LANES] + h2 * step[t + 3 * LANES])
            r0 = web[at + R0] + (x * px - z * vx) * dpx + (x * py - z * vy) * dpy
            dz = (zq * r0 + d * rq) * per_det
            dx = (q * r0 - a * rq) * per_det if least_mass else 0.0
            dvx = (web[at + RX] - x * dpx - vx * dz - px * dx) * per_z
            dvy = (web[at + RY] - x * dpy - vy * dz - py * dx) * per_z
            own[t + DA1X] += h1 * dvx
            own[t + DA1Y] += h1 * dvy
            own[t + DA2X] += h2 * dvx
            own[t + DA2Y] += h2 * dvy
            own[t + CHANGE] += cost * dx
            primal, dual = _inverse_step(x, vx, vy, dx, dvx, dvy), _inverse_step(z, px, py, dz, dpx, dpy)
            if least_mass:
                primal, dual = _larger(primal, dx / q), _larger(dual, -dz / zq)
            own[t + PRIMAL], own[t + DUAL] = _larger(own[t + PRIMAL], primal), _larger(own[t + DUAL], dual)
            web[at + DPX], web[at + DPY], web[at + DZ] = dpx, dpy, dz
            web[at + DX], web[at + DVX], web[at + DVY] = dx, dvx, dvy
    for t in range(LANES):
        price, d_price = own[t + PRICE], step[t + 4 * LANES]
        per_price = 1.0 / price
        ax, ay, yx, yy, t1 = own[t + A1X], own[t + A1Y], own[t + Y1X], own[t + Y1Y], own[t + T1]
        dax, day, dyx, dyy = own[t + DA1X], own[t + DA1Y], step[t], step[t + LANES]
        dt1 = (own[t + R1] - t1 * d_price - ax * dyx - ay * dyy - yx * dax - yy * day) * per_price
        bx, by, wx, wy, t2 = own[t + A2X], own[t + A2Y], own[t + Y2X], own[t + Y2Y], own[t + T2]
        dbx, dby, dwx, dwy = own[t + DA2X], own[t + DA2Y], step[t + 2 * LANES], step[t + 3 * LANES]
        dt2 = (own[t + R2] - t2 * d_price - bx * dwx - by * dwy - wx * dbx - wy * dby) * per_price
        primal = _larger(_inverse_step(t1, ax, ay, dt1, dax, day), _inverse_step(t2, bx, by, dt2, dbx, dby))
        dual = _larger(_inverse_step(price, yx, yy, d_price, dyx, dyy), _inverse_step(price, wx, wy, d_price, dwx, dwy))
        if least_mass:
            primal, dual = _larger(primal, (dt1 + dt2) / own[t + LEFT]), _larger(dual, -d_price * per_price)
        else:
            own[t + CHANGE] = dt1 + dt2
        own[t + DT1], own[t + DT2] = dt1, dt2
        own[t + PRIMAL], own[t + DUAL] = 1.0 / _larger(own[t + PRIMAL], primal), 1.0 / _larger(own[t + DUAL], dual)


@inner
def correct(least_mass, webs, web, own, step):  # type: ignore[no-untyped-def]
    """Right sides of a step to products ``AIM`` that allows for what the products miss in the direction found last."""
    _clear(own, G1X, DA1X)
    for k in range(webs):
        first = k * WEB
        for t in range(LANES):
            at = first + t
            h1, h2, cost, aim = web[at + H1], web[at + H2], web[at + COST], own[t + AIM]
            vx, vy, x, z, px, py = web[at + VX], web[at + VY], web[at + X], web[at + Z], web[at + PX], web[at + PY]
            dvx, dvy, dx = web[at + DVX], web[at + DVY], web[at + DX]
            dpx, dpy, dz = web[at + DPX], web[at + DPY], web[at + DZ]
            q = 1.0 - x if least_mass else 0.0
            zq = z - cost if least_mass else 1.0
            a, d = x * z - (vx * px + vy * py), z * z - px * px - py * py
            more_x, more_y = -(dx * dpx + dz * dvx), -(dx * dpy + dz * dvy)
            r0 = web[at + R0] + z * (aim - dx * dz - dvx * dpx - dvy * dpy) - px * more_x - py * more_y
            rx, ry = web[at + RX] + more_x, web[at + RY] + more_y
            rq = web[at + RQ] + aim + dx * dz if least_mass else 0.0
            per_det, per_z = web[at + PER_DET], web[at + PER_Z]
            dz, dx = (zq * r0 + d * rq) * per_det, (q * r0 - a * rq) * per_det
            gx, gy = (rx - vx * dz - px * dx) * per_z, (ry - vy * dz - py * dx) * per_z
            own[t + G1X] += h1 * gx
            own[t + G1Y] += h1 * gy
            own[t + G2X] += h2 * gx
            own[t + G2Y] += h2 * gy
            web[at + R0], web[at + RX], web[at + RY], web[at + RQ] = r0, rx, ry, rq
    for t in range(LANES):
        aim, d_price, dt1, dt2 = own[t + AIM], step[t + 4 * LANES], own[t + DT1], own[t + DT2]
        dax, day, dyx, dyy = own[t + DA1X], own[t + DA1Y], step[t], step[t + LANES]
        dbx, dby, dwx, dwy = own[t + DA2X], own[t + DA2Y], step[t + 2 * LANES], step[t + 3 * LANES]
        own[t + R1] += aim - dt1 * d_price - dax * dyx - day * dyy
        own[t + R1X] -= dt1 * dyx + d_price * dax
        own[t + R1Y] -= dt1 * dyy + d_price * day
        own[t + R2] += aim - dt2 * d_price - dbx * dwx - dby * dwy
        own[t + R2X] -= dt2 * dwx + d_price * dbx
        own[t + R2Y] -= dt2 * dwy + d_price * dby
        own[t + R_LEFT] += aim + (dt1 + dt2) * d_price


@inner
def go(webs, web, own, step):  # type: ignore[no-untyped-def]
    """Slacks by ``PRIMAL``, multipliers by ``DUAL``."""
    for k in range(webs):
        first = k * WEB
        for t in range(LANES):
            at, primal = first + t, own[t + PRIMAL]
            web[at + VX] += primal * web[at + DVX]
            web[at + VY] += primal * web[at + DVY]
            web[at + X] += primal * web[at + DX]
            web[at + Z] += own[t + DUAL] * web[at + DZ]
    for t in range(LANES):
        primal, dual = own[t + PRIMAL], own[t + DUAL]
        own[t + T1] += primal * own[t + DT1]
        own[t + T2] += primal * own[t + DT2]
        own[t + Y1X] += dual * step[t]
        own[t + Y1Y] += dual * step[t + LANES]
        own[t + Y2X] += dual * step[t + 2 * LANES]
        own[t + Y2Y] += dual * step[t + 3 * LANES]
        own[t + PRICE] += dual * step[t + 4 * LANES]
