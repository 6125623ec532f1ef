"""Solids against the answer: what remains by volume integrals beside what the service says. No CAD."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Dict, Iterator, List, Mapping, Tuple

from .first_order import first_order, gross
from .moments import Moments

#: relative difference above which the solids are not those of the answer
TOLERANCE = 1e-9
#: relative difference that is rounding
_EQUAL = 1e-12
#: of all forces together, as if none cancelled another
_SMALL = 1e-6
#: of that, what rounding leaves
_ROUNDING = 1e-3


@dataclass(frozen=True)
class Line:
    """One figure: of the solids, of the service, and without counterweights, by which their difference is measured.

    small : below this a figure is what rounding leaves of larger ones, and no measure.
    headline : whether it is told in the line of the verdict.
    """

    what: str
    unit: str
    before: float
    service: float
    solids: float
    small: float
    headline: bool = False

    @property
    def off(self) -> float:
        return abs(self.solids - self.service) / (max(self.before, self.service, self.small) or 1.0)

    def __str__(self) -> str:
        solids, service, before = map(self._figure, (self.solids, self.service, self.before))
        difference = "equal" if self.off <= _EQUAL else f"difference {self.off:.1e} of it"
        return (
            f"{self.what}: solids {solids} {self.unit}, service {service} {self.unit}, "
            f"without {before} {self.unit}, {difference}"
        )

    @property
    def outcome(self) -> str:
        """What remains of what there was."""
        return f"{self.what} {self._figure(self.solids)} of {self._figure(self.before)} {self.unit}"

    def _figure(self, value: float) -> str:
        """Digits; what rounding leaves of larger figures is nothing."""
        nothing = abs(value) <= max(TOLERANCE * max(self.before, self.service), _ROUNDING * self.small)
        return "0" if nothing else f"{value:,.6g}"


@dataclass(frozen=True)
class Verdict:
    """What the comparison came to."""

    lines: Tuple[Line, ...]
    notes: Tuple[str, ...] = ()

    @property
    def worst(self) -> float:
        return max(line.off for line in self.lines)

    @property
    def held(self) -> bool:
        return self.worst <= TOLERANCE

    @property
    def headline(self) -> str:
        """The verdict in a line."""
        if not self.held:
            return (
                f"REFUSED: the solids are not those of the answer, by {self.worst:.1e} (at most {TOLERANCE:g}). "
                "Shaft, tables or counterweights have changed: balance again."
            )
        outcome = ", ".join(line.outcome for line in self.lines if line.headline)
        return f"HELD: the solids leave what the service says: {outcome}."

    def words(self) -> List[str]:
        """The verdict, what is noted beside it, and all figures."""
        return [self.headline, *self.notes, *map(str, self.lines)]


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
    for name, ellipse, unit, least in (("force", force, "N", small), ("moment", moment, "Nm", small * arm)):
        scale = before[name][f"peak_{unit}"]
        for part, value in (
            ("peak", ellipse.peak),
            ("co_rotating", ellipse.co_rotating),
            ("counter_rotating", ellipse.counter_rotating),
        ):
            words = f"{part.replace('_', '-')} {name}"
            figure = after[name][f"{part}_{unit}"]
            lines.append(Line(words, unit.replace("Nm", "N m"), scale, figure, value, least, part == "peak"))
    masses: Dict[str, float] = {
        counterweight["web"]: counterweight["mass_kg"] for counterweight in answer["counterweights"]
    }
    most = max(masses.values(), default=0.0)
    for web in sorted({*masses, *weights}):
        mass = weights.get(web, Moments()).mass_kg
        lines.append(Line(f"mass on {web}", "kg", most, masses.get(web, 0.0), mass, 0.0))
    return Verdict(tuple(lines))


def _places(machine: Mapping[str, Any]) -> Iterator[float]:
    for kind in ("throws", "webs", "unbalances"):
        yield from (entry["position_m"] for entry in machine.get(kind, ()))
