"""Peaks over the whole turn: bracketed whatever the samples, of one machine and of many designs."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from optimizer.formulation.simulation import Prepared
from optimizer.mechanics.indicated import TURN
from optimizer.mechanics.row_series import Reading
from optimizer.mechanics.shaft import INFLUENCES, bearing_places
from optimizer.mechanics.shaft_curves import ShaftCurves, bending_influence, planes, shaft_curves
from optimizer.mechanics.whole_turn import TurnCurves, WholeTurn
from optimizer.numerics.arrays import Complex, Real
from optimizer.responses.piecewise_cubics import Bracket, Index
from schemas.machine.reciprocating import ReciprocatingMachine

#: of a bracket, relative to the peak; and of a floor
TOLERANCE, FLOOR_TOLERANCE = 1e-9, 1e-7


class Extremes(NamedTuple):
    """Largest and smallest values of curves over the turn, (..., C)."""

    high: Bracket
    low: Bracket  # of the values negated

    @property
    def magnitude(self) -> Bracket:
        """Largest magnitude."""
        first = self.high.lower >= self.low.lower
        return Bracket(
            np.where(first, self.high.angle, self.low.angle),
            np.where(first, self.high.value, self.low.value),
            np.maximum(self.high.lower, self.low.lower),
            np.maximum(self.high.upper, self.low.upper),
        )


def bracket(found: Bracket, *index: int) -> tuple[float, float]:
    """One bracket as an answer holds it: at least and at most."""
    return float(found.lower[index]), float(found.upper[index])


def of_rows(scene: Prepared, reading: Reading) -> Extremes:
    """Of a force of every row, (..., rows)."""
    count = scene.layout.reciprocating.mass.shape[-1]
    whole: WholeTurn = scene.results["whole_turn"]
    pieces = _curves_of_rows(whole, reading, count).pieces
    return Extremes(*(_reshaped(scene, pieces.largest(sign, TOLERANCE)) for sign in (1.0, -1.0)))


def largest_of_rows(scene: Prepared, reading: Reading) -> Bracket:
    """Largest magnitude of a force of all rows, (...); 0 without rows."""
    whole: WholeTurn = scene.results["whole_turn"]
    count = scene.layout.reciprocating.mass.shape[-1]
    if count == 0:
        nothing = np.zeros(scene.layout.omega.shape)
        return Bracket(nothing, nothing.astype(complex), nothing, nothing)
    designs = np.repeat(np.arange(len(whole.centre)), count)
    found = _curves_of_rows(whole, reading, count).pieces.peaks(np.zeros(designs.size), TOLERANCE, None, designs)
    return _one(_reshaped(scene, found))


def of_torque(scene: Prepared, constant: Real | float = 0.0) -> Bracket:
    """Largest torque of all rows with a constant (...), N m, magnitude: (...)."""
    whole: WholeTurn = scene.results["whole_turn"]
    offset = np.broadcast_to(np.reshape(constant, -1), len(whole.centre))
    return _one(_reshaped(scene, whole.torque.pieces.peaks(offset, TOLERANCE)))


def bearing_influence(scene: Prepared) -> Real:
    """Loads of the main bearings for unit loads in all planes, (..., B, L)."""
    influence = INFLUENCES[scene.request.fidelity.shaft]
    return influence(bearing_places(_reciprocating(scene)), planes(scene.layout))


def bearing_and_bending_curves(scene: Prepared, corners: Real) -> ShaftCurves:
    """Loads of the B main bearings and bending moments at corners (..., S), over omega^2: B + S curves together."""
    influence = INFLUENCES[scene.request.fidelity.shaft]
    moments = bending_influence(scene.layout, bearing_places(_reciprocating(scene)), influence, corners)
    both = np.concatenate([bearing_influence(scene), moments], axis=-2)
    return shaft_curves(scene.results["whole_turn"], scene.layout, both)


def of_shaft(scene: Prepared, found: ShaftCurves, unbalance: Complex | None, group: Index | None = None) -> Bracket:
    """Peaks of loads [N] or moments [N m] without or with counterweights (..., webs) kg m: (..., C).

    Parameters
    ----------
    group : (C,) from 0, where only the largest of each group is asked for: (..., groups).
    """
    pieces = found.curves.pieces
    if group is not None:
        designs = np.arange(len(pieces.half) // group.size)
        group = (designs[:, None] * (np.max(group) + 1) + group).reshape(-1)
    return _times_square(scene, pieces.peaks(found.offsets(unbalance), TOLERANCE, None, group))


def of_shaft_each(scene: Prepared, found: ShaftCurves, unbalances: Sequence[Complex | None]) -> tuple[Bracket, ...]:
    """The same with several sets of counterweights, all peaks searched together."""
    pieces = found.curves.pieces
    count, sets = len(pieces.half), len(unbalances)
    offset = np.concatenate([found.offsets(each) for each in unbalances])
    every = pieces.peaks(offset, TOLERANCE, np.tile(np.arange(count), sets))
    each = zip(*(np.split(part, sets) for part in every), strict=True)
    return tuple(_times_square(scene, Bracket(*parts)) for parts in each)


def at_least(scene: Prepared, found: ShaftCurves, unbalance: Complex | None) -> Real:
    """What the same peaks of one machine are not below (C,): the largest at the middles of the pieces."""
    pieces = found.curves.pieces
    size = np.abs(pieces.cubic[..., 0] + found.offsets(unbalance)[:, None])
    largest: Real = np.max(np.where(pieces.half > 0.0, size, 0.0), axis=-1) * scene.omega_squared
    return largest


def one_by_one(alone: int, together: int) -> Index:
    """Groups of curves of which some stand alone, and of the others only the largest counts."""
    return np.minimum(np.arange(alone + together), alone)


def _times_square(scene: Prepared, found: Bracket) -> Bracket:
    """Times omega^2, with the leading axes of the scene."""
    angle, value, lower, upper = _reshaped(scene, found)
    square = scene.layout.omega[..., None] ** 2
    return Bracket(angle, value * square, lower * square, upper * square)


def _reciprocating(scene: Prepared) -> ReciprocatingMachine:
    machine = scene.machine
    assert isinstance(machine, ReciprocatingMachine)  # no other has bearings
    return machine


def _curves_of_rows(whole: WholeTurn, reading: Reading, count: int) -> TurnCurves:
    """A force of every row by itself."""
    return whole.curves(reading, np.broadcast_to(np.eye(count), (len(whole.centre), count, count)))


def _one(found: Bracket) -> Bracket:
    """Without the last axis, of length 1."""
    angle, value, lower, upper = found
    return Bracket(angle[..., 0], value[..., 0], lower[..., 0], upper[..., 0])


def _reshaped(scene: Prepared, found: Bracket) -> Bracket:
    """With the leading axes of the scene, and angles within the turns after which all repeats."""
    leading = scene.layout.omega.shape
    count = found.angle.size // max(int(np.prod(leading)), 1)
    shape = (*leading, count)
    whole: WholeTurn = scene.results["whole_turn"]
    angle = np.mod(found.angle, TURN * whole.turns)
    return Bracket(
        angle.reshape(shape), found.value.reshape(shape), found.lower.reshape(shape), found.upper.reshape(shape)
    )
