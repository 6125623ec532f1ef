"""Checks fronts and the rows of sweeps as well: each point, and each row, by what verify.py does with one answer.

    python verify_many.py request.json answer.json

Of a sweep, the answer is its rows as a JSON list or as NDJSON. The other verify*.py have to lie beside this file.
"""

from __future__ import annotations

import json
import sys
from functools import partial
from math import inf
from typing import Any, Iterator, Sequence

from verify import CEILING, before, ceilings, infeasible, light, lightest, optimum, priced_at, proven, smallest
from verify_claims import Claim, Claims, covered, judged, main, near
from verify_machine import NAMES, Machine
from verify_numbers import ABOUT_ONE, ONE, SPECK, NotCovered, Place, Unreadable, largest, read, real
from verify_program import CEILINGS, Statement
from verify_turn import single
from verify_weights import counterweights, usual_gap

__all__ = ["PLACES", "Unreadable", "main", "read", "verify"]

#: numbers and texts, of all points or rows together, that a service looks at in one request
PLACES = 200_000


def front(request: Place, answer: Place) -> Claims:
    """Fronts of force and moment, one for each budget."""
    request.known()
    asked, goal = request / "machine", request / "objective"
    yield from before(_machine(request, answer, asked / "max_total_mass_kg"), answer, answer / "without_counterweights")
    fronts, budgets = list(answer / "fronts"), list(request / "total_mass_budgets_kg")
    if len(fronts) != max(1, len(budgets)):
        raise Unreadable((*answer.path, "fronts"), "must hold one front for each budget")
    for each, budget in zip(fronts, budgets or [asked / "max_total_mass_kg"]):
        if (each / "status").text("optimal", "inaccurate", "infeasible") == "infeasible":
            yield from infeasible(request, answer, budget, each / "infeasibility")
            continue
        machine = _machine(request, answer, budget)
        statement = Statement(machine, goal, {name: {name: ONE} for name in NAMES})
        for name, unit in NAMES.items():
            yield _scale(Statement(machine, goal, {name: {name: ONE}}), each / "scale" / f"{name}_{unit}")
        for one in each / "points":
            yield from covered(point(statement, request, each / "scale", one))
        ends, implied = each / "ends", each / "implied_max_mass_kg"
        yield from covered(smallest(machine, goal, ends, ends / "multipliers", implied))


def _scale(statement: Statement, place: Place) -> Claim:
    """The peak without counterweights, or where that is next to nothing at most what they could make it."""
    machine, said = statement.machine, place.number()
    (rest,) = statement.values(machine.laden).values()
    most = statement.reachable(Place({}))
    if rest.low > (said * real(1e-6)).high:
        return near("yardstick", place, rest)
    if most is None:
        return "yardstick", place, None, ONE
    # where they make nothing, 1 kg m or 1 kg m^2 that turns with the shaft
    return "yardstick", place, largest(most, machine.square) * ABOUT_ONE - said, said


def _machine(request: Place, answer: Place, budget: Place) -> Machine:
    return Machine(request / "machine", answer / "reference_plane_m", budget)


def point(statement: Statement, request: Place, scale: Place, answer: Place) -> Claims:
    """One point of a front: nobody is below its corner in both weighted peaks."""
    proof, multipliers, status = answer / "certificate", answer / "multipliers", answer / "status"
    implied, place = proof / "implied_max_mass_kg", answer / "counterweights"
    optimal = status.text("optimal", "inaccurate") == "optimal"
    weights, mass = yield from counterweights(statement.machine, place)
    yield near("total_mass", answer / "total_mass_kg", mass)
    yield from ceilings(statement, weights, place, optimal)
    after = statement.machine.responses(weights)
    peaks = statement.values(after)
    relative = proof / "relative_gap"
    for name, unit in NAMES.items():
        co, counter = after[name]
        yield near("after", answer / f"{name}_peak_{unit}", abs(co) + abs(counter))
        yield near("objective", answer / f"weighted_{name}_peak_{unit}", peaks[name])
        corner, size = proof / f"{name}_{unit}", (scale / f"{name}_{unit}").number()
        if corner:
            # the point is above its corner by no more than it says
            above = peaks[name] + SPECK * peaks[name] - corner.number()
            yield "gap", corner, relative.number() * size - above, peaks[name]
    if optimal:
        asked = (request / "accuracy" / "relative_gap").number(usual_gap(request / "machine"), least=0)
        yield "status", relative, asked - relative.number() if relative else None, ONE
    slack = {name: size * real(CEILING) for name, size in statement.sizes.items()}
    priced = partial(priced_at, {name: (proof / f"{name}_{unit}").number(0.0) for name, unit in NAMES.items()})
    yield from proven("corner", proof / "force_N", statement, multipliers / "objective", implied, slack, priced)
    most = {name: (proof / f"mass_{name}_limit_{unit}").number(0.0) for name, unit in NAMES.items()}
    if proof / "mass_lower_bound_kg":
        yield from lightest(statement, proof, multipliers, most, after, mass)
        sizes = {name: (scale / f"{name}_{unit}").number() for name, unit in NAMES.items()}
        yield from light(statement, proof, sizes, mass, optimal)


def sweep(request: Place, rows: Place) -> Iterator[Claim]:
    """Rows of a sweep, each as the answer to the base with the values of its axes."""
    paths = [(axis / "path").text() for axis in request / "axes"]
    for row in rows:
        if (row / "status").text() in ("optimal", "inaccurate", "infeasible"):
            body = (request / "base").value
            for path in paths:
                body = with_value(body, path.split("/")[1:], (row / path).value, request / "axes")
            yield from covered(_row(Place(body, "request", "base"), row))


def with_value(body: Any, parts: Sequence[str], value: Any, place: Place) -> Any:
    """A copy of a body with another value at a JSON pointer (RFC 6901)."""
    if not parts:
        return value
    name = parts[0].replace("~1", "/").replace("~0", "~")
    if isinstance(body, list) and name.isdecimal() and len(name) < 6 and int(name) < len(body):
        k = int(name)
        return [*body[:k], with_value(body[k], parts[1:], value, place), *body[k + 1 :]]
    if not isinstance(body, (dict, type(None))) or len(parts) > 32:
        raise Unreadable(place.path, "an axis leads to no field of the base")
    return {**(body or {}), name: with_value((body or {}).get(name), parts[1:], value, place)}


def _row(request: Place, row: Place) -> Claims:
    """A row in the form of the answer to one request; what it does not hold stays out."""
    try:
        proof = json.loads((row / "multipliers").text(default="{}"))
    except (ValueError, RecursionError):
        proof = None
    if not isinstance(proof, dict):
        raise Unreadable((*row.path, "multipliers"), "must be a JSON object as a text")
    status, weights = (row / "status").value, []
    for web in request / "machine" / "webs":
        name = (web / "name").text()
        weights.append({"web": name, **{of: (row / f"{of}.{name}").value for of in ("mass_kg", "angle_deg")}})
        if status != "infeasible" and weights[-1]["mass_kg"] is None:
            # a column that was not asked for
            raise NotCovered(row / f"mass_kg.{name}")
    given = [field for field in CEILINGS.values() if request / "objective" / field]
    peaks = {name: {f"peak_{unit}": (row / f"{name}_peak_{unit}").value} for name, unit in NAMES.items()}
    proofs = {**proof, **row.value, "multipliers": proof}
    found = {
        "status": status,
        "counterweights": weights,
        "total_mass_kg": (row / "total_mass_kg").value,
        "residual": {"after": peaks},
        "certificate": proofs,
        "infeasibility": {**proofs, "conflict": given},
    }
    yield from optimum(request, Place(found, *row.path))


def leaves(value: Any) -> int:
    """Numbers and texts in a JSON value."""
    found, left = 0, [value]
    while left:
        one = left.pop()
        if isinstance(one, (dict, list)):
            left.extend(one.values() if isinstance(one, dict) else one)
        found += 1
    return found


def verify(request: Any, answer: Any, most: float = inf) -> dict[str, Any]:
    """Every claim of an answer, and the verdict on the whole.

    Parameters
    ----------
    request, answer : what a JSON file holds: bodies of optimize or pareto with their answers, or the body of a sweep
        with a list of its rows.
    most : numbers and texts to look at, those of the request again for every point or row.

    Raises
    ------
    Unreadable
        naming the field that is not what the service takes or gives.
    """
    asked, given = Place(request, "request"), Place(answer, "answer")
    many = "base" in request if isinstance(request, dict) else False
    work = leaves(answer) + leaves(request) * (len(answer) if many and isinstance(answer, list) else 1)
    if work > most:
        raise Unreadable(given.path, f"holds more than is checked at a time: {work} of {most} numbers and texts")
    kind = sweep if many else front if isinstance(answer, dict) and "fronts" in answer else single
    return judged(covered(kind(asked, given)))


if __name__ == "__main__":
    sys.exit(main(verify, __doc__, sys.argv[1:]))
