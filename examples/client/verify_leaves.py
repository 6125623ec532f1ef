"""Every number and text of an answer, and whether a claim stands for it: what is not looked at is named.

What says how an answer was found, when, and in which words (REMARKS) claims nothing that a request could contradict;
all else is either checked or listed.
"""

from __future__ import annotations

from math import isfinite
from typing import Any, Dict, Iterator, List, Set, Tuple, Union

from verify_numbers import Place, Unreadable, pointer

Path = Tuple[Union[str, int], ...]
#: how it was found and told: the last part of a path, or the path from the answer on
REMARKS = {
    "version", "timing", "effects", "status_reason", "warnings", "method", "rounds", "nodes", "cuts", "gearing",
    "reason", "message", "label", "index", "description", "time_limit_reached", "mean_torque_error_Nm",
    "fluctuation_energy_error_J",
}  # fmt: skip
#: names that are listed
MOST = 200


def account(answer: Place, visits: Set[Path], evidence: Set[Path]) -> Dict[str, Any]:
    """How many leaves there are, how many were looked at, and the names of the others, those of a list as one."""
    counts = [0, 0]
    names: Dict[str, None] = {}
    for path in _left(answer, visits, evidence, counts):
        names.setdefault(pointer(tuple("*" if isinstance(part, int) else part for part in path)))
    return {"leaves": counts[0], "checked": counts[1], "not_covered": list(names)[:MOST]}


def _left(answer: Place, visits: Set[Path], evidence: Set[Path], counts: List[int]) -> Iterator[Path]:
    """Places of what was not looked at: a whole part of the answer where nothing of it was."""
    # without recursion: what is nested deeply is judged like all else
    start: Path = answer.path
    left: List[Tuple[Any, Path]] = [(answer.value, start)]
    missed: List[Path] = []
    while left:
        value, path = left.pop()
        name = path[-1] if path else ""
        if name in REMARKS or path in evidence:
            _finite(value, path)
            continue
        if isinstance(value, (dict, list)):
            items = value.items() if isinstance(value, dict) else enumerate(value)
            left.extend((item, (*path, key)) for key, item in reversed(list(items)))
        elif value is not None:
            _finite(value, path)
            counts[0] += 1
            counts[1] += path in visits
            if path not in visits:
                missed.append(path)
    prefixes = {path[:n] for path in visits for n in range(len(path) + 1)}
    for path in missed:
        # the shortest part of which nothing was looked at
        yield next((path[:n] for n in range(len(start) + 1, len(path)) if path[:n] not in prefixes), path)


def _finite(value: Any, path: Path) -> None:
    """Raises where a number of what is below a place is not finite."""
    left = [value]
    while left:
        item = left.pop()
        if isinstance(item, float) and not isfinite(item):
            raise Unreadable(path, "must be a finite number")
        if isinstance(item, (dict, list)):
            left.extend(item.values() if isinstance(item, dict) else item)


def leaves(value: Any) -> int:
    """Numbers and texts in a JSON value."""
    count, left = 0, [value]
    while left:
        item = left.pop()
        if isinstance(item, (dict, list)):
            left.extend(item.values() if isinstance(item, dict) else item)
        count += 1
    return count
