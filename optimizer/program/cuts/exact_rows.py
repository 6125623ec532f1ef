"""Rows of goals in closed form, all at once: searches evaluate an unbalance by them many times."""

from collections.abc import Sequence

import numpy as np

from optimizer.numerics.arrays import Complex
from optimizer.program.cuts.cut import Scatter
from optimizer.program.cuts.dominance import Group


class ExactRows:
    """The rows of some groups, sums of weighted peaks without scalars."""

    def __init__(self, groups: Sequence[Group]) -> None:
        self._groups = [[row.peaks for row in group.rows] for group in groups]
        norms = [peak.norms for rows in self._groups for peaks in rows for peak in peaks]
        self._none = not norms
        if norms:
            self._constant = np.concatenate([part.constant for part in norms])
            self._influence = np.concatenate([part.influence for part in norms])

    def at(self, u: Complex, scatter: Scatter) -> list[list[float]]:
        """What the rows of every group come to with an unbalance (K,) kg m."""
        if self._none:
            return [[] for _ in self._groups]
        vectors = self._constant + np.add.reduce(self._influence * u, axis=-1)
        sizes = iter(np.abs(vectors).tolist())
        sums: list[list[float]] = []
        for rows in self._groups:
            sums.append([])
            for peaks in rows:
                value = 0.0
                for peak in peaks:
                    size = sum([next(sizes) for _ in range(peak.norms.constant.size)])
                    value += float(peak.floor) + size + scatter.of(peak.norms.influence, u)
                sums[-1].append(value)
        return sums
