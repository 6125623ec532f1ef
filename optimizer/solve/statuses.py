"""What an answer says of itself: the status, and a sentence why, of searches and of optima of any mass.

What is true of both is in :mod:`optimizer.program.verdict`.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from optimizer.choices.discrete.search import EXHAUSTED
from optimizer.choices.feasible_set import SearchResult
from optimizer.formulation.task import Demand
from optimizer.program.cuts.optimum import CertifiedOptimum
from optimizer.program.verdict import CONTRADICTED, Verdict
from schemas.answer.answers import GoalReached

_ALL = (
    "Proven optimal: of all sets of counterweights none within the limits has a smaller objective, and none with the"
    " same objective has less mass."
)
_LIGHTEST = "Proven optimal: of all sets of counterweights none that keeps the ceilings has less mass."
_TREE = (
    "Proven within the requested gap: no set of counterweights within the limits is better than this one by more than"
    " the gap that the certificate states."
)
#: why a search left a gap
LATE = "The search ended at accuracy.time_limit_s. The certificate states the gap to the proven lower bound."
_SIZE = "The search ended at the largest size of its tree. The certificate states the gap to the proven lower bound."
_CUTS = (
    "The search ended because further candidates gave no new cut. The certificate states the gap to the proven lower"
    " bound."
)
_ROUNDING = (
    "The search has divided all that can be chosen, and rounding leaves a gap. The certificate states the gap to the"
    " proven lower bound."
)
_WHY = {"time": LATE, "size": _SIZE, "cuts": _CUTS, "rounding": _ROUNDING}
#: beside any of these, where the tree has proven nothing of its own
_AMPLE = (
    " The bound is that of free masses and angles: what may be chosen comes so close that no closer bound was proven."
)
_NONE = "Proven infeasible: no set of counterweights keeps the ceilings, since {proof}."
_BY = {True: "all were compared", False: "branch and bound excludes all of them"}
_NOTHING_FEASIBLE = (
    "The search ended before it found a set of counterweights that keeps the ceilings or proved that none does. The"
    " closest set is shown."
)
_EARLIER = (
    "The last goal is within the requested gap. The search for another goal ended with a larger gap, which `goals`"
    " of the certificate states."
)
_IN_ORDER = "Proven optimal: every goal is certified in its order, and keeps what those before it allow."


def ended(result: SearchResult | None) -> str:
    """What is said of the lightest set that keeps the ceilings; None: none of any masses does."""
    if result is None:
        return _NONE.format(proof="no free masses do")
    if not result.feasible:
        return (
            _NONE.format(proof=_BY[result.method == EXHAUSTED]) if result.lower_bound == np.inf else _NOTHING_FEASIBLE
        )
    if result.ended is not None:
        return _WHY[result.ended]
    return _LIGHTEST if result.proven else _TREE


def search_status(result: SearchResult, status: str, reason: str, proven: bool) -> tuple[str, str]:
    """What may be said of a set, from what the search and the verdict say."""
    if not proven:
        return status, reason
    if not result.feasible:
        if result.lower_bound == np.inf:
            return "infeasible", _NONE.format(proof=_BY[result.method == EXHAUSTED])
        return "inaccurate", _NOTHING_FEASIBLE
    if status == "optimal":
        return status, _ALL if result.proven else _TREE
    if result.ended is not None:
        return status, _WHY[result.ended]
    return status, reason


def ample_reason(reason: str, result: SearchResult, of_any: float) -> str:
    """The same with what is said of a choice of which nothing is proven but what holds for any masses at any angles.

    Parameters
    ----------
    of_any : lower bound of these, over omega^2.
    """
    return reason + _AMPLE if reason in _WHY.values() and not result.lower_bound > of_any else reason


class SearchProof(NamedTuple):
    """The proof of a search about all choices."""

    ended: SearchResult  # of the last goal
    nodes: int  # of the trees of all goals
    rounds: int  # likewise
    bounds: Sequence[float] | None  # of the goals before it, over omega^2; None: of goals in order nothing is proven
    closed: bool  # the gaps of all goals are at most the target gap
    levels: Sequence[GoalReached] = ()  # all goals in their order, where some are what castings cost

    @property
    def lower_bound(self) -> float:
        """Of the last goal, over omega^2: of what keeps the ceilings, so that of what does not nothing is proven."""
        return -np.inf if self.bounds is None or not self.ended.feasible else self.ended.lower_bound


def status_of(
    optimum: CertifiedOptimum, judged: Verdict, demand: Demand, search: SearchProof | None, allowance: float
) -> tuple[str, str]:
    """The status and a sentence why.

    Parameters
    ----------
    allowance : of the last goal, for what comes after it.
    """
    status, reason = str(judged.status.item()), str(judged.reason.item())
    if optimum.timed_out and status != "optimal" and reason != CONTRADICTED:
        reason = f"The time limit of {demand.time_limit_s:g} s ended the search. {reason}"
    if search is not None:
        proven = search.bounds is None or not np.isnan(judged.lower_bound[0])
        status, reason = search_status(search.ended, status, reason, proven)
        if search.bounds is not None:
            reason = ample_reason(reason, search.ended, optimum.proof.bound)
        if status == "optimal" and not search.closed:
            return "inaccurate", _EARLIER
    if status == "optimal" and (allowance > 0.0 or (search is not None and search.levels)):
        reason = _IN_ORDER
    return status, reason
