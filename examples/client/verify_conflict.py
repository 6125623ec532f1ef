"""Ceilings that no counterweights keep, in any of several cases: what multipliers prove, and of which scenarios."""

from __future__ import annotations

from typing import List, NamedTuple, Optional, Sequence, Set, Tuple

from verify_claims import EVIDENCE, Claims
from verify_cuts import Part
from verify_multipliers import ALONG, Program, Pulls
from verify_numbers import ONE, STEP, ZERO, J, Number, Place, largest, total
from verify_program import CEILINGS, phasors


class Limit(NamedTuple):
    """A ceiling in one case: its entry, its multiplier, and what an excess over it is multiplied by."""

    entry: Place
    part: Part
    multiplier: Number
    price: Number  # no less than the length of the multiplier


def conflict(program: Program, verdict: Place) -> Claims:
    """The ceilings cannot be kept, nor can those of the scenarios that are named."""
    proofs, implied = verdict / "multipliers", verdict / "implied_max_mass_kg"
    proof = proofs / "conflict"
    if not proof:
        # what a comparison of all choices proves has no multipliers
        yield "conflict", verdict / "conflict", None, ONE
        yield from _named(verdict, None)
        return
    limits = _limits(program, proof)
    yield from _proven(program, limits, proof, implied, proof)
    several = list(proofs / "scenarios")
    if not several:
        # one, or several with one another: all whose ceilings have a price
        yield from _named(verdict, {case for limit in limits for case in [limit.part.case.name] if case})
        return
    yield from _named(verdict, {(entry / "scenario").text() for entry in several})
    for entry in several:
        # each by itself
        own, name = entry / "conflict", (entry / "scenario").text()
        limits = _limits(program, own)
        is_own = len(several) > 1 and {limit.part.case.name for limit in limits} <= {name}
        yield "conflict", entry / "scenario", ONE if is_own else -ONE, ONE
        yield from _proven(program, limits, own, implied, entry / "scenario")


def _named(verdict: Place, names: Optional[Set[str]]) -> Claims:
    """The scenarios that an answer names are these, each once; None: it is not known which."""
    if "scenarios" not in verdict.value:
        # a row of a sweep has no list
        return
    there = [item.text() for item in verdict / "scenarios"]
    if names is None:
        yield from (("conflict", item, None, ONE) for item in verdict / "scenarios")
        return
    complete = len({*there}) == len(there) and {*there} == names
    for item in verdict / "scenarios":
        yield "conflict", item, ONE if item.value in names else -ONE, ONE
    yield "conflict", verdict / "scenarios", ONE if complete else -ONE, ONE


def _proven(program: Program, limits: Sequence[Limit], proof: Place, implied: Place, place: Place) -> Claims:
    least, believed = excess(program, limits, proof, implied)
    if believed:
        yield "reach", implied, None, ONE
    # strictly above 0: what is at most 0 proves nothing
    yield "conflict", place, None if least is None else least - STEP, ONE
    if least is not None:
        yield EVIDENCE, proof, None, ONE
        yield EVIDENCE, implied, None, ONE


def _limits(program: Program, proof: Place) -> List[Limit]:
    """Every ceiling of a proof that has a price, which stands in the row at its place."""
    rows, entries, limits = list(proof / "rows"), list(proof / "ceilings"), []
    prices = [(row / "value").number(least=0) for row in rows] if len(rows) == len(entries) else [ZERO for _ in entries]
    for entry, price in zip(entries, prices):
        multiplier = (entry / "x").number() + J * (entry / "y").number()
        longest = largest(price, abs(multiplier))
        if longest.high > 0:
            limits.append(Limit(entry, program.part(entry), multiplier, longest))
    return limits


def excess(program: Program, limits: Sequence[Limit], proof: Place, implied: Place) -> Tuple[Optional[Number], bool]:
    """What the ceilings are exceeded by at least, each by its price, and whether implied limits are believed.

    Any price no less than the length of its multiplier proves it, and so does any corner of masses that are off.
    """
    pulls, off = Pulls(ZERO, program.webs), program.off
    for limit in limits:
        start, factors, cap = limit.part.capped(limit.entry)
        is_along = limit.entry / "angle_deg" and (limit.entry / "response").text() in ALONG
        p = limit.multiplier.parts()[0] if is_along else limit.multiplier
        # what is off by itself has to keep the ceiling too
        besides = off.besides * total(map(abs, factors))
        corners = _corners(limit, start, cap) if limit.part.corners else [(start, cap)]
        # a higher price proves more of a ceiling below what cannot be changed, and of scatter
        prices = [limit.price if program.scattered or (most - besides).low < 0 else abs(p) for _, most in corners]
        values = [p.along(at) - price * (most - besides) for price, (at, most) in zip(prices, corners)]
        n = max(range(len(corners)), key=lambda n: values[n].high)
        pulls.least = pulls.least + values[n]
        pulls.spread = [old + prices[n] * off.share * abs(factor) for old, factor in zip(pulls.spread, factors)]
        pulls.slopes = [slope + factor.conjugate() * p for slope, factor in zip(pulls.slopes, factors)]
    return program.within_limits(pulls, proof, implied, ZERO)


def _corners(limit: Limit, start: Number, cap: Number) -> List[Tuple[Number, Number]]:
    """What a ceiling of the first order limits, and how much it allows, in every corner of masses that are off."""
    response = (limit.entry / "response").text()
    most = (limit.part.goal / CEILINGS[response]).number(least=0)
    every = [phasors(corner.laden, response) for corner in limit.part.corners]
    return [(start, cap), *((co, most - abs(counter)) for co, counter in every)]
