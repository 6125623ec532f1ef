"""Force and moment of the first order, of the moments of a rotor and the rows of a machine: arithmetic of its own.

What the service says remains is held against this; nothing here comes from an answer.
"""

from __future__ import annotations

from cmath import exp
from dataclasses import dataclass
from math import pi, radians
from typing import Any, Iterator, Mapping, Sequence, Tuple

from .moments import Moments


@dataclass(frozen=True)
class Response:
    """What turns with the shaft and what turns against it, N or N m; their sum is the peak."""

    co_rotating: float
    counter_rotating: float

    @property
    def peak(self) -> float:
        return self.co_rotating + self.counter_rotating


#: position, crank as x + iy, axis of the row, mass that reciprocates, mass that turns with the pin
Row = Tuple[float, complex, float, float, float]


def rows(throws: Sequence[Mapping[str, Any]]) -> Iterator[Row]:
    """Every row of every throw, as a request has them."""
    for throw in throws:
        crank = _crank(throw)
        for row in throw.get("rows", ()):
            rod = row.get("connecting_rod") or {}
            mass, share = rod.get("mass_kg", 0.0), rod.get("reciprocating_share", 1 / 3)
            if rod.get("centre_of_mass_m") is not None:
                share = rod["centre_of_mass_m"] / rod["length_m"]
            parts = row.get("parts", ())
            yield (
                throw["position_m"] + row.get("offset_m", 0.0),
                crank,
                radians(row["axis_deg"]),
                row.get("reciprocating_mass_kg", 0.0) + share * mass + _parts(parts, "reciprocating"),
                (1 - share) * mass + _parts(parts, "rotating"),
            )


def _parts(parts: Sequence[Mapping[str, Any]], motion: str) -> float:
    return float(sum(part["mass_kg"] for part in parts if part["motion"] == motion))


def _crank(throw: Mapping[str, Any]) -> complex:
    return complex(throw["crank_radius_m"] * exp(1j * radians(throw["crank_angle_deg"])))


def first_order(
    rotor: Moments, throws: Sequence[Mapping[str, Any]], speed_rpm: float, plane_m: float
) -> Tuple[Response, Response]:
    """Force [N], and moment about a plane [N m]."""
    turning = [rotor.static_kg_m, rotor.axial_kg_m2 - plane_m * rotor.static_kg_m]
    against = [0j, 0j]
    for position, crank, axis, reciprocating, with_pin in rows(throws):
        # half of what reciprocates turns with the shaft, half of it against
        plus = (with_pin + reciprocating / 2) * crank
        minus = reciprocating / 2 * crank.conjugate() * exp(2j * axis)
        for k, arm in enumerate((1.0, position - plane_m)):
            turning[k] += arm * plus
            against[k] += arm * minus
    for throw in throws:
        more = throw.get("rotating_mass_kg", 0.0) * _crank(throw)
        turning[0] += more
        turning[1] += (throw["position_m"] - plane_m) * more
    square = (speed_rpm * pi / 30) ** 2
    force, moment = (Response(square * abs(plus), square * abs(minus)) for plus, minus in zip(turning, against))
    return force, moment


def gross(throws: Sequence[Mapping[str, Any]], speed_rpm: float, rotors: Sequence[Moments]) -> float:
    """All forces together, as if none cancelled another [N]."""
    moving = sum((reciprocating + with_pin) * abs(crank) for _, crank, _, reciprocating, with_pin in rows(throws))
    return (speed_rpm * pi / 30) ** 2 * (moving + sum(abs(rotor.static_kg_m) for rotor in rotors))
