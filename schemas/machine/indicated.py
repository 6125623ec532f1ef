"""Indicated pressure of a cylinder over one or two turns of the shaft, as measured or as computed elsewhere."""

from collections.abc import Iterator
from itertools import pairwise
from typing import Annotated, Any, Literal

from pydantic import ConfigDict, Field

from schemas.base.presence import absent, conditions, present, when
from schemas.base.quantities import Angle, Pressure
from schemas.base.rules import Path, Rule, Ruled, first_of
from schemas.base.units import Unit, between

TURN_DEG = 360.0
MAX_TRACE = 7201
#: degrees between entries; a trace may be steep, but it does not jump
LEAST_STEP_DEG = 1e-6
#: share of a pressure by which the value that ends a cycle may differ from the first, which it repeats
CLOSED = 1e-9
#: degrees by which a dead centre may be rounded where it is written down
DEAD_CENTRE_DEG = 1e-3


class PressureTrace(Ruled):
    """Pressure of one side over a cycle; linear between the entries, and from the last one on to the first."""

    angle_deg: tuple[Annotated[float, between(0.0, 2 * TURN_DEG), Unit("deg")], ...] = Field(
        min_length=3,
        max_length=MAX_TRACE,
        description="angles that the shaft has turned since the dead centre, rising, within one cycle from 0; a last "
        "one at the end of the cycle repeats the first value",
        examples=[[0.0, 20.0, 180.0, 360.0, 540.0, 700.0, 720.0]],
    )
    pressure_Pa: tuple[Pressure, ...] = Field(
        description="absolute pressure at these angles",
        examples=[[9e6, 1.2e7, 3e5, 1e5, 1e5, 5e6, 9e6]],
    )

    def rules(self) -> Iterator[Rule]:
        rising = f"the angles must rise, by {LEAST_STEP_DEG:g} at least"
        yield from first_of(
            Rule(right - left < LEAST_STEP_DEG, ("angle_deg", k), rising)
            for k, (left, right) in enumerate(pairwise(self.angle_deg), start=1)
        )
        unequal = len(self.pressure_Pa) != len(self.angle_deg)
        message = f"must hold one value for each of the {len(self.angle_deg)} angles"
        yield Rule(unequal, ("pressure_Pa",), message)

    def cycle_rules(self, path: Path, turns: int) -> Iterator[Rule]:
        """The trace is one cycle of so many turns, from end to end."""
        angle, value, last = self.angle_deg, self.pressure_Pa, len(self.angle_deg) - 1
        cycle = TURN_DEG * turns
        left_out = angle[0] + cycle - angle[last]
        apart = (left_out < LEAST_STEP_DEG) & (abs(value[-1] - value[0]) > CLOSED * value[0])
        words = f"the trace does not close: the value at {cycle:g} must be that at 0"
        yield from first_of(
            [
                *(
                    Rule(crank_angle > cycle, (*path, "angle_deg", k), f"must lie within the cycle of {turns} turn(s)")
                    for k, crank_angle in enumerate(angle)
                ),
                Rule(
                    left_out >= 0.5 * cycle,
                    (*path, "angle_deg", last),
                    "the trace does not close: it leaves out half of the cycle or more",
                ),
                Rule(apart, (*path, "pressure_Pa", len(value) - 1), words),
            ]
        )


class IndicatedPressure(Ruled):
    """Pressures of the sides of a piston over a cycle, in place of the cycle of four processes."""

    model_config = ConfigDict(json_schema_extra=conditions(when(absent("head"), present("crank"))))

    head: PressureTrace | None = Field(
        None,
        description="pressure on the head side",
        examples=[{"angle_deg": [0, 20, 180, 360], "pressure_Pa": [9e6, 1.2e7, 3e5, 9e6]}],
    )
    crank: PressureTrace | None = Field(
        None, description="pressure on the crank side, over the same angles", examples=[None]
    )
    cycle_turns: Literal[1, 2] = Field(
        1, description="turns of the shaft in a cycle: 2 for a four-stroke engine", examples=[2]
    )
    dead_centre_deg: Annotated[Angle | None, Unit("deg")] = Field(
        None,
        description="shaft angle of the outer dead centre of the row from which the angles count, 0 to 360, or to "
        "720 for two revolutions; null is the first",
        examples=[0.0],
    )

    def rules(self) -> Iterator[Rule]:
        yield Rule(self.head is None and self.crank is None, ("head",), "give the pressure of the head or crank side")
        for side, trace in (("head", self.head), ("crank", self.crank)):
            if trace is not None:
                yield from trace.cycle_rules((side,), self.cycle_turns)
        if self.dead_centre_deg is not None:
            most = TURN_DEG * self.cycle_turns
            outside = (self.dead_centre_deg < 0.0) | (self.dead_centre_deg > most)
            yield Rule(outside, ("dead_centre_deg",), f"must lie within the cycle, from 0 to {most:g} degrees")

    def row_rules(self, sense: float, crank_angle_deg: Any, axis_deg: Any) -> Iterator[Rule]:
        """The angles count from an outer dead centre of the row; paths from here."""
        if self.dead_centre_deg is not None:
            past = (self.dead_centre_deg + sense * (crank_angle_deg - axis_deg)) % TURN_DEG
            off = (past > DEAD_CENTRE_DEG) & (past < TURN_DEG - DEAD_CENTRE_DEG)
            yield Rule(off, ("dead_centre_deg",), "must be the shaft angle of an outer dead centre of the row")
