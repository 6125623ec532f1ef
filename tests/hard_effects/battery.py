"""All hard cases of the effects."""

from tests.hard_effects import cases_bearings, cases_inertia, cases_motion, cases_pins, cases_turn
from tests.hard_effects.case import Case

CASES: tuple[Case, ...] = (
    *cases_inertia.CASES,
    *cases_motion.CASES,
    *cases_turn.CASES,
    *cases_bearings.CASES,
    *cases_pins.CASES,
)
