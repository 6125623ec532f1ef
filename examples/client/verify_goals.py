"""Goals over a revolution, in several cases, with tolerances, in their order: what an answer prints of them."""

from __future__ import annotations

from typing import Dict, Generator, List, NamedTuple, Sequence

from verify_alternatives import CLAIM, Worth, every
from verify_answer import Fitted
from verify_bearings import columns, within
from verify_cases import Scatter, nominal
from verify_ceilings import margins
from verify_claims import Claim, Claims, near
from verify_cuts import Part
from verify_levels import WIDE, levels
from verify_machine import NAMES, ON_FRAME, Machine
from verify_nominal import NO_SCATTER, fixed_alone, nominal_optimum, nominal_part
from verify_numbers import ABOUT_ONE, ONE, ZERO, Number, Place, largest, real
from verify_values import Value, most, off_sizes
from verify_weights import active_limits


class Program(NamedTuple):
    """What is asked: machines, goals in their order, what counterweights may be off by, rows of the first order."""

    parts: List[Part]
    goal_names: List[str]
    off: Scatter
    machine: Machine
    rows: Dict[str, Dict[str, Number]]


def values(request: Place, answer: Place, program: Program, fitted: Fitted) -> Claims:
    """Objective, goals before it, the worst case and what it costs."""
    proof = answer / "certificate"
    fixed = fixed_alone(program.machine, fitted)
    there, rest = ([Value(part, side, program.off) for part in program.parts] for side in (fitted, fixed))
    optimal = (answer / "status").text() == "optimal"
    rooms = yield from margins(answer / "counterweights", there, rest, optimal)
    if program.machine.budget is not None:
        most_there = float(program.machine.budget)
        rooms["max_total_mass"] = 1 - float(fitted.mass) / most_there if most_there > 0 else 0.0
    yield from active_limits("active_limits", answer / "active_limits", rooms)
    if answer / "bearing_columns":
        yield from columns(request, program.machine, answer / "bearing_columns", fitted)
    if list(request / "objective" / "priorities"):
        yield from levels(request, answer, program.goal_names, there, rest, fitted)
    first = program.parts[0]
    if not first.over_turn and len(program.goal_names) == 1:
        yield from _exactly(request, answer, program, fitted)
        return
    last = program.goal_names[-1]
    value, nothing = (most([case.goal(last) for case in side]) for side in (there, rest))
    off = WIDE * nothing.high
    yield within("objective", proof / "objective", value.low, value.high, off)
    rest_of = proof / "objective_without_counterweights"
    yield within("before", rest_of, nothing.low, nothing.high, off)
    if not rest_of and nothing.low > off:
        # a row of a sweep has the reference value alone
        yield within("yardstick", proof / "yardstick", nothing.low, nothing.high, off)
    if answer / "worst_case":
        yield from _worst_case(answer / "worst_case", proof / "objective", there)
    if answer / "price_of_robustness":
        as_it_is = Value(nominal_part(request, program.machine, program.parts), fitted, NO_SCATTER).goal(last)
        yield within("price", answer / "price_of_robustness" / "nominal", as_it_is.low, as_it_is.high, off)
        yield from nominal_optimum(request, program.machine, program.parts, program.off, answer)


def cheaper(request: Place, answer: Place, program: Program, best: Fitted) -> Claims:
    """Cheaper choices beside the best one, by what they come to in all cases."""
    rest = [Value(part, fixed_alone(program.machine, best), program.off) for part in program.parts]

    def judged(entry: Place, there: Fitted) -> Generator[Claim, None, Worth]:
        cases, place = [Value(part, there, program.off) for part in program.parts], entry / "objective"
        yield from margins(entry / "counterweights", cases, rest, True)
        if not program.parts[0].over_turn:
            value = _exact(program, there)
            return Worth(value, near(CLAIM, place, value * ABOUT_ONE))
        between, nothing = (most([case.goal(program.goal_names[-1]) for case in side]) for side in (cases, rest))
        off = WIDE * nothing.high
        return Worth(real(between.low - off), within(CLAIM, place, between.low, between.high, off))

    yield from every(request, answer, program.machine, judged)


def _exact(program: Program, there: Fitted) -> Number:
    """What goals of the first order come to in all cases."""
    sizes = off_sizes(program.parts[0], there)
    placed = ((part, part.placed(there).first) for part in program.parts)
    return largest(ZERO, *(part.value(weights, program.off, sizes) for part, weights in placed))


def _worst_case(place: Place, objective: Place, there: Sequence[Value]) -> Claims:
    """Peaks in the worst case, each by itself."""
    value = objective.double()
    yield within("worst_case", place / "objective", value, value, 1e-12 * abs(value))
    for name, unit in NAMES.items():
        peak = most([case.response(name) if case.part.all else case.of_first_order(name) for case in there])
        yield within("worst_case", place / f"{name}_peak_{unit}", peak.low, peak.high, WIDE * peak.high)
    for claim in place / "responses":
        name = (claim / "response").text(*ON_FRAME)
        peak = most([case.response(name) if case.part.all else case.of_first_order(name) for case in there])
        yield "worst_case", claim / "response", ONE, ONE
        yield within("worst_case", claim / "peak", peak.low, peak.high, WIDE * peak.high)
    if there[0].part.of_shaft:
        peak = most([case.bearings() for case in there])
        yield within("worst_case", place / "bearing_peak_N", peak.low, peak.high, WIDE * peak.high)
    else:
        yield "worst_case", place / "bearing_peak_N", -ONE if place / "bearing_peak_N" else ONE, ONE


def _exactly(request: Place, answer: Place, program: Program, fitted: Fitted) -> Claims:
    """Values of goals of the first order, in exact numbers."""
    masses = fitted.first
    proof, worst, price = answer / "certificate", answer / "worst_case", answer / "price_of_robustness"
    sizes = off_sizes(program.parts[0], fitted)
    nothing = [ZERO for _ in sizes]
    parts = [(part, part.placed(fitted).first) for part in program.parts]
    value = _exact(program, fitted)
    rest = largest(ZERO, *(part.value(part.machine.there, program.off, nothing) for part, _ in parts))
    # what is off by itself is multiplied in doubles too
    yield near("objective", proof / "objective", value * ABOUT_ONE)
    yield near("before", proof / "objective_without_counterweights", rest * ABOUT_ONE)
    if not proof / "objective_without_counterweights" and rest.low > 0:
        # a row of a sweep has the reference value alone
        yield near("yardstick", proof / "yardstick", rest * ABOUT_ONE)
    if worst:
        yield near("worst_case", worst / "objective", value * ABOUT_ONE)
        for name, unit in NAMES.items():
            peaks = [part.peak(weights, name, program.off, sizes) for part, weights in parts]
            yield near("worst_case", worst / f"{name}_peak_{unit}", largest(*peaks) * ABOUT_ONE)
        for entry in worst / "responses":
            name = (entry / "response").text(*ON_FRAME)
            peaks = [part.peak(weights, name, program.off, sizes) for part, weights in parts]
            yield "worst_case", entry / "response", ONE, ONE
            yield near("worst_case", entry / "peak", largest(*peaks) * ABOUT_ONE)
    if price:
        responses = program.machine.responses(masses)
        yield near("price", price / "nominal", nominal(program.machine, request / "objective", program.rows, responses))
        yield from nominal_optimum(request, program.machine, program.parts, program.off, answer)
