"""Any two or three responses that are traded for one another, and the programs over the turn that stand on them."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import product

import numpy as np

from optimizer.formulation.formulate import RESPONSES, weighing
from optimizer.numerics.arrays import SMALLEST, Complex, Real, Reals
from optimizer.numerics.memoization import cached_property
from optimizer.numerics.records import record
from optimizer.program.cuts.dominance import Group, Weighed
from optimizer.program.cuts.semi_infinite import Goal, Problem
from optimizer.program.norms import Norms
from optimizer.program.rows import Row, total_mass
from optimizer.program.solution import OPTIMUM_SHARE
from schemas.base.variation import with_fields
from schemas.front.trade import Traded
from schemas.request.objective import Objective

#: width of the brackets by which the counterweights of an answer are judged, as a share of what is traded
_CLOSE = 1e-10
#: quantities over the turn, by what stands before the colon in their names, where that is not what is traded
_OF: dict[str, Traded] = {"bearing": "bearings"}


def alone(objective: Objective, names: Sequence[Traded]) -> Objective:
    """The objective that is the largest of some responses, each as it is; or itself, where that is traded."""
    if "objective" in names:
        return with_fields(objective, {("priorities",): ()})
    return weighing(
        objective,
        dict.fromkeys(names, 1.0),
        combine="max",
        priorities=(),
        bearing_weight=float("bearings" in names),
        bending_weight=float("bending" in names),
        roll_weight=float("roll" in names),
    )


@record(frozen=True)
class Measures:
    """D responses of a machine under its limits and ceilings, over omega^2 but for the mass.

    names : of the responses.
    program : of them all, to be given goals.
    groups : the largest of what each consists of.
    """

    names: tuple[Traded, ...]
    program: Problem
    groups: tuple[Group, ...]

    def values(self, u: Complex) -> Real:
        """What each comes to with counterweights (K,) kg m, (D,); of what is known by a bracket the upper end."""
        return self.separate.values(u, _CLOSE).goals

    def excess(self, u: Complex) -> float:
        """The largest relative excess over a ceiling; -inf without."""
        return self.separate.values(u, _CLOSE).excess

    @cached_property
    def separate(self) -> Problem:
        """The program with a goal for each, that are not put in any order."""
        pairs = zip(self.names, self.groups, strict=True)
        return replace(self.program, goals=tuple(Goal(name, (group,)) for name, group in pairs))

    @cached_property
    def at_rest(self) -> Real:
        """Their values without counterweights (D,)."""
        return self.values(np.zeros(self.program.limits.radius.shape, dtype=complex))

    def gross(self, u: Complex) -> Real:
        """What every counterweight by itself adds to each at most, summed (D,)."""
        size = (1.0 + self.program.scatter.share) * np.abs(u)
        return np.array([self._most(group, size) for group in self.groups])

    def _most(self, group: Group, size: Real) -> float:
        of_rows = [sum(np.sum(np.abs(peak.norms.influence) @ size) for peak in row.peaks) for row in group.rows]
        quantities = self.program.quantities
        of_weighed = [w * np.abs(quantities[q].response.influence) @ size for q, w, _ in group.weighed]
        return float(max([*of_rows, *of_weighed], default=0.0))

    def first(self, index: int, size: Real, allowance: float) -> Problem:
        """The program that makes one small, and after it the largest of the others by their sizes (D,).

        Parameters
        ----------
        allowance : share of its size that the others may use.
        """
        rest = [above(self.groups[i], 0.0, size[i]) for i in range(len(self.names)) if i != index]
        goal = Goal(self.names[index], (self.groups[index],), float(size[index]), allowance=allowance)
        return replace(self.program, goals=(goal, Goal("others", (_largest(rest),), 1.0)))

    def along(self, anchor: Real, unit: Real) -> Problem:
        """min max_i (R_i - anchor_i)/unit_i: the first attainable point on the line anchor + t unit, (D,) both."""
        rows = [above(*arguments) for arguments in zip(self.groups, anchor.tolist(), unit.tolist(), strict=True)]
        return replace(self.program, goals=(Goal("trade", (_largest(rows),), 1.0),))


def measures(program: Problem, names: tuple[Traded, ...]) -> Measures:
    """The responses that a program weighs, by their names."""
    every = tuple(row for group in program.groups for row in group.rows)
    groups = {
        "mass": Group((total_mass(program.limits, *program.scatter),)),
        "objective": Group(tuple(row for goal in program.goals for of_case in _sums(goal) for row in _summed(of_case))),
    } | {
        name: Group(
            tuple(row for row in every if row.peaks[0].name == name),
            tuple(
                member
                for group in program.groups
                for member in group.weighed
                if _traded(program.quantities[member.quantity].name) == name
            ),
        )
        for name in names
        if name not in ("mass", "objective")
    }
    return Measures(names, program, tuple(groups[name] for name in names))


def _sums(goal: Goal) -> Iterator[Sequence[Group]]:
    """The sums of which a goal is the largest: one, or one of every case."""
    cases = goal.cases or (0,) * len(goal.groups)
    for case in dict.fromkeys(cases):
        yield [group for group, of in zip(goal.groups, cases, strict=True) if of == case]


def _summed(groups: Sequence[Group]) -> Iterator[Row]:
    """Rows of which the largest is the sum of the largest of every group: each with each."""
    if len(groups) == 1:
        yield from groups[0].rows
        return
    for rows in product(*(group.rows for group in groups)):
        yield Row("sum", tuple(peak for row in rows for peak in row.peaks))


def _traded(quantity: str) -> Traded:
    """What a quantity over the turn belongs to."""
    kind = quantity.partition(":")[0]
    return _OF.get(kind, kind)


def sizes(at_rest: Real, gross: Real, unit: Reals = 1.0) -> Real:
    """What gaps are relative to (D,): what is there without counterweights; where that is nothing, what they do.

    Parameters
    ----------
    gross : (D,) the most that counterweights do one by one, summed.
    unit : (D,) what gaps are relative to where they do nothing either.
    """
    size = np.where(at_rest > OPTIMUM_SHARE * gross, at_rest, gross)
    return np.where(size > SMALLEST, size, unit)


def unit_of(name: Traded, objective: Objective) -> str:
    """Unit of a response."""
    if name in RESPONSES:
        return RESPONSES[name].unit
    specific = objective.bearing_measure == "specific"
    inside = {"bearings": "Pa" if specific else "N", "bending": "N m", "roll": "N m"}
    return (inside | {"mass": "kg", "objective": "as weighed"})[name]


def above(group: Group, anchor: float, unit: float) -> Group:
    """A response as a share of a unit above an anchor."""
    rows = tuple(scaled(row, anchor, unit) for row in group.rows)
    weighed = tuple(Weighed(q, weight / unit, (offset - anchor) / unit) for q, weight, offset in group.weighed)
    return Group(rows, weighed)


def scaled(row: Row, anchor: float, unit: float) -> Row:
    """A row as a share of a unit above an anchor."""
    peaks = [
        replace(peak, floor=peak.floor / unit, norms=Norms(peak.norms.constant / unit, peak.norms.influence / unit))
        for peak in row.peaks
    ]
    # the anchor once, however many peaks are added up
    peaks[0] = replace(peaks[0], floor=peaks[0].floor - anchor / unit)
    return Row(row.name, tuple(peaks))


def _largest(groups: Sequence[Group]) -> Group:
    """The largest of several groups."""
    return Group(
        tuple(row for group in groups for row in group.rows),
        tuple(member for group in groups for member in group.weighed),
    )
