"""Loads of the anti-rotation pins of a scroll machine."""

from collections.abc import Iterator

from optimizer.effects.effect import Context, Effect
from optimizer.effects.machine_kinds import pinned_scroll
from optimizer.errors import MissingInput
from optimizer.pins.answer import pin_loads
from schemas.base.angles import Angles
from schemas.base.model import FieldProblem
from schemas.base.rules import Rule
from schemas.machine.machine import Machine
from schemas.machine.scroll_machine import CrankPins, ScrollMachine
from schemas.scroll.over_turn import LARGEST_PIN_RADIUS_M, LEAST_PIN_RADIUS_M
from schemas.scroll.pin_loads import MAX_LOADS, PinLoadsAnswer, PinLoadsRequest


def _question(machine: ScrollMachine, guide: CrankPins, angles: Angles) -> PinLoadsRequest:
    force = machine.tangential_gas_force_N
    return PinLoadsRequest(
        pin_count=guide.count,
        pin_circle_radius_m=guide.pin_circle_radius_m,
        rotation_torque_Nm=machine.rotation_torque_Nm,
        tangential_gas_force_N=force,
        orbit_radius_m=None if force is None else machine.orbit_radius_m,
        drive_bearing=machine.drive_bearing,
        angles=angles,
    )


def _problems(machine: Machine) -> Iterator[FieldProblem]:
    if not isinstance(machine, ScrollMachine):
        yield FieldProblem(("kind",), "only a scroll machine has anti-rotation pins")
    elif not isinstance(machine.anti_rotation, CrankPins):
        yield FieldProblem(("anti_rotation", "type"), "only crank pins have pin loads")
    elif machine.rotation_torque_Nm is None and machine.tangential_gas_force_N is None:
        yield FieldProblem(("rotation_torque_Nm",), "pin loads need the torque or the tangential gas force")


def _rules(machine: Machine) -> Iterator[Rule]:
    scroll, _ = pinned_scroll(machine)
    if scroll.tangential_gas_force_N is not None:
        # the one range of a scroll machine that is wider than that of the pins
        lever = scroll.orbit_radius_m
        outside = (lever < LEAST_PIN_RADIUS_M) | (lever > LARGEST_PIN_RADIUS_M)
        message = f"must be between {LEAST_PIN_RADIUS_M:g} and {LARGEST_PIN_RADIUS_M:g} for pin loads"
        yield Rule(outside, ("orbit_radius_m",), message)


def _pin_loads(context: Context) -> PinLoadsAnswer:
    machine, pins = pinned_scroll(context.machine)
    if pins.count * context.angle.size > MAX_LOADS:
        path = ("angles", "step_deg")
        raise MissingInput([FieldProblem(path, f"pins times samples must be at most {MAX_LOADS}")])
    step = 360.0 / context.angle.size
    return pin_loads(_question(machine, pins, Angles(step_deg=step)))


SCROLL = (
    Effect(
        "pin_loads",
        "loads of the anti-rotation pins",
        _pin_loads,
        inputs=("machine.anti_rotation", "machine.rotation_torque_Nm", "machine.tangential_gas_force_N"),
        problems=_problems,
        rules=_rules,
    ),
)
