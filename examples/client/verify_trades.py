"""Fronts of any two or three responses: what every point comes to, in the worst of all cases.

The answer has no multipliers of them: what is proven of corners, ends and masses is not covered, but for what a point
of the front itself contradicts.
"""

from __future__ import annotations

from typing import Dict, List, NamedTuple, Optional, Sequence

from verify_answer import Fitted, fitted
from verify_bearings import within
from verify_cases import scatter, without_cases
from verify_ceilings import margins
from verify_claims import Claim, Claims, covered, near, same
from verify_cuts import FIELDS, Part
from verify_first import searched
from verify_levels import WIDE
from verify_machine import NAMES, ON_FRAME, Machine, Mass
from verify_multipliers import Program
from verify_nominal import fixed_alone
from verify_numbers import ABOUT_ONE, ONE, SPECK, ZERO, Number, Place, Unreadable, real
from verify_values import Range, Value, most
from verify_weights import usual_gap

#: fields of a request that names responses
TRADED = f" responses {FIELDS} bearing_measure "
#: responses inside the shaft, and the roll moment, by the kinds of their weights
INSIDE = {"bearings": "bearing", "bending": "bending", "roll": "roll"}
#: a peak without counterweights above this share of the reference value is that value
SHARE = 1e-6
STATUSES = ("optimal", "inaccurate")


class _Worth(NamedTuple):
    """What a point claims: its values, its corner, and where this stands."""

    values: List[float]
    corner: List[Optional[float]]
    places: List[Place]


class Trade:
    """The responses that are traded, each as the objective of a program."""

    def __init__(self, request: Place, machine: Machine) -> None:
        self.request, self.machine = request, machine
        self.names = [item.text(*ON_FRAME, *INSIDE, "mass", "objective") for item in request / "responses"]
        self.worst = {name: _parts(request, machine, name) for name in self.names if name != "mass"}
        nominal = without_cases(request)
        self.nominal = {name: _parts(nominal, machine, name) for name in self.names if name != "mass"}
        self.off, self.exact = scatter(request), scatter(nominal)
        #: under the ceilings
        self.limited = [*Program(_limited(request), machine, Place(None)).parts.values()]

    def value(self, name: str, there: Fitted, is_worst: bool = True) -> Range:
        """What a response comes to."""
        if name == "mass":
            mass = there.mass + there.on_shafts_mass
            return Range(float(Number(mass.low, mass.low)), float(mass))
        parts, off = (self.worst[name], self.off) if is_worst else (self.nominal[name], self.exact)
        return most([Value(part, there, off).goal("all" if name == "objective" else _goal(name)) for part in parts])

    def unit(self, name: str) -> str:
        """Of its values."""
        specific = (self.request / "objective" / "bearing_measure").value == "specific"
        own = {"bearings": "Pa" if specific else "N", "bending": "N m", "roll": "N m", "mass": "kg"}
        own["objective"] = "as weighed"
        return own.get(name) or {"N": "N", "Nm": "N m"}[ON_FRAME[name].unit]


def _goal(name: str) -> str:
    return name if name in ("bearings", "bending") else "external"


def _parts(request: Place, machine: Machine, name: str) -> List[Part]:
    """The machines of all cases, with one response as their objective."""
    goal = dict((request / "objective").value or {})
    goal.update(priorities=[])
    if name != "objective":
        kinds = [*ON_FRAME, *INSIDE.values()]
        goal.update({f"{kind}_weight": 1.0 if kind == INSIDE.get(name, name) else 0.0 for kind in kinds})
    if not goal.get("bearing_weight"):
        goal.pop("bearing_measure", None)
    program = Program(Place({**request.value, "objective": goal}, *request.path), machine, Place(None))
    return [*program.parts.values()]


def _limited(request: Place) -> Place:
    """The request without an order of its goals."""
    goal = {**((request / "objective").value or {}), "priorities": [], "bearing_weight": 0.0, "bearing_measure": None}
    return Place({**request.value, "objective": goal}, *request.path)


def traded(request: Place, machine: Machine, curve: Place) -> Claims:
    """One front: its responses, its points, and what these contradict."""
    trade = Trade(request, machine)
    entries, points = list(curve / "responses"), list(curve / "points")
    if len(entries) != len(trade.names):
        raise Unreadable((*curve.path, "responses"), "must hold one entry for each response of the request")
    nothing = _nothing(machine)
    rest = {name: trade.value(name, nothing) for name in trade.names}
    for name, entry in zip(trade.names, entries):
        yield same("trades", entry / "response", name)
        yield same("trades", entry / "unit", trade.unit(name))
        low, high = rest[name]
        yield within("before", entry / "without_counterweights", low, high, WIDE * high)
        size, least = (entry / "yardstick").double(), (entry / "lower_bound").double()
        # what is fixed is no part of the reference value of the mass
        if name != "mass" and high > SHARE * size:
            yield within("yardstick", entry / "yardstick", low, high, WIDE * high)
        else:
            yield "yardstick", entry / "yardstick", None if size > 0 else -ONE, ONE
        yield _unless("trades", entry / "lower_bound", (entry / "smallest").double() - least, size)
    worth = []
    for entry in points:
        claim = yield from _point(trade, entries, rest, entry)
        worth.append(claim)
    for n, (entry, own) in enumerate(zip(points, worth)):
        yield _beaten(entry / "beaten_by", [claim.values for claim in worth], n)
        # nobody is below a corner in all of its values
        below = max(_above(own.corner, claim.values) for claim in worth)
        yield from (_unless("corner", place, -below, 1.0) for place in own.places)
        for value, response in zip(own.values, entries):
            size = (response / "yardstick").double()
            yield _unless("trades", response / "lower_bound", value - (response / "lower_bound").double(), size)
    states = [(entry / "status").text(*STATUSES) for entry in points]
    status, worst = (curve / "status").value, "inaccurate" if "inaccurate" in states else "optimal"
    # ends that are not closed, or a search that time ended, leave a front open whose points all are closed
    open_ended = status == "inaccurate" and worst == "optimal"
    yield "status", curve / "status", None if open_ended else ONE if status == worst else -ONE, ONE
    if len(trade.names) == 2:
        for first, second, entry in zip(worth, worth[1:], points[1:]):
            yield "front", entry / "values", ONE if first.values <= second.values else -ONE, ONE


def _nothing(machine: Machine) -> Fitted:
    """What is on a machine without counterweights."""
    fixed = iter(machine.there)
    turning = [next(fixed) if web.fixed else Mass(ZERO, ONE, ZERO, web.position) for web in machine.webs]
    return Fitted(turning, [], machine.fixed, ZERO)


def _unless(claim: str, place: Place, room: float, size: float) -> Claim:
    """What is contradicted, and not covered else."""
    broken = room < -WIDE * abs(size)
    return claim, place, real(room) if broken else None, real(abs(size))


def _above(corner: Sequence[Optional[float]], values: Sequence[float]) -> float:
    """By which share of itself a corner is above values in the least."""
    return min(
        (-1.0 if bound is None else (bound - value) / max(abs(bound), abs(value), 1e-300) - WIDE)
        for bound, value in zip(corner, values)
    )


def _beaten(place: Place, values: Sequence[Sequence[float]], n: int) -> Claim:
    """The first point that is as small in every response and smaller in one."""
    better = [
        k
        for k, other in enumerate(values)
        if all(a <= b for a, b in zip(other, values[n])) and any(a < b for a, b in zip(other, values[n]))
    ]
    return same("front", place, better[0] if better else None)


def _point(trade: Trade, entries: Sequence[Place], rest: Dict[str, Range], answer: Place) -> Claims:
    """One point; returns what it claims."""
    request, machine, proof = trade.request, trade.machine, answer / "certificate"
    optimal = (answer / "status").text(*STATUSES) == "optimal"
    there: Fitted = yield from fitted(request, machine, answer / "counterweights", answer / "balance_shafts")
    yield from covered(searched(request / "machine", answer, proof))
    yield near("total_mass", answer / "total_mass_kg", there.mass)
    if answer / "balance_shafts_mass_kg":
        yield near("total_mass", answer / "balance_shafts_mass_kg", there.on_shafts_mass)
    bare = fixed_alone(machine, there)
    sides = ([Value(part, side, trade.off) for part in trade.limited] for side in (there, bare))
    yield from covered(margins(answer / "counterweights", *sides, optimal))
    left = machine.responses(there.first)
    for name, unit in NAMES.items():
        co, counter = left[name]
        yield near("after", answer / f"{name}_peak_{unit}", abs(co) + abs(counter))
    values = yield from _values("trades", trade, answer / "values", there, rest, True)
    if answer / "nominal_values":
        yield from _values("trades", trade, answer / "nominal_values", there, rest, False)
    corner = [None if item.value is None else item.double() for item in proof / "corner"]
    if len(corner) != len(values):
        raise Unreadable((*proof.path, "corner"), "must hold one value for each response")
    sizes, relative, shares = [(entry / "yardstick").double() for entry in entries], proof / "relative_gap", []
    for value, bound, size in zip(values, corner, sizes):
        shares += [] if bound is None or size <= 0 else [(value - bound) / size]
    if relative:
        slack = WIDE + max((abs(value) / size for value, size in zip(values, sizes) if size > 0), default=0.0) * 1e-12
        yield within("gap", relative, max(shares, default=0.0), max([0.0, *shares]), slack)
    if optimal:
        least = (request / "accuracy" / "relative_gap").number(usual_gap(request / "machine"), least=0)
        yield "status", answer / "status", least - relative.number() if relative else -ONE, ONE
    else:
        yield "status", answer / "status", ONE, ONE
    yield from _mass(proof, there)
    return _Worth(values, corner, [*(proof / "corner")])


def _values(claim: str, trade: Trade, place: Place, there: Fitted, rest: Dict[str, Range], is_worst: bool) -> Claims:
    """What the responses come to, in their order; returns them as they are printed."""
    items = list(place)
    if len(items) != len(trade.names):
        raise Unreadable(place.path, "must hold one value for each response")
    for name, item in zip(trade.names, items):
        low, high = trade.value(name, there, is_worst)
        yield within(claim, item, low, high, WIDE * max(rest[name].high, high))
    return [item.double() for item in items]


def _mass(proof: Place, there: Fitted) -> Claims:
    """What is proven of the mass has no multipliers; its gap is a difference of what is printed."""
    least, gap, mass = proof / "mass_lower_bound_kg", proof / "mass_relative_gap", there.mass + there.on_shafts_mass
    if not least or not gap:
        return
    above = mass + SPECK * mass - least.number()
    yield "mass_lower_bound", least, above if above.high < 0 else None, mass
    claim, place, room, size = near("mass_gap", gap, above * ABOUT_ONE / mass if mass.low > 0 else mass)
    # where next to nothing is there, it is a share of another mass
    yield claim, place, None if room is None or room.high < 0 else room, size
