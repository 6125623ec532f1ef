"""What limits cost where goals look at the whole turn: the slope of the bound that cuts prove."""

from __future__ import annotations

from typing import Dict, Sequence, Tuple

from verify_cases import scenarios
from verify_claims import Claims
from verify_cuts import Part, Term
from verify_machine import Machine
from verify_numbers import ONE, NotCovered, Number, Place
from verify_prices import Priced, price_entries, stated_limits
from verify_program import CEILINGS

#: units of the ceilings on loads of the shaft
LOADED = {"bearing_ceiling_N": "N", "specific_load_ceiling_Pa": "Pa", "bending_ceiling_Nm": "(N m)"}


def costs(
    request: Place, answer: Place, machine: Machine, part: Part, terms: Sequence[Term], slopes: Sequence[Number]
) -> Claims:
    """Of one goal without tolerances and scenarios; ``slopes``: what the bound rises by per kg m on each web."""
    place, goal, proof = answer / "shadow_prices", request / "objective", answer / "certificate"
    off = any(v != 0 for v in (request / "tolerances").read((dict,), "an object", {}).values() if v is not None)
    several = scenarios(request) or off or list(goal / "priorities")
    if several or machine.groups or proof / "continuous_lower_bound" or not proof / "gap":
        yield "shadow_prices", place, -ONE if list(place) else ONE, ONE
        return
    if part.geared:
        # of webs on balance shafts the prices are not told here
        if list(place):
            raise NotCovered(place)
        return
    weight, unit = _measure(part, goal)
    touched = {v.text() for v in answer / "active_limits"}
    multipliers = proof / "multipliers" / "objective"
    budget = "max_total_mass" in touched
    pulls = [-v.middle() for v in slopes]
    stated = list(stated_limits(machine, answer / "counterweights", pulls, multipliers, budget))
    for field, length in _lengths(part, multipliers).items():
        per = LOADED.get(field) or ("N" if field.endswith("_N") else "(N m)")
        limit = field.rpartition("_")[0]
        stated.append(Priced(limit, "", length, (goal / field).double(), per, limit in touched))
    rest = (proof / "objective_without_counterweights").double(0.0)
    # what cancels in the pulls
    sizes = [sum(abs(v.factors[k].middle()) * abs(v.y.middle()) for v in terms) for k in range(len(pulls))]
    dust = 1e-11 * max((size * web.radius.middle().real for size, web in zip(sizes, machine.webs)), default=0.0)
    yield from price_entries(place, stated, weight, unit, (proof / "gap").double(), rest, dust)


def _measure(part: Part, goal: Place) -> Tuple[float, str]:
    """The first of what is weighed: its weight, and its unit."""
    for name, unit in (("force", "N"), ("moment", "N m")):
        if name in part.weights:
            return part.weights[name].middle().real, unit
    if float(part.weights["bearing"]) > 0:
        return part.weights["bearing"].middle().real, "Pa" if part.specific else "N"
    return (
        part.weights["bending"] if float(part.weights["bending"]) > 0 else part.weights["roll"]
    ).middle().real, "N m"


def _lengths(part: Part, multipliers: Place) -> Dict[str, float]:
    """Of every ceiling that is stated, the lengths of the multipliers of its cuts; of specific loads times the area."""
    goal = part.goal
    fields = [field for field in (*CEILINGS.values(), *LOADED) if goal / field]
    lengths = dict.fromkeys(fields, 0.0)
    for cut in multipliers / "ceilings":
        response, length = (cut / "response").text(), abs(complex((cut / "x").double(), (cut / "y").double()))
        kind, _, name = response.partition(":")
        field = CEILINGS.get(response) or {"bearing": "bearing_ceiling_N"}.get(kind, "bending_ceiling_Nm")
        if kind == "bearing" and goal / "specific_load_ceiling_Pa":
            if goal / "bearing_ceiling_N" and length > 0:
                # of both it is not told whose cut it is
                raise NotCovered(cut)
            field, length = "specific_load_ceiling_Pa", length * part.area[name].middle().real
        if field not in lengths:
            raise NotCovered(cut)
        lengths[field] += length
    return lengths
