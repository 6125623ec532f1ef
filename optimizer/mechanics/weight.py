"""Weights: on the guides of crossheads, which they may lift off, and on the main bearings."""

import numpy as np

from optimizer.mechanics.whole_turn import TurnCurves
from optimizer.numerics.arrays import Complex, Real, spread
from optimizer.numerics.records import record

#: m/s^2, standard acceleration of free fall
GRAVITY = 9.80665


@record(frozen=True)
class Guides:
    """Crossheads on the guides of their rows, (..., rows)."""

    weight: Real  # N across the axis; 0 where the axis is upright, so that there is no lower guide
    towards: Real  # 1 where a positive side force presses on the lower guide, -1 where it lifts

    def load(self, side: Real) -> Real:
        """Forces of the crossheads on their guides with their weight (..., rows, T) N, positive towards the lower one.

        In rod tension the rod draws the crosshead to the side of the crank pin: the side force N points along
        s j e^{jg}. Of the weight the part across the axis lies on the guide. So a crosshead is off it where the sum is
        negative (lecture slides on compressors). There one of two opposed rows is lifted by its side force, falls at
        the dead centres, and knocks.

        Parameters
        ----------
        side : (..., rows, T) N, positive in rod tension.
        """
        load: Real = self.towards[..., None] * side + self.weight[..., None]
        return load

    def lifted_share(self, side: TurnCurves) -> Real:
        """Share of the cycle over which crossheads are off their lower guides, (..., rows); 0 of upright rows.

        Parameters
        ----------
        side : side forces of every row of every design over the turn, N rows curves.
        """
        shape = np.broadcast_shapes(self.weight.shape, self.towards.shape)
        towards, weight = (spread(part, shape).reshape(-1) for part in (self.towards, self.weight))
        cycle, (designs, count) = np.deg2rad(side.period_deg), side.weights.shape[:2]
        # there N = 0, between them it has one sign
        crossings = np.sort(np.mod(side.crossings(-towards * weight)[0], cycle), axis=-1)
        width = np.diff(crossings, axis=-1, append=crossings[..., :1] + cycle)
        middle = (crossings + 0.5 * width).reshape(designs, count * width.shape[-1])
        there = side.along(middle).reshape(designs, count, count, width.shape[-1])
        own = np.arange(count)
        force = towards[:, None] * there[:, own, own].reshape(width.shape).real + weight[:, None]
        # one after the other, so that it does not depend on how many crossings another design has
        lifted = np.add.accumulate(np.where(force < 0.0, width, 0.0), axis=-1)[..., -1]
        return np.where(weight > 0.0, lifted / cycle, 0.0).reshape(shape)


def guides(mass: Real, axis: Complex, sense: Real, down: Complex) -> Guides:
    """Guides of rows.

    Parameters
    ----------
    mass : (..., rows) kg.
    axis : (..., rows) direction of the cylinder axes.
    sense : (...) of rotation.
    down : (...) direction of gravity.
    """
    across = 1j * axis
    part = (np.conj(across) * np.asarray(down)[..., None]).real
    # an upright row has none; 1e-12 of the weight is rounding
    weight = np.where(np.abs(part) > 1e-12, mass * GRAVITY * np.abs(part), 0.0)
    return Guides(weight, np.where(part < 0.0, -1.0, 1.0) * np.asarray(sense)[..., None])


def along_axis(mass: Real, axis: Complex, down: Complex) -> Complex:
    """What a row's weight presses on its crank: the part along the axis, (..., rows) N; the guide bears the rest.

    The rod leans, but over the turn as much to one side as to the other, so that this is its mean.

    Parameters
    ----------
    mass : (..., rows) kg that reciprocates.
    axis : (..., rows) direction of the cylinder axes.
    down : (...) direction of gravity.
    """
    result: Complex = mass * GRAVITY * (np.conj(axis) * np.asarray(down)[..., None]).real * axis
    return result
