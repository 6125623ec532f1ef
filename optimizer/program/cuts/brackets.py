"""What quantities over the turn come to, between two figures that are proven."""

from collections.abc import Sequence

import numpy as np

from optimizer.numerics.arrays import Complex, Real
from optimizer.program.cuts.cut import Evaluation, Quantity, Scatter
from optimizer.responses.curve import peaks
from optimizer.responses.mass_scatter import peaks_astray

#: relative width of brackets of what has no part in a goal; times the largest force of a machine it is a double yet
WIDEST = 1e100
#: unbalances that are remembered
_REMEMBERED = 3
#: share of an unbalance within which another is near
_NEAR = 1e-9


class Brackets:
    """Brackets of quantities. Brackets at recent unbalances are kept, and bound the quantities near them.

    Where counterweights differ by du, a quantity differs by no more than sum |H_k du_k|, and what scatters with them.
    """

    def __init__(self, quantities: Sequence[Quantity], cancelled: Sequence[bool], scatter: Scatter) -> None:
        """Prepare.

        Parameters
        ----------
        cancelled : (quantities,) those whose curves are nothing.
        """
        self._quantities, self._cancelled, self._scatter = quantities, cancelled, scatter
        self._recent: list[tuple[Complex, dict[int, Evaluation]]] = []

    def evaluate(self, u: Complex, tolerance: Real, selection: Sequence[int] | None = None) -> tuple[Evaluation, ...]:
        """What quantities come to with an unbalance (K,) kg m.

        Parameters
        ----------
        tolerance : (quantities,) of upper - lower, relative to lower.
        selection : which, by default all.
        """
        numbers = range(len(self._quantities)) if selection is None else selection
        results: dict[int, Evaluation] = {}
        near_by = _NEAR * np.maximum.reduce(np.abs(u), initial=0.0) if self._recent else 0.0
        for at, evaluations in reversed(self._recent):
            change = np.abs(u - at)
            if np.maximum.reduce(change, initial=0.0) <= near_by:
                near = {
                    q: self._near(q, evaluations[q], change) for q in numbers if q in evaluations and q not in results
                }
                results |= {
                    q: evaluation
                    for q, evaluation in near.items()
                    if evaluation.upper - evaluation.lower <= tolerance[q] * evaluation.lower
                }
        missing = [q for q in numbers if q not in results]
        if missing:
            # half the tolerance: rounding and reuse for near unbalances then leave brackets within it
            new = dict(zip(missing, self._evaluations(u, 0.5 * tolerance, missing), strict=True))
            self._recent = [*self._recent[1 - _REMEMBERED :], (u, new)]
            results |= new
        return tuple(results[q] for q in numbers)

    def _near(self, q: int, reached: Evaluation, change: Real) -> Evaluation:
        influence = np.abs(self._quantities[q].response.influence)
        off = float(influence @ change) * (1.0 + self._scatter.share)
        return Evaluation(reached.lower - off, reached.upper + off, reached.cut)

    def _evaluations(self, u: Complex, tolerance: Real, numbers: list[int]) -> tuple[Evaluation, ...]:
        quantities, scatter = self._quantities, self._scatter
        results: dict[int, Evaluation] = {}
        peak: list[int] = []
        for q in numbers:
            # a curve of rounding has the peak of what is added to it, at once where that stands still
            if quantities[q].measure == "rms":
                results[q] = quantities[q].rms(u, scatter)
            elif self._cancelled[q] and (quantities[q].response.turning is None or not np.any(u)):
                size = abs(quantities[q].response.offset(u))
                results[q] = quantities[q].peak(u, scatter, size, size, quantities[q].cut(0.0, 0j))
            else:
                peak.append(q)
        scattered = [q for q in peak if quantities[q].masses > 0.0]
        exact = [q for q in peak if not quantities[q].masses > 0.0]
        for group in (scattered, exact):
            if group:
                responses = [quantities[q].response for q in group]
                bracket = (
                    peaks(responses, u, tolerance[group])
                    if group is exact
                    else peaks_astray(responses, [quantities[q].masses for q in group], u, tolerance[group])
                )
                for q, angle, value, lower, upper in zip(group, *(part.tolist() for part in bracket), strict=True):
                    results[q] = quantities[q].peak(u, scatter, lower, upper, quantities[q].cut(angle, value))
        return tuple(results[q] for q in numbers)
