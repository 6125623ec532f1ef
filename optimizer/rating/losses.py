"""Pressure losses in valves and ducts, and what they make of the pressures in the cylinder."""

#: mean piston speed [m/s] for which losses are quoted, (1-24)
REFERENCE_SPEED = 3.5


def mean_piston_speed(stroke: float, speed_rpm: float) -> float:
    """C_m = S n / 30 [m/s]; the 2D12's calculation takes 4.0 from a table where its own stroke and speed make 4.667."""
    return stroke * speed_rpm / 30.0


def corrected_loss(loss: float, piston_speed: float, relative_density: float) -> float:
    """delta' = delta (C_m / 3.5)^2 (rho / rho_air), (1-24)."""
    return loss * (piston_speed / REFERENCE_SPEED) ** 2 * relative_density


def pressures_in_cylinder(p1: float, p2: float, suction_loss: float, discharge_loss: float) -> tuple[float, float]:
    """p_s = p1' (1 - delta_s) and p_d = p2' (1 + delta_d) [Pa], (1-25)."""
    return p1 * (1.0 - suction_loss), p2 * (1.0 + discharge_loss)
