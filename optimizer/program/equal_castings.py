"""Webs that carry alike counterweights: each that of another, turned, or the mirror image of it.

A unit is the webs of one group, or a web by itself. With w the unbalance of its first web, web k carries t_k w, or
t_k conj(w) where it is mirrored. The possible unbalances are a space over the real numbers; the nearest point of it to
any other is a mean over every unit (docs/mathematics.md section 5).
"""

from typing import Any

import numpy as np

from optimizer.numerics.arrays import Complex, Real
from optimizer.numerics.records import record


@record(frozen=True)
class Alike:
    """Which webs are alike; what is no array is common to all programs."""

    turn: Complex  # (..., K) unit vectors t_k, 1 of the first web of a unit
    ahead_deg: Real  # (..., K) their angles
    leader: tuple[int, ...]  # (K,) first web of the unit of each web
    mirrored: tuple[bool, ...]  # (K,) whether a web carries the mirror image

    @property
    def plain(self) -> bool:
        """Whether no web carries a mirror image."""
        return not any(self.mirrored)

    @property
    def first(self) -> np.ndarray:
        """First web of each unit (U,)."""
        return np.unique(np.array(self.leader, dtype=int))

    @property
    def owner(self) -> np.ndarray:
        """Unit of each web (K,)."""
        return np.searchsorted(self.first, np.array(self.leader, dtype=int))

    @property
    def count(self) -> np.ndarray:
        """Webs of each unit (U,)."""
        return np.bincount(self.owner)

    def summed(self, of_webs: Any) -> Any:
        """Sums (..., U) over the webs of every unit."""
        return of_webs @ (self.owner[:, None] == np.arange(self.first.size)).astype(float)

    def carried(self, of_units: Complex) -> Complex:
        """Unbalances of all webs (..., K) where the first of every unit carries these (..., U)."""
        unbalances = of_units[..., self.owner]
        return self.turn * np.where(self.mirrored, np.conj(unbalances), unbalances)

    def means(self, u: Complex) -> Complex:
        """What the first webs of all units carry (..., U) in the nearest unbalances that are alike."""
        back = u * np.conj(self.turn)
        return np.asarray(self.summed(np.where(self.mirrored, np.conj(back), back)) / self.count)

    def angles(self, web: int, angle: float) -> Real:
        """Directions (K,) [rad] of what all webs carry where one of them carries something in a direction."""
        turn = np.angle(self.turn)
        first = (angle - turn[web]) * (-1.0 if self.mirrored[web] else 1.0)
        return np.where(self.mirrored, -first, first) + turn

    def nearest(self, u: Complex) -> Complex:
        """The nearest unbalances that are alike, or of what pulls at the webs the part that moves them (..., K)."""
        return self.carried(self.means(u))

    def fitted(self, mass_kg: Real, angle_deg: Real) -> tuple[Real, Real]:
        """Masses and angles (..., K), to the last digit those of the first of every unit, degrees below 360."""
        leader = np.array(self.leader, dtype=int)
        mass, angle = mass_kg[..., leader], angle_deg[..., leader]
        # twice, because a hair below 0 comes to 360
        image = np.mod(np.mod(np.where(self.mirrored, -angle, angle) + self.ahead_deg, 360.0), 360.0)
        own = (leader == np.arange(leader.size)) | (mass == 0.0)
        return mass, np.where(own, np.where(mass > 0, angle, 0.0), image)

    def only(self, webs: np.ndarray) -> "Alike":
        """Of some of the webs (K,) bool, of a unit all or none."""
        place = np.cumsum(webs) - 1
        numbers = np.flatnonzero(webs).tolist()
        return Alike(
            self.turn[..., webs],
            self.ahead_deg[..., webs],
            tuple(int(place[self.leader[k]]) for k in numbers),
            tuple(self.mirrored[k] for k in numbers),
        )

    def pieces(self, web: np.ndarray) -> "Alike":
        """Of pieces of the webs: the n-th pieces of alike webs are alike.

        Parameters
        ----------
        web : (P,) of each piece, in rising order; alike webs have as many.
        """
        start = np.searchsorted(web, np.arange(len(self.leader)))
        leader = start[np.array(self.leader, dtype=int)[web]] + np.arange(web.size) - start[web]
        mirrored = np.array(self.mirrored)[web].tolist()
        return Alike(self.turn[..., web], self.ahead_deg[..., web], tuple(leader.tolist()), tuple(mirrored))
