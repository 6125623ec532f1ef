"""Motion of every row over the turn: displacement, velocity, acceleration, obliquity of the rod.

A row's own crank angle phi counts from its outer dead centre in the direction of rotation. The
displacement counts from the outer dead centre towards the shaft; velocity and acceleration are its
derivatives, so that the inertia force +m a on the frame is positive in rod tension.
"""

from dataclasses import dataclass

import numpy as np

from optimizer.mechanics.layout import Layout
from optimizer.response import Real


@dataclass(frozen=True)
class Motion:
    """Rows over shaft angles, (..., rows, T)."""

    crank_angle: Real  # rad, own angle phi
    displacement: Real  # m
    velocity: Real  # m/s
    acceleration: Real  # m/s^2
    rod_angle_sine: Real  # sin beta = lam sin phi
    rod_angle_cosine: Real

    @property
    def tangential_factor(self) -> Real:
        """sin(phi + beta) / cos beta: tangential force over piston force (seed 004, 2-22)."""
        return np.sin(self.crank_angle) + np.cos(self.crank_angle) * self.rod_angle_sine / self.rod_angle_cosine

    @property
    def radial_factor(self) -> Real:
        """cos(phi + beta) / cos beta: radial force over piston force (seed 001 l. 13)."""
        return np.cos(self.crank_angle) - np.sin(self.crank_angle) * self.rod_angle_sine / self.rod_angle_cosine


def own_angle(layout: Layout, shaft_angle: Real) -> Real:
    """Own crank angles phi = theta + s (crank angle - axis) of the rows, rad.

    Parameters
    ----------
    shaft_angle : (..., T) rad, theta.

    Returns
    -------
    (..., rows, T).
    """
    rows = layout.reciprocating
    ahead = layout.sense[..., None] * np.angle(rows.crank_direction * np.conj(rows.axis))
    return shaft_angle[..., None, :] + ahead[..., :, None]


def motion(layout: Layout, shaft_angle: Real, exact: bool = True) -> Motion:
    """Motion of every row.

    Exact: x = r ((1 - cos phi) + (1 - cos beta) / lam), c = r w sin(phi + beta) / cos beta,
    a = r w^2 (cos phi + lam (cos 2 phi + lam^2 sin^4 phi) / cos^3 beta).
    Cut off after the second order: x = r ((1 - cos phi) + lam/4 (1 - cos 2 phi)),
    c = r w (sin phi + lam/2 sin 2 phi), a = r w^2 (cos phi + lam cos 2 phi).
    Source: seed 001 l. 3; seed 004 (2-5)..(2-9).

    Parameters
    ----------
    shaft_angle : (..., T) rad.
    exact : or cut off after the second order.
    """
    rows = layout.reciprocating
    radius, lam, omega = rows.crank_radius[..., None], rows.rod_ratio[..., None], layout.omega[..., None, None]
    phi = own_angle(layout, shaft_angle)
    sine, cosine = np.sin(phi), np.cos(phi)
    beta_sine = lam * sine
    beta_cosine = np.sqrt((1.0 - beta_sine) * (1.0 + beta_sine))
    # 1 - cos without cancellation near the dead centres
    rise = 2.0 * np.sin(0.5 * phi) ** 2
    if exact:
        x = rise + lam * sine**2 / (1.0 + beta_cosine)
        c = sine + cosine * beta_sine / beta_cosine
        a = cosine + lam * (np.cos(2.0 * phi) + beta_sine**2 * sine**2) / beta_cosine**3
    else:
        x = rise + 0.5 * lam * sine**2
        c = sine + 0.5 * lam * np.sin(2.0 * phi)
        a = cosine + lam * np.cos(2.0 * phi)
    return Motion(phi, radius * x, radius * omega * c, radius * omega**2 * a, beta_sine, beta_cosine)


def angle_at(displacement: Real, crank_radius: Real, rod_ratio: Real) -> Real:
    """Own crank angle in [0, pi] at which the piston has moved so far, rad; exact.

    With t = x/r: (1 - cos phi) (1 + lam (2 - t) / 2 ...) follows from the cosine rule,
    1 - cos phi = t (2 - lam t) / (2 (1 + lam (1 - t))).

    Parameters
    ----------
    displacement : (...) m, within the stroke.
    """
    t = displacement / crank_radius
    rise = t * (2.0 - rod_ratio * t) / (2.0 * (1.0 + rod_ratio * (1.0 - t)))
    # 1 - cos phi = 2 sin^2(phi / 2)
    return 2.0 * np.arcsin(np.sqrt(np.clip(0.5 * rise, 0.0, 1.0)))


def steep_angles(rod_ratio: Real) -> Real:
    """Own crank angles that enclose the steep motion of a rod hardly longer than its crank, rad (..., 24).

    Within sqrt(1 - lam^2) of 90 and 270 degrees the acceleration shoots up to r w^2 / (1 - lam^2)^(1/2).
    Geometrically graded angles let quadrature follow it; nan where the rod is long enough.
    """
    scale = np.sqrt((1.0 - rod_ratio) * (1.0 + rod_ratio))[..., None]
    distance = scale ** np.linspace(0.0, 1.25, 6)
    steep = np.concatenate(
        [quarter + sign * distance for quarter in (0.5 * np.pi, 1.5 * np.pi) for sign in (1, -1)], -1
    )
    return np.where(rod_ratio[..., None] > 0.8, steep, np.nan)
