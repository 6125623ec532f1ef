"""Pins with clearance: which of them bear, as a convex program in two unknowns, with a certificate.

A rigid scroll turns by rho and shifts by t along the eccentric. Pin i is strained by d_i = a_i rho + t - eps_i, bears
beyond its clearance c_i, and then pushes with Q_i = k_i sign(d_i) max(|d_i| - c_i, 0). Equilibrium sum Q a = T,
sum Q = 0 is the stationary point of the strain energy less the work of the torque:

    minimise over rho, t   P = sum k_i/2 max(|d_i| - c_i, 0)^2 - T rho                                   (primal)
    maximise over Q        D = -sum (Q_i^2/(2 k_i) + c_i |Q_i| + eps_i Q_i),  sum Q a = T, sum Q = 0     (dual)

Both are convex and P = D at the optimum. D is strongly concave, so the loads are unique, and any Q in equilibrium is
within |Q_i - Q_i*| <= sqrt(2 k_i (P - D)) of them. The gap P - D is a sum of non-negative terms, one for each pin
(Fenchel-Young), and is computed as such, without cancellation. Pins are the last axis.

Where a rigid bearing holds the scroll on the eccentric, t = 0 and the loads need not sum to 0: one unknown less, and
one constraint less in the dual.
"""

import numpy as np

from optimizer.numerics.arrays import Real
from optimizer.numerics.records import record

_ITERATIONS = 80
_EPS = float(np.finfo(float).eps)


@record(frozen=True)
class Contact:
    """Loads of pins with clearance."""

    load: Real  # (..., n) N
    rotation: Real  # (...) rad, rho
    shift: Real  # (...) m, t
    gap: Real  # (...) J, P - D
    error_bound: Real  # (...) N, no load is further than this from the exact one


@record(frozen=True)
class _Scaled:
    """Rows of the program in lengths: torque over (lever times stiffness), all data of the order of 1."""

    lever: Real  # (m, n)
    stiffness: Real
    clearance: Real
    error: Real
    torque: Real  # (m,)
    is_rigid: bool = False

    def take(self, rows: np.ndarray) -> "_Scaled":
        return _Scaled(
            self.lever[rows],
            self.stiffness[rows],
            self.clearance[rows],
            self.error[rows],
            self.torque[rows],
            self.is_rigid,
        )

    def strain(self, turn: Real, shift: Real) -> Real:
        return self.lever * turn[:, None] + shift[:, None] - self.error

    def net(self, force: Real) -> Real:
        """Sum of forces (m, n) that a shift has to bring to 0."""
        return np.zeros(force.shape[:-1]) if self.is_rigid else np.sum(force, axis=-1)

    def beyond(self, strain: Real) -> Real:
        """Strain beyond the clearance, signed; 0 where the pin does not bear."""
        return strain - np.clip(strain, -self.clearance, self.clearance)


def pin_contact(
    lever: Real, torque: Real, stiffness: Real, clearance: Real, error: Real, is_rigid: bool = False
) -> Contact:
    """Loads at any number of shaft angles at once.

    Levers must differ where the torque is not 0; else nothing holds it, and the loads mean nothing.

    Parameters
    ----------
    lever : (..., n) m, a.
    torque : (...) N m, T.
    stiffness : (..., n) N/m, k > 0.
    clearance : (..., n) m, c >= 0.
    error : (..., n) m, eps.
    is_rigid : whether a rigid bearing keeps t = 0.
    """
    shape = np.broadcast_shapes(lever.shape, (*np.shape(torque), 1), stiffness.shape, clearance.shape, error.shape)
    a, k, c, eps = (np.broadcast_to(x, shape).reshape(-1, shape[-1]) for x in (lever, stiffness, clearance, error))
    moment = np.broadcast_to(torque, shape[:-1]).reshape(-1)
    stiffest = np.max(k, axis=-1)
    k = k / stiffest[:, None]
    mean = np.zeros(k.shape[:-1]) if is_rigid else np.sum(k * a, axis=-1) / np.sum(k, axis=-1)
    a = a - mean[:, None]
    reach = _nonzero(np.max(np.abs(a), axis=-1))
    moment = moment / (reach * stiffest)
    size = _nonzero(np.max(np.concatenate([np.abs(moment)[:, None], c, np.abs(eps)], axis=-1), axis=-1))
    scaled = _Scaled(a / reach[:, None], k, c / size[:, None], eps / size[:, None], moment / size, is_rigid)
    turn, shift = _minimise(scaled)
    load = _in_equilibrium(scaled, turn, shift)
    gap = _gap(scaled, turn, shift, load)
    force = stiffest * size
    # |Q - Q*| <= sqrt(2 k gap), and k <= 1 in these units
    bound = force * (np.sqrt(2.0 * gap) + _rounding(scaled, turn, shift, load))
    turn, shift = turn * size / reach, shift * size
    return Contact(
        (load * force[:, None]).reshape(shape),
        turn.reshape(shape[:-1]),
        (shift - mean * turn).reshape(shape[:-1]),
        (gap * force * size).reshape(shape[:-1]),
        bound.reshape(shape[:-1]),
    )


def _nonzero(value: Real) -> Real:
    return np.where(value > 0.0, value, 1.0)


def _minimise(scaled: _Scaled) -> tuple[Real, Real]:
    """Semismooth Newton with an exact line search, from the answer without clearance, (m,) and (m,).

    P is piecewise quadratic and convex with a continuous gradient: every step goes down, and the step is exact once
    the bearing pins are the right ones. The small multiple of the identity serves while too few pins bear.
    """
    a, k, eps = scaled.lever, scaled.stiffness, scaled.error
    whole, square = np.sum(k, axis=-1), np.sum(k * a**2, axis=-1)
    turn = (scaled.torque + np.sum(k * a * eps, axis=-1)) / _nonzero(square)
    shift = scaled.net(k * eps) / whole
    pending = np.arange(turn.size)
    for _ in range(_ITERATIONS):
        rows = scaled.take(pending)
        strain = rows.strain(turn[pending], shift[pending])
        force = rows.stiffness * rows.beyond(strain)
        moment, sum_ = np.sum(force * rows.lever, axis=-1) - rows.torque, rows.net(force)
        # the digits that bearing pins lose when error and clearance are taken off
        terms = np.abs(shift[pending])[:, None] + np.abs(rows.error) + rows.clearance + np.abs(strain)
        noise = np.sum(np.where(force != 0.0, rows.stiffness * terms, 0.0), axis=-1)
        scale = np.abs(rows.torque) + np.sum(np.abs(force), axis=-1)
        open_ = np.maximum(np.abs(moment), np.abs(sum_)) > _EPS * (noise + 4.0 * scale)
        if not np.any(open_):
            break
        pending, rows, strain = pending[open_], rows.take(open_), strain[open_]
        step = _newton_step(rows, strain, moment[open_], sum_[open_])
        along = _line_search(rows, strain, *step)
        turn[pending] += along * step[0]
        shift[pending] += along * step[1]
    return turn, shift


def _newton_step(rows: _Scaled, strain: Real, moment: Real, sum_: Real) -> tuple[Real, Real]:
    """Direction -(H + delta I)^-1 g, with a largest component of 1."""
    bearing = np.where(np.abs(strain) > rows.clearance, rows.stiffness, 0.0)
    delta = 4.0 * _EPS * np.sum(rows.stiffness, axis=-1)
    tt = np.sum(bearing * rows.lever**2, axis=-1) + delta
    ts = rows.net(bearing * rows.lever)
    ss = np.sum(bearing, axis=-1) + delta
    turn, shift = -(ss * moment - ts * sum_), -(tt * sum_ - ts * moment)
    # rounding can turn the direction of a singular system uphill; the gradient never is
    uphill = (turn * moment + shift * sum_ >= 0.0) | (tt * ss - ts**2 <= 0.0)
    turn, shift = np.where(uphill, -moment, turn), np.where(uphill, -sum_, shift)
    length = _nonzero(np.maximum(np.abs(turn), np.abs(shift)))
    return turn / length, shift / length


def _line_search(rows: _Scaled, strain: Real, turn: Real, shift: Real) -> Real:
    """Step (m,) to the minimum of P along a direction: the root of a rising, piecewise linear slope.

    Its kinks are where a pin begins or ceases to bear; the search halves their sorted list.
    """
    change = rows.lever * turn[:, None] + shift[:, None]
    moves = np.abs(change) > 0.0
    safe = np.where(moves, change, 1.0)
    kinks = [np.where(moves, (side * rows.clearance - strain) / safe, 0.0) for side in (-1.0, 1.0)]
    kink = np.sort(np.maximum(np.concatenate(kinks, axis=-1), 0.0), axis=-1)
    index = np.arange(turn.size)

    def slope(step: Real) -> Real:
        force = rows.stiffness * rows.beyond(strain + step[:, None] * change)
        return np.sum(force * change, axis=-1) - rows.torque * turn

    low, high = np.full(turn.size, -1), np.full(turn.size, kink.shape[-1])
    while np.any(high - low > 1):
        middle = np.clip((low + high) // 2, 0, kink.shape[-1] - 1)
        below = slope(kink[index, middle]) < 0.0
        low, high = np.where(below & (high - low > 1), middle, low), np.where(~below & (high - low > 1), middle, high)
    last = high == kink.shape[-1]
    start = np.where(low < 0, 0.0, kink[index, np.maximum(low, 0)])
    end = np.where(last, start + 1.0, kink[index, np.minimum(high, kink.shape[-1] - 1)])
    inside = strain + (0.5 * (start + end))[:, None] * change
    steepness = np.sum(np.where(np.abs(inside) > rows.clearance, rows.stiffness * change**2, 0.0), axis=-1)
    step = np.where(steepness > 0.0, -slope(start) / _nonzero(steepness), 0.0)
    return np.where(last, start + step, np.clip(start + step, start, end))


def _in_equilibrium(scaled: _Scaled, turn: Real, shift: Real) -> Real:
    """Loads of the bearing pins, with what rounding leaves of the two balances spread among them (m, n)."""
    strain = scaled.strain(turn, shift)
    load = scaled.stiffness * scaled.beyond(strain)
    bearing = np.where(np.abs(strain) > scaled.clearance, scaled.stiffness, 0.0)
    beyond, whole, square, mean = _about_mean(scaled, bearing)
    for _ in range(2):
        force = -scaled.net(load)
        moment = scaled.torque - np.sum(load * scaled.lever, axis=-1) - mean * force
        twist = np.where(square > 0.0, moment / _nonzero(square), 0.0)
        load = load + bearing * (twist[:, None] * beyond + (force / whole)[:, None])
    return load


def _about_mean(scaled: _Scaled, bearing: Real) -> tuple[Real, Real, Real, Real]:
    """Levers (m, n) about the stiffness's mean of the bearing pins, whole stiffness, second moment, and that mean."""
    whole = _nonzero(np.sum(bearing, axis=-1))
    mean = scaled.net(bearing * scaled.lever) / whole
    beyond = scaled.lever - mean[:, None]
    return beyond, whole, np.sum(bearing * beyond**2, axis=-1), mean


def _gap(scaled: _Scaled, turn: Real, shift: Real, load: Real) -> Real:
    """P - D for loads in equilibrium, (m,) >= 0: of each pin, strain energy + its conjugate - Q d."""
    strain = scaled.strain(turn, shift)
    over = np.abs(strain) - scaled.clearance
    stiffness, size = scaled.stiffness, np.abs(load)
    same = load * strain >= 0.0
    bears = (stiffness * np.maximum(over, 0.0) - size) ** 2 / (2.0 * stiffness) + size * np.maximum(-over, 0.0)
    against = 0.5 * stiffness * np.maximum(over, 0.0) ** 2 + size**2 / (2.0 * stiffness)
    against = against + size * (scaled.clearance + np.abs(strain))
    return np.sum(np.where(same, bears, against), axis=-1)


def _rounding(scaled: _Scaled, turn: Real, shift: Real, load: Real) -> Real:
    """What rounding alone may have done to a load, (m,).

    The strains are sums of parts that may cancel. What is left of the two balances, and what the levers have lost when
    their mean was taken off, is carried by all bearing pins as :func:`_in_equilibrium` spreads it.
    """
    strain = scaled.strain(turn, shift)
    parts = np.abs(scaled.lever * turn[:, None]) + np.abs(shift)[:, None] + np.abs(scaled.error) + scaled.clearance
    bearing = np.where(np.abs(strain) > scaled.clearance, scaled.stiffness, 0.0)
    beyond, whole, square, _ = _about_mean(scaled, bearing)
    # levers are at most 1: a sum of n products, each with a lever whose error is some eps
    off = (load.shape[-1] + 8.0) * _EPS * (np.sum(np.abs(load), axis=-1) + np.abs(scaled.torque))
    twist = np.where(square > 0.0, off / _nonzero(square), 0.0)
    spread = bearing * (twist[:, None] * np.abs(beyond) + (off / whole)[:, None])
    return np.max(4.0 * _EPS * scaled.stiffness * parts + spread, axis=-1)
