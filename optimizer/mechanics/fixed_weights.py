"""Weights that are on the crank already: what the program sees as part of the machine, and what an answer shows."""

from dataclasses import replace

import numpy as np

from optimizer.mechanics.angles import direction
from optimizer.mechanics.layout import Layout, Rotating, stacked
from optimizer.numerics.arrays import Real, side_by_side
from optimizer.numerics.memoization import remembered
from schemas.machine.machine import Machine


@remembered
def any_fixed(machine: Machine) -> bool:
    """Whether some web carries a fixed weight."""
    return any(web.fixed is not None for web in machine.webs)


@remembered
def fixed_webs(machine: Machine) -> np.ndarray:
    """Which webs carry a fixed weight (K,) bool."""
    return np.array([web.fixed is not None for web in machine.webs], dtype=bool)


def fixed_masses(machine: Machine) -> Real:
    """Fixed weights of all webs (..., K) kg, 0 where there is none."""
    return stacked([0.0 if web.fixed is None else web.fixed.mass_kg for web in machine.webs])


@remembered
def fixed_mass(machine: Machine) -> Real:
    """Their sum (...) kg."""
    if not any_fixed(machine):
        return np.zeros(())
    return np.asarray(np.add.reduce(fixed_masses(machine), axis=-1))


def beside(machine: Machine, mass_kg: Real, angle_deg: Real) -> tuple[Real, Real]:
    """Masses [kg] and angles [deg] of free counterweights (..., K), with the fixed weights in their places.

    Of webs on balance shafts, which stand behind those of the crankshaft, nothing is fixed.
    """
    if not any_fixed(machine):
        return mass_kg, angle_deg
    mask = fixed_webs(machine)
    behind = mass_kg.shape[-1] - mask.size
    angles = np.mod(stacked([0.0 if web.fixed is None else web.fixed.angle_deg for web in machine.webs]), 360.0)
    masses, at = (
        np.pad(array, [(0, 0)] * (array.ndim - 1) + [(0, behind)]) for array in (fixed_masses(machine), angles)
    )
    there = np.pad(mask, (0, behind))
    # without a mass there is no angle
    return np.where(there, masses, mass_kg), np.where(there, np.where(masses > 0, at, 0.0), angle_deg)


def laden(layout: Layout, machine: Machine) -> Layout:
    """The layout with the fixed weights among its rotating masses: the free counterweights balance both."""
    if not any_fixed(machine):
        return layout
    there = np.flatnonzero(fixed_webs(machine))
    fixed = [web.fixed for web in machine.webs if web.fixed is not None]
    turning = layout.rotating
    parts = {
        "mass": stacked([weight.mass_kg for weight in fixed]),
        "radius": layout.webs.radius[..., there],
        "direction": direction(stacked([weight.angle_deg for weight in fixed])),
        "position": layout.webs.position[..., there],
    }
    return replace(
        layout, rotating=Rotating(**{name: side_by_side(getattr(turning, name), more) for name, more in parts.items()})
    )
