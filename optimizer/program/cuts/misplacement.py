"""What a goal over the turn comes to at worst where counterweights are not quite what they should be.

As in :mod:`optimizer.program.misplacement`. A peak over the turn is convex in what the counterweights add to its curve.
So the worst of all additions is at one of finitely many corners, each with a bracket of its own.
"""

from collections.abc import Callable, Iterator, Sequence

import numpy as np

from optimizer.numerics.arrays import Complex, Real
from optimizer.program.cuts.cut import EXACT, Evaluation, Quantity
from optimizer.program.cuts.semi_infinite import Problem
from optimizer.program.misplacement import angle_corners, mass_corners, worst_by_angle, worst_by_mass
from optimizer.program.norms import Norms
from optimizer.responses.curve import peaks_about

#: relative width of the brackets
_WIDTH = 1e-7


def largest_last_goals(
    program: Problem, u: Complex, reached: Sequence[Evaluation], angle: float, share: float
) -> tuple[float, float]:
    """The last goal where every counterweight (K,) is off by up to an angle [rad], and by up to a share of its mass.

    Neither is less than what it comes to; of a sum of peaks it may be more.

    Parameters
    ----------
    program : whose counterweights do not scatter.
    reached : what its quantities come to with counterweights as they should be.
    """
    assert program.scatter == EXACT
    kinds: tuple[_Kind, ...] = (
        (2.0 * np.sin(0.5 * angle), lambda norms: worst_by_angle(norms, u, angle), lambda v: angle_corners(v, angle)),
        (share, lambda norms: worst_by_mass(norms, u, share), lambda v: share * mass_corners(v)),
    )
    quantities = tuple(zip(program.quantities, reached, program.samples.cancelled, strict=True))
    worst = [[_no_less(quantity, u, entry, nothing, kind) for quantity, entry, nothing in quantities] for kind in kinds]
    sharp = [(k, q) for k, of_kind in enumerate(worst) for q in _matter(program, reached, of_kind)]
    for (k, q), peak in zip(sharp, _sharper(program, u, [(kinds[k], q) for k, q in sharp]), strict=True):
        worst[k][q] = min(worst[k][q], peak)
    by_angle, by_mass = (_last_goal(program, size, entry) for (_, size, _), entry in zip(kinds, worst, strict=True))
    return by_angle, by_mass


#: largest change of a counterweight as a share of it, sizes of norms at worst, and corners of what sums may change by
_Kind = tuple[float, Callable[[Norms], Real], Callable[[Complex], Complex]]


def _no_less(quantity: Quantity, u: Complex, reached: Evaluation, cancelled: bool, kind: _Kind) -> float:
    """What a quantity comes to at worst, or more: every counterweight off along what is largest.

    Parameters
    ----------
    cancelled : there is no curve, so that counterweights are all of it.
    """
    change, size, _ = kind
    response = quantity.response
    if quantity.measure == "rms":
        mean = Norms(np.array([quantity.mean]), response.influence[None])
        return float(np.hypot(size(mean)[0], quantity.spread)) + quantity.rms_error
    if cancelled and response.turning is None:
        return max(float(size(Norms(np.zeros(1, complex), response.influence[None]))[0]), reached.upper)
    return reached.upper + change * float(np.sum(np.abs(response.influence * u)))


def _matter(program: Problem, reached: Sequence[Evaluation], worst: Sequence[float]) -> list[int]:
    """Peaks that may decide the last goal, where what counterweights add stands still."""
    numbers: set[int] = set()
    for group in program.goals[-1].groups:
        least = max(
            (member.offset + member.weight * reached[member.quantity].lower for member in group.weighed), default=0.0
        )
        numbers |= {
            member.quantity
            for member in group.weighed
            if member.offset + member.weight * worst[member.quantity] > least
        }
    peaks = [
        quantity.measure == "peak" and quantity.response.turning is None and not cancelled
        for quantity, cancelled in zip(program.quantities, program.samples.cancelled, strict=True)
    ]
    return sorted(q for q in numbers if peaks[q])


def _sharper(program: Problem, u: Complex, kinds: Sequence[tuple[_Kind, int]]) -> Iterator[float]:
    """The worst of peaks by brackets at all corners."""
    if not kinds:
        return
    responses, offsets, of = [], [], []
    for n, ((_, _, corners), q) in enumerate(kinds):
        response = program.quantities[q].response
        contributions = response.influence * u
        shifts = corners(contributions[contributions != 0])
        shifts = response.offset(u) + (shifts if shifts.size else np.zeros(1, complex))
        responses += [response] * shifts.size
        offsets.append(shifts)
        of += [n] * shifts.size
    yield from peaks_about(responses, np.concatenate(offsets), _WIDTH, np.array(of)).upper.tolist()


def _last_goal(program: Problem, size: Callable[[Norms], Real], of_quantities: Sequence[float]) -> float:
    largest = [
        max(
            [float(sum(peak.floor + np.sum(size(peak.norms)) for peak in row.peaks)) for row in group.rows]
            + [member.offset + member.weight * of_quantities[member.quantity] for member in group.weighed]
        )
        for group in program.groups
    ]
    return float(program.of_goals(np.array(largest))[-1])
