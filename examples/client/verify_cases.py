"""The machines that one set of counterweights is to suit, what may be off, and goals in their order."""

from __future__ import annotations

from itertools import product
from math import radians, sin, sqrt
from typing import Any, Callable, Dict, Iterator, List, NamedTuple, Optional, Sequence

from verify_machine import Machine, Responses
from verify_numbers import ABOUT_ONE, COSTS, ONE, ZERO, NotCovered, Number, Place, Unreadable, largest, real, total
from verify_program import Statement


class Stated(NamedTuple):
    """What a field of a request states of cases: the names of its own fields, and the cases as scenarios."""

    fields: str
    scenarios: Callable[[Place], Iterator[Place]]


#: by field of a request
CASES: Dict[str, Stated] = {
    "scenarios": Stated("weight changes path value", lambda request: iter(request / "scenarios")),
    # beside this one
}
#: fields that say what may be off
OFF = " tolerances mass_relative unbalance_kg_m reciprocating_mass_relative "
#: fields that state cases
OF_CASES = "".join(f" {name} {case.fields} " for name, case in CASES.items())
#: fields of a request that are known here
FIELDS = f"{OFF}priorities goal allowance {OF_CASES}"
#: rows whose masses are off one way or the other, all ways of them
MOST_ROWS = 8
#: fields that say where the plane of the moments is
PLANES = ("position_m", "orbiting_position_m", "reference_plane_m")
#: the goal that a part of the objective belongs to
GOALS = {"bearing": "bearings", "bending": "bending"}


def scenarios(request: Place) -> List[Place]:
    """The cases of a request, as scenarios."""
    return [scenario for kind in CASES.values() for scenario in kind.scenarios(request)]


def without_cases(request: Place) -> Place:
    """A request about the unchanged machine, nothing off."""
    return Place({**request.value, **dict.fromkeys(CASES), "tolerances": None}, *request.path)


def uncertain(request: Place) -> bool:
    """Whether there are several cases, or anything may be off."""
    stated = (request / "tolerances").value
    off = isinstance(stated, dict) and any((request / "tolerances" / name).value for name in stated)
    return off or bool(scenarios(request))


class Scatter(NamedTuple):
    """What every unbalance may be off by, in any direction: a share of itself, and kg m besides."""

    share: Number
    besides: Number

    def of(self, factors: Sequence[Number], sizes: Sequence[Number]) -> Number:
        """What |start + sum of factors times unbalances| grows by at most."""
        return total(abs(factor) * (self.share * size + self.besides) for factor, size in zip(factors, sizes))


def scatter(request: Place) -> Scatter:
    """A mass off by up to d and an angle by up to a move an unbalance by max |(1 + d) e^{ja} - 1| of itself."""
    tolerances = request / "tolerances"
    mass, angle = (tolerances / "mass_relative").double(0.0, least=0), (tolerances / "angle_deg").double(0.0, least=0)
    if mass == 0 and angle == 0:
        return Scatter(ZERO, (tolerances / "unbalance_kg_m").number(0.0, least=0))
    if (request / "machine" / "web_groups").value:
        # equal castings are off each in its own way, which bounds of one pull for all do not tell
        raise NotCovered(request / "machine" / "web_groups")
    share = sqrt(mass**2 + 4 * (1 + mass) * sin(radians(min(angle, 180.0) / 2)) ** 2)
    return Scatter(real(share) * ABOUT_ONE, (tolerances / "unbalance_kg_m").number(0.0, least=0))


def corners(request: Place, machine: Machine) -> List[Machine]:
    """Every machine whose reciprocating masses are off by all that they may be; none where they are not off.

    A peak is convex in the masses, so it is largest at one of them.
    """
    field = request / "tolerances" / "reciprocating_mass_relative"
    share, rows = field.number(0.0, least=0), sum(mass.counter is not ZERO for mass in machine.masses)
    if share.high == 0 or rows == 0:
        return []
    if rows > MOST_ROWS:
        raise NotCovered(field)
    return [machine.off(signs) for signs in product((share, -share), repeat=rows)]


class Case(NamedTuple):
    """A machine, what its objective is multiplied by, and its name; none where there are no scenarios."""

    request: Place
    machine: Machine
    weight: Number
    name: Optional[str]


def cases(request: Place, machine: Machine, plane: Place) -> Iterator[Case]:
    """One of every scenario, or the unchanged machine."""
    places = scenarios(request)
    if not places:
        yield Case(request, machine, ONE, None)
    for scenario in places:
        body, has_shift = request.value, False
        for change in scenario / "changes":
            path = (change / "path").text().split("/")[1:]
            of_shafts = path[1:2] == ["balance_shafts"] and path[-1:][0] not in ("x_m", "y_m")
            if of_shafts or path[:1] != ["machine"]:
                # what is chosen for a shaft is told by the unchanged machine
                raise NotCovered(change / "path")
            body = with_value(body, path, (change / "value").value, request)
            has_shift |= path[-1] in PLANES
        changed = Place(body, *request.path)
        budget = changed / "machine" / "max_total_mass_kg"
        # with other planes the moments of a case may be about another one
        own = Machine(changed / "machine", changed / "objective", Place(None) if has_shift else plane, budget)
        yield Case(changed, own, (scenario / "weight").number(1.0, least=0), (scenario / "name").text())


def goals(request: Place) -> List[str]:
    """Goals that are met one after the other but for costs; one name for all of them where they are weighed."""
    goal_names = [(priority / "goal").text() for priority in request / "objective" / "priorities"]
    return [name for name in goal_names if name not in COSTS] or ["all"]


def goal_of(kind: str, goal_names: Sequence[str]) -> int:
    """Which goal a part of the objective belongs to."""
    name = goal_names[0] if goal_names == ["all"] else GOALS.get(kind, "external")
    return goal_names.index(name) if name in goal_names else 0


def nominal(machine: Machine, goal: Place, rows: Dict[str, Dict[str, Number]], responses: Responses) -> Number:
    """The objective of the first order, nothing off."""
    return largest(ZERO, *Statement(machine, goal, rows, capped=False).values(responses).values())


def with_value(body: Any, parts: Sequence[str], value: Any, place: Place) -> Any:
    """A copy of a body with another value at a JSON pointer (RFC 6901)."""
    if not parts:
        return value
    name = parts[0].replace("~1", "/").replace("~0", "~")
    if isinstance(body, list) and name.isdecimal() and len(name) < 6 and int(name) < len(body):
        k = int(name)
        return [*body[:k], with_value(body[k], parts[1:], value, place), *body[k + 1 :]]
    if not isinstance(body, (dict, type(None))) or len(parts) > 32:
        raise Unreadable(place.path, "a path leads to no field")
    return {**(body or {}), name: with_value((body or {}).get(name), parts[1:], value, place)}
