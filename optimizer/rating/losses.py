"""Pressure losses in valves and ducts, and what they make of the pressures in the cylinder."""

import math
from dataclasses import dataclass

#: mean piston speed [m/s] for which losses are quoted, (1-24)
REFERENCE_SPEED = 3.5


@dataclass(frozen=True)
class Readings:
    """A relative loss read off a chart at two pressures [Pa]; between and beyond them a power law."""

    low: float
    high: float
    at_low: float
    at_high: float

    def at(self, pressure: float) -> float:
        """Relative loss at a pressure [Pa]; below 1 however small the pressure."""
        power = math.log(self.at_high / self.at_low) / math.log(self.high / self.low)
        return min(self.at_low * (pressure / self.low) ** power, 0.99)

    def cover(self, pressure: float) -> bool:
        """Whether a pressure [Pa] lies between the readings."""
        return self.low <= pressure <= self.high


#: under (1-24) of the calculation of the 2D12: the losses of its two stages, read off a chart for 3.5 m/s and air
SUCTION = Readings(low=0.3e6, high=0.79e6, at_low=0.036, at_high=0.028)
DISCHARGE = Readings(low=0.79e6, high=2.1e6, at_low=0.061, at_high=0.045)


def mean_piston_speed(stroke: float, speed_rpm: float) -> float:
    """C_m = S n / 30 [m/s]; the 2D12's calculation takes 4.0 from a table where its own stroke and speed make 4.667."""
    return stroke * speed_rpm / 30.0


def corrected_loss(loss: float, piston_speed: float, relative_density: float) -> float:
    """delta' = delta (C_m / 3.5)^2 (rho / rho_air), (1-24)."""
    return loss * (piston_speed / REFERENCE_SPEED) ** 2 * relative_density


def pressures_in_cylinder(p1: float, p2: float, suction_loss: float, discharge_loss: float) -> tuple[float, float]:
    """p_s = p1' (1 - delta_s) and p_d = p2' (1 + delta_d) [Pa], (1-25)."""
    return p1 * (1.0 - suction_loss), p2 * (1.0 + discharge_loss)
