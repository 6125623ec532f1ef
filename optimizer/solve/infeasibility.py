"""Ceilings over the turn that no counterweights keep: which conflict, and what comes closest."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from optimizer.formulation.balance_shafts import Fitted, placement_of
from optimizer.formulation.formulate import RESPONSES, objective_ceilings
from optimizer.formulation.formulate import limited as limited_responses
from optimizer.formulation.goals import Goals
from optimizer.formulation.simulation import Prepared
from optimizer.formulation.task import Task
from optimizer.outputs.first_order import first_order, response_peaks, smallest_peaks, smallest_proofs
from optimizer.program.cuts.dominance import Group, Weighed
from optimizer.program.cuts.optimum import METHOD, CertifiedOptimum, Conflict
from optimizer.program.cuts.semi_infinite import Goal, Problem
from optimizer.program.limits import Limits
from optimizer.program.optimum import optimum
from optimizer.program.rows import Row, weighted_peak
from optimizer.program.verdict import INFEASIBLE
from optimizer.solve.conflict import TAKES_PART, ProvenConflict, proven_conflict
from optimizer.solve.cut_plates import cut_plates, implied_masses
from optimizer.solve.solution import Infeasible, multipliers_of
from schemas.answer.infeasibility import Closest, Infeasibility, SmallestPeak
from schemas.answer.limits import CeilingField
from schemas.answer.proof import BoundMultipliers, InfeasibilityMultipliers
from schemas.base.responses import PAIR
from schemas.machine.machine import Machine

#: relative gap of the smallest peaks by themselves
_ALONE = 1e-7
#: so many responses of a conflict are looked at by themselves
_MOST_AT_FAULT = 6


class Smallest(NamedTuple):
    """What a response comes to by itself at least, in the units of the answer."""

    value: float
    lower_bound: float
    multipliers: BoundMultipliers


class ImpliedMasses(NamedTuple):
    """Largest masses that proofs count with where those of the machine are larger, by web, kg."""

    together: dict[str, float]
    alone: dict[str, dict[str, float]]  # of responses whose smallest peak is proven for others


class StatedCeiling(NamedTuple):
    """A ceiling of a task."""

    response: str
    field: CeilingField
    allowed: float  # [unit of the response]
    over_turn: bool = False  # on a response over the whole turn

    @property
    def needs_entry(self) -> bool:
        """With what its response comes to at least, for which the answer has no other field."""
        return self.over_turn or self.response not in PAIR


def report(
    scene: Prepared,
    placement: Fitted,
    ceilings: Sequence[StatedCeiling],
    together: Sequence[StatedCeiling],
    least: Mapping[str, Smallest],
    implied: ImpliedMasses,
    conflict: ProvenConflict | None,
) -> Infeasibility:
    """Why there are no counterweights: which ceilings conflict, and the smallest peaks within the limits.

    Parameters
    ----------
    placement : what comes closest.
    together : ceilings that conflict where each by itself can be kept.
    least : of the responses, and of all under ceilings that the report is about.
    implied : largest masses that the proofs count with.
    """
    impossible = [ceiling for ceiling in ceilings if least[ceiling.response].lower_bound > ceiling.allowed]
    left = replace(scene, shafts=placement.on_shafts).first_order(placement.on_crank)
    return Infeasibility(
        conflict=tuple(dict.fromkeys(entry.field for entry in impossible or together)),
        **smallest_peaks(
            {name: entry.value for name, entry in least.items()},
            {name: entry.lower_bound for name, entry in least.items()},
        ),
        smallest=tuple(
            SmallestPeak(
                response=entry.response,
                ceiling_field=entry.field,
                ceiling=entry.allowed,
                smallest=least[entry.response].value,
                lower_bound=least[entry.response].lower_bound,
                multipliers=least[entry.response].multipliers,
            )
            for entry in dict.fromkeys(ceilings)
            if entry.needs_entry
        ),
        implied_max_mass_kg=implied.together,
        smallest_implied_max_mass_kg=implied.alone,
        scenarios=() if conflict is None else conflict.scenarios,
        closest=Closest(
            counterweights=placement.counterweights,
            balance_shafts=placement.balance_shafts,
            first_order=first_order(left),
            responses=response_peaks(scene, left),
        ),
        multipliers=InfeasibilityMultipliers(
            conflict=None if conflict is None else conflict.multipliers,
            scenarios=() if conflict is None else conflict.alone,
            **smallest_proofs({name: entry.multipliers for name, entry in least.items()}),
        ),
    )


def out_of_reach(task: Task, scene: Prepared, goals: Goals, failure: Conflict) -> Infeasible:
    """Which ceilings conflict, what each peak comes to by itself, and the best compromise."""
    cut, there, within, mass, angle = cut_plates(task, scene, goals, failure.closest.unbalance, failure.limits)
    infeasible = unreachable(
        task, there, goals, placement_of(cut.machine, cut.objective, mass, angle), failure.limits, failure
    )
    return infeasible if within.program.plates is None else replace(infeasible, cut=there)


def unreachable(
    task: Task,
    scene: Prepared,
    goals: Goals,
    placement: Fitted,
    within: Limits,
    failure: Conflict | None,
) -> Infeasible:
    """The same of what is shown as closest, with the proof by multipliers where there is one."""
    square = scene.omega_squared
    alone = goals.program.changed(ceilings=(), limited=())
    groups = {name: Group(rows=rows) for name, rows in _alone(task, goals, square).items()}
    if task.objective.orders == "all":
        groups |= _of_all_orders(goals, PAIR, square)
    # quantities in the conflict; all with ceilings if the proof does not name them
    at_fault = _under_ceilings(task, goals) if failure is None else _at_fault(failure)
    limited = {alone.quantities[limit.quantity].name: limit for limit in goals.limited}
    limited = {name: limit for name, limit in limited.items() if name in at_fault}
    for name in limited:
        of_name = {limit.quantity: limit for limit in goals.limited if alone.quantities[limit.quantity].name == name}
        groups[name] = Group(weighed=tuple(Weighed(q, limit.omega_squared / square) for q, limit in of_name.items()))
    least = {name: _least(alone, group) for name, group in groups.items()}
    peaks = {
        name: Smallest(goal.value * square, goal.lower_bound * square, multipliers_of(goal.proof, square, goals.speeds))
        for name, (goal,) in ((name, smallest.goals) for name, smallest in least.items())
    }
    # of all orders the ceilings are among what is limited over the turn
    ceilings = objective_ceilings(task.objective) if task.objective.orders == "first" else []
    exact = [StatedCeiling(fields.response, fields.field, allowed) for fields, allowed in ceilings]
    of_turn = [
        StatedCeiling(name, limit.field, limit.ceiling, over_turn=True)
        for limit in goals.limited
        for name in [alone.quantities[limit.quantity].name]
        if name in limited
    ]
    # of a cone program a small multiplier may hold a large ceiling
    few = goals.program.finite is None
    together = [ceiling for ceiling in (*exact, *of_turn) if few and ceiling.response in at_fault] or exact
    conflict = None if failure is None else proven_conflict(goals.program, failure, goals.speeds)
    implied = _implied(task.space.machine, within, {name: peak.limits for name, peak in least.items()})
    infeasibility = report(scene, placement, (*exact, *of_turn), together, peaks, implied, conflict)
    spent = (0.0 if failure is None else failure.certify_s) + sum(peak.certify_s for peak in least.values())
    return Infeasible("infeasible", INFEASIBLE, infeasibility, spent, METHOD if failure is None else failure.method)


def _implied(machine: Machine, together: Limits, alone: Mapping[str, Limits]) -> ImpliedMasses:
    """The masses within which the conflict is proven, and of each response by itself where that counts with others."""
    rest = {name: limits for name, limits in alone.items() if np.any(limits.max_mass != together.max_mass)}
    return ImpliedMasses(
        implied_masses(machine, together), {name: implied_masses(machine, limits) for name, limits in rest.items()}
    )


def _alone(task: Task, goals: Goals, omega_squared: float) -> dict[str, tuple[Row, ...]]:
    """Peaks of the first order, and components with a ceiling, by themselves: the largest of all cases."""
    rows: dict[str, list[Row]] = {}
    for case in goals.cases:
        for responses in case.variants:
            limited = limited_responses(responses, task.objective) if task.objective.orders == "first" else ()
            components = [response for response, _ in limited if response.name not in RESPONSES]
            for response in (*responses, *components):
                of_name = rows.setdefault(response.name, [])
                name = f"{response.name} {len(of_name)}" if of_name else response.name
                of_name.append(Row(name, (weighted_peak(response, case.omega_squared / omega_squared),)))
    return {name: tuple(rows_of) for name, rows_of in rows.items()}


def _at_fault(failure: Conflict) -> list[str]:
    """Responses whose ceilings conflict, those first that the proof leans on most."""
    statement, row = failure.proof.statement, np.maximum(failure.proof.multipliers.row, 0.0)
    share: dict[str, float] = {}
    for term, owner in zip(statement.names.terms, statement.row.tolist(), strict=True):
        share[term.response] = share.get(term.response, 0.0) + float(row[owner] / np.sum(row))
    leant = [name for name, part in share.items() if part > TAKES_PART]
    return sorted(leant, key=lambda name: -share[name])[:_MOST_AT_FAULT]


def _under_ceilings(task: Task, goals: Goals) -> list[str]:
    """Responses that have a ceiling, the first of them."""
    ceilings = objective_ceilings(task.objective) if task.objective.orders == "first" else ()
    limited = (goals.program.quantities[limit.quantity].name for limit in goals.limited)
    return list(dict.fromkeys((*(fields.response for fields, _ in ceilings), *limited)))[:_MOST_AT_FAULT]


def _of_all_orders(goals: Goals, names: Sequence[str], omega_squared: float) -> dict[str, Group]:
    """Peaks of all orders by themselves, with a ceiling or not: the largest of all cases."""
    weighed: dict[str, list[Weighed]] = {name: [] for name in names}
    for q, quantity in enumerate(goals.program.quantities):
        if quantity.name in weighed:
            weighed[quantity.name].append(Weighed(q, goals.speeds[quantity.scenario] / omega_squared))
    return {name: Group(weighed=tuple(of_name)) for name, of_name in weighed.items()}


def _least(program: Problem, group: Group) -> CertifiedOptimum:
    """The smallest value of one group."""
    # without ceilings nothing is out of reach
    return optimum(program.changed(goals=(Goal("alone", (group,)),)), _ALONE, False).certain()
