"""Certified counterweights of one request that asks for the whole turn: bearings, bending, goals in their order."""

from collections.abc import Iterator

import numpy as np

from optimizer.formulation.balance_shafts import chosen, posed
from optimizer.formulation.counterweights import masses_and_angles, unbalance
from optimizer.formulation.formulate import given_ceilings
from optimizer.formulation.goals import Case, Goals, formulate
from optimizer.formulation.limits import TOUCHED
from optimizer.formulation.simulation import Prepared
from optimizer.mechanics.fixed_weights import beside, fixed_masses
from optimizer.mechanics.whole_turn import WholeTurn
from optimizer.numerics.arrays import Complex, Real
from optimizer.program.certificate import ceiling_allowance
from optimizer.program.cuts.optimum import METHOD, Found, Unkept, over_turn
from optimizer.program.cuts.proof import Proof
from optimizer.program.cuts.semi_infinite import Problem, Values
from optimizer.program.verdict import CONTRADICTED, Claim, Verdict, mass_resolution, verdict
from optimizer.solve import sensitivity
from optimizer.solve.infeasibility import out_of_reach
from optimizer.solve.outcome import Outcome, multipliers_of
from optimizer.solve.prices import touched_by_mass
from optimizer.solve.proof import implied_max_mass, named, physical
from optimizer.solve.turn_prices import prices_over_turn
from schemas.answer.answers import Certificate, GoalReached
from schemas.answer.limits import MachineLimit, ShadowPrice
from schemas.answer.proof import Multipliers
from schemas.request.requests import OptimizeRequest

#: width of the brackets by which the counterweights of an answer are judged, as a share of goals and ceilings
_CLOSE = 1e-10
#: the same where goals are kept whose price may be high
_CLOSER = 1e-12


def certified_turn(request: OptimizeRequest, scene: Prepared, in_full: bool = True) -> Outcome:
    """Counterweights that are optimal over the whole turn.

    Parameters
    ----------
    in_full : with prices of the limits and what misplaced counterweights may cost.

    Raises
    ------
    MissingInput
        if bearings lack the sizes that specific loads need.
    """
    together, responses = posed(request), scene.responses
    if request.objective.orders == "all":
        responses = tuple(each.unmirrored() for each in responses)
    machine, square = together.machine, scene.omega_squared
    case = Case(machine, square, (responses,), (whole_turn_of(scene), scene.laden))
    asked = formulate(machine, together.objective, [case], square, request.fidelity)
    accuracy, least = request.accuracy, request.objective.least_mass
    found = over_turn(asked.program, accuracy.relative_gap, least, asked.allowances, accuracy.time_limit_s)
    if isinstance(found, Unkept):
        return out_of_reach(request, scene, asked, found)
    return fitted(request, scene, asked, found, in_full)


def fitted(request: OptimizeRequest, scene: Prepared, asked: Goals, found: Found, in_full: bool = True) -> Outcome:
    """What is told of counterweights that were found.

    Parameters
    ----------
    asked : what the counterweights are judged by: the program that was solved, or one with more variants.
    in_full : with prices of the limits and what misplaced counterweights may cost.
    """
    mass, angle = masses_and_angles(posed(request).machine, found.point.unbalance, found.limits)
    return told(request, scene, asked, found, mass, angle, in_full=in_full)


def told(
    request: OptimizeRequest,
    scene: Prepared,
    asked: Goals,
    found: Found,
    mass: Real,
    angle: Real,
    of_choices: float | None = None,
    in_full: bool = True,
) -> Outcome:
    """The same of counterweights with masses [kg] and angles [deg] (K,).

    Parameters
    ----------
    found : whose proof holds for them.
    of_choices : lower bound of all that may be chosen, over omega^2; None where any mass at any angle may be.
    in_full : with prices of the limits and what misplaced counterweights may cost.
    """
    machine, square = posed(request).machine, scene.omega_squared
    u = unbalance(mass, angle, found.limits.radius)
    shown = chosen(request, mass, angle)
    there, _ = beside(machine, mass, angle)
    values = asked.program.values(u, _CLOSE if len(asked.program.goals) == 1 else _CLOSER)
    found = found.counting(float(values.goals[-1]))
    judged = _judged(request, asked.program, found, u, values, mass, -np.inf if of_choices is None else of_choices)
    late = found.timed_out and judged.status != "optimal" and judged.reason != CONTRADICTED
    ended = f"The time limit of {request.accuracy.time_limit_s:g} s ended the search. " if late else ""
    touched = tuple(dict.fromkeys((*touched_by_mass(machine, there), *_touched(request, asked, values))))
    gap, several = float(judged.gap[0]), request.robust or request.objective.priorities
    prices: tuple[ShadowPrice, ...] = ()
    if in_full and of_choices is None and not (several or np.isnan(gap) or machine.web_groups):
        # of a group no web gives way by itself, and no choice gives way at all
        prices = prices_over_turn(posed(request), asked, found.proof, u, shown.all_of_them, touched, gap)
    return Outcome(
        str(judged.status),
        f"{ended}{judged.reason}",
        shown.on_crank,
        u,
        shown.on_shafts,
        found.certify_s,
        METHOD,
        0,
        {
            **shown.fields,
            "active_limits": touched,
            "shadow_prices": prices,
            "sensitivity": None
            if not in_full or any(each.response.turning is not None for each in asked.program.quantities)
            else sensitivity.over_turn(asked.program, u, values, square),
            "certificate": _certificate(request, asked, found, judged, values, square),
        },
    )


def whole_turn_of(scene: Prepared) -> WholeTurn:
    """The forces of the rows over the turn."""
    turn: WholeTurn = scene.simulated.result("whole_turn", "objective")
    return turn


def _judged(
    request: OptimizeRequest,
    program: Problem,
    found: Found,
    u: Complex,
    values: Values,
    mass: Real,
    lower_bound: float,
) -> Verdict:
    """What may be said of the counterweights as they are fitted."""
    size = float(program.yardsticks[-1])
    *before, (bound, rounding) = (_bound(goal.proof, u, values.excess) for goal in found.goals)
    # what goals before the last are proven to need, these counterweights need as well
    against = [least > value + known for (least, known), value in zip(before, values.goals[:-1], strict=True)]
    mass_bound = None
    if request.objective.least_mass:
        mass_bound = np.asarray(0.0 if found.mass_proof is None else found.mass_proof.bound)
    kept = all(value <= goal.most * (1.0 + 1e-12) for value, goal in zip(values.goals[:-1], found.goals, strict=False))
    claimed = Claim(
        values.goals[-1:],
        # a sum of sizes is not below 0, whatever the rounding of a proof
        np.array([max(bound, lower_bound, 0.0)]),
        np.array([rounding]),
        np.array([size]),
        np.asarray(values.excess if kept else np.inf),
        np.asarray(np.sum(mass)),
        mass_resolution(found.proof.statement, np.array([size])),
        mass_bound,
        found.contradicted or any(against),
    )
    return verdict(claimed, request.accuracy.relative_gap)


def _bound(proof: Proof, u: Complex, excess: float) -> tuple[float, float]:
    """A bound that speaks of all that exceed no ceiling by more than counterweights do, and the rounding of a value."""
    statement = proof.statement
    over = np.full(statement.ceilings.size.shape, max(excess, 0.0))
    allowance = float(ceiling_allowance(statement, proof.multipliers, over))
    return proof.bound - allowance, float(statement.rounding(u)) + proof.charge * np.finfo(float).eps


def _certificate(
    request: OptimizeRequest, asked: Goals, found: Found, judged: Verdict, values: Values, square: float
) -> Certificate:
    program, least = asked.program, request.objective.least_mass
    fixed, of_mass = np.sum(fixed_masses(request.machine)), None
    if found.mass_proof is not None:
        proof = found.mass_proof
        of_mass = named(proof.statement, physical(proof.statement, proof.multipliers, "mass", square))
    return Certificate(
        objective=float(values.goals[-1]) * square,
        lower_bound=_or_null(judged.lower_bound[0] * square),
        gap=_or_null(judged.gap[0] * square),
        relative_gap=_or_null(judged.relative_gap),
        yardstick=float(program.yardsticks[-1]) * square,
        objective_without_counterweights=float(program.at_rest.goals[-1]) * square,
        mass_lower_bound_kg=_or_null(judged.mass_lower_bound + fixed) if least else None,
        mass_relative_gap=_or_null(judged.mass_gap) if least else None,
        mass_yardstick_kg=_or_null(judged.mass_yardstick) if least else None,
        mass_objective_limit=_or_null(found.mass_target * square) if least else None,
        implied_max_mass_kg=implied_max_mass(posed(request).machine, found.limits.max_mass[None])[0],
        method=METHOD,
        cuts=found.cuts,
        rounds=found.rounds,
        goals=tuple(
            GoalReached(
                goal=goal.goal,
                value=goal.value * square,
                lower_bound=None if judged.reason == CONTRADICTED else _or_null(goal.lower_bound * square),
                limit=goal.most * square,
            )
            for goal in found.goals[:-1]
        ),
        multipliers=Multipliers(objective=multipliers_of(found, square), mass=of_mass),
    )


def _or_null(value: Real | float) -> float | None:
    return float(value) if np.isfinite(value) else None


def _touched(request: OptimizeRequest, asked: Goals, values: Values) -> Iterator[MachineLimit]:
    """Ceilings that are touched, in any case."""
    program = asked.program
    called = {each.name: each.limit for each, _ in given_ceilings(request.objective)}
    limits = [*(called[each.name] for each, _ in program.ceilings), *(each.limit for each in asked.limited)]
    caps = np.array([cap for _, cap in (*program.ceilings, *program.limited)])
    for limit, over in zip(limits, values.over * program.sizes + TOUCHED * caps, strict=True):
        if over >= 0.0:
            yield limit
