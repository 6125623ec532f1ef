"""What nodes of a tree leave the webs: nothing, anything in a sector, or at least the least that is fitted."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from optimizer.numerics.arrays import Complex, Real
from optimizer.numerics.records import record
from optimizer.program.equal_castings import Alike
from optimizer.program.limits import Limits

#: a sector this wide is the whole turn, rad
WHOLE = np.pi
#: widest piece of a sector in which something is certainly fitted, half of it, rad
WIDEST = 0.25 * np.pi
_OF_NODES = ("out", "fitted", "centre", "half")


@record(frozen=True)
class Places:
    """Of N nodes, in polar coordinates; a web that is neither out nor fitted may be either, if it has a least."""

    least: Real  # (K,) kg m, the least unbalance that is fitted; 0 where there is none
    most: Real  # (K,) kg m
    out: np.ndarray  # (N, K) bool: nothing is fitted
    fitted: np.ndarray  # (N, K) bool: something is
    centre: Real  # (N, K) rad, middle of where it may be
    half: Real  # (N, K) rad, half of its opening
    alike: Alike | None = None  # webs of which what is decided for one is decided for all, turned or mirrored

    @property
    def undecided(self) -> np.ndarray:
        """Webs that may be left out or not (N, K)."""
        return (self.least > 0) & ~self.out & ~self.fitted

    def subset(self, nodes: "np.ndarray | list[int]") -> "Places":
        return self._mapped(lambda array: array[nodes])

    def beside(self, *more: "Places") -> "Places":
        """All nodes in one."""
        per_node: dict[str, Any] = {
            name: np.concatenate([getattr(self, name), *(getattr(places, name) for places in more)])
            for name in _OF_NODES
        }
        return replace(self, **per_node)

    def without(self, node: int, web: int) -> "Places":
        """A node alone (1, K), nothing on a web."""
        places = self.subset([node])
        places.out[0, self.beside_web(web)] = True
        return places

    def within(self, node: int, web: int, centre: float, half: float) -> "Places":
        """A node alone (1, K), something on a web, in a piece of its sector."""
        places, webs = self.subset([node]), self.beside_web(web)
        places.fitted[0, webs], places.half[0, webs] = True, half
        places.centre[0, webs] = centre if self.alike is None else self.alike.angles(web, centre)[webs]
        return places

    def beside_web(self, web: int) -> np.ndarray:
        """The webs that are alike with one, itself among them."""
        return np.array([web]) if self.alike is None else np.flatnonzero(self.alike.owner == self.alike.owner[web])

    def slopes(self, slope: Complex) -> Complex:
        """Slopes (N, K) that come to the same wherever webs are alike, and are alike themselves."""
        return slope if self.alike is None else self.alike.nearest(slope)

    def together(self, of_webs: Real) -> Real:
        """Of what is of webs (N, K), on every web the sum over those that are alike with it."""
        summed: Real = of_webs if self.alike is None else self.alike.summed(of_webs)[..., self.alike.owner]
        return summed

    def nearest(self, angle: Real) -> Real:
        """Angles (..., N, K) [rad] within the sectors, nearest to others."""
        off = principal_angle(angle - self.centre)
        return self.centre + np.clip(off, -self.half, self.half)

    def lowest(self, slope: Complex, price: Real) -> tuple[Real, Complex]:
        """Least of Re(conj(slope_k) u_k) + each_k |u_k| of every web (N, K), and where it is, kg m.

        Along a ray it is linear, so it is at its ends; the ray is the one nearest to against the slope.
        """
        direction = np.angle(-slope)
        angle = self.nearest(direction)
        rate = price - np.abs(slope) * np.cos(direction - angle)
        size = np.where(self.out, 0.0, np.where(rate < 0, self.most, np.where(self.fitted, self.least, 0.0)))
        return rate * size, size * np.exp(1j * angle)

    def when_fitted(self, slope: Complex, price: Real) -> Real:
        """The same of webs that are undecided, if something is fitted (N, K)."""
        direction = np.angle(-slope)
        rate = price - np.abs(slope) * np.cos(direction - self.nearest(direction))
        return rate * np.where(rate < 0, self.most, self.least)

    def whole(self, webs: np.ndarray) -> np.ndarray:
        """Webs (N, K) bool, with all that are alike with one of them."""
        return webs if self.alike is None else self.together(webs) > 0

    def towards(self, u: Complex) -> Real:
        """Directions (N, K) [rad] within the sectors nearest to unbalances, alike where webs are."""
        if self.alike is None:
            return self.nearest(np.angle(u))
        first = np.exp(1j * np.angle(u[..., self.alike.first]))
        return self.nearest(np.angle(self.alike.carried(first)))

    def _mapped(self, function: Callable[[np.ndarray], np.ndarray]) -> "Places":
        per_node: dict[str, Any] = {name: function(getattr(self, name)).copy() for name in _OF_NODES}
        return replace(self, **per_node)


def root(least: Real, limits: Limits) -> Places:
    """Nothing decided, one node.

    Parameters
    ----------
    least : (K,) kg m.
    limits : of one program (no leading axes).
    """
    most = limits.reach
    half = np.where(limits.free, WHOLE, np.arctan2(limits.half_angle_sin, limits.half_angle_cos))
    none = np.zeros((1, least.size), bool)
    # what is too heavy for its limit, or for the budget, is not fitted
    return Places(least, most, (least > most)[None], none, np.angle(limits.centre)[None], half[None], limits.alike)


def principal_angle(angle: Real) -> Real:
    """Angles from -pi to pi."""
    return np.mod(angle + np.pi, 2.0 * np.pi) - np.pi
