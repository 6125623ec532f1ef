"""The first order: what multipliers prove of its peaks, that ceilings are kept, or that they cannot be."""

from __future__ import annotations

from functools import partial
from typing import Callable, Iterator, Sequence

from verify_alternatives import alternatives
from verify_answer import Fitted, closest
from verify_claims import EVIDENCE, Claim, Claims, near, same
from verify_machine import ENTRY_FIELDS, NAMES, Machine, Mass, Responses
from verify_numbers import (
    ABOUT_ONE,
    ONE,
    SPECK,
    STEP,
    ZERO,
    NotCovered,
    Number,
    Place,
    largest,
    real,
    total,
)
from verify_prices import prices, sensitivity
from verify_program import CEILINGS, Statement, phasors, weighed
from verify_shafts import Geared
from verify_weights import catalogue, heavy_enough, stocked

CEILING = 1e-9  # of the larger of a ceiling and what is there without counterweights, likewise
SMALLEST = 1e-5  # of what is there before: by which what is smallest may be above its bound
#: how choices are searched
SEARCHES = ("exhaustion in halves", "branch and bound")
MASS_SHARE = 1e-5  # of the least mass that could cancel something: masses below are not told apart any finer


def proven(
    claim: str,
    place: Place,
    statement: Statement,
    proof: Place,
    implied: Place,
    slack: dict[str, Number],
    price: Callable[[dict[str, Number]], Number],
    cost: Number = ZERO,
) -> Iterator[Claim]:
    """What is said, by what its rows are multiplied with, is no more than multipliers prove."""
    for believed in (False, True):
        bound = statement.bound(proof, implied, slack, cost, believed)
        value = price(bound.rows)
        room = bound.least - value if place and proof and bound.least is not None else None
        if room is not None and room.high >= 0:
            break
    if believed and room is not None and room.high >= 0:
        yield "reach", implied, None, ONE
    yield claim, place, room, largest(abs(value), abs(bound.least or ZERO))
    if room is not None:
        yield EVIDENCE, proof, None, ONE
        yield EVIDENCE, implied, None, ONE


def priced_at(values: dict[str, Number], rows: dict[str, Number], least: Number = ZERO) -> Number:
    """Rows of these values, and a mass."""
    return least + total(row * values[name] for name, row in rows.items())


def ceilings(statement: Statement, weights: Sequence[Mass], place: Place, feasible: bool) -> Claims:
    """``feasible``: whether the answer says that they are; returns by how much they are exceeded."""
    over = excess(statement, weights)
    for name, size in statement.sizes.items():
        room = size * real(CEILING) - over[name]
        yield "ceilings", place, room if feasible or room.high >= 0 else None, size
    return over


def excess(statement: Statement, weights: Sequence[Mass]) -> dict[str, Number]:
    """By how much counterweights exceed the ceilings."""
    after = statement.machine.responses(weights)
    return {name: largest(abs(phasors(after, name)[0]) - cap, ZERO) for name, cap in statement.caps.items()}


def optimum(request: Place, answer: Place, machine: Machine, fitted: Fitted) -> Claims:
    """The proof of the answer to one request, with its counterweights."""
    request.require_coverage(ENTRY_FIELDS)
    design, goal, proof = request / "machine", request / "objective", answer / "certificate"
    if (goal / "orders").text("first", "all", default="first") == "all":
        raise NotCovered(goal / "orders")
    weights = {name: weight for name, weight in weighed(goal, machine).items() if weight.high > 0}
    together = (goal / "combine").text("sum", "max", default="sum") == "sum"
    rows = {"sum": weights} if together else {name: {name: weight} for name, weight in weights.items()}
    statement = Statement(machine, goal, rows)
    optimal = (answer / "status").text() == "optimal"
    over = yield from ceilings(statement, fitted.turning, answer / "counterweights", optimal)
    after = machine.responses(fitted.turning)
    value, rest = (largest(ZERO, *statement.values(responses).values()) for responses in (after, machine.laden))
    objective, lowest, implied = proof / "objective", proof / "lower_bound", proof / "implied_max_mass_kg"
    is_choice = yield from searched(design, answer, proof)
    lowest = proof / "continuous_lower_bound" if is_choice else lowest
    yield near("objective", objective, value)
    yield near("before", proof / "objective_without_counterweights", rest)
    # nothing that exceeds no ceiling by more is better; any masses beside a choice keep them
    slack = {} if is_choice else over
    multipliers, priced = proof / "multipliers", partial(priced_at, dict.fromkeys(rows, lowest.number(0.0)))
    yield from proven("lower_bound", lowest, statement, multipliers / "objective", implied, slack, priced)
    if proof / "yardstick":
        yield yardstick(statement, proof / "yardstick", rest, implied)
    asks_least = (goal / "least_mass").read((bool,), "true or false", True)
    if asks_least and not is_choice:
        size = (proof / "yardstick").number(0.0)
        most = dict.fromkeys(rows, (proof / "mass_objective_limit").number(0.0))
        yield from lightest(statement, proof, multipliers, most, after, fitted.mass)
        yield from light(statement, proof, dict.fromkeys(rows, size), fitted.mass)
    yield from sensitivity(statement, fitted.turning, answer / "sensitivity")
    yield from alternatives(request, answer, machine, statement)
    yield from prices(statement, request, answer, fitted, is_choice)


def searched(design: Place, answer: Place, proof: Place) -> Claims:
    """Returns whether counterweights are chosen by a search; the tree or the comparison behind it is not repeated."""
    shafts = [(design, answer), *zip(design / "balance_shafts", answer / "balance_shafts")]
    for shaft, there in shafts:
        yield from heavy_enough(shaft, there / "counterweights")
    webs = (web for shaft, _ in shafts for web in shaft / "webs")
    stock = (design / "catalogue") or (design / "max_counterweights") or any(map(stocked, webs))
    if stock:
        yield from catalogue(design, answer)
    # of rows of a sweep the method alone tells it, where it is a column
    least = any((web / "min_fitted_mass_kg").value for shaft, _ in shafts for web in shaft / "webs")
    by_method = (proof / "method").value in SEARCHES or (least and not proof / "method")
    is_choice = bool(stock or proof / "continuous_lower_bound" or by_method)
    if is_choice:
        yield "lower_bound", proof / "lower_bound", None, ONE
    return is_choice


def lightest(
    statement: Statement, proof: Place, multipliers: Place, most: dict[str, Number], after: Responses, mass: Number
) -> Claims:
    """Nothing with rows up to these, which the answer keeps, and that counts as keeping the ceilings is lighter."""
    place, implied = proof / "mass_lower_bound_kg", proof / "implied_max_mass_kg"
    slack = {name: size * real(CEILING) for name, size in statement.sizes.items()}
    least = place.number(0.0) - statement.machine.fixed
    if least.low <= 0:
        yield "mass_lower_bound", place, -least if place else None, ONE
        yield EVIDENCE, multipliers / "mass", None, ONE
    else:
        priced = partial(priced_at, most, least=least)
        yield from proven("mass_lower_bound", place, statement, multipliers / "mass", implied, slack, priced, ONE)
    for name, value in statement.values(after).items():
        for field in ("mass_objective_limit", f"mass_{name}_limit_{NAMES.get(name)}"):
            if proof / field:
                yield "mass_lower_bound", proof / field, most[name] - value, abs(value)


def light(statement: Statement, proof: Place, sizes: dict[str, Number], mass: Number) -> Claims:
    """The yardstick of the mass: the mass, or what makes no difference to rows of these sizes."""
    least, place = proof / "mass_lower_bound_kg", proof / "mass_yardstick_kg"
    size = place.number(0.0)
    if least and place:
        rows = {name: {name: ONE} for name in statement.caps}
        limited = Statement(statement.machine, Place({}), rows, False, statement.geared)

        def most(implied: Place) -> Number:
            cancelling = statement.lightest(sizes, implied), limited.lightest(statement.sizes, implied)
            every = [number for number in cancelling if number is not None]
            counts = min(every, key=lambda number: number.high, default=ZERO)
            return largest(mass - statement.machine.fixed, counts * real(MASS_SHARE)) * ABOUT_ONE

        left = most(Place(None)) - size
        # what is cut from a plate has another radius than all that could be; and webs may be implied to carry nothing
        cut = any(web.plate for web in statement.machine.webs)
        unknown = left.high < 0 and (cut or (most(proof / "implied_max_mass_kg") - size).high >= 0)
        yield "yardstick", place, None if unknown else left, size


def yardstick(statement: Statement, place: Place, rest: Number, implied: Place) -> Claim:
    """The objective without counterweights, or where it is 0 to rounding at most what they could make it.

    That is by the limits that are given, also where none of what they allow can be of use.
    """
    if rest.low > 0:
        return near("yardstick", place, rest)
    most = statement.reachable(Place(None)) or statement.reachable(implied)
    if most is None:
        return "yardstick", place, None, ONE
    # what rounding leaves of a machine that is balanced may be told as it is
    most = largest(most, rest)
    return "yardstick", place, most * ABOUT_ONE - place.number(), most


def infeasible(request: Place, answer: Place, budget: Place, verdict: Place) -> Claims:
    """No counterweights within the limits keep the ceilings, and what can be reached without them."""
    request.require_coverage(ENTRY_FIELDS)
    goal, proofs, implied = request / "objective", verdict / "multipliers", verdict / "implied_max_mass_kg"
    plain = Machine(request / "machine", goal, answer / "reference_plane_m", budget)
    exact = Machine(request / "machine", goal, answer / "reference_plane_m", budget, exact=True)
    statement = Statement(exact, goal, {})
    limits = {CEILINGS[name]: name for name in statement.caps}
    names = [item.text() for item in verdict / "conflict"]
    yield from (("conflict", item, ONE if item.value in limits else -ONE, ONE) for item in verdict / "conflict")
    if len({*names}) < len(names):
        yield "conflict", verdict / "conflict", -ONE, ONE
    if proofs / "conflict" and names:
        # strictly above 0: what is at most 0 proves nothing
        yield from proven("conflict", proofs / "conflict", statement, proofs / "conflict", implied, {}, lambda _: STEP)
    else:
        # that there are none without a proof is nothing that is covered
        yield "conflict", verdict / "conflict", None if names else -ONE, ONE
    yield from smallest(plain, Place({}), verdict, proofs, implied)
    for name, unit in NAMES.items():
        lowest, attained = (verdict / f"smallest_{name}{part}_{unit}" for part in ("_lower_bound", ""))
        if lowest and attained:
            yield from near_the_bound(
                f"smallest_{name}", attained, lowest, plain, name, implied_alone(verdict, name, implied)
            )
        if lowest and f"{name}_ceiling_{unit}" in names and len(names) < len(limits):
            # this ceiling alone is out of reach
            yield "conflict", lowest, lowest.number() - (goal / f"{name}_ceiling_{unit}").number(), lowest.number()
    for item in verdict / "smallest":
        name, lowest = (item / "response").text(*CEILINGS), item / "lower_bound"
        if CEILINGS[name] not in limits:
            yield "smallest", item / "response", -ONE, ONE
            continue
        yield from component(goal, plain, verdict, item)
        if CEILINGS[name] in names and len(names) < len(limits):
            yield "conflict", lowest, lowest.number() - (goal / CEILINGS[name]).number(), lowest.number()
    yield from closest(request, plain, verdict / "closest")


def component(goal: Place, machine: Machine, verdict: Place, item: Place) -> Claims:
    """What a response or its component, which has a ceiling, comes to at least by itself."""
    name, lowest = (item / "response").text(*CEILINGS), item / "lower_bound"
    implied = implied_alone(verdict, name, verdict / "implied_max_mass_kg")
    alone, priced = Statement(machine, Place({}), {name: {name: ONE}}), partial(priced_at, {name: lowest.number()})
    yield from proven("smallest", lowest, alone, item / "multipliers", implied, {}, priced)
    yield "smallest", item / "response", ONE, ONE
    yield same("smallest", item / "ceiling_field", CEILINGS[name])
    yield near("smallest", item / "ceiling", (goal / CEILINGS[name]).number(0.0))
    yield from near_the_bound("smallest", item / "smallest", lowest, machine, name, implied)


def near_the_bound(claim: str, attained: Place, lowest: Place, machine: Machine, name: str, implied: Place) -> Claims:
    """What is smallest is no less than its bound, and above it by no more than a share of what is there before.

    Where rounding of what the limits allow is more than that share, nothing is told.
    """
    of = name.partition(":")[0]
    co, counter = machine.laden[of]
    above = attained.number() - lowest.number()
    size, noise = abs(co) + abs(counter), SPECK * abs(attained.number())
    yield claim, attained, above + noise, abs(attained.number())
    room = size * real(SMALLEST) + noise - above
    if room.high < 0:
        most = Statement(machine, Place({}), {name: {name: ONE}}).reachable(implied)
        lost = most is None or (above - SPECK * most).low <= 0
        yield claim, attained, None if lost else room, size
    else:
        yield claim, attained, room, size


def implied_alone(verdict: Place, response: str, together: Place) -> Place:
    """Largest masses that the bound on a peak alone counts with."""
    own = verdict / "smallest_implied_max_mass_kg" / response
    return own if own else together


def smallest(
    machine: Machine, goal: Place, verdict: Place, proofs: Place, implied: Place, geared: Sequence[Geared] = ()
) -> Claims:
    """Bounds on either peak alone, under the ceilings of a goal. ``geared``: places on balance shafts."""
    for name, unit in NAMES.items():
        lowest = verdict / f"smallest_{name}_lower_bound_{unit}"
        priced = partial(priced_at, {name: lowest.number(0.0)})
        alone = Statement(machine, goal, {name: {name: ONE}}, geared=geared)
        limits = implied_alone(verdict, name, implied)
        yield from proven(f"smallest_{name}", lowest, alone, proofs / f"smallest_{name}", limits, {}, priced)
