"""What the multipliers of cuts prove of goals over a revolution, in every case.

Of bearing loads, bending moments, roll, and force and moment of all orders a cut is the response at one shaft angle: a
length that is affine in the unbalances. Rows of lengths times multipliers are no more than the objective, and what they
pull at the webs with is taken off as far as the limits reach.
"""

from __future__ import annotations

from copy import copy
from typing import Dict, List, Optional, Sequence, Tuple

from verify_answer import Fitted
from verify_cases import cases, goals, scatter
from verify_claims import EVIDENCE, Claims
from verify_curves import root
from verify_cuts import Group, Part, Term
from verify_machine import ON_FRAME, Machine, Web, over
from verify_numbers import ONE, ZERO, J, NotCovered, Number, Place, largest, real, total
from verify_program import CEILINGS, weighed
from verify_worth import of_plate, support, worth_of_budget

#: share of a bound that the rounding of multipliers may take off
FAINT = 1e-12
#: components on the frame, of which the real part alone counts
ALONG = [name for name in CEILINGS if ":" in name]
#: products of cuts with rows, masses and webs that are evaluated at a time
MOST = 30_000


class Pulls:
    """What multipliers prove before counterweights, and what they pull at every web with, and scatter it by."""

    def __init__(self, least: Number, webs: Sequence[Web]) -> None:
        self.least = least
        self.slopes, self.spread = [ZERO for _ in webs], [ZERO for _ in webs]


class Program:
    """The objective by its cuts, in every case, and what multipliers prove of it."""

    def __init__(self, request: Place, machine: Machine, answer: Place) -> None:
        goal = request / "objective"
        self.machine, self.off, self.goal_names = machine, scatter(request), goals(request)
        self.scattered = self.off.share.high > 0 or self.off.besides.high > 0
        weights = {name: weight for name, weight in weighed(goal, machine).items() if weight.high > 0}
        for kind in ("bearing", "bending", "roll"):
            weights[kind] = (goal / f"{kind}_weight").number(0.0, least=0)
        external = {name: weights[name] for name in ON_FRAME if name in weights}
        together = (goal / "combine").text("sum", "max", default="sum") == "sum"
        self.rows = {"sum": external} if together else {name: {name: weight} for name, weight in external.items()}
        every = cases(request, machine, answer / "reference_plane_m")
        self.parts = {case.name: Part(case, weights, self.goal_names) for case in every}
        self.first = next(iter(self.parts.values()))
        #: what is proven may be a mean of several corners, whose shares are not told
        self.mixed = bool(self.first.corners)
        self.webs = [*machine.webs, *(entry.web for entry in self.first.geared)]
        #: of the last bound: what it rises by per kg m on each web
        self.slopes: List[Number] = []
        entries = answer / "certificate" / "goals"
        self.levels = [
            (entry / "limit").number() for entry in entries if (entry / "goal").text() in self.goal_names[:-1]
        ]
        if answer and len(self.levels) != len(self.goal_names) - 1:
            raise NotCovered(answer / "certificate" / "goals")

    def up_to(self, goal: int) -> Program:
        """The same with the goals up to one."""
        program = copy(self)
        program.goal_names, program.levels = self.goal_names[: goal + 1], self.levels[:goal]
        return program

    def part(self, cut: Place) -> Part:
        """The machine of its case."""
        name = (cut / "scenario").text() if cut / "scenario" else None
        if name not in self.parts:
            raise NotCovered(cut)
        return self.parts[name]

    def terms(self, proof: Place) -> List[Term]:
        """Terms of the objective with their multipliers."""
        places, size = list(proof / "terms"), self.first
        if len(places) * (len(size.turn.rows) + len(self.machine.masses) + len(self.webs)) > MOST:
            raise NotCovered(proof / "terms")
        allowed = {(row / "name").text(): (row / "value").number(least=0) for row in proof / "rows"}
        cuts: Dict[Tuple[Part, str], List[Place]] = {}
        for cut in places:
            cuts.setdefault((self.part(cut), (cut / "row").text()), []).append(cut)
        worst = {key: key[0].worst(of_row, allowed.get(key[1], ZERO)) for key, of_row in cuts.items()}
        return [part.term(cut, worst[part, (cut / "row").text()]) for cut in places for part in [self.part(cut)]]

    def reached(self, terms: List[Term], fitted: Fitted) -> Number:
        """What counterweights come to of the last goal, at the angles of the cuts."""
        rows: Dict[Tuple[Group, str], Number] = {}
        # what is fixed is in the start of every cut
        own = [ZERO if web.fixed else item.product * item.co for item, web in zip(fitted.turning, self.machine.webs)]
        exact = [*own, *(item.vector(mass) for item, (_, mass) in zip(self.first.geared, fitted.on_shafts))]
        sizes, wide = [abs(item) for item in exact], self.machine.wide
        # weights that are large beside what they leave: each is a figure of its own
        vectors = [item * wide + self.machine.blur * size for item, size in zip(exact, sizes)]
        for item in terms:
            point = item.start
            for vector, factor in zip(vectors, item.factors):
                point = point + vector * factor
            point = point.parts()[0] if item.scalar else point
            before = rows.get((item.group, item.row), item.floor)
            length = abs(point) + self.off.of(item.factors, sizes)
            rows[item.group, item.row] = before + (abs(length + J * item.still) if item.mean else length)
        groups = {group for group, _ in rows if group[1] == len(self.goal_names) - 1}
        most = {group: largest(*(value for (of, _), value in rows.items() if of == group)) for group in groups}
        every = {group[0] for group in groups}
        return largest(ZERO, *(total(value for group, value in most.items() if group[0] == case) for case in every))

    def bound(
        self, proof: Place, terms: List[Term], implied: Place, cost: Number = ZERO, most: Number = ZERO
    ) -> Tuple[Optional[Number], bool]:
        """Of the last goal, or of the mass with goals up to ``most``, and whether implied limits are believed."""
        rows = {(entry / "name").text(): (entry / "value").number(least=0) for entry in proof / "rows"}
        group_of = {entry.row: entry.group for entry in terms}
        if any(group_of[entry.row] != entry.group for entry in terms):
            raise NotCovered(proof / "terms")
        rows = {name: value for name, value in rows.items() if value.low > 0 and name in group_of}
        rows, terms = _means(rows, terms, self.scattered)
        group_of = {entry.row: entry.group for entry in terms}
        sums = {group: total(value for name, value in rows.items() if group_of[name] == group)
                for group in {group_of[name] for name in rows}}  # fmt: skip
        if cost is ZERO and not sums:
            return None, False
        share, charge = self._shares(sums, cost, most, proof)
        floors = {entry.row: entry.floor for entry in terms}
        pulls = Pulls(total(value * share[group_of[name]] * floors[name] for name, value in rows.items()), self.webs)
        pulls.least = pulls.least - charge
        for entry in terms:
            if entry.row in rows:
                self._add(pulls, entry, rows[entry.row], share[entry.group])
        self._add_ceilings(pulls, proof)
        self.slopes = pulls.slopes
        return self.within_limits(pulls, proof, implied, cost)

    def _add(self, pulls: Pulls, term: Term, allowed: Number, share: Number) -> None:
        """A term with its multiplier; |y| <= lambda holds by shortening."""
        y = term.y.parts()[0] if term.scalar else term.y
        size = abs(y)
        if self.scattered:
            grown = (term.pull if term.mean else allowed) * share
            pulls.spread = [
                old + grown * self.off.share * abs(factor) for old, factor in zip(pulls.spread, term.factors)
            ]
            pulls.least = pulls.least + grown * self.off.besides * total(map(abs, term.factors))
        if size.low > 0:
            shorter = share * (allowed / size if size.high > allowed.low else ONE)
            shorter = Number(min(shorter.low, share.low), min(shorter.low, share.low))
            pulls.least = pulls.least + y.along(term.start) * shorter
            pulls.slopes = [
                slope + factor.conjugate() * y * shorter for slope, factor in zip(pulls.slopes, term.factors)
            ]

    def _add_ceilings(self, pulls: Pulls, proof: Place) -> None:
        for limit in proof / "ceilings":
            p = (limit / "x").number() + J * (limit / "y").number()
            if abs(p).high <= 0:
                continue
            part = self.part(limit)
            start, factors, cap = part.capped(limit)
            if limit / "angle_deg" and (limit / "response").text() in ALONG:
                p = p.parts()[0]
            pulls.least = pulls.least + p.along(start) - abs(p) * cap
            if self.scattered:
                # what is off by itself has to keep the ceiling too
                grown = abs(p) * self.off.share
                pulls.spread = [old + grown * abs(factor) for old, factor in zip(pulls.spread, factors)]
                pulls.least = pulls.least + abs(p) * self.off.besides * total(map(abs, factors))
            pulls.slopes = [slope + factor.conjugate() * p for slope, factor in zip(pulls.slopes, factors)]

    def within_limits(self, pulls: Pulls, proof: Place, implied: Place, cost: Number) -> Tuple[Optional[Number], bool]:
        """What is proven before counterweights, less what these take off at most."""
        machine, least, believed = self.machine, pulls.least, False
        beta = (proof / "budget").number(0.0, least=0) if machine.left is not None else ZERO
        pulled = list(zip(self.webs, machine.together([-slope for slope in pulls.slopes]), pulls.spread))
        if beta is not ZERO and not any(web.plate for web in self.webs):
            gains = [
                (web.radius * (support(pull, web.sector) - wide) - cost, self.first.exact.reach(web, implied))
                for web, pull, wide in pulled
            ]
            beta = worth_of_budget(beta, gains, machine.left)
        for web, pull, wide in pulled:
            if web.plate is not None:
                pull, place = support(pull, web.sector) - wide, implied / web.name
                taken = of_plate(web, web.plate, pull, cost + beta, Place(None))
                within = of_plate(web, web.plate, pull, cost + beta, place) if place else taken
                # of a very large plate the rounding of multipliers is much, of what it is implied to carry little
                if (taken - within - abs(least) * real(FAINT)).low > 0:
                    believed, taken = True, within
                least = least - taken
                continue
            gain = web.radius * (support(pull, web.sector) - wide) - cost - beta
            if gain.high <= 0:
                continue
            carries = self.first.exact.reach(web, Place(None))
            if carries is None or implied / web.name:
                believed, carries = True, self.first.exact.reach(web, implied)
            if carries is None:
                return None, True
            least = least - Number(max(gain.low, 0), gain.high) * carries
        return least - (beta * machine.left if machine.left else ZERO), believed

    def _shares(
        self, sums: Dict[Group, Number], cost: Number, most: Number, proof: Place
    ) -> Tuple[Dict[Group, Number], Number]:
        """What the rows of every group are multiplied by, and what the levels of goals are charged with.

        The largest of several cases is no less than their mean with prices that sum to 1. A goal that is kept below a
        level takes the price times the level off. A price is the largest sum of the groups of a case.
        """
        prices: Dict[Tuple[Optional[str], int], Number] = {}
        for (case, goal, _), value in sums.items():
            prices[case, goal] = largest(prices.get((case, goal), ZERO), value)
        last = len(self.goal_names) - 1
        if len(prices) == 1 and last == 0:
            (price,) = prices.values()
            price = ONE if cost is ZERO else price
            return {group: over(price, value, proof) for group, value in sums.items()}, price * most
        whole = total(price for (_, goal), price in prices.items() if goal == last)
        share = ONE if cost is not ZERO else over(ONE, whole, proof)
        share = Number(share.low, share.low)
        levels = [*self.levels, most]
        charge = total(price * levels[goal] for (_, goal), price in prices.items() if goal < last or cost is not ZERO)
        return dict.fromkeys(sums, share), charge * share


def by_cuts(
    claim: str,
    entry: Place,
    bound: Tuple[Optional[Number], bool],
    implied: Place,
    proof: Place,
    besides: Number = ZERO,
    mixed: bool = False,
) -> Claims:
    """What is said is no more than cuts prove.

    ``besides``: what is there in any case. ``mixed``: how cases share what is proven is not told.
    """
    least, believed = bound
    if believed:
        yield "reach", implied, None, ONE
    room = None if least is None or not entry else least + besides - entry.number()
    if mixed and room is not None and room.high < 0:
        room = None
    yield claim, entry, room, largest(abs(entry.number(0.0)), abs(least or ZERO))
    if room is not None:
        yield EVIDENCE, proof, None, ONE
        yield EVIDENCE, implied, None, ONE


def _means(rows: Dict[str, Number], terms: List[Term], scattered: bool) -> Tuple[Dict[str, Number], List[Term]]:
    """All rows of a root mean square as one, hypot(length, what stays), with y of the length and z of what stays.

    y^2 + z^2 is no more than the square of the row: z is what y leaves of it. Scattered masses make the length longer
    also where y is short: with any pull between y and the row, of which z is what is left.
    """
    together: Dict[Tuple[str, Group], List[Term]] = {}
    for term in terms:
        if term.mean and term.row in rows:
            together.setdefault((term.mean, term.group), []).append(term)
    result = [term for term in terms if not term.mean]
    rows = dict(rows)
    for (name, group), cuts in together.items():
        allowed, y = total(rows[term.row] for term in cuts), total(term.y for term in cuts)
        pull = abs(y)
        if scattered:
            pull = largest(pull, total(rows[term.row] * term.share for term in cuts))
        for term in cuts:
            del rows[term.row]
        pull = Number(min(pull.low, allowed.low), min(pull.high, allowed.high))
        left = root(largest(allowed * allowed - pull * pull, ZERO))
        of = f"{name} of {group}"
        rows[of] = allowed
        result.append(cuts[0]._replace(row=of, y=y, pull=pull, floor=left / allowed * cuts[0].still))
    return rows, result
