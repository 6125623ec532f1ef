"""The optimum of one request, proven to 15 digits and more: what the service is compared with.

Smallest objective, least mass among the optima, smallest excess over the ceilings. Each is found by the interior point
method of :mod:`tests.hard.interior`, each with its own lower bound from the multipliers, in the same numbers.
"""

from dataclasses import dataclass
from typing import Any

from tests.hard.bounds import mass_bound, objective_bound
from tests.hard.interior import ONE, ZERO, Block, Cone, NotConverged, Number, Vector, mp, solve
from tests.hard.program import Body, Goal, Machine, Pair, Term, goal, machine

#: proven gap at which a reference is good enough, relative to the objective without counterweights
PROVEN = mp.mpf(10) ** -18
#: optima are within this share of the objective without counterweights (docs/api/certificate.md)
OPTIMUM_SHARE = mp.mpf(10) ** -6
#: a ceiling counts as kept up to this share of the larger of itself and the response without counterweights
CEILING_TOLERANCE = mp.mpf(10) ** -9
#: an excess over the ceilings that no double-precision input tells from none
DECIDED = mp.mpf(10) ** -13
#: interior given to ceilings that have none
_HAIR = mp.mpf(10) ** -24
#: a point of the interior point method is within its limits up to this
_EXACT = mp.mpf(10) ** -40


@dataclass(frozen=True)
class Reference:
    """What mathematics says about one request; objective and peaks in N, N m and kg."""

    excess: Number | None  # smallest largest relative excess over a ceiling; None without ceilings
    feasible: bool
    objective: Number | None = None  # proven to PROVEN of ``rest``
    relaxed: Number | None = None  # objective when ceilings are exceeded by their tolerance
    rest: Number = ZERO  # objective without counterweights
    noise: Number = ZERO  # rounding that the inputs carry into the objective
    mass: Number | None = None  # least mass among the optima
    mass_relaxed: Number | None = None  # least mass when ceilings are exceeded by their tolerance
    mass_price: Number = ZERO  # kg per newton of objective, at the least mass
    force: Number | None = None  # peaks at the least mass, or at the smallest objective without it
    moment: Number | None = None


def reference(body: Body) -> Reference:
    """Solve a request; where 100 digits do not hold it, as a component of 1e-222 beside 1, with six times as many.

    Raises
    ------
    NotConverged
        if the proof is not reached.
    """
    try:
        return _reference(body)
    except (NotConverged, ZeroDivisionError):
        with mp.workdps(6 * mp.dps):
            return _reference(body)


def _reference(body: Body) -> Reference:
    data = machine(body)
    actual_goal = goal(body, data)
    square = data.omega_squared
    rest = actual_goal.value(data.baseline)
    weight = [
        max((term.share for term in actual_goal.terms if term.response == r), default=ZERO, key=abs) for r in (0, 1)
    ]
    noise = 4 * (abs(weight[0]) * data.noise[0] + abs(weight[1]) * data.noise[1])
    common = {"rest": rest * square, "noise": noise * square}
    program = _Program(data, actual_goal)
    excess = None
    if actual_goal.ceilings:
        excess = program.smallest_excess()
        if excess > DECIDED:
            return Reference(excess, False, **common)
        if excess > -_HAIR:
            # nothing that keeps them has room to move
            program = program.relaxed(max(ZERO, excess) + _HAIR)
    objective, u = program.smallest_objective()
    loose = program.relaxed(CEILING_TOLERANCE)
    relaxed = loose.smallest_objective()[0] if actual_goal.ceilings else objective
    mass, mass_relaxed, price = None, None, ZERO
    if actual_goal.least_mass:
        share = min(OPTIMUM_SHARE, mp.mpf(body.get("accuracy", {}).get("relative_gap", 1e-6)))
        mass, price, u = program.least_mass(objective + share * rest)
        mass_relaxed = loose.least_mass(objective + share * rest)[0] if actual_goal.ceilings else mass
    after = data.after(u)
    return Reference(
        excess,
        True,
        objective * square,
        relaxed * square,
        mass=mass,
        mass_relaxed=mass_relaxed,
        mass_price=price / square,
        force=_peak(after.force) * square,
        moment=_peak(after.moment) * square,
        **common,
    )


def _peak(pair: tuple[Any, Any]) -> Number:
    return abs(pair[0]) + abs(pair[1])


class _Program:
    """One machine and goal in units of order one."""

    def __init__(self, data: Machine, objective: Goal) -> None:
        self.data, self.goal = data, objective
        self.reach = [_least(web.radius * web.max_mass, data.budget, web.radius) for web in data.webs]
        self.used = [k for k, reach in enumerate(self.reach) if reach > 0]
        co = (data.baseline.force[0], data.baseline.moment[0])
        influence = (ONE, max([abs(data.webs[k].arm) for k in self.used], default=ZERO) or ONE)
        call = [abs(c) / i for c, i in zip(co, influence, strict=True)]
        call += [abs(t.constant / t.share) / influence[t.response] for t in objective.terms if t.share]
        mass_radius = max(call) or max(self.reach, default=ONE) or ONE
        self.units = [mass_radius * i for i in influence]
        self.co = co

    # the three questions

    def smallest_excess(self) -> Number:
        """Smallest largest excess over the ceilings, relative to their size."""
        size = [self._size(ceiling) for ceiling in self.goal.ceilings]
        terms = tuple(
            Term(response, 1 / s, mp.mpc(0), row)
            for row, ((response, _), s) in enumerate(zip(self.goal.ceilings, size, strict=True))
        )
        floors = tuple(-cap / s for (_, cap), s in zip(self.goal.ceilings, size, strict=True))
        smallest, _ = _Program(self.data, Goal(terms, floors, (), False)).smallest_objective(_HAIR / 1000)
        return smallest

    def relaxed(self, share: Number) -> "_Program":
        """The program with every ceiling raised by a share of its size."""
        raised = tuple((ceiling[0], ceiling[1] + share * self._size(ceiling)) for ceiling in self.goal.ceilings)
        return _Program(self.data, Goal(self.goal.terms, self.goal.floors, raised, self.goal.least_mass))

    def smallest_objective(self, enough: Number = PROVEN) -> tuple[Number, Vector]:
        """The optimum, per omega^2, and counterweights that reach it."""
        rest, floor = self.goal.value(self.data.baseline), max(self.goal.floors)
        if not self.used or (self._resting() and rest <= floor):
            return rest, [mp.mpc(0)] * len(self.reach)
        smallest, _, u = self._solve(None, enough * max(abs(rest), self._unit()))
        return smallest, u

    def least_mass(self, target: Number) -> tuple[Number, Number, Vector]:
        """Least mass with an objective of at most ``target``, its price in kg per unit of objective, counterweights."""
        if not self.used or (self._resting() and self.goal.value(self.data.baseline) <= target):
            return ZERO, ZERO, [mp.mpc(0)] * len(self.reach)
        return self._solve(target, PROVEN)

    def _resting(self) -> bool:
        """Whether no counterweights at all keep the ceilings."""
        return all(abs(self.co[r]) <= cap for r, cap in self.goal.ceilings)

    def _size(self, ceiling: tuple[int, Number]) -> Number:
        """What an excess over a ceiling is measured by."""
        return max(abs(self.co[ceiling[0]]), abs(ceiling[1])) or self.units[ceiling[0]]

    def _unit(self) -> Number:
        """What counterweights can change in the objective."""
        share = self.goal.value(self.data.baseline) - max(self.goal.floors)
        return share if share > 0 else max(abs(t.share) * self.units[t.response] for t in self.goal.terms)

    # one cone program

    def _solve(self, target: Number | None, enough: Number) -> tuple[Number, Number, Vector]:
        """Smallest objective (no target) or least mass, proven to ``enough`` (least mass: relative); price of a row."""
        data, objective, unit = self.data, self.goal, self._unit()
        moving = sorted({t.response for t in objective.terms} | {r for r, _ in objective.ceilings})
        budget = data.budget is not None
        rows = 2 * len(moving) + budget
        mass_unit = max(self.reach[k] / data.webs[k].radius for k in self.used)
        blocks = [self._web_block(k, moving, budget, target is not None, mass_unit) for k in self.used]
        count = rows + len(objective.terms) + (target is None)
        shared = Block([ZERO] * count, [[-ONE if i == j else ZERO for j in range(count)] for i in range(rows)], [])
        cones = shared.cones
        for index, term in enumerate(objective.terms):
            at = 2 * moving.index(term.response)
            share = term.share * self.units[term.response] / unit
            constant = term.constant / unit
            G = [_row(count, {rows + index: -ONE}), _row(count, {at: -share}), _row(count, {at + 1: -share})]
            cones.append(Cone(G, [ZERO, constant.real, constant.imag]))
        for response, cap in objective.ceilings:
            at = 2 * moving.index(response)
            G = [_row(count, {}), _row(count, {at: -ONE}), _row(count, {at + 1: -ONE})]
            cones.append(Cone(G, [cap / self.units[response], ZERO, ZERO]))
        base = max(objective.floors)
        for row, floor in enumerate(objective.floors):
            entries = {rows + i: ONE for i, term in enumerate(objective.terms) if term.row == row}
            head = (base - floor if target is None else target - floor) / unit
            if target is None:
                entries[count - 1] = -ONE
            cones.append(Cone([_row(count, entries)], [head]))
        if budget:
            cones.append(Cone([_row(count, {rows - 1: ONE})], [data.budget / mass_unit]))
        if target is None:
            shared.cost[-1] = ONE
        rhs = []
        for response in moving:
            mass = -self.co[response] / self.units[response]
            rhs += [mass.real, mass.imag]
        if budget:
            rhs.append(ZERO)
        best: dict[str, Any] = {}

        def proven(every: list[Block]) -> bool:
            u = [mp.mpc(0)] * len(self.reach)
            for k, block in zip(self.used, every, strict=False):
                u[k] = self._unbalance(k, block.x)
            after = data.after(u)
            y, p, lam = self._multipliers(every[-1], unit, unit if target is None else mass_unit)
            if target is None:
                peak, bound = objective.value(after), objective_bound(data, objective, y, p, lam)
                margin = enough
            else:
                peak = sum((abs(v) / web.radius for v, web in zip(u, data.webs, strict=True)), ZERO)
                bound = mass_bound(data, objective, y, p, lam, target)
                margin = enough * peak
            best.update(value=peak, u=u, price=sum(lam, ZERO), gap=peak - bound)
            return peak - bound <= margin and self._violation(u, after, target) <= _EXACT

        try:
            solve([*blocks, shared], rhs, proven)
        except NotConverged as error:
            raise NotConverged(f"{error}; proven gap {mp.nstr(best.get('gap', mp.inf) / enough * PROVEN, 3)}") from None
        return best["value"], best["price"], best["u"]

    def _web_block(self, k: int, moving: list[int], budget: bool, costs: bool, mass_unit: Number) -> Block:
        """Variables (x, y, m): u = reach e^{jc} (x + j sine y), mass = m reach/radius."""
        web, reach = self.data.webs[k], self.reach[k]
        coupling = []
        for response in moving:
            factor = (reach if response == 0 else reach * web.arm) / self.units[response]
            along = factor * web.centre
            across = along * mp.mpc(0, web.sine)
            coupling += [[mp.re(along), mp.re(across), ZERO], [mp.im(along), mp.im(across), ZERO]]
        mass = reach / web.radius / mass_unit
        if budget:
            coupling.append([ZERO, ZERO, mass])
        cones = [
            Cone([[ZERO, ZERO, -ONE], [-ONE, ZERO, ZERO], [ZERO, -web.sine, ZERO]], [ZERO, ZERO, ZERO]),
            Cone([[ZERO, ZERO, ONE]], [ONE]),
        ]
        if web.cosine is not None:
            cones += [Cone([[-ONE, web.cosine * sign, ZERO]], [ZERO]) for sign in (1, -1)]
        return Block([ZERO, ZERO, mass if costs else ZERO], coupling, cones)

    def _unbalance(self, k: int, x: Vector) -> Any:
        web = self.data.webs[k]
        return self.reach[k] * web.centre * mp.mpc(x[0], web.sine * x[1])

    def _multipliers(self, shared: Block, unit: Number, value: Number) -> tuple[list[Any], list[Any], Vector]:
        """Of terms and ceilings (complex) and rows; ``value`` is the unit of what is minimised."""
        terms, ceilings, rows = len(self.goal.terms), len(self.goal.ceilings), len(self.goal.floors)
        cones = shared.cones
        y = [-mp.mpc(c.z[1], c.z[2]) * value / unit for c in cones[:terms]]
        p = [
            -mp.mpc(c.z[1], c.z[2]) * value / self.units[r]
            for c, (r, _) in zip(cones[terms : terms + ceilings], self.goal.ceilings, strict=True)
        ]
        lam = [c.z[0] * value / unit for c in cones[terms + ceilings : terms + ceilings + rows]]
        return y, p, lam

    def _violation(self, u: Vector, after: Pair, target: Number | None) -> Number:
        """Largest relative violation of a limit."""
        worst = ZERO
        for v, web, reach in zip(u, self.data.webs, self.reach, strict=True):
            if not reach:
                continue
            worst = max(worst, abs(v) / reach - 1)
            if web.cosine is not None:
                turned = v * mp.conj(web.centre)
                worst = max(worst, (abs(turned.imag) * web.cosine - turned.real * web.sine) / (reach * web.sine))
        if self.data.budget is not None:
            total = sum((abs(v) / web.radius for v, web in zip(u, self.data.webs, strict=True)), ZERO)
            worst = max(worst, total / self.data.budget - 1)
        co = (after.force[0], after.moment[0])
        for response, cap in self.goal.ceilings:
            worst = max(worst, (abs(co[response]) - cap) / self._size((response, cap)))
        if target is not None:
            worst = max(worst, (self.goal.value(after) - target) / target)
        return worst


def _least(first: Number, budget: Number | None, radius: Number) -> Number:
    return first if budget is None else min(first, radius * budget)


def _row(count: int, entries: dict[int, Number]) -> Vector:
    return [entries.get(i, ZERO) for i in range(count)]
