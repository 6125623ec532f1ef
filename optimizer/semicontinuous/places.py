"""What nodes of a tree leave the webs: nothing, anything in a sector, or at least the least that is fitted."""

from collections.abc import Callable
from dataclasses import dataclass, fields, replace

import numpy as np

from optimizer.arrays import Complex, Real
from optimizer.program.limits import Limits

#: a sector this wide is the whole turn, rad
WHOLE = np.pi
#: widest piece of a sector in which something is certainly fitted, half of it, rad
WIDEST = 0.25 * np.pi


@dataclass(frozen=True)
class Places:
    """Of N nodes, in polar coordinates; a web that is neither out nor fitted may be either, if it has a least."""

    least: Real  # (K,) kg m, the least unbalance that is fitted; 0 where there is none
    most: Real  # (K,) kg m
    out: np.ndarray  # (N, K) bool: nothing is fitted
    fitted: np.ndarray  # (N, K) bool: something is
    centre: Real  # (N, K) rad, middle of where it may be
    half: Real  # (N, K) rad, half of its opening

    @property
    def undecided(self) -> np.ndarray:
        """Webs that may be left out or not (N, K)."""
        return (self.least > 0) & ~self.out & ~self.fitted

    def chosen(self, nodes: "np.ndarray | list[int]") -> "Places":
        return self._mapped(lambda array: array[nodes])

    def beside(self, *others: "Places") -> "Places":
        """All nodes in one."""
        return replace(
            self,
            **{
                name: np.concatenate([getattr(self, name), *(getattr(each, name) for each in others)])
                for name in ("out", "fitted", "centre", "half")
            },
        )

    def without(self, node: int, web: int) -> "Places":
        """A node alone (1, K), nothing on a web."""
        one = self.chosen([node])
        one.out[0, web] = True
        return one

    def within(self, node: int, web: int, centre: float, half: float) -> "Places":
        """A node alone (1, K), something on a web, in a piece of its sector."""
        one = self.chosen([node])
        one.fitted[0, web], one.centre[0, web], one.half[0, web] = True, centre, half
        return one

    def nearest(self, angle: Real) -> Real:
        """Angles (..., N, K) [rad] within the sectors, nearest to others."""
        off = wrapped(angle - self.centre)
        return self.centre + np.clip(off, -self.half, self.half)

    def lowest(self, slope: Complex, each: Real) -> tuple[Real, Complex]:
        """Least of Re(conj(slope_k) u_k) + each_k |u_k| of every web (N, K), and where it is, kg m.

        Along a ray it is linear, so it is at its ends; the ray is the one nearest to against the slope.
        """
        wanted = np.angle(-slope)
        angle = self.nearest(wanted)
        rate = each - np.abs(slope) * np.cos(wanted - angle)
        size = np.where(self.out, 0.0, np.where(rate < 0, self.most, np.where(self.fitted, self.least, 0.0)))
        return rate * size, size * np.exp(1j * angle)

    def when_fitted(self, slope: Complex, each: Real) -> Real:
        """The same of webs that are undecided, if something is fitted (N, K)."""
        wanted = np.angle(-slope)
        rate = each - np.abs(slope) * np.cos(wanted - self.nearest(wanted))
        return rate * np.where(rate < 0, self.most, self.least)

    def _mapped(self, function: Callable[[np.ndarray], np.ndarray]) -> "Places":
        per_node = [field.name for field in fields(self)[2:]]
        return replace(self, **{name: function(getattr(self, name)).copy() for name in per_node})


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
    return Places(least, most, (least > most)[None], none, np.angle(limits.centre)[None], half[None])


def wrapped(angle: Real) -> Real:
    """Angles from -pi to pi."""
    return np.mod(angle + np.pi, 2.0 * np.pi) - np.pi
