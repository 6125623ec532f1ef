"""Goals over the whole turn: what their cuts prove.

Of bearing loads, bending moments, and force and moment of all orders, the multipliers prove a bound by cuts: each is
the response at one shaft angle, which is evaluated here from rods and masses. That no angle between is worse is not
covered, nor are gas, friction, root mean squares, roll, continuous shafts, goals in their order, balance shafts,
scenarios and tolerances.
"""

from __future__ import annotations

from typing import Dict, List, NamedTuple, Optional, Tuple

from verify_answer import Fitted
from verify_claims import EVIDENCE, Claims
from verify_curves import Turn
from verify_first import ceilings, searched
from verify_machine import NAMES, NOTHING, Machine, Mass, over
from verify_numbers import (
    ABOUT_ONE,
    ONE,
    SPECK,
    ZERO,
    J,
    NotCovered,
    Number,
    Place,
    largest,
    real,
    total,
)
from verify_program import CEILINGS, Statement, support

#: fields of an objective that look at the whole turn and are known here
FIELDS = "orders bearing_weight bearing_ceiling_N specific_load_ceiling_Pa bending_weight bending_ceiling_Nm"
#: components on the frame, of which the real part alone counts
ALONG = [name for name in CEILINGS if ":" in name]
#: products of cuts with rows, masses and webs that are evaluated at a time
MOST = 30_000


class Term(NamedTuple):
    """|start + sum of factors times unbalances|, in a row of the objective; or what a ceiling limits."""

    row: str
    group: str
    start: Number
    factors: List[Number]  # of every web, per kg m
    y: Number  # its multiplier


class Program:
    """The objective by its cuts, and what multipliers prove of it."""

    def __init__(self, request: Place, machine: Machine) -> None:
        goal = request / "objective"
        self.machine, self.goal = machine, goal
        self.all = (goal / "orders").text("first", "all", default="first") == "all"
        self.apart = (goal / "combine").text("sum", "max", default="sum") == "sum"
        weights = {"force": (goal / "force_weight").number(1.0, least=0), "moment": ONE / machine.span}
        if goal / "moment_weight":
            weights["moment"] = (goal / "moment_weight").number(least=0)
        self.weights = {name: weight for name, weight in weights.items() if weight.high > 0}
        for kind in ("bearing", "bending"):
            self.weights[kind] = (goal / f"{kind}_weight").number(0.0, least=0)
        if self.weights["bearing"].high > 0 and (goal / "bearing_measure").value == "rms":
            raise NotCovered(goal / "bearing_measure")
        self.area = {}
        if (goal / "bearing_measure").value == "specific":
            for one in request / "machine" / "bearings":
                self.area[(one / "name").text()] = (one / "diameter_m").number() * (one / "length_m").number()
        names = FIELDS.split()[1:]
        loads = any((goal / name).value not in (None, 0) for name in names)
        self.turn = Turn(request, machine, loads)
        limits = [*names, *(CEILINGS.values() if self.all else ())]
        self.limited = any("_ceiling_" in name and goal / name for name in limits)
        external = {name: self.weights[name] for name in NAMES if name in self.weights and not self.all}
        rows = {"sum": external} if self.apart else {name: {name: weight} for name, weight in external.items()}
        self.exact = Statement(machine, goal, rows if external else {}, capped=not self.all)

    def terms(self, proof: Place) -> List[Term]:
        """Terms of the objective with their multipliers."""
        found = list(proof / "terms")
        if len(found) * (len(self.turn.rows) + len(self.machine.masses) + len(self.machine.webs)) > MOST:
            raise NotCovered(proof / "terms")
        return [self._term(one) for one in found]

    def _term(self, one: Place) -> Term:
        response, row = (one / "response").text(), (one / "row").text()
        kind, _, name = response.partition(":")
        y = (one / "x").number() + J * (one / "y").number()
        if one / "scenario" or kind not in self.weights or not self.turn.knows(response):
            raise NotCovered(one)
        if not one / "angle_deg":
            exact = self.exact.terms.get((response, (one / "part").text("co", "counter")))
            if exact is None:
                raise NotCovered(one)
            return Term(row, self._group("first"), exact.start, self._factors(response, exact.factor), y)
        weight = self.weights[kind] * ABOUT_ONE
        weight = over(weight, self.area[name], one) if kind == "bearing" and self.area else weight
        start = self.turn.seen(response, (one / "angle_deg").double()) * weight
        return Term(row, self._group(kind), start, self._factors(response, weight), y)

    def _group(self, kind: str) -> str:
        return kind if self.apart else "all"

    def _factors(self, response: str, factor: Number) -> List[Number]:
        square = self.machine.square
        return [self.turn.factor(response, web.position) * square * factor for web in self.machine.webs]

    def reached(self, terms: List[Term], weights: List[Mass]) -> Number:
        """What counterweights come to at the angles of the cuts."""
        rows: Dict[Tuple[str, str], Number] = {}
        for one in terms:
            moved = one.start
            for weight, factor in zip(weights, one.factors):
                moved = moved + weight.product * weight.co * factor
            before = rows.get((one.group, one.row), self.exact.floor.get(one.row, ZERO))
            rows[one.group, one.row] = before + abs(moved)
        groups = {group for group, _ in rows}
        return total(largest(*(value for (of, _), value in rows.items() if of == group)) for group in groups)

    def bound(
        self, proof: Place, terms: List[Term], implied: Place, cost: Number = ZERO, most: Number = ZERO
    ) -> Tuple[Optional[Number], bool]:
        """Of the objective, or of the mass with objectives up to ``most``, and whether implied limits are believed."""
        machine = self.machine
        rows = {(one / "name").text(): (one / "value").number(least=0) for one in proof / "rows"}
        group_of = {one.row: one.group for one in terms}
        rows = {name: value for name, value in rows.items() if value.low > 0 and name in group_of}
        sums = {group: total(value for name, value in rows.items() if group_of[name] == group)
                for group in {group_of[name] for name in rows}}  # fmt: skip
        if cost is ZERO and not sums:
            return None, False
        # every group by the price of the objective: 1, or in the bound of a mass the largest of their sums
        price = ONE if cost is ZERO else max(sums.values(), key=lambda one: one.high, default=ZERO)
        share = {group: over(price, each, proof) for group, each in sums.items()}
        least = total(value * share[group_of[name]] * self.exact.floor.get(name, ZERO) for name, value in rows.items())
        slopes = [ZERO for _ in machine.webs]
        for one in terms:
            allowed, size = rows.get(one.row, ZERO), abs(one.y)
            if size.low <= 0 or allowed.low <= 0:
                continue
            # |y| <= lambda holds by shortening
            shorter = share[one.group] * (allowed / size if size.high > allowed.low else ONE)
            shorter = Number(min(shorter.low, share[one.group].low), min(shorter.low, share[one.group].low))
            least = least + one.y.along(one.start) * shorter
            slopes = [slope + factor * one.y * shorter for slope, factor in zip(slopes, one.factors)]
        for limit in proof / "ceilings":
            p = (limit / "x").number() + J * (limit / "y").number()
            if abs(p).high <= 0:
                continue
            start, factors, cap = self._capped(limit)
            if limit / "angle_deg" and (limit / "response").text() in ALONG:
                p = (limit / "x").number()
            least = least + p.along(start) - abs(p) * cap
            slopes = [slope + factor * p for slope, factor in zip(slopes, factors)]
        beta = (proof / "budget").number(0.0, least=0) if machine.budget else ZERO
        believed, least = False, least - (price * most if cost is not ZERO else ZERO)
        for web, pull in zip(machine.webs, machine.together([-slope for slope in slopes])):
            gain = web.radius * support(pull, web.sector) - cost - beta
            if gain.high <= 0:
                continue
            carries = self.exact.reach(web, Place(None))
            if carries is None or implied / web.name:
                believed, carries = True, self.exact.reach(web, implied)
            if carries is None:
                return None, True
            least = least - Number(max(gain.low, 0), gain.high) * carries
        return least - (beta * machine.budget if machine.budget else ZERO), believed

    def _capped(self, one: Place) -> Tuple[Number, List[Number], Number]:
        """What a ceiling limits, and how much it allows."""
        response, goal = (one / "response").text(), self.goal
        kind, _, name = response.partition(":")
        along = bool(name) and kind in NAMES
        if one / "scenario" or (one / "angle_deg" and not self.turn.knows(kind if along else response)):
            raise NotCovered(one)
        if not one / "angle_deg":
            if response not in self.exact.caps:
                raise NotCovered(one)
            co, counter = self.machine.before[kind]
            start = co if not name else co + counter.conjugate() * (ONE if name == "x" else -ONE)
            return start, self._factors(kind, ONE), self.exact.caps[response]
        degrees = (one / "angle_deg").double()
        if along and self.all and response in CEILINGS and goal / CEILINGS[response]:
            # the real part of what is turned to the frame and to the axis
            back = self.turn.turned(degrees) * (ONE if name == "x" else -J)
            factors = [factor * back.conjugate() for factor in self._factors(kind, ONE)]
            return self.turn.seen(kind, degrees) * back, factors, (goal / CEILINGS[response]).number(least=0)
        start = self.turn.seen(response, degrees)
        if kind == "bearing" and goal / "specific_load_ceiling_Pa":
            raise NotCovered(goal / "specific_load_ceiling_Pa")
        field = f"{kind}_ceiling_{NAMES[kind]}" if kind in NAMES else {"bearing": "bearing_ceiling_N"}.get(kind, "")
        cap = goal / (field or "bending_ceiling_Nm")
        if not cap:
            raise NotCovered(one)
        return start, self._factors(response, ONE), cap.number(least=0)


def looks_at_the_turn(request: Place) -> bool:
    """Whether an objective asks for more than the first order, in a way that is known here."""
    goal = request / "objective"
    loads = any((goal / name).value not in (None, 0) for name in FIELDS.split()[1:])
    return loads or (goal / "orders").value == "all"


def over_turn(request: Place, answer: Place, machine: Machine, fitted: Fitted) -> Claims:
    """The proof of the answer to one request whose objective looks at the whole turn."""
    request.known(FIELDS)
    asked, proof, found = request / "machine", answer / "certificate", fitted.turning
    for web, one in zip(machine.webs, asked / "webs"):
        if web.fixed is not None:
            # the curves of the shaft are evaluated without it
            raise NotCovered(one / "fixed")
    program = Program(request, machine)
    optimal = (answer / "status").text() == "optimal"
    yield from ceilings(program.exact, found, answer / "counterweights", optimal)
    if program.limited:
        yield "ceilings", answer / "counterweights", None, ONE
    objective, lowest, implied = proof / "objective", proof / "lower_bound", proof / "implied_max_mass_kg"
    chosen = yield from searched(asked, answer / "counterweights", proof)
    of_any_mass = proof / "continuous_lower_bound" if chosen else lowest
    multipliers, value = proof / "multipliers", objective.number(0.0)
    noise = SPECK * (abs(value) + abs(lowest.number(0.0)))
    # not below what is there at the angles of the cuts; whether anything is above it is not told here
    terms = program.terms(multipliers / "objective")
    reached = program.reached(terms, found)
    yield "cuts", proof, value + noise + real(NOTHING) - reached if objective else None, largest(value, reached)
    yield "objective", objective, None, ONE
    of_objective = multipliers / "objective"
    yield from _proven("lower_bound", of_any_mass, program.bound(of_objective, terms, implied), implied, of_objective)
    least = proof / "mass_lower_bound_kg"
    if least and multipliers / "mass" and least.number().high > 0:
        limit, of_mass = (proof / "mass_objective_limit").number(), multipliers / "mass"
        found_least = program.bound(of_mass, program.terms(of_mass), implied, ONE, limit)
        yield from _proven("mass_lower_bound", least, found_least, implied, of_mass)
        yield "mass_lower_bound", least, limit + noise - value, abs(value)


def unreachable(request: Place, answer: Place, budget: Place, said: Place) -> Claims:
    """No counterweights keep the ceilings of the whole turn."""
    raise NotCovered(said)
    yield


def _proven(claim: str, said: Place, found: Tuple[Optional[Number], bool], implied: Place, proof: Place) -> Claims:
    least, believed = found
    if believed:
        yield "reach", implied, None, ONE
    room = None if least is None or not said else least - said.number()
    yield claim, said, room, largest(abs(said.number(0.0)), abs(least or ZERO))
    if room is not None:
        yield EVIDENCE, proof, None, ONE
        yield EVIDENCE, implied, None, ONE
