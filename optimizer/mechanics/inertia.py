"""Inertia forces on the frame as phasors by order, and their couples.

Everything is divided by omega^2: forces are kg m, couples kg m^2. Couples C = sum (z - z_ref) F lie
in the plane of the forces; the moment vector is j C.
"""

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

from optimizer.mechanics.layout import Layout
from optimizer.mechanics.slider_crank import acceleration_harmonic
from optimizer.numerics.arrays import Complex, Real, any_true, spread, total
from optimizer.numerics.memoization import remembered, remembered_of_pair
from optimizer.numerics.sums import force_and_couple
from optimizer.responses.response import Phasors, Response

#: what turns against the shaft where nothing does, of one machine
_NOTHING: Complex = np.zeros(1, complex)[0]


class Wrench(NamedTuple):
    """Force and its couple about the reference plane, each a pair of phasors (...)."""

    force: Phasors
    moment: Phasors

    def plus(self, other: "Wrench") -> "Wrench":
        return Wrench(self.force + other.force, self.moment + other.moment)

    def times(self, factor: Real) -> "Wrench":
        return Wrench(self.force * factor, self.moment * factor)

    def spread(self, leading: tuple[int, ...]) -> "Wrench":
        """The same of as many machines as the leading axes say; what is common to all is not copied."""
        return Wrench(*(Phasors(spread(pair.co, leading), spread(pair.counter, leading)) for pair in self))


@remembered
def first_order(layout: Layout) -> tuple[Wrench, Wrench]:
    """First-order force of the rotating masses, and that of the reciprocating ones."""
    return rotating(layout), reciprocating(layout, 1)


def rotating(layout: Layout) -> Wrench:
    """First-order force of the rotating masses, m r e^{jd}: co-rotating only.

    Source: Qian and Qu eqs (12)-(18); docs/mathematics.md section 2.
    """
    force, couple = _summed(layout, rotating_forces(layout).co[..., None, :], layout.rotating.position)
    return _co_rotating(*_entries(force), *_entries(couple))


@remembered
def rotating_forces(layout: Layout) -> Phasors:
    """The same mass by mass (..., n)."""
    masses = layout.rotating
    co = masses.mass * masses.radius * masses.direction
    return Phasors(co, np.zeros(co.shape, complex))


def reciprocating(layout: Layout, order: int, harmonic: Callable[[int, Real], Real] = acceleration_harmonic) -> Wrench:
    """Force of one order of the reciprocating masses.

    A row pushes along its axis g with m r A_k cos k(theta + s (d - g)), which is the pair
    co = (m r A_k / 2) e^{j(k d - (k-1) g)}, counter = (m r A_k / 2) e^{j((k+1) g - k d)}.
    Source: Qian and Qu eqs (1)-(11); docs/mathematics.md section 2.

    Parameters
    ----------
    order : k >= 1.
    harmonic : (order, rod ratio) -> A_k; exact by default.
    """
    (alone,) = reciprocating_orders(layout, (order,), harmonic)
    return alone


def reciprocating_orders(
    layout: Layout, orders: Sequence[int], harmonic: Callable[[int, Real], Real] = acceleration_harmonic
) -> list[Wrench]:
    """The same of several orders, summed at once: small sums cost by their number."""
    force, couple = _summed(layout, _row_forces(layout, orders, harmonic), layout.reciprocating.position)
    forces, couples = _entries(force), _entries(couple)
    return [Wrench(Phasors(*forces[n : n + 2]), Phasors(*couples[n : n + 2])) for n in range(0, 2 * len(orders), 2)]


def reciprocating_forces(
    layout: Layout, order: int, harmonic: Callable[[int, Real], Real] = acceleration_harmonic
) -> Phasors:
    """The same row by row (..., n)."""
    every = _row_forces(layout, (order,), harmonic)
    return Phasors(every[..., 0, :], every[..., 1, :])


def _row_forces(layout: Layout, orders: Sequence[int], harmonic: Callable[[int, Real], Real]) -> Complex:
    """The same of several orders, of each co and counter (..., 2 orders, n)."""
    rows = layout.reciprocating
    (size, opposed), crank, axis = _row_constants(layout), rows.crank_direction, rows.axis
    shapes = {size.shape, crank.shape, axis.shape}
    if max(orders) > 1:
        shapes.add(rows.rod_ratio.shape)
    *leading, count = shapes.pop() if len(shapes) == 1 else np.broadcast_shapes(*shapes)
    every = np.empty((*leading, 2 * len(orders), count), complex)
    for n, order in enumerate(orders):
        co, counter = every[..., 2 * n, :], every[..., 2 * n + 1, :]
        # A_1 = 1 whatever the rod, so that the first order needs no rod
        if order == 1:
            np.multiply(size, crank, out=co)
            np.multiply(np.conj(co), axis**2, out=counter)
            continue
        vector = size * harmonic(order, rows.rod_ratio) * crank**order
        np.multiply(np.conj(vector), axis ** (order + 1), out=counter)
        np.multiply(vector, opposed if order == 2 else opposed ** (order - 1), out=co)
    return every


@remembered
def _row_constants(layout: Layout) -> tuple[Real, Complex]:
    """What the forces of all orders are made of: m r / 2 and the conjugates of the axes (..., n)."""
    rows = layout.reciprocating
    return 0.5 * rows.mass * rows.crank_radius, np.conj(rows.axis)


@remembered_of_pair
def counterweights(layout: Layout, unbalance: Complex) -> Wrench:
    """First-order force of counterweights: co-rotating only.

    Couples are summed about the reference plane, with the arms of :func:`first_order_responses`: what the program
    cancels is cancelled here, however large the counterweights are.

    Parameters
    ----------
    unbalance : (..., webs) mass-radius products m R e^{ja}, kg m.
    """
    return _co_rotating(*force_and_couple(unbalance, web_arms(layout)))


def _co_rotating(force: Complex, moment: Complex) -> Wrench:
    """A force that turns with the shaft, and its moment (...)."""
    nothing = np.zeros(force.shape, complex) if force.ndim else _NOTHING
    return Wrench(Phasors(force, nothing), Phasors(moment, nothing))


@remembered
def web_arms(layout: Layout) -> Real:
    """Distance of the webs from the reference plane (..., webs) m."""
    return layout.webs.position - layout.reference_plane[..., None]


def first_order_responses(layout: Layout, baseline: Wrench) -> tuple[Response, Response]:
    """Force and moment as responses to the unbalance of the counterweights.

    A counterweight in plane z adds u to the co-rotating force and (z - z_ref) u to the
    co-rotating moment (docs/mathematics.md section 2).

    Parameters
    ----------
    baseline : first-order force and moment without counterweights.
    """
    arm = web_arms(layout)
    return (
        Response("force", "N", baseline.force, np.ones_like(arm)),
        Response("moment", "N m", baseline.moment, arm),
    )


def _entries(sums: Complex) -> Sequence[Complex]:
    """The entries along the last axis (..., m): m arrays (...), numbers where there are no more axes."""
    count = range(sums.shape[-1])
    # to iterate over an array ends with an error that takes longer than the numbers do
    return list(map(sums.__getitem__, count)) if sums.ndim == 1 else [sums[..., n] for n in count]


def _summed(layout: Layout, forces: Complex, position: Real) -> tuple[Complex, Complex]:
    """Sums (..., m) of m times the forces (..., m, n) in planes (..., n), and their couples about the reference plane.

    Where the sum vanishes the couple is the same about any plane, and is summed about the centre, where the arms are
    short. Else it is summed with its own arms: moved there from the centre it loses what is small beside the span.
    """
    force, about = force_and_couple(forces, (position - layout.reference_plane[..., None])[..., None, :])
    if layout.central:
        return force, about
    balanced = force == 0
    if not any_true(balanced):
        return force, about
    return force, np.where(balanced, total((position - layout.centre_plane[..., None])[..., None, :] * forces), about)
