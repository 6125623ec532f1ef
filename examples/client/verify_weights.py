"""The counterweights of an answer: what they come to, the limits of their webs, and what there is to choose from."""

from __future__ import annotations

from fractions import Fraction
from math import radians
from typing import Dict, Iterator, List, Optional, Tuple

from verify_claims import Claim, Claims, near
from verify_cranks import Crank, own_cranks
from verify_machine import CHOICES, Machine, Mass, Web, web_of
from verify_numbers import (
    ONE,
    ZERO,
    Number,
    Place,
    direction,
    real,
)
from verify_plates import FIGURE, Plate

MASS = 1e-12  # of a limit: by which rounded masses may exceed it
ANGLE = 1e-12  # degrees likewise
ROUNDING = 1e-14  # share of an angle by which a remainder of doubles may be off
TOUCHED, UNSURE = 1e-4, 1e-9  # a limit of which no more than this share is left is touched; what rounding may tell
_NOWHERE, _NONE = Place(None), {"mass_kg": 0, "angle_deg": 0, "radius_m": 0}
SAME = 1e-9  # of a mass, relative, and of an angle in degrees: by which they are those of a catalogue


def counterweights(machine: Machine, place: Place, design: Place = _NOWHERE) -> Claims:
    """Their consistency and the limits of the webs; returns them as masses, and their total mass.

    ``design``: the machine in the request, by which the cranks are known; without it the cranks are not looked at.
    """
    names = [(entry / "web").text() for entry in place]
    yield "counterweights", place, ONE if names == [web.name for web in machine.webs] else -ONE, ONE
    by_name, turning, total_mass, cranks = dict(zip(names, place)), [], ZERO, own_cranks(design)
    for web in machine.webs:
        entry = by_name.get(web.name, Place({**_NONE, "web": web.name}, *place.path))
        turns = yield from counterweight(machine, web, entry, machine.fastest)
        yield from _crank(cranks.get(web.name), entry) if design else ()
        total_mass = total_mass + (entry / "mass_kg").number()
        turning.append(turns)
    if all(web.name in by_name for web in machine.webs):
        yield from _alike(machine, by_name)
    if machine.budget is not None:
        yield "max_total_mass", place, machine.budget * real(1 + MASS) - total_mass, machine.budget
    return turning, total_mass * machine.wide


def counterweight(machine: Machine, web: Web, entry: Place, fastest: Number) -> Claims:
    """A counterweight within the limits of its web; returns it as a mass. ``fastest``: square of its highest speed."""
    yield "counterweights", entry / "web", ONE, ONE
    printed, mass, angle = entry / "mass_kg", (entry / "mass_kg").number(), (entry / "angle_deg").double()
    radius = web.radius
    if web.plate is not None:
        radius = (entry / "radius_m").number(least=0)
        yield from _cut(web.plate, entry)
    u = (direction(angle) + machine.blur) * mass * radius * machine.wide
    exactly = mass * radius * machine.wide, *u.parts(), web.position, radius, mass * radius * fastest * machine.wide
    fields = "mass_radius_kg_m", "x_kg_m", "y_kg_m", "position_m", "radius_m", "centrifugal_force_N"
    figures = zip(fields, exactly)
    yield from (near("counterweights", entry / field, exact) for field, exact in figures if entry / field)
    yield "max_mass", printed, mass, abs(mass)
    if (mass.high <= 0 and angle != 0) or not 0 <= angle < 360:
        # no weight has no angle, and an angle is told within one turn
        yield "counterweights", entry / "angle_deg", -ONE, ONE
    yield "counterweights", entry / "angle_deg", ONE, ONE
    if web.fixed is not None:
        yield near("fixed", printed, web.fixed[0])
        off = (Fraction(angle) - Fraction(web.fixed[1]) + 180) % 360 - 180
        yield "fixed", entry / "angle_deg", real(Fraction(ANGLE) - abs(off)) if mass.high > 0 else ONE, ONE
    elif web.limit is not None:
        yield "max_mass", printed, web.limit * real(1 + MASS) - mass, web.limit
    if entry / "fixed":
        there = (entry / "fixed").read((bool,), "true or false")
        yield "fixed", entry / "fixed", ONE if there == (web.fixed is not None) else -ONE, ONE
    if web.sector is not None and mass.high > 0:
        turn, (centre, half) = Fraction(360), web.sector
        off = abs((Fraction(angle) - Fraction(centre) + turn / 2) % turn - turn / 2)
        yield "sector", entry / "angle_deg", real(Fraction(half) + Fraction(ANGLE) - off), ONE
    if entry / "active_limits":
        yield from active_limits("active_limits", entry / "active_limits", dict(_touched(web, entry)))
    return Mass(mass * radius, direction(angle), ZERO, web.position)


def _crank(crank: Optional[Crank], entry: Place) -> Claims:
    """The crank that a counterweight belongs to, and the angle from it: what a fitter drills by."""
    throw, printed = entry / "throw", entry / "angle_from_crank_deg"
    if crank is None:
        yield "crank", entry, -ONE if throw or printed else ONE, ONE
        return
    yield "crank", throw, ONE if throw and throw.double() == crank.throw else -ONE, ONE
    if (entry / "mass_kg").double() == 0:
        yield "crank", printed, -ONE if printed else ONE, ONE
        return
    if not printed:
        yield "crank", printed, -ONE, ONE
        return
    angle = printed.double()
    off = (Fraction((entry / "angle_deg").double()) - Fraction(crank.degrees) - Fraction(angle) + 180) % 360 - 180
    # a remainder of doubles: off by the rounding of the larger of both angles
    allowed = Fraction(ROUNDING) * (360 + abs(Fraction(crank.degrees)))
    yield "crank", printed, real(allowed - abs(off)) if 0 <= angle < 360 else -ONE, ONE


def _alike(machine: Machine, by_name: Dict[str, Place]) -> Claims:
    """Identical castings: the same mass and the same angle from the own crank, or mirrored."""
    for group in machine.groups:
        (first, crank, _), *copies = group
        same = by_name[machine.webs[first].name]
        for k, angle, mirrored in copies:
            entry = by_name[machine.webs[k].name]
            yield near("web_groups", entry / "mass_kg", (same / "mass_kg").number())
            there, target = ((Fraction((place / "angle_deg").double()) - Fraction(own))
                            for place, own in ((entry, angle), (same, crank)))  # fmt: skip
            off = (there + (target if mirrored else -target) + 180) % 360 - 180
            fitted = (entry / "mass_kg").number().high > 0
            yield "web_groups", entry / "angle_deg", real(Fraction(ANGLE) - abs(off)) if fitted else ONE, ONE


def _touched(web: Web, entry: Place) -> Iterator[Tuple[str, float]]:
    """Limits of a web, and by which share of each a counterweight stays below it; a limit of 0 is touched."""
    mass, angle = (entry / "mass_kg").double(), (entry / "angle_deg").double()
    if web.fixed is not None:
        return
    for name, most in web.limits:
        largest = float(most) if web.plate is None or name == "max_mass" else web.plate.unbalance(web.plate.most)
        size = mass * (entry / "radius_m").double() if name == "envelope" else mass
        yield name, 1 - size / largest if largest > 0 else 0.0
    if web.sector is not None:
        off = abs((angle - web.sector[0] + 180) % 360 - 180)
        yield "sector", 1 - off / web.sector[1] if mass > 0 and web.sector[1] > 0 else 1.0


def active_limits(claim: str, place: Place, rooms: Dict[str, float]) -> Claims:
    """A list of the limits that are touched, those of which less than a share is left, each once.

    Of what nothing can be told the room is nan.
    """
    names = [entry.text() for entry in place]
    must = [name for name, room in rooms.items() if room <= TOUCHED - UNSURE]
    may = [name for name, room in rooms.items() if not room > TOUCHED + UNSURE]
    right = {*must} <= {*names} <= {*may} and len({*names}) == len(names)
    yield claim, place, ONE if right else -ONE, ONE
    yield from ((claim, entry, ONE, ONE) for entry in place)


def _cut(of: Plate, entry: Place) -> Claims:
    """The outline of a counterweight that is cut from a plate."""
    mass, radius, shape = (entry / "mass_kg").double(least=0), (entry / "radius_m").double(least=0), entry / "shape"
    if mass == 0:
        yield _close("shape", entry / "radius_m", of.lever(0.0))
        yield "shape", shape, -ONE if shape else ONE, ONE
        return
    angle = radians((shape / "half_angle_deg").double(least=0))
    yield "shape", shape / "half_angle_deg", real(of.most * (1 + ROUNDING) - angle), ONE
    # the opening is what its unbalance takes: of a full plate it is no better known than its own rounding
    away = abs(of.unbalance(min(angle, of.most)) - mass * radius) - FIGURE * of.unbalance(of.most)
    yield "shape", shape / "half_angle_deg", real(-away), ONE
    opening = min(angle, of.most)
    yield _close("shape", entry / "mass_kg", of.mass(opening), of.mass(of.most) * SAME)
    yield _close("shape", entry / "radius_m", of.unbalance(opening) / max(of.mass(opening), 1e-300), of.outer * 1e-6)
    yield _close("shape", shape / "inertia_kg_m2", of.inertia(opening))
    yield _close("shape", shape / "outer_radius_m", of.outer)
    if of.chord:
        yield _close("shape", shape / "chord_height_m", of.lever(opening), of.outer * SAME)
    else:
        yield "shape", shape / "chord_height_m", -ONE if shape / "chord_height_m" else ONE, ONE


def _close(claim: str, place: Place, figure: float, more: float = 0.0) -> Claim:
    """A figure in doubles."""
    if not place:
        return claim, place, -ONE, ONE
    return claim, place, real(FIGURE * abs(figure) + more - abs(place.double() - figure)), real(abs(figure))


def shafts(machine: Machine, design: Place, place: Place) -> Claims:
    """The unbalances of the balance shafts; returns what they add, by order, and their total mass."""
    design_shafts, entries = list(design / "balance_shafts"), list(place)
    names = [(entry / "name").text() for entry in entries]
    yield "balance_shafts", place, ONE if names == [(entry / "name").text() for entry in design_shafts] else -ONE, ONE
    weights: List[Tuple[int, Mass]] = []
    mass = ZERO
    for shaft, entry in zip(design_shafts, entries):
        ratio = (shaft / "speed_ratio").whole()
        yield near("balance_shafts", entry / "speed_ratio", real(ratio))
        yield "balance_shafts", entry / "name", ONE, ONE
        webs = [web_of(web, machine.fastest * real(ratio * ratio)) for web in shaft / "webs"]
        fitted = [(weight / "web").text() for weight in entry / "counterweights"]
        right = fitted == [web.name for web in webs]
        yield "balance_shafts", entry / "counterweights", ONE if right else -ONE, ONE
        on_shaft = ZERO
        for web, weight in zip(webs, entry / "counterweights") if right else ():
            turns = yield from counterweight(machine, web, weight, machine.fastest * real(ratio * ratio))
            yield from _crank(None, weight)
            on_shaft = on_shaft + (weight / "mass_kg").number()
            back = Mass(turns.product, ZERO, turns.co, turns.position)
            weights.append((abs(ratio), turns if ratio > 0 else back))
        if entry / "total_mass_kg":
            # rows of sweeps have that of all shafts alone
            yield near("total_mass", entry / "total_mass_kg", on_shaft * machine.wide)
        mass = mass + on_shaft
    return weights, mass * machine.wide


def heavy_enough(design: Place, place: Place) -> Claims:
    """Masses that are fitted are no smaller than the least that is."""
    for web, entry in zip(design / "webs", place):
        least, mass = web / "min_fitted_mass_kg", (entry / "mass_kg").number(least=0)
        if least and mass.high > 0:
            yield "min_fitted_mass", entry / "mass_kg", mass - least.number() * real(1 - MASS), mass


def stocked(web: Place) -> bool:
    """Whether a web has choices of its own."""
    return any(web / name for name in CHOICES)


def usual_gap(design: Place) -> float:
    """The gap that a machine is asked for where none is said: wide where counterweights are chosen, or a least is."""
    on_shafts = (web for shaft in design / "balance_shafts" for web in shaft / "webs")
    places = (design, *(design / "webs"), *on_shafts)
    names = ("catalogue", "max_counterweights", "min_fitted_mass_kg", *CHOICES)
    return 1e-3 if any(place / name for place in places for name in names) else 1e-6


def castings(design: Place, answer: Place) -> List[Tuple[Place, Place]]:
    """Webs that take what there is, with what they carry: all of the crankshaft or none, and on balance shafts those
    that say so. What is fixed is no choice."""
    own = list(zip(design / "webs", answer / "counterweights"))
    general = (design / "catalogue") or (design / "max_counterweights") or any(map(stocked, design / "webs"))
    pairs = [pair for pair in own if general and not pair[0] / "fixed"]
    for shaft, there in zip(design / "balance_shafts", answer / "balance_shafts"):
        pairs += [pair for pair in zip(shaft / "webs", there / "counterweights") if stocked(pair[0])]
    return pairs


def catalogue(design: Place, answer: Place) -> Claims:
    """Masses, holes, steps and counts that there are."""
    general, cranks = design / "catalogue", own_cranks(design)
    used: list[Number] = []
    pairs = castings(design, answer)
    for web, entry in pairs:
        mass, angle = (entry / "mass_kg").number(), (entry / "angle_deg").double()
        if mass.high <= 0:
            continue
        own = [option for name, options in CHOICES.items() if web / name for option in options(web / name)]
        # where an option is both, masses of the catalogue are none of them
        masses = [option for option, _ in own if option is not None] or list(general / "masses_kg")
        off = min((abs(option.number() - mass) for option in masses), key=lambda option: option.high, default=None)
        if not masses and general / "mass_step_kg":
            off = _from_step(mass, (general / "mass_step_kg").number())
        yield "catalogue", entry / "mass_kg", None if off is None else mass * real(SAME) - off, mass
        turn = Fraction(360)
        wide = (mass * real(SAME)).high
        angles = [
            at for option, at in own if at is not None and (option is None or abs(option.number() - mass).low <= wide)
        ]
        away = [abs((Fraction(option.double()) - Fraction(angle) + turn / 2) % turn - turn / 2) for option in angles]
        if all(at is None for _, at in own) and general / "angle_step_deg":
            # from the own crank, on a balance shaft from the x axis
            crank = cranks.get((web / "name").text())
            starts = [0.0] if "balance_shafts" in web.path else [crank.degrees] if crank else []
            step = Fraction((general / "angle_step_deg").double(least=1e-9))
            rests = [(Fraction(angle) - Fraction(start)) % turn for start in starts]
            away = [min(abs(rest - round(rest / step) * step), turn - rest) for rest in rests]
        yield "catalogue", entry / "angle_deg", real(Fraction(SAME) - min(away)) if away else None, ONE
        if all(abs(mass - other).low > (mass * real(SAME)).high for other in used):
            used.append(mass)
    fitted = sum((entry / "mass_kg").double() > 0 for _, entry in pairs)
    for most, count in ((design / "max_counterweights", fitted), (general / "max_part_numbers", len(used))):
        if most:
            yield "catalogue", most, most.number() - real(count), ONE


def _from_step(mass: Number, step: Number) -> Number:
    """How far a mass is from a whole number of steps, at least one."""
    whole = max(round(float(mass / step)), 1) if step.low > 0 else 0
    return abs(mass - real(whole) * step)
