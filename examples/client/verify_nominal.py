"""What the worst case costs: the best of the unchanged machine, nothing off.

The counterweights of that optimum are in the answer, like the multipliers that prove its bound. Its own figures are
evaluated from them, on the unchanged machine and in every case.
"""

from __future__ import annotations

from typing import Sequence

from verify_answer import Fitted, fitted
from verify_bearings import within
from verify_cases import Case, Scatter, scenarios, without_cases
from verify_ceilings import margins
from verify_claims import Claims
from verify_cuts import Part
from verify_levels import WIDE
from verify_machine import Machine, Mass
from verify_numbers import ONE, ZERO, Place, real
from verify_values import Value, most
from verify_weights import usual_gap

NO_SCATTER = Scatter(ZERO, ZERO)


def nominal_part(request: Place, machine: Machine, parts: Sequence[Part]) -> Part:
    """The machine without scenarios, nothing off."""
    first = parts[0]
    return Part(Case(without_cases(request), machine, ONE, None), first.unweighted, first.goal_names)


def nominal_optimum(request: Place, machine: Machine, parts: Sequence[Part], off: Scatter, answer: Place) -> Claims:
    """Every figure of the best of the unchanged machine, but what multipliers prove."""
    place = answer / "price_of_robustness"
    best, worst = place / "nominal_optimum", place / "nominal_optimum_worst_case"
    if not best:
        yield "nominal_optimum", worst, -ONE if worst else ONE, ONE
        return
    goal, plain = parts[0].goal_names[-1], nominal_part(request, machine, parts)
    masses = (request / "tolerances" / "reciprocating_mass_relative").double(0.0)
    none = masses == 0 and all(share.high == 0 for share in off) and not scenarios(request)
    if none:
        # nothing is off: the optimum is the answer's own
        value = (answer / "certificate" / "objective").double()
        for field in (best, worst):
            yield within("nominal_optimum", field, value, value, 1e-12 * abs(value))
        return
    if not list(place / "nominal_counterweights"):
        yield from _without_search(place, parts, answer)
        return
    there = yield from fitted(request, machine, place / "nominal_counterweights", place / "nominal_balance_shafts")
    optimum, bare = Value(plain, there, NO_SCATTER), Value(plain, fixed_alone(machine, there), NO_SCATTER)
    value, rest = optimum.goal(goal), bare.goal(goal)
    wide = WIDE * rest.high
    yield within("nominal_optimum", best, value.low, value.high, wide)
    yield from margins(place, [optimum], [bare], True)
    of_all = most([Value(case, there, off).goal(goal) for case in parts])
    yield within("nominal_optimum", worst, of_all.low, of_all.high, WIDE * of_all.high + wide)
    lowest = place / "nominal_lower_bound"
    gap = (request / "accuracy" / "relative_gap").double(usual_gap(request / "machine"), least=0)
    if not lowest:
        yield "nominal_optimum", best, None, ONE
        return
    above = best.double() - lowest.double() + wide
    # what is proven may be less than was sought: how much less is not told
    near_it = above <= gap * rest.high + 2 * wide
    yield "nominal_optimum", lowest, real(above) if near_it or above < 0 else None, ONE


def fixed_alone(machine: Machine, there: Fitted) -> Fitted:
    """What is on the machine where nothing is chosen."""
    webs = zip(there.turning, machine.webs)
    return there._replace(
        turning=[mass if web.fixed else Mass(ZERO, ONE, ZERO, web.position) for mass, web in webs], on_shafts=[]
    )


def _without_search(place: Place, parts: Sequence[Part], answer: Place) -> Claims:
    """Of choices: where nothing is limited the optimum is no better in the worst case than what is proven of all."""
    worst, lowest = place / "nominal_optimum_worst_case", answer / "certificate" / "lower_bound"
    yield "nominal_optimum", place / "nominal_optimum", None, ONE
    # a goal before it may have been kept to another limit
    free = len(parts[0].goal_names) == 1 and not any(part.exact.caps or part.limited for part in parts)
    broken = free and worst.double() < lowest.double(0.0) * (1 - WIDE)
    yield "nominal_optimum", worst, -ONE if broken else None, ONE
