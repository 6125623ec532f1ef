"""The machine of a request, its program, and what multipliers prove of it (docs/mathematics.md section 5)."""

from __future__ import annotations

from typing import Dict, Iterable, NamedTuple, Optional, Sequence, Tuple

from verify_numbers import (
    ABOUT_ONE,
    BITS,
    BLUR,
    HALF,
    ONE,
    PI,
    ZERO,
    J,
    NotCovered,
    Number,
    Place,
    Unreadable,
    direction,
    largest,
    real,
    total,
)

NOTHING = 1e-230  # in the unit of a figure: what doubles do not tell from 0
NO_SPAN = 1e-250  # m: a machine that is no longer has no length, and 1 m counts as its span

# ---- the machine


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


NAMES = {"force": "N", "moment": "Nm"}
#: phasors that turn with and against the shaft, of force [N] and moment [N m]
Responses = Dict[str, Tuple[Number, Number]]


#: ceilings by the response that they limit, a component of it as force:x
CEILINGS = {
    f"{name}:{axis}" if axis else name: f"{name}_ceiling_{axis}_{unit}" if axis else f"{name}_ceiling_{unit}"
    for name, unit in NAMES.items()
    for axis in ("", "x", "y")
}


def phasors(responses: Responses, name: str) -> tuple[Number, Number]:
    """Of a response, or of a component of it, whose peak is the length of a single one: co +- conj(counter)."""
    of, _, axis = name.partition(":")
    co, counter = responses[of]
    return (co, counter) if not axis else (co + counter.conjugate() * (ONE if axis == "x" else -ONE), ZERO)


class Machine:
    """A machine in the units of the answer; its masses are exact, or known to their rounding."""

    def __init__(self, place: Place, plane: Place, budget: Place, exact: bool = False) -> None:
        (place / "rotation").text("ccw", "cw", default="ccw")
        kind = (place / "kind").text("reciprocating", "scroll")
        masses, planes, ends = (_throws if kind == "reciprocating" else _scroll)(place)
        masses += [each for own in place / "unbalances" for each in _unbalance(own)]
        self.wide, self.blur = (ONE, ZERO) if exact else (ABOUT_ONE, BLUR)
        omega = (place / "speed_rpm").number(least=0) * Number(PI, PI + 1) / Number(30 * 10**80, 30 * 10**80)
        self.square, self.masses = omega * omega, masses
        fastest = (place / "overspeed_rpm") or (place / "speed_rpm")
        turning = fastest.number(least=0) * Number(PI, PI + 1) / Number(30 * 10**80, 30 * 10**80)
        self.webs = [_web(web, turning * turning) for web in place / "webs"]
        if len({web.name for web in self.webs}) < len(self.webs):
            raise Unreadable((*place.path, "webs"), "names must be unique")
        self.budget = budget.number(least=0) if budget else None
        # where the machine says that moments are, or midway; where the answer says so is what counts from here
        self.asked_plane = (place / "reference_plane_m").number(0.5 * (min(planes) + max(planes)))
        self.plane = plane.number() if plane else self.asked_plane
        ends = [*ends, *((web / "position_m").double() for web in place / "webs")]
        span = real(max(ends)) - real(min(ends))
        self.span = span if span.low > real(NO_SPAN).high else ONE
        self.groups = _groups(place)
        #: what is there already: the program chooses beside it, within what it leaves of the budget
        there = [(web, *web.fixed) for web in self.webs if web.fixed is not None]
        fixed = [Mass(mass * web.radius, direction(angle), ZERO, web.position) for web, mass, angle in there]
        self.fixed = total(mass for _, mass, _ in there)
        self.left = largest(self.budget - self.fixed, ZERO) if self.budget is not None else None
        self.before, self.laden = self.responses([]), self.responses(fixed)

    def responses(self, weights: Sequence[Mass]) -> Responses:
        """With counterweights."""
        found = {}
        for name in NAMES:
            co = counter = ZERO
            for mass in (*self.masses, *weights):
                arm = ONE if name == "force" else mass.position * self.wide - self.plane * self.wide
                size = mass.product * self.wide * self.square * arm
                co = co + (mass.co + self.blur) * size
                counter = counter + (mass.counter + self.blur) * size if mass.counter is not ZERO else counter
            found[name] = co, counter
        return found


def _groups(place: Place) -> list[list[tuple[int, float]]]:
    """Webs that get the same casting, by number, with the angles of their own cranks, degrees."""
    names = [(web / "name").text() for web in place / "webs"]
    throws = [((one / "position_m").double(), (one / "crank_angle_deg").double()) for one in place / "throws"]
    found = []
    for group in place / "web_groups":
        found.append([(names.index(name), 0.0) for name in map(Place.text, group / "webs") if name in names])
        if len(found[-1]) < len(list(group / "webs")):
            raise NotCovered(group / "webs")
        for n, (k, _) in enumerate(found[-1] if throws else ()):
            web = list(place / "webs")[k]
            at = (web / "position_m").double()
            near = min(range(len(throws)), key=lambda t: abs(throws[t][0] - at))
            named = int((web / "throw").double(float(near))) if web / "throw" else near
            if named >= len(throws):
                raise NotCovered(web / "throw")
            found[-1][n] = k, throws[named][1]
    return found


def _web(place: Place, fastest: Number) -> Web:
    """``fastest``: square of the highest speed."""
    most, sector = place / "max_mass_kg", place / "sector"
    edges = ((sector / "centre_deg").double(), (sector / "half_angle_deg").double(least=0)) if sector else None
    there = place / "fixed"
    radius, limit = (there / "radius_m") or (place / "counterweight_radius_m"), most.number(least=0) if most else None
    weight = ((there / "mass_kg").number(least=0), (there / "angle_deg").double()) if there else None
    limit, bolts = ZERO if there else limit, place / "max_centrifugal_force_N"
    if bolts:
        of_one_kg = radius.number(least=0) * fastest
        if of_one_kg.low <= 0:
            raise NotCovered(bolts)
        force = bolts.number(least=0) / of_one_kg
        limit = force if limit is None else min(limit, force, key=lambda one: one.high)
    name, where = (place / "name").text(), (place / "position_m").number()
    return Web(name, where, radius.number(least=0), limit, edges, weight)


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


# ---- what is to be small, under which ceilings, and what multipliers prove of it (docs/mathematics.md section 5)


#: response, and co, counter or ceiling
Key = Tuple[str, str]


class Term(NamedTuple):
    """A length |start + factor f| in a row, or one that a ceiling limits; f is what counterweights add."""

    row: str
    response: str
    start: Number
    factor: Number

    @property
    def moves(self) -> str:
        """What counterweights add to it: force or moment."""
        return self.response.partition(":")[0]


class Bound(NamedTuple):
    """The rows times their multipliers are at least this; None: nothing is proven."""

    least: Optional[Number]
    rows: Dict[str, Number]


class Statement:
    """Rows, which are sums of weighted peaks, and ceilings; they go by their names in the answer."""

    def __init__(self, machine: Machine, goal: Place, rows: dict[str, dict[str, Number]], capped: bool = True) -> None:
        self.machine, self.rows = machine, rows
        self.x, self.y = ((goal / "direction_weights" / name).number(1.0, least=0) for name in ("x", "y"))
        self.floor: dict[str, Number] = dict.fromkeys(rows, ZERO)
        self.terms: dict[Key, Term] = {}
        for row, name, weight in ((r, name, weight) for r, each in rows.items() for name, weight in each.items()):
            floor, lengths = self.peak(phasors(machine.laden, name), weight)
            self.floor[row] = self.floor[row] + floor
            self.terms.update({(name, part): Term(row, name, *length) for part, length in lengths.items()})
        limits = {name: goal / field for name, field in CEILINGS.items() if capped}
        start = {name: phasors(machine.laden, name) for name in CEILINGS}
        #: ceiling less the phasor against the shaft, and the size of the ceiling
        self.caps = {n: most.number(least=0) - abs(start[n][1]) for n, most in limits.items() if most}
        self.sizes = {name: self._size(largest(abs(start[name][0]), abs(cap)), name) for name, cap in self.caps.items()}

    def _size(self, size: Number, name: str) -> Number:
        """What a ceiling is measured by; if nothing is there and nothing allowed, what the rows call for does to it."""
        if size.low > 0:
            return size
        arms = [abs(web.position - self.machine.plane) for web in self.machine.webs]
        most = {"force": ONE, "moment": largest(ZERO, *arms)}
        most = {response: arm if arm.low > 0 else ONE for response, arm in most.items()}
        moving = [one for one in self.terms.values() if abs(one.factor).low > 0]
        called = [abs(one.start) / (abs(one.factor) * most[one.moves]) for one in moving]
        size = most[name.partition(":")[0]] * largest(ZERO, *called)
        return size if size.low > 0 else self.machine.square

    def peak(self, response: tuple[Number, Number], weight: Number) -> tuple[Number, dict[str, tuple[Number, Number]]]:
        """A floor, and vectors whose lengths it adds; each with the factor of the phasor with the shaft in it."""
        p, q, f, b = weight * (self.x + self.y) * HALF, weight * (self.x - self.y) * HALF, *response
        if self.x.low == self.y.low:
            return p * abs(b), {"co": (f * p, p)}
        return ZERO, {"co": (f * p + b.conjugate() * q, p), "counter": (f * q + b.conjugate() * p, q)}

    def values(self, responses: Responses) -> dict[str, Number]:
        """Of every row."""
        found = dict.fromkeys(self.rows, ZERO)
        for row, name, weight in ((r, name, weight) for r, each in self.rows.items() for name, weight in each.items()):
            floor, lengths = self.peak(phasors(responses, name), weight)
            found[row] = found[row] + floor + total(abs(vector) for vector, _ in lengths.values())
        return found

    def bound(self, proof: Place, implied: Place, slack: dict[str, Number], cost: Number, believed: bool) -> Bound:
        """Of rows and cost * mass, for all within the limits that exceed no ceiling by more than slack.

        What the answer says that missing limits imply is believed, or shown to be of no account. Without rows
        of an objective the multipliers have those of the ceilings, and prove that they conflict.
        """
        limits = {(name, "ceiling"): Term(name, name, phasors(self.machine.laden, name)[0], ONE) for name in self.caps}
        terms = {**self.terms, **limits}
        rows, y = self._multipliers(proof, terms)
        if cost is ZERO and total(rows.values()).low <= 0:
            return Bound(None, rows)
        machine = self.machine
        price = cost + ((proof / "budget").number(0.0, least=0) if machine.left is not None else ZERO)
        free = {w.name: w for w in machine.webs if not believed and (w.limit is None or implied / w.name)}
        if price.high == 0:
            grouped = {machine.webs[k].name for group in machine.groups for k, _ in group}
            free = self._balance(y, terms, [w for w in free.values() if w.sector is None and w.name not in grouped])
        # |y| <= lambda holds by shortening all alike; what a ceiling costs is its own length, if it has no row
        most = {key: rows.get(one.row, ZERO) for key, one in terms.items()}
        most.update({key: Number(abs(y[key]).high, abs(y[key]).high) for key in limits if self.floor})
        share = _share((most[key], abs(y[key])) for key in y)
        least, slope = total(rows[name] * self.floor[name] for name in rows if self.floor), dict.fromkeys(NAMES, ZERO)
        for key, term in terms.items():
            least = least + y[key].along(term.start) * share
            slope[term.moves] = slope[term.moves] + y[key] * term.factor * share
        for name, _ in limits:
            least = least - most[name, "ceiling"] * (self.caps[name] + slack.get(name, ZERO))
        gains = self._gains(slope)
        # where a kilogram has a price, what has no limit must gain no more: all multipliers are shortened alike
        share = _share((price, gains[name]) for name in free if price.low > 0 and machine.left is None)
        least = least * share
        for web in machine.webs:
            gain = gains[web.name] * share - price
            if gain.high > 0 and (web.name not in free or (machine.left is not None and price.high > 0)):
                limit = self.reach(web, implied if believed else Place(None))
                if limit is None:
                    return Bound(None, rows)
                least = least - Number(max(gain.low, 0), gain.high) * limit
        if machine.left is not None:
            least = least - (price - cost) * machine.left
        return Bound(least, {name: row * share for name, row in rows.items()})

    def _gains(self, slope: dict[str, Number]) -> dict[str, Number]:
        """What a kilogram on each web takes off at most."""
        machine = self.machine
        gains, pulls = {}, []
        for web in machine.webs:
            pulls.append(-(slope["force"] + slope["moment"] * (web.position - machine.plane)) * machine.square)
            gains[web.name] = web.radius * support(pulls[-1], web.sector)
        for group in machine.groups:
            # of identical castings a kilogram on each gains what it does on all together
            first, crank = group[0]
            back = [(pulls[k], direction(angle).conjugate() * direction(crank)) for k, angle in group]
            pull = total(one * turned for one, turned in back) / real(len(group))
            for k, _ in group:
                gains[machine.webs[k].name] = machine.webs[k].radius * support(pull, machine.webs[first].sector)
        return gains

    def _multipliers(self, proof: Place, terms: Iterable[Key]) -> tuple[dict[str, Number], dict[Key, Number]]:
        """Of the rows and of the terms, those that are not 0 and those that are to be given."""
        rows = {(one / "name").text(): (one / "value").number(least=0) for one in proof / "rows"}
        rows = {name: row for name, row in rows.items() if row.high > 0}
        if not rows.keys() <= (self.floor or self.caps).keys():
            raise NotCovered(proof / "rows")
        y = dict.fromkeys(terms, ZERO)
        for field in ("terms", "ceilings"):
            for one in proof / field:
                part = (one / "part").text("co", "counter", default="co")
                key = (one / "response").text(), part if field == "terms" else "ceiling"
                vector = (one / "x").number() + J * (one / "y").number()
                if abs(vector).high > 0 and (key not in y or one / "angle_deg" or one / "scenario"):
                    raise NotCovered(one)
                if abs(vector).high > 0:
                    y[key] = y[key] + vector
        return rows, y

    def _balance(self, y: dict[Key, Number], terms: dict[Key, Term], webs: Sequence[Web]) -> dict[str, Web]:
        """Choose a multiplier so that webs without limit gain exactly nothing; those for which that can be done."""
        slope = dict.fromkeys(NAMES, ZERO)
        chosen: dict[str, Key] = {}
        for key, one in terms.items():
            slope[one.moves] = slope[one.moves] + y[key] * one.factor
            if one.factor.low > 0:
                chosen.setdefault(one.moves, key)
        arms = {web.position.low: web.position - self.machine.plane for web in webs}
        if len(arms) == 1 and "force" in chosen:
            # on one plane it is enough that force and moment together do nothing
            slope = {"force": slope["force"] + slope["moment"] * next(iter(arms.values()))}
        if not webs or any(abs(slope[name]).high > 0 for name in slope.keys() - chosen.keys()):
            return {}
        for name in chosen.keys() & slope.keys():
            y[chosen[name]] = y[chosen[name]] - slope[name] / terms[chosen[name]].factor
        return {web.name: web for web in webs}

    def reach(self, web: Web, implied: Place) -> Number | None:
        """Largest mass of a web: its limit, the budget or what the answer says that they imply; None without."""
        said = (implied / web.name).number(least=0) if implied / web.name else None
        limits = [limit for limit in (web.limit, self.machine.left, said) if limit is not None]
        return min(limits, key=lambda one: one.high) if limits else None

    def change(self, web: Web, row: str) -> Number:
        """What a kilogram on a web adds to a row at most."""
        arms = {"force": ONE, "moment": abs(web.position - self.machine.plane)}
        does = total(abs(one.factor) * arms[one.moves] for one in self.terms.values() if one.row == row)
        return does * web.radius * self.machine.square

    def reachable(self, implied: Place) -> Number | None:
        """What all that the limits allow adds to the rows at most; None where there is no limit."""
        limits = [self.reach(web, implied) for web in self.machine.webs]
        if None in limits:
            return None
        added = (self.change(web, row) * limit for web, limit in zip(self.machine.webs, limits) for row in self.rows)
        return total(added)

    def lightest(self, sizes: dict[str, Number]) -> Number | None:
        """The least mass that could cancel one of the rows, of these sizes; None where none can be."""
        limits = [(web, self.reach(web, Place(None))) for web in self.machine.webs]
        webs = [web for web, limit in limits if limit is None or limit.high > 0]
        most = {row: largest(ZERO, *(self.change(web, row) for web in webs)) for row in self.rows}
        found = [sizes[row] / does for row, does in most.items() if does.low > 0 and sizes[row].low > 0]
        return min(found, key=lambda one: one.high, default=None)


def _share(pairs: Iterable[tuple[Number, Number]]) -> Number:
    """What all sizes are to be multiplied by to be no more than allowed (allowed, size), at most 1."""
    share = ONE.low
    for allowed, size in pairs:
        if size.high > allowed.low:
            share = min(share, (allowed.low << BITS) // size.high)
    return Number(share, share)


def support(pull: Number, sector: tuple[float, float] | None) -> Number:
    """Largest Re(conj(pull) v) over unit-disc vectors v in the sector, or somewhat more."""
    if sector is None:
        return abs(pull)
    (along, across), (cos, sin) = (pull * direction(sector[0]).conjugate()).parts(), direction(sector[1]).parts()
    across = abs(across)
    if (along * sin).high > (across * cos).low:
        return abs(pull)
    return largest(along * cos + across * sin, ZERO)
