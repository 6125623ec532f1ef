"""Machines of the kind that an effect is of; the problems of the effect name any other before."""

from typing import NamedTuple

from schemas.machine.machine import Machine
from schemas.machine.reciprocating import ReciprocatingMachine
from schemas.machine.scroll_machine import CrankPins, ScrollMachine


class PinnedScroll(NamedTuple):
    """A scroll machine that crank pins hold."""

    machine: ScrollMachine
    pins: CrankPins


def reciprocating(machine: Machine) -> ReciprocatingMachine:
    """The machine, which has cranks and rows.

    Raises
    ------
    TypeError
        of any other: that is a fault of the caller, who has not looked at the problems.
    """
    if isinstance(machine, ReciprocatingMachine):
        return machine
    raise TypeError(f"a {machine.kind} machine has no rows")


def pinned_scroll(machine: Machine) -> PinnedScroll:
    """The machine, which has crank pins.

    Raises
    ------
    TypeError
        of any other, likewise.
    """
    if isinstance(machine, ScrollMachine) and isinstance(machine.anti_rotation, CrankPins):
        return PinnedScroll(machine, machine.anti_rotation)
    raise TypeError(f"this {machine.kind} machine has no crank pins")
