"""Curves of several forces of the rows of one machine, so that one search serves all.

The rows are expanded about an angle once, whatever the forces, and each force is read from that expansion.
"""

from itertools import accumulate, chain, pairwise

import numpy as np

from optimizer.mechanics.curve_series import CurveSeries, SeriesCurves
from optimizer.mechanics.whole_turn import TurnCurves
from optimizer.numerics.memoization import cached_property
from optimizer.numerics.records import record
from optimizer.responses.piecewise_cubics import Index, Pieces


@record(frozen=True)
class CurveBatch(SeriesCurves):
    """Curves of one turn of one machine, those of one part after those of another."""

    parts: tuple[TurnCurves, ...]

    @cached_property
    def first(self) -> Index:
        """Number of the first curve of each part, and how many there are in all."""
        return np.array((0, *accumulate(len(part.weights[0]) for part in self.parts)))

    @cached_property
    def pieces(self) -> Pieces:
        """The curves piece by piece (J, P)."""
        turn = self.parts[0].whole
        cubic, rest, size = self._series.over(turn.points, turn.bounds, turn.half)
        centre, half = (array.repeat(len(rest), axis=0) for array in (turn.centre, turn.half))
        pieces = Pieces(centre, half, cubic, rest, size, source=self)
        for part, ends in zip(self.parts, pairwise(self.first.tolist()), strict=True):
            part.take(pieces, slice(*ends))
        return pieces

    @cached_property
    def _series(self) -> CurveSeries:
        turn = self.parts[0].whole
        readings = tuple(chain.from_iterable((part.reading,) * len(part.weights[0]) for part in self.parts))
        weights, constant = (
            np.concatenate([getattr(part, name)[0] for part in self.parts]) for name in ("weights", "constant")
        )
        return CurveSeries(turn.rows, turn.centre, readings, weights, constant)
