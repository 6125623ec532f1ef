"""Whether a shaft can be one, before anything is asked of the service: density, mass and cranks. No CAD."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Iterator, List, Mapping, Sequence, Tuple

#: kg/m3 of what shafts are made of
_DENSITIES = (1_000.0, 20_000.0)
#: rod over crank radius of machines
_RODS = (2.0, 20.0)
#: stroke over bore of machines
_STROKES = (0.05, 10.0)
#: mass that moves with a row over that of the shaft, at most
_MOVING = 20.0
#: share by which a crank that is described differs from that of the faces
_SAME = 0.01


@dataclass(frozen=True)
class Piece:
    """A body of the shaft."""

    name: str
    volume_m3: float
    density_kg_m3: float

    @property
    def mass_kg(self) -> float:
        return self.volume_m3 * self.density_kg_m3


@dataclass(frozen=True)
class Sizes:
    """The shaft as its solids are."""

    pieces: Tuple[Piece, ...]
    length_m: float

    @property
    def mass_kg(self) -> float:
        return sum(piece.mass_kg for piece in self.pieces)


def summary(sizes: Sizes, throws: Sequence[Mapping[str, Any]]) -> str:
    """What the shaft weighs and measures in words, to be confirmed."""
    bodies = "1 body" if len(sizes.pieces) == 1 else f"{len(sizes.pieces)} bodies"
    densities = sorted({f"{piece.density_kg_m3:,.5g}" for piece in sizes.pieces})
    radii = sorted({f"{1e3 * throw['crank_radius_m']:,.5g}" for throw in throws})
    return (
        f"The shaft weighs {sizes.mass_kg:,.5g} kg ({bodies} of {' and '.join(densities)} kg/m3) and is"
        f" {1e3 * sizes.length_m:,.5g} mm long; crank radius {' and '.join(radii)} mm."
    )


def reasons(sizes: Sizes, machine: Mapping[str, Any]) -> List[str]:
    """Why the shaft of a machine cannot be one; nothing if it can."""
    return [*_of_densities(sizes), *_of_rows(sizes, machine.get("throws", ()))]


def unlike(faces: Sequence[Mapping[str, Any]], description: Sequence[Mapping[str, Any]]) -> List[str]:
    """Cranks that are described otherwise than the faces show them, throw by throw."""
    return [
        f"throw {throw['name']}: the faces show a crank radius of {1e3 * throw['crank_radius_m']:.5g} mm,"
        f" {1e3 * more['crank_radius_m']:.5g} mm are described"
        for throw, more in zip(faces, description)
        if isinstance(more.get("crank_radius_m"), (int, float))
        and abs(more["crank_radius_m"] - throw["crank_radius_m"]) > _SAME * throw["crank_radius_m"]
    ]


def _of_densities(sizes: Sizes) -> Iterator[str]:
    least, most = _DENSITIES
    for piece in sizes.pieces:
        if not least <= piece.density_kg_m3 <= most:
            yield f"{piece.name}: a density of {piece.density_kg_m3:g} kg/m3; shafts have {least:g} to {most:g}"


def _of_rows(sizes: Sizes, throws: Sequence[Mapping[str, Any]]) -> Iterator[str]:
    units = "is the shaft in other units?"
    for throw in throws:
        radius, name = throw["crank_radius_m"], f"throw {throw.get('name', '')}"
        for row in throw.get("rows", ()):
            length = (row.get("connecting_rod") or {}).get("length_m")
            if length and not _RODS[0] <= length / radius <= _RODS[1]:
                ratio, customary = f"{length / radius:.3g} times", f"{_RODS[0]:g} to {_RODS[1]:g} times"
                yield (
                    f"{name}: a rod of {1e3 * length:.5g} mm is {ratio} as long as its crank radius of"
                    f" {1e3 * radius:.5g} mm; machines have {customary}: {units}"
                )
            bore = (row.get("cylinder") or {}).get("bore_m")
            if bore and not _STROKES[0] <= 2 * radius / bore <= _STROKES[1]:
                yield f"{name}: a stroke of {2e3 * radius:.5g} mm in a bore of {1e3 * bore:.5g} mm: {units}"
            moving = row.get("reciprocating_mass_kg") or 0.0
            if moving > _MOVING * sizes.mass_kg:
                yield f"{name}: {moving:.5g} kg move on a shaft of {sizes.mass_kg:.3g} kg: {units}"
