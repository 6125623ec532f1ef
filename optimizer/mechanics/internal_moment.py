"""The first-order moment inside a shaft: what a balanced layout still bends itself and its frame with."""

from collections.abc import Sequence
from itertools import accumulate, pairwise

import numpy as np

from optimizer.mechanics.inertia import reciprocating_forces, rotating_forces
from optimizer.mechanics.layout import Layout
from optimizer.numerics.arrays import Complex, Real
from optimizer.numerics.memoization import remembered


def internal_moment(layout: Layout, unbalance: Complex | None = None) -> Real:
    """Largest couple, about any plane, of the first-order forces on one side of it (...), kg m^2 (over omega^2).

    Where force and moment are balanced it is the same from both sides; where they are not, the larger side counts.
    The couple is linear between the planes of the masses, so it is largest in one of them.

    Parameters
    ----------
    unbalance : (..., webs) mass-radius products of the counterweights, kg m; none without.
    """
    place, force = _inertia(layout)
    if unbalance is not None:
        webs = (layout.webs.position, unbalance, 0.0)
        place, force = _side_by_side([(place, force[..., 0, :], force[..., 1, :]), webs])
    arm = place - np.asarray(layout.centre_plane)[..., None]
    order = arm.argsort(axis=-1)
    if order.ndim == 1:
        return np.asarray(_largest_of_few(arm[order].tolist(), *force[:, order].tolist()))
    arm = np.take_along_axis(arm, order, axis=-1)
    return _largest(arm[..., None, :], np.take_along_axis(force, order[..., None, :], axis=-1))


@remembered
def _inertia(layout: Layout) -> tuple[Real, Complex]:
    """Places (..., n) m of the masses of a machine, and their first-order forces, co and counter (..., 2, n) kg m."""
    turning, moving = rotating_forces(layout), reciprocating_forces(layout, 1)
    return _side_by_side(
        [
            (layout.rotating.position, turning.co, turning.counter),
            (layout.reciprocating.position, moving.co, moving.counter),
        ]
    )


def _side_by_side(parts: Sequence[tuple[Real, Complex, Complex | float]]) -> tuple[Real, Complex]:
    """Places (..., n) of all parts, and both of their phasors (..., 2, n)."""
    ends = [0, *accumulate(place.shape[-1] for place, _, _ in parts)]
    leading = np.broadcast_shapes(*(array.shape[:-1] for place, co, _ in parts for array in (place, co)))
    place, force = np.empty((*leading, ends[-1])), np.empty((*leading, 2, ends[-1]), complex)
    for (own, co, counter), (first, last) in zip(parts, pairwise(ends), strict=True):
        place[..., first:last], force[..., 0, first:last], force[..., 1, first:last] = own, co, counter
    return place, force


def _largest_of_few(arms: list[float], co: list[complex], counter: list[complex]) -> float:
    """The same as :func:`_largest` of one machine (n,), in plain numbers: in a quarter of the time."""
    largest = 0.0
    for step in (1, -1):
        force = couple = counter_force = counter_couple = 0j
        for arm, turning, against in zip(arms[::step], co[::step], counter[::step], strict=True):
            force, counter_force = force + turning, counter_force + against
            couple, counter_couple = couple + arm * turning, counter_couple + arm * against
            largest = max(largest, abs(arm * force - couple) + abs(arm * counter_force - counter_couple))
    return largest


def _largest(arm: Real, force: Complex) -> Real:
    """Largest couple (...) of all forces (..., 2, n) on one side of each, about the place of it (..., 1, n)."""
    # both sides at once; their forces, and behind these their couples
    arms, terms = np.empty((2, *arm.shape)), np.empty((2, 2, *force.shape), complex)
    arms[0], arms[1] = arm, arm[..., ::-1]
    terms[0, 0], terms[0, 1] = force, force[..., ::-1]
    np.multiply(arms, terms[0], out=terms[1])
    forces, couples = np.add.accumulate(terms, axis=-1)
    size = np.add.reduce(np.abs(arms * forces - couples), axis=-2)
    result: Real = np.maximum.reduce(size, axis=(0, -1), initial=0.0)
    return result
