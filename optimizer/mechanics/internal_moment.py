"""The first-order moment inside a shaft: what a balanced layout still bends itself and its frame with."""

import numpy as np

from optimizer.mechanics.inertia import reciprocating_forces, rotating_forces
from optimizer.mechanics.layout import Layout
from optimizer.numerics.arrays import Complex, Real
from optimizer.responses.response import Phasors


def internal_moment(layout: Layout, unbalance: Complex | None = None) -> Real:
    """Largest couple, about any plane, of the first-order forces on one side of it (...), kg m^2 (over omega^2).

    Where force and moment are balanced it is the same from both sides; where they are not, the larger side counts.
    The couple is linear between the planes of the masses, so it is largest in one of them.

    Parameters
    ----------
    unbalance : (..., webs) mass-radius products of the counterweights, kg m; none without.
    """
    parts = [(layout.rotating.position, rotating_forces(layout))]
    parts.append((layout.reciprocating.position, reciprocating_forces(layout, 1)))
    if unbalance is not None:
        parts.append((layout.webs.position, Phasors(unbalance, np.zeros(1, complex))))
    ends = np.cumsum([0, *(place.shape[-1] for place, _ in parts)]).tolist()
    leading = np.broadcast_shapes(*(array.shape[:-1] for place, pair in parts for array in (place, pair.co)))
    # both phasors beside each other
    place, force = np.empty((*leading, ends[-1])), np.empty((*leading, 2, ends[-1]), complex)
    for (own, pair), first, last in zip(parts, ends, ends[1:], strict=False):
        place[..., first:last], force[..., 0, first:last], force[..., 1, first:last] = own, pair.co, pair.counter
    place -= np.asarray(layout.centre_plane)[..., None]
    order = np.argsort(place, axis=-1)
    arm = np.take_along_axis(place, order, axis=-1)[..., None, :]
    force = np.take_along_axis(force, order[..., None, :], axis=-1)
    peaks = [_largest_of_side(arm[..., ::side], force[..., ::side]) for side in (1, -1)]
    return np.maximum(*peaks)


def _largest_of_side(arm: Real, force: Complex) -> Real:
    """Largest couple (...) of all forces (..., 2, n) up to each, about the place of it (..., 1, n)."""
    couple = arm * np.cumsum(force, axis=-1) - np.cumsum(arm * force, axis=-1)
    result: Real = np.maximum.reduce(np.add.reduce(np.abs(couple), axis=-2), axis=-1, initial=0.0)
    return result
