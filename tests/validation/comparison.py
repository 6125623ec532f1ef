"""One comparison: what somebody else says, what we compute, and how far they may be apart."""

from dataclasses import dataclass
from typing import Literal


@dataclass(frozen=True)
class Comparison:
    """A figure of ours beside one that is published, follows by analysis, or was computed independently."""

    machine: str
    quantity: str
    kind: Literal["published", "analytic", "independent"]
    expected: float
    ours: float
    #: largest difference that the printing, or the method, of the other one explains
    allowed: float
    unit: str

    @property
    def difference(self) -> float:
        return self.ours - self.expected

    @property
    def agrees(self) -> bool:
        # nan agrees with nothing
        return abs(self.difference) <= self.allowed

    @property
    def cells(self) -> tuple[str, ...]:
        figures = (f"{self.expected:.6g}", f"{self.ours:.6g}", f"{abs(self.difference):.1e}", f"{self.allowed:.1e}")
        return self.machine, self.quantity, self.kind, *figures, self.unit


@dataclass(frozen=True)
class Misprint:
    """A printed figure that is wrong: what stands there, what is right and why, and what we compute."""

    source: str
    place: str
    printed: float
    right: Comparison
    reason: str
