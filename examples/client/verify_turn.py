"""Goals over the whole turn: what their cuts prove.

Of bearing loads, bending moments, and force and moment of all orders, the multipliers prove a bound by cuts. Each is
the response at one shaft angle, which is evaluated here from rods and masses. Gas and friction where loads count, roll
and balance shafts are not covered.
"""

from __future__ import annotations

from functools import partial

from verify_answer import Fitted, closest, fitted
from verify_cases import FIELDS as CASES
from verify_cases import scenarios, without_cases
from verify_claims import EVIDENCE, Claims, covered, near
from verify_conflict import conflict
from verify_costs import costs
from verify_cuts import FIELDS, SHAFTS
from verify_first import excess, implied_alone, light, near_the_bound, priced_at, searched, smallest
from verify_first import proven as exactly
from verify_goals import Program as Asked
from verify_goals import cheaper, values
from verify_machine import ENTRY_FIELDS, NAMES, NOTHING, Machine
from verify_misplacement import misplacement
from verify_multipliers import Program, by_cuts
from verify_numbers import ONE, SPECK, Place, largest, real
from verify_program import CEILINGS
from verify_smallest import SmallestPeaks

#: ceilings of loads over the turn
LOADED = ("bearing_ceiling_N", "specific_load_ceiling_Pa", "bending_ceiling_Nm")


def looks_at_the_turn(request: Place) -> bool:
    """Whether an objective asks for more than the first order, in a way that is known here."""
    goal = request / "objective"
    loads = any((goal / name).value not in (None, 0) for name in FIELDS.split()[1:])
    several = scenarios(request) or request / "tolerances" or list(goal / "priorities")
    shafts = list(request / "machine" / "balance_shafts")
    return loads or (goal / "orders").value == "all" or bool(several) or bool(shafts)


def over_turn(request: Place, answer: Place, machine: Machine, fitted: Fitted) -> Claims:
    """The proof of the answer to one request whose objective looks at the whole turn."""
    request.require_coverage(f"{FIELDS}{CASES}{SHAFTS}{ENTRY_FIELDS}")
    design, proof = request / "machine", answer / "certificate"
    program = Program(request, machine, answer)
    objective, lowest, implied = proof / "objective", proof / "lower_bound", proof / "implied_max_mass_kg"
    is_choice = yield from searched(design, answer, proof)
    of_any_mass = proof / "continuous_lower_bound" if is_choice else lowest
    multipliers, value = proof / "multipliers", objective.number(0.0)
    noise = SPECK * (abs(value) + abs(lowest.number(0.0)))
    # not below what is there at the angles of the cuts
    terms = program.terms(multipliers / "objective")
    reached = program.reached(terms, fitted)
    yield "cuts", proof, value + noise + real(NOTHING) - reached if objective else None, largest(value, reached)
    of_objective = multipliers / "objective"
    bound = program.bound(of_objective, terms, implied)
    yield from by_cuts("lower_bound", of_any_mass, bound, implied, of_objective, mixed=program.mixed)
    slopes = program.slopes
    yield from _earlier(program, proof, implied)
    least, limit = proof / "mass_lower_bound_kg", (proof / "mass_objective_limit").number(0.0)
    if least:
        yield "mass_lower_bound", proof / "mass_objective_limit", limit + noise - value, abs(value)
    if least and (least.number() - machine.fixed).low <= 0:
        yield "mass_lower_bound", least, machine.fixed - least.number(), ONE
        yield EVIDENCE, multipliers / "mass", None, ONE
    elif least and multipliers / "mass":
        of_mass = multipliers / "mass"
        bound = program.bound(of_mass, program.terms(of_mass), implied, ONE, limit)
        yield from by_cuts("mass_lower_bound", least, bound, implied, of_mass, machine.fixed, program.mixed)
    size, mass, first = proof / "mass_yardstick_kg", fitted.mass + fitted.on_shafts_mass, program.first
    if size and abs(size.number() - mass).low <= (mass * SPECK).high:
        yield near("yardstick", size, mass)
    elif not (first.over_turn or first.geared or first.exact.caps or len(program.parts) > 1):
        rows = dict.fromkeys(first.statements[0].rows, (proof / "yardstick").number(0.0))
        yield from light(first.statements[0], proof, rows, fitted.mass)
    goals_of = Asked([*program.parts.values()], program.goal_names, program.off, machine, program.rows)
    yield from covered(values(request, answer, goals_of, fitted))
    yield from covered(cheaper(request, answer, goals_of, fitted))
    yield from covered(_nominal(request, machine, answer))
    if slopes:
        yield from covered(costs(request, answer, machine, program.first, terms, slopes))
    yield from covered(misplacement(goals_of.parts, program.goal_names[-1], fitted, answer / "sensitivity"))


def _earlier(program: Program, proof: Place, implied: Place) -> Claims:
    """Bounds of the goals before the last: each by its own multipliers, under the limits of those before it."""
    earlier_goals = [goal for goal in proof / "goals" if (goal / "goal").text() in program.goal_names[:-1]]
    for n, goal in enumerate(earlier_goals):
        if not goal / "lower_bound":
            continue
        if not goal / "multipliers":
            yield "goals", goal / "lower_bound", None, ONE
            continue
        so_far = program.up_to(n)
        bound = so_far.bound(goal / "multipliers", so_far.terms(goal / "multipliers"), implied)
        yield from by_cuts("goals", goal / "lower_bound", bound, implied, goal / "multipliers", mixed=program.mixed)


def _nominal(request: Place, machine: Machine, answer: Place) -> Claims:
    """The bound of the unchanged machine, nothing off, by multipliers of its own."""
    price = answer / "price_of_robustness"
    if not price / "nominal_multipliers":
        return
    program, proof = Program(without_cases(request), machine, Place(None)), price / "nominal_multipliers"
    lowest, first, implied = price / "nominal_lower_bound", program.first, price / "nominal_implied_max_mass_kg"
    if not (first.over_turn or first.geared):
        # of the first order alone: what webs without limits gain by rounding is taken off exactly
        priced = partial(priced_at, dict.fromkeys(first.exact.rows, lowest.number()))
        there = yield from fitted(request, machine, price / "nominal_counterweights", price / "nominal_balance_shafts")
        over = excess(first.exact, there.turning)
        yield from exactly("nominal_optimum", lowest, first.exact, proof, implied, over, priced)
        return
    bound = program.bound(proof, program.terms(proof), implied)
    yield from by_cuts("nominal_optimum", lowest, bound, implied, proof)


def unreachable(request: Place, answer: Place, budget: Place, verdict: Place) -> Claims:
    """No counterweights keep the ceilings, at the angles of the cuts."""
    request.require_coverage(f"{FIELDS}{CASES}{SHAFTS}{ENTRY_FIELDS}")
    goal, proofs, implied = request / "objective", verdict / "multipliers", verdict / "implied_max_mass_kg"
    machine = Machine(request / "machine", goal, answer / "reference_plane_m", budget)
    limits = [field for field in (*CEILINGS.values(), *LOADED) if goal / field]
    names = [item.text() for item in verdict / "conflict"]
    yield from (("conflict", item, ONE if item.value in limits else -ONE, ONE) for item in verdict / "conflict")
    if not names or len({*names}) < len(names):
        yield "conflict", verdict / "conflict", -ONE, ONE
    program = Program(request, machine, Place(None))
    yield from conflict(program, verdict)
    yield from closest(request, machine, verdict / "closest")
    first = program.first
    of_cases = len(program.parts) > 1 or bool(program.scattered or program.mixed or first.all or first.geared)
    yield from SmallestPeaks(request, machine, verdict).claims(of_cases)
    if not of_cases:
        # a scenario alone is a machine of its own
        machine = program.first.machine
        yield from smallest(machine, Place({}), verdict, proofs, implied)
        for name, unit in NAMES.items():
            lowest, attained = (verdict / f"smallest_{name}{part}_{unit}" for part in ("_lower_bound", ""))
            if lowest and attained:
                yield from near_the_bound(
                    f"smallest_{name}", attained, lowest, machine, name, implied_alone(verdict, name, implied)
                )
