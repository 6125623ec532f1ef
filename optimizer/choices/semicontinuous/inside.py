"""Points that keep everything: with a choice of the webs on which something is fitted, better step by step.

The half plane beyond the tangent to the least at a direction is convex and keeps it. So is a disc about the point where
they touch that stays within the largest. The best point of these is the next one, and the next tangent is at its
direction: no step is worse than the one before.
"""

from dataclasses import replace

import numpy as np

from optimizer.choices.clock import Clock
from optimizer.choices.relaxations import Relaxations, solved
from optimizer.choices.semicontinuous.places import Places, principal_angle
from optimizer.numerics.arrays import Complex, Real
from optimizer.program.limits import Limits
from optimizer.program.statement import Statement

#: share of its size for a web without room: the kernel takes no limit of 0
SPECK = 1e-9
#: tangents that are tried one after the other, for the objective and for the mass
_TANGENTS, _LIGHTER = 5, 25
#: points that are moved to their tangents before the clock is looked at
_AT_ONCE = 8
#: a fall of the mass that ends them, relative
_HARDLY = 1e-6
#: rounding of a size, relative
_ROUNDING = 1e-12


class BestPoint:
    """The best point so far; of equal ones the lightest."""

    def __init__(self, statement: Statement, places: Places, resolution: float) -> None:
        """``places`` is where anything may be; ``resolution``: objectives that differ by no more are equal."""
        self.statement, self.places, self.resolution = statement, places, resolution
        self.least = np.inf  # smallest objective
        self.unbalance: Complex | None = None  # (K,) kg m

    def solved(
        self, programs: Statement, share: Real, gap: Real, least_mass: bool, clock: Clock | None = None
    ) -> Relaxations:
        """Optima of N programs in all or some of what is added to points (N, K), as far as there is time."""
        return solved(programs, self.places.alike, share, gap, least_mass, clock)

    def offer(self, u: Complex) -> Real:
        """Take the best of points (M, K) kg m, or stay; their objectives (M,), inf of what breaks a limit."""
        u = u if self.places.alike is None else self.places.alike.nearest(u)
        statement, size = self.statement, np.abs(u)
        mask = np.all(statement.ceilings.excess(u) <= statement.ceilings.tolerance, axis=-1)
        mask &= statement.mass(u) <= statement.limits.max_total_mass * (1.0 + _ROUNDING)
        places = self.places
        within = (size >= places.least * (1.0 - _ROUNDING)) & (size <= places.most * (1.0 + _ROUNDING))
        within &= np.abs(principal_angle(np.angle(u) - places.centre)) <= places.half + _ROUNDING
        mask &= np.all((size == 0) | (within & ~places.out), axis=-1)
        value = np.where(mask, statement.objective(u), np.inf)
        near = np.flatnonzero(value <= min(float(np.min(value, initial=np.inf)), self.least) + self.resolution)
        near = near[np.isfinite(value[near])]
        if near.size:
            self.least = min(self.least, float(np.min(value)))
            points = u[near]
            before = self.unbalance
            if before is not None and float(statement.objective(before)) <= self.least + self.resolution:
                points = np.concatenate([before[None], points])
            self.unbalance = points[int(np.argmin(statement.mass(points)))]
        return value


def improved(incumbent: BestPoint, u: Complex, fitted: np.ndarray, clock: Clock) -> None:
    """Offer the best that tangents find from the directions of points (M, K), something on some of the webs.

    Parameters
    ----------
    fitted : (M, K) bool, on which of the webs with a least; nothing is on the others that have one.
    clock : what is left of the time; at its end the points so far are offered.
    """
    before = np.full(len(u), np.inf)
    for _ in range(_TANGENTS):
        u = _tangent(incumbent, u, fitted, clock)
        value = incumbent.offer(u)
        if clock.spent() or not np.any(value < before - incumbent.resolution):
            return
        before = value


def _tangent(incumbent: BestPoint, u: Complex, fitted: np.ndarray, clock: Clock) -> Complex:
    """The best beyond the tangents at the directions of points (M, K); of the first ones alone where the time ends."""
    points: list[Complex] = []
    for first in range(0, len(u), _AT_ONCE):
        if points and clock.spent():
            break
        block = slice(first, first + _AT_ONCE)
        base, room, program = _beyond(incumbent, u[block], fitted[block])
        share, gap = np.full(len(base), 1e-9), np.zeros(len(base))
        # what is a speck is nothing
        points.append(base + np.where(room, incumbent.solved(program, share, gap, False).unbalance, 0.0))
    return np.concatenate(points)


def lightened(incumbent: BestPoint, u: Complex, share: float, clock: Clock) -> Complex:
    """With the same webs fitted a lighter point (K,) that is worse than the best by a share at most, or the same.

    What is beyond the least is no heavier than the least and it together, and as heavy where it is along the least.
    """
    statement, step = incumbent.statement, np.array([share / _LIGHTER])
    if share <= 0:
        return u
    for _ in range(_LIGHTER):
        base, room, program = _beyond(incumbent, u[None], np.abs(u[None]) > 0)
        trial = base + np.where(room, incumbent.solved(program, step, np.zeros(1), True).unbalance, 0.0)
        # offered alone, as it is no better
        alone = BestPoint(statement, incumbent.places, 0.0)
        alone.offer(trial)
        before, after = float(statement.mass(u)), float(statement.mass(trial[0]))
        if alone.least > incumbent.least + share or after >= before:
            break
        u = trial[0]
        if before - after <= _HARDLY * before or clock.spent():
            break
    return u


def _beyond(incumbent: BestPoint, u: Complex, fitted: np.ndarray) -> tuple[Complex, np.ndarray, Statement]:
    """Points (M, K) of the least in the directions of others, kg m, which webs have room beyond, and the programs in
    what is added."""
    statement, places = incumbent.statement, incumbent.places
    least, most, limits = places.least, places.most, statement.limits
    fitted = fitted & (least > 0) & ~places.out
    angle = places.towards(u)
    base = np.where(fitted, least * np.exp(1j * angle), 0.0)
    # of the directions of a sector those that go no way back
    turn, opened, quarter = places.centre, places.half, 0.5 * np.pi
    off = principal_angle(angle - turn)
    low = np.where(limits.free, angle - quarter, turn + np.maximum(-opened, off - quarter))
    high = np.where(limits.free, angle + quarter, turn + np.minimum(opened, off + quarter))
    centre, half = np.where(fitted, 0.5 * (low + high), turn), np.where(fitted, 0.5 * (high - low), opened)
    reach = np.where(fitted, most - least, np.where(least > 0, 0.0, most))
    budget = limits.max_total_mass - np.sum(np.abs(base) / limits.radius, axis=-1)
    return base, reach > 0, replace(statement.about(base), limits=cones(limits, reach, centre, half, budget))


def cones(limits: Limits, reach: Real, centre: Real, half: Real, budget: Real) -> Limits:
    """Limits (N, K) of what is within reach [kg m] in sectors [rad], with a little room where there is none."""
    largest = np.max(np.minimum(limits.reach, 1e300), initial=0.0)
    reach = np.maximum(reach, SPECK * largest)
    free, shape = half > 0.5 * np.pi, reach.shape
    half = np.where(free, 0.5 * np.pi, half)
    return Limits(
        radius=np.broadcast_to(limits.radius, shape),
        max_mass=reach / limits.radius,
        free=free,
        centre=np.where(free, 1.0, np.exp(1j * centre)),
        half_angle_cos=np.where(free, 0.0, np.cos(half)),
        half_angle_sin=np.where(free, 1.0, np.sin(half)),
        max_total_mass=np.maximum(budget, SPECK * (np.sum(limits.max_mass) + 1e-300)),
    )


def sharing(incumbent: BestPoint, u: Complex, clock: Clock) -> None:
    """Offer what comes of a relaxed point (K,) with something on more and more of its webs, the heaviest first."""
    least = incumbent.places.least
    share = np.where(least > 0, np.abs(u) / np.where(least > 0, least, 1.0), np.inf)
    below = np.flatnonzero(share < 1.0)
    order = below[np.argsort(-share[below], kind="stable")]
    fitted = np.repeat((share >= 1.0)[None], order.size + 1, axis=0)
    for count in range(1, order.size + 1):
        fitted[count, order[:count]] = True
    improved(incumbent, np.repeat(u[None], len(fitted), axis=0), incumbent.places.whole(fitted), clock)
