"""What chambers of the four processes come to, in closed form, chamber by chamber; compiled.

Shapes: L rows, those of one design after those of another; C chambers of a row, T angles.
"""

import numpy as np
from numpy.polynomial.legendre import leggauss

from optimizer.numerics.compiling import in_place, inner

#: what a chamber comes to: travels at which suction and discharge open, m; the crank angles there, rad, by exact
#: kinematics and by those cut off after the second order; the work of a turn, J
SUCTION, DISCHARGE, SUCTION_ANGLE, DISCHARGE_ANGLE, SUCTION_CUT_OFF, DISCHARGE_CUT_OFF, WORK = range(7)
VALUES = 7
_TURN = 2.0 * np.pi
#: Gauss-Legendre quadrature on [0, 1]
_INSIDE, _SHARES = (np.array(values) for values in (0.5 * (1.0 + leggauss(10)[0]), 0.5 * leggauss(10)[1]))


@in_place
def chamber_values(rows, chambers, values):  # type: ignore[no-untyped-def]
    """Switching of every chamber and its work in a turn, by the formulas of :mod:`optimizer.mechanics.gas`.

    Parameters
    ----------
    rows : (3, L) crank radius [m], rod ratio, 1 - rod ratio.
    chambers : (7, L, C) area, pressures, clearance, exponents, whether it is closed, as in :class:`Chambers`.
    values : (7, L, C) that are written; nan where the chamber never delivers, and on open sides but for the work.
    """
    for r in range(chambers.shape[1]):
        radius, lam, margin = rows[0, r], rows[1, r], rows[2, r]
        stroke = 2.0 * radius
        for c in range(chambers.shape[2]):
            low, high, clear = chambers[1, r, c], chambers[2, r, c], chambers[3, r, c] * stroke
            expansion, compression = chambers[4, r, c], chambers[5, r, c]
            closed, head = chambers[6, r, c] != 0.0, c % 2 == 0
            log = _log_ratio(low, high, closed)
            suction = clear * np.expm1(log / expansion)
            # share of the full volume that compression takes away
            reduction = -np.expm1(-log / compression)
            discharge, before = stroke * (1.0 - reduction) - clear * reduction, (stroke + clear) * reduction
            if not (closed and suction < stroke and discharge > 0.0):
                suction, discharge, before = np.nan, np.nan, np.nan
            values[SUCTION, r, c], values[DISCHARGE, r, c] = suction, discharge
            left = stroke - suction
            for cut_off in range(2):
                exact = cut_off == 0
                # the head chamber grows over 0..pi and shrinks over pi..2 pi; the crank chamber the other way round
                if head:
                    opens = angle_at(suction, left, radius, lam, margin, exact)
                    closes = _TURN - angle_at(discharge, before, radius, lam, margin, exact)
                else:
                    opens = _TURN - angle_at(left, suction, radius, lam, margin, exact)
                    closes = angle_at(before, discharge, radius, lam, margin, exact)
                values[SUCTION_ANGLE + 2 * cut_off, r, c], values[DISCHARGE_ANGLE + 2 * cut_off, r, c] = opens, closes
            work = 0.0
            if closed:
                input_work = low * (stroke + clear) * _above_start(log, compression) + (high - low) * discharge
                recovery = low * (clear + suction) * _above_start(log, expansion)
                work = chambers[0, r, c] * (input_work - recovery)
            values[WORK, r, c] = work


@in_place
def work_values(angle, displacement, velocity, remaining, rows, own, chambers, travels, indicated, work):  # type: ignore[no-untyped-def]
    """Running integral of torque - mean of every row, by the formulas of :class:`optimizer.mechanics.row_work.RowWork`.

    Parameters
    ----------
    angle, displacement, velocity, remaining : (L, T) rad, m, m/s, m.
    rows, chambers : as of the chambers; (7, L, 0) without gas.
    own : (2, L) mass [kg], and work of the friction in a turn [J].
    travels : (2, L, C) m, at which suction and discharge open.
    indicated : (L, C) J, put into the gas in a turn.
    work : (L, T) J, which is written.
    """
    number, count = angle.shape
    for r in range(number):
        stroke, mass, rubbed = 2.0 * rows[0, r], own[0, r], own[1, r]
        for t in range(count):
            crank = angle[r, t] % _TURN
            # both ways count from the outer dead centre
            way = displacement[r, t] if crank < 0.5 * _TURN else stroke + remaining[r, t]
            value = 0.5 * mass * (velocity[r, t] * velocity[r, t]) + rubbed * (0.5 * way / stroke - crank / _TURN)
            gas = 0.0
            for c in range(chambers.shape[2]):
                head = c % 2 == 0
                path, left = displacement[r, t], remaining[r, t]
                # a chamber counts from the dead centre at which it is smallest
                since = crank if head else (crank + 0.5 * _TURN) % _TURN
                travel, rest = (path, left) if head else (left, path)
                opens, delivers = travels[0, r, c], travels[1, r, c]
                input_work = _gas_work(chambers[:, r, c], stroke, travel, rest, since < 0.5 * _TURN, opens, delivers)
                gas += input_work - indicated[r, c] * (since / _TURN)
            work[r, t] = value + gas


@inner
def angle_at(displacement, remaining, radius, lam, margin, exact):  # type: ignore[no-untyped-def]
    """Own crank angle in [0, pi] at which a piston has moved so far, rad.

    With t = x/r and u = 2 - t the cosine rule gives 1 - cos phi = t (2 (1 - lam) + lam u) / (2 (1 - lam + lam u)) and
    1 + cos phi = u (2 + lam u) / (2 (1 - lam + lam u)), so that tan^2(phi/2) is their quotient. Each is as good as its
    own distance, so the angle keeps its digits at both dead centres. Cut off after the second order the travel is
    t = (1 + lam) (1 - cos phi) - lam (1 - cos phi)^2 / 2, whose roots for 1 - cos phi and 1 + cos phi do not cancel.

    Parameters
    ----------
    displacement, remaining : m, whose sum is the stroke; nan where the piston never comes there.
    radius, lam, margin : m, rod ratio, 1 - rod ratio.
    exact : or cut off after the second order, as :func:`optimizer.mechanics.kinematics.motion`.
    """
    t, u = displacement / radius, remaining / radius
    t, u = 0.0 if t < 0.0 else t, 0.0 if u < 0.0 else u
    if exact:
        rise, fall = t * (2.0 * margin + lam * u), u * (2.0 + lam * u)
    else:
        # one root: (1 + lam)^2 - 2 lam t = (1 - lam)^2 + 2 lam u
        root = np.sqrt(margin * margin + 2.0 * lam * u)
        rise, fall = t / (1.0 + lam + root), u / (margin + root)
    return 2.0 * np.arctan2(np.sqrt(rise), np.sqrt(fall))


@inner
def _log_ratio(low, high, closed):  # type: ignore[no-untyped-def]
    """ln(p_d / p_s), 0 on open sides, which may be open to a vacuum; good for pressures that hardly differ."""
    return np.log1p((high - low) / low) if closed else 0.0


@inner
def _above_start(log, exponent):  # type: ignore[no-untyped-def]
    """g(log / n, n), work of a compression above its first pressure over first pressure times first volume."""
    length, power = log / exponent, exponent - 1.0
    if log < 1.0:
        # two terms cancel for small pressure ratios, and the integrand is smooth
        total = 0.0
        for k in range(_INSIDE.size):
            u = length * _INSIDE[k]
            total += np.expm1(exponent * u) * np.exp(-u) * _SHARES[k]
        return length * total
    return (length if power == 0.0 else np.expm1(power * length) / power) + np.expm1(-length)


@inner
def _gas_work(chamber, stroke, travel, rest, growing, opens, delivers):  # type: ignore[no-untyped-def]
    """Work put into the gas of a chamber (7,) since it was smallest, J.

    With l = ln(V / V_end) a polytropic of exponent n takes p V l phi((n - 1) l) from p and V, phi(z) = (e^z - 1) / z.
    """
    area, low, high, clear, expansion, compression, closed = chamber
    if closed == 0.0:
        # what is open takes the one pressure both ways
        return -area * low * travel
    clear *= stroke
    log = _log_ratio(low, high, True)
    # once it shrinks, what it took while it grew is that of the stroke
    way = travel if growing else stroke
    length = min(np.log1p(way / clear), log / expansion)
    intake = high * clear * length * _growth((1.0 - expansion) * length) + low * max(way - opens, 0.0)
    if growing:
        return -area * intake
    full = stroke + clear
    length = min(-np.log1p(-rest / full), log / compression)
    input_work = low * full * length * _growth((compression - 1.0) * length) + high * max(delivers - travel, 0.0)
    return area * (input_work - intake)


@inner
def _growth(power):  # type: ignore[no-untyped-def]
    """(e^z - 1) / z, 1 at 0."""
    return 1.0 if power == 0.0 else np.expm1(power) / power
