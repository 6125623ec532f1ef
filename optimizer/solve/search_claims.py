"""What may be claimed of counterweights that a search has found, beside what is proven of any mass at any angle."""

import numpy as np

from optimizer.choices.discrete.search import EXHAUSTED
from optimizer.choices.feasible_set import SearchResult

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
    " The bound is that of free masses and angles: the catalogue comes so close to these that no closer bound was"
    " proven."
)
_NONE = "Proven infeasible: no set of counterweights keeps the ceilings, since {proof}."
_BY = {True: "all were compared", False: "branch and bound excludes all of them"}
_NONE_FOUND = (
    "The search ended before it found a set of counterweights that keeps the ceilings or proved that none does. The"
    " closest set is shown."
)


def ended(found: SearchResult | None) -> str:
    """What is said of the lightest set that keeps the ceilings; None: none of any masses does."""
    if found is None:
        return _NONE.format(proof="no free masses do")
    if not found.kept:
        return _NONE.format(proof=_BY[found.method == EXHAUSTED]) if found.lower_bound == np.inf else _NONE_FOUND
    if found.ended is not None:
        return _WHY[found.ended]
    return _LIGHTEST if found.proven else _TREE


def told_status(found: SearchResult, status: str, reason: str, proven: bool) -> tuple[str, str]:
    """What may be said of a set, from what the search and the verdict say."""
    if not proven:
        return status, reason
    if not found.kept:
        if found.lower_bound == np.inf:
            return "infeasible", _NONE.format(proof=_BY[found.method == EXHAUSTED])
        return "inaccurate", _NONE_FOUND
    if status == "optimal":
        return status, _ALL if found.proven else _TREE
    if found.ended is not None:
        return status, _WHY[found.ended]
    return status, reason


def told_ample(reason: str, found: SearchResult, of_any: float) -> str:
    """The same with what is said of a choice of which nothing is proven but what holds for any masses at any angles.

    Parameters
    ----------
    of_any : lower bound of these, over omega^2.
    """
    return reason + _AMPLE if reason in _WHY.values() and not found.lower_bound > of_any else reason
