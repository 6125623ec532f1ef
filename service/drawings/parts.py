"""What a workshop makes: counterweights of one outline are one part, however many there are."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from math import isclose, radians

from schemas.answer.counterweights import Counterweight
from schemas.machine.machine import Machine
from schemas.machine.webs import Envelope
from service.drawings.outline import Outline, outline

#: share of their half-angle by which the outlines of one part differ at most; a thousandth of a mm on a metre
_ALIKE = 1e-6


@dataclass(frozen=True)
class Part:
    """A part number.

    half_angle : half the opening at the outer radius, rad.
    places : the counterweights that are made so.
    """

    number: int
    envelope: Envelope
    half_angle: float
    places: tuple[Counterweight, ...]

    @property
    def name(self) -> str:
        """Of its files."""
        return f"counterweight-{self.number}"

    @property
    def outline(self) -> Outline:
        """Upwards, about the shaft."""
        return outline(self.envelope, self.half_angle)


def parts(machine: Machine, fitted: Iterable[Counterweight]) -> tuple[Part, ...]:
    """The counterweights that are cut from plates, part by part, in the order of their webs."""
    plates: list[Part] = []
    for envelope, half_angle, counterweight in _cut(machine, fitted):
        for k, part in enumerate(plates):
            if part.envelope == envelope and isclose(part.half_angle, half_angle, rel_tol=_ALIKE):
                plates[k] = Part(part.number, envelope, part.half_angle, (*part.places, counterweight))
                break
        else:
            plates.append(Part(len(plates) + 1, envelope, half_angle, (counterweight,)))
    return tuple(plates)


def _cut(machine: Machine, fitted: Iterable[Counterweight]) -> Iterator[tuple[Envelope, float, Counterweight]]:
    envelopes = {web.name: web.envelope for web in machine.every_web}
    for counterweight in fitted:
        envelope = envelopes.get(counterweight.web)
        if envelope is not None and counterweight.shape is not None:
            yield envelope, radians(counterweight.shape.half_angle_deg), counterweight
