"""Fronts of force and moment of several scenarios, or where something may be off: peaks are those of the worst case."""

from __future__ import annotations

from typing import Dict, Iterator, NamedTuple, Optional, Tuple

from verify_answer import MASS_GAP, Fitted, fitted
from verify_bearings import within
from verify_ceilings import margins
from verify_claims import EVIDENCE, Claim, Claims, covered, near
from verify_first import light
from verify_levels import WIDE
from verify_machine import NAMES, ON_FRAME, Machine
from verify_multipliers import Program
from verify_nominal import fixed_alone
from verify_numbers import ABOUT_ONE, ONE, SPECK, ZERO, Number, Place, largest, real, total
from verify_values import Value, most, off_sizes
from verify_weights import active_limits, usual_gap

#: price of the mass where it has none; rows keep their multipliers beside it
FREE = Number(0, 0)
#: by the name of a peak
Peaks = Dict[str, Number]


class _Proof(NamedTuple):
    """What is proven beyond some rows, what these are worth, and whether implied limits are believed."""

    beyond: Number
    worth: Number
    believed: bool


class WorstFront:
    """What one front trades: the larger of both peaks in the worst case, and either by itself."""

    def __init__(self, request: Place, machine: Machine) -> None:
        self.request, self.machine = request, machine
        self.joint = _program(request, machine, tuple(NAMES))
        self.alone = {name: _program(request, machine, (name,)) for name in NAMES}
        self.parts = [*self.joint.parts.values()]

    def peaks(self, there: Fitted) -> Peaks:
        """Of what is fitted, as they are weighed across the shaft, in the worst scenario."""
        values = {}
        for name, program in self.alone.items():
            parts = [(part, part.placed(there).first, off_sizes(part, there)) for part in program.parts.values()]
            values[name] = largest(*(part.value(first, program.off, sizes) for part, first, sizes in parts)) * ABOUT_ONE
        return values

    @property
    def at_rest(self) -> Peaks:
        """Without counterweights."""
        values = {}
        for name, program in self.alone.items():
            nothing = [ZERO for _ in program.webs]
            peaks = (part.value(part.machine.there, program.off, nothing) for part in program.parts.values())
            values[name] = largest(*peaks) * ABOUT_ONE
        return values

    def reachable(self, name: str) -> Optional[Number]:
        """What counterweights could make a peak in the worst scenario; None where they have no limits."""
        parts = [*self.alone[name].parts.values()]
        reached = [part.exact.reachable(Place({})) for part in parts]
        most = [size for size in reached if size is not None]
        return largest(*most, *(part.machine.square for part in parts)) if len(most) == len(parts) else None

    def proven(
        self, program: Program, proof: Place, implied: Place, values: Peaks, cost: Number = FREE
    ) -> Optional[_Proof]:
        """What multipliers prove beyond rows that come to values by the peaks that they are of.

        A corner is a mean of its peaks, by the multipliers of their rows.
        """
        terms, of = program.terms(proof), {}
        for term, entry in zip(terms, proof / "terms"):
            of[term.row] = (entry / "response").text(*NAMES)
        rows = {(entry / "name").text(): (entry / "value").number(least=0) for entry in proof / "rows"}
        rows = {name: value for name, value in rows.items() if value.low > 0 and name in of}
        if not rows:
            return None
        worth = total(value * values[of[name]] for name, value in rows.items())
        least, believed = program.bound(proof, terms, implied, cost, worth / total(rows.values()))
        return None if least is None else _Proof(least, worth, believed)


def _program(request: Place, machine: Machine, names: Tuple[str, ...]) -> Program:
    """The request with the larger of some peaks as its objective."""
    weights = {f"{name}_weight": 1.0 if name in names else 0.0 for name in ON_FRAME}
    goal = {**((request / "objective").value or {}), **weights, "combine": "max"}
    return Program(Place({**request.value, "objective": goal}, *request.path), machine, Place(None))


def worst_curve(request: Place, machine: Machine, curve: Place) -> Claims:
    """The scale of one front, its points, and what is proven of its ends."""
    front, scale, ends = WorstFront(request, machine), curve / "scale", curve / "ends"
    rest, implied = front.at_rest, curve / "implied_max_mass_kg"
    for name, unit in NAMES.items():
        yield _scale(front, name, rest[name], scale / f"{name}_{unit}")
    for entry in curve / "points":
        yield from covered(_point(front, scale, entry))
    for name, unit in NAMES.items():
        lowest, proof = ends / f"smallest_{name}_lower_bound_{unit}", ends / "multipliers" / f"smallest_{name}"
        own = _of(proof, name)
        of = front.proven(front.alone[name], own, implied, {name: lowest.number(0.0)}) if proof else None
        yield from _claimed(f"smallest_{name}", lowest, of, proof, implied, front.joint.mixed)


def _of(proof: Place, name: str) -> Place:
    """A proof without what belongs to the other peak, where that is nothing."""
    if not proof:
        return proof
    terms = [
        term.value
        for term in proof / "terms"
        if (term / "response").value == name or abs((term / "x").double()) + abs((term / "y").double()) > 0
    ]
    return Place({**proof.value, "terms": terms}, *proof.path)


def _scale(front: WorstFront, name: str, rest: Number, place: Place) -> Tuple[str, Place, Optional[Number], Number]:
    """The peak without counterweights, or where that is next to nothing at most what they could make it."""
    size = place.number()
    if rest.low > (size * real(1e-6)).high:
        return near("yardstick", place, rest)
    reach = front.reachable(name)
    return "yardstick", place, None if reach is None else reach * ABOUT_ONE - size, size


def _point(front: WorstFront, scale: Place, answer: Place) -> Claims:
    """One point: nobody is below its corner in both peaks, whatever is off."""
    request, machine = front.request, front.machine
    optimal = (answer / "status").text("optimal", "inaccurate") == "optimal"
    there: Fitted = yield from fitted(request, machine, answer / "counterweights", answer / "balance_shafts")
    yield near("total_mass", answer / "total_mass_kg", there.mass)
    if answer / "balance_shafts_mass_kg":
        yield near("total_mass", answer / "balance_shafts_mass_kg", there.on_shafts_mass)
    bare = fixed_alone(machine, there)
    worst, rest = ([Value(part, side, front.joint.off) for part in front.parts] for side in (there, bare))
    rooms = yield from margins(answer / "counterweights", worst, rest, optimal)
    if machine.budget is not None:
        budget = float(machine.budget)
        rooms["max_total_mass"] = 1 - float(there.mass) / budget if budget > 0 else 0.0
    yield from active_limits("active_limits", answer / "active_limits", rooms)
    peaks, left = front.peaks(there), machine.responses(there.first)
    for name, unit in NAMES.items():
        co, counter = left[name]
        yield near("after", answer / f"{name}_peak_{unit}", abs(co) + abs(counter))
        yield near("objective", answer / f"weighted_{name}_peak_{unit}", peaks[name])
        peak, place = most([case.of_first_order(name) for case in worst]), answer / "worst_case" / f"{name}_peak_{unit}"
        yield within("worst_case", place, peak.low, peak.high, WIDE * peak.high)
    yield from _corner(front, scale, answer, peaks, optimal)
    yield from _mass(front, scale, answer, peaks, there, optimal)
    if not optimal:
        yield "status", answer / "status", ONE, ONE


def _corner(front: WorstFront, scale: Place, answer: Place, peaks: Peaks, optimal: bool) -> Claims:
    proof, worst, multipliers = answer / "certificate", ZERO, answer / "multipliers" / "objective"
    relative, corner = proof / "relative_gap", {}
    for name, unit in NAMES.items():
        place, size = proof / f"{name}_{unit}", (scale / f"{name}_{unit}").number()
        yield near("yardstick", proof / "yardstick" / f"{name}_{unit}", size)
        corner[name] = place.number(0.0)
        if place:
            above = peaks[name] + SPECK * peaks[name] - corner[name]
            worst = largest(worst, above * ABOUT_ONE / size)
            yield "gap", relative, relative.number() * size - above, peaks[name]
    if relative:
        yield near("gap", relative, worst)
    if optimal:
        most = (front.request / "accuracy" / "relative_gap").number(usual_gap(front.request / "machine"), least=0)
        yield "status", relative, most - relative.number() if relative else None, ONE
    implied = proof / "implied_max_mass_kg"
    of = front.proven(front.joint, multipliers, implied, corner) if multipliers else None
    yield from of_both(_claimed("corner", proof / "force_N", of, multipliers, implied, front.joint.mixed), proof)


def of_both(claims: Iterator[Claim], proof: Place) -> Claims:
    """What is proven of a corner stands in both of its peaks."""
    for claim, place, room, size in claims:
        yield claim, place, room, size
        if claim == "corner":
            yield claim, proof / "moment_Nm", room, size


def _mass(front: WorstFront, scale: Place, answer: Place, peaks: Peaks, there: Fitted, optimal: bool) -> Claims:
    """Nothing with peaks up to these, which the point keeps, is lighter."""
    proof, multipliers = answer / "certificate", answer / "multipliers" / "mass"
    place, mass, fixed = proof / "mass_lower_bound_kg", there.mass + there.on_shafts_mass, front.machine.fixed
    if not place:
        return
    limits = {name: proof / f"mass_{name}_limit_{unit}" for name, unit in NAMES.items()}
    up_to = {name: limit.number(0.0) for name, limit in limits.items()}
    implied, least = proof / "implied_max_mass_kg", place.number() - fixed
    rooms, open_ended = {name: up_to[name] - peaks[name] for name in up_to}, False
    if least.low <= 0:
        yield "mass_lower_bound", place, -least, ONE
        yield EVIDENCE, multipliers, None, ONE
    else:
        of = front.proven(front.joint, multipliers, implied, up_to, ONE) if multipliers else None
        of = None if of is None else of._replace(beyond=of.beyond - least, worth=place.number())
        open_ended = front.joint.mixed and of is not None and of.beyond.high < 0
        yield from _claimed("mass_lower_bound", place, of, multipliers, implied, front.joint.mixed)
    for name, limit in limits.items():
        if limit:
            # where it is not told what is proven, nor is for which peaks
            room = rooms[name]
            yield "mass_lower_bound", limit, None if open_ended and room.high >= 0 else room, peaks[name]
    first, size = front.parts[0], proof / "mass_yardstick_kg"
    if size and abs(size.number() - mass).low <= (mass * SPECK).high:
        yield near("yardstick", size, mass)
    elif not (first.geared or first.exact.caps or front.joint.mixed or len(front.parts) > 1):
        sizes = {name: (scale / f"{name}_{unit}").number() for name, unit in NAMES.items()}
        yield from light(first.exact, proof, sizes, there.mass)
    wide, gap = size.number(0.0), mass - place.number()
    yield near("mass_gap", proof / "mass_relative_gap", gap * ABOUT_ONE / wide if wide.low > 0 else ZERO)
    if optimal:
        yield "status", answer / "status", wide * real(MASS_GAP) - gap, wide


def _claimed(
    claim: str, place: Place, proof: Optional[_Proof], multipliers: Place, implied: Place, mixed: bool
) -> Claims:
    """``mixed``: how several changes of the masses share what is proven is not told."""
    if proof is not None and proof.believed:
        yield "reach", implied, None, ONE
    room = proof.beyond if proof is not None and place else None
    if mixed and room is not None and room.high < 0:
        room = None
    yield claim, place, room, ONE if proof is None else abs(proof.worth)
    if room is not None:
        yield EVIDENCE, multipliers, None, ONE
        yield EVIDENCE, implied, None, ONE
