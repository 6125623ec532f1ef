"""Checks the answer to one request of optimize against that request, from the two files alone.

    python verify.py request.json answer.json

The standard library, Python 3.8 or newer; nothing of the service is imported. Beside this file have to lie
verify_numbers.py, which reads the files into numbers that enclose every quotient, square root, sine and cosine,
verify_machine.py and verify_program.py, which evaluate machine, limits, values and bounds anew, verify_claims.py and
verify_weights.py. verify_many.py does the same for fronts and sweeps. What is claimed, by which formulas and to which
tolerance is in docs/verify.md. Exit code 0: nothing is broken, 1: something is, 2: the files cannot be read.
"""

from __future__ import annotations

import sys
from functools import partial
from typing import Any, Callable, Iterator, Sequence

from verify_claims import Claim, Claims, covered, judged, main, near
from verify_machine import NAMES, Machine, Mass, Responses
from verify_numbers import (
    ABOUT_ONE,
    BLUR,
    ONE,
    SPECK,
    STEP,
    ZERO,
    NotCovered,
    Number,
    Place,
    direction,
    largest,
    real,
    total,
)
from verify_program import CEILINGS, Statement, phasors
from verify_weights import catalogue, counterweights, heavy_enough, stocked, usual_gap

CEILING = 1e-9  # of the larger of a ceiling and what is there without counterweights, likewise
MASS_GAP = 1e-4  # largest mass_relative_gap of an optimal answer
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
        said = price(bound.rows)
        room = bound.least - said if place and proof and bound.least is not None else None
        if room is not None and room.high >= 0:
            break
    if believed and room is not None and room.high >= 0:
        yield "reach", implied, None, ONE
    yield claim, place, room, largest(abs(said), abs(bound.least or ZERO))


def priced_at(values: dict[str, Number], rows: dict[str, Number], least: Number = ZERO) -> Number:
    """Rows of these values, and a mass."""
    return least + total(row * values[name] for name, row in rows.items())


_FIGURES: dict[str, Callable[[Number, Number], Number]] = {
    "peak": lambda co, counter: abs(co) + abs(counter),
    "minor": lambda co, counter: abs(abs(co) - abs(counter)),
    "peak_x": lambda co, counter: abs(co + counter.conjugate()),
    "peak_y": lambda co, counter: abs(co - counter.conjugate()),
    "co_rotating": lambda co, counter: abs(co),
    "counter_rotating": lambda co, counter: abs(counter),
}


def first_order(claim: str, place: Place, responses: Responses) -> Claims:
    for name, pair in responses.items():
        for figure, evaluate in _FIGURES.items():
            said = place / name / f"{figure}_{NAMES[name]}"
            if said:
                yield near(claim, said, evaluate(*pair))
        axis, product = place / name / "major_axis_deg", pair[0] * pair[1]
        if axis:
            # along e^{ja} both phasors point the same way: their product is along e^{2ja}
            way = direction(axis.double()) + BLUR
            yield claim, axis, -abs(product - way * way * abs(product)), abs(product)


def ceilings(statement: Statement, weights: Sequence[Mass], place: Place, kept: bool) -> Claims:
    """``kept``: whether the answer says that they are; returns by how much they are exceeded."""
    machine, excess = statement.machine, {}
    after = machine.responses(weights)
    for name, cap in statement.caps.items():
        size = statement.sizes[name]
        excess[name] = largest(abs(phasors(after, name)[0]) - cap, ZERO)
        room = size * real(CEILING) - excess[name]
        yield "ceilings", place, room if kept or room.high >= 0 else None, size
    return excess


def optimum(request: Place, answer: Place) -> Claims:
    """The answer to one request: counterweights with their certificate, or the proof that there are none."""
    request.known()
    if answer / "fronts":
        raise NotCovered(answer / "fronts")
    asked, goal, proof = request / "machine", request / "objective", answer / "certificate"
    if (goal / "orders").text("first", "all", default="first") == "all":
        raise NotCovered(goal / "orders")
    status = (answer / "status").text("optimal", "inaccurate", "infeasible")
    machine = Machine(asked, answer / "reference_plane_m", asked / "max_total_mass_kg")
    yield from before(machine, answer, answer / "residual" / "before")
    if status == "infeasible":
        yield from infeasible(request, answer, asked / "max_total_mass_kg", answer / "infeasibility")
        return
    weights = {"force": (goal / "force_weight").number(1.0, least=0), "moment": ONE / machine.span}
    if goal / "moment_weight":
        weights["moment"] = (goal / "moment_weight").number(least=0)
    weights = {name: weight for name, weight in weights.items() if weight.high > 0}
    together = (goal / "combine").text("sum", "max", default="sum") == "sum"
    rows = {"sum": weights} if together else {name: {name: weight} for name, weight in weights.items()}
    statement = Statement(machine, goal, rows)
    found, mass = yield from counterweights(machine, answer / "counterweights")
    excess = yield from ceilings(statement, found, answer / "counterweights", status == "optimal")
    after = machine.responses(found)
    yield near("total_mass", answer / "total_mass_kg", mass)
    yield from first_order("after", answer / "residual" / "after", after)
    value, rest = (largest(ZERO, *statement.values(responses).values()) for responses in (after, machine.laden))
    objective, lowest, implied = proof / "objective", proof / "lower_bound", proof / "implied_max_mass_kg"
    chosen = yield from searched(asked, answer / "counterweights", proof)
    lowest = proof / "continuous_lower_bound" if chosen else lowest
    yield near("objective", objective, value)
    yield near("before", proof / "objective_without_counterweights", rest)
    # nothing that exceeds no ceiling by more is better
    multipliers, priced = proof / "multipliers", partial(priced_at, dict.fromkeys(rows, lowest.number(0.0)))
    yield from proven("lower_bound", lowest, statement, multipliers / "objective", implied, excess, priced)
    lowest = proof / "lower_bound"
    gap, size = objective.number(0.0) - lowest.number(0.0), (proof / "yardstick").number(0.0)
    noise = SPECK * (abs(objective.number(0.0)) + abs(lowest.number(0.0)))
    if lowest and proof / "yardstick":
        yield near("gap", proof / "gap", gap + noise)
        yield near("relative_gap", proof / "relative_gap", (gap + noise) * ABOUT_ONE / size if size.low > 0 else ZERO)
        yield yardstick(statement, proof / "yardstick", rest, implied)
    asks_least = (goal / "least_mass").read((bool,), "true or false", True)
    if asks_least and not chosen:
        most = dict.fromkeys(rows, (proof / "mass_objective_limit").number(0.0))
        yield from lightest(statement, proof, multipliers, most, after, mass)
        yield from light(statement, proof, dict.fromkeys(rows, size), mass, status == "optimal")
    if status == "optimal":
        wide = (request / "accuracy" / "relative_gap").number(usual_gap(request / "machine"), least=0)
        room = wide * size + noise - gap
        yield "status", lowest, room if proof / "yardstick" else None, size


def searched(asked: Place, place: Place, proof: Place) -> Claims:
    """Returns whether counterweights are chosen by a search; the tree or the comparison behind it is not repeated."""
    yield from heavy_enough(asked, place)
    stock = (asked / "catalogue") or (asked / "max_counterweights") or any(map(stocked, asked / "webs"))
    if stock:
        yield from catalogue(asked, place)
    chosen = bool(stock or proof / "continuous_lower_bound")
    if chosen:
        yield "lower_bound", proof / "lower_bound", None, ONE
    return chosen


def lightest(
    statement: Statement, proof: Place, multipliers: Place, most: dict[str, Number], after: Responses, mass: Number
) -> Claims:
    """Nothing with rows up to these, which the answer keeps, and that counts as keeping the ceilings is lighter."""
    place, implied = proof / "mass_lower_bound_kg", proof / "implied_max_mass_kg"
    slack = {name: size * real(CEILING) for name, size in statement.sizes.items()}
    least = place.number(0.0) - statement.machine.fixed
    if least.high <= 0:
        yield "mass_lower_bound", place, -least if place else None, ONE
    else:
        priced = partial(priced_at, most, least=least)
        yield from proven("mass_lower_bound", place, statement, multipliers / "mass", implied, slack, priced, ONE)
        for name, value in statement.values(after).items():
            yield "mass_lower_bound", place, most[name] - value, abs(value)


def light(statement: Statement, proof: Place, sizes: dict[str, Number], mass: Number, optimal: bool) -> Claims:
    """The gap of the mass, over its yardstick: the mass, or what makes no difference to rows of these sizes."""
    least, place = proof / "mass_lower_bound_kg", proof / "mass_yardstick_kg"
    size, gap = place.number(0.0), mass - least.number(0.0)
    if least and place:
        yield near("mass_gap", proof / "mass_relative_gap", gap * ABOUT_ONE / size if size.low > 0 else ZERO)
        limited = Statement(statement.machine, Place({}), {name: {name: ONE} for name in statement.caps}, capped=False)
        cancelling = (statement.lightest(sizes), limited.lightest(statement.sizes))
        counts = min((one for one in cancelling if one is not None), key=lambda one: one.high, default=ZERO)
        yield (
            "yardstick",
            place,
            largest(mass - statement.machine.fixed, counts * real(MASS_SHARE)) * ABOUT_ONE - size,
            size,
        )
    if optimal:
        yield "status", least, size * real(MASS_GAP) - gap if least and place else None, size


def before(machine: Machine, answer: Place, place: Place) -> Claims:
    """The machine as it is."""
    if answer / "reference_plane_m":
        yield near("reference_plane", answer / "reference_plane_m", machine.asked_plane * ABOUT_ONE)
    yield from first_order("before", place, machine.before)
    for name, unit in NAMES.items() if answer / "floor" else ():
        yield near("floor", answer / "floor" / f"{name}_{unit}", abs(machine.before[name][1]))


def yardstick(statement: Statement, place: Place, rest: Number, implied: Place) -> Claim:
    """The objective without counterweights, or where it is 0 to rounding at most what they could make it."""
    if rest.low > 0:
        return near("yardstick", place, rest)
    most = statement.reachable(implied)
    if most is None:
        return "yardstick", place, None, ONE
    return "yardstick", place, most * ABOUT_ONE - place.number(), most


def infeasible(request: Place, answer: Place, budget: Place, said: Place) -> Claims:
    """No counterweights within the limits keep the ceilings, and what can be reached without them."""
    goal, proofs, implied = request / "objective", said / "multipliers", said / "implied_max_mass_kg"
    plain = Machine(request / "machine", answer / "reference_plane_m", budget)
    exact = Machine(request / "machine", answer / "reference_plane_m", budget, exact=True)
    statement = Statement(exact, goal, {})
    given = {CEILINGS[name]: name for name in statement.caps}
    named = [one.text(*given) for one in said / "conflict"]
    if proofs / "conflict" and named:
        # strictly above 0: what is at most 0 proves nothing
        yield from proven("conflict", proofs / "conflict", statement, proofs / "conflict", implied, {}, lambda _: STEP)
    else:
        yield "conflict", proofs / "conflict", None if named else -ONE, ONE
    yield from smallest(plain, Place({}), said, proofs, implied)
    for name, unit in NAMES.items():
        lowest, found = (said / f"smallest_{name}{part}_{unit}" for part in ("_lower_bound", ""))
        if lowest and found:
            yield f"smallest_{name}", found, found.number() * ABOUT_ONE - lowest.number(), abs(found.number())
        if lowest and f"{name}_ceiling_{unit}" in named and len(named) < len(given):
            # this ceiling alone is out of reach
            yield "conflict", lowest, lowest.number() - (goal / f"{name}_ceiling_{unit}").number(), lowest.number()
    for one in said / "smallest":
        name, lowest = (one / "response").text(*CEILINGS), one / "lower_bound"
        alone, priced = Statement(plain, Place({}), {name: {name: ONE}}), partial(priced_at, {name: lowest.number()})
        yield from proven("smallest", lowest, alone, one / "multipliers", implied, {}, priced)
        if CEILINGS[name] in named and len(named) < len(given):
            yield "conflict", lowest, lowest.number() - (goal / CEILINGS[name]).number(), lowest.number()
    if said / "closest":
        weights, _ = yield from counterweights(plain, said / "closest" / "counterweights")
        yield from first_order("closest", said / "closest" / "first_order", plain.responses(weights))


def smallest(machine: Machine, goal: Place, said: Place, proofs: Place, implied: Place) -> Claims:
    """Bounds on either peak alone, under the ceilings of a goal."""
    for name, unit in NAMES.items():
        lowest = said / f"smallest_{name}_lower_bound_{unit}"
        alone, priced = Statement(machine, goal, {name: {name: ONE}}), partial(priced_at, {name: lowest.number(0.0)})
        yield from proven(f"smallest_{name}", lowest, alone, proofs / f"smallest_{name}", implied, {}, priced)


def verify(request: Any, answer: Any) -> dict[str, Any]:
    """Every claim of an answer, and the verdict on the whole; both are what a JSON file holds.

    Raises
    ------
    Unreadable
        naming the field that is not what the service takes or gives.
    """
    return judged(covered(optimum(Place(request, "request"), Place(answer, "answer"))))


if __name__ == "__main__":
    sys.exit(main(verify, __doc__, sys.argv[1:]))
