"""Goals in their order: what each came to by itself, what is proven of it, and the limit that the answer keeps.

The value of a goal is that of counterweights that the answer need not have: those after it may take what it allows.
So it lies between its bound and its limit. The bound is proven by multipliers where any masses may be.
"""

from __future__ import annotations

from typing import List, Sequence

from verify_answer import Fitted
from verify_bearings import within
from verify_claims import Claims, same
from verify_numbers import COSTS, ONE, Place, real
from verify_values import Range, Value, most
from verify_weights import SAME, castings

#: share of a goal without counterweights by which brackets are wide
WIDE = 2e-9
#: least share of it that a goal leaves to those after it
ALLOWANCE = 1e-6


def levels(
    request: Place, answer: Place, own: Sequence[str], there: Sequence[Value], rest: Sequence[Value], fitted: Fitted
) -> Claims:
    """Every goal that an answer lists. ``rest``: without counterweights."""
    proof, order = answer / "certificate", list(request / "objective" / "priorities")
    entries, names = list(proof / "goals"), [(item / "goal").text() for item in order]
    labels = [(item / "goal").text() for item in entries]
    places = [names.index(item) for item in labels if item in names]
    # a cost of which no choice was found is left out
    must = [item for item in names[: max(n for n, item in enumerate(names) if item not in COSTS)] if item not in COSTS]
    right = len(places) == len(labels) and places == sorted({*places}) and {*must} <= {*labels}
    yield "goals", proof / "goals", ONE if right else -ONE, ONE
    for place, name in zip(entries, labels) if right else ():
        yield same("goals", place / "goal", name)
        last, allowance = name == labels[-1], (order[names.index(name)] / "allowance").double(0.0, least=0)
        if name in COSTS:
            yield from _cost(name, place, request, answer, fitted, last)
            continue
        value, nothing = (most([item.goal(name) for item in side]) for side in (there, rest))
        yield from _goal(place, value, nothing, allowance)
        if (answer / "status").value == "optimal" and not last and not _searched(proof):
            yield from _closed(place, nothing, allowance)
        if name == own[-1]:
            yield from _bound(place, proof / "lower_bound", proof)


def _goal(place: Place, peak: Range, rest: Range, allowance: float) -> Claims:
    """One of the machine."""
    value, off = (place / "value").double(), WIDE * rest.high
    wide, low = max(allowance, ALLOWANCE) * rest.high, max(value, peak.low)
    if rest.low <= 0 and (place / "limit").double() >= low - off:
        # where all cancels an allowance is a share of what counterweights could make of it
        yield "goals", place / "limit", None, ONE
    else:
        yield within("goals", place / "limit", low, value + wide, off)
    lowest = place / "lower_bound"
    above = value - lowest.double() + off if lowest else 0.0
    yield "goals", place / "value", ONE if above >= 0 else -ONE, ONE


def _closed(place: Place, rest: Range, allowance: float) -> Claims:
    """An earlier goal of an optimum: near its bound, above which the goals after it may use what is allowed."""
    value, limit, lowest = ((place / name).double(0.0) for name in ("value", "limit", "lower_bound"))
    if rest.low <= 0 or not place / "lower_bound":
        return
    off, most = WIDE * rest.high, max(allowance, ALLOWANCE) * rest.high
    yield "goals", place / "value", ONE if value <= lowest + ALLOWANCE * rest.high + off else -ONE, ONE
    yield "goals", place / "limit", ONE if limit <= max(value, lowest + most) + off else -ONE, ONE


def _searched(proof: Place) -> bool:
    return bool(proof / "nodes") or bool(proof / "continuous_lower_bound")


def _bound(place: Place, own: Place, proof: Place) -> Claims:
    """Of what the certificate proves as well, where no choices were searched."""
    searched = _searched(proof)
    if place / "lower_bound":
        alike = own and (place / "lower_bound").double() == own.double()
        yield "goals", place / "lower_bound", None if searched else ONE if alike else -ONE, ONE


def _cost(name: str, place: Place, request: Place, answer: Place, fitted: Fitted, last: bool) -> Claims:
    """What castings cost: their mass, with those fixed, their number or their sizes, without."""
    proof, items = answer / "certificate", [item for _, item in castings(request / "machine", answer)]
    masses = sorted((item / "mass_kg").double() for item in items if (item / "mass_kg").double() > 0)
    comes_to = {
        "mass": float(fitted.mass + fitted.on_shafts_mass),
        "pieces": float(len(masses)),
        "sizes": float(_sizes(masses)),
    }[name]
    value, limit = (place / "value").double(), (place / "limit").double()
    off = SAME * comes_to
    yield "goals", place / "limit", real(min(limit - comes_to, limit - value) + off), ONE
    least = (place / "lower_bound").double(value)
    yield "goals", place / "value", real(min(value - least, off - abs(value - comes_to) if last else off) + off), ONE
    if name == "mass":
        yield from _bound(place, proof / "mass_lower_bound_kg", proof)
    elif place / "lower_bound":
        yield "goals", place / "lower_bound", None, ONE


def _sizes(masses: List[float]) -> int:
    return sum(n == 0 or mass - masses[n - 1] > SAME * mass for n, mass in enumerate(masses))
