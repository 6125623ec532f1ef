"""What one machine answers at the angles of cuts: vectors of an objective over the turn, and what ceilings limit."""

from __future__ import annotations

from functools import cached_property
from typing import Dict, Iterable, List, NamedTuple, Optional, Sequence, Tuple

from verify_answer import Fitted
from verify_bearings import SAMPLE
from verify_cases import Case, Scatter, corners, goal_of
from verify_curves import Turn
from verify_loads import Loads
from verify_machine import ON_FRAME, Mass, Responses, over
from verify_numbers import ABOUT_ONE, ONE, SPECK, ZERO, J, NotCovered, Number, Place, largest, real, total
from verify_program import CEILINGS, Statement
from verify_program import Term as Length
from verify_shafts import Geared, geared

#: fields of an objective that look at the whole turn and are known here
FIELDS = (
    "orders bearing_weight bearing_ceiling_N specific_load_ceiling_Pa bending_weight bending_ceiling_Nm roll_weight"
)
#: of balance shafts
SHAFTS = " balance_shafts speed_ratio x_m y_m roll_weight "
#: share by which one corner may be worse than another that counts as bad
ALIKE = Number(-real(2e-14).high, real(2e-14).high)
#: case, goal and kind
Group = Tuple[Optional[str], int, str]


class Term(NamedTuple):
    """|start + sum of factors times unbalances|, in a row of the objective; or what a ceiling limits."""

    row: str
    group: Group
    start: Number
    factors: List[Number]  # of every web, and of those of balance shafts, per kg m
    y: Number  # its multiplier
    floor: Number  # of its row
    scalar: bool = False  # the real part alone counts
    mean: str = ""  # of a root mean square, the response
    still: Number = ZERO  # what it has beside the length, at a right angle to it
    share: Number = ZERO  # of its row's multiplier, that of the length
    pull: Number = ZERO  # what its multiplier pulls at scattered masses with, in any direction


class Part:
    """What one machine of a program answers: the vectors of its cuts, and what its ceilings limit."""

    def __init__(self, case: Case, weights: Dict[str, Number], goal_names: Sequence[str]) -> None:
        request, machine = case.request, case.machine
        self.machine, self.goal, self.case, self.goal_names = machine, request / "objective", case, goal_names
        goal = self.goal
        self.all = (goal / "orders").text("first", "all", default="first") == "all"
        self.apart = (goal / "combine").text("sum", "max", default="sum") == "sum"
        self.unweighted = weights
        self.weights = {name: weight * case.weight for name, weight in weights.items()}
        self.mean = (goal / "bearing_measure").value == "rms"
        self.area, self.specific = {}, (goal / "bearing_measure").value == "specific"
        if self.specific or goal / "specific_load_ceiling_Pa":
            for entry in request / "machine" / "bearings":
                self.area[(entry / "name").text()] = (entry / "diameter_m").number() * (entry / "length_m").number()
        names = FIELDS.split()[1:]
        loads = any((goal / name).value not in (None, 0) for name in names)
        rolls = weights["roll"].high > 0
        self.turn = Turn(request, machine, loads or rolls)
        limits = [*names, *(CEILINGS.values() if self.all else ())]
        self.limited = any("_ceiling_" in name and goal / name for name in limits)
        self.of_shaft = loads and any((goal / name).value not in (None, 0) for name in names if name != "roll_weight")
        self.over_turn = loads or rolls or self.all
        if loads and self.turn.spans is None:
            raise NotCovered(request / "machine" / "bearings")
        for row in self.turn.rows if self.over_turn else ():
            if not row.place / "connecting_rod":
                raise NotCovered(row.place / "connecting_rod")
        external = {name: self.weights[name] for name in ON_FRAME if name in self.weights and not self.all}
        self.rows = {"sum": external} if self.apart else {name: {name: weight} for name, weight in external.items()}
        self.geared = geared(request / "machine", machine, mirrored=not self.all)
        self.exact = Statement(machine, goal, self.rows if external else {}, not self.all, self.geared)
        #: where reciprocating masses are off: every peak has a corner of its own, and so has a row of its own
        self.corners = corners(request, machine)
        if self.corners and self.over_turn:
            raise NotCovered(request / "tolerances" / "reciprocating_mass_relative")
        self.machines = self.corners or [machine]
        rows = {name: {name: weight} for name, weight in external.items()}
        at_corners = [Statement(corner, goal, rows, False, self.geared) for corner in self.corners]
        self.statements = at_corners or [self.exact]

    @cached_property
    def loads(self) -> Loads:
        """Curves over the revolution."""
        return Loads(self.case.request / "machine", self.machine, self.turn)

    def placed(self, fitted: Fitted) -> Fitted:
        """Counterweights where this machine has its webs."""
        webs = zip(fitted.turning, self.machine.webs)
        return fitted._replace(turning=[mass._replace(position=web.position) for mass, web in webs])

    def worst(self, cuts: Sequence[Place], allowed: Number) -> Statement:
        """The statement in which the cuts of one row of the first order prove most: any of its corners proves it."""
        if not self.corners:
            return self.exact
        y = {
            ((cut / "response").text(), (cut / "part").text("co", "counter")): (cut / "x").number()
            + J * (cut / "y").number()
            for cut in cuts
        }
        if not y.keys() <= self.statements[0].terms.keys():
            raise NotCovered(cuts[0])

        def proves(statement: Statement) -> float:
            terms = {key: statement.terms[key] for key in y}
            floors = {term.row: statement.floor[term.row] for term in terms.values()}
            of_floors = total(floors.values()) * allowed
            return float(of_floors + total(y[key].along(term.start) for key, term in terms.items()))

        return max(self.statements, key=proves)

    def term(self, cut: Place, statement: Statement) -> Term:
        """A cut; ``statement``: of the machine whose first order it is about."""
        response, row = (cut / "response").text(), (cut / "row").text()
        kind, _, name = response.partition(":")
        y = (cut / "x").number() + J * (cut / "y").number()
        if kind not in self.weights or self.weights[kind].high <= 0 or not self.turn.knows(response):
            raise NotCovered(cut)
        if not cut / "angle_deg" and not (kind == "bearing" and self.mean):
            exact = statement.terms.get((response, (cut / "part").text("co", "counter")))
            if exact is None:
                raise NotCovered(cut)
            floor = statement.floor[exact.row]
            return Term(
                row,
                self._group(response if self.corners else "first"),
                exact.start,
                self.of_first_order(exact),
                y,
                floor,
            )
        if kind == "bearing" and self.mean:
            # without a share the multiplier itself is the least that it can be
            return self._mean(response, row, y)._replace(share=(cut / "share").number(0.0, least=0))
        weight, degrees = self.weights[kind] * ABOUT_ONE, (cut / "angle_deg").double()
        weight = over(weight, self.area[name], cut) if kind == "bearing" and self.specific else weight
        start, factors = self.turn.on_shaft(response, degrees) * weight, self.at(response, degrees, weight)
        return Term(row, self._group(kind), start, factors, y, ZERO, kind == "roll")

    def _mean(self, response: str, row: str, y: Number) -> Term:
        """Of a root mean square: the length of the mean, as the shaft sees it, beside all that moves around it."""
        weight, curve = self.weights["bearing"] * ABOUT_ONE, self.loads.curve(response)
        off = SAMPLE * self.loads.size_of(response)
        around = Number(real(-off).low, real(off).high)
        mean = curve.mean
        start = real(mean.real) + around + J * (real(mean.imag) + around) + self._fixed(response)
        still = real(curve.plus(-mean).rms) + around
        factors = [*self._factors(response, weight), *(ZERO for _ in self.geared)]
        return Term(row, self._group("bearing"), start * weight, factors, y, ZERO, False, response, still * weight)

    def _fixed(self, response: str) -> Number:
        """What weights that are there already add."""
        fixed = ((self.turn.factor(response, mass.position) * mass.product, mass) for mass in self.machine.there)
        return total(size * (mass.co + self.machine.blur) for size, mass in fixed) * self.machine.square

    def of_first_order(self, term: Length) -> List[Number]:
        """Factors of a length of the first order."""
        back = [gear.first(term.factor, term.backwards) * self._arm(term.moves, gear) for gear in self.geared]
        return [*self._factors(term.moves, term.factor), *back]

    def of_ceiling(self, response: str) -> List[Number]:
        """Factors of what a ceiling of the first order limits."""
        axis = response.partition(":")[2]
        return self.of_first_order(Length("", response, ZERO, ONE, {"x": ONE, "y": -ONE}.get(axis, ZERO)))

    def at(self, response: str, degrees: float, weight: Number) -> List[Number]:
        """Factors of a response at a shaft angle."""
        unit, square = self.turn.unit(degrees), self.machine.square
        if response == "roll":
            on_shafts = [item.roll(unit) * square for item in self.geared]
        else:
            # those on balance shafts do not load the crankshaft
            moves = response in ON_FRAME
            on_shafts = [item.on_shaft(unit) * self._arm(response, item) if moves else ZERO for item in self.geared]
        return [*self._factors(response, weight), *(item * weight for item in on_shafts)]

    def _arm(self, response: str, shaft_web: Geared) -> Number:
        return self.turn.factor(response, shaft_web.web.position) * self.machine.square

    def value(self, weights: Sequence[Mass], off: Scatter, sizes: Sequence[Number]) -> Number:
        """The objective of the first order where counterweights of these sizes [kg m] are off."""
        most: Dict[str, Number] = {}
        parts: Dict[str, Number] = {}
        for statement in self.statements:
            responses = statement.machine.responses(weights)
            rows = statement.values(responses)
            for term in statement.terms.values():
                rows[term.row] = rows[term.row] + off.of(self.of_first_order(term), sizes)
            most = {name: largest(row, most.get(name, ZERO)) for name, row in rows.items()}
            for name in rows if self.corners else ():
                parts[name] = largest(self.size(statement, responses, name), parts.get(name, ZERO))
        # what is left at one corner is rounded by what cancels at another
        for name, size in parts.items():
            most[name] = most[name] + SPECK * size + ALIKE * most[name]
        return total(most.values()) if self.corners and self.apart else largest(ZERO, *most.values())

    def size(self, statement: Statement, responses: Responses, name: str) -> Number:
        """Of what a weighed peak is the length of, before components of it cancel."""
        co, counter = responses[name]
        return (abs(co) + abs(counter)) * (statement.x + statement.y) * self.weights[name]

    def together(self, rows: Iterable[float]) -> float:
        """The same of rows whose largest values are known."""
        return sum(rows) if self.corners and self.apart else max(rows, default=0.0)

    def peak(self, weights: Sequence[Mass], name: str, off: Scatter, sizes: Sequence[Number]) -> Number:
        """The largest of a response of the first order, likewise."""
        phasors = [corner.responses(weights)[name] for corner in self.machines]
        return largest(ZERO, *(abs(co) + abs(counter) for co, counter in phasors)) + self.grown(name, off, sizes)

    def grown(self, name: str, off: Scatter, sizes: Sequence[Number]) -> Number:
        """What both lengths of a response of the first order grow by at most."""
        first = (gear if abs(gear.ratio) == 1 else None for gear in self.geared)
        on_shafts = [ZERO if gear is None else self._arm(name, gear) for gear in first]
        own = [self.machine.arm(name, web.position) * self.machine.square for web in self.machine.webs]
        return off.of([*own, *on_shafts], sizes)

    def _group(self, kind: str) -> Group:
        goal = goal_of(kind, self.goal_names)
        return self.case.name, goal, kind if self.apart else "all"

    def _factors(self, response: str, factor: Number) -> List[Number]:
        square = self.machine.square
        return [self.turn.factor(response, web.position) * square * factor for web in self.machine.webs]

    def capped(self, cut: Place) -> Tuple[Number, List[Number], Number]:
        """What a ceiling limits, and how much it allows."""
        response, goal = (cut / "response").text(), self.goal
        kind, _, name = response.partition(":")
        along = bool(name) and kind in ON_FRAME
        if cut / "angle_deg" and not self.turn.knows(kind if along else response):
            raise NotCovered(cut)
        if not cut / "angle_deg":
            if response not in self.exact.caps:
                raise NotCovered(cut)
            co, counter = self.machine.laden[kind]
            start = co if not name else co + counter.conjugate() * (ONE if name == "x" else -ONE)
            return start, self.of_ceiling(response), self.exact.caps[response]
        degrees = (cut / "angle_deg").double()
        if along and self.all and response in CEILINGS and goal / CEILINGS[response]:
            # the real part of what is turned to the frame and to the axis
            back = self.turn.unit(degrees) * (ONE if name == "x" else -J)
            factors = [factor * back for factor in self.at(kind, degrees, ONE)]
            return self.turn.on_shaft(kind, degrees) * back, factors, (goal / CEILINGS[response]).number(least=0)
        start = self.turn.on_shaft(response, degrees)
        field = CEILINGS.get(kind) or {"bearing": "bearing_ceiling_N"}.get(kind, "")
        caps = [limit.number(least=0) for limit in [goal / (field or "bending_ceiling_Nm")] if limit]
        if kind == "bearing" and goal / "specific_load_ceiling_Pa":
            caps.append((goal / "specific_load_ceiling_Pa").number(least=0) * self.area[name])
        if not caps:
            raise NotCovered(cut)
        return start, self.at(response, degrees, ONE), min(caps, key=lambda cap: cap.high)
