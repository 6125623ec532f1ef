"""Cheaper choices beside the best one: what each comes to, that it is cheaper, and within its allowance."""

from __future__ import annotations

from typing import Callable, Dict, Generator, List, NamedTuple

from verify_answer import Fitted, fitted
from verify_claims import Claim, Claims, near, same
from verify_machine import Machine
from verify_numbers import ONE, ZERO, Number, Place, largest, real
from verify_program import Statement, phasors
from verify_weights import SAME, castings, catalogue

CLAIM = "alternatives"
CEILING = 1e-9  # of the larger of a ceiling and what is there without counterweights


class Worth(NamedTuple):
    """What a choice comes to, and the claim on it."""

    value: Number  # no more than it comes to for certain
    claim: Claim


#: what an entry and its counterweights come to, after claims on ceilings
Judge = Callable[[Place, Fitted], Generator[Claim, None, Worth]]


def alternatives(request: Place, answer: Place, machine: Machine, statement: Statement) -> Claims:
    """Those of goals of the first order."""

    def judged(entry: Place, there: Fitted) -> Generator[Claim, None, Worth]:
        after = machine.responses(there.turning)
        for name, cap in statement.caps.items():
            room = cap + statement.sizes[name] * real(CEILING) - abs(phasors(after, name)[0])
            yield "ceilings", entry / "counterweights", room, statement.sizes[name]
        value = largest(ZERO, *statement.values(after).values())
        return Worth(value, near(CLAIM, entry / "objective", value))

    yield from every(request, answer, machine, judged)


def every(request: Place, answer: Place, machine: Machine, judged: Judge) -> Claims:
    """All that an answer lists; that nothing is cheaper still was found by a search, which is not repeated."""
    if not list(answer / "alternatives"):
        # rows of a sweep have no such list, nor all that it is held to
        return
    best = (answer / "certificate" / "objective").number()
    rest = (answer / "certificate" / "objective_without_counterweights").number()
    mass = (answer / "total_mass_kg").number() + (answer / "balance_shafts_mass_kg").number(0.0)
    own = costs(request / "machine", answer, mass)
    stated = [entry.double() for entry in request / "alternatives"]
    for entry in answer / "alternatives":
        minimised, allowance = (entry / "minimised").text("mass", "pieces", "sizes"), entry / "allowance"
        yield CLAIM, entry / "minimised", ONE, ONE
        yield CLAIM, allowance, ONE if allowance.double() in stated else -ONE, ONE
        there: Fitted = yield from fitted(request, machine, entry / "counterweights", entry / "balance_shafts")
        yield from catalogue(request / "machine", entry)
        value, claim = yield from judged(entry, there)
        most = best * (ONE + allowance.number())
        yield claim
        yield CLAIM, entry / "objective", most + rest * real(SAME) - value, most
        cost = costs(request / "machine", entry, there.mass + there.on_shafts_mass)
        yield near(CLAIM, entry / "total_mass_kg", cost["mass"])
        for field in ("pieces", "sizes"):
            yield same(CLAIM, entry / field, round(float(cost[field])))
        yield CLAIM, entry / "minimised", own[minimised] - cost[minimised], ONE
        lowest = entry / "lower_bound"
        if lowest:
            yield CLAIM, lowest, cost[minimised] * real(1 + SAME) - lowest.number(), ONE
            yield CLAIM, lowest, None, ONE


def costs(design: Place, answer: Place, mass: Number) -> Dict[str, Number]:
    """Total mass, and the numbers of counterweights and of different masses that are chosen."""
    masses: List[float] = sorted(
        (weight / "mass_kg").double() for _, weight in castings(design, answer) if (weight / "mass_kg").double() > 0
    )
    sizes = sum(n == 0 or mass_kg - masses[n - 1] > SAME * mass_kg for n, mass_kg in enumerate(masses))
    return {"mass": mass, "pieces": real(len(masses)), "sizes": real(sizes)}
