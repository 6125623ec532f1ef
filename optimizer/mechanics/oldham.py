"""Keys of an Oldham ring: loads, sliding speeds and friction loss, broadcasting over leading axes.

The ring slides by e cos(theta - u) along its axis u in the frame, guided by two keys on that axis. Two keys across it
sit in the scroll and drive the ring. The rotation torque T is carried by each pair as the couple 2 N R, so N = T/(2 R).
The keys in the scroll carry beside that the inertia of the ring, m e omega^2 cos(theta - u), half each. Against the
frame the ring slides with e omega sin, against the scroll, which circles, with e omega cos. Friction loads no key here.
Angles in radians, counted in the direction of rotation.
"""

import numpy as np

from optimizer.numerics.arrays import Real
from optimizer.numerics.records import record


@record(frozen=True)
class Oldham:
    """An Oldham ring, (...)."""

    orbit_radius: Real  # m, e
    key_radius: Real  # m, R
    mass: Real  # kg
    axis: Real  # rad, u
    omega: Real  # rad/s


@record(frozen=True)
class Keys:
    """Loads and sliding speeds of the keys at shaft angles (..., T)."""

    frame: Real  # (..., T) N, of each of the two in the frame
    scroll: Real  # (..., T, 2) N along the axis, of the two in the scroll
    frame_speed: Real  # (..., T) m/s, magnitude
    scroll_speed: Real  # (..., T) m/s, magnitude

    def loss(self, friction: Real) -> Real:
        """Power lost to sliding, (..., T) W, for a coefficient of friction (..., T)."""
        in_frame = 2.0 * np.abs(self.frame) * self.frame_speed
        return np.asarray(friction * (in_frame + np.sum(np.abs(self.scroll), axis=-1) * self.scroll_speed))


def keys(ring: Oldham, torque: Real, angle: Real) -> Keys:
    """What the keys carry and how they slide.

    Parameters
    ----------
    torque : (..., T) N m.
    angle : (..., T) rad.
    """
    orbit, reach = np.asarray(ring.orbit_radius)[..., None], np.asarray(ring.key_radius)[..., None]
    speed = orbit * np.asarray(ring.omega)[..., None]
    own = angle - np.asarray(ring.axis)[..., None]
    couple = torque / (2.0 * reach)
    inertia = 0.5 * np.asarray(ring.mass)[..., None] * speed * np.asarray(ring.omega)[..., None] * np.cos(own)
    scroll = np.stack([couple - inertia, -couple - inertia], axis=-1)
    return Keys(couple, scroll, speed * np.abs(np.sin(own)), speed * np.abs(np.cos(own)))


def level_angles(ring: Oldham, torque: Real, angle: Real) -> Real:
    """Shaft angles between which the load of every key rises or falls throughout, (..., M, 5) rad, each in its piece.

    Between entries of the torque a key in the scroll carries +-T/(2 R) - A cos(theta - u) with A = m e omega^2 / 2 and
    T' constant: it is level where +-T'/(2 R) + A sin(theta - u) = 0. An angle that is none of its piece is moved to the
    end of it; the last of five is its beginning.

    Parameters
    ----------
    torque : (..., M) N m, linear in between and periodic.
    angle : (..., M) rad, rising within one turn.
    """
    following, slope = _pieces(torque, angle)
    reach, axis = np.asarray(ring.key_radius)[..., None], np.asarray(ring.axis)[..., None]
    inertia = _inertia(ring)[..., None]
    share = slope / (2.0 * reach)
    level = np.arcsin(np.clip(share / np.where(inertia > 0.0, inertia, np.inf), -1.0, 1.0))
    # of both signs of the couple, and of both angles with that sine
    own = np.stack([level, np.pi - level, -level, np.pi + level], axis=-1) + axis[..., None]
    start, wide = angle[..., None], (following - angle)[..., None]
    inside = np.minimum(np.mod(own - start, 2.0 * np.pi), wide)
    return np.concatenate([start + inside, start], axis=-1)


def largest_key(ring: Oldham, torque: Real, angle: Real) -> Real:
    """Largest magnitude of what a key carries over the turn, (...) N, exact: keys in the frame carry most at entries.

    Parameters
    ----------
    torque : (..., M) N m, linear in between and periodic.
    angle : (..., M) rad, rising within one turn.
    """
    where = level_angles(ring, torque, angle)
    _, slope = _pieces(torque, angle)
    reach, axis = np.asarray(ring.key_radius)[..., None, None], np.asarray(ring.axis)[..., None, None]
    couple = (torque[..., None] + slope[..., None] * (where - angle[..., None])) / (2.0 * reach)
    pull = np.abs(_inertia(ring)[..., None, None] * np.cos(where - axis))
    return np.asarray(np.max(np.abs(couple) + pull, axis=(-2, -1)))


def _pieces(torque: Real, angle: Real) -> tuple[Real, Real]:
    """Ends of the pieces between entries (..., M) rad, and slopes there (..., M) N m/rad."""
    following = np.concatenate([angle[..., 1:], angle[..., :1] + 2.0 * np.pi], axis=-1)
    return following, (np.roll(torque, -1, axis=-1) - torque) / (following - angle)


def _inertia(ring: Oldham) -> Real:
    """Half of the ring's largest inertia, (...) N."""
    return 0.5 * np.asarray(ring.mass * ring.orbit_radius * ring.omega**2)


def pin_losses(load: Real, diameter: Real, friction: Real, omega: Real) -> Real:
    """Power that pins lose in their two journals, (..., T) W: mu |Q| d/2 at omega, twice a pin.

    Parameters
    ----------
    load : (..., T, n) N.
    """
    return np.asarray(np.sum(np.abs(load), axis=-1) * diameter * friction * omega)
