"""Quantities over a revolution: each is the largest of infinitely many norms, of which the program holds cuts.

A cut is one of these norms, floor + |c + H u|, so that no u makes the quantity smaller: a row of a statement. The
peak of |d(theta) + H u| over the turn has a cut at every angle; the root mean square sqrt(V + |mean d + H u|^2) one for
every split of a unit between the part that stays and the part that moves.
"""

import math
from collections.abc import Sequence
from typing import Literal, NamedTuple

import numpy as np

from optimizer.numerics.arrays import Complex, Real
from optimizer.numerics.memoization import cached_property
from optimizer.numerics.records import record
from optimizer.responses.curve import TurnResponse

#: by this share of them constants differ that are not one
_ALIKE = 1e-12
#: cuts of a quantity that are kept from one round to the next
_MOST_CUTS = 16
#: share of what is added up in a curve at which it has cancelled
DUST = 1e-13


class Scatter(NamedTuple):
    """What the unbalance of every counterweight may be off by, in any direction."""

    share: float = 0.0  # of itself
    unbalance: float = 0.0  # kg m, whatever the counterweight

    def of(self, influence: Real | Complex, u: Complex) -> float:
        """What |c + influence @ u| grows by at most: all counterweights (K,) off in the direction in which it grows."""
        return float(np.sum(np.abs(influence) * (self.share * np.abs(u) + self.unbalance))) if any(self) else 0.0


#: counterweights as they should be
EXACT = Scatter()


class Cut(NamedTuple):
    """floor + |constant + influence @ u|, which the quantity is never below; of a scalar the real part inside."""

    constant: complex
    influence: Real | Complex  # (K,)
    floor: float = 0.0
    angle_deg: float | None = None  # of the shaft, where the cut belongs to one
    scalar: bool = False
    share: float | None = None  # of a root mean square: constant and influence are the response's times this

    def at(self, u: Complex, scatter: Scatter) -> float:
        """What it comes to with an unbalance (K,)."""
        vector = self.constant + self.influence @ u
        return self.floor + float(abs(vector.real if self.scalar else vector)) + scatter.of(self.influence, u)

    def alike(self, other: "Cut") -> bool:
        """Whether both are one norm of a peak, of one angle or of several: they differ by rounding.

        Beside a jump there are two of one angle. Of a response that stands still all angles have the same.
        """
        if self.angle_deg is None or other.angle_deg is None:
            return False
        if abs(self.constant - other.constant) > _ALIKE * max(abs(self.constant), abs(other.constant)):
            return False
        return self.angle_deg == other.angle_deg or bool(np.array_equal(self.influence, other.influence))


def distinct(cuts: Sequence[Cut]) -> list[Cut]:
    """Cuts of one quantity without those that repeat one before them but for rounding."""
    result: list[Cut] = []
    constant = np.array([cut.constant for cut in cuts])
    size = np.abs(constant)
    near = np.abs(constant[:, None] - constant) <= _ALIKE * np.maximum(size[:, None], size)
    for n, cut in enumerate(cuts):
        if not any(cut.alike(cuts[before]) for before in np.flatnonzero(near[n, :n]).tolist()):
            result.append(cut)
    return result


class Evaluation(NamedTuple):
    """What a quantity comes to, between two figures that are proven, and the cut that comes to the lower one."""

    lower: float
    upper: float
    cut: Cut


@record(frozen=True)
class Quantity:
    """What is to be small of a response over the turn."""

    response: TurnResponse
    measure: Literal["peak", "rms"] = "peak"
    scenario: str | None = None  # whose response it is; None is the unchanged machine
    masses: float = 0.0  # share by which the mass of every row may be off

    @property
    def name(self) -> str:
        return self.response.name

    @cached_property
    def nothing(self) -> bool:
        """Whether the root mean square of the curve is what rounding leaves of all that is added up in it."""
        response = self.response
        size = float(response.curves.pieces.size[response.number])
        rms = np.hypot(abs(response.mean), np.sqrt(response.variance))
        return not self.masses > 0.0 and not rms > DUST * size

    @property
    def mean(self) -> complex:
        """Mean of the curve over the turn."""
        return 0j if self.nothing else self.response.mean

    @cached_property
    def spread(self) -> float:
        """sqrt(V), what the root mean square comes to at least, but for its error."""
        return 0.0 if self.nothing else float(np.sqrt(self.response.variance))

    @property
    def rms_error(self) -> float:
        """What the root mean square may be off by; of a curve that has cancelled nothing is left to be off."""
        return 0.0 if self.nothing else self.response.rms_error

    def cut(self, angle: float, value: complex) -> Cut:
        """The cut of the peak at an angle [rad], where the curve has a value."""
        influence = self.response.influence_at(angle)
        return Cut(value, influence, angle_deg=math.degrees(angle), scalar=self.response.scalar)

    def harmonics(self, largest: float) -> tuple[Cut, ...]:
        """Cuts that tell together all that counterweights add to a peak, at any angle: each speed at which they turn.

        The mean of d + sum_n c_n e^{j n theta}, turned back by n, is no longer than the peak, so that this is at least
        |c_n| less the largest |d|; of a scalar |c_n + conj(c_-n)| / 2, in its two parts.

        Parameters
        ----------
        largest : of the curve without counterweights, or more.
        """
        influence, turning = self.response.influence, self.response.turning
        if turning is None or self.measure == "rms":
            return ()
        if not self.response.scalar:
            return tuple(Cut(0j, np.where(turning == n, influence, 0.0), -largest) for n in np.unique(turning))
        cuts = []
        for n in np.unique(np.abs(turning)):
            share = np.where(turning == n, 0.5, 0.0) + np.where(turning == -n, 0.5, 0.0)
            for quarter in (1.0, 1.0j) if n else (1.0,):
                phase = np.where(turning < 0, np.conj(quarter), quarter)
                cuts.append(Cut(0j, share * phase * influence, -largest, scalar=True))
        return tuple(cuts)

    def peak(self, u: Complex, scatter: Scatter, lower: float, upper: float, cut: Cut) -> Evaluation:
        """The peak where counterweights scatter, from what it is where they do not."""
        more = scatter.of(self.response.influence, u)
        return Evaluation(lower + more, upper + more, cut)

    def rms(self, u: Complex, scatter: Scatter) -> Evaluation:
        """The root mean square: with the angle of the vector (|mean + H u|, sqrt(V)) its cut is it.

        Both errors are within those of mean and variance.
        """
        mean, influence = self.mean, self.response.influence
        along_mean = abs(mean + self.response.offset(u)) + scatter.of(influence, u)
        value = float(np.hypot(along_mean, self.spread))
        along, across = (along_mean / value, self.spread / value) if value > 0 else (1.0, 0.0)
        off = self.rms_error
        cut = Cut(along * mean, along * influence, across * self.spread - off, share=along)
        return Evaluation(value - off, value + off, cut)


class Pool:
    """The cuts of every quantity so far."""

    def __init__(self, first: Sequence[Sequence[Cut]], scatter: Scatter) -> None:
        self.cuts = [list(cuts) for cuts in first]
        self.nodes: Real | None = None  # (n, P) half-angles at which the masses of plates have tangents, rad
        self.scatter = scatter

    def count(self) -> int:
        return sum(len(cuts) for cuts in self.cuts)

    def add(self, evaluations: Sequence[Sequence[Evaluation]], u: Complex, matters: Real) -> bool:
        """Take the cuts of every quantity whose true value is above what matters; whether any was new."""
        new = False
        for cuts, several, least in zip(self.cuts, evaluations, matters, strict=True):
            above = [evaluation for evaluation in several if evaluation.lower > least]
            if not above:
                continue
            level = max(cut.at(u, self.scatter) for cut in cuts) * (1.0 + 4 * np.finfo(float).eps)
            for evaluation in above:
                if evaluation.lower > level and not any(evaluation.cut.alike(cut) for cut in cuts):
                    cuts.append(evaluation.cut)
                    new = True
        return new

    def forget(self, u: Complex) -> None:
        """Keep what is largest at a point."""
        for q, cuts in enumerate(self.cuts):
            if len(cuts) > _MOST_CUTS:
                self.cuts[q] = sorted(cuts, key=lambda cut: -cut.at(u, self.scatter))[:_MOST_CUTS]
