"""Scroll pin loads as readable tables."""

from collections.abc import Iterator

from rich.console import Group, RenderableType
from rich.text import Text

from schemas.scroll import PinLoadsAnswer
from service.cells import add, number, table


def pin_loads_report(answer: PinLoadsAnswer) -> RenderableType:
    """Peaks of every pin, equilibrium, and what to mind."""
    return Group(*_parts(answer))


def _parts(answer: PinLoadsAnswer) -> Iterator[RenderableType]:
    pins = table("pin loads, N", "pin", "at, deg", "peak", "at shaft angle, deg", "compression from, deg", "to, deg")
    for pin in answer.pins:
        halves = (pin.compression_from_deg, pin.compression_to_deg)
        add(pins, str(pin.index), pin.phase_deg, pin.peak_N, pin.peak_angle_deg, *halves)
    yield pins
    yield Text(
        f"largest pin load {number(answer.peak_N)} N; mechanisms that bear half a turn only: "
        f"{number(answer.half_turn_mechanism_peak_N)} N"
    )
    balance = answer.equilibrium
    yield Text(
        f"equilibrium {'holds' if balance.holds else 'does not hold'} at every instant: moment within "
        f"{number(balance.max_moment_error_Nm)} N m, net force within {number(balance.max_net_force_N)} N"
    )
    if not balance.holds and balance.reason:
        yield Text(balance.reason)
    if answer.dead_points_deg:
        yield Text("dead points at " + ", ".join(number(angle) for angle in answer.dead_points_deg) + " deg")
    for warning in answer.warnings:
        yield Text(f"warning: {warning.message}")
