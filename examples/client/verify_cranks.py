"""Whose crank each web belongs to, and how much of the rotating unbalance of each crank its webs balance."""

from __future__ import annotations

from typing import Dict, List, NamedTuple, Optional, Sequence

from verify_machine import Machine, row_masses
from verify_numbers import ABOUT_ONE, BLUR, ZERO, NotCovered, Number, Place, direction, real, total

TIE = 1e-9  # distances that differ by less than this share of the extent are equal
NEXT_TO_NOTHING = 1e-280  # kg m: what turns with a crank that has no rotating mass


class Crank(NamedTuple):
    """The crank that a web belongs to."""

    throw: int
    degrees: float


def shares(design: Place) -> Dict[str, Dict[int, Number]]:
    """Of every web, the throws that it belongs to: the one that it names, or the nearest, equally near ones alike."""
    places = [(throw / "position_m").double() for throw in design / "throws"]
    webs = [((web / "name").text(), (web / "position_m").double(), web / "throw") for web in design / "webs"]
    far = max((abs(at - place) for _, at, _ in webs for place in places), default=0.0)
    extent = max(map(abs, places), default=0.0) + far
    throws: Dict[str, Dict[int, Number]] = {}
    for name, at, throw_number in webs if places else ():
        away = [abs(at - place) for place in places]
        near = [t for t, distance in enumerate(away) if distance <= min(away) + TIE * extent]
        if throw_number:
            near = [throw_number.whole(least=0)]
            if near[0] >= len(places):
                raise NotCovered(throw_number)
        throws[name] = {t: real(1 / len(near)) for t in near}
    return throws


def own_cranks(design: Place) -> Dict[str, Optional[Crank]]:
    """Of every web the crank that it belongs to; none where two are equally near, and on a scroll."""
    angles = [(throw / "crank_angle_deg").double() for throw in design / "throws"]
    of_webs = {name: [*near] for name, near in shares(design).items()}
    names = [(web / "name").text() for web in design / "webs"]
    alone = {name: near[0] for name, near in of_webs.items() if len(near) == 1}
    return {name: Crank(alone[name], angles[alone[name]]) if name in alone else None for name in names}


class Rate(NamedTuple):
    """What is opposite a crank, and across it, over what turns with it; None where nothing does."""

    throw: int
    name: Optional[str]
    rate: Optional[Number]
    sideways: Optional[Number]


def balance_rates(design: Place, machine: Machine, unbalances: Dict[str, Number]) -> List[Rate]:
    """Of every throw, with unbalances of its webs [kg m]."""
    of_webs, results = shares(design), []
    for t, throw in enumerate(design / "throws"):
        crank = direction((throw / "crank_angle_deg").double()) + machine.blur
        turning = [(throw / "rotating_mass_kg").number(0.0), *(row_masses(row)[1] for row in throw / "rows")]
        size = total(turning) * (throw / "crank_radius_m").number() * machine.wide
        against: Sequence[Number] = [u * of_webs[web][t] for web, u in unbalances.items() if t in of_webs.get(web, {})]
        name = (throw / "name").text() if throw / "name" else None
        if size.low <= real(NEXT_TO_NOTHING).high:
            results.append(Rate(t, name, None, None))
            continue
        rate = -(total(against) + BLUR * total(abs(part) for part in against)) * crank.conjugate()
        along, across = (part * ABOUT_ONE / size if part is not ZERO else ZERO for part in rate.parts())
        results.append(Rate(t, name, along, across))
    return results
