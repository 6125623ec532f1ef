"""The problem: goals in order under ceilings and limits, with quantities by cuts where there are any.

Such are bearing peaks beside force and moment, and root mean squares. :attr:`Problem.finite` has finitely many norms.

minimise    P_n(u) = sum_g max( rows of the group, w_q Q_q(u) of its quantities )      the last goal, or the mass
            or the largest of several such sums
subject to  P_i(u) <= most_i for the goals before it, ceilings on responses and on quantities, limits

With finitely many cuts of every quantity it is a statement whose objective and ceilings no u exceeds: what is proven
of that is proven of the program.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from optimizer.numerics.arrays import SMALLEST, Complex, Real, Reals
from optimizer.numerics.memoization import cached_property
from optimizer.numerics.records import record
from optimizer.program.ceilings import Ceilings, limited
from optimizer.program.cuts.brackets import WIDEST, Brackets
from optimizer.program.cuts.cut import EXACT, Cut, Evaluation, Quantity, Scatter
from optimizer.program.cuts.dominance import Group, Weighed, deciding, spare
from optimizer.program.cuts.exact_rows import ExactRows
from optimizer.program.cuts.samples import Samples
from optimizer.program.cuts.terms import Terms
from optimizer.program.limits import Limits
from optimizer.program.norms import Norms
from optimizer.program.plate_pieces import Plates, total_mass
from optimizer.program.points import points_at
from optimizer.program.rows import Row, WeightedPeak, statement
from optimizer.program.scaling import natural_reach
from optimizer.program.statement import Names, Statement
from optimizer.program.verdict import yardstick
from optimizer.responses.response import Response

#: relative width of the brackets of quantities without counterweights
_FINE = 1e-12
#: attributes that depend on the quantities alone
_OF_QUANTITIES = ("samples", "brackets", "first", "_resting")
#: what is smaller is nothing
_TINY = 1e-300
#: share of what goals and ceilings are measured by: what samples show to be smaller may be larger between them
_FAINT = 1e-9
#: excesses over no ceilings; nobody writes to it
_NONE_OVER = np.zeros(0)
#: of every quantity
Cuts = Sequence[Sequence[Cut]]


class Goal(NamedTuple):
    """A sum of groups that is to be small, or the largest of several such sums."""

    name: str
    groups: tuple[Group, ...]
    unit: float | None = None  # what gaps are measured by; by default the yardstick
    cases: tuple[int, ...] = ()  # sum to which each group belongs, in rising order from 0; by default one
    allowance: float = 0.0  # share of its unit that goals after it may use


class Values(NamedTuple):
    """Goals and excesses at an unbalance; where brackets give them, their upper ends."""

    goals: Real  # (goals,)
    over: Real  # (ceilings and limited,) excess over each ceiling, relative to its size
    reached: tuple[Evaluation, ...]  # every quantity
    over_budget: float = -1.0  # of the mass, relative to the budget, where plates count; below 0 some is left
    rounding: float | None = None  # of the goal of a problem that is a cone program

    @property
    def excess(self) -> float:
        """The largest excess over a ceiling; -inf without ceilings."""
        return float(np.maximum.reduce(self.over)) if self.over.size else -np.inf


@record(frozen=True)
class Problem:
    """What is to be small, in order, and under which ceilings and limits; it knows no request.

    Rows, ceilings and limits of a problem without quantities may have leading axes: many problems of one shape.

    goals : in the order of their priority, at least one.
    ceilings, limited : responses with the largest peak allowed, and quantities, by their place, with the largest value.
    plates : webs whose mass is no multiple of their unbalance. Their radius in the limits is that of a first gram, so
        that every proof with it holds for heavier plates.
    """

    quantities: tuple[Quantity, ...]
    goals: tuple[Goal, ...]
    ceilings: tuple[tuple[Response, Reals], ...]
    limited: tuple[tuple[int, float], ...]
    limits: Limits
    scatter: Scatter = EXACT
    plates: Plates | None = None
    symmetric: bool = False  # prefer the optimum with the symmetry of the problem

    def mass(self, u: Complex) -> float:
        """What an unbalance (K,) weighs, kg."""
        return total_mass(self.plates, self.limits.radius, u)

    @cached_property
    def finite(self) -> Statement | None:
        """The program itself, (...); None where several goals, quantities or scatter want cuts, or sums of cases."""
        (goal, *later) = self.goals
        if later or self.quantities or goal.cases or self.scatter != EXACT:
            return None
        return statement([group.rows for group in goal.groups], self.ceilings, self.limits)

    @cached_property
    def groups(self) -> tuple[Group, ...]:
        """Groups of all goals."""
        return tuple(group for goal in self.goals for group in goal.groups)

    @cached_property
    def goal_of(self) -> np.ndarray:
        """(groups,) goal to which a group belongs."""
        return np.repeat(np.arange(len(self.goals)), [len(goal.groups) for goal in self.goals])

    @cached_property
    def case_of(self) -> np.ndarray:
        """(groups,) sum to which a group belongs, of those of all goals."""
        cases = [np.array(goal.cases or [0] * len(goal.groups), dtype=int) for goal in self.goals]
        first = np.cumsum([0, *(int(case[-1]) + 1 for case in cases)])
        return np.concatenate([case + start for case, start in zip(cases, first, strict=False)])

    @cached_property
    def goal_of_case(self) -> np.ndarray:
        """(cases,) goal to which a sum belongs."""
        return self.goal_of[np.searchsorted(self.case_of, np.arange(self.case_of[-1] + 1))]

    def of_goals(self, of_groups: Real) -> Real:
        """(goals,) the largest sums of what groups (groups,) come to."""
        sums: Real = np.bincount(self.case_of, of_groups).astype(float)
        if sums.size == len(self.goals):
            return sums
        return np.maximum.reduceat(sums, np.searchsorted(self.goal_of_case, np.arange(len(self.goals))))

    def changed(self, **fields: Any) -> "Problem":
        """The program with other goals, ceilings or limits; results that depend on the quantities alone stay."""
        if all(getattr(self, name) is value for name, value in fields.items()):
            return self
        result = replace(self, **fields)
        vars(result).update({name: vars(self)[name] for name in _OF_QUANTITIES if name in vars(self)})
        if fields.keys() == {"limits"}:
            vars(result)["finite"] = None if self.finite is None else replace(self.finite, limits=result.limits)
        return result

    @cached_property
    def samples(self) -> Samples:
        """The quantities all over the turn."""
        return Samples(self.quantities)

    @cached_property
    def brackets(self) -> Brackets:
        """The quantities by what is proven of them."""
        return Brackets(self.quantities, self.samples.cancelled, self.scatter)

    @cached_property
    def first(self) -> Cuts:
        """Cuts to begin with."""
        return self.samples.first()

    @cached_property
    def telling(self) -> Cuts:
        """The same, and what tells all that counterweights change: no two of them alike in these are told apart."""
        if all(quantity.response.turning is None for quantity in self.quantities):
            return self.first
        resting = zip(self.quantities, self.first, self._resting[0], strict=True)
        return tuple((*first, *quantity.harmonics(rest.upper)) for quantity, first, rest in resting)

    @cached_property
    def at_rest(self) -> Values:
        """Without counterweights."""
        if self.finite is not None:
            still = np.zeros(self.limits.radius.shape, complex)
            over = self.finite.ceilings.excess(still) if self.ceilings else _NONE_OVER
            return Values(self.finite.at_rest[None], over, (), self._over_budget(still))
        still, fine = np.zeros(self.limits.radius.shape, complex), np.full(len(self.quantities), _FINE)
        return self._decided(still, fine, *self._resting)

    @cached_property
    def _resting(self) -> tuple[tuple[Evaluation, ...], np.ndarray]:
        """Brackets without counterweights, and which are coarse (quantities,)."""
        still = np.zeros(self.limits.radius.shape, complex)
        spare = self._spare(self.samples.sizes(still, self.scatter))
        return self.brackets.evaluate(still, np.maximum(_FINE, spare)), spare > _FINE

    @cached_property
    def yardsticks(self) -> Real:
        """(goals,) what gaps are relative to: the goal without counterweights.

        Where that is 0, what the counterweights that cancel everything in the program could change of it, as
        :func:`optimizer.program.verdict.yardstick` has it.
        """
        return self.yardsticks_within(self.limits)

    def yardsticks_within(self, limits: Limits) -> Real:
        """(goals,) what gaps are relative to, with limits that may be implied."""
        if self.finite is not None:
            return yardstick(self.finite if limits is self.limits else replace(self.finite, limits=limits))[None]
        rest = self.at_rest.goals
        if np.all(rest > 0):
            return rest
        program = self.begun
        reach = np.minimum(limits.reach, natural_reach(program))
        of_term = np.sum(np.abs(program.norms.influence) * reach, axis=-1)
        change = self.of_goals(np.bincount(program.group[program.row], of_term, len(self.groups)).astype(float))
        return np.where(rest > 0, rest, change)

    @cached_property
    def units(self) -> Real:
        """(goals,) what gaps are measured by on the way: the yardsticks, 1 where there is nothing to measure."""
        scales = [goal.unit for goal in self.goals]
        if all(unit is not None for unit in scales):
            return np.array(scales)
        return np.where(self.yardsticks > 0, self.yardsticks, 1.0)

    @cached_property
    def sizes(self) -> Real:
        """(ceilings and limited,) what excesses are measured by."""
        if self.finite is not None:
            return self.finite.ceilings.size
        rest = np.array([self._resting[0][q].upper for q, _ in self.limited])
        size = np.maximum(np.array([cap for _, cap in self.limited]), rest)
        return np.concatenate([self._exact_ceilings.size, np.where(size > 0, size, 1.0)])

    @cached_property
    def _exact_ceilings(self) -> Ceilings:
        """The ceilings on responses."""
        if not self.ceilings:
            return self._none
        exact = limited(self.ceilings, self._objective(self.first).norms, self.limits.radius.size)
        norms = replace(exact.norms, scatter=self.scatter.share)
        return replace(exact, norms=norms, cap=exact.cap - self._astray(norms))

    def _astray(self, norms: Norms) -> Real:
        """What terms grow by, whatever the counterweights."""
        return self.scatter.unbalance * np.sum(np.abs(norms.influence), axis=-1)

    def alone(self, n: int) -> "Problem":
        """The program of one of the goals alone."""
        return self.changed(goals=self.goals[n : n + 1])

    @cached_property
    def _none(self) -> Ceilings:
        """No ceilings."""
        webs = self.limits.radius.size
        norms = Norms(np.zeros(0, complex), np.zeros((0, webs)), self.scatter.share)
        return limited((), norms, webs)

    @cached_property
    def begun(self) -> Statement:
        """The program with the cuts to begin with."""
        return self.outer(self.first)

    def outer(self, cuts: Cuts) -> Statement:
        """The program with finitely many cuts of every quantity: its groups, its ceilings with what is limited last."""
        program = self._objective(cuts)
        exact, limits = self._exact_ceilings, [(q, cap, cut) for q, cap in self.limited for cut in cuts[q]]
        if not limits:
            return replace(program, ceilings=exact)
        norms = Norms(
            np.append(exact.norms.constant, [cut.constant for _, _, cut in limits]),
            np.concatenate([exact.norms.influence, *(cut.influence[None] for _, _, cut in limits)]),
            self.scatter.share,
            (*(False for _ in exact.names), *(cut.scalar for _, _, cut in limits)),
        )
        # an excess is a share of the quantity's size, not of its cuts'
        size = dict(zip(self.limited, self.sizes[len(self.ceilings) :].tolist(), strict=True))
        ceilings = Ceilings(
            (*exact.names, *(self.quantities[q].name for q, _, _ in limits)),
            norms,
            np.append(exact.cap, [cap - cut.floor for _, cap, cut in limits] - self._astray(norms)[exact.cap.size :]),
            np.append(exact.size, [size[q, cap] for q, cap, _ in limits]),
            angles_deg=(*(None for _ in exact.names), *(cut.angle_deg for _, _, cut in limits)),
            scenarios=(*(exact.scenarios or ()), *(self.quantities[q].scenario for q, _, _ in limits)),
        )
        return replace(program, ceilings=ceilings)

    def _objective(self, cuts: Cuts) -> Statement:
        """The statement without ceilings."""
        terms = Terms()
        for n, group in enumerate(self.groups):
            for row in group.rows:
                terms.add(n, row)
            for member in group.weighed:
                for cut in cuts[member.quantity]:
                    terms.add_cut(n, self.quantities[member.quantity], cut, member)
        influence: Real | Complex = np.stack(terms.influence)  # type: ignore[assignment]  # real or complex
        # what is too small to divide by has no influence
        influence = np.where(np.abs(influence) > SMALLEST, influence, 0.0)
        norms = Norms(np.array(terms.constant, dtype=complex), influence, self.scatter.share, tuple(terms.scalar))
        owner, group_of = np.array(terms.row), np.array(terms.group)
        floor = np.array(terms.floor) + np.bincount(owner, self._astray(norms)).astype(float)
        names = Names(tuple(terms.names), tuple(terms.rows))
        return Statement(norms, owner, group_of, floor, self._none, self.limits, names)

    def values(self, u: Complex, width: float) -> Values:
        """What an unbalance (K,) comes to.

        Parameters
        ----------
        width : of the brackets, as a share of what the goals and ceilings are measured by.
        """
        if self.finite is not None:
            over, point = self.finite.ceilings.excess(u) if self.ceilings else _NONE_OVER, points_at(self.finite, u)
            return Values(point.objective[None], over, (), self._over_budget(u), float(point.rounding))
        about = np.maximum(self.samples.sizes(u, self.scatter), _TINY)
        tolerance = np.clip(width * self._shares / np.maximum(about, self._faint), 1e-15, WIDEST)
        spare = self._spare(about)
        return self._decided(u, tolerance, self.brackets.evaluate(u, np.maximum(tolerance, spare)), spare > tolerance)

    def _spare(self, about: Real) -> Real:
        """Widths of brackets (quantities,) that tell of what decides nothing that it does not.

        0 of what is limited, and of what scatters, whose search wants cells to begin with.
        """
        widths = spare(self.groups, about)
        widths[[q for q, _ in self.limited]] = 0.0
        widths[[quantity.masses > 0.0 for quantity in self.quantities]] = 0.0
        return widths

    def _decided(self, u: Complex, tolerance: Real, reached: tuple[Evaluation, ...], coarse: np.ndarray) -> Values:
        """Goals and excesses at an unbalance. Brackets that are coarse (quantities,) are computed again, to a
        tolerance (quantities,) where they may decide something."""
        may = deciding(self.groups, reached)
        may[[q for q, _ in self.limited]] = True
        again = np.flatnonzero(coarse & may).tolist()
        closer = dict(zip(again, self.brackets.evaluate(u, tolerance, again), strict=True)) if again else {}
        return self._values(u, tuple(closer.get(q, evaluation) for q, evaluation in enumerate(reached)), self.sizes)

    @cached_property
    def _shares(self) -> Real:
        """(quantities,) how much of each is worth what goals and ceilings are measured by."""
        worth = np.full(len(self.quantities), np.inf)
        for group, n in zip(self.groups, self.goal_of.tolist(), strict=True):
            for member in group.weighed:
                share = float(self.units[n]) / len(self.goals[n].groups) / member.weight
                worth[member.quantity] = min(worth[member.quantity], share)
        for (q, _), size in zip(self.limited, self.sizes[len(self.ceilings) :].tolist(), strict=True):
            worth[q] = min(worth[q], size)
        return worth

    @cached_property
    def _faint(self) -> Real:
        """(quantities,) below which one nearly cancels and is bracketed by rounding: its samples say too little of how
        large it is."""
        return np.where(np.isfinite(self._shares), _FAINT * self._shares, 0.0)

    def sample_values(self, u: Complex, matters: Real) -> tuple[Values, tuple[tuple[Evaluation, ...], ...]]:
        """What an unbalance comes to at some angles, which is no more than the truth, and every quantity there.

        Parameters
        ----------
        matters : (quantities,) above which more angles than one count.
        """
        maxima = self.samples.highest(u, self.scatter, matters)
        return self._values(u, tuple(evaluations[0] for evaluations in maxima), self.sizes), maxima

    @cached_property
    def _exact_rows(self) -> ExactRows:
        return ExactRows(self.groups)

    def _values(self, u: Complex, reached: tuple[Evaluation, ...], sizes: Real) -> Values:
        largest = [
            max(rows + [member.offset + member.weight * reached[member.quantity].upper for member in group.weighed])
            for rows, group in zip(self._exact_rows.at(u, self.scatter), self.groups, strict=True)
        ]
        over = [
            float(response.to(u).peak) + self.scatter.of(response.influence, u) - cap for response, cap in self.ceilings
        ]
        over += [reached[q].upper - cap for q, cap in self.limited]
        return Values(self.of_goals(np.array(largest)), np.array(over) / sizes, reached, self._over_budget(u))

    def _over_budget(self, u: Complex) -> float:
        budget = float(self.limits.max_total_mass)
        if self.plates is None or budget == np.inf:
            return -1.0
        mass = self.mass(u)
        return mass / budget - 1.0 if budget > 0.0 else mass

    def excess_scales(self, cuts: Sequence[int]) -> Real:
        """What the rows of the program of the smallest excess are divided by, with so many cuts of every quantity."""
        count = [*(1 for _ in self.ceilings), *(cuts[q] for q, _ in self.limited)]
        return np.repeat(self.sizes, np.array(count, dtype=int))

    def excess(self) -> "Problem":
        """The program of the smallest largest excess over the ceilings; its sign tells whether they can be kept."""
        rows = []
        for (response, cap), size in zip(self.ceilings, self.sizes.tolist(), strict=False):
            norms = Norms(response.baseline.co[..., None] / size, response.influence[..., None, :] / size)
            floor = np.asarray((np.abs(response.baseline.counter) - cap) / size)
            rows.append(Row(response.name, (WeightedPeak(response.name, floor, norms, response.scenario),)))
        sizes = self.sizes[len(self.ceilings) :].tolist()
        weighed = [Weighed(q, 1.0 / size, -cap / size) for (q, cap), size in zip(self.limited, sizes, strict=True)]
        goal = Goal("excess", (Group(tuple(rows), tuple(weighed)),), 1.0)
        return self.changed(goals=(goal,), ceilings=(), limited=())
