"""Fields of an answer about its counterweights, with goals in their order."""

import time
from collections.abc import Collection, Iterator, Mapping
from dataclasses import replace
from math import isnan
from typing import NamedTuple

import numpy as np

from optimizer.formulation.balance_shafts import DesignSpace, placement_of
from optimizer.formulation.counterweights import unbalance
from optimizer.formulation.formulate import objective_ceilings
from optimizer.formulation.goals import Goals
from optimizer.formulation.limits import TOUCHED
from optimizer.formulation.simulation import Prepared
from optimizer.formulation.task import Demand, Task
from optimizer.mechanics.fixed_weights import beside, fixed_mass
from optimizer.numerics.arrays import Complex, Real
from optimizer.program.certificate import Multipliers, budget_price, ceiling_allowance
from optimizer.program.cuts.optimum import METHOD, CertifiedOptimum
from optimizer.program.cuts.proof import Proof
from optimizer.program.cuts.semi_infinite import Problem, Values
from optimizer.program.points import points_at
from optimizer.program.sensitivity import shadow_prices
from optimizer.program.verdict import CONTRADICTED, Claim, Verdict, mass_resolution, verdict
from optimizer.solve.certify import MASS_FIGURES
from optimizer.solve.cut_plates import cut_plates
from optimizer.solve.prices import shadow_prices as priced
from optimizer.solve.prices import touched_by_mass
from optimizer.solve.proof import PhysicalMultipliers
from optimizer.solve.sensitivity import sensitivity
from optimizer.solve.solution import Proofs, Solution, certificate, finite_or_null, multipliers_of
from optimizer.solve.statuses import SearchProof, status_of
from schemas.answer.answers import GoalReached
from schemas.answer.limits import MachineLimit, ShadowPrice, WebLimit

#: width of the brackets by which the counterweights of an answer are judged, as a share of goals and ceilings
_CLOSE = 1e-10
#: the same where goals are kept whose price may be high
_CLOSER = 1e-12
#: a floor is a sum of few, exact to so many units in its last place
_FLOORS = 8.0
_EPS = float(np.finfo(float).eps)


class Candidate(NamedTuple):
    """Counterweights as they are fitted, and the proof that holds for them."""

    mass: Real  # (K,) kg
    angle: Real  # (K,) degrees
    optimum: CertifiedOptimum


def fitted(
    task: Task, scene: Prepared, goals: Goals, optimum: CertifiedOptimum, demand: Demand, in_full: bool = True
) -> Solution:
    """Fields of an answer about an optimum.

    Parameters
    ----------
    goals : what the counterweights are judged by: the program that was solved, or one with more variants.
    in_full : with prices of the limits and what misplaced counterweights may cost.
    """
    task, scene, goals, mass, angle = cut_plates(task, scene, goals, optimum.point.unbalance, optimum.limits)
    if goals.program.plates is not None:
        optimum = optimum.within(goals.program.limits)
    outcome = solution_of(task, scene, goals, Candidate(mass, angle, optimum), demand, in_full=in_full)
    return outcome if goals.program.plates is None else replace(outcome, cut=scene)


def solution_of(
    task: Task,
    scene: Prepared,
    goals: Goals,
    candidate: Candidate,
    demand: Demand,
    search: SearchProof | None = None,
    in_full: bool = True,
) -> Solution:
    """The same of counterweights of any kind.

    Parameters
    ----------
    search : what is proven of all choices; None where any mass at any angle may be.
    in_full : with prices of the limits and what misplaced counterweights may cost.
    """
    began, (mass, angle, optimum) = time.perf_counter(), candidate
    together, program, square = task.space, goals.program, scene.omega_squared
    machine, u = together.machine, unbalance(mass, angle, optimum.limits.radius)
    placement = placement_of(task.machine, task.objective, mass, angle, u)
    values = program.values(u, _CLOSE if len(program.goals) == 1 else _CLOSER)
    optimum = optimum.counting(float(values.goals[-1]))
    claimed = _claim(demand, program, optimum, u, values, mass, -np.inf if search is None else search.lower_bound)
    # what the last goal allows is for the mass, and for what castings cost, after it
    judged = verdict(claimed, demand.relative_gap + program.goals[-1].allowance)
    gap, (there, _) = judged.gap.item(), beside(machine, mass, angle)
    touched = tuple(dict.fromkeys((*touched_by_mass(machine, there), *touched_ceilings(task, goals, values))))
    proofs = Proofs.of(optimum, square, goals.speeds)
    prices, several = tuple[ShadowPrice, ...](), task.robust or task.objective.priorities
    if in_full and search is None and not (several or isnan(gap) or machine.web_groups):
        # of a group no web gives way by itself, and no choice gives way at all
        active = placement.active_limits(touched)
        prices = _prices(together, goals, optimum.proof, proofs.objective, u, active, gap, square)
    at_rest, target = float(program.at_rest.goals[-1]), float(optimum.mass_target)
    printed = _printed(task, claimed, judged, at_rest, target, square) | _of_search(optimum, judged, search, square)
    status, reason = status_of(optimum, judged, demand, search, program.goals[-1].allowance)
    levels = _levels(optimum, search, goals, square)
    if search is None and program.goals[-1].allowance > 0.0:
        levels += (_mass_level(optimum, float(np.sum(there)), printed["mass_lower_bound_kg"]),)
    if judged.reason.item() == CONTRADICTED:
        levels = tuple(level.model_copy(update={"lower_bound": None, "multipliers": None}) for level in levels)
    turning = any(quantity.response.turning is not None for quantity in program.quantities)
    return Solution(
        status,
        reason,
        mass,
        angle,
        u,
        placement,
        certificate(printed, machine, optimum.limits.max_mass, proofs.by_name(optimum), levels),
        {
            "active_limits": touched,
            "shadow_prices": prices,
            "sensitivity": sensitivity(goals, u, values, square) if in_full and not turning else None,
        },
        optimum.certify_s,
        optimum.method if search is None else search.ended.method,
        0 if search is None else search.nodes,
        time.perf_counter() - began,
    )


def _printed(
    task: Task, claimed: Claim, judged: Verdict, at_rest: float, mass_target: float, omega_squared: float
) -> dict[str, float | str | None]:
    """As :func:`optimizer.solve.certify.figures`, of one machine in plain numbers."""
    of_mass = dict[str, float | None].fromkeys(MASS_FIGURES)
    if claimed.mass_lower_bound is not None:
        masses = (
            judged.mass_lower_bound.item() + float(fixed_mass(task.machine)),
            judged.mass_gap.item(),
            judged.mass_yardstick.item(),
            mass_target * omega_squared,
        )
        of_mass = dict(zip(MASS_FIGURES, masses, strict=True))
    return {
        "objective": claimed.value.item() * omega_squared,
        "lower_bound": judged.lower_bound.item() * omega_squared,
        "gap": judged.gap.item() * omega_squared,
        "relative_gap": judged.relative_gap.item(),
        "yardstick": claimed.yardstick.item() * omega_squared,
        "objective_without_counterweights": at_rest * omega_squared,
        **of_mass,
    }


def _of_search(
    optimum: CertifiedOptimum, judged: Verdict, search: SearchProof | None, omega_squared: float
) -> dict[str, Real | float | str | None]:
    """The method of the optimum, as the certificate has it."""
    by_cuts = optimum.method == METHOD
    rounds, cuts = (optimum.rounds, optimum.cuts) if by_cuts else (None, None)
    if search is None:
        return {"method": optimum.method, "cuts": cuts, "rounds": rounds}
    printed: dict[str, Real | float | str | None] = {"method": search.ended.method, "nodes": search.nodes}
    if search.bounds is None:
        return printed | {"cuts": cuts, "rounds": rounds} | dict.fromkeys(("lower_bound", "gap", "relative_gap"))
    if by_cuts:
        printed |= {"cuts": search.ended.cuts, "rounds": optimum.rounds + search.rounds}
    any_mass = np.minimum(max(optimum.proof.bound, 0.0), judged.lower_bound[0]) * omega_squared
    return printed | {"continuous_lower_bound": any_mass}


def _levels(
    optimum: CertifiedOptimum, search: SearchProof | None, goals: Goals, omega_squared: float
) -> tuple[GoalReached, ...]:
    """What goals came to in their order, as far as there are bounds of them; of those before the last with proofs."""
    if search is not None and search.levels:
        return tuple(search.levels)
    bounds = [goal.lower_bound for goal in optimum.goals[:-1]]
    if search is not None and search.bounds is not None:
        bounds = [*search.bounds]
    if search is None and goals.program.goals[-1].allowance > 0.0:
        bounds.append(optimum.proof.bound)
    levels = []
    for goal, bound in zip(optimum.goals, bounds, strict=False):
        # above what it comes to by no more than rounding
        least = finite_or_null(min(bound, goal.value) * omega_squared)
        alone = search is None and goal is not optimum.goals[-1]
        proof = multipliers_of(goal.proof, omega_squared, goals.speeds) if alone else None
        value, limit = goal.value * omega_squared, goal.most * omega_squared
        levels.append(GoalReached(goal=goal.goal, value=value, lower_bound=least, limit=limit, multipliers=proof))
    return tuple(levels)


def _mass_level(optimum: CertifiedOptimum, kilograms: float, least: object) -> GoalReached:
    """The minimum mass after goals that allow something for it."""
    bound = None if optimum.mass_proof is None else finite_or_null(np.asarray(least))
    return GoalReached(goal="mass", value=kilograms, lower_bound=bound, limit=kilograms)


def _prices(
    together: DesignSpace,
    goals: Goals,
    proof: Proof,
    in_units: PhysicalMultipliers,
    u: Complex,
    active: Mapping[str | None, Collection[WebLimit | MachineLimit]],
    gap: float,
    omega_squared: float,
) -> tuple[ShadowPrice, ...]:
    """What limits cost, by the proof of the objective: every ceiling over the turn by all of its cuts."""
    usable = Multipliers(in_units.term, in_units.row, in_units.ceiling)
    budget = None if proof.laid is None else budget_price(proof.laid, usable, 0.0)
    return priced(
        together.machine,
        together.objective,
        shadow_prices(proof.statement, u, usable, budget),
        [(limit, proof.cuts[limit.quantity]) for limit in goals.limited],
        active,
        omega_squared,
        gap,
        float(goals.program.at_rest.goals[-1]),
    )


def _claim(
    demand: Demand,
    program: Problem,
    optimum: CertifiedOptimum,
    u: Complex,
    values: Values,
    mass: Real,
    lower_bound: float,
) -> Claim:
    """What is claimed of the counterweights as they are fitted."""
    # the counterweights that the proofs count with can change no more
    size = float(program.yardsticks_within(optimum.limits)[-1])
    *before, (bound, rounding) = (_bound(program, goal.proof, u, values) for goal in optimum.goals)
    # what goals before the last are proven to need, these counterweights need as well
    earlier = values.goals[:-1].tolist()
    against = [least > value + off for (least, off), value in zip(before, earlier, strict=True)]
    mass_bound = None
    if demand.least_mass:
        mass_bound = np.asarray(0.0 if optimum.mass_proof is None else optimum.mass_proof.bound)
    feasible = all(value <= goal.most * (1.0 + 1e-12) for value, goal in zip(earlier, optimum.goals, strict=False))
    return Claim(
        values.goals[-1:],
        # a sum of sizes is not below 0, whatever the rounding of a proof
        np.array([max(bound, lower_bound, 0.0)]),
        np.array([rounding]),
        np.array([size]),
        np.asarray(values.excess if feasible else np.inf),
        np.asarray(np.add.reduce(mass)),
        mass_resolution(optimum.proof.statement, np.array([size])),
        mass_bound,
        optimum.contradicted or any(against),
    )


def _bound(program: Problem, proof: Proof, u: Complex, values: Values) -> tuple[float, float]:
    """The bound that is claimed of counterweights with some values, and the rounding of a value."""
    statement, own = proof.statement, values.rounding
    # what scatters whatever the counterweights is a floor
    charge = proof.charge + _FLOORS * sum(map(abs, statement.floor.tolist()))
    if own is None or program.finite is None or statement.norms is not program.finite.norms:
        own = float(points_at(statement, u).rounding)
    return bound_beside(proof, values.excess), own + charge * _EPS


def bound_beside(proof: Proof, excess: float) -> float:
    """A bound that speaks of all that exceed no ceiling by more than an excess, as a share of its size."""
    if excess <= 0.0:
        return proof.bound
    over = np.full(proof.statement.ceilings.size.shape, excess)
    return proof.bound - float(ceiling_allowance(proof.statement, proof.multipliers, over))


def touched_ceilings(task: Task, goals: Goals, values: Values) -> Iterator[MachineLimit]:
    """Ceilings that are touched, in any case; as often as there are such cases."""
    program = goals.program
    if not values.over.size:
        return
    called = {ceiling.response: ceiling.limit for ceiling, _ in objective_ceilings(task.objective)}
    limits = [*(called[ceiling.name] for ceiling, _ in program.ceilings), *(ceiling.limit for ceiling in goals.limited)]
    caps = np.array([cap for _, cap in (*program.ceilings, *program.limited)])
    for limit, over in zip(limits, values.over * program.sizes + TOUCHED * caps, strict=True):
        if over >= 0.0:
            yield limit
