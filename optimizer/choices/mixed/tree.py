"""Branch and bound over the options, the other webs relaxed to their discs and sectors until all options are decided.

A node without choice is the program of the other webs alone. Where these have least masses, a tree of them decides it.
"""

from dataclasses import replace
from typing import Any

import numpy as np

from optimizer.choices.clock import Clock
from optimizer.choices.discrete.branch import Work
from optimizer.choices.discrete.options import Options
from optimizer.choices.discrete.relaxed import hulls
from optimizer.choices.mixed.incumbent import MixedIncumbent
from optimizer.choices.relaxations import solved
from optimizer.choices.semicontinuous.search import SearchGoal
from optimizer.numerics.arrays import Complex, Real, spread
from optimizer.numerics.memoization import cached_property
from optimizer.numerics.records import record
from optimizer.program.certificate import Multipliers, objective_lower_bound
from optimizer.program.limits import OF_WEBS, Limits
from optimizer.program.statement import Statement

#: share of the largest unbalance for a web without room: the kernel takes no limit of 0
_SPECK = 1e-9
#: an optimum may be so far above the smallest objective
_SHARE = 1e-9


@record(frozen=True)
class MixedWork(Work):
    """What is done with the nodes of such a tree."""

    yardstick: float  # of gaps, in units of the objective

    @property
    def best(self) -> MixedIncumbent:
        """The incumbent, which knows the other webs."""
        assert isinstance(self.incumbent, MixedIncumbent)
        return self.incumbent

    @cached_property
    def loose(self) -> tuple[Statement, np.ndarray]:
        """The program with every web an unknown of its own, and the slot of each web of a slot.

        What is proven knows that webs are alike all the same.
        """
        alike = self.options.alike
        statement = replace(self.statement, limits=replace(self.statement.limits, alike=None))
        return statement, np.arange(self.options.slots) if alike is None else alike.owner

    def relaxation(self, left: np.ndarray, clock: Clock) -> tuple[Complex, Multipliers, np.ndarray]:
        statement, slot = self.loose
        options = self.options
        webs = replace(
            options, unbalance=options.on_webs, mass=(options.mass / options.webs[:, None])[slot], alike=None
        )
        base, limits = self._around(webs, left[:, slot])
        program = replace(statement.about(base), limits=limits)
        result = solved(program, None, np.full(len(left), _SHARE), np.zeros(len(left)), False, clock)
        near = (base + result.unbalance)[:, : slot.size]
        near = near if options.alike is None else options.alike.means(near)
        return near, result.multipliers, result.nowhere

    def _around(self, webs: Options, left: np.ndarray) -> tuple[Complex, Limits]:
        """Base points (N, W + S) kg m, and limits of what is added to them.

        Parameters
        ----------
        webs : whose every slot is a web.
        left : (N, W, O) options of N nodes.
        """
        hull, free_limits, own = hulls(webs, left), self.best.free_webs.limits, self.statement.limits
        radius = own.radius[: left.shape[1]]
        of_slots = {
            "radius": spread(radius, hull.reach.shape),
            "max_mass": hull.reach / radius,
            "free": hull.free,
            "centre": hull.centre,
            "half_angle_cos": hull.half_angle_cos,
            "half_angle_sin": hull.half_angle_sin,
        }
        shape = (len(left), free_limits.radius.size)
        arrays: dict[str, Any] = {
            name: np.concatenate([of_slots[name], spread(getattr(free_limits, name), shape)], axis=-1)
            for name in OF_WEBS
        }
        largest = float(np.max(arrays["radius"] * arrays["max_mass"]))
        arrays["max_mass"] = np.maximum(arrays["max_mass"], _SPECK * largest / arrays["radius"])
        budget = np.maximum(own.max_total_mass - hull.mass, _SPECK * (hull.mass + 1e-300))
        base = np.concatenate([hull.base, np.zeros(shape)], axis=-1)
        return base, replace(own, **arrays, max_total_mass=budget, alike=None)

    def enumeration(self, left: np.ndarray, forced: Real, bound: Real, clock: Clock) -> tuple[np.ndarray, float]:
        decided = np.all(np.sum(left, axis=-1) == 1, axis=-1)
        if not np.any(decided):
            return decided, np.inf
        sets = np.argmax(left[decided], axis=-1)
        self.best.offer(sets)
        below = self.best.programs(sets, self.statement)
        relaxations = self.best.free_webs.optima(below, clock=clock)
        least = np.maximum(objective_lower_bound(below, relaxations.multipliers), bound[decided])
        least = np.where(relaxations.nowhere, np.inf, least)
        open_sets = np.flatnonzero(least < self.incumbent.least - self.gap).tolist()
        for n in open_sets if self.best.free_webs.semicontinuous else ():
            if not clock.spent():
                least[n] = self._of_set(sets[n], below.subset(n), float(least[n]), clock)
        return decided, float(np.min(least))

    def _of_set(self, selection: np.ndarray, below: Statement, at_least: float, clock: Clock) -> float:
        """What a set (K,) comes to at least, whatever the other webs carry; the best of it is offered."""
        best = self.best
        goal = SearchGoal(max(0.5 * self.gap, 0.0), self.yardstick, 0.0, clock.left_s)
        u, least = best.free_webs.proven(best.programs(selection[None]).subset(0), below, at_least, goal)
        best.offer_beside(selection[None], u[None])
        return least
