"""Checks which weighed part goes on which row: each part once, what the rows weigh, and what the machine comes to.

That no assignment is better is proven by comparing all of them, where there are no more than a few thousand. Else it is
not covered, nor is the best of the parts as they are listed where counterweights are chosen as well.
"""

from __future__ import annotations

import copy
from fractions import Fraction
from itertools import combinations, permutations, product
from math import factorial, perm
from typing import Any, Dict, Iterator, List, Mapping, NamedTuple, Sequence, Tuple

from verify_answer import Fitted
from verify_claims import Claims, near, same
from verify_form import form
from verify_machine import NAMES, Machine, Responses
from verify_numbers import ABOUT_ONE, ONE, SPECK, ZERO, Number, Place, Unreadable, largest, real
from verify_orders import first_order
from verify_program import Statement
from verify_weights import ANGLE, counterweights, shafts
from verify_weights import ROUNDING as ROUNDED

__all__ = ["matching"]

#: assignments that are compared, and what doubles may be off by, of all forces together
MOST, ROUNDING = 5_000, 1e-11
#: kg on a row that show what a kilogram there does, beside which its own mass is rounding
HEAVY = 2.0**120
NUT = "balance_nut"
#: claims of limits that counterweights are chosen within
LIMITS = ("max_mass", "max_total_mass", "sector", "web_groups")
Row = Tuple[int, int]


class Parts(NamedTuple):
    """Parts of a class by their names, in the order of the list, and the rows that take one each."""

    name: str
    masses: Dict[str, float]
    rows: List[Row]


def matching(request: Place, answer: Place) -> Claims:
    """Claims of an assignment of parts to rows."""
    yield from form(answer, ("match",))
    design = request / "machine"
    rows = [(k, n) for k, throw in enumerate(design / "throws") for n, _ in enumerate(throw / "rows")]
    classes, nuts = list(_classes(request, rows)), _nuts(request)
    matched = yield from _assigned(answer, classes, nuts, rows)
    input_masses = dict.fromkeys(rows, 0.0)
    for kind in classes:
        for row, mass in zip(kind.rows, kind.masses.values()):
            input_masses[row] += mass
    entries = list(answer / "rows")
    places = [((row / "throw").double(), (row / "row").double()) for row in entries]
    yield "rows", answer / "rows", ONE if places == rows else -ONE, ONE
    own = [row for throw in design / "throws" for row in throw / "rows"]
    for entry, row, mine in zip(entries, places, own):
        for name in ("throw", "row"):
            yield same("rows", entry / name, (entry / name).value)
        yield same("rows", entry / "name", (mine / "name").value)
        whole = (mine / "reciprocating_mass_kg").number(least=0) + real(matched.get(row, 0.0))
        yield near("rows", entry / "reciprocating_mass_kg", whole * ABOUT_ONE)
    yield from _evaluated(request, answer, [_with(design, by_row) for by_row in (input_masses, matched)], classes, nuts)


def _classes(request: Place, rows: List[Row]) -> Iterator[Parts]:
    for kind in request / "parts":
        names = [entry.text() for entry in kind / "names"]
        masses = [entry.double(least=0) for entry in kind / "masses_kg"]
        taking = [((row / "throw").whole(), (row / "row").whole()) for row in kind / "rows"]
        if len({*names}) < len(names) or len(names) != len(masses) or not {*taking} <= {*rows}:
            raise Unreadable(kind.path, "names, masses and rows must go together")
        yield Parts((kind / "class").text(), dict(zip(names, masses)), taking or rows)


def _nuts(request: Place) -> Dict[str, float]:
    return {str(n + 1): mass.double(least=0) for n, mass in enumerate(request / "balance_nuts_kg")}


def _assigned(answer: Place, classes: Sequence[Parts], nuts: Dict[str, float], rows: List[Row]) -> Claims:
    """Every part on a row of its class, one each; nuts there or among the spares. Returns masses by rows."""
    left = {(kind.name, name): mass for kind in classes for name, mass in kind.masses.items()}
    left.update({(NUT, name): mass for name, mass in nuts.items()})
    rows_of = {kind.name: list(kind.rows) for kind in classes}
    rows_of[NUT] = list(rows)
    matched: Dict[Row, float] = {}
    for where in ("assignments", "spares"):
        for part in answer / where:
            key = (part / "class").text(), (part / "part").text()
            fit = key in left and (where == "assignments" or key[0] == NUT)
            if where == "assignments":
                row = (part / "throw").double(), (part / "row").double()
                fit = fit and row in rows_of[key[0]]
                for name in ("throw", "row"):
                    yield "assignments", part / name, ONE if fit else -ONE, ONE
                if fit:
                    rows_of[key[0]].remove(row)
                    matched[row] = matched.get(row, 0.0) + left[key]
            for name in ("class", "part"):
                yield where, part / name, ONE if fit else -ONE, ONE
            if fit:
                yield near(where, part / "mass_kg", real(left.pop(key)))
    yield "assignments", answer / "assignments", -ONE if left else ONE, ONE
    return matched


def _with(design: Place, by_row: Mapping[Any, float]) -> Place:
    """The machine with masses on its rows."""
    body: Any = copy.deepcopy(design.value)
    for k, throw in enumerate(design / "throws"):
        for n, row in enumerate(throw / "rows"):
            mass = (row / "reciprocating_mass_kg").double(0.0) + by_row.get((k, n), 0.0)
            body["throws"][k]["rows"][n]["reciprocating_mass_kg"] = mass
    return Place(body, *design.path)


def _evaluated(
    request: Place, answer: Place, machines: Sequence[Place], classes: Sequence[Parts], nuts: Dict[str, float]
) -> Claims:
    """Both ellipses, the objective, and its gap."""
    goal, proof, none = request / "objective", answer / "certificate", Place(None)
    before, after = (Machine(design, goal, none, none) for design in machines)
    is_choice = (request / "choose_counterweights").value is True
    placed = _fitted(after, answer, machines[1])
    fitted = yield from placed if is_choice else _beyond_limits(placed)
    turning = fitted.first
    if not is_choice:
        webs = (web for web in request / "machine" / "webs" if web / "fixed")
        there = {(web / "name").text(): web / "fixed" for web in webs}
        there.update({(entry / "web").text(): entry for entry in request / "counterweights"})
        every = [entry for shaft in [answer, *(answer / "balance_shafts")] for entry in shaft / "counterweights"]
        for entry in every:
            place = there.get((entry / "web").text(), Place({"mass_kg": 0.0, "angle_deg": 0.0}))
            yield near("counterweights", entry / "mass_kg", (place / "mass_kg").number())
            stated, printed = (place / "angle_deg").double(0.0), (entry / "angle_deg").double()
            off = (Fraction(printed) - Fraction(stated) + 180) % 360 - 180
            allowed = Fraction(ANGLE) + Fraction(ROUNDED) * abs(Fraction(stated))
            is_there = (entry / "mass_kg").number().high > 0
            yield "counterweights", entry / "angle_deg", real(allowed - abs(off)) if is_there else ONE, ONE
    weights = {"force": (goal / "force_weight").number(1.0, least=0), "moment": ONE / after.span}
    if goal / "moment_weight":
        weights["moment"] = (goal / "moment_weight").number(least=0)
    together = (goal / "combine").text("sum", "max", default="sum") == "sum"
    rows = {"sum": weights} if together else {name: {name: weight} for name, weight in weights.items()}

    def value(machine: Machine, responses: Responses) -> Number:
        return largest(ZERO, *Statement(machine, goal, rows, capped=False).values(responses).values())

    residual = after.responses(turning)
    objective = value(after, residual)
    yield from first_order("after", answer / "residual" / "after", residual)
    yield near("objective", proof / "objective", objective)
    size = value(before, before.laden)
    if not is_choice:
        unsorted = before.responses(turning)
        size = value(before, unsorted)
        yield from first_order("before", answer / "residual" / "before", unsorted)
        yield near("before", proof / "objective_as_listed", size)
    yield near("yardstick", proof / "yardstick", size)
    yield from _gap(request, answer, proof)
    if not is_choice and _count(classes, nuts, len(list(_places(request / "machine")))) <= MOST:
        lengths = {name: float(weight) for name, weight in weights.items()}
        bare = [_with(request / "machine", {row: HEAVY}) for row in [None, *_places(request / "machine")]]
        responses = [Machine(entry, none, none, none).responses(turning) for entry in bare]
        least = min(_every(request, lengths, together, responses, classes, nuts))
        off = ROUNDING * (float(abs(size)) + float(objective))
        room = least + off - (proof / "lower_bound").double(0.0)
        yield "lower_bound", proof / "lower_bound", real(room), real(max(abs(least), off))


def _beyond_limits(claims: Claims) -> Claims:
    """What is on the machine already need not keep the limits of those that are chosen."""
    while True:
        try:
            claim, place, room, size = next(claims)
        except StopIteration as end:
            return end.value
        yield claim, place, ONE if claim in LIMITS and room is not None and room.high < 0 else room, size


def _fitted(machine: Machine, answer: Place, design: Place) -> Claims:
    """What is on crankshaft and balance shafts, which is returned."""
    turning, mass = yield from counterweights(machine, answer / "counterweights", design)
    there, on_shafts = yield from shafts(machine, design, answer / "balance_shafts")
    yield near("total_mass", answer / "total_mass_kg", mass, largest(mass, ONE))
    if answer / "balance_shafts_mass_kg":
        yield near("total_mass", answer / "balance_shafts_mass_kg", on_shafts)
    return Fitted(turning, there, mass, on_shafts)


def _gap(request: Place, answer: Place, proof: Place) -> Claims:
    optimal = (answer / "status").text("optimal", "inaccurate") == "optimal"
    if not proof / "lower_bound":
        yield "status", answer / "status", -ONE if optimal else ONE, ONE
        return
    value, lowest = (proof / "objective").number(), (proof / "lower_bound").number()
    size, gap = (proof / "yardstick").number(least=0), value - lowest
    noise = SPECK * (abs(value) + abs(lowest))
    yield near("gap", proof / "gap", gap + noise)
    yield near("relative_gap", proof / "relative_gap", (gap + noise) * ABOUT_ONE / size if size.low > 0 else ZERO)
    wide = (request / "accuracy" / "relative_gap").number(1e-3, least=0)
    yield "status", answer / "status", wide * size + noise - gap if optimal else ONE, ONE


def _places(design: Place) -> Iterator[Row]:
    return ((k, n) for k, throw in enumerate(design / "throws") for n, _ in enumerate(throw / "rows"))


def _count(classes: Sequence[Parts], nuts: Dict[str, float], rows: int) -> int:
    """How many assignments there are."""
    count = 1
    for kind in classes:
        count *= factorial(min(len(kind.masses), 20))
    return count * sum(perm(len(nuts), n) * perm(rows, n) // factorial(n) for n in range(min(len(nuts), rows) + 1))


def _every(
    request: Place, weights: Dict[str, float], together: bool, machines: Sequence[Responses], parts: Sequence[Parts],
    nuts: Dict[str, float],
) -> Iterator[float]:  # fmt: skip
    """Objectives of all assignments; ``machines``: responses without parts, and with HEAVY on each row."""
    rows = list(_places(request / "machine"))
    start, *more = [[entry[name] for name in NAMES] for entry in machines]
    base = [item.middle() for item in _flat(start)]
    slopes = [[(item.middle() - old) / HEAVY for item, old in zip(_flat(entry), base)] for entry in more]
    across = [(request / "objective" / "direction_weights" / name).double(1.0, least=0) for name in ("x", "y")]
    p, q = sum(across) / 2, (across[0] - across[1]) / 2
    for orders in product(*(permutations(item.masses.values()) for item in parts)):
        on_rows = dict.fromkeys(rows, 0.0)
        for item, masses in zip(parts, orders):
            for row, mass in zip(item.rows, masses):
                on_rows[row] += mass
        for fitted in _with_nuts(on_rows, nuts):
            vectors = list(base)
            for row, slope in zip(rows, slopes):
                vectors = [entry + fitted[row] * item for entry, item in zip(vectors, slope)]
            peaks = []
            for name, (co, counter) in zip(NAMES, (vectors[:2], vectors[2:])):
                lengths = abs(p * co + q * counter.conjugate()) + abs(q * co + p * counter.conjugate())
                peaks.append(weights.get(name, 0.0) * lengths)
            yield sum(peaks) if together else max(peaks)


def _flat(pairs: Sequence[Tuple[Number, Number]]) -> List[Number]:
    return [number for pair in pairs for number in pair]


def _with_nuts(on_rows: Dict[Row, float], nuts: Dict[str, float]) -> Iterator[Dict[Row, float]]:
    """Rows with nuts, at most one on each."""
    for count in range(min(len(nuts), len(on_rows)) + 1):
        for places in combinations(on_rows, count):
            for masses in permutations(nuts.values(), count):
                yield {**on_rows, **{row: on_rows[row] + mass for row, mass in zip(places, masses)}}
