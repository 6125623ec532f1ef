"""What the steps of the vectors have in common, compiled: a matrix of blocks of 2 x 2, for two vectors each, with the
column and the row of a price. It is eliminated once, and solved for the predictor and the corrector.

Blocks stand entry by entry, block (j, Q) with the column of the price and below it the row. Names, and what stands
where, are as in :mod:`optimizer.program.kernel.disc_peaks`.
"""

from optimizer.program.kernel.compiling import fused
from optimizer.program.kernel.disc_peaks import (
    AX,
    AY,
    BLOCK,
    DS,
    DYX,
    DYY,
    J0,
    JX,
    JY,
    KA,
    KB,
    KC,
    KD,
    OVER,
    PAIR,
    YX,
    YY,
    F,
    L,
    S,
    add_multiple,
)
from optimizer.program.kernel.disc_webs import (
    BUDGET,
    D_BUDGET,
    D_PRICE,
    DU,
    DW,
    GIVE,
    KEEP,
    LANES,
    LEFT,
    MOST,
    OWN_MASS,
    R_LEFT,
    TOLL,
    TOLL_MASS,
    G,
    N,
    clear,
)


@fused
def eliminate(least_mass, budgeted, terms, basis, peak, own, matrix):  # type: ignore[no-untyped-def]
    """The equations of all y and of the price, as L and U in place, the blocks on the diagonal inverted.

    Block (j, Q) holds the column of the price, and below it the row, for vector j.
    """
    vectors = basis.size
    bordered, corner = least_mass or budgeted, matrix[vectors, vectors]
    for j in range(vectors):
        if j < terms:
            _couple(peak[j], L, YX)
        else:
            _couple(peak[j], S, AX)
        for i in range(vectors):
            of = N + BLOCK * (basis[j] + basis[i])
            _add_webs(peak[j], peak[i], own[of : of + BLOCK], matrix[j, i])
        if j < terms:
            _add_own(peak[j], L, YX, matrix[j, j])
        else:
            _add_own(peak[j], S, AX, matrix[j, j])
    if least_mass:
        clear(own, DW, DU)
        for j in range(terms):
            add_multiple(peak[j], YX, own[DW + PAIR * basis[j] : DU])
        for j in range(vectors):
            of = N + BLOCK * basis[j]
            _border(peak[j], own[DW:DU], own[of : of + 2 * BLOCK], 1.0 if j < terms else 0.0, matrix[j, vectors])
        for t in range(LANES):
            corner[t] = own[t + MOST]
    elif budgeted:
        for j in range(vectors):
            to, give = TOLL + PAIR * basis[j], GIVE + PAIR * basis[j]
            prices = own[BUDGET:D_BUDGET]
            _border_of_budget(peak[j], own[to : to + PAIR], own[give : give + PAIR], prices, matrix[j, vectors])
        for t in range(LANES):
            corner[t] = own[t + LEFT] - own[t + BUDGET] * own[t + TOLL_MASS]
    for i in range(vectors):
        pivot, border = matrix[i, i], matrix[i, vectors]
        _invert(pivot)
        for j in range(i + 1, vectors):
            below = matrix[j, i]
            _times(below, pivot)
            for k in range(i + 1, vectors):
                _take_block(below, matrix[i, k], matrix[j, k])
        if bordered:
            _close(pivot, border, corner)
            for j in range(i + 1, vectors):
                _take_border(matrix[j, i], matrix[i, j], border, matrix[j, vectors])
    if bordered:
        for t in range(LANES):
            corner[t] = 1.0 / corner[t]


@fused
def _couple(vector, size, pair):  # type: ignore[no-untyped-def]
    for t in range(LANES):
        ox, oy, f, yx, yy = vector[t + pair], vector[t + pair + LANES], vector[t + F], vector[t + YX], vector[t + YY]
        along = vector[t + size] * vector[t + L]
        vector[t + KA], vector[t + KB] = f * (along - ox * yx), -f * ox * yy
        vector[t + KC], vector[t + KD] = -f * oy * yx, f * (along - oy * yy)


@fused
def _add_webs(vector, source, webs, block):  # type: ignore[no-untyped-def]
    for t in range(LANES):
        f = source[t + F]
        ka, kb, kc, kd = f * vector[t + KA], f * vector[t + KB], f * vector[t + KC], f * vector[t + KD]
        a, b, c, d = webs[t], webs[t + LANES], webs[t + 2 * LANES], webs[t + 3 * LANES]
        block[t], block[t + LANES] = ka * a + kb * c, ka * b + kb * d
        block[t + 2 * LANES], block[t + 3 * LANES] = kc * a + kd * c, kc * b + kd * d


@fused
def _add_own(vector, size, pair, block):  # type: ignore[no-untyped-def]
    for t in range(LANES):
        ox, oy, ax, ay = vector[t + pair], vector[t + pair + LANES], vector[t + AX], vector[t + AY]
        along = vector[t + size] * vector[t + S]
        block[t] += along - ox * ax
        block[t + LANES] -= ox * ay
        block[t + 2 * LANES] -= oy * ax
        block[t + 3 * LANES] += along - oy * ay


@fused
def _border(vector, price, webs, term, border):  # type: ignore[no-untyped-def]
    for t in range(LANES):
        f, size, s, ax, ay = vector[t + F], term * vector[t + L], term * vector[t + S], vector[t + AX], vector[t + AY]
        border[t], border[t + LANES] = size * ax - s * vector[t + YX], size * ay - s * vector[t + YY]
        yx, yy, zx, zy = price[t], price[t + LANES], price[t + 2 * LANES], price[t + 3 * LANES]
        a, b, c, d = webs[t], webs[t + LANES], webs[t + 2 * LANES], webs[t + 3 * LANES]
        e, g, h, i = webs[t + 4 * LANES], webs[t + 5 * LANES], webs[t + 6 * LANES], webs[t + 7 * LANES]
        border[t + 2 * LANES] = term * ax + f * (yx * a + yy * c + zx * e + zy * h)
        border[t + 3 * LANES] = term * ay + f * (yx * b + yy * d + zx * g + zy * i)


@fused
def _border_of_budget(vector, toll, give, price, border):  # type: ignore[no-untyped-def]
    for t in range(LANES):
        border[t] = vector[t + KA] * toll[t] + vector[t + KB] * toll[t + LANES]
        border[t + LANES] = vector[t + KC] * toll[t] + vector[t + KD] * toll[t + LANES]
        f = vector[t + F] * price[t]
        border[t + 2 * LANES], border[t + 3 * LANES] = -f * give[t], -f * give[t + LANES]


@fused
def _invert(m):  # type: ignore[no-untyped-def]
    for t in range(LANES):
        a, b, c, d = m[t], m[t + LANES], m[t + 2 * LANES], m[t + 3 * LANES]
        per = 1.0 / (a * d - b * c)
        m[t], m[t + LANES], m[t + 2 * LANES], m[t + 3 * LANES] = d * per, -b * per, -c * per, a * per


@fused
def _times(m, n):  # type: ignore[no-untyped-def]
    for t in range(LANES):
        a, b, c, d = m[t], m[t + LANES], m[t + 2 * LANES], m[t + 3 * LANES]
        e, f, g, h = n[t], n[t + LANES], n[t + 2 * LANES], n[t + 3 * LANES]
        m[t], m[t + LANES] = a * e + b * g, a * f + b * h
        m[t + 2 * LANES], m[t + 3 * LANES] = c * e + d * g, c * f + d * h


@fused
def _close(pivot, border, corner):  # type: ignore[no-untyped-def]
    for t in range(LANES):
        a, b = border[t + 2 * LANES], border[t + 3 * LANES]
        x = a * pivot[t] + b * pivot[t + 2 * LANES]
        y = a * pivot[t + LANES] + b * pivot[t + 3 * LANES]
        border[t + 2 * LANES], border[t + 3 * LANES] = x, y
        corner[t] -= x * border[t] + y * border[t + LANES]


@fused
def _take_border(below, right, border, total):  # type: ignore[no-untyped-def]
    for t in range(LANES):
        x, y, a, b = border[t], border[t + LANES], border[t + 2 * LANES], border[t + 3 * LANES]
        total[t] -= below[t] * x + below[t + LANES] * y
        total[t + LANES] -= below[t + 2 * LANES] * x + below[t + 3 * LANES] * y
        total[t + 2 * LANES] -= a * right[t] + b * right[t + 2 * LANES]
        total[t + 3 * LANES] -= a * right[t + LANES] + b * right[t + 3 * LANES]


@fused
def _take_block(m, n, total):  # type: ignore[no-untyped-def]
    for t in range(LANES):
        a, b, c, d = m[t], m[t + LANES], m[t + 2 * LANES], m[t + 3 * LANES]
        e, f, g, h = n[t], n[t + LANES], n[t + 2 * LANES], n[t + 3 * LANES]
        total[t] -= a * e + b * g
        total[t + LANES] -= a * f + b * h
        total[t + 2 * LANES] -= c * e + d * g
        total[t + 3 * LANES] -= c * f + d * h


@fused
def _take_column(m, column, total):  # type: ignore[no-untyped-def]
    for t in range(LANES):
        x, y = column[t], column[t + LANES]
        total[t] -= m[t] * x + m[t + LANES] * y
        total[t + LANES] -= m[t + 2 * LANES] * x + m[t + 3 * LANES] * y


@fused
def _take_product(border, vector, total):  # type: ignore[no-untyped-def]
    for t in range(LANES):
        total[t] -= border[t + 2 * LANES] * vector[t] + border[t + 3 * LANES] * vector[t + LANES]


@fused
def solve_peaks(least_mass, budgeted, terms, basis, peak, own, matrix, step):  # type: ignore[no-untyped-def]
    """Steps of all y and of the prices, and of the multipliers of force and moment."""
    vectors = basis.size
    bordered, corner, price = least_mass or budgeted, matrix[vectors, vectors], step[vectors]
    for t in range(LANES):
        price[t] = own[t + R_LEFT]
    for j in range(vectors):
        vector, of = peak[j], G + PAIR * basis[j]
        if j < terms:
            _right_side(vector, own[of : of + PAIR], step[j], price)
        else:
            for t in range(LANES):
                vector[DS + t] = -own[t + KEEP] * vector[OVER + t]
            _right_side_below(vector, own[of : of + PAIR], step[j])
    if budgeted:
        for t in range(LANES):
            price[t] = own[t + R_LEFT] + own[t + BUDGET] * own[t + OWN_MASS]
    for j in range(vectors):
        for i in range(j):
            _take_column(matrix[j, i], step[i], step[j])
        if bordered:
            _take_product(matrix[j, vectors], step[j], price)
    if bordered:
        for t in range(LANES):
            price[t] *= corner[t]
    for n in range(vectors):
        i = vectors - 1 - n
        for j in range(i + 1, vectors):
            _take_column(matrix[i, j], step[j], step[i])
        if bordered:
            _take_multiple(price, matrix[i, vectors], step[i])
        _turn(matrix[i, i], step[i])
    clear(own, DW, DU)
    for j in range(vectors):
        _keep_step(step[j], peak[j], own[DW + PAIR * basis[j] : DU])
    for t in range(LANES):
        own[t + D_PRICE], own[t + D_BUDGET] = (price[t] if least_mass else 0.0), (price[t] if budgeted else 0.0)


@fused
def _right_side(vector, webs, right, price):  # type: ignore[no-untyped-def]
    for t in range(LANES):
        r0, size, gx, gy = vector[t + J0], vector[t + L], webs[t], webs[t + LANES]
        right[t] = size * vector[t + JX] - vector[t + YX] * r0 - vector[t + KA] * gx - vector[t + KB] * gy
        right[t + LANES] = size * vector[t + JY] - vector[t + YY] * r0 - vector[t + KC] * gx - vector[t + KD] * gy
        price[t] += r0 - vector[t + F] * (vector[t + YX] * gx + vector[t + YY] * gy)


@fused
def _right_side_below(vector, webs, right):  # type: ignore[no-untyped-def]
    for t in range(LANES):
        ds, s, gx, gy = vector[t + DS], vector[t + S], webs[t], webs[t + LANES]
        r0, rx, ry = (
            vector[t + J0] - vector[t + L] * ds,
            vector[t + JX] - vector[t + YX] * ds,
            vector[t + JY] - vector[t + YY] * ds,
        )
        right[t] = s * rx - vector[t + AX] * r0 - vector[t + KA] * gx - vector[t + KB] * gy
        right[t + LANES] = s * ry - vector[t + AY] * r0 - vector[t + KC] * gx - vector[t + KD] * gy


@fused
def _take_multiple(share, column, total):  # type: ignore[no-untyped-def]
    for t in range(LANES):
        total[t] -= column[t] * share[t]
        total[t + LANES] -= column[t + LANES] * share[t]


@fused
def _turn(m, vector):  # type: ignore[no-untyped-def]
    for t in range(LANES):
        x, y = vector[t], vector[t + LANES]
        vector[t] = m[t] * x + m[t + LANES] * y
        vector[t + LANES] = m[t + 2 * LANES] * x + m[t + 3 * LANES] * y


@fused
def _keep_step(step, vector, total):  # type: ignore[no-untyped-def]
    for t in range(LANES):
        f, x, y = vector[t + F], step[t], step[t + LANES]
        vector[t + DYX], vector[t + DYY] = x, y
        total[t] += f * x
        total[t + LANES] += f * y
