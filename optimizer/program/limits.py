"""Where the counterweights may be: mass, sector, budget."""

import math
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from types import ModuleType
from typing import Any

import numpy as np

from optimizer.numerics.arrays import Complex, Real, all_true, columns, mapped, of_programs_of, plain, spread
from optimizer.numerics.memoization import cached_property
from optimizer.numerics.records import record
from optimizer.program.equal_castings import Alike
from optimizer.program.kernel.programs import Region

#: fields with an entry for each web
OF_WEBS = ("radius", "max_mass", "free", "centre", "half_angle_cos", "half_angle_sin")
#: leaders, images and numbers of webs where none are alike
_NONE_ALIKE = (np.empty(0, np.int64), np.empty(0, bool), np.empty(0))


@record(frozen=True)
class Limits:
    """0 <= m_k <= max_mass_k, |u_k| <= R_k m_k, u_k in its sector, sum m_k <= max_total_mass.

    A web without a sector has ``free`` set, centre 1 and half-angle 90 degrees.
    """

    radius: Real  # (..., K) m
    max_mass: Real  # (..., K) kg
    free: np.ndarray  # (..., K) bool
    centre: Complex  # (..., K) unit vectors
    half_angle_cos: Real  # (..., K)
    half_angle_sin: Real  # (..., K)
    max_total_mass: Real  # (...) kg, inf where there is no budget
    alike: Alike | None = None  # webs that carry alike counterweights, whose other limits are alike too
    marginal_radius: Real | None = None  # (..., K) m, at which one more kilogram acts where that is not the radius

    @property
    def margin(self) -> Real:
        """Radius at which one more kilogram acts, m (..., K): of a plate the lever of its edge, else the radius."""
        return self.radius if self.marginal_radius is None else self.marginal_radius

    @property
    def reach(self) -> Real:
        """Largest |u_k| that the limits allow, kg m (..., K)."""
        return self.radius * self.most

    @property
    def most(self) -> Real:
        """Largest m_k that the limits allow, kg (..., K)."""
        return np.minimum(self.max_mass, self.max_total_mass[..., None])

    @cached_property
    def all_free(self) -> bool:
        """Whether no web of any program has a sector."""
        return all_true(self.free)

    @cached_property
    def budget_ends(self) -> np.ndarray:
        """Whether the budget ends before every web is full (...)."""
        return np.asarray(np.add.reduce(self.max_mass, axis=-1) > self.max_total_mass)

    def spent(self, gain: Real) -> tuple[Real, Real]:
        """The masses of largest total gain: webs in falling order of it until the budget is spent, kg (..., K).

        And what a kilogram gains on the web at which the budget ends (...), at least 0; 0 where it does not end.

        Parameters
        ----------
        gain : (..., K) per kilogram.
        """
        *leading, webs = gain.shape
        many = math.prod(leading)
        masses, price = _knapsack().filled(
            plain(gain).reshape(many, webs),
            plain(spread(self.max_mass, gain.shape)).reshape(many, webs),
            plain(spread(self.max_total_mass, tuple(leading))).reshape(many),
        )
        return masses.reshape(gain.shape), price.reshape(leading)

    def into(self, u: Complex) -> Complex:
        """An unbalance within all limits, close to one that is nearly so, kg m (..., K)."""
        axes = self.radius.shape[:-1]
        leading = np.broadcast_shapes(axes, u.shape[:-1])
        # limits that are the same for some of the points are computed once for each
        own = axes if leading[len(leading) - len(axes) :] == axes else leading
        return within(self.region(own), leading, u)

    def region(self, leading: tuple[int, ...]) -> Region:
        """The same of programs of these axes, for compiled loops."""
        of_programs, alike = of_programs_of(leading), self.alike
        if alike is None:
            own: tuple[np.ndarray, ...] = np.empty((math.prod(leading), 0), complex), *_NONE_ALIKE
        else:
            leader, mirrored = np.array(alike.leader, np.int64), np.array(alike.mirrored, bool)
            own = of_programs(alike.turn, 1), leader, mirrored, alike.count[alike.owner].astype(float)
        return Region(
            of_programs(self.radius, 1),
            of_programs(self.max_mass, 1),
            of_programs(self.max_total_mass, 0),
            of_programs(self.free, 1),
            of_programs(self.centre, 1),
            of_programs(self.half_angle_cos, 1),
            of_programs(self.half_angle_sin, 1),
            *own,
        )

    def support(self, g: Complex) -> Real:
        """Largest Re(conj(g_k) v) over unit vectors v in sector k (docs/mathematics.md section 5), (..., K).

        It is below 0 where all of them point away, so that no rounding makes a gain of it.

        Of alike webs the mean of theirs, with vectors that are alike.
        """
        g = g if self.alike is None else self.alike.nearest(g)
        if self.all_free:
            return np.abs(g)
        rotated = g * np.conj(self.centre)
        across = np.abs(rotated.imag)
        inside = across * self.half_angle_cos <= rotated.real * self.half_angle_sin
        edge = rotated.real * self.half_angle_cos + across * self.half_angle_sin
        return np.where(self.free | inside, np.abs(g), edge)

    def opening(self, g: Complex) -> Real:
        """Growth of :meth:`support` per radian of half-angle, 1/rad (..., K)."""
        if self.all_free:
            return np.zeros(g.shape)
        rotated = g * np.conj(self.centre)
        growth = np.abs(rotated.imag) * self.half_angle_cos - rotated.real * self.half_angle_sin
        return np.where(self.free, 0.0, np.maximum(growth, 0.0))

    def mapped(self, function: Callable[[Any], Any]) -> "Limits":
        """A function of every array."""
        return Limits(
            function(self.radius),
            function(self.max_mass),
            function(self.free),
            function(self.centre),
            function(self.half_angle_cos),
            function(self.half_angle_sin),
            function(self.max_total_mass),
            None if self.alike is None else mapped(self.alike, function),
            None if self.marginal_radius is None else function(self.marginal_radius),
        )

    def permutation(self, webs: np.ndarray) -> "Limits":
        """The same with the webs, none of which are alike, in another order (K,)."""
        of_webs: dict[str, Any] = {name: getattr(self, name)[..., webs] for name in OF_WEBS}
        return replace(self, **of_webs)

    def only(self, webs: np.ndarray) -> "Limits":
        """The limits of some of the webs (K,) bool; or (N, K), of each of N programs as many, where none are alike."""
        of_webs = {name: columns(getattr(self, name), webs) for name in OF_WEBS}
        alike = None if self.alike is None else self.alike.only(webs)
        return Limits(**of_webs, max_total_mass=self.max_total_mass, alike=alike)

    def together(self, of_webs: Real) -> Real:
        """Of alike webs the sum, of others as it is (..., U)."""
        summed: Real = of_webs if self.alike is None else self.alike.summed(of_webs)
        return summed


def within(region: Region, leading: tuple[int, ...], u: Complex) -> Complex:
    """Unbalances, of these leading axes, within all limits, close to those that are nearly so."""
    webs = u.shape[-1]
    points = np.array(spread(u, (*leading, webs)), complex, order="C")
    _regions().bring(points.reshape(math.prod(leading), webs), region, np.empty(webs, complex))
    return points


# loads the compiler, a tenth of a second, and so at the first call; an import at each takes as long as a short loop
@cache
def _regions() -> ModuleType:
    from optimizer.program.kernel import regions

    return regions


@cache
def _knapsack() -> ModuleType:
    from optimizer.numerics.kernel import knapsack

    return knapsack
