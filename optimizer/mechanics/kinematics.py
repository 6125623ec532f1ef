"""Motion of every row over the turn: displacement, velocity, acceleration, obliquity of the rod.

A row's own crank angle phi counts from its outer dead centre in the direction of rotation. The
displacement counts from the outer dead centre towards the shaft. Velocity and acceleration are its derivatives, so that
the inertia force +m a on the frame is positive in rod tension.
"""

import math
from functools import cache
from types import ModuleType

import numpy as np

from optimizer.mechanics.layout import Layout
from optimizer.mechanics.layout import spread as spread_layout
from optimizer.numerics.arrays import Real, in_order, spread
from optimizer.numerics.memoization import cached_property, remembered
from optimizer.numerics.records import record

#: above this rod ratio the motion is steep near 90 and 270 degrees
_STEEP = 0.8


@record(frozen=True)
class Motion:
    """Rows over shaft angles, (..., rows, T)."""

    crank_angle: Real  # rad, own angle phi
    displacement: Real  # m
    velocity: Real  # m/s
    acceleration: Real  # m/s^2
    rod_angle_sine: Real  # sin beta = lam sin phi
    rod_angle_cosine: Real
    remaining: Real  # m, stroke - displacement without cancellation

    sine: Real  # of the crank angle, which most of the forces have in common
    cosine: Real

    @cached_property
    def rod_angle_tangent(self) -> Real:
        """tan beta."""
        return self.rod_angle_sine / self.rod_angle_cosine

    @cached_property
    def tangential_factor(self) -> Real:
        """sin(phi + beta) / cos beta: tangential force over piston force (design calculation of the 2D12, 2-22)."""
        return self.sine + self.cosine * self.rod_angle_tangent

    @cached_property
    def radial_factor(self) -> Real:
        """cos(phi + beta) / cos beta: radial force over piston force (lecture slides on compressors)."""
        return self.cosine - self.sine * self.rod_angle_tangent


def own_angle(layout: Layout, shaft_angle: Real) -> Real:
    """Own crank angles phi = theta + s (crank angle - axis) of the rows, rad.

    Parameters
    ----------
    shaft_angle : (..., T) rad, theta.

    Returns
    -------
    (..., rows, T).
    """
    return shaft_angle[..., None, :] + angle_ahead(layout)[..., :, None]


@remembered
def angle_ahead(layout: Layout) -> Real:
    """Own crank angles of the rows at shaft angle 0, (..., rows) rad."""
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
    kernel = motion_kernel()
    phi, table = own_angle(layout, shaft_angle), row_table(layout)
    if phi.shape[:-1] != table.shape[1:]:
        leading = np.broadcast_shapes(phi.shape[:-2], table.shape[1:-1])
        phi, layout = spread(phi, (*leading, *phi.shape[-2:])), spread_layout(layout, leading)
        table = row_table(layout)
    shape, places = phi.shape, (math.prod(phi.shape[:-1]), phi.shape[-1])
    sine, cosine = in_order(np.sin(phi)), in_order(np.cos(phi))
    omega, values = in_order(spread(layout.omega, shape[:-2])), np.empty((kernel.VALUES, *shape))
    kernel.motion_values(
        *(sine.reshape(places), cosine.reshape(places), table.reshape(len(table), places[0]), omega.reshape(-1)),
        *(exact, values.reshape(kernel.VALUES, *places)),
    )
    # to iterate over an array ends with an error that takes as long as to look at all of them
    x, c, a, beta_sine, beta_cosine, remaining = map(values.__getitem__, range(kernel.VALUES))
    return Motion(phi, x, c, a, beta_sine, beta_cosine, remaining, sine, cosine)


# it loads the compiler, and so at the first call; an import at each takes as long as a small array
@cache
def motion_kernel() -> ModuleType:
    """What is compiled of motion and pressures at single angles."""
    from optimizer.mechanics.kernel import motion_values

    return motion_values


@remembered
def row_table(layout: Layout) -> Real:
    """Crank radius [m], rod ratio and 1 - rod ratio of the rows, as what is compiled takes them, (3, ..., rows)."""
    rows = layout.reciprocating
    parts = (rows.crank_radius, rows.rod_ratio, rows.rod_margin)
    shape = np.broadcast_shapes((*layout.omega.shape, 1), *(part.shape for part in parts))
    return np.array([spread(part, shape) for part in parts])


def steep(rod_ratio: Real) -> bool:
    """Whether any of the rods needs :func:`steep_angles`."""
    return bool(np.count_nonzero(rod_ratio > _STEEP))


def steep_angles(rod_ratio: Real) -> Real:
    """Own crank angles that enclose the steep motion of a rod hardly longer than its crank, rad (..., 84).

    Within s = sqrt(1 - lam^2) of 90 and 270 degrees the acceleration shoots up to r w^2 / s: cos beta has zeros at
    the complex angles s off the axis. The distances of these angles to there are in geometric progression, down to s/4.
    So every panel between them is about as far from the zeros as it is wide, and quadrature converges equally for any
    rod; nan where fewer angles suffice.
    """
    scale = np.sqrt((1.0 - rod_ratio) * (1.0 + rod_ratio))[..., None]
    distance = 0.5 / 2.5 ** np.arange(21.0)
    needed = np.where((rod_ratio[..., None] > _STEEP) & (distance >= 0.25 * scale), distance, np.nan)
    quarters = [(quarter, sign) for quarter in (0.5 * np.pi, 1.5 * np.pi) for sign in (1.0, -1.0)]
    return np.concatenate([quarter + sign * needed for quarter, sign in quarters], axis=-1)
