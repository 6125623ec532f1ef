"""What is to be small, under which ceilings, and what multipliers prove of it (docs/mathematics.md section 5)."""

from __future__ import annotations

from typing import Dict, Iterable, NamedTuple, Optional, Sequence, Tuple

from verify_machine import NAMES, ON_FRAME, Machine, Responses, Web
from verify_numbers import (
    ABOUT_ONE,
    BITS,
    HALF,
    ONE,
    ZERO,
    J,
    NotCovered,
    Number,
    Place,
    largest,
    real,
    total,
)
from verify_shafts import Geared
from verify_worth import budget, of_plate, support

#: ceilings by the response that they limit, a component of it as force:x
CEILINGS = {
    f"{name}:{axis}" if axis else name: f"{name}_ceiling_{axis}_{unit}" if axis else f"{name}_ceiling_{unit}"
    for name, (unit, *_) in ON_FRAME.items()
    for axis in ("", "x", "y")
}


def weighed(goal: Place, machine: Machine) -> dict[str, Number]:
    """Weights of all responses on the frame: of the moment one over the span where none is said, of the others 0."""
    usual = {"force": ONE, "moment": ONE / machine.span}
    places = {name: goal / f"{name}_weight" for name in ON_FRAME}
    return {name: place.number(least=0) if place else usual.get(name, ZERO) for name, place in places.items()}


def phasors(responses: Responses, name: str) -> tuple[Number, Number]:
    """Of a response, or of a component of it, whose peak is the length of a single one: co +- conj(counter)."""
    of, _, axis = name.partition(":")
    co, counter = responses[of]
    return (co, counter) if not axis else (co + counter.conjugate() * (ONE if axis == "x" else -ONE), ZERO)


#: response, and co, counter or ceiling
Key = Tuple[str, str]


class Term(NamedTuple):
    """A length |start + factor f| in a row, or one that a ceiling limits; f is what counterweights add.

    Where balance shafts turn backwards their conjugate has a factor of its own.
    """

    row: str
    response: str
    start: Number
    factor: Number
    backwards: Number = ZERO  # of what balance shafts add that turn backwards

    @property
    def moves(self) -> str:
        """The response that counterweights add to."""
        return self.response.partition(":")[0]


class Bound(NamedTuple):
    """The rows times their multipliers are at least this; None: nothing is proven."""

    least: Optional[Number]
    rows: Dict[str, Number]


class Statement:
    """Rows, which are sums of weighted peaks, and ceilings; they go by their names in the answer."""

    def __init__(
        self,
        machine: Machine,
        goal: Place,
        rows: dict[str, dict[str, Number]],
        capped: bool = True,
        geared: Sequence[Geared] = (),
    ) -> None:
        """``geared``: places on balance shafts, whose mirror images are chosen where they turn backwards."""
        self.machine, self.rows, self.geared = machine, rows, geared
        self.backwards = any(gear.ratio == -1 for gear in geared)
        self.webs = [*machine.webs, *(gear.web for gear in geared)]
        self.x, self.y = ((goal / "direction_weights" / name).number(1.0, least=0) for name in ("x", "y"))
        self.floor: dict[str, Number] = dict.fromkeys(rows, ZERO)
        self.terms: dict[Key, Term] = {}
        for row, name, weight in ((r, name, weight) for r, item in rows.items() for name, weight in item.items()):
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
        webs = self.webs
        most = {n: largest(ZERO, *(abs(self.machine.arm(n, web.position)) for web in webs)) for n in ON_FRAME}
        most = {response: arm if arm.low > 0 else ONE for response, arm in most.items()}
        moving = [term for term in self.terms.values() if abs(term.factor).low > 0]
        called = [abs(term.start) / (abs(term.factor) * most[term.moves]) for term in moving]
        other = most[name.partition(":")[0]] * largest(ZERO, *called)
        other = other if other.low > 0 else self.machine.square
        # what may be rounding alone, or a little that is there
        return other if size.high <= 0 else Number(min(max(size.low, 1), other.low), max(size.high, other.high))

    def peak(self, response: tuple[Number, Number], weight: Number) -> tuple[Number, dict[str, tuple[Number, ...]]]:
        """A floor, and vectors whose lengths it adds; each with the factors of the phasors in it, forwards first."""
        p, q, f, b = weight * (self.x + self.y) * HALF, weight * (self.x - self.y) * HALF, *response
        if self.x.low == self.y.low and not self.backwards:
            return p * abs(b), {"co": (f * p, p)}
        if self.x.low == self.y.low:
            return ZERO, {"co": (f * p, p), "counter": (b.conjugate() * p, ZERO, p)}
        return ZERO, {"co": (f * p + b.conjugate() * q, p, q), "counter": (f * q + b.conjugate() * p, q, p)}

    def values(self, responses: Responses) -> dict[str, Number]:
        """Of every row."""
        sums = dict.fromkeys(self.rows, ZERO)
        for row, name, weight in ((r, name, weight) for r, item in self.rows.items() for name, weight in item.items()):
            floor, lengths = self.peak(phasors(responses, name), weight)
            sums[row] = sums[row] + floor + total(abs(vector) for vector, *_ in lengths.values())
        return sums

    def bound(
        self,
        proof: Place,
        implied: Place,
        slack: dict[str, Number],
        cost: Number,
        believed: bool,
        printed: bool = False,
    ) -> Bound:
        """Of rows and cost * mass, for all within the limits that exceed no ceiling by more than slack.

        What the answer says that missing limits imply is believed, or shown to be of no account. Without rows
        of an objective the multipliers have those of the ceilings, and prove that they conflict. ``printed``: with the
        price of the budget that is printed, beside plates too.
        """
        limits = {(name, "ceiling"): self._limited(name) for name in self.caps}
        terms = {**self.terms, **limits}
        rows, y = self._multipliers(proof, terms)
        if cost is ZERO and total(rows.values()).low <= 0:
            return Bound(None, rows)
        machine = self.machine
        price = cost + ((proof / "budget").number(0.0, least=0) if machine.left is not None else ZERO)
        free = {w.name: w for w in self.webs if not believed and (w.limit is None or implied / w.name) and not w.plate}
        if price.high == 0:
            grouped = {machine.webs[k].name for group in machine.groups for k, _, _ in group}
            free = self._balance(y, terms, [w for w in free.values() if w.sector is None and w.name not in grouped])
        # |y| <= lambda holds by shortening all alike; what a ceiling costs is its own length, if it has no row
        most = {key: rows.get(item.row, ZERO) for key, item in terms.items()}
        most.update({key: Number(abs(y[key]).high, abs(y[key]).high) for key in limits if self.floor})
        share = _share((most[key], abs(y[key])) for key in y)
        least = total(rows[name] * self.floor[name] for name in rows if self.floor)
        for key, term in terms.items():
            least = least + y[key].along(term.start) * share
        for name, _ in limits:
            least = least - most[name, "ceiling"] * (self.caps[name] + slack.get(name, ZERO))
        pulls = self._pulls({key: vector * share for key, vector in y.items()}, terms)
        gains = {web.name: web.radius * pulls[web.name] for web in self.webs}
        # where a kilogram has a price, what has no limit must gain no more: all multipliers are shortened alike
        share = _share((price, gains[name]) for name in free if price.low > 0 and machine.left is None)
        least = least * share
        if machine.left is not None and not printed:
            price = cost + budget(machine, pulls, share, cost, implied if believed else Place(None), price - cost)
        for web in self.webs:
            if web.plate is not None:
                place = implied / web.name if believed else Place(None)
                least = least - of_plate(web, web.plate, pulls[web.name] * share, price, place)
                continue
            gain = gains[web.name] * share - price
            if gain.high > 0 and (web.name not in free or (machine.left is not None and price.high > 0)):
                limit = self.reach(web, implied if believed else Place(None))
                if limit is None:
                    return Bound(None, rows)
                least = least - Number(max(gain.low, 0), gain.high) * limit
        if machine.left is not None:
            least = least - (price - cost) * machine.left
        return Bound(least, {name: row * share for name, row in rows.items()})

    def _limited(self, name: str) -> Term:
        """What a ceiling limits."""
        backwards = {"x": ONE, "y": -ONE}.get(name.partition(":")[2], ZERO)
        return Term(name, name, phasors(self.machine.laden, name)[0], ONE, backwards)

    def slopes(self, y: dict[Key, Number], terms: dict[Key, Term]) -> Tuple[dict[str, Number], dict[str, Number]]:
        """What force and moment of a kilogram metre that turns with the shaft, and against it, are multiplied by."""
        own, backwards = dict.fromkeys(NAMES, ZERO), dict.fromkeys(NAMES, ZERO)
        for key, term in terms.items():
            self.machine.add(own, term.moves, y[key] * term.factor)
            if self.backwards:
                self.machine.add(backwards, term.moves, y[key] * term.backwards)
        return own, backwards

    def _pulls(self, y: dict[Key, Number], terms: dict[Key, Term]) -> dict[str, Number]:
        """What a kilogram metre on each web takes off at most."""
        machine, (own, backwards) = self.machine, self.slopes(y, terms)

        def pull(web: Web, slope: dict[str, Number]) -> Number:
            return -(slope["force"] + slope["moment"] * (web.position - machine.plane)) * machine.square

        pulls = machine.together([pull(web, own) for web in machine.webs])
        pulls += [gear.first(pull(gear.web, own), pull(gear.web, backwards)) for gear in self.geared]
        return {web.name: support(whole, web.sector) for web, whole in zip(self.webs, pulls)}

    def _multipliers(self, proof: Place, terms: Iterable[Key]) -> tuple[dict[str, Number], dict[Key, Number]]:
        """Of the rows and of the terms, those that are not 0 and those that are to be given."""
        rows = {(entry / "name").text(): (entry / "value").number(least=0) for entry in proof / "rows"}
        rows = {name: row for name, row in rows.items() if row.high > 0}
        if not rows.keys() <= (self.floor or self.caps).keys():
            raise NotCovered(proof / "rows")
        y = dict.fromkeys(terms, ZERO)
        for field in ("terms", "ceilings"):
            for entry in proof / field:
                part = (entry / "part").text("co", "counter", default="co")
                key = (entry / "response").text(), part if field == "terms" else "ceiling"
                vector = (entry / "x").number() + J * (entry / "y").number()
                if abs(vector).high > 0 and (key not in y or entry / "angle_deg" or entry / "scenario"):
                    raise NotCovered(entry)
                if abs(vector).high > 0:
                    y[key] = y[key] + vector
        return rows, y

    def _balance(self, y: dict[Key, Number], terms: dict[Key, Term], webs: Sequence[Web]) -> dict[str, Web]:
        """Choose a multiplier so that webs without limit gain exactly nothing; those for which that can be done.

        What turns against the shaft is left as it is.
        """
        ratios = {gear.web.name: gear.ratio for gear in self.geared}
        webs = [web for web in webs if ratios.get(web.name, 1) == 1]
        slope, _ = self.slopes(y, terms)
        pivots: dict[str, Key] = {}
        for key, term in terms.items():
            if term.factor.low > 0 and term.moves in NAMES:
                pivots.setdefault(term.moves, key)
        arms = {web.position.low: web.position - self.machine.plane for web in webs}
        if len(arms) == 1 and "force" in pivots:
            # on one plane it is enough that force and moment together do nothing
            slope = {"force": slope["force"] + slope["moment"] * next(iter(arms.values()))}
        if not webs or any(abs(slope[name]).high > 0 for name in slope.keys() - pivots.keys()):
            return {}
        for name in pivots.keys() & slope.keys():
            y[pivots[name]] = y[pivots[name]] - slope[name] / terms[pivots[name]].factor
        return {web.name: web for web in webs}

    def reach(self, web: Web, implied: Place) -> Number | None:
        """Largest mass of a web: its limit, the budget or what the answer says that they imply; None without."""
        implication = (implied / web.name).number(least=0) if implied / web.name else None
        cut = real(web.plate.mass(web.plate.most)) * ABOUT_ONE if web.plate else None
        limits = [limit for limit in (web.limit, self.machine.left, implication, cut) if limit is not None]
        return min(limits, key=lambda number: number.high) if limits else None

    def change(self, web: Web, row: str) -> Number:
        """What a kilogram on a web adds to a row at most."""
        arms = {name: abs(self.machine.arm(name, web.position)) for name in ON_FRAME}
        on_shafts = {gear.web.name: gear for gear in self.geared}

        def factor(term: Term) -> Number:
            gear = on_shafts.get(web.name)
            return term.factor if gear is None else gear.first(term.factor, term.backwards)

        does = total(abs(factor(term)) * arms[term.moves] for term in self.terms.values() if term.row == row)
        radius = real(web.plate.lever(0.0)) * ABOUT_ONE if web.plate else web.radius
        return does * radius * self.machine.square

    def reachable(self, implied: Place) -> Number | None:
        """What all that the limits allow adds to the rows at most; None where there is no limit."""
        gain = ZERO
        for web in self.webs:
            limit = self.reach(web, implied)
            if limit is None:
                return None
            gain = gain + total(self.change(web, row) for row in self.rows) * limit
        return gain

    def lightest(self, sizes: dict[str, Number], implied: Place) -> Number | None:
        """The least mass that could cancel one of the rows, of these sizes; None where none can be."""
        limits = [(web, self.reach(web, implied)) for web in self.webs]
        webs = [web for web, limit in limits if limit is None or limit.high > 0]
        most = {row: largest(ZERO, *(self.change(web, row) for web in webs)) for row in self.rows}
        masses = [sizes[row] / does for row, does in most.items() if does.low > 0 and sizes[row].low > 0]
        return min(masses, key=lambda number: number.high, default=None)


def _share(pairs: Iterable[tuple[Number, Number]]) -> Number:
    """What all sizes are to be multiplied by to be no more than allowed (allowed, size), at most 1."""
    share = ONE.low
    for allowed, size in pairs:
        if size.high > allowed.low:
            share = min(share, (allowed.low << BITS) // size.high)
    return Number(share, share)
