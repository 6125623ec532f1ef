"""The machine of a request: what turns with its shaft and against it, and where counterweights may sit."""

from __future__ import annotations

from copy import copy
from typing import Callable, Dict, Iterator, NamedTuple, Optional, Sequence, Tuple

from verify_numbers import (
    ABOUT_ONE,
    BLUR,
    HALF,
    ONE,
    PI,
    ZERO,
    NotCovered,
    Number,
    Place,
    Unreadable,
    direction,
    largest,
    real,
    total,
)
from verify_plates import Plate, plate

NOTHING = 1e-230  # in the unit of a figure: what doubles do not tell from 0
NO_SPAN = 1e-250  # m: a machine that is no longer has no length, and 1 m counts as its span


class Mass(NamedTuple):
    """A mass on a crank: kg m, its directions with and against the shaft, and where along the shaft [m]."""

    product: Number
    co: Number
    counter: Number
    position: Number


class Web(NamedTuple):
    """A place for a counterweight."""

    name: str
    position: Number
    radius: Number
    limit: Optional[Number]
    sector: Optional[Tuple[float, float]]  # centre and half-angle, degrees
    fixed: Optional[Tuple[Number, float]] = None  # mass and angle of a weight that is there already
    limits: Tuple[Tuple[str, Number], ...] = ()  # those of its mass by their names [kg]
    plate: Optional[Plate] = None  # from which it is cut: then its radius is what the answer says
    pull: Optional[Number] = None  # of a kilogram at the highest speed of its shaft [N], where bolts limit it


NAMES = {"force": "N", "moment": "Nm"}


class OnFrame(NamedTuple):
    """A response on the frame: the end of its fields, what it has of force and moment, and the fields that say so."""

    unit: str
    shares: Callable[[Machine, Place], Tuple[Number, Number]]  # by the fields of an objective
    fields: str = ""


#: all that an objective may weigh and limit on the frame
ON_FRAME: Dict[str, OnFrame] = {
    "force": OnFrame("N", lambda machine, goal: (ONE, ZERO)),
    "moment": OnFrame("Nm", lambda machine, goal: (ZERO, ONE)),
    # beside force and moment
}
#: mass and angle that a web may take; none is left to the catalogue
Option = Tuple[Optional[Place], Optional[Place]]
#: all that a web may say of what is chosen for it: options by what a field holds
CHOICES: Dict[str, Callable[[Place], Iterator[Option]]] = {
    "catalogue_masses_kg": lambda masses: ((mass, None) for mass in masses),
    "hole_angles_deg": lambda angles: ((None, angle) for angle in angles),
    # beside these two
}
#: fields of a request that these tables name
ENTRY_FIELDS = " ".join(
    [
        f"{name}_weight {name}_ceiling_{unit} {name}_ceiling_x_{unit} {name}_ceiling_y_{unit} {fields}"
        for name, (unit, _, fields) in ON_FRAME.items()
    ]
    + [*CHOICES]
)
#: phasors that turn with and against the shaft, in the units of the answer
Responses = Dict[str, Tuple[Number, Number]]


class Machine:
    """A machine in the units of the answer; its masses are exact, or known to their rounding."""

    def __init__(self, place: Place, goal: Place, plane: Place, budget: Place, exact: bool = False) -> None:
        (place / "rotation").text("ccw", "cw", default="ccw")
        kind = (place / "kind").text("reciprocating", "scroll")
        masses, planes, ends = (_throws if kind == "reciprocating" else _scroll)(place)
        masses += [mass for own in place / "unbalances" for mass in _unbalance(own)]
        self.wide, self.blur = (ONE, ZERO) if exact else (ABOUT_ONE, BLUR)
        omega = (place / "speed_rpm").number(least=0) * Number(PI, PI + 1) / Number(30 * 10**80, 30 * 10**80)
        self.square, self.masses = omega * omega, masses
        fastest = (place / "overspeed_rpm") or (place / "speed_rpm")
        turning = fastest.number(least=0) * Number(PI, PI + 1) / Number(30 * 10**80, 30 * 10**80)
        self.fastest = turning * turning
        self.webs = [web_of(web, self.fastest) for web in place / "webs"]
        if len({web.name for web in self.webs}) < len(self.webs):
            raise Unreadable((*place.path, "webs"), "names must be unique")
        self.budget = budget.number(least=0) if budget else None
        # where the machine says that moments are, or midway; where the answer says so is what counts from here
        centre = 0.5 * (min(planes) + max(planes))
        self.centre, self.own_plane = real(centre), (place / "reference_plane_m").number(centre)
        self.plane = plane.number() if plane else self.own_plane
        self.shares = {name: response.shares(self, goal) for name, response in ON_FRAME.items()}
        ends = [*ends, *((web / "position_m").double() for web in place / "webs")]
        span = real(max(ends)) - real(min(ends))
        self.span = span if span.low > real(NO_SPAN).high else ONE
        self.groups = _groups(place)
        #: what is there already: the program chooses beside it, within what it leaves of the budget
        there = [(web, *web.fixed) for web in self.webs if web.fixed is not None]
        self.there = [Mass(mass * web.radius, direction(angle), ZERO, web.position) for web, mass, angle in there]
        # the service adds them up in doubles
        self.fixed = total(mass for _, mass, _ in there) * self.wide
        self.left = largest(self.budget - self.fixed, ZERO) if self.budget is not None else None
        self.refresh()

    def refresh(self) -> None:
        """What the masses do, without counterweights and with those that are there."""
        self.before = self.alone(self.masses)
        self.laden = self.responses(self.there)
        #: phasors of higher orders without balance shafts, where they were needed; None where a row has no rod
        self.higher: Dict[int, Optional[Responses]] = {}

    def off(self, shares: Sequence[Number]) -> Machine:
        """Where what moves along the rows is off by these shares, row by row."""
        left, machine = iter(shares), copy(self)
        machine.masses = [
            mass if mass.counter is ZERO else mass._replace(product=mass.product * (ONE + next(left)))
            for mass in self.masses
        ]
        machine.refresh()
        return machine

    def responses(self, weights: Sequence[Mass]) -> Responses:
        """With counterweights."""
        return self._plus(self.before, weights)

    def alone(self, weights: Sequence[Mass]) -> Responses:
        """Of some masses, without the machine."""
        return self._plus(dict.fromkeys(ON_FRAME, (ZERO, ZERO)), weights)

    def _plus(self, responses: Responses, weights: Sequence[Mass]) -> Responses:
        sums = {}
        for name, (co, counter) in responses.items():
            for mass in weights:
                arm = self.arm(name, mass.position, self.wide)
                size = mass.product * self.wide * self.square * arm
                co = co + (mass.co + self.blur) * size if mass.co is not ZERO else co
                counter = counter + (mass.counter + self.blur) * size if mass.counter is not ZERO else counter
            sums[name] = co, counter
        return sums

    def arm(self, name: str, position: Number, wide: Number = ONE) -> Number:
        """What a unit of force in a plane adds to a response. ``wide``: what every product may be off by."""
        force, moment = self.shares[name]
        if moment is ZERO:
            return force if force is ONE else force * wide
        along = position - self.plane if wide is ONE else position * wide - self.plane * wide
        along = along if moment is ONE else along * moment * wide
        return along if force is ZERO else along + force * wide

    def add(self, slopes: Dict[str, Number], name: str, by: Number) -> None:
        """Add to the slopes by force and moment what a response has of them."""
        for of, share in zip(NAMES, self.shares[name]):
            if share is not ZERO:
                slopes[of] = slopes[of] + (by if share is ONE else by * share)

    def together(self, pulls: Sequence[Number]) -> list[Number]:
        """What pulls at the webs, of identical castings by the mean of what pulls at all, as seen from their cranks."""
        result = list(pulls)
        for group in self.groups:
            back = [(pulls[k] * direction(angle).conjugate(), mirrored) for k, angle, mirrored in group]
            mean = total(pull.conjugate() if mirrored else pull for pull, mirrored in back) / real(len(group))
            for k, angle, mirrored in group:
                result[k] = (mean.conjugate() if mirrored else mean) * direction(angle)
        return result


def _groups(place: Place) -> list[list[tuple[int, float, bool]]]:
    """Webs that get the same casting, by number, the angles of their own cranks [deg], and which are mirrored there."""
    names = [(web / "name").text() for web in place / "webs"]
    throws = [((throw / "position_m").double(), (throw / "crank_angle_deg").double()) for throw in place / "throws"]
    groups = []
    for group in place / "web_groups":
        mirror = (group / "mirror").read((bool,), "true or false", False)
        webs = [names.index(name) for name in map(Place.text, group / "webs") if name in names]
        groups.append([(k, 0.0, mirror and n % 2 == 1) for n, k in enumerate(webs)])
        if len(groups[-1]) < len(list(group / "webs")):
            raise NotCovered(group / "webs")
        for n, (k, _, mirrored) in enumerate(groups[-1] if throws else ()):
            web = list(place / "webs")[k]
            at = (web / "position_m").double()
            near = min(range(len(throws)), key=lambda t: abs(throws[t][0] - at))
            throw_number = (web / "throw").whole(float(near))
            if throw_number >= len(throws):
                raise NotCovered(web / "throw")
            groups[-1][n] = k, throws[throw_number][1], mirrored
    return groups


def web_of(place: Place, fastest: Number) -> Web:
    """``fastest``: square of the highest speed of the web's shaft."""
    most, sector = place / "max_mass_kg", place / "sector"
    edges = ((sector / "centre_deg").double(), (sector / "half_angle_deg").double(least=0)) if sector else None
    there, cut = place / "fixed", plate(place / "envelope") if place / "envelope" else None
    radius, limit = (there / "radius_m") or (place / "counterweight_radius_m"), most.number(least=0) if most else None
    weight = ((there / "mass_kg").number(least=0), (there / "angle_deg").double()) if there else None
    name, where = (place / "name").text(), (place / "position_m").number()
    limit, bolts = ZERO if there else limit, place / "max_centrifugal_force_N"
    limits = [("max_mass", most.number(least=0))] if most else []
    if cut is not None:
        return Web(name, where, ZERO, limit, edges, weight, (*limits, ("envelope", ZERO)), cut)
    per_kg = None
    if bolts:
        per_kg = radius.number(least=0) * fastest
        if per_kg.low <= 0:
            raise NotCovered(bolts)
        force = bolts.number(least=0) / per_kg
        limits.append(("max_centrifugal_force", force))
        limit = force if limit is None else min(limit, force, key=lambda number: number.high)
    return Web(name, where, radius.number(least=0), limit, edges, weight, tuple(limits), None, per_kg)


def _unbalance(place: Place) -> list[Mass]:
    """Of the shaft itself, by its components: counted in the responses, not in the planes."""
    where = (place / "position_m").number()
    return [
        Mass((place / name).number(0.0), direction(angle), ZERO, where)
        for name, angle in (("x_kg_m", 0.0), ("y_kg_m", 90.0))
    ]


def _moving(product: Number, crank: Number, degrees: float, position: Number) -> Mass:
    """Along an axis g: half of it turns along e^{jd}, half along e^{j(2g - d)} against the shaft."""
    return Mass(product * HALF, crank, direction(degrees) * direction(degrees) * crank.conjugate(), position)


def _throws(place: Place) -> tuple[list[Mass], list[float], list[float]]:
    """Masses, planes whose middle is the default reference, and planes that the span counts."""
    masses, planes = [], []
    for throw in place / "throws":
        radius, crank = (throw / "crank_radius_m").number(), direction((throw / "crank_angle_deg").double())
        planes.append((throw / "position_m").double())
        masses.append(Mass((throw / "rotating_mass_kg").number(0.0) * radius, crank, ZERO, real(planes[-1])))
        for row in throw / "rows":
            where = real(planes[-1]) + (row / "offset_m").number(0.0)
            moving, turning = row_masses(row)
            masses.append(_moving(moving * radius, crank, (row / "axis_deg").double(), where))
            masses.append(Mass(turning * radius, crank, ZERO, where))
    if not planes:
        raise Unreadable((*place.path, "throws"), "must hold at least one item")
    return masses, planes, planes


def row_masses(row: Place) -> Tuple[Number, Number]:
    """What moves along the axis of a row, and what turns with the crank pin, kg."""
    rod = row / "connecting_rod"
    moving = (row / "reciprocating_mass_kg").number(0.0 if row / "parts" else None)
    weight = (rod / "mass_kg").number(0.0)
    if rod / "centre_of_mass_m":
        share = over((rod / "centre_of_mass_m").number(), (rod / "length_m").number(), rod / "length_m")
    else:
        share = (rod / "reciprocating_share").number(1 / 3)
    moving, turning = moving + share * weight, (ONE - share) * weight
    for part in row / "parts":
        mass = (part / "mass_kg").number()
        if (part / "motion").text("reciprocating", "rotating", default="reciprocating") == "rotating":
            turning = turning + mass
        else:
            moving = moving + mass
    return moving, turning


def over(number: Number, by: Number, place: Place) -> Number:
    """A quotient; what cannot be told from 0 divides nothing."""
    if by.low <= 0:
        raise NotCovered(place)
    return number / by


def _scroll(place: Place) -> tuple[list[Mass], list[float], list[float]]:
    orbit, crank, guide = (place / "orbit_radius_m").number(), direction(0.0), place / "anti_rotation"
    own, other = (place / "orbiting_position_m").double(), (guide / "position_m").double()
    masses = [Mass((place / "orbiting_mass_kg").number() * orbit, crank, ZERO, real(own))]
    if (guide / "type").text("oldham", "crank_pins") == "oldham":
        # it slides with the projection of the orbit: a crank with an infinite rod
        masses.append(_moving((guide / "mass_kg").number() * orbit, crank, (guide / "axis_deg").double(), real(other)))
    else:
        pins = (guide / "count").number() * (guide / "eccentric_mass_kg").number(0.0)
        masses.append(Mass(pins * orbit, crank, ZERO, real(other)))
    return masses, [own], [own, other]
