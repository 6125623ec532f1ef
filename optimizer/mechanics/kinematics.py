"""Motion of every row over the turn: displacement, velocity, acceleration, obliquity of the rod.

A row's own crank angle phi counts from its outer dead centre in the direction of rotation. The
displacement counts from the outer dead centre towards the shaft; velocity and acceleration are its
derivatives, so that the inertia force +m a on the frame is positive in rod tension.
"""

from dataclasses import dataclass

import numpy as np

from optimizer.mechanics.layout import Layout
from optimizer.numerics.arrays import Real
from optimizer.numerics.memoization import cached_property, remembered


@dataclass(frozen=True)
class Motion:
    """Rows over shaft angles, (..., rows, T)."""

    crank_angle: Real  # rad, own angle phi
    displacement: Real  # m
    velocity: Real  # m/s
    acceleration: Real  # m/s^2
    rod_angle_sine: Real  # sin beta = lam sin phi
    rod_angle_cosine: Real
    remaining: Real  # m, stroke - displacement without cancellation

    @cached_property
    def sine(self) -> Real:
        """sin phi, which most of the forces have in common."""
        return np.sin(self.crank_angle)

    @cached_property
    def cosine(self) -> Real:
        """cos phi."""
        return np.cos(self.crank_angle)

    @property
    def tangential_factor(self) -> Real:
        """sin(phi + beta) / cos beta: tangential force over piston force (design calculation of the 2D12, 2-22)."""
        return self.sine + self.cosine * self.rod_angle_sine / self.rod_angle_cosine

    @property
    def radial_factor(self) -> Real:
        """cos(phi + beta) / cos beta: radial force over piston force (lecture slides on compressors)."""
        return self.cosine - self.sine * self.rod_angle_sine / self.rod_angle_cosine


def own_angle(layout: Layout, shaft_angle: Real) -> Real:
    """Own crank angles phi = theta + s (crank angle - axis) of the rows, rad.

    Parameters
    ----------
    shaft_angle : (..., T) rad, theta.

    Returns
    -------
    (..., rows, T).
    """
    return shaft_angle[..., None, :] + _ahead(layout)[..., :, None]


@remembered
def _ahead(layout: Layout) -> Real:
    """The same at shaft angle 0, (..., rows)."""
    rows = layout.reciprocating
    apart = rows.crank_direction * np.conj(rows.axis)
    return layout.sense[..., None] * np.arctan2(apart.imag, apart.real)


def motion(layout: Layout, shaft_angle: Real, exact: bool = True) -> Motion:
    """Motion of every row.

    Exact: x = r ((1 - cos phi) + (1 - cos beta) / lam), c = r w sin(phi + beta) / cos beta,
    a = r w^2 (cos phi + lam ((1 - lam^2) cos 2 phi + lam^2 cos^4 phi) / cos^3 beta), where the bracket is the usual
    cos 2 phi + lam^2 sin^4 phi and cos^2 beta = (1 - lam^2) + lam^2 cos^2 phi: nothing cancels at 90 degrees, however
    near lam is to 1. To the inner dead centre there remains 4 r cos^2(phi/2) u / (u + 1 + lam) with
    u = cos beta + lam cos phi = (1 - lam^2) / (cos beta - lam cos phi).
    Cut off after the second order: x = r ((1 - cos phi) + lam/4 (1 - cos 2 phi)),
    c = r w (sin phi + lam/2 sin 2 phi), a = r w^2 (cos phi + lam cos 2 phi).
    Source: lecture slides on compressors; design calculation of the 2D12 (2-5)..(2-9).

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
    # 1 - lam^2 from 1 - lam
    short = rows.rod_margin[..., None] * (1.0 + lam)
    beta_cosine = np.sqrt(short + (lam * cosine) ** 2)
    # 1 - cos and 1 + cos without cancellation near the dead centres
    rise, fall = 2.0 * np.sin(0.5 * phi) ** 2, 2.0 * np.cos(0.5 * phi) ** 2
    if exact:
        x = rise + lam * sine**2 / (1.0 + beta_cosine)
        c = sine + cosine * beta_sine / beta_cosine
        a = cosine + lam * (short * np.cos(2.0 * phi) + lam**2 * cosine**4) / beta_cosine**3
        upright = beta_cosine + lam * np.abs(cosine)
        u = np.where(cosine >= 0.0, upright, short / upright)
        remaining = 2.0 * fall * u / (u + 1.0 + lam)
    else:
        x = rise + 0.5 * lam * sine**2
        c = sine + 0.5 * lam * np.sin(2.0 * phi)
        a = cosine + lam * np.cos(2.0 * phi)
        remaining = fall - 0.5 * lam * sine**2
    return Motion(
        phi, radius * x, radius * omega * c, radius * omega**2 * a, beta_sine, beta_cosine, radius * remaining
    )


def angle_at(
    displacement: Real,
    crank_radius: Real,
    rod_ratio: Real,
    remaining: Real | None = None,
    rod_margin: Real | None = None,
    exact: bool = True,
) -> Real:
    """Own crank angle in [0, pi] at which the piston has moved so far, rad.

    With t = x/r and u = 2 - t the cosine rule gives 1 - cos phi = t (2 (1 - lam) + lam u) / (2 (1 - lam + lam u)) and
    1 + cos phi = u (2 + lam u) / (2 (1 - lam + lam u)), so that tan^2(phi/2) is their quotient. Each is as good as its
    own distance, so the angle keeps its digits at both dead centres. Cut off after the second order the travel is
    t = (1 + lam) (1 - cos phi) - lam (1 - cos phi)^2 / 2, whose roots for 1 - cos phi and 1 + cos phi do not cancel.

    Parameters
    ----------
    displacement : (...) m, within the stroke.
    remaining : (...) m, stroke - displacement, where it is known better than by the difference.
    rod_margin : (...) 1 - lam, likewise.
    exact : or cut off after the second order, as :func:`motion`.
    """
    t = displacement / crank_radius
    u = 2.0 - t if remaining is None else remaining / crank_radius
    margin = 1.0 - rod_ratio if rod_margin is None else rod_margin
    t, u = np.maximum(t, 0.0), np.maximum(u, 0.0)
    if exact:
        rise, fall = t * (2.0 * margin + rod_ratio * u), u * (2.0 + rod_ratio * u)
    else:
        # one root: (1 + lam)^2 - 2 lam t = (1 - lam)^2 + 2 lam u
        root = np.sqrt(margin**2 + 2.0 * rod_ratio * u)
        rise, fall = t / (1.0 + rod_ratio + root), u / (margin + root)
    return 2.0 * np.arctan2(np.sqrt(rise), np.sqrt(fall))


def steep_angles(rod_ratio: Real) -> Real:
    """Own crank angles that enclose the steep motion of a rod hardly longer than its crank, rad (..., 84).

    Within s = sqrt(1 - lam^2) of 90 and 270 degrees the acceleration shoots up to r w^2 / s: cos beta has zeros at
    the complex angles s off the axis. Angles whose distances to there are in geometric progression, down to s/4, keep
    every panel between them about as far from the zeros as it is wide, so that quadrature converges alike for any
    rod; nan where an angle is not needed.
    """
    scale = np.sqrt((1.0 - rod_ratio) * (1.0 + rod_ratio))[..., None]
    distance = 0.5 / 2.5 ** np.arange(21.0)
    needed = np.where((rod_ratio[..., None] > 0.8) & (distance >= 0.25 * scale), distance, np.nan)
    quarters = [(quarter, sign) for quarter in (0.5 * np.pi, 1.5 * np.pi) for sign in (1.0, -1.0)]
    return np.concatenate([quarter + sign * needed for quarter, sign in quarters], axis=-1)
