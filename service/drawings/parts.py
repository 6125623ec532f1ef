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
    found: list[Part] = []
    for envelope, half_angle, one in _cut(machine, fitted):
        for k, part in enumerate(found):
            if part.envelope == envelope and isclose(part.half_angle, half_angle, rel_tol=_ALIKE):
                found[k] = Part(part.number, envelope, part.half_angle, (*part.places, one))
                break
        else:
            found.append(Part(len(found) + 1, envelope, half_angle, (one,)))
    return tuple(found)


def _cut(machine: Machine, fitted: Iterable[Counterweight]) -> Iterator[tuple[Envelope, float, Counterweight]]:
    envelopes = {web.name: web.envelope for web in machine.webs}
    for one in fitted:
        envelope = envelopes.get(one.web)
        if envelope is not None and one.shape is not None:
            yield envelope, radians(one.shape.half_angle_deg), one
