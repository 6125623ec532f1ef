"""Webs that take no options: any mass in a sector, or at least so heavy where something is fitted.

With the options of all slots decided what is left is a program of these webs alone.
"""

from dataclasses import replace

import numpy as np

from optimizer.choices.clock import Clock
from optimizer.choices.relaxations import Relaxations, solved
from optimizer.choices.semicontinuous.inside import BestPoint, lightened, sharing
from optimizer.choices.semicontinuous.places import Places, root
from optimizer.choices.semicontinuous.search import SearchGoal, search
from optimizer.numerics.arrays import Complex, Real, spread
from optimizer.numerics.memoization import cached_property
from optimizer.numerics.records import record
from optimizer.program.limits import Limits
from optimizer.program.statement import Statement

#: share of the largest mass for a web or a budget without room, as the kernel takes no 0; and where none has any, kg
_SPECK, _NOTHING = 1e-9, 1e-9
#: an optimum may be so far above the smallest objective
_SHARE = 1e-9
#: of sets whose other webs are too light, those that are made to keep their least masses
_REPAIRS = 4


@record(frozen=True)
class FreeWebs:
    """S webs behind those of the slots."""

    limits: Limits  # (S,), finite and without a budget of their own
    least: Real  # (S,) kg m, the least unbalance that is fitted; 0 where there is none

    @cached_property
    def places(self) -> Places:
        """Where anything may be."""
        return root(self.least, self.limits)

    @property
    def most(self) -> Real:
        return self.limits.reach

    @property
    def radius(self) -> Real:
        return self.limits.radius

    @property
    def semicontinuous(self) -> bool:
        """Whether some web has a least mass of what is fitted."""
        return bool(np.any(self.least > 0))

    def lowest(self, slope: Complex, price: Real) -> tuple[Real, Complex]:
        return self.places.lowest(slope, price)

    def program(self, statement: Statement, u: Complex, mass_kg: Real) -> Statement:
        """Programs (M,) of these webs alone beside others.

        Parameters
        ----------
        u : (M, W) kg m, what the webs before them carry.
        mass_kg : (M,) of that.
        """
        webs, count = self.least.size, len(u)
        mask = np.arange(u.shape[-1] + webs) >= u.shape[-1]
        about = statement.about(np.concatenate([u, np.zeros((count, webs))], axis=-1)).only(mask)
        limits = self.limits.mapped(lambda array: spread(array, (count, *array.shape)))
        left = np.maximum(statement.limits.max_total_mass - mass_kg, self._speck)
        room = np.maximum(limits.max_mass, self._speck)
        return replace(about, limits=replace(limits, max_mass=room, max_total_mass=left))

    def optima(self, programs: Statement, share: Real | None = None, clock: Clock | None = None) -> Relaxations:
        """Of programs (M,) of these webs, whatever their least masses.

        Parameters
        ----------
        share : (M,) by which the lightest may be above the smallest objective; None asks for no light ones.
        """
        count = len(programs.floor)
        level = np.full(count, _SHARE) if share is None else share
        result = solved(programs, None, level, np.zeros(count), share is not None, clock)
        # what is a speck is nothing
        has_room = (self.most > 0) & (programs.limits.max_total_mass > self._speck)[:, None]
        return result._replace(unbalance=np.where(has_room, result.unbalance, 0.0))

    @property
    def _speck(self) -> float:
        """Mass of a web or a budget without room, kg."""
        return _SPECK * float(np.max(self.limits.max_mass)) or _NOTHING

    def best(self, programs: Statement, below: float, clock: Clock) -> Complex:
        """What these webs carry at best (M, S) kg m, or nearly: of least masses what tangents find.

        Parameters
        ----------
        below : objectives from which on a set is not worth a closer look.
        """
        points = self.optima(programs, clock=clock).unbalance
        if not self.semicontinuous:
            return points
        light = np.any((np.abs(points) > 0) & (np.abs(points) < self.least), axis=-1)
        value = np.where(light, programs.objective(points), np.inf)
        for place, n in enumerate(np.argsort(value, kind="stable").tolist()):
            if not light[n]:
                break
            incumbent = BestPoint(programs.subset(n), self.places, 0.0)
            nothing = np.where(np.abs(points[n]) >= self.least, points[n], 0.0)
            incumbent.offer(np.stack([nothing, np.zeros(self.least.size, complex)]))
            if place < _REPAIRS and value[n] < below and not clock.spent():
                sharing(incumbent, points[n], clock)
            points[n] = nothing if incumbent.unbalance is None else incumbent.unbalance
        return points

    def proven(self, program: Statement, below: Statement, at_least: float, goal: SearchGoal) -> tuple[Complex, float]:
        """The best of one program that is heavy enough (S,) kg m, and what none comes to less than.

        Parameters
        ----------
        below : nowhere above the program, which the bound is of.
        """
        point = self.optima(program.alone()).unbalance[0]
        u, result = search(program, self.least, point, at_least, goal, (), below)
        return u, max(result.lower_bound, at_least)

    def lightened(self, program: Statement, u: Complex, share: float, clock: Clock) -> Complex:
        """Lighter (S,) kg m, and worse than the best of one program by a share at most; or the same."""
        incumbent = BestPoint(program, self.places, 0.0)
        incumbent.offer(u[None])
        if incumbent.unbalance is None or share <= 0.0:
            return u
        if self.semicontinuous:
            return lightened(incumbent, u, share, clock)
        light = self.optima(program.alone(), np.array([share])).unbalance
        value = float(BestPoint(program, self.places, 0.0).offer(light)[0])
        lighter = float(program.mass(light[0])) < float(program.mass(u))
        return light[0] if lighter and value <= incumbent.least + share else u
