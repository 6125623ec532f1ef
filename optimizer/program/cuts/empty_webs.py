"""Webs left empty over the turn that carry next to nothing (:mod:`optimizer.program.methods.empty_webs`).

What rounding cannot take away is sought again without these webs, as the least mass under all goals. The point is taken
where it keeps them and is as light as is proven to be good enough: what is proven of all webs holds for it.
"""

from dataclasses import replace

import numpy as np

from optimizer.numerics.arrays import Real
from optimizer.numerics.records import record
from optimizer.program.cuts.cut import Pool
from optimizer.program.cuts.rounding import snap_turn_to_limits
from optimizer.program.cuts.semi_infinite import Problem
from optimizer.program.cuts.stage import Levels, Point, Search
from optimizer.program.methods.rounding import dust
from optimizer.program.solution import CEILING_ROUNDING
from optimizer.program.statement import Statement
from optimizer.program.verdict import MASS_GAP

#: relative gap of the mass that may be left, most of what an answer may claim
_HEAVIER = 0.9 * MASS_GAP
#: of the mass of a point that does not keep its goals, which anything that does is lighter than
_NO_POINT = 2.0
#: how often webs are left empty that only then carry next to nothing
_ROUNDS = 3


@record(frozen=True)
class EmptyWebs:
    """What the search without some webs needs to know of the program."""

    program: Problem
    statement: Statement  # with some cuts
    pool: Pool
    most: Real  # (goals,) what the goals may come to
    margin: Real  # (goals,) by which the solver aims lower
    mass_bound: float | None  # kg, nothing is lighter; None where the mass does not count
    raised: bool  # ceilings take up the tolerance that they have
    until: float  # time.thread_time() at which the search ends
    enough: float  # relative gap of the mass that ends it
    width: float  # of the brackets of all figures

    def leave(self, point: Point) -> Point:
        """The point without dust, all of it at once or web by web, as far as it stays an optimum."""
        empty = np.zeros(point.unbalance.shape, bool)
        for _ in range(_ROUNDS):
            nothing = self._dust(point)
            if not nothing.any():
                return point
            candidate = self._without(empty | nothing, point)
            if candidate is None:
                break
            point, empty = candidate, empty | nothing
        for web in np.argsort(np.abs(point.unbalance) / self.program.limits.radius):
            if self._dust(point)[web]:
                alone = empty | (np.arange(empty.size) == web)
                candidate = self._without(alone, point)
                if candidate is not None:
                    point, empty = candidate, alone
        return point

    def _dust(self, point: Point) -> np.ndarray:
        return dust(np.abs(point.unbalance) / self.program.limits.radius)

    def _without(self, empty: np.ndarray, point: Point) -> Point | None:
        """An optimum that needs none of these webs (K,) bool; None if the search finds none."""
        limits = self.program.limits
        bare = self.program.changed(limits=replace(limits, max_mass=np.where(empty, 0.0, limits.max_mass)))
        u = np.where(empty, 0.0, point.unbalance)
        start = Point(u, bare.values(u, self.width), _NO_POINT * point.mass)
        levels = Levels(self.margin, self.most, self.most)
        candidate = Search(bare, self.pool, levels, start, self.raised, self.until).run(self.enough).point
        if candidate is start or candidate.mass >= start.mass:
            return None
        statement = replace(self.statement, limits=bare.limits)
        candidate = snap_turn_to_limits(bare, statement, candidate, self.most, self.mass_bound, self.width)
        close = bool(np.all(candidate.values.goals <= np.maximum(self.most, point.values.goals)))
        compliance = candidate.values.excess <= max(point.values.excess, CEILING_ROUNDING)
        heaviest = np.inf if self.mass_bound is None else self.mass_bound / (1.0 - _HEAVIER)
        return candidate if close and compliance and candidate.mass <= max(point.mass, heaviest) else None
