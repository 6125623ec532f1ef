"""The waist over the whole turn: responses of all orders, seen from the shaft, where counterweights only shift them.

Beside :mod:`optimizer.responses.response`, which knows one order at a time. A vector across the shaft, F(theta) on the
frame, is
d(theta) = e^{-j s theta} F(theta) as the shaft sees it. Counterweights turn with the shaft, so they add a constant:
d(theta) + influence @ u. The peak over the turn is then the distance of a point from the farthest point of a fixed
curve, and convex in u. Its floor is the radius of the smallest circle around the curve.

Everything is divided by omega^2, as in :class:`optimizer.responses.response.Response`: forces are kg m, moments kg m^2,
and the influence of a counterweight is free of speed. Angles are shaft angles theta in rad, from 0 to the period.
"""

from collections.abc import Sequence
from typing import Protocol

import numpy as np

from optimizer.numerics.arrays import Complex, Real, Reals, in_order
from optimizer.numerics.records import record
from optimizer.responses.floors import Floor, Floors
from optimizer.responses.moving_curves import Harmonics, with_harmonics
from optimizer.responses.piecewise_cubics import Bracket, Index, Pieces
from optimizer.responses.worst_masses import Parts


class Curves(Protocol):
    """J curves over one period that are evaluated together."""

    @property
    def period_deg(self) -> float:
        """360, or 720 where the gas takes two turns."""

    @property
    def pieces(self) -> Pieces:
        """The curves piece by piece, (J,)."""

    @property
    def mean(self) -> Complex:
        """Means over the period (J,)."""

    @property
    def variance(self) -> Real:
        """Means of |curve - mean|^2 over the period (J,)."""

    @property
    def rms_error(self) -> Real:
        """What root mean squares of curve + constant, by this mean and variance, may be off by (J,)."""

    @property
    def parts(self) -> Parts:
        """What the inertia of each row adds to the curves."""

    def at(self, angle: Real) -> Complex:
        """The curves at angles (n,) rad: (J, n); in the middle between the limits at a jump or one of them."""


@record(frozen=True)
class TurnResponse:
    """A response over the whole turn that is affine in the unbalance u of the counterweights.

    name : what it is, unique among the responses of a program.
    unit : of the response times omega^2: "N", "N m".
    influence : (K,) change of the curve for one kg m on each web; real, or complex where a counterweight answers out
        of line with itself. Constant over the turn.
    curves, number : the curve without counterweights, over omega^2: one of several that are evaluated together.
    turning : (K,) how often what each web adds turns, as the shaft sees it, while the shaft turns once: the influence
        is then H_k e^{j n_k theta}. None where all of it stands still.
    scalar : the curve is real, and of what counterweights add the real part counts: no vector across the shaft, but
        one number at every angle. Something of it turns.
    """

    name: str
    unit: str
    influence: Real | Complex
    curves: Curves
    number: int
    turning: Real | None = None
    scalar: bool = False

    @property
    def period_deg(self) -> float:
        return self.curves.period_deg

    def offset(self, unbalance: Complex) -> complex:
        """What counterweights (K,) kg m add to the curve."""
        return complex(self.influence @ unbalance)

    def influence_at(self, angle: float) -> Real | Complex:
        """Influence (K,) at a shaft angle [rad]."""
        return self.influence if self.turning is None else self.influence * np.exp(1j * self.turning * angle)

    def contribution(self, unbalance: Complex, angle: Real) -> Complex | complex:
        """What counterweights (K,) kg m add to the curve at angles (n,) rad; one for all where it stands still."""
        moving = self.harmonics(unbalance)
        return self.offset(unbalance) if moving is None else moving.at(angle)

    def harmonics(self, unbalance: Complex) -> Harmonics | None:
        """What counterweights (K,) kg m add to the curve, where some of it turns; None where it stands still."""
        return None if self.turning is None else Harmonics(self.turning, self.influence * unbalance, self.scalar)

    def at(self, angle: Real) -> Complex:
        """The curve without counterweights at angles (n,) rad."""
        return self.curves.at(angle)[self.number]

    def peak(self, offset: complex, tolerance: float) -> Bracket:
        """Peak of |curve + offset| over the period; shapes ().

        Parameters
        ----------
        tolerance : of upper - lower, relative to lower.
        """
        brackets = self.curves.pieces.peaks(np.array([offset]), tolerance, np.array([self.number]))
        return Bracket(*(brackets[0] for brackets in brackets))

    @property
    def mean(self) -> complex:
        """Mean of the curve, the centre of its mean square."""
        return complex(self.curves.mean[self.number])

    @property
    def variance(self) -> float:
        """Mean of |curve - mean|^2: the mean square of curve + offset is this + |mean + offset|^2."""
        return float(self.curves.variance[self.number])

    @property
    def rms_error(self) -> float:
        """What sqrt(variance + |mean + offset|^2) may be off by, whatever the offset."""
        return float(self.curves.rms_error[self.number])


def peaks(responses: Sequence[TurnResponse], unbalance: Complex, tolerance: Reals) -> Bracket:
    """Peaks (responses,) with counterweights (K,) kg m; those of the same curves are searched together.

    Parameters
    ----------
    tolerance : (responses,) or one for all, of upper - lower, relative to lower.
    """
    influence = np.array([response.influence for response in responses])
    # product by product, as of a response alone
    offset = (influence[:, None, :] @ unbalance[:, None]).reshape(-1).astype(complex, copy=False)
    if all(response.turning is None for response in responses):
        return peaks_about(responses, offset, tolerance)
    # what turns makes another curve of each
    tolerances = np.broadcast_to(tolerance, len(responses))
    contribution = [response.harmonics(unbalance) for response in responses]
    brackets = [
        peaks_about([response], offset[k : k + 1], tolerances[k])
        if by is None
        else _moving(response, by, tolerances[k])
        for k, (response, by) in enumerate(zip(responses, contribution, strict=True))
    ]
    return Bracket(*(np.concatenate(part) for part in zip(*brackets, strict=True)))


def peaks_about(
    responses: Sequence[TurnResponse], offset: Complex, tolerance: Reals, group: Index | None = None
) -> Bracket:
    """Peaks (responses,) with what is added to each curve (responses,); a response may stand there more than once.

    Parameters
    ----------
    group : (responses,) from 0, each of one response, to search only the largest of each group, which costs
        less: peaks (groups,).
    """
    number: Index = np.array([response.number for response in responses], dtype=np.intp)
    first = responses[0].curves
    if group is None and all(response.curves is first for response in responses):
        # as mostly: there is nothing to be put together
        return first.pieces.peaks(offset, tolerance, number)
    tolerances, owner = (
        np.broadcast_to(tolerance, len(responses)),
        np.arange(len(responses)) if group is None else group,
    )
    together: dict[int, list[int]] = {}
    for k, response in enumerate(responses):
        together.setdefault(id(response.curves), []).append(k)
    groups, brackets = [], []
    for numbers in together.values():
        labels, of = np.unique(owner[numbers], return_inverse=True)
        groups.append(labels)
        brackets.append(
            responses[numbers[0]].curves.pieces.peaks(offset[numbers], tolerances[numbers], number[numbers], of)
        )
    order = np.argsort(np.concatenate(groups))
    return Bracket(*(np.concatenate(part)[order] for part in zip(*brackets, strict=True)))


def _moving(response: TurnResponse, by: Harmonics, tolerance: Reals) -> Bracket:
    """Peak (1,) of a curve to which counterweights add what turns; its value is that without them all the same."""
    brackets = with_harmonics(response.curves.pieces, response.number, by).peaks(np.zeros(1, dtype=complex), tolerance)
    return brackets._replace(value=brackets.value - by.at(brackets.angle))


def floors(
    curves: Curves, tolerance: float, numbers: Sequence[int] | Index | None = None, group: Index | None = None
) -> Floors:
    """The smallest circles around curves, each radius to a tolerance relative to it.

    Parameters
    ----------
    numbers : which curves, by default all; of designs in which the same pieces have a width.
    group : (numbers,) from 0, to search only the largest radius of each group: of the others no more is found
        out than that they are smaller.
    """
    from optimizer.responses.kernel.parts import Members

    pieces = curves.pieces
    every = np.arange(len(pieces.half))
    number = every if numbers is None else np.array(numbers, dtype=np.int64)
    together = every[: number.size] if group is None else in_order(np.asarray(group, np.int64))
    open_ = np.array([tolerance])
    members = Members(number, together, np.zeros(0, complex), open_, pieces.size[number], np.zeros(0))
    return pieces.source.circles(pieces.cubics, members)


def floor(response: TurnResponse, tolerance: float) -> Floor:
    """The smallest circle around the curve of a response."""
    return floors(response.curves, tolerance, [response.number]).floor(0)
