"""Forces and couples of one order along two axes: amplitudes, and phases from a dead centre."""

from typing import NamedTuple

import numpy as np

from optimizer.mechanics.inertia import Wrench, web_arms
from optimizer.mechanics.layout import Layout
from optimizer.numerics.arrays import Complex, Real, spread
from optimizer.responses.piecewise_cubics import Index
from optimizer.responses.response import Phasors

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
    phasors = np.array([phasor for pair in wrench for phasor in _along(pair)])
    least = np.array([spread(entry, phasors.shape[1:]) for entry in negligible for _ in range(2)])
    loads = _oscillation(phasors, order, sense, dead_centre_deg, least)
    return FoundationLoad(*(Oscillation(*entry) for entry in zip(*loads, strict=True)))


def _along(pair: Phasors) -> tuple[Complex, Complex]:
    """Phasors C of the x and the y component, each Re(C e^{jsk theta})."""
    mirrored = np.conj(pair.counter)
    return pair.co + mirrored, -1j * (pair.co - mirrored)


def _oscillation(phasor: Complex, order: int | Index, sense: Real, dead_centre_deg: Real, least: Real) -> Oscillation:
    amplitude = np.where(np.abs(phasor) > least, np.abs(phasor), 0.0)
    turned = -sense * np.rad2deg(np.angle(phasor)) - order * np.asarray(dead_centre_deg)
    # twice, because a hair below 0 comes to 360
    phase = np.mod(np.mod(turned, 360.0), 360.0)
    return Oscillation(amplitude, np.where(amplitude > 0.0, phase, 0.0))


def rounding(layout: Layout, unbalance: Complex) -> tuple[Real, Real]:
    """Force [N] and couple [N m] below which nothing but rounding is left of the sums over the machine.

    Parameters
    ----------
    unbalance : (..., webs) kg m, of the counterweights.
    """
    turning, moving = layout.rotating, layout.reciprocating
    plane = layout.reference_plane[..., None]
    sizes = (turning.mass * turning.radius, moving.mass * moving.crank_radius, np.abs(unbalance))
    arms = (np.abs(turning.position - plane), np.abs(moving.position - plane), np.abs(web_arms(layout)))
    # positions are rounded too, so that arms are at least what their plane's distance from 0 loses
    far = np.abs(plane)
    square = _ROUNDING * layout.omega**2
    force, couple = np.zeros(()), np.zeros(())
    for size, arm in zip(sizes, arms, strict=True):
        force = force + np.add.reduce(size, axis=-1)
        couple = couple + np.add.reduce(size * (arm + far), axis=-1)
    return force * square, couple * square


def outer_dead_centre_deg(crank_deg: Real, axis_deg: Real, sense: Real) -> Real:
    """Shaft angle in [0, 360) at which the crank points along the axis of its row (...)."""
    return np.mod(np.mod(sense * (np.asarray(axis_deg) - np.asarray(crank_deg)), 360.0), 360.0)
