"""What an effect is of: a machine of another kind is refused by its name."""

import pytest
from pydantic import TypeAdapter

from optimizer.effects.machine_kinds import pinned_scroll, reciprocating
from schemas.machine.machine import Machine
from tests.effects.machines import SCROLL, complete

PINS = {"type": "crank_pins", "count": 3, "pin_circle_radius_m": 0.06, "eccentric_mass_kg": 0.05, "position_m": 0.03}


def machine(body: object) -> Machine:
    read: Machine = TypeAdapter(Machine).validate_python(body)
    return read


def test_a_machine_of_the_kind_is_itself() -> None:
    rows, scroll = machine(complete()), machine({**SCROLL, "anti_rotation": PINS})
    assert reciprocating(rows) is rows
    assert pinned_scroll(scroll) == (scroll, scroll.anti_rotation)


def test_another_kind_is_named() -> None:
    with pytest.raises(TypeError, match="a scroll machine has no rows"):
        reciprocating(machine(SCROLL))
    for fields in (complete(), SCROLL):
        with pytest.raises(TypeError, match="machine has no crank pins"):
            pinned_scroll(machine(fields))
