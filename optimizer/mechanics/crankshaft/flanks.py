"""Plane faces across a shaft: flanks of webs, ends of bodies. Their normals say on which side the material is."""

import numpy as np
from numpy.typing import NDArray

from optimizer.mechanics.crankshaft.faces import Numbers, Planes
from optimizer.numerics.arrays import Real
from optimizer.numerics.records import record

#: cosine with the shaft above which a face is across it; above the second it is a flank that leans
_ACROSS, _LEANING = 1 - 1e-8, float(np.cos(np.deg2rad(20.0)))
#: share of a section, above which a plane face closes it
_CLOSED = 0.25


@record(frozen=True)
class Flanks:
    """Plane faces across the shaft (n,): number, height, sense of the normal, area, and where they are across it.

    leaning : heights (k,) of plane faces that are nearly across, and number in the request and angle of each.
    """

    number: Numbers
    z: Real
    sense: Numbers
    area: Real
    across: Real
    leaning: tuple[Real, Numbers, Real]
    tolerance: float

    @classmethod
    def of(cls, planes: Planes, tolerance: float) -> "Flanks":
        """The flanks among planes that are seen in the frame of the shaft."""
        cosine = planes.normal[:, 2]
        is_flank = np.abs(cosine) >= _ACROSS
        leans = ~is_flank & (np.abs(cosine) >= _LEANING)
        angle = np.rad2deg(np.arccos(np.minimum(1.0, np.abs(cosine[leans]))))
        return cls(
            planes.number[is_flank],
            planes.point[is_flank, 2],
            np.sign(cosine[is_flank]).astype(np.intp),
            planes.area[is_flank],
            planes.point[is_flank, 0] + 1j * planes.point[is_flank, 1],
            (planes.point[leans, 2], planes.number[leans], angle),
            tolerance,
        )

    def between(self, low: float, high: float) -> tuple[float, float] | None:
        """Outermost flanks with material between them, within two heights; None without any."""
        inside = (self.z >= low - self.tolerance) & (self.z <= high + self.tolerance)
        down, up = self.z[inside & (self.sense < 0)], self.z[inside & (self.sense > 0)]
        if not len(down) or not len(up) or not np.max(up) - np.min(down) > self.tolerance:
            return None
        return float(np.min(down)), float(np.max(up))

    def largest(self, low: float, high: float) -> tuple[float, float] | None:
        """The largest two flanks with material between them, within two heights; None without, or without areas."""
        inside = (self.z > low) & (self.z < high)
        if np.any(np.isnan(self.area[inside])):
            return None
        down, of_down = self._levels(inside & (self.sense < 0))
        up, of_up = self._levels(inside & (self.sense > 0))
        pair_area = np.where(up - down[:, None] > self.tolerance, of_down[:, None] + of_up, -1.0)
        if not pair_area.size or np.max(pair_area) < 0:
            return None
        first, last = np.unravel_index(int(np.argmax(pair_area)), pair_area.shape)
        return float(down[first]), float(up[last])

    def cap(self, centre: complex, radius: float, height: float, sense: int) -> bool:
        """Whether a plane face closes a round section at a height."""
        there = (self.sense == sense) & (np.abs(self.z - height) <= 10 * self.tolerance)
        there &= np.abs(self.across - centre) <= radius / 2
        area = np.where(np.isnan(self.area), np.inf, self.area)
        return bool(np.any(there & (area >= _CLOSED * np.pi * radius**2)))

    def faces(self, low: float, high: float) -> tuple[int, ...]:
        """Numbers in the request of the flanks at two heights, with the material between them."""
        height, sense = np.array([[low], [high]]), np.array([[-1], [1]])
        at = (np.abs(self.z - height) <= self.tolerance) & (self.sense == sense)
        return tuple(self.number[np.any(at, axis=0)].tolist())

    def lean(self, low: float, high: float) -> tuple[int, float] | None:
        """Number and angle of the flank that leans most, within two heights."""
        z, number, angle = self.leaning
        inside = np.flatnonzero((z > low) & (z < high))
        if not len(inside):
            return None
        worst = inside[np.argmax(angle[inside])]
        return int(number[worst]), float(angle[worst])

    def _levels(self, mask: NDArray[np.bool_]) -> tuple[Real, Real]:
        """Heights of faces, those at one height once, and the area at each."""
        z, area = self.z[mask], self.area[mask]
        order = np.argsort(z, kind="stable")
        z, area = z[order], area[order]
        starts = np.flatnonzero(np.diff(z, prepend=-np.inf) > self.tolerance)
        return z[starts], np.add.reduceat(area, starts) if len(starts) else area
