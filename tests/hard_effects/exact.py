"""Slider-crank, gas, friction and torque of a posted machine at 50 digits; shares no code with the mechanics.

A machine is the dictionary that a client posts; every number in it is taken as exactly the double that it is. Shaft
angles are in radians. Formulas are in lengths (r and l themselves, no rod ratio) and in the shortest form, with no
regard for cancellation: the digits carry it.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from mpmath import MPContext

mp = MPContext()
mp.dps = 50
Number = Any  # mpmath.mpf of the context above


def cis(angle_deg: float) -> Number:
    """Unit vector for an angle in degrees."""
    return mp.expjpi(mp.mpf(angle_deg) / 180)


@dataclass(frozen=True)
class Chamber:
    """One side of a piston; ``sign`` of its force in rod tension, -1 on the head side. Open sides have no cycle."""

    sign: int
    area: Number
    low: Number
    high: Number
    clear: Number  # m
    expands: Number
    compresses: Number
    closed: bool
    stroke: Number

    @property
    def suction_opens(self) -> Number:
        """Own travel, m."""
        return self.clear * ((self.high / self.low) ** (1 / self.expands) - 1)

    @property
    def discharge_opens(self) -> Number:
        """Own travel, m."""
        return (self.stroke + self.clear) * (self.low / self.high) ** (1 / self.compresses) - self.clear

    def pressure(self, travel: Number, grows: bool) -> Number:
        """At an own travel, by the stage of the cycle."""
        if not self.closed:
            return self.low
        if grows:
            if travel >= self.suction_opens:
                return self.low
            return self.high * (self.clear / (travel + self.clear)) ** self.expands
        if travel <= self.discharge_opens:
            return self.high
        return self.low * ((self.stroke + self.clear) / (travel + self.clear)) ** self.compresses

    def grown(self, travel: Number) -> Number:
        """Integral of p dx from 0 while the chamber grows, N/m times m per area."""
        if not self.closed:
            return self.low * travel
        end = min(travel, self.suction_opens)
        return _polytropic(self.high, self.clear, end + self.clear, self.expands) + self.low * (travel - end)

    def shrunk(self, travel: Number) -> Number:
        """Integral of p dx from ``travel`` to the stroke while the chamber shrinks."""
        if not self.closed:
            return self.low * (self.stroke - travel)
        full, end = self.stroke + self.clear, max(travel, self.discharge_opens)
        return -_polytropic(self.low, full, end + self.clear, self.compresses) + self.high * (end - travel)

    @property
    def work(self) -> Number:
        """Put into the gas in a turn, J."""
        return self.area * (self.shrunk(mp.mpf(0)) - self.grown(self.stroke))


def _polytropic(pressure: Number, start: Number, end: Number, exponent: Number) -> Number:
    """Integral of pressure (start/x)^exponent from start to end."""
    with mp.workdps(90):  # exponents may be as near to 1 as doubles go
        if exponent == 1:
            return pressure * start * mp.log(end / start)
        return pressure * start**exponent * (end ** (1 - exponent) - start ** (1 - exponent)) / (1 - exponent)


@dataclass(frozen=True)
class Row:
    """A row and what drives it."""

    radius: Number
    length: Number  # inf for an infinite rod
    mass: Number  # reciprocating, with the share of the rod
    crank: Number  # unit vector
    axis: Number
    sense: int
    omega: Number
    plane: Number
    chambers: tuple[Chamber, ...]
    friction: Number  # N

    @cached_property
    def ahead(self) -> Number:
        """Own angle at shaft angle 0."""
        return self.sense * mp.arg(self.crank * mp.conj(self.axis))

    def at(self, theta: Number) -> "State":
        return State(self, mp.mpf(theta) + self.ahead)


@dataclass(frozen=True)
class State:
    """A row at an own angle."""

    row: Row
    phi: Number

    @cached_property
    def sine(self) -> Number:
        return mp.sin(self.phi)

    @cached_property
    def cosine(self) -> Number:
        return mp.cos(self.phi)

    @cached_property
    def upright(self) -> Number:
        """Projection of the rod on the axis."""
        return mp.sqrt(self.row.length**2 - (self.row.radius * self.sine) ** 2)

    @property
    def infinite(self) -> bool:
        return bool(mp.isinf(self.row.length))

    @cached_property
    def displacement(self) -> Number:
        r = self.row.radius
        return r * (1 - self.cosine) + (mp.mpf(0) if self.infinite else self.row.length - self.upright)

    @cached_property
    def rate(self) -> Number:
        """dx/dphi."""
        r = self.row.radius
        return r * self.sine + (0 if self.infinite else r**2 * self.sine * self.cosine / self.upright)

    @property
    def velocity(self) -> Number:
        return self.row.omega * self.rate

    @cached_property
    def acceleration(self) -> Number:
        r, s, c = self.row.radius, self.sine, self.cosine
        bent = 0 if self.infinite else r**2 * (c**2 - s**2) / self.upright + r**4 * s**2 * c**2 / self.upright**3
        return self.row.omega**2 * (r * c + bent)

    @property
    def tangent(self) -> Number:
        """tan beta."""
        return mp.mpf(0) if self.infinite else self.row.radius * self.sine / self.upright

    @property
    def outward(self) -> bool:
        """Whether the head chamber grows."""
        return bool(self.sine >= 0)

    def pressure(self, side: int) -> Number:
        chamber = self.row.chambers[side]
        travel = self.displacement if side == 0 else chamber.stroke - self.displacement
        return chamber.pressure(travel, self.outward if side == 0 else not self.outward)

    @cached_property
    def gas(self) -> tuple[Number, Number]:
        """Force of either side, rod tension positive."""
        head, crank = (c.sign * c.area * self.pressure(side) for side, c in enumerate(self.row.chambers))
        return head, crank

    @property
    def inertia(self) -> Number:
        return self.row.mass * self.acceleration

    @property
    def friction(self) -> Number:
        # the piston stands still at the dead centres, as near as doubles can tell
        return mp.mpf(0) if abs(self.sine) < mp.mpf("1e-12") else mp.sign(self.sine) * self.row.friction

    @cached_property
    def piston(self) -> Number:
        return sum(self.gas) + self.inertia + self.friction

    @property
    def torque(self) -> Number:
        """By virtual work."""
        return self.piston * self.rate

    @property
    def radial(self) -> Number:
        return self.piston * (self.cosine - self.sine * self.tangent)

    @property
    def work(self) -> Number:
        """Integral of the torque from the own angle 0 to phi in [0, 2 pi], in closed form."""
        row, x = self.row, self.displacement
        kinetic = row.mass * self.velocity**2 / 2
        head, crank = row.chambers
        stroke = head.stroke
        if self.phi <= mp.pi:
            gas = crank.area * crank.shrunk(stroke - x) - head.area * head.grown(x)
            return gas + kinetic + row.friction * x
        gas = crank.area * (crank.shrunk(mp.mpf(0)) - crank.grown(stroke - x))
        gas -= head.area * (head.grown(stroke) - head.shrunk(x))
        return gas + kinetic + row.friction * (2 * stroke - x)


def rows(body: dict[str, Any]) -> list[Row]:
    """All rows of a posted machine, throw by throw."""
    omega = mp.mpf(body["speed_rpm"]) * mp.pi / 30
    lines = []
    for throw in body["throws"]:
        radius = mp.mpf(throw["crank_radius_m"])
        for row in throw.get("rows", ()):
            rod = row["connecting_rod"]
            length = mp.inf if rod["length_m"] is None else mp.mpf(rod["length_m"])
            share = mp.mpf(rod.get("reciprocating_share", 1 / 3)) * mp.mpf(rod.get("mass_kg", 0.0))
            lines.append(
                Row(
                    radius=radius,
                    length=length,
                    mass=mp.mpf(row["reciprocating_mass_kg"]) + share,
                    crank=cis(throw["crank_angle_deg"]),
                    axis=cis(row["axis_deg"]),
                    sense=-1 if body.get("rotation") == "cw" else 1,
                    omega=omega,
                    plane=mp.mpf(throw["position_m"]) + mp.mpf(row.get("offset_m", 0.0)),
                    chambers=tuple(_chambers(row["cylinder"], 2 * radius)) if row.get("cylinder") else (),
                    friction=mp.mpf(0),
                )
            )
    return _with_friction(body, lines)


def _chambers(cylinder: dict[str, Any], stroke: Number) -> Iterator[Chamber]:
    if "bore_m" in cylinder:
        bore, rod = mp.mpf(cylinder["bore_m"]), mp.mpf(cylinder["piston_rod_diameter_m"])
        areas = {"head": mp.pi * bore**2 / 4, "crank": mp.pi * (bore**2 - rod**2) / 4}
    else:
        areas = {side: mp.mpf(cylinder[f"{side}_area_m2"]) for side in ("head", "crank")}
    for side, sign in (("head", -1), ("crank", 1)):
        data = {**cylinder, **(cylinder.get(side) or {})}
        closed = cylinder.get("acting", "double") in ("double", side)
        low = mp.mpf(data["suction_pressure_Pa"] if closed else cylinder["ambient_pressure_Pa"])
        yield Chamber(
            sign=sign,
            area=areas[side],
            low=low,
            high=mp.mpf(data["discharge_pressure_Pa"]) if closed else low,
            clear=mp.mpf(data["relative_clearance"]) * stroke,
            expands=mp.mpf(data["expansion_exponent"]),
            compresses=mp.mpf(data["compression_exponent"]),
            closed=closed,
            stroke=stroke,
        )


def rotating_friction(body: dict[str, Any]) -> Number:
    """Friction torque of the shaft, N m."""
    data = body.get("friction") or {}
    if data.get("mechanical_efficiency") is None:
        return mp.mpf(data.get("rotating_torque_Nm") or 0.0)
    losses = sum(_losses(body, rows({**body, "friction": None})))
    omega = mp.mpf(body["speed_rpm"]) * mp.pi / 30
    return (1 - mp.mpf(data.get("reciprocating_share", 0.7))) * losses / omega


def _losses(body: dict[str, Any], lines: list[Row]) -> list[Number]:
    """Power lost to friction of every row, W."""
    data = body["friction"]
    indicated_power_W = data.get("indicated_power_W")
    power = (
        [mp.mpf(power) for power in indicated_power_W]
        if indicated_power_W
        else [sum(c.work for c in row.chambers if c.closed) * row.omega / (2 * mp.pi) for row in lines]
    )
    return [power_share * (1 / mp.mpf(data["mechanical_efficiency"]) - 1) for power_share in power]


def _with_friction(body: dict[str, Any], lines: list[Row]) -> list[Row]:
    data = body.get("friction")
    if not data:
        return lines
    if data.get("mechanical_efficiency") is None:
        force = [mp.mpf(friction) for friction in data.get("reciprocating_force_N") or [0.0] * len(lines)]
    else:
        share = mp.mpf(data.get("reciprocating_share", 0.7))
        # two strokes a turn
        losses = zip(_losses(body, lines), lines, strict=True)
        force = [share * lost * 2 * mp.pi / row.omega / (4 * row.radius) for lost, row in losses]
    return [Row(**{**row.__dict__, "friction": friction}) for row, friction in zip(lines, force, strict=True)]
