"""Counterweights to be drawn."""

from collections.abc import Iterator

from pydantic import Field

from schemas.base.rules import Rule
from schemas.machine.fitted import GivenCounterweight, fitted_rules
from schemas.machine.rotor import MAX_WEBS
from schemas.request.requests import OptimizeRequest


class DrawingsRequest(OptimizeRequest):
    """Draw the counterweights of a machine: those that are given, or else the optimum."""

    counterweights: tuple[GivenCounterweight, ...] | None = Field(
        None,
        max_length=MAX_WEBS,
        description="counterweights to draw, as an answer holds them; null are those that are found to be best",
        examples=[[{"web": "1a", "mass_kg": 24.5, "angle_deg": 180}]],
    )

    def rules(self) -> Iterator[Rule]:
        yield from super().rules()
        yield from fitted_rules(self.machine, self.counterweights or ())
        plain = all(web.envelope is None for web in self.machine.every_web)
        yield Rule(plain, ("machine", "webs"), "a drawing needs the envelope of a web; none has one")
