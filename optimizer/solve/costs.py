"""The smallest costs of choices under levels of goals: their mass, their number, their sizes.

Bisection gives the fewest that keep a level. For a number of them the smallest of the last goal is sought, until
it is below the level, or proven to be above it. The least mass is a goal as others are. Of one goal of the first order
light sets are compared outright.
"""

import logging
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from typing import NamedTuple

import numpy as np

from optimizer.choices.catalogue import Catalogue
from optimizer.choices.clock import Clock
from optimizer.choices.discrete.ample import light_sizes, offer_light_sets
from optimizer.choices.discrete.exchange import start
from optimizer.choices.discrete.lightest import lighter, lightest
from optimizer.choices.discrete.neighbourhoods import neighbourhoods
from optimizer.choices.discrete.options import EQUAL, Incumbent, Options
from optimizer.choices.discrete.search import EXHAUSTED
from optimizer.choices.feasible_set import Choice, FeasibleSet, SearchResult
from optimizer.numerics.arrays import Complex
from optimizer.program.ceilings import CEILING_TOLERANCE
from optimizer.program.cuts.dominance import Group
from optimizer.program.cuts.optimum import CertifiedOptimum, Conflict, GoalLevel, next_goal, over_turn
from optimizer.program.cuts.semi_infinite import Goal, Problem
from optimizer.program.limits import Limits
from optimizer.program.rows import total_mass
from optimizer.program.statement import Statement
from optimizer.solve.caps import NO_CAPS, Caps, cost
from optimizer.solve.cutting_plane_rounds import Start, in_rounds
from optimizer.solve.few_webs import UNKNOWN, FewWebs, compare_on_few_webs, few_webs, lightened
from schemas.request.objective import Cost

_LOG = logging.getLogger(__name__)
#: width of the brackets that compare sets, as a share of goals
_CLOSE = 1e-10
#: gap of a search for a number of castings, of any masses of least mass, and of the lightest choice
_GAP, _SHARP, _LIGHT = 1e-3, 1e-6, 1e-9
#: share of the time of a search for so few sizes in which light sets of them are tried first
_FIRST = 0.6
#: options of a slot near to the optimum of any masses, and light ones of another, pass by pass
_COUNTS = ((40, 120), (80, 300))
#: share of the time in which the fewest castings are made lighter
_LIGHTER = 0.1
#: of a set that was compared with others; its proof stands beside it
COMPARED = SearchResult(True, -np.inf, 0, EXHAUSTED)


def _of_parts(options: Options, selection: np.ndarray) -> Options:
    """The options that have the part numbers of a set (K,)."""
    parts = options.of(options.part, selection)
    exists = options.exists & ((options.part < 0) | np.isin(options.part, parts[parts >= 0]))
    return replace(options, exists=exists, most_parts=None)


class Least(NamedTuple):
    """The cheapest choice of a search, and the lower bound of its cost."""

    choice: Choice | None  # None where the search has none that keeps the levels
    lower_bound: float  # kg, or a number


@dataclass
class Costs:
    """Searches of one program whose goals all have a level; every choice that they come upon, and all that they prove.

    program : with its goals so far; of none yet with the first one, whose level is infinite.
    best : of its last goal, any masses at any angles.
    reached : of the goals before the last.
    caps : what goals before leave of other costs.
    """

    program: Problem
    best: CertifiedOptimum
    reached: Sequence[GoalLevel]
    choices: Callable[[Limits], FeasibleSet]  # within limits that hold the best of them
    caps: Caps = NO_CAPS
    size: float = 1.0  # what gaps of the last goal are relative to
    whole: bool = True  # every web takes options, none any mass beside them
    light: float = _LIGHT  # gap of the lightest choice
    offers: list[tuple[float, Choice]] = field(default_factory=list)  # with what they come to of the last goal
    few: dict[int, FewWebs] = field(default_factory=dict)  # by the number of webs
    proven: dict[tuple[Cost, int], float] = field(default_factory=dict)  # of no more than a number, of the last goal

    def least(self, kind: Cost, level: float, seconds: float) -> Least:
        """The cheapest choice whose last goal is no more than a level.

        Parameters
        ----------
        level : of the last goal; inf where it may be anything.
        """
        bound = self._lightest(level, seconds) if kind == "mass" else self._fewest(kind, level, seconds)
        return Least(self.cheapest(kind, level), bound)

    def cheapest(self, kind: Cost, level: float) -> Choice | None:
        """Of the choices that were come upon, of equally cheap ones the lightest, and of these the best."""
        within = [(value, choice) for value, choice in self.offers if value <= level]
        if not within:
            return None
        # sums of masses are rounded
        cheap = min(cost(choice, kind) for _, choice in within) * (1.0 + EQUAL)
        equal = [offer for offer in within if cost(offer[1], kind) <= cheap]
        # what is within the level is good enough, and what is light is cheap
        return min(equal, key=lambda offer: (cost(offer[1], "mass"), offer[0]))[1]

    def value(self, choice: Choice) -> float:
        """What a choice comes to of the last goal."""
        return float(self.program.values(choice.unbalance, _CLOSE).goals[-1])

    def offer(self, choice: Choice) -> None:
        """Know a choice too, if it keeps what is before the last goal."""
        values = self.program.values(choice.unbalance, _CLOSE)
        most = np.array([goal.most for goal in self.reached])
        if values.excess <= CEILING_TOLERANCE and np.all(values.goals[:-1] <= most):
            self.offers.append((float(values.goals[-1]), choice))

    def _fewest(self, kind: Cost, level: float, seconds: float) -> float:
        """Look for the fewest, and lighter ones that are as few: the number that they are at least."""
        at_least = self._bisection(kind, level, (1.0 - _LIGHTER) * seconds)
        self._lighten(kind, level, Clock(_LIGHTER * seconds))
        return at_least

    def _bisection(self, kind: Cost, level: float, seconds: float) -> float:
        """Look for the fewest: the number that they are at least."""
        clock, incumbent = Clock(seconds), self.cheapest(kind, level)
        high = self.program.limits.radius.size + 1 if incumbent is None else int(cost(incumbent, kind))
        at_least = self._at_least(kind, level, high)
        low = at_least
        while low < high and not clock.spent():
            number = (low + high) // 2
            steps = math.ceil(math.log2(high - low + 1))
            bound = self._with_so_few(kind, number, level, clock.left_s / steps)
            incumbent = self.cheapest(kind, level)
            if incumbent is not None and cost(incumbent, kind) <= number:
                high = int(cost(incumbent, kind))
                continue
            low = number + 1
            if bound > level or bound == np.inf:
                at_least = low
        while at_least < high and not clock.spent():
            # what halving has left open, from below
            bound = self._with_so_few(kind, at_least, level, clock.left_s / 2.0)
            if not (bound > level or bound == np.inf):
                break
            at_least += 1
        return float(at_least)

    def _lighten(self, kind: Cost, level: float, clock: Clock) -> None:
        """Make the cheapest choice lighter, under a level of one goal of the first order."""
        incumbent, choices = self.cheapest(kind, level), self.caps.of(self.choices(self.best.limits))
        if incumbent is None or level == np.inf or self.program.finite is None or not isinstance(choices, Catalogue):
            return
        options, limits = choices.stock.options, self.caps.within(self.best.limits)
        u = incumbent.unbalance if options.alike is None else options.alike.means(incumbent.unbalance)
        if kind == "sizes":
            options = _of_parts(options, options.nearest(u))
        light = lightened(replace(self.program.finite, limits=limits), options, options.nearest(u), level, clock)
        self.offer(choices.picked(light, COMPARED))

    def _at_least(self, kind: Cost, level: float, high: int) -> int:
        """A lower bound of the number, without a search."""
        number = 0
        while number < high:
            # no size is no counterweight, one or more of them may be on all webs
            webs = number if kind == "pieces" else 0 if number == 0 else -1
            bound = self.proven.get((kind, number), -np.inf)
            if webs >= 0:
                bound = max(bound, self._of_few_webs(webs).least)
            if not (bound > level or bound == np.inf):
                break
            number += 1
        return number

    def _with_so_few(self, kind: Cost, number: int, level: float, seconds: float) -> float:
        """Look for the best of so few: what the last goal comes to at least."""
        before = self.proven.get((kind, number), -np.inf)
        if before > level or before == np.inf:
            return before
        few = self._of_few_webs(number) if kind == "pieces" else UNKNOWN
        bound = max(before, few.least)
        if bound <= level and bound < np.inf:
            clock, caps = Clock(seconds), self.caps.lower(kind, number)
            limits = caps.within(self.best.limits)
            choices = caps.of(self.choices(limits))
            if self.program.finite is not None and len(few.points) and isinstance(choices, Catalogue):
                statement = replace(self.program.finite, limits=limits)
                bound = max(bound, self._on_few_webs(few, statement, choices, level, clock))
            elif kind == "sizes" and isinstance(choices, Catalogue):
                self._light_sizes(choices, level, Clock(_FIRST * seconds))
            incumbent = self.cheapest(kind, level)
            if bound > level or (incumbent is not None and cost(incumbent, kind) <= number):
                self.proven[kind, number] = bound
                return bound
            choice, result = in_rounds(
                self.program,
                replace(self.best, limits=limits, goals=(*self.reached, self.best.goals[-1])),
                choices,
                _GAP,
                self.size,
                lambda: clock.left_s,
                Start(None, level, tuple(few.points[:1])),
            )
            bound = max(bound, result.lower_bound)
            if result.feasible:
                self.offer(choice)
        self.proven[kind, number] = bound
        return bound

    def _of_few_webs(self, number: int) -> FewWebs:
        """What any masses on so few webs come to at least, of one goal of the first order, and their optima."""
        if number not in self.few:
            limits = self.caps.within(self.best.limits)
            self.few[number] = few_webs(self.program, limits, number) if self.whole else UNKNOWN
        return self.few[number]

    def _on_few_webs(self, few: FewWebs, statement: Statement, choices: Catalogue, level: float, clock: Clock) -> float:
        """Compare choices near the optima on few webs: the last goal at least."""

        def offer(selection: np.ndarray) -> None:
            self.offer(choices.picked(selection, COMPARED))

        return compare_on_few_webs(few, statement, choices.stock.options, level, EQUAL * self.size, offer, clock)

    def _light_sizes(self, choices: Catalogue, level: float, clock: Clock) -> None:
        """Try light sets of so few sizes, of one goal of the first order, until one keeps the level."""
        options = choices.stock.options
        if self.program.finite is None or options.most_parts == 0:
            return
        # webs without a largest mass of their own have that of what there is
        statement = replace(self.program.finite, limits=self.caps.within(self.best.limits))
        incumbent = Incumbent(statement, options, EQUAL * self.size)
        about = self.best.point.unbalance
        about = about if options.alike is None else options.alike.means(about)
        start(incumbent, about[None])
        if incumbent.selection is not None:
            sizes = light_sizes(statement, options, about) if np.isfinite(level) else None
            offer_light_sets(incumbent, statement, about, lambda: incumbent.least <= level, clock, sizes, level)
            self.offer(choices.picked(incumbent.selection, COMPARED))

    def _lightest(self, level: float, seconds: float) -> float:
        """Look for the lightest: what none is lighter than, kg."""
        clock, incumbent = Clock(seconds), self.cheapest("mass", level)
        goals = () if level == np.inf else self.program.goals
        mass = Goal("mass", (Group((total_mass(self.program.limits),)),))
        weighed = self.program.changed(goals=(*goals, mass), limits=self.caps.within(self.best.limits))
        reached = [*self.reached, self.best.goals[-1]._replace(most=level)] if goals else []
        any_mass: CertifiedOptimum | Conflict
        if incumbent is not None and reached:
            any_mass = next_goal(weighed, reached, incumbent.unbalance, _SHARP, seconds)
        else:
            any_mass = over_turn(weighed, _SHARP, False, seconds)
        if isinstance(any_mass, Conflict):
            if incumbent is None:
                return np.inf
            _LOG.error("no masses are proven to keep ceilings that a choice of %g kg keeps", cost(incumbent, "mass"))
            return 0.0
        bound = max(any_mass.proof.bound, 0.0)
        if not self.whole:
            any_mass = replace(any_mass, limits=self._no_heavier(incumbent))
        choices = self.caps.of(self.choices(any_mass.limits))
        if self.program.finite is not None and incumbent is not None and isinstance(choices, Catalogue):
            statement = replace(self.program.finite, limits=self.caps.within(self.best.limits))
            return self._compared(statement, choices, incumbent, level, bound, any_mass.point.unbalance, clock)
        size = max(any_mass.point.mass, bound) or 1.0
        choice, result = in_rounds(
            weighed,
            replace(any_mass, goals=(*reached, any_mass.goals[-1])),
            choices,
            self.light,
            size,
            lambda: clock.left_s,
            Start(incumbent),
        )
        if result.feasible:
            self.offer(choice)
        # what is weighed may be off as well
        off = self.program.scatter.of(1.0 / self.program.limits.radius, np.zeros(1, complex))
        return max((max(result.lower_bound, bound) - off) / (1.0 + self.program.scatter.share), 0.0)

    def _no_heavier(self, incumbent: Choice | None) -> Limits:
        """Limits of all that is lighter than a choice, if there is one, whatever takes no options."""
        limits = self.caps.within(self.best.limits)
        if incumbent is None:
            return limits
        return replace(limits, max_mass=np.minimum(limits.max_mass, cost(incumbent, "mass") * (1.0 + EQUAL)))

    def _compared(
        self,
        statement: Statement,
        choices: Catalogue,
        incumbent: Choice,
        level: float,
        least: float,
        relaxed: Complex,
        clock: Clock,
    ) -> float:
        """The same of one goal of the first order, by light sets that are compared outright.

        Parameters
        ----------
        incumbent : the lightest choice so far.
        least : kg, that none is lighter than.
        relaxed : (K,) kg m, the lightest of any masses.
        """
        options = choices.stock.options
        every, above = [np.flatnonzero(row) for row in options.exists], cost(incumbent, "mass")
        result = lightest(statement, options, every, level, (least, above), clock)
        if result.selection is not None:
            self.offer(choices.picked(result.selection, COMPARED))
        elif result.lower_bound < above:
            about = relaxed if options.alike is None else options.alike.means(relaxed)
            for near, many in _COUNTS:
                for candidates in neighbourhoods(options, about, near, many):
                    cheapest = self.cheapest("mass", level) or incumbent
                    selection = None
                    if not clock.spent():
                        selection = lighter(
                            statement, options, candidates, level, cost(cheapest, "mass"), clock
                        ).selection
                    if selection is not None:
                        self.offer(choices.picked(selection, COMPARED))
        return options.next_mass(result.lower_bound)
