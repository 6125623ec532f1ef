"""Ceilings on what counterweights leave over a revolution, or in any of several cases: kept, and which are touched."""

from __future__ import annotations

from copy import copy
from math import isnan, nan
from typing import Dict, Iterator, NamedTuple, Sequence

from verify_claims import Claims
from verify_first import CEILING
from verify_numbers import Place, real
from verify_program import CEILINGS, Statement, weighed
from verify_values import Value
from verify_weights import TOUCHED, UNSURE

#: fields of an objective that limit loads of the shaft
LOADED = ("bearing_ceiling_N", "specific_load_ceiling_Pa", "bending_ceiling_Nm")


class Limited(NamedTuple):
    """A ceiling by its name in the answer, what it allows, and the response."""

    limit: str
    most: float
    response: str


def limited(value: Value) -> Iterator[Limited]:
    """All that the objective of a machine limits."""
    goal = value.part.goal
    for response, field in CEILINGS.items():
        if goal / field:
            yield Limited(field.rpartition("_")[0], (goal / field).double(least=0), response)
    load, specific, bending = (goal / f"{name}" for name in LOADED)
    for name in value.part.turn.bearings:
        if load:
            yield Limited("bearing_ceiling", load.double(least=0), f"bearing:{name}")
        if specific:
            area = value.part.area[name].middle().real
            yield Limited("specific_load_ceiling", specific.double(least=0) * area, f"bearing:{name}")
    for plane in value.part.loads.planes if bending else ():
        yield Limited("bending_ceiling", bending.double(least=0), f"bending:{plane!r}")


def _called(value: Value, response: str) -> float:
    """What a ceiling is measured by where nothing is there and nothing allowed: what is weighed calls for that much."""
    machine, goal = copy(value.part.machine), value.part.goal
    machine.webs = [*machine.webs, *(place.web for place in value.part.geared)]
    sizes = Statement(machine, goal, {"sum": weighed(goal, machine)}).sizes
    return float(sizes[response]) if response in sizes else 0.0


def margins(place: Place, there: Sequence[Value], rest: Sequence[Value], optimal: bool) -> Claims:
    """That an optimal answer keeps the ceilings; returns which share of each is left at least."""
    rooms: Dict[str, float] = {}
    for value, nothing in zip(there, rest):
        for limit, most, response in limited(value):
            peak = value.under(response)
            # broken is what exceeds the ceiling for certain, as in the first order
            room = most - peak.low
            if room < 0:
                bare = nothing.under(response)
                size = max(most, bare.high)
                room += CEILING * (size if most > 0 or bare.low > 0 else max(size, _called(value, response)))
            yield "ceilings", place, real(room) if optimal or room >= 0 else None, real(max(most, peak.high))
            # a ceiling that the rounding of what cancels comes near to may be listed or not
            unsure = peak.high - peak.low > UNSURE * most
            share = nan if unsure else 1 - peak.high / most if most > 0 else 0.0
            rooms[limit] = _tighter(rooms.get(limit, share), share)
    return rooms


def _tighter(first: float, second: float) -> float:
    """The smaller room; where one of them is not told, the other only if it is none."""
    rooms = [room for room in (first, second) if not isnan(room)]
    least = min(rooms, default=nan)
    return least if len(rooms) == 2 or least <= TOUCHED - UNSURE else nan
