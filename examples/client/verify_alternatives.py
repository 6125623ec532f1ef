"""Cheaper choices beside the best one: what each comes to, that it is cheaper, and within its allowance."""

from __future__ import annotations

from typing import Dict, List

from verify_claims import Claims, near, same
from verify_machine import Machine
from verify_numbers import ONE, ZERO, Number, Place, largest, real
from verify_program import Statement, phasors
from verify_weights import SAME, castings, catalogue, counterweights

CEILING = 1e-9  # of the larger of a ceiling and what is there without counterweights


def alternatives(request: Place, answer: Place, machine: Machine, statement: Statement) -> Claims:
    """All that an answer lists; that nothing is cheaper still was found by a search, which is not repeated."""
    if not list(answer / "alternatives"):
        # rows of a sweep have no such list, nor all that it is held to
        return
    best = (answer / "certificate" / "objective").number()
    rest = (answer / "certificate" / "objective_without_counterweights").number()
    own = costs(request / "machine", answer, (answer / "total_mass_kg").number())
    stated = [entry.double() for entry in request / "alternatives"]
    for entry in answer / "alternatives":
        minimised, allowance = (entry / "minimised").text("mass", "pieces", "sizes"), entry / "allowance"
        yield "alternatives", entry / "minimised", ONE, ONE
        yield "alternatives", allowance, ONE if allowance.double() in stated else -ONE, ONE
        turning, mass = yield from counterweights(machine, entry / "counterweights", request / "machine")
        yield from catalogue(request / "machine", entry)
        after = machine.responses(turning)
        value, most = largest(ZERO, *statement.values(after).values()), best * (ONE + allowance.number())
        yield near("alternatives", entry / "objective", value)
        yield "alternatives", entry / "objective", most + rest * real(SAME) - value, most
        for name, cap in statement.caps.items():
            room = cap + statement.sizes[name] * real(CEILING) - abs(phasors(after, name)[0])
            yield "ceilings", entry / "counterweights", room, statement.sizes[name]
        cost = costs(request / "machine", entry, mass)
        yield near("alternatives", entry / "total_mass_kg", cost["mass"])
        for counted in ("pieces", "sizes"):
            yield same("alternatives", entry / counted, round(float(cost[counted])))
        yield "alternatives", entry / "minimised", own[minimised] - cost[minimised], ONE
        lowest = entry / "lower_bound"
        if lowest:
            yield "alternatives", lowest, cost[minimised] * real(1 + SAME) - lowest.number(), ONE
            yield "alternatives", lowest, None, ONE


def costs(design: Place, answer: Place, mass: Number) -> Dict[str, Number]:
    """Total mass, and the numbers of counterweights and of different masses that are chosen."""
    masses: List[float] = sorted(
        (weight / "mass_kg").double() for _, weight in castings(design, answer) if (weight / "mass_kg").double() > 0
    )
    sizes = sum(n == 0 or mass_kg - masses[n - 1] > SAME * mass_kg for n, mass_kg in enumerate(masses))
    return {"mass": mass, "pieces": real(len(masses)), "sizes": real(sizes)}
