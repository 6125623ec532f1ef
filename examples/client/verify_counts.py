"""How many counterweights, or different masses, against what they come to at least.

What every point comes to is evaluated, and that it is so many. The search behind a bound is not repeated: it is broken
where another point contradicts it, and not covered else.
"""

from __future__ import annotations

from typing import List, NamedTuple, Optional

from verify_answer import Fitted, fitted
from verify_bearings import within
from verify_ceilings import margins
from verify_claims import Claims, covered, near, same
from verify_first import heavy_enough
from verify_levels import WIDE
from verify_machine import NAMES, Machine, Mass
from verify_nominal import fixed_alone
from verify_numbers import ONE, ZERO, Place, real
from verify_trades import Trade
from verify_values import Range, Value
from verify_weights import SAME, castings, catalogue, usual_gap

#: fields of a request that say what is counted
COUNTED = " counts of least "
STATUSES = ("optimal", "inaccurate", "infeasible")
#: webs that have a counterweight, and different masses
PIECES, SIZES = ("weights", "pieces"), ("part_numbers", "sizes")
#: of the value where a ceiling may be exceeded by its tolerance
_SLACK = 1e-7


class _Point(NamedTuple):
    """So many at most, what they come to, what is proven, and how many there are of either kind."""

    place: Place
    at_most: int
    value: Optional[float]
    bound: Optional[float]
    weights: int
    sizes: int


class _Count:
    """What is counted, and what is to be small."""

    def __init__(self, request: Place, machine: Machine) -> None:
        self.request, self.machine, stated = request, machine, request / "counts"
        self.of = (stated / "of").text(*PIECES, *SIZES)
        self.least = (stated / "least").text("objective", "mass", default="objective")
        both = Place({**request.value, "counts": None, "responses": ["objective", "mass"]}, *request.path)
        self.trade = Trade(both, machine)
        bare = iter(machine.there)
        turning = [next(bare) if web.fixed else Mass(ZERO, ONE, ZERO, web.position) for web in machine.webs]
        self.rest = self.trade.value("objective", Fitted(turning, [], machine.fixed, ZERO))

    def value(self, there: Fitted) -> Range:
        return self.trade.value(self.least, there)


def counted(request: Place, machine: Machine, curve: Place) -> Claims:
    """One front: its points, and what these contradict."""
    count, points = _Count(request, machine), list(curve / "points")
    yield same("counts", curve / "of", count.of)
    yield same("counts", curve / "least", count.least)
    entries = []
    for place in points:
        entry = yield from _point(count, place)
        entries.append(entry)
    numbers = [entry.at_most for entry in entries]
    rising = bool(numbers) and all(a < b for a, b in zip(numbers, numbers[1:]))
    yield "counts", curve / "points", ONE if rising else -ONE, ONE
    states = [(place / "status").text(*STATUSES) for place in points]
    whole = "infeasible" if {*states} <= {"infeasible"} else "inaccurate" if "inaccurate" in states else "optimal"
    yield same("status", curve / "status", whole)
    for entry in entries:
        yield from _contradicted(count, entry, entries)


def _point(count: _Count, place: Place) -> Claims:
    """One point; returns what it claims."""
    request, machine, at_most = count.request, count.machine, (place / "at_most").whole(least=0)
    yield "counts", place / "at_most", ONE, ONE
    if (place / "status").text(*STATUSES) == "infeasible":
        for field in ("value", "lower_bound", "relative_gap", "weights", "part_numbers", "total_mass_kg"):
            yield same("status", place / field, None)
        for field in ("counterweights", "balance_shafts"):
            yield "status", place / field, -ONE if list(place / field) else ONE, ONE
        yield from (same("status", place / f"{name}_peak_{unit}", None) for name, unit in NAMES.items())
        return _Point(place, at_most, None, None, 0, 0)
    optimal, design = (place / "status").value == "optimal", request / "machine"
    there: Fitted = yield from fitted(request, machine, place / "counterweights", place / "balance_shafts")
    for shaft, own in [(design, place), *zip(design / "balance_shafts", place / "balance_shafts")]:
        yield from heavy_enough(shaft, own / "counterweights")
    yield from catalogue(design, place)
    bare = fixed_alone(machine, there)
    sides = ([Value(part, side, count.trade.off) for part in count.trade.limited] for side in (there, bare))
    yield from covered(margins(place / "counterweights", *sides, optimal))
    masses = [(entry / "mass_kg").double() for _, entry in castings(design, place)]
    weights, sizes = sum(mass > 0 for mass in masses), _sizes(masses)
    yield same("counts", place / "weights", weights)
    yield same("counts", place / "part_numbers", sizes)
    used = weights if count.of in PIECES else sizes
    yield "counts", place / "at_most", real(at_most - used), ONE
    yield near("total_mass", place / "total_mass_kg", there.mass)
    if place / "balance_shafts_mass_kg":
        yield near("total_mass", place / "balance_shafts_mass_kg", there.on_shafts_mass)
    left = machine.responses(there.first)
    for name, unit in NAMES.items():
        co, counter = left[name]
        yield near("after", place / f"{name}_peak_{unit}", abs(co) + abs(counter))
    value, bound, relative = count.value(there), place / "lower_bound", place / "relative_gap"
    off = WIDE * (max(count.rest.high, value.high) if count.least == "objective" else value.high)
    yield within("objective", place / "value", value.low, value.high, off)
    lowest = bound.double() if bound else None
    size = count.rest if count.least == "objective" else value
    if relative and lowest is not None and size.low > 0:
        above = (place / "value").double() - lowest
        yield within("gap", relative, above / size.high, above / size.low, WIDE)
    if optimal:
        most = (request / "accuracy" / "relative_gap").number(usual_gap(design), least=0)
        yield "status", place / "status", most - relative.number() if relative else -ONE, ONE
    else:
        yield "status", place / "status", ONE, ONE
    return _Point(place, at_most, (place / "value").double(), lowest, weights, sizes)


def _sizes(masses: List[float]) -> int:
    """Different masses."""
    different: List[float] = []
    for mass in masses:
        if mass > 0 and all(abs(mass - other) > SAME * mass for other in different):
            different.append(mass)
    return len(different)


def _contradicted(count: _Count, entry: _Point, entries: List[_Point]) -> Claims:
    """No other point that is as few is below what is proven of one, nor is there any where none keeps the ceilings."""

    def within_limit(other: _Point) -> bool:
        used = other.weights if count.of in PIECES else other.sizes
        return other.value is not None and used <= entry.at_most

    values = [other.value for other in entries if within_limit(other) and other.value is not None]
    if entry.value is None:
        broken = any((other.place / "status").value == "optimal" and within_limit(other) for other in entries)
        yield "counts", entry.place / "status", -ONE if broken else None, ONE
    if entry.bound is not None:
        room = min(values, default=entry.bound) - entry.bound
        size = max(abs(entry.bound), count.rest.high if count.least == "objective" else 0.0)
        is_broken = room < -(WIDE + _SLACK) * size
        yield "lower_bound", entry.place / "lower_bound", real(room) if is_broken else None, real(size)
