"""What a hard case is, and the machines that they are made of, as JSON."""

import math
from dataclasses import dataclass
from typing import Any

Body = dict[str, Any]

#: rev/min of 1 rad/s
RPM = 30.0 / math.pi
#: asked of an ordinary case
ORDINARY_GAP = 1e-9


@dataclass(frozen=True)
class Case:
    """One request with the reason why it is hard.

    ordinary : must be certified to ORDINARY_GAP, which its body then asks for.
    peaks_unique : all its optima (of least mass, if asked for) have the same peaks.
    """

    name: str
    why: str
    body: Body
    ordinary: bool = False
    peaks_unique: bool = True

    @property
    def theme(self) -> str:
        return self.name.partition("/")[0]


def case(
    name: str, why: str, machine: Body, *, ordinary: bool = False, peaks_unique: bool = True, **objective: Any
) -> Case:
    """A case of a machine and the fields of its objective."""
    body: Body = {"machine": machine, "objective": objective}
    if ordinary:
        body["accuracy"] = {"relative_gap": ORDINARY_GAP}
    return Case(name, why, body, ordinary, peaks_unique)


def row(axis: float, mass: float, **more: Any) -> Body:
    return {"axis_deg": axis, "reciprocating_mass_kg": mass, **more}


def throw(z: float, angle: float, rows: list[Body], *, radius: float = 0.1, rotating: float = 0.0) -> Body:
    return {
        "position_m": z,
        "crank_radius_m": radius,
        "crank_angle_deg": angle,
        "rotating_mass_kg": rotating,
        "rows": rows,
    }


def web(
    name: str, z: float, max_mass: float | None = 100.0, radius: float = 0.2, sector: tuple[float, float] | None = None
) -> Body:
    """``sector`` is centre and half-angle in degrees."""
    place: Body = {"name": name, "position_m": z, "counterweight_radius_m": radius, "max_mass_kg": max_mass}
    if sector is not None:
        place["sector"] = {"centre_deg": sector[0], "half_angle_deg": sector[1]}
    return place


def machine(throws: list[Body], webs: list[Body], *, omega: float = 60.0, **more: Any) -> Body:
    """``omega`` in rad/s."""
    return {"kind": "reciprocating", "speed_rpm": omega * RPM, "throws": throws, "webs": webs, **more}


def v_twin(scale: float = 1.0, *, radius: float = 0.1, angle: float = 70.0) -> list[Body]:
    """Two unequal V throws: nothing cancels, force and moment pull different ways."""
    return [
        throw(-0.3, 0.0, [row(45.0, 12.0 * scale), row(45.0 + angle, 9.0 * scale)], radius=radius, rotating=5 * scale),
        throw(0.4, 130.0, [row(45.0, 7.0 * scale), row(45.0 + angle, 11.0 * scale)], radius=radius, rotating=3 * scale),
    ]


def four_webs(scale: float = 1.0, radius: float = 0.2) -> list[Body]:
    """Webs on either side of two throws; the limits of two of them bind."""
    return [
        web("a", -0.45, 6.0 * scale, radius),
        web("b", -0.15, 2.0 * scale, radius, (170.0, 40.0)),
        web("c", 0.25, 1.5 * scale, radius, (310.0, 40.0)),
        web("d", 0.55, 6.0 * scale, radius),
    ]


def single_row(mass: float = 10.0, radius: float = 0.1, axis: float = 90.0) -> list[Body]:
    return [throw(0.0, axis, [row(axis, mass)], radius=radius)]


def scroll(
    webs: list[Body], guide: Body, *, orbit: float = 0.005, mass: float = 1.2, omega: float = 300.0, **more: Any
):
    return {
        "kind": "scroll",
        "speed_rpm": omega * RPM,
        "orbit_radius_m": orbit,
        "orbiting_mass_kg": mass,
        "orbiting_position_m": 0.05,
        "anti_rotation": guide,
        "webs": webs,
        **more,
    }
