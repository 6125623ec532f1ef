"""Certified counterweights of one request that asks for the whole turn: bearings, bending, goals in their order."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from optimizer.arrays import Complex, Real
from optimizer.balance_shafts import Fitted, chosen, posed
from optimizer.effects.registry import run
from optimizer.figures import sensitivity
from optimizer.figures.counterweights import masses_and_angles, unbalance
from optimizer.figures.first_order import first_order, smallest_peaks, smallest_proofs
from optimizer.figures.limits import touched_by_mass
from optimizer.figures.proof import implied_max_mass, named, named_excess, physical
from optimizer.figures.turn_prices import prices_over_turn
from optimizer.fixed import beside, fixed_masses
from optimizer.formulate import RESPONSES, given_ceilings
from optimizer.formulate import limited as limited_responses
from optimizer.goals import Case, Goals, goals
from optimizer.limits import TOUCHED
from optimizer.mechanics.whole_turn import WholeTurn
from optimizer.program.certificate import ceiling_allowance
from optimizer.program.cut_proof import Proof
from optimizer.program.cuts import METHOD, Found, Unkept, over_turn
from optimizer.program.deciding import Group, Weighed
from optimizer.program.limits import Limits
from optimizer.program.over_turn import Goal, OverTurn, Values
from optimizer.program.rows import Row, weighted_peak
from optimizer.program.verdict import CONTRADICTED, INFEASIBLE, Claim, Verdict, mass_resolution, verdict
from optimizer.scene import Prepared
from schemas.answers import Certificate, GoalReached
from schemas.infeasibility import Closest, Infeasibility, SmallestPeak
from schemas.limits import MachineLimit, ShadowPrice
from schemas.proof import BoundMultipliers, InfeasibilityMultipliers, Multipliers
from schemas.requests import OptimizeRequest

#: width of the brackets by which the counterweights of an answer are judged, as a share of goals and ceilings
_CLOSE = 1e-10
#: the same where goals are kept whose price may be high
_CLOSER = 1e-12
#: relative gap of the smallest peaks by themselves
_ALONE = 1e-7
#: share of the largest multiplier of a conflict from which on a ceiling takes part in it
_TAKES_PART = 1e-6
#: so many responses of a conflict are looked at by themselves
_MOST_AT_FAULT = 6


@dataclass(frozen=True)
class CertifiedTurn:
    """Counterweights as they are fitted, and the fields of the answer that tell what is proven of them."""

    status: str
    reason: str
    unbalance: Complex | None  # (K,) kg m; None where the ceilings are out of reach
    chosen: Complex | None  # (K + S,) kg m, without the weights that are fixed
    shafts: Complex | None  # (S,) kg m, of the balance shafts; None where there are none to show
    certify_s: float  # time spent on bounds
    fields: dict[str, object]


def certified_turn(request: OptimizeRequest, scene: Prepared) -> CertifiedTurn:
    """Counterweights that are optimal over the whole turn.

    Raises
    ------
    MissingInput
        if bearings lack the sizes that specific loads need.
    """
    together, responses = posed(request), scene.responses
    if request.objective.orders == "all":
        responses = tuple(each.unmirrored() for each in responses)
    case = Case(together, scene.laden, (responses,), whole_turn_of(scene))
    asked = goals(together, [case], scene.omega_squared)
    accuracy, least = request.accuracy, request.objective.least_mass
    found = over_turn(asked.program, accuracy.relative_gap, least, asked.allowances, accuracy.time_limit_s)
    if isinstance(found, Unkept):
        return out_of_reach(request, scene, asked, found)
    return fitted(request, scene, asked, found)


def fitted(request: OptimizeRequest, scene: Prepared, asked: Goals, found: Found) -> CertifiedTurn:
    """What is told of counterweights that were found.

    Parameters
    ----------
    asked : what the counterweights are judged by: the program that was solved, or one with more variants.
    """
    mass, angle = masses_and_angles(posed(request).machine, found.point.unbalance, found.limits)
    return told(request, scene, asked, found, mass, angle)


def told(
    request: OptimizeRequest,
    scene: Prepared,
    asked: Goals,
    found: Found,
    mass: Real,
    angle: Real,
    lower_bound: float = -np.inf,
) -> CertifiedTurn:
    """The same of counterweights with masses [kg] and angles [deg] (K,).

    Parameters
    ----------
    found : whose proof holds for them.
    lower_bound : of all that may be chosen, over omega^2, where more is proven of these.
    """
    machine, square = posed(request).machine, scene.omega_squared
    u = unbalance(mass, angle, found.limits.radius)
    shown = chosen(request, mass, angle)
    there, _ = beside(machine, mass, angle)
    values = asked.program.values(u, _CLOSE if len(asked.program.goals) == 1 else _CLOSER)
    found = found.counting(float(values.goals[-1]))
    judged = _judged(request, asked.program, found, u, values, mass, lower_bound)
    late = found.timed_out and judged.status != "optimal" and judged.reason != CONTRADICTED
    ended = f"The time limit of {request.accuracy.time_limit_s:g} s ended the search. " if late else ""
    touched = tuple(dict.fromkeys((*touched_by_mass(machine, there), *_touched(request, asked, values))))
    gap, several = float(judged.gap[0]), request.robust or request.objective.priorities
    prices: tuple[ShadowPrice, ...] = ()
    if not (several or np.isnan(gap) or machine.web_groups):
        # of a group no web gives way by itself
        prices = prices_over_turn(posed(request), asked, found.proof, u, shown.all_of_them, touched, gap)
    return CertifiedTurn(
        str(judged.status),
        f"{ended}{judged.reason}",
        shown.on_crank,
        u,
        shown.on_shafts,
        found.certify_s,
        {
            **shown.fields,
            "active_limits": touched,
            "shadow_prices": prices,
            "sensitivity": None
            if any(each.response.turning is not None for each in asked.program.quantities)
            else sensitivity.over_turn(asked.program, u, values, square),
            "certificate": _certificate(request, asked, found, judged, values, square),
        },
    )


def whole_turn_of(scene: Prepared) -> WholeTurn:
    """The forces of the rows, if no output has asked for them either."""
    if "whole_turn" not in scene.results:
        needs = ("whole_turn",)
        angle = np.zeros(1)
        found = run(scene.machine, scene.layout, needs, scene.request.fidelity, angle)["whole_turn"]
        assert isinstance(found, WholeTurn)
        return found
    turn: WholeTurn = scene.results["whole_turn"]
    return turn


def _judged(
    request: OptimizeRequest,
    program: OverTurn,
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
        multipliers=Multipliers(objective=_proof(found, square), mass=of_mass),
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


def out_of_reach(request: OptimizeRequest, scene: Prepared, asked: Goals, found: Unkept) -> CertifiedTurn:
    """Which ceilings conflict, what each peak comes to by itself, and the best compromise."""
    mass, angle = masses_and_angles(posed(request).machine, found.closest.unbalance, found.limits)
    return unreachable(request, scene, asked, chosen(request, mass, angle), found.limits, found)


def unreachable(
    request: OptimizeRequest,
    scene: Prepared,
    asked: Goals,
    shown: Fitted,
    within: Limits,
    found: Unkept | None,
) -> CertifiedTurn:
    """The same of what is shown as closest, with the proof by multipliers where there is one."""
    machine, square = posed(request).machine, scene.omega_squared
    alone = asked.program.changed(ceilings=(), limited=())
    groups = {name: Group(rows=rows) for name, rows in _alone(request, asked, square).items()}
    components = [name for name in groups if name not in RESPONSES]
    # of quantities those that the conflict is about
    at_fault = [] if found is None else _at_fault(found)
    limited = {alone.quantities[each.quantity].name: each for each in asked.limited}
    limited = {name: each for name, each in limited.items() if name in at_fault}
    for name in limited:
        of_name = {each.quantity: each for each in asked.limited if alone.quantities[each.quantity].name == name}
        groups[name] = Group(weighed=tuple(Weighed(q, each.omega_squared / square) for q, each in of_name.items()))
    # one reach for all that is proven here
    least = {name: _least(alone, group) for name, group in groups.items()}
    most = np.max([within.max_mass, *(each.limits.max_mass for each in least.values())], axis=0)
    if np.any(most != alone.limits.max_mass):
        alone = alone.changed(limits=replace(alone.limits, max_mass=most))
        least = {name: _least(alone, group) for name, group in groups.items()}
    value = {name: each.goals[0].value * square for name, each in least.items()}
    bound = {name: each.goals[0].lower_bound * square for name, each in least.items()}
    # of all orders the ceilings are among what is limited over the turn
    given = given_ceilings(request.objective) if request.objective.orders == "first" else []
    both = dict.fromkeys(
        (name, each.field, each.ceiling)
        for each in asked.limited
        for name in [alone.quantities[each.quantity].name]
        if name in limited
    )
    peaks = tuple(
        SmallestPeak(
            response=name,
            ceiling_field=field,
            ceiling=ceiling,
            smallest=value[name],
            lower_bound=bound[name],
            multipliers=_proof(least[name], square),
        )
        for name, field, ceiling in (
            *((each.name, each.field, allowed) for each, allowed in given if each.name in components),
            *both,
        )
    )
    exact = {ceiling.name: ceiling.field for ceiling, _ in given}
    impossible = [ceiling.field for ceiling, allowed in given if bound[ceiling.name] > allowed]
    impossible += [each.ceiling_field for each in peaks if each.lower_bound > each.ceiling]
    together = [field for name, field in exact.items() if name in at_fault] + [field for _, field, _ in both]
    closest = first_order(replace(scene, shafts=shown.on_shafts).first_order(shown.on_crank))
    conflict, scenarios = None, tuple[str, ...]()
    if found is not None:
        scales, proof = asked.program.excess_scales(found.proof.cuts), found.proof
        conflict = named_excess(proof.statement, proof.multipliers, scales, square)
        scenarios = _scenarios(asked.program, found)
    fields: dict[str, object] = {
        "counterweights": (),
        "total_mass_kg": None,
        "certificate": None,
        "infeasibility": Infeasibility(
            conflict=tuple(dict.fromkeys(impossible or together or exact.values())),
            **smallest_peaks(value, bound),
            smallest=peaks,
            implied_max_mass_kg=implied_max_mass(machine, most[None])[0],
            scenarios=scenarios,
            closest=Closest(
                counterweights=shown.counterweights, balance_shafts=shown.balance_shafts, first_order=closest
            ),
            multipliers=InfeasibilityMultipliers(
                conflict=conflict,
                **smallest_proofs({name: _proof(least[name], square) for name in RESPONSES}),
            ),
        ),
    }
    spent = (0.0 if found is None else found.certify_s) + sum(each.certify_s for each in least.values())
    return CertifiedTurn("infeasible", INFEASIBLE, None, None, None, spent, fields)


def _alone(request: OptimizeRequest, asked: Goals, omega_squared: float) -> dict[str, tuple[Row, ...]]:
    """Peaks of the first order, and components with a ceiling, by themselves: the largest of all cases."""
    rows: dict[str, list[Row]] = {}
    for case in asked.cases:
        for responses in case.variants:
            limited = limited_responses(responses, request.objective) if request.objective.orders == "first" else ()
            components = [each for each, _ in limited if each.name not in RESPONSES]
            for each in (*responses, *components):
                of_name = rows.setdefault(each.name, [])
                name = f"{each.name} {len(of_name)}" if of_name else each.name
                of_name.append(Row(name, (weighted_peak(each, case.omega_squared / omega_squared),)))
    return {name: tuple(each) for name, each in rows.items()}


def _scenarios(program: OverTurn, found: Unkept) -> tuple[str, ...]:
    """Scenarios whose ceilings are out of reach by themselves, or those whose ceilings conflict with one another."""
    statement, row = found.proof.statement, np.maximum(found.proof.multipliers.row, 0.0)
    leant = row[statement.row] > _TAKES_PART * np.sum(row)
    terms = zip(statement.names.terms, leant.tolist(), strict=True)
    names = tuple(dict.fromkeys(term.scenario for term, counts in terms if counts and term.scenario is not None))
    if len(names) < 2:
        return names
    return tuple(name for name in names if isinstance(_under(program, name), Unkept)) or names


def _under(program: OverTurn, scenario: str) -> Found | Unkept:
    """The program under the ceilings of one scenario alone, as far as whether they can be kept."""
    ceilings = tuple(each for each in program.ceilings if each[0].scenario == scenario)
    limited = tuple(each for each in program.limited if program.quantities[each[0]].scenario == scenario)
    return over_turn(program.changed(goals=program.goals[-1:], ceilings=ceilings, limited=limited), 1.0, False, ())


def _at_fault(found: Unkept) -> list[str]:
    """Responses whose ceilings conflict, those first that the proof leans on most."""
    statement, row = found.proof.statement, np.maximum(found.proof.multipliers.row, 0.0)
    share: dict[str, float] = {}
    for term, owner in zip(statement.names.terms, statement.row.tolist(), strict=True):
        share[term.response] = share.get(term.response, 0.0) + float(row[owner] / np.sum(row))
    leant = [name for name, part in share.items() if part > _TAKES_PART]
    return sorted(leant, key=lambda name: -share[name])[:_MOST_AT_FAULT]


def _least(program: OverTurn, group: Group) -> Found:
    """The smallest value of one group."""
    found = over_turn(program.changed(goals=(Goal("alone", (group,)),)), _ALONE, False, ())
    assert isinstance(found, Found)  # without ceilings nothing is out of reach
    return found


def _proof(found: Found, omega_squared: float) -> BoundMultipliers:
    proof = found.proof
    return named(proof.statement, physical(proof.statement, proof.multipliers, "objective", omega_squared))
