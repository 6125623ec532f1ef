"""The counterweights of an answer: what they come to, the limits of their webs, and what there is to choose from."""

from __future__ import annotations

from fractions import Fraction

from verify_claims import Claims, near
from verify_machine import Machine, Mass
from verify_numbers import (
    ONE,
    ZERO,
    Number,
    Place,
    direction,
    real,
)

MASS = 1e-12  # of a limit: by which rounded masses may exceed it
ANGLE = 1e-12  # degrees likewise
SAME = 1e-9  # of a mass, relative, and of an angle in degrees: by which they are those of a catalogue


def counterweights(machine: Machine, place: Place) -> Claims:
    """Their consistency and the limits of the webs; returns them as masses, and their total mass."""
    names = [(one / "web").text() for one in place]
    yield "counterweights", place, ONE if names == [web.name for web in machine.webs] else -ONE, ONE
    by_name, turning, total_mass = dict(zip(names, place)), [], ZERO
    for web in machine.webs:
        one = by_name.get(web.name, Place({"mass_kg": 0, "angle_deg": 0}, *place.path))
        said, mass, angle = one / "mass_kg", (one / "mass_kg").number(), (one / "angle_deg").double()
        u = (direction(angle) + machine.blur) * mass * web.radius * machine.wide
        exactly = mass * web.radius * machine.wide, *u.parts(), web.position, web.radius
        figures = zip(("mass_radius_kg_m", "x_kg_m", "y_kg_m", "position_m", "radius_m"), exactly)
        yield from (near("counterweights", one / field, exact) for field, exact in figures if one / field)
        yield "max_mass", said, mass, abs(mass)
        if web.fixed is not None:
            yield near("fixed", said, web.fixed[0])
            off = (Fraction(angle) - Fraction(web.fixed[1]) + 180) % 360 - 180
            yield "fixed", one / "angle_deg", real(Fraction(ANGLE) - abs(off)) if mass.high > 0 else ONE, ONE
        elif web.limit is not None:
            yield "max_mass", said, web.limit * real(1 + MASS) - mass, web.limit
        if web.sector is not None and mass.high > 0:
            turn, (centre, half) = Fraction(360), web.sector
            off = abs((Fraction(angle) - Fraction(centre) + turn / 2) % turn - turn / 2)
            yield "sector", one / "angle_deg", real(Fraction(half) + Fraction(ANGLE) - off), ONE
        total_mass = total_mass + mass
        turning.append(Mass(mass * web.radius, direction(angle), ZERO, web.position))
    for group in machine.groups:
        (first, crank, _), *others = group
        same = by_name[machine.webs[first].name]
        for k, angle, mirrored in others:
            one = by_name[machine.webs[k].name]
            yield near("web_groups", one / "mass_kg", (same / "mass_kg").number())
            there, asked = ((Fraction((each / "angle_deg").double()) - Fraction(own))
                            for each, own in ((one, angle), (same, crank)))  # fmt: skip
            off = (there + (asked if mirrored else -asked) + 180) % 360 - 180
            fitted = (one / "mass_kg").number().high > 0
            yield "web_groups", one / "angle_deg", real(Fraction(ANGLE) - abs(off)) if fitted else ONE, ONE
    if machine.budget is not None:
        yield "max_total_mass", place, machine.budget * real(1 + MASS) - total_mass, machine.budget
    return turning, total_mass * machine.wide


def heavy_enough(asked: Place, place: Place) -> Claims:
    """Masses that are fitted are no smaller than the least that is."""
    for web, one in zip(asked / "webs", place):
        least, mass = web / "min_fitted_mass_kg", (one / "mass_kg").number(least=0)
        if least and mass.high > 0:
            yield "min_fitted_mass", one / "mass_kg", mass - least.number() * real(1 - MASS), mass


def stocked(web: Place) -> bool:
    """Whether a web has masses or holes of its own."""
    return bool(web / "catalogue_masses_kg") or bool(web / "hole_angles_deg")


def usual_gap(asked: Place) -> float:
    """The gap that a machine is asked for where none is said: wide where counterweights are chosen, or a least is."""
    places = (asked, *(web for web in asked / "webs"))
    names = ("catalogue", "max_counterweights", "catalogue_masses_kg", "hole_angles_deg", "min_fitted_mass_kg")
    return 1e-3 if any(place / name for place in places for name in names) else 1e-6


def catalogue(asked: Place, place: Place) -> Claims:
    """Masses, holes and counts that there are; steps are not covered. What is fixed is no choice, and not counted."""
    general = asked / "catalogue"
    used: list[Number] = []
    chosen = [(web, one) for web, one in zip(asked / "webs", place) if not web / "fixed"]
    for web, one in chosen:
        mass, angle = (one / "mass_kg").number(), (one / "angle_deg").double()
        if mass.high <= 0:
            continue
        masses = (web / "catalogue_masses_kg") or (general / "masses_kg")
        off = min((abs(each.number() - mass) for each in masses), key=lambda each: each.high, default=None)
        yield "catalogue", one / "mass_kg", None if off is None else mass * real(SAME) - off, mass
        turn = Fraction(360)
        away = [abs((Fraction(each.double()) - Fraction(angle) + turn / 2) % turn - turn / 2)
                for each in web / "hole_angles_deg"]  # fmt: skip
        yield "catalogue", one / "angle_deg", real(Fraction(SAME) - min(away)) if away else None, ONE
        if all(abs(mass - other).low > (mass * real(SAME)).high for other in used):
            used.append(mass)
    fitted = sum((one / "mass_kg").double() > 0 for _, one in chosen)
    for most, count in ((asked / "max_counterweights", fitted), (general / "max_part_numbers", len(used))):
        if most:
            yield "catalogue", most, most.number() - real(count), ONE
