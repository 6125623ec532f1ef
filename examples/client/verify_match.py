"""Checks which weighed part goes on which row: each part once, and what the rows weigh with theirs.

What no other assignment undercuts, and the peaks, are not covered: of those the answer to optimize, or analyze, of the
machine with these rows says all.
"""

from __future__ import annotations

from typing import Dict, Tuple

from verify_claims import Claims, near, same
from verify_numbers import ABOUT_ONE, ONE, ZERO, NotCovered, Number, Place

__all__ = ["matching"]


def matching(request: Place, answer: Place) -> Claims:
    """Claims of an assignment of parts to rows."""
    listed: Dict[Tuple[str, str], Number] = {}
    for kind in request / "parts":
        names = [each.text() for each in kind / "names"]
        weights = [each.number(least=0) for each in kind / "masses_kg"]
        listed.update(zip([((kind / "class").text(), name) for name in names], weights))
    total = answer / "total_mass_kg"
    sum_of_all = sum(((each / "mass_kg").number() for each in answer / "counterweights"), ZERO)
    yield near("total_mass", total, sum_of_all * ABOUT_ONE, max(total.number(), ONE, key=lambda each: each.high))
    if (request / "balance_nuts_kg").value:
        # nuts have no names, and may lie beside the machine
        raise NotCovered(request / "balance_nuts_kg")
    weight: Dict[Tuple[int, int], Number] = {}
    for k, throw in enumerate(request / "machine" / "throws"):
        for n, row in enumerate(throw / "rows"):
            weight[k, n] = (row / "reciprocating_mass_kg").number(least=0)
    left = dict(listed)
    for part in answer / "assignments":
        key = (part / "class").text(), (part / "part").text()
        place = int((part / "throw").double()), int((part / "row").double())
        known = key in left and place in weight
        for name in ("class", "part", "throw", "row"):
            yield "assignments", part / name, ONE if known else -ONE, ONE
        if known:
            mass = left.pop(key)
            yield near("assignments", part / "mass_kg", mass)
            weight[place] = weight[place] + mass
    yield same("spares", Place(len(list(answer / "spares")), *(answer / "spares").path), 0)
    yield "assignments", answer / "assignments", -ONE if left else ONE, ONE
    rows = list(answer / "rows")
    places = [(int((row / "throw").double()), int((row / "row").double())) for row in rows]
    yield "rows", answer / "rows", ONE if sorted(places) == sorted(weight) else -ONE, ONE
    for row, place in zip(rows, places):
        for name in ("throw", "row"):
            yield same("rows", row / name, (row / name).value if place in weight else None)
        yield near("rows", row / "reciprocating_mass_kg", weight.get(place, ZERO) * ABOUT_ONE)
    raise NotCovered(request / "parts")
