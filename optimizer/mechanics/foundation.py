"""Forces and couples of one order along two axes: amplitudes, and phases from a dead centre."""

from typing import NamedTuple

import numpy as np

from optimizer.mechanics.inertia import Wrench
from optimizer.mechanics.layout import Layout
from optimizer.mechanics.shaft_curves import planes
from optimizer.numerics.arrays import Complex, Real, Reals, spread
from optimizer.responses.piecewise_cubics import Index

#: of a sum, relative to the sum of the magnitudes, is what rounding leaves
_ROUNDING = 32.0 * np.finfo(float).eps


class Oscillation(NamedTuple):
    """A load along one axis, A cos(k psi - phase), psi the angle of the shaft since the dead centre."""

    amplitude: Real  # (...) N or N m
    phase_deg: Real  # (...) in [0, 360); 0 where the amplitude is 0


class FoundationLoad(NamedTuple):
    """Loads of one order on the foundation."""

    force_x: Oscillation
    force_y: Oscillation
    couple_of_x_forces: Oscillation
    couple_of_y_forces: Oscillation


def foundation_load(
    wrench: Wrench, order: int | Index, sense: Real, dead_centre_deg: Real, negligible: tuple[Real, Real]
) -> FoundationLoad:
    """Loads of one order along x and y, or of one each (...).

    Parameters
    ----------
    wrench : force [N] and couple [N m] of the order.
    order : k >= 1.
    sense : (...) +1 counter-clockwise, -1 clockwise.
    dead_centre_deg : (...) shaft angle from which phases count.
    negligible : force [N] and couple [N m] that rounding alone leaves, (...) each.
    """
    co, counter = (np.array([getattr(pair, name) for pair in wrench]) for name in ("co", "counter"))
    mirrored = np.conj(counter)
    # of the x and of the y component, each Re(C e^{jsk theta})
    phasors = np.empty((4, *co.shape[1:]), complex)
    phasors[0::2], phasors[1::2] = co + mirrored, -1j * (co - mirrored)
    least = np.array([spread(entry, phasors.shape[1:]) for entry in negligible for _ in range(2)])
    size, phase = _oscillation(phasors, order, sense, dead_centre_deg, least)
    return FoundationLoad._make([Oscillation(size[number], phase[number]) for number in range(4)])


def _oscillation(phasor: Complex, order: int | Index, sense: Real, dead_centre_deg: Real, least: Real) -> Oscillation:
    size = np.abs(phasor)
    mask = size > least
    angle = -sense * np.rad2deg(np.arctan2(phasor.imag, phasor.real)) - order * np.asarray(dead_centre_deg)
    # twice, because a hair below 0 comes to 360
    phase = np.mod(np.mod(angle, 360.0), 360.0)
    return Oscillation(np.where(mask, size, 0.0), np.where(mask, phase, 0.0))


def rounding(layout: Layout, unbalance: Complex) -> tuple[Real, Real]:
    """Force [N] and couple [N m] below which nothing but rounding is left of the sums over the machine.

    Parameters
    ----------
    unbalance : (..., webs) kg m, of the counterweights.
    """
    turning, moving = layout.rotating, layout.reciprocating
    plane, places = layout.reference_plane[..., None], planes(layout)
    # positions are rounded too, so that arms are at least what their plane's distance from 0 loses
    arm = np.abs(places - plane) + np.abs(plane)
    masses = (moving.mass * moving.crank_radius, turning.mass * turning.radius)
    fixed = np.concatenate([spread(size, (*places.shape[:-1], size.shape[-1])) for size in masses], axis=-1)
    own = np.abs(unbalance)
    webs = arm[..., fixed.shape[-1] :]
    square = _ROUNDING * layout.omega**2
    force = np.add.reduce(fixed, axis=-1) + np.add.reduce(own, axis=-1)
    couple = np.add.reduce(fixed * arm[..., : fixed.shape[-1]], axis=-1) + np.add.reduce(own * webs, axis=-1)
    return force * square, couple * square


def outer_dead_centre_deg(crank_deg: Reals, axis_deg: Reals, sense: Reals) -> Reals:
    """Shaft angle in [0, 360) at which the crank points along the axis of its row (...)."""
    return sense * (axis_deg - crank_deg) % 360.0 % 360.0
