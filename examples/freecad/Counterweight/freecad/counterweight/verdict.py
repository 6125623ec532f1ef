"""Solids against the answer: what remains by volume integrals beside what the service says. No CAD."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Dict, Iterator, List, Mapping, Tuple

from .first_order import first_order, gross
from .moments import Moments

#: relative difference above which the solids are not those of the answer
TOLERANCE = 1e-9
#: of all forces together, as if none cancelled another
_SMALL = 1e-6


@dataclass(frozen=True)
class Line:
    """One figure: of the solids, of the service, and without counterweights, by which their difference is measured.

    small : below this a figure is what rounding leaves of larger ones, and no measure.
    """

    what: str
    unit: str
    before: float
    told: float
    found: float
    small: float

    @property
    def off(self) -> float:
        return abs(self.found - self.told) / (max(self.before, self.told, self.small) or 1.0)

    def __str__(self) -> str:
        return (
            f"{self.what}: solids {self.found:,.6g} {self.unit}, service {self.told:,.6g} {self.unit}, "
            f"without {self.before:,.6g} {self.unit}, difference {self.off:.1e} of it"
        )


@dataclass(frozen=True)
class Verdict:
    """What the comparison came to."""

    lines: Tuple[Line, ...]

    @property
    def worst(self) -> float:
        return max(line.off for line in self.lines)

    @property
    def held(self) -> bool:
        return self.worst <= TOLERANCE

    def words(self) -> List[str]:
        if self.held:
            last = f"The solids leave what the service says, to {self.worst:.1e}."
        else:
            last = (
                f"REFUSED: the solids are not those of the answer, by {self.worst:.1e} (at most {TOLERANCE:g}). "
                "Shaft, tables or counterweights have changed: balance again."
            )
        return [*map(str, self.lines), last]


def verdict(
    machine: Mapping[str, Any], answer: Mapping[str, Any], shaft: Moments, weights: Mapping[str, Moments]
) -> Verdict:
    """Hold solids against an answer.

    Parameters
    ----------
    machine : of the request; nothing but rows, throws and speed is read of it.
    shaft : moments of all bodies of the shaft.
    weights : moments of the counterweight on each web.
    """
    total = sum(weights.values(), shaft)
    plane = answer["reference_plane_m"]
    force, moment = first_order(total, machine["throws"], machine["speed_rpm"], plane)
    small = _SMALL * gross(machine["throws"], machine["speed_rpm"], [shaft, *weights.values()])
    arm = max((abs(place - plane) for place in _places(machine)), default=0.0)
    before, after = answer["residual"]["before"], answer["residual"]["after"]
    lines = []
    for name, found, unit, least in (("force", force, "N", small), ("moment", moment, "Nm", small * arm)):
        scale = before[name][f"peak_{unit}"]
        for part, value in (
            ("peak", found.peak),
            ("co_rotating", found.co_rotating),
            ("counter_rotating", found.counter_rotating),
        ):
            words = f"{part.replace('_', '-')} {name}"
            told = after[name][f"{part}_{unit}"]
            lines.append(Line(words, unit.replace("Nm", "N m"), scale, told, value, least))
    masses: Dict[str, float] = {one["web"]: one["mass_kg"] for one in answer["counterweights"]}
    most = max(masses.values(), default=0.0)
    for web in sorted({*masses, *weights}):
        mass = weights.get(web, Moments()).mass_kg
        lines.append(Line(f"mass on {web}", "kg", most, masses.get(web, 0.0), mass, 0.0))
    return Verdict(tuple(lines))


def _places(machine: Mapping[str, Any]) -> Iterator[float]:
    for each in ("throws", "webs", "unbalances"):
        yield from (one["position_m"] for one in machine.get(each, ()))
