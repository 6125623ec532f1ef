"""The program with quantities that are known by cuts: bearing peaks beside force and moment, root mean squares.

minimise    P_n(u) = sum_g max( rows of the group, w_q Q_q(u) of its quantities )      the last goal, or the mass
subject to  P_i(u) <= most_i for the goals before it, ceilings on responses and on quantities, limits

With finitely many cuts of every quantity it is a statement whose objective and ceilings no u exceeds: what is proven
of that is proven of the program.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np

from optimizer.arrays import Complex, Real
from optimizer.program.cut import Cut, Quantity, Reached, reached
from optimizer.program.limits import Limits
from optimizer.program.statement import Norms, Row, Statement, WeightedPeak, statement
from optimizer.program.verdict import yardstick
from optimizer.response import Phasors, Response

#: relative width of the brackets by which quantities are known where they only are a measure
_FINE = 1e-9
#: of every quantity
Cuts = Sequence[Sequence[Cut]]


class Weighed(NamedTuple):
    """offset + weight * quantity, a row of a group."""

    quantity: int  # its place in the program
    weight: float  # > 0
    offset: float = 0.0


class Group(NamedTuple):
    """The largest of some rows and of some quantities."""

    rows: tuple[Row, ...] = ()
    weighed: tuple[Weighed, ...] = ()


class Goal(NamedTuple):
    """A sum of groups that is to be small."""

    name: str
    groups: tuple[Group, ...]


class Values(NamedTuple):
    """What an unbalance comes to; of what is known by brackets the upper figure."""

    goals: Real  # (goals,)
    over: Real  # (ceilings and limited,) excess over each ceiling, relative to its size
    reached: tuple[Reached, ...]  # every quantity

    @property
    def excess(self) -> float:
        """The largest excess over a ceiling; -inf without ceilings."""
        return float(np.max(self.over, initial=-np.inf))


@dataclass(frozen=True)
class OverTurn:
    """A program whose quantities are known by cuts.

    goals : in the order of their priority, at least one.
    ceilings, limited : responses with the largest peak allowed, and quantities, by their place, with the largest value.
    """

    quantities: tuple[Quantity, ...]
    goals: tuple[Goal, ...]
    ceilings: tuple[tuple[Response, float], ...]
    limited: tuple[tuple[int, float], ...]
    limits: Limits

    @cached_property
    def groups(self) -> tuple[Group, ...]:
        """Groups of all goals."""
        return tuple(group for goal in self.goals for group in goal.groups)

    @cached_property
    def goal_of(self) -> np.ndarray:
        """(groups,) goal to which a group belongs."""
        return np.repeat(np.arange(len(self.goals)), [len(goal.groups) for goal in self.goals])

    @cached_property
    def first(self) -> Cuts:
        """Cuts to begin with."""
        return tuple(quantity.first for quantity in self.quantities)

    @cached_property
    def at_rest(self) -> Values:
        """Without counterweights."""
        still = np.zeros(self.limits.radius.shape, complex)
        return self._values(still, self._resting, self.sizes)

    @cached_property
    def _resting(self) -> tuple[Reached, ...]:
        return reached(self.quantities, np.zeros(self.limits.radius.shape, complex), _FINE)

    @cached_property
    def yardsticks(self) -> Real:
        """(goals,) what gaps are relative to, as :func:`optimizer.program.verdict.yardstick` has it."""
        rest = self.at_rest.goals
        return np.array(
            [value or float(yardstick(self.alone(n).statement(self.first))) for n, value in enumerate(rest.tolist())]
        )

    @cached_property
    def sizes(self) -> Real:
        """(ceilings and limited,) what excesses are measured by."""
        exact = self._posed(self.first).ceilings.size[: len(self.ceilings)]
        rest = np.array([self._resting[q].upper for q, _ in self.limited])
        size = np.maximum(np.array([cap for _, cap in self.limited]), rest)
        return np.concatenate([exact, np.where(size > 0, size, 1.0)])

    def alone(self, n: int) -> "OverTurn":
        """The program of one of the goals alone."""
        return replace(self, goals=self.goals[n : n + 1])

    def statement(self, cuts: Cuts) -> Statement:
        """The program with finitely many cuts of every quantity: its groups, its ceilings with what is limited last."""
        posed = self._posed(cuts)
        if not self.limited:
            return posed
        # an excess is a share of the quantity's size, not of its cuts'
        count = np.concatenate([np.ones(len(self.ceilings), int), [len(cuts[q]) for q, _ in self.limited]])
        return replace(posed, ceilings=replace(posed.ceilings, size=np.repeat(self.sizes, count.astype(int))))

    def _posed(self, cuts: Cuts) -> Statement:
        groups = [
            [
                *group.rows,
                *(self._row(each, cut) for each in group.weighed for cut in cuts[each.quantity]),
            ]
            for group in self.groups
        ]
        limited = [(self._limited(q, cut), cap) for q, cap in self.limited for cut in cuts[q]]
        return statement(groups, [*self.ceilings, *limited], self.limits)

    def _row(self, weighed: Weighed, cut: Cut) -> Row:
        name, weight = self.quantities[weighed.quantity].name, weighed.weight
        norms = Norms(np.array([weight * cut.constant]), weight * cut.influence[None, :])
        peak = WeightedPeak(name, np.asarray(weighed.offset + weight * cut.floor), norms)
        return Row(name if cut.angle_deg is None else f"{name} at {cut.angle_deg!r} deg", (peak,))

    def _limited(self, q: int, cut: Cut) -> Response:
        """A response that is above a ceiling only where the quantity is."""
        response = self.quantities[q].response
        return Response(
            response.name,
            response.unit,
            Phasors(np.asarray(cut.constant), np.asarray(complex(cut.floor))),
            cut.influence,
        )

    def values(self, u: Complex, tolerance: float) -> Values:
        """What an unbalance (K,) comes to.

        Parameters
        ----------
        tolerance : relative width of the brackets of the quantities.
        """
        return self._values(u, reached(self.quantities, u, tolerance), self.sizes)

    def _values(self, u: Complex, found: tuple[Reached, ...], sizes: Real) -> Values:
        largest = [
            max(
                [_sum(row, u) for row in group.rows]
                + [each.offset + each.weight * found[each.quantity].upper for each in group.weighed]
            )
            for group in self.groups
        ]
        over = [float(response.to(u).peak) - cap for response, cap in self.ceilings]
        over += [found[q].upper - cap for q, cap in self.limited]
        return Values(np.bincount(self.goal_of, largest).astype(float), np.array(over) / sizes, found)

    def excess(self) -> "OverTurn":
        """The program of the smallest largest excess over the ceilings; its sign tells whether they can be kept."""
        rows = []
        for (response, cap), size in zip(self.ceilings, self.sizes.tolist(), strict=False):
            norms = Norms(response.baseline.co[..., None] / size, response.influence[..., None, :] / size)
            floor = np.asarray((np.abs(response.baseline.counter) - cap) / size)
            rows.append(Row(response.name, (WeightedPeak(response.name, floor, norms),)))
        sizes = self.sizes[len(self.ceilings) :].tolist()
        weighed = [Weighed(q, 1.0 / size, -cap / size) for (q, cap), size in zip(self.limited, sizes, strict=True)]
        goal = Goal("excess", (Group(tuple(rows), tuple(weighed)),))
        return replace(self, goals=(goal,), ceilings=(), limited=())


def _sum(row: Row, u: Complex) -> float:
    return float(sum(peak.floor + np.sum(np.abs(peak.norms.at(u))) for peak in row.peaks))
