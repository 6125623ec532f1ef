"""Anti-rotation pins of a scroll: their loads over the turn, dead points and exact peaks.

A pin at z = R e^{j psi} of the scroll pushes along the eccentric e^{j theta} with Q. Its moment is Q a with the lever a
= R sin(theta - psi). For evenly spaced pins (Liu, Zhao and Li, equations (1) and (3))

    Q_i = 2 T_R / (n R) sin(theta - 2 pi (i - 1) / n).

For any pattern the elastic distribution minimises sum Q^2 / (2 k) subject to sum Q a = T_R and sum Q = 0, so that

    Q_i = T_R k_i d_i / sum k d^2,    d_i = a_i - sum k a / sum k = Im(e^{j theta} conj(w_i)),    w_i = z_i - z_mean.

Their energy balance (2) fixes only the mean of the moment over the turn: with one pin or two, equation (1) gives
2 T_R sin^2 theta. A rigid bearing of the drive carries the net force: without sum Q = 0 the scroll
turns about its own centre, w_i = z_i. An elastic one is one more pin at the centre, whose lever is 0.

A pattern holds no torque where all levers are equal; that happens only to pins (and a bearing that carries) on one
line, when the eccentric lies along it. Angles are in degrees, growing with the rotation; pins are the last axis.
"""

from dataclasses import replace

import numpy as np

from optimizer.mechanics.angles import direction
from optimizer.numerics.arrays import Complex, Real
from optimizer.numerics.records import record

#: pins whose places leave a line by less than this share of their span are on it; so near a dead point, in radians,
#: the loads are of the order of 1e6 times the usual ones and mean nothing
COLLINEAR = 1e-6
_PANEL_DEG = 0.5
_BISECTIONS = 48


@record(frozen=True)
class Pins:
    """Pins of a scroll, (..., n)."""

    place: Complex  # m, R e^{j psi}
    stiffness: Real  # N/m, or relative to each other
    #: a rigid bearing of the drive holds the scroll's centre and carries the net force
    is_rigid: bool = False

    @property
    def offset(self) -> Complex:
        """Places from where the scroll turns, w (..., n) m: from their mean, weighted with the stiffnesses."""
        if self.is_rigid:
            return self.place
        weight = self.stiffness / np.sum(self.stiffness, axis=-1, keepdims=True)
        # from pin to pin: the mean is next to a pin that is much stiffer than the others, and would cancel there
        apart = self.place[..., :, None] - self.place[..., None, :]
        return np.sum(weight[..., None, :] * apart, axis=-1)


@record(frozen=True)
class PeriodicTable:
    """A quantity over one turn: linear between its entries, and from the last one on to the first."""

    angle_deg: Real  # (m,) rising in [0, 360)
    value: Real  # (m,)

    def at(self, angle_deg: Real) -> Real:
        return np.interp(angle_deg, self.angle_deg, self.value, period=360.0)

    @property
    def keeps_its_sign(self) -> bool:
        return bool(np.all(self.value > 0.0) or np.all(self.value < 0.0))

    @property
    def changes_deg(self) -> Real:
        """Where it changes its sign between two entries, (q,) in [0, 360)."""
        following, next_value = np.append(self.angle_deg[1:], self.angle_deg[0] + 360.0), np.roll(self.value, -1)
        share = self.value / np.where(self.value == next_value, np.inf, self.value - next_value)
        angle = self.angle_deg + share * (following - self.angle_deg)
        return np.asarray(angle[(share > 0.0) & (share < 1.0)] % 360.0)


def gas_torques(tangential_force: Real, orbit_radius: Real) -> tuple[Real, Real]:
    """Rotation torque and orbiting resistance torque of the tangential gas force, N m (...).

    Assumption, usual for scroll compressors with equal wraps: the resultant of the tangential gas forces acts midway
    between the centres of orbiting and fixed scroll. So its lever about the centre of the orbiting scroll is r/2.
    All of a scroll that does not turn moves with r omega, so by its power the same force resists the motor
    with F_t r. Liu, Zhao and Li, section 3, names both moments and gives no formula.

    Parameters
    ----------
    tangential_force : (...) N.
    orbit_radius : (...) m.
    """
    resistance = tangential_force * orbit_radius
    return 0.5 * resistance, resistance


def levers(place: Complex, angle_deg: Real) -> Real:
    """Levers R sin(theta - psi) of the pins, (..., n) m, for places (..., n) m and shaft angles (...) degrees."""
    along = direction(angle_deg)[..., None]
    return along.imag * place.real - along.real * place.imag


def even_pin_loads(torque: Real, radius: Real, count: int, angle_deg: Real) -> Real:
    """Loads of evenly spaced pins by formula (3) of Liu, Zhao and Li, (..., n) N; in equilibrium for n >= 3.

    Parameters
    ----------
    torque : (...) N m.
    radius : (...) m.
    angle_deg : (...) degrees.
    """
    phase = direction(360.0 * np.arange(count) / count)
    factor = np.asarray(2.0 * torque / (count * radius))
    return factor[..., None] * levers(phase, angle_deg)


def elastic_loads(torque: Real, pins: Pins, angle_deg: Real) -> Real:
    """Loads of any pattern by the elastic distribution, (..., n) N; 0 where all levers are equal.

    Parameters
    ----------
    torque : (...) N m.
    angle_deg : (...) degrees.
    """
    size = np.max(np.abs(pins.place), axis=-1, keepdims=True)
    relative = pins.stiffness / np.max(pins.stiffness, axis=-1, keepdims=True)
    scaled = Pins(pins.place / size, relative, pins.is_rigid)
    lever = levers(scaled.offset, angle_deg)
    moment = torque / size[..., 0]
    if pins.is_rigid:
        return _about_centre(moment, lever, relative)
    load = _distribute(moment, np.zeros_like(moment), lever, relative)
    # very unequal stiffnesses cost digits, which one step of refinement brings back
    missing = moment - np.sum(load * lever, axis=-1)
    return load + _distribute(missing, -np.sum(load, axis=-1), lever, relative)


def _distribute(moment: Real, force: Real, lever: Real, stiffness: Real) -> Real:
    """Elastic loads with sum Q a = moment and sum Q = force; the 2x2 system, solved about the mean lever."""
    whole = np.sum(stiffness, axis=-1)
    mean = np.sum(stiffness * lever, axis=-1) / whole
    beyond = lever - mean[..., None]
    square = np.sum(stiffness * beyond**2, axis=-1)
    turn = np.where(square > 0.0, (moment - mean * force) / np.where(square > 0.0, square, 1.0), 0.0)
    return stiffness * (turn[..., None] * beyond + (force / whole)[..., None])


def _about_centre(moment: Real, lever: Real, stiffness: Real) -> Real:
    """Elastic loads with sum Q a = moment, whatever their sum."""
    square = np.sum(stiffness * lever**2, axis=-1)
    turn = np.where(square > 0.0, moment / np.where(square > 0.0, square, 1.0), 0.0)
    return stiffness * turn[..., None] * lever


def principal(offset: Complex, weight: Real) -> tuple[Real, Real, Real]:
    """Principal axes of sum weight w w^T: major and minor semi-axis (...) m and direction of the major, rad (...).

    The minor one from the area, major^2 minor^2 = sum over pairs of (w_i x w_k)^2 (Cauchy and Binet): a sum without
    cancellation, so that a pattern near a line, or one whose soft pins alone keep it off a line, keeps its width.
    """
    weighted = np.sqrt(weight) * offset
    axes, values, _ = np.linalg.svd(np.stack([weighted.real, weighted.imag], axis=-2), full_matrices=False)
    major = values[..., 0]
    cross = np.imag(np.conj(weighted)[..., :, None] * weighted[..., None, :])
    area = np.sqrt(0.5 * np.sum(cross**2, axis=(-2, -1)))
    minor = np.where(major > 0.0, area / np.where(major > 0.0, major, 1.0), 0.0)
    return major, minor, np.arctan2(axes[..., 1, 0], axes[..., 0, 0])


def dead_points(place: Complex) -> Real:
    """Shaft angles in [0, 360) at which a pattern (n,) of at least two pins holds no torque, (0,) or (2,) degrees.

    The levers are all equal where the eccentric lies along a line through all pins.
    """
    major, minor, along = principal(place - np.mean(place), np.ones(place.shape))
    if minor > COLLINEAR * major:
        return np.zeros(0)
    return _opposite_angles(np.rad2deg(along))


def _opposite_angles(angle_deg: Real) -> Real:
    """The angle in [0, 180) and its opposite; on a round figure where rounding alone keeps it off."""
    round_figure = np.round(angle_deg, 6)
    near = np.where(np.abs(angle_deg - round_figure) < 1e-10, round_figure, angle_deg)
    first = np.mod(near, 180.0) + 0.0
    return np.array([first, first + 180.0])


def at_dead_point(angle_deg: Real, dead_deg: Real) -> np.ndarray:
    """Whether shaft angles (...) are at one of the dead points (d,)."""
    away = np.mod(angle_deg[..., None] - dead_deg + 180.0, 360.0) - 180.0
    return np.any(np.abs(away) <= np.rad2deg(COLLINEAR), axis=-1)


@record(frozen=True)
class LoadShapes:
    """Loads of n pins as T_R(theta) c sin(theta - g) / (1 - e cos(2 (theta - b))); a rigid bearing's is the last.

    The formula has e = 0; the elastic distribution 1 - e = 2 s^2 / (S^2 + s^2), S and s the semi-axes of the pattern.
    """

    factor: Real  # (n,) c, 1/m
    phase_deg: Real  # (n,) g
    eccentricity: float  # e
    remainder: float  # 1 - e, without cancellation
    axis_deg: float  # b

    @classmethod
    def even(cls, phase_deg: Real, radius: float) -> "LoadShapes":
        return cls(np.full(phase_deg.shape, 2.0 / (phase_deg.size * radius)), phase_deg, 0.0, 1.0, 0.0)

    @classmethod
    def elastic(cls, pins: Pins) -> "LoadShapes":
        relative = pins.stiffness / np.max(pins.stiffness)
        offset = Pins(pins.place, relative, pins.is_rigid).offset
        major, minor, axis = principal(offset, relative)
        whole = float(major**2 + minor**2)
        push = relative * offset
        if pins.is_rigid:
            push = np.append(push, -np.sum(push))
        return cls(
            2.0 * np.abs(push) / whole,
            np.mod(np.rad2deg(np.angle(push)), 360.0),
            float((major - minor) * (major + minor)) / whole,
            2.0 * float(minor) ** 2 / whole,
            float(np.rad2deg(axis)),
        )

    def parts(self, angle_deg: Real) -> tuple[Real, Real, Real, Real]:
        """sin and cos of theta - g, the denominator and its derivative at angles (n, ...)."""
        own = np.deg2rad(angle_deg - self.phase_deg[:, None])
        twice = np.deg2rad(angle_deg - self.axis_deg)
        denominator = self.remainder + 2.0 * self.eccentricity * np.sin(twice) ** 2
        return np.sin(own), np.cos(own), denominator, 2.0 * self.eccentricity * np.sin(2.0 * twice)

    def candidates(self) -> Real:
        """Angles (n, c) in [0, 360) where the loads of a constant torque are largest, roots of

        (A/2) cos(t - g) + (B/4) cos(3t - g - 2b) - (3B/4) cos(t - 2b + g) = 0,  B = e A: a cubic in e^{2jt}.
        """
        phase = np.deg2rad(self.phase_deg)
        quarter = [self.phase_deg + 90.0]
        if self.eccentricity > 1e-6:
            twice = 2.0 * np.deg2rad(self.axis_deg)
            fundamental = 0.5 * np.exp(-1j * phase) - 0.75 * self.eccentricity * np.exp(1j * (phase - twice))
            three = 0.25 * self.eccentricity * np.exp(-1j * (phase + twice))
            companion = np.zeros((phase.size, 3, 3), dtype=complex)
            companion[:, 0, :] = (
                -np.stack([fundamental, np.conj(fundamental), np.conj(three)], axis=-1) / three[:, None]
            )
            companion[:, 1, 0] = companion[:, 2, 1] = 1.0
            quarter += list(np.rad2deg(0.5 * np.angle(np.linalg.eigvals(companion))).T)
            # roots of a pattern near a line crowd about its axis and lose half their digits
            width = np.rad2deg(np.sqrt(0.5 * self.remainder / self.eccentricity))
            quarter += [np.full(phase.shape, self.axis_deg + side * width) for side in (-1.0, 0.0, 1.0)]
        half = np.stack(quarter, axis=-1)
        return np.mod(np.concatenate([half, half + 180.0], axis=-1), 360.0)


def peaks(shapes: LoadShapes, torque: PeriodicTable) -> tuple[Real, Real]:
    """Largest |Q| over the turn, (n,) N, and the first angle where it stands, (n,) degrees in [0, 360).

    Between the entries of the torque the derivative is continuous. Panels of half a degree, the entries, and the roots
    for a constant torque bracket its roots. These are bisected to the last digit.
    """
    fixed = np.concatenate([np.arange(0.0, 360.0 + _PANEL_DEG / 2.0, _PANEL_DEG), torque.angle_deg])
    own = shapes.candidates()
    edges = np.sort(np.concatenate([np.broadcast_to(fixed, (own.shape[0], fixed.size)), own], axis=-1), axis=-1)
    left, right, value = edges[:, :-1], edges[:, 1:], torque.at(edges)
    wide = right - left > 1e-9
    slope = np.where(wide, np.diff(value, axis=-1) / np.where(wide, right - left, 1.0), 0.0)
    piece = _Piece(shapes, left, value[:, :-1], slope)
    crosses = piece.derivative(left) * piece.derivative(right) < 0.0
    piece, low, high = piece.take(crosses), left[crosses][:, None], right[crosses][:, None]
    sign = np.sign(piece.derivative(low))
    for _ in range(_BISECTIONS):
        middle = 0.5 * (low + high)
        same = np.sign(piece.derivative(middle)) == sign
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    roots = left.copy()
    roots[crosses] = (0.5 * (low + high))[:, 0]
    return _largest(shapes, torque, np.mod(np.concatenate([edges, roots], axis=-1), 360.0))


@record(frozen=True)
class _Piece:
    """Panels over which the torque is linear, (n, p)."""

    shapes: LoadShapes
    start: Real
    value: Real
    slope: Real

    def take(self, panels: np.ndarray) -> "_Piece":
        """Chosen panels (n, p) as panels (m, 1), as if each belonged to a pin of its own."""
        shapes, pin = self.shapes, np.nonzero(panels)[0]
        own = replace(shapes, factor=shapes.factor[pin], phase_deg=shapes.phase_deg[pin])
        return _Piece(own, self.start[panels][:, None], self.value[panels][:, None], self.slope[panels][:, None])

    def derivative(self, angle_deg: Real) -> Real:
        """Of the loads, up to a positive factor."""
        sine, cosine, below, change = self.shapes.parts(angle_deg)
        torque = self.value + self.slope * (angle_deg - self.start)
        return np.rad2deg(self.slope) * sine * below + torque * (cosine * below - sine * change)


def _largest(shapes: LoadShapes, torque: PeriodicTable, candidates: Real) -> tuple[Real, Real]:
    """Largest magnitude among angles (n, c), and the first of those where it stands."""
    sine, _, below, _ = shapes.parts(candidates)
    size = np.abs(torque.at(candidates) * shapes.factor[:, None] * sine) / np.where(below > 0.0, below, np.inf)
    peak = np.max(size, axis=-1)
    # equal peaks half a turn apart differ in the last digits
    first = np.where(size >= peak[:, None] * (1.0 - 1e-13), candidates, np.inf)
    return peak, np.where(peak > 0.0, np.mod(np.round(np.min(first, axis=-1), 10), 360.0), 0.0)


def degrees_of_freedom(count: int) -> tuple[int, int, int, int]:
    """Moving links, lower pairs, virtual constraints and F of a scroll on ``count`` pins (Liu, Zhao and Li, section 1).

    Shaft, scroll and z small cranks move; shaft in frame and scroll, every crank in frame and scroll: 2 z + 2 turning
    pairs. In parallelograms every crank after the first repeats a constraint. F = 3 n - (2 P_l - P').
    """
    links, pairs, repeated = count + 2, 2 * count + 2, count - 1
    return links, pairs, repeated, 3 * links - (2 * pairs - repeated)
