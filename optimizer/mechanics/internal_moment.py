"""The first-order moment inside a shaft: what a balanced layout still bends itself and its frame with."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from optimizer.mechanics.inertia import reciprocating_forces, rotating_forces
from optimizer.mechanics.layout import Layout
from optimizer.numerics.arrays import Complex, Real, spread
from optimizer.responses.response import Phasors


def internal_moment(layout: Layout, unbalance: Complex | None = None) -> Real:
    """Largest couple, about any plane, of the first-order forces on one side of it (...), kg m^2 (over omega^2).

    Where force and moment are balanced it is the same from both sides; where they are not, the larger side counts.
    The couple is linear between the planes of the masses, so it is largest in one of them.

    Parameters
    ----------
    unbalance : (..., webs) mass-radius products of the counterweights, kg m; none without.
    """
    forces = [rotating_forces(layout), reciprocating_forces(layout, 1)]
    places = [layout.rotating.position, layout.reciprocating.position]
    if unbalance is not None:
        forces.append(Phasors(unbalance, np.zeros_like(unbalance)))
        places.append(layout.webs.position)
    leading = np.broadcast_shapes(*(part.co.shape[:-1] for part in forces), *(part.shape[:-1] for part in places))
    place: Real = _joined(places, leading) - np.asarray(layout.centre_plane)[..., None]
    order = np.argsort(place, axis=-1)
    arm = np.take_along_axis(place, order, axis=-1)[..., None, :]
    # both phasors beside each other
    both = np.stack([_joined([getattr(one, part) for one in forces], leading) for part in ("co", "counter")], axis=-2)
    force = np.take_along_axis(both, order[..., None, :], axis=-1)
    peaks = [_largest_of_side(arm[..., ::side], force[..., ::side]) for side in (1, -1)]
    return np.maximum(*peaks)


def _largest_of_side(arm: Real, force: Complex) -> Real:
    """Largest couple (...) of all forces (..., 2, n) up to each, about the place of it (..., 1, n)."""
    couple = arm * np.cumsum(force, axis=-1) - np.cumsum(arm * force, axis=-1)
    result: Real = np.maximum.reduce(np.add.reduce(np.abs(couple), axis=-2), axis=-1, initial=0.0)
    return result


def _joined(parts: Sequence[Any], leading: tuple[int, ...]) -> Any:
    """Side by side on the last axis."""
    return np.concatenate([spread(part, (*leading, part.shape[-1])) for part in parts], axis=-1)
