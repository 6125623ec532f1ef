"""Motion of rows and pressures in their chambers at single angles, element by element; compiled.

By arrays every step of such a formula is an operation of its own, which costs more than its arithmetic.

Shapes: L rows, those of one design after those of another; C chambers of a row, T angles.
"""

import numpy as np

from optimizer.numerics.compiling import in_place

#: what the motion of a row comes to
DISPLACEMENT, VELOCITY, ACCELERATION, ROD_SINE, ROD_COSINE, REMAINING = range(6)
VALUES = 6
_TURN = 2.0 * np.pi
#: a power is below or above what bounds it for certain where its base is so much beyond that of the bound
_BEYOND = 1e-9


@in_place
def motion_values(sine, cosine, rows, omega, exact, values):  # type: ignore[no-untyped-def]
    """Motion of rows by the formulas of :func:`optimizer.mechanics.kinematics.motion`.

    Parameters
    ----------
    sine, cosine : (L, T) of the crank angles.
    rows : (3, L) crank radius [m], rod ratio, 1 - rod ratio.
    omega : (N,) rad/s, of designs with as many rows each.
    exact : or cut off after the second order.
    values : (6, L, T) that are written: m, m/s, m/s^2, sine and cosine of the rod's angle, m.
    """
    number, count = sine.shape
    for r in range(number):
        radius, lam, speed = rows[0, r], rows[1, r], omega[r * omega.size // number]
        # 1 - lam^2 from 1 - lam
        short = rows[2, r] * (1.0 + lam)
        per_time, per_square = radius * speed, radius * (speed * speed)
        for t in range(count):
            sin, cos = sine[r, t], cosine[r, t]
            square, size = sin * sin, abs(cos)
            beta_sine, beta_cosine = lam * sin, np.sqrt(short + (lam * cos) * (lam * cos))
            # 1 - cos and 1 + cos, of which the smaller would cancel near its dead centre
            larger = 1.0 + size
            smaller = square / larger
            rise, fall = (smaller, larger) if cos >= 0.0 else (larger, smaller)
            cos_2 = (cos - sin) * (cos + sin)
            if exact:
                x = rise + lam * square / (1.0 + beta_cosine)
                c = sin + cos * beta_sine / beta_cosine
                bracket = short * cos_2 + (lam * lam) * ((cos * cos) * (cos * cos))
                a = cos + lam * bracket / (beta_cosine * beta_cosine * beta_cosine)
                upright = beta_cosine + lam * size
                u = upright if cos >= 0.0 else short / upright
                left = 2.0 * fall * u / (u + 1.0 + lam)
            else:
                x = rise + 0.5 * lam * square
                c = sin + lam * sin * cos
                a = cos + lam * cos_2
                left = fall - 0.5 * lam * square
            values[DISPLACEMENT, r, t], values[REMAINING, r, t] = radius * x, radius * left
            values[VELOCITY, r, t], values[ACCELERATION, r, t] = per_time * c, per_square * a
            values[ROD_SINE, r, t], values[ROD_COSINE, r, t] = beta_sine, beta_cosine


@in_place
def cycle_pressures(angle, displacement, remaining, rows, chambers, pressure):  # type: ignore[no-untyped-def]
    """Pressures of the four processes by the formulas of :func:`optimizer.mechanics.gas.gas_forces`.

    Parameters
    ----------
    angle : (L, T) rad, crank angles.
    displacement, remaining : (L, T) m.
    rows : (3, L), as of the motion.
    chambers : (7, L, C) area, pressures, clearance, exponents, whether it is closed, as in :class:`Chambers`.
    pressure : (L, C, T) Pa, which is written.
    """
    number, count = angle.shape
    for r in range(number):
        stroke = 2.0 * rows[0, r]
        for c in range(chambers.shape[2]):
            low, high, clear = chambers[1, r, c], chambers[2, r, c], chambers[3, r, c] * stroke
            expansion, compression, head = chambers[4, r, c], chambers[5, r, c], c % 2 == 0
            if chambers[6, r, c] == 0.0:
                for t in range(count):
                    pressure[r, c, t] = low
                continue
            # a comparison shows where suction and discharge last, without a power
            least = (low / high) ** (1.0 / expansion) * (1.0 - _BEYOND)
            most = (high / low) ** (1.0 / compression) * (1.0 + _BEYOND)
            for t in range(count):
                volume = (displacement[r, t] if head else remaining[r, t]) + clear
                if (angle[r, t] % _TURN < np.pi) == head:
                    share, value = clear / volume, low
                    if not share < least:
                        value = high * share**expansion
                        value = low if value < low else value
                else:
                    share, value = (stroke + clear) / volume, high
                    if not share > most:
                        value = low * share**compression
                        value = high if value > high else value
                pressure[r, c, t] = value
