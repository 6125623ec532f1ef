"""Certified peaks of pins with clearance: no load of any instant is above its bound.

A trial motion of the scroll, linear in the angle over an interval, strains the pins by d and so gives them the loads
q_i = k_i sign(d_i) max(|d_i| - c_i, 0). At the rates of the pins that bear in the middle, these miss torque and
balance by r_M and r_F of the second order in the width, as long as no pin begins or ceases to bear. Some of the pins
take that rest as they take a torque and a force,

    delta_i = k_i (tau (a_i - mean a) + r_F / sum k),    tau = (r_M - mean a r_F) / sum k (a - mean a)^2,

with E^2 = sum delta_i^2 / k_i. The gap of :mod:`optimizer.pins.contact` between the trial motion and the balanced loads
q + delta is at most E^2 / 2, and 2 c_i |delta_i| more of a pin whose load may change its sign. Its square root bounds
the loads; and each has |Q_i| times what the motion leaves of its clearance in it:

    |Q_i - q_i| <= |delta_i| + sqrt(2 k_i gap),    |Q_i| <= gap / (c_i - |d_i|) where |d_i| < c_i.

Intervals whose bound is above the largest load so far are split. Pins are the last axis, intervals the one before.
"""

from typing import TypeVar

import numpy as np

from optimizer.numerics.arrays import Complex, Real
from optimizer.numerics.records import record
from optimizer.pins.loads import PeriodicTable, levers
from optimizer.pins.pattern import Pattern

#: real, or complex where they are places
Vector = TypeVar("Vector", Real, Complex)
#: an interval is closed where its bound is above the largest load by less than this share of the largest of all
TOLERANCE = 1e-9
#: peaks whose brackets are wider than this share of it are not certified
CERTIFIED = 1e-6
_PARTS, _LEVELS, _MOST_ROWS = 4, 16, 4_000
#: levers whose squares differ by less than this share of the largest hold no torque
_ALIKE = 1e-20
_EPS = float(np.finfo(float).eps)
#: what rounding may add to a sum of a few terms
_ROUNDING = 64.0 * _EPS


@record(frozen=True)
class Peaks:
    """Of every column of the loads, (n,)."""

    size: Real  # N, the largest magnitude that stands at an angle
    angle_deg: Real
    bound: Real | None  # N, no magnitude at any angle is larger; None where there is none

    def bracket(self, column: int) -> tuple[float, float] | None:
        """Of one column, N."""
        return None if self.bound is None else (float(self.size[column]), float(self.bound[column]))

    def largest_bracket(self, count: int) -> tuple[float, float] | None:
        """Of the largest of the first columns, N."""
        return None if self.bound is None else (float(np.max(self.size[:count])), float(np.max(self.bound[:count])))

    @property
    def is_certified(self) -> bool:
        """Whether each bracket is narrower than a millionth of the largest load."""
        return self.bound is not None and bool(np.all(self.bound - self.size <= CERTIFIED * np.max(self.size)))


@record(frozen=True)
class _Intervals:
    """Shaft angles (m,), over which the torque is linear."""

    left_deg: Real
    right_deg: Real
    slope: Real  # N m/rad

    @classmethod
    def of(cls, edges_deg: Real, torque: PeriodicTable) -> "_Intervals":
        left, right = edges_deg[:-1], edges_deg[1:]
        return cls(left, right, (torque.at(right) - torque.at(left)) / np.deg2rad(right - left))

    @property
    def middle_deg(self) -> Real:
        return 0.5 * (self.left_deg + self.right_deg)

    @property
    def half(self) -> Real:
        """Half widths in radians, beyond what rounding moves a middle by."""
        return np.deg2rad(0.5 * (self.right_deg - self.left_deg) + 360.0 * _EPS)

    def parts(self, rows: np.ndarray) -> "_Intervals":
        """Those of some rows, each in equal parts."""
        left, right = self.left_deg[rows, None], self.right_deg[rows, None]
        share = np.arange(1, _PARTS) / _PARTS
        edges = np.concatenate([left, left + share * (right - left), right], axis=-1)
        slope = np.repeat(self.slope[rows], _PARTS)
        return _Intervals(edges[:, :-1].reshape(-1), edges[:, 1:].reshape(-1), slope)


def enclosed_peaks(pattern: Pattern, torque: PeriodicTable, grid_deg: Real, size: Real, angle_deg: Real) -> Peaks:
    """Peaks (n,) that a search has come to, or larger ones, each with its bound.

    A pattern with dead points has no bound there: its loads jump.

    Parameters
    ----------
    grid_deg : edges of the first intervals, rising from 0 to 360, entries of the torque among them.
    size, angle_deg : of the search, N and degrees.
    """
    intervals = _Intervals.of(grid_deg, torque)
    bound = np.zeros(size.shape)
    for level in range(_LEVELS):
        load, above = _enclosure(pattern, torque, intervals)
        best, pin = np.argmax(np.abs(load), axis=0), np.arange(size.size)
        larger = np.abs(load)[best, pin]
        # the angle of a search is the first of those with that load
        missed = larger > size + TOLERANCE * np.max(size)
        size, angle_deg = np.where(missed, larger, size), np.where(missed, intervals.middle_deg[best], angle_deg)
        closed = size + TOLERANCE * np.max(size)
        open_ = np.any(above > closed, axis=-1)
        if not np.any(open_) or level == _LEVELS - 1 or _PARTS * np.count_nonzero(open_) > _MOST_ROWS:
            bound = np.maximum(closed, np.max(above, axis=0))
            break
        intervals = intervals.parts(open_)
    return Peaks(size, angle_deg, bound)


@record(frozen=True)
class _Middles:
    """The scroll in the middles of intervals, (m, n) or (m, 1); places over the largest, stiffnesses over the stiffest.

    So the lengths of strains, and of loads over the stiffest, are in metres; a torque is one over place and stiffness.
    """

    half: Real  # rad
    place: Complex  # (n,)
    stiffness: Real  # (n,)
    clearance: Real  # (n,)
    lever: Real
    #: change of the levers with the angle
    swing: Real
    strain: Real
    #: what rounding may have done to a strain
    rounding: Real
    load: Real
    rotation: Real
    torque: Real
    slope: Real
    is_rigid: bool

    @classmethod
    def of(cls, pattern: Pattern, torque: PeriodicTable, intervals: _Intervals) -> "_Middles":
        middle, pins, (clearance, error) = intervals.middle_deg, pattern.pins, pattern.play
        size, stiffest = float(np.max(np.abs(pins.place))), float(np.max(pins.stiffness))
        place, moment = pins.place / size, torque.at(middle)
        contact = pattern.contact(moment, middle)
        lever, rotation, shift = levers(place, middle), contact.rotation[:, None] * size, contact.shift[:, None]
        parts = np.abs(lever * rotation) + np.abs(shift) + np.abs(error) + clearance
        return cls(
            half=intervals.half[:, None],
            place=place,
            stiffness=pins.stiffness / stiffest,
            clearance=clearance,
            lever=lever,
            swing=levers(place, middle + 90.0),
            strain=lever * rotation + shift - error,
            rounding=_ROUNDING * parts,
            load=contact.load / stiffest,
            rotation=rotation,
            torque=moment[:, None] / (size * stiffest),
            slope=intervals.slope[:, None] / (size * stiffest),
            is_rigid=pattern.is_rigid,
        )

    def net(self, force: Vector) -> Vector:
        """Sum of forces (m, 1) that the scroll's shift has to bring to 0."""
        return np.zeros((len(force), 1), force.dtype) if self.is_rigid else _sum(force)


@record(frozen=True)
class _Trial:
    """Motion of the scroll over intervals, linear in the angle, and what it makes of the pins; (m, n).

    largest : no load of it is larger.
    rise : change of the linear part of a load with the angle.
    deviation : what a load may be beside its linear part.
    margin : a pin bears at least so much in all of the interval; 0 where it may not bear.
    slack : of the clearance so much is left in all of the interval; 0 or less where it may bear.
    missing_moment, missing_force : what the loads leave of torque and balance at most, (m, 1).
    """

    largest: Real
    rise: Real
    deviation: Real
    margin: Real
    slack: Real
    missing_moment: Real
    missing_force: Real


def _enclosure(pattern: Pattern, torque: PeriodicTable, intervals: _Intervals) -> tuple[Real, Real]:
    """Loads in the middles, and a bound of their magnitudes over the whole intervals, (m, n) N."""
    middles = _Middles.of(pattern, torque, intervals)
    trial = _trial(middles)
    error = np.minimum(
        _error(middles, trial, trial.margin > 0.0), _error(middles, trial, np.ones(trial.margin.shape, dtype=bool))
    )
    above = trial.largest + error
    if pattern.is_rigid:
        # the bearing carries the rest of the net force
        net = np.abs(np.sum(middles.load, axis=-1)) + middles.half[:, 0] * np.abs(np.sum(trial.rise, axis=-1))
        above = np.column_stack([above, net + np.sum(trial.deviation + error, axis=-1)])
    stiffest = float(np.max(pattern.pins.stiffness))
    return pattern.with_rest(middles.load * stiffest), above * (stiffest * (1.0 + _ROUNDING))


def _trial(middles: _Middles) -> _Trial:
    """At the rates at which the pins that bear in the middles keep torque and balance."""
    half, stiffness, clearance = middles.half, middles.stiffness, middles.clearance
    lever, swing, strain, load = middles.lever, middles.swing, middles.strain, middles.load
    bears = np.abs(strain) > clearance
    turn_rate, shift_rate = _rates(middles, np.where(bears, stiffness, 0.0))
    rate = swing * middles.rotation + lever * turn_rate + shift_rate
    # of the second order: what levers (at most one from the centre) and turn change together, and the levers' curvature
    reach = np.abs(middles.place)
    curved = np.abs(swing * turn_rate) + 0.5 * reach * (np.abs(middles.rotation) + np.abs(turn_rate) * half)
    rest = half**2 * curved + middles.rounding
    rise = np.where(bears, stiffness * rate, 0.0)
    beyond = np.abs(strain) - clearance
    swerve = half * np.abs(rate) + rest
    # of a pin that bears in the middle, what it lacks where it ceases to; of another, all that it may bear
    kink = stiffness * np.where(bears, np.maximum(swerve - beyond, 0.0), np.maximum(swerve + beyond, 0.0))
    law = stiffness * np.sign(strain) * np.maximum(beyond, 0.0)
    deviation = kink + np.where(bears, stiffness * rest, 0.0) + np.abs(load - law)
    ends = np.maximum(np.abs(strain + half * rate), np.abs(strain - half * rate))
    carried = np.abs(load) + np.abs(law) + half * np.abs(rise) + deviation
    moment = np.abs(middles.torque - _sum(load * lever))
    moment = moment + half * np.abs(middles.slope - _sum(load * swing + rise * lever))
    moment = moment + _sum(
        half**2 * np.abs(rise * swing) + 0.5 * half**2 * reach * (np.abs(load) + half * np.abs(rise))
    )
    moment = moment + _sum(deviation * (np.abs(lever) + half * reach)) + _ROUNDING * _sum(carried * reach)
    force = np.abs(middles.net(load)) + half * np.abs(middles.net(rise)) + middles.net(deviation + _ROUNDING * carried)
    return _Trial(
        largest=stiffness * np.maximum(ends + rest - clearance, 0.0),
        rise=rise,
        deviation=deviation,
        margin=np.maximum(stiffness * (beyond - swerve), 0.0),
        slack=-(beyond + swerve),
        missing_moment=moment,
        missing_force=force,
    )


def _sum(terms: Vector) -> Vector:
    return np.sum(terms, axis=-1, keepdims=True)


def _rates(middles: _Middles, bearing: Real) -> tuple[Real, Real]:
    """Change of turn and shift with the angle, (m, 1): the torque changes, and the levers of the loads do."""
    lever, swing = middles.lever, middles.swing
    whole = _nonzero(_sum(bearing))
    mean = middles.net(bearing * lever) / whole
    square = _sum(bearing * (lever - mean) ** 2)
    # strains change by swing * rotation where turn and shift stay
    moment = middles.slope - _sum(middles.load * swing) - _sum(bearing * swing * (lever - mean)) * middles.rotation
    turn = np.where(square > _ALIKE * whole, moment / _nonzero(square), 0.0)
    return turn, -middles.net(bearing * swing) * middles.rotation / whole - mean * turn


def _error(middles: _Middles, trial: _Trial, members: np.ndarray) -> Real:
    """How far the loads may be from those of the trial, (m, n), if some of the pins carry what is missing."""
    carrier = np.where(members, middles.stiffness, 0.0)
    whole = _nonzero(_sum(carrier))
    mean, centre = middles.net(carrier * middles.lever) / whole, middles.net(carrier * middles.place) / whole
    offset = middles.place - centre
    # sum k (a - mean a)^2 changes with the angle by no more than |sum k w^2|
    square = _sum(carrier * (middles.lever - mean) ** 2) - middles.half * np.abs(_sum(carrier * offset**2))
    holds = square > _ALIKE * whole
    force = trial.missing_force
    moment = trial.missing_moment + (np.abs(mean) + middles.half * np.abs(centre)) * force
    energy = np.hypot(moment / np.sqrt(np.where(holds, square, 1.0)), force / np.sqrt(whole))
    share = np.sqrt(carrier) * energy
    turns = _sum(np.where(share > trial.margin, middles.clearance * share, 0.0))
    error = share + np.sqrt(middles.stiffness) * np.hypot(energy, 2.0 * np.sqrt(turns))
    # the gap is also that of the loads themselves: each has |Q| times what the trial leaves of its clearance in it
    gap = 0.5 * energy**2 + 2.0 * turns
    slack = np.maximum(trial.slack, 0.0)
    error = np.where(gap < error * slack, gap / _nonzero(slack), error)
    return np.where(holds, error, np.inf)


def _nonzero(value: Real) -> Real:
    return np.where(value > 0.0, value, 1.0)
