"""Which quantities decide what a program over the turn comes to: of the others a coarse bracket tells enough."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from optimizer.numerics.arrays import Real
from optimizer.program.cuts.cut import Evaluation
from optimizer.program.rows import Row

#: share of what a quantity is below what decides that its bracket may take up
_SHARE = 0.25
#: what is smaller is nothing
_TINY = 1e-300


class Weighed(NamedTuple):
    """offset + weight * quantity, a row of a group."""

    quantity: int  # its place in the program
    weight: float  # > 0
    offset: float = 0.0


class Group(NamedTuple):
    """The largest of some rows and of some quantities."""

    rows: tuple[Row, ...] = ()
    weighed: tuple[Weighed, ...] = ()


def spare(groups: Sequence[Group], about: Real) -> Real:
    """How wide brackets may be, relative to what quantities (quantities,) are about, to tell of those that decide
    nothing that they do not; 0 of those that may decide."""
    left, sizes = [np.inf] * about.size, about.tolist()
    for group in groups:
        level = max((member.offset + member.weight * sizes[member.quantity] for member in group.weighed), default=0.0)
        for member in group.weighed:
            room = (level - member.offset) / member.weight - sizes[member.quantity]
            left[member.quantity] = min(left[member.quantity], room)
    size = np.maximum(about, _TINY)
    return _SHARE * (np.clip(left, 0.0, size) / size)


def deciding(groups: Sequence[Group], evaluations: Sequence[Evaluation]) -> np.ndarray:
    """(quantities,) whether any may be the largest of a group, by brackets."""
    may = [False] * len(evaluations)
    for group in groups:
        least = max(
            (member.offset + member.weight * evaluations[member.quantity].lower for member in group.weighed),
            default=0.0,
        )
        for member in group.weighed:
            may[member.quantity] |= member.offset + member.weight * evaluations[member.quantity].upper > least
    return np.array(may, dtype=bool)
