"""What the mass of a rotor does when it turns. No CAD; SI units, directions as complex numbers x + iy."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Dict, List


@dataclass(frozen=True)
class Moments:
    """Mass, its static moment S = sum m r and its axial moment T = sum m r z, about the origin on the shaft."""

    mass_kg: float = 0.0
    static_kg_m: complex = 0j
    axial_kg_m2: complex = 0j

    def __add__(self, other: Moments) -> Moments:
        return Moments(
            self.mass_kg + other.mass_kg,
            self.static_kg_m + other.static_kg_m,
            self.axial_kg_m2 + other.axial_kg_m2,
        )

    def as_unbalances(self, name: str, low_m: float, high_m: float) -> List[Dict[str, Any]]:
        """Two unbalances of a machine, in the planes of both ends, with the same force and the same moment."""
        at_low = (self.static_kg_m * high_m - self.axial_kg_m2) / (high_m - low_m)
        ends = ((f"{name} -", low_m, at_low), (f"{name} +", high_m, self.static_kg_m - at_low))
        return [
            {"name": end, "position_m": position, "x_kg_m": value.real, "y_kg_m": value.imag}
            for end, position, value in ends
        ]
