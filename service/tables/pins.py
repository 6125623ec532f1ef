"""Loads of the anti-rotation pins of a scroll over a revolution, pin by pin."""

from schemas.scroll.pin_loads import PinLoads
from service.tables.lines import Lines, as_csv


def lines(loads: PinLoads, every: int = 1) -> Lines:
    """A line for each shaft angle, or for every so many of them; a column for each pin."""
    heads = ["shaft angle, deg", *(f"Q {pin.index}, N" for pin in loads.pins)]
    if loads.drive_bearing is not None:
        heads.append("drive bearing, N")
    columns = [loads.angle_deg, *(pin.load_N for pin in loads.pins)]
    if loads.drive_bearing is not None:
        columns.append(loads.drive_bearing.load_N)
    columns.append(loads.rotation_torque_Nm)
    return [[*heads, "rotation torque, N m"], *map(list, zip(*(column[::every] for column in columns), strict=True))]


def pins_csv(loads: PinLoads) -> bytes:
    """The same as CSV."""
    return as_csv(lines(loads))


def dead_points(phase_deg: float) -> tuple[float, float]:
    """Shaft angles at which the crank of a pin lies along its own radius, so that it turns nothing."""
    return phase_deg % 360.0, (phase_deg + 180.0) % 360.0
