"""What each peak comes to at least by itself, where no counterweights keep the ceilings: in the worst of all cases."""

from __future__ import annotations

from typing import Dict, Optional

from verify_bearings import SAMPLE, peak_of
from verify_cases import CASES, Scatter, scenarios
from verify_claims import EVIDENCE, Claims, covered, near, same
from verify_conflict import Limit, excess
from verify_cuts import Part
from verify_first import SMALLEST, component, implied_alone
from verify_levels import WIDE
from verify_machine import NAMES, ON_FRAME, Machine
from verify_multipliers import Program, by_cuts
from verify_numbers import ABOUT_ONE, ONE, SPECK, ZERO, J, NotCovered, Number, Place, largest, real, total
from verify_program import CEILINGS

#: fields of ceilings on loads by the responses that they limit
LOADED = {"bearing": ("bearing_ceiling_N", "specific_load_ceiling_Pa"), "bending": ("bending_ceiling_Nm",)}
KINDS = (*ON_FRAME, "bearing", "bending", "roll")
#: ceilings of peaks that are in an answer without a list
OWN = tuple(CEILINGS[name] for name in NAMES)
#: relative: a specific load stands as a force, by the area of its bearing
PRINTED = 1e-12
_NONE = Place(None)


class SmallestPeaks:
    """Peaks by themselves, under no ceilings."""

    def __init__(self, request: Place, machine: Machine, verdict: Place) -> None:
        self.request, self.machine, self.verdict = request, machine, verdict
        self.implied = verdict / "implied_max_mass_kg"
        self._programs: Dict[str, Program] = {}

    def claims(self, of_cases: bool) -> Claims:
        """Of responses with a ceiling over a revolution, and of force and moment where cuts or cases prove them."""
        for name, unit in NAMES.items() if of_cases else ():
            lowest, attained = (self.verdict / f"smallest_{name}{part}_{unit}" for part in ("_lower_bound", ""))
            proof = self.verdict / "multipliers" / f"smallest_{name}"
            if lowest and proof:
                yield from covered(self._peak(f"smallest_{name}", name, lowest, attained, proof))
        goal = self.request / "objective"
        every = (goal / "orders").text("first", "all", default="first") == "all"
        entries = {(entry / "ceiling_field").value for entry in self.verdict / "smallest"}
        # a row of a sweep has no list
        for item in self.verdict / "conflict" if "smallest" in self.verdict.value else ():
            # force and moment of the first order have fields of their own
            if every or item.value not in OWN:
                yield "smallest", self.verdict / "smallest", ONE if item.value in entries else -ONE, ONE
        for entry in self.verdict / "smallest":
            name = (entry / "response").text()
            if of_cases and ":" in name and name in CEILINGS:
                yield from covered(self._component(name, entry))
            elif of_cases or name not in CEILINGS or not goal / CEILINGS[name]:
                yield from covered(self._under_a_ceiling(entry))
            else:
                # a component of the first order, in closed form
                machine = next(iter(self._alone(name).parts.values())).machine
                yield from covered(component(goal, machine, self.verdict, entry))

    def _component(self, name: str, entry: Place) -> Claims:
        """Along an axis, in the worst case: nothing keeps a ceiling below the bound."""
        goal, field, lowest = self.request / "objective", CEILINGS[name], entry / "lower_bound"
        yield near("smallest", entry / "ceiling", (goal / field).number(0.0))
        yield same("smallest", entry / "ceiling_field", field if goal / field else None)
        yield same("smallest", entry / "response", name)
        stated = {"orders": (goal / "orders").value or "first", field: lowest.double(least=0)}
        program = Program(Place({**self.request.value, "objective": stated}, *self.request.path), self.machine, _NONE)
        proof, implied = entry / "multipliers", implied_alone(self.verdict, name, self.implied)
        rows, limits = {(row / "name").text(): (row / "value").number(least=0) for row in proof / "rows"}, []
        names = [(term / "row").text() for term in proof / "terms"]
        if len({*names}) < len(names) and any(not term / "angle_deg" for term in proof / "terms"):
            raise NotCovered(proof / "terms")
        for term, row in zip(proof / "terms", names):
            if (term / "response").text() != name:
                raise NotCovered(term)
            multiplier = (term / "x").number() + J * (term / "y").number()
            price = largest(rows.get(row, ZERO), abs(multiplier))
            limits += [Limit(term, program.part(term), multiplier, price)] if price.high > 0 else []
        least, believed = excess(program, limits, proof, implied)
        if believed:
            yield "reach", implied, None, ONE
        yield "smallest", lowest, least, ONE
        if least is not None:
            yield EVIDENCE, proof, None, ONE
            yield EVIDENCE, implied, None, ONE
        value, above = (entry / "smallest").number(), (entry / "smallest").number() - lowest.number()
        yield "smallest", entry / "smallest", above + SPECK * abs(value), abs(value)
        kind = name.partition(":")[0]
        size = largest(*(_at_rest(part, kind) + _scatter(part, kind, program.off) for part in program.parts.values()))
        room = size * real(SMALLEST) + SPECK * abs(value) - above
        # where rounding of what the limits allow is more than that, nothing is told
        yield "smallest", entry / "smallest", None if room.high < 0 and least is None else room, size

    def _under_a_ceiling(self, entry: Place) -> Claims:
        name, field = (entry / "response").text(), (entry / "ceiling_field").text()
        limit = self.request / "objective" / field
        if not limit or field not in (CEILINGS.get(name), *LOADED.get(name.partition(":")[0], ())):
            yield "smallest", entry / "response", -limit.number(1.0), limit.number(1.0)
            return
        ceilings = [_allowed(part, limit, field, name) for part in self._alone(name).parts.values()]
        off = min((abs((entry / "ceiling").number() - most) for most in ceilings), key=lambda number: number.low)
        yield "smallest", entry / "ceiling", largest(*ceilings) * real(PRINTED) - off, largest(*ceilings)
        yield same("smallest", entry / "ceiling_field", field)
        yield same("smallest", entry / "response", name)
        yield from self._peak("smallest", name, entry / "lower_bound", entry / "smallest", entry / "multipliers")

    def _peak(self, claim: str, name: str, lowest: Place, attained: Place, proof: Place) -> Claims:
        """The bound by its multipliers; what is reached is above it by no more than a share of what is there before."""
        if any((term / "response").text() != name for term in proof / "terms"):
            raise NotCovered(proof / "terms")
        program, implied = self._alone(name), implied_alone(self.verdict, name, self.implied)
        # by itself: a ceiling proves nothing of it
        free = Place({**(proof.value or {}), "ceilings": []}, *proof.path)
        bound = program.bound(free, program.terms(free), implied)
        yield from by_cuts(claim, lowest, bound, implied, proof, mixed=program.mixed)
        value, above = attained.number(), attained.number() - lowest.number()
        yield claim, attained, above + SPECK * abs(value), abs(value)
        size = largest(*(_at_rest(part, name) + _scatter(part, name, program.off) for part in program.parts.values()))
        if bound[0] is not None and not bound[1] and not program.mixed:
            # no counterweights come below what is proven
            yield claim, attained, value + SPECK * abs(value) + real(WIDE) * size - bound[0], abs(value)
        room: Optional[Number] = size * real(SMALLEST) + SPECK * abs(value) - above
        if room is not None and room.high < 0:
            # where rounding of what the limits allow is more than that share, nothing is told
            reached = [_reachable(part, name, implied) for part in program.parts.values()]
            most = [number for number in reached if number is not None]
            if len(most) < len(reached) or (above - (SPECK + real(SAMPLE)) * largest(*most)).low <= 0:
                room = None
        yield claim, attained, room, size

    def _alone(self, name: str) -> Program:
        """The request with peaks of one kind as its objective, under no ceilings, as much in every case."""
        kind = name.partition(":")[0]
        if kind not in self._programs:
            weights = {f"{other}_weight": 1.0 if other == kind else 0.0 for other in KINDS}
            orders = (self.request / "objective" / "orders").text("first", "all", default="first")
            goal = {"orders": orders, "combine": "max", **weights}
            every = [{**case.value, "weight": 1.0} for case in scenarios(self.request)]
            body = {**self.request.value, "objective": goal, **dict.fromkeys(CASES), "scenarios": every}
            self._programs[kind] = Program(Place(body, *self.request.path), self.machine, Place(None))
        return self._programs[kind]


def _allowed(part: Part, limit: Place, field: str, name: str) -> Number:
    """Largest peak that a ceiling allows in a case."""
    allowed = limit.number(least=0)
    if field != "specific_load_ceiling_Pa":
        return allowed
    for entry in part.case.request / "machine" / "bearings":
        if (entry / "name").text() == name.partition(":")[2]:
            return allowed * (entry / "diameter_m").number() * (entry / "length_m").number()
    raise NotCovered(limit)


def _at_rest(part: Part, name: str) -> Number:
    """The peak without counterweights."""
    if name in ON_FRAME and not part.all:
        phasors = [corner.laden[name] for corner in part.machines]
        return largest(*(abs(co) + abs(counter) for co, counter in phasors))
    curve = part.loads.with_weights(name, part.machine.there)
    return real(peak_of(curve, part.goal).high + SAMPLE * part.loads.size_of(name)) * ABOUT_ONE


def _scatter(part: Part, name: str, off: Scatter) -> Number:
    """What unbalances that are off by themselves make of it."""
    return off.besides * total(map(abs, part.at(name, 0.0, ABOUT_ONE)))


def _reachable(part: Part, name: str, implied: Place) -> Optional[Number]:
    """What all that the limits allow makes at most; None where there is no limit."""
    reach = total([])
    for web, factor in zip(part.exact.webs, part.at(name, 0.0, ABOUT_ONE)):
        mass = part.exact.reach(web, implied)
        if mass is None:
            return None
        reach = reach + abs(factor) * (real(web.plate.lever(0.0)) * ABOUT_ONE if web.plate else web.radius) * mass
    return reach
