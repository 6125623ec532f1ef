"""Machines with balance shafts, as JSON, and an independent simulation of all that they shake with."""

import cmath
import math
from typing import Any, NamedTuple

import numpy as np

from tests.optimize.machines import machine, row, throw, web

#: rad/s, and m r omega^2 of 10 kg at 0.1 m
OMEGA = 600.0 * math.pi / 30.0
WHOLE = 10.0 * 0.1 * OMEGA**2


def shaft(name: str, ratio: int, position: float = 0.0, max_mass: float | None = 100.0, **more: Any) -> dict[str, Any]:
    """One web, called by the name of its shaft; x_m, y_m belong to the shaft, what else is given to the web."""
    place = {key: more.pop(key) for key in ("x_m", "y_m") if key in more}
    return {"name": name, "speed_ratio": ratio, "webs": [web(f"{name} web", position, max_mass, **more)], **place}


def single(shafts: list[dict[str, Any]], webs: int = 1, ratio: float = 0.3, **more: Any) -> dict[str, Any]:
    """One cylinder along y, r/l as given, on whose throw ``webs`` counterweights can sit."""
    rows = [row(90.0, 10.0, connecting_rod={"length_m": 0.1 / ratio})]
    places = [web("a", 0.0, None), web("b", 0.0, None)][:webs]
    return machine([throw(0.0, 90.0, rows)], places, balance_shafts=shafts, **more)


def in_line_four(shafts: list[dict[str, Any]], ratio: float = 0.3, **more: Any) -> dict[str, Any]:
    """Cranks at 0, 180, 180, 0 degrees from the cylinders along y, 10 kg each."""
    throws = [
        throw(0.12 * k, angle, [row(90.0, 10.0, connecting_rod={"length_m": 0.1 / ratio})])
        for k, angle in enumerate((90.0, 270.0, 270.0, 90.0))
    ]
    return machine(throws, [], balance_shafts=shafts, **more)


def at(body: dict[str, Any], answer: dict[str, Any], theta_deg: float, first: bool = False) -> tuple[complex, complex]:
    """Force [N] and couple [N m] at one shaft angle from the definitions alone: masses times accelerations.

    Parameters
    ----------
    first : of the first order of the pistons, in place of their true motion.
    """
    s = 1.0 if body.get("rotation", "ccw") == "ccw" else -1.0
    omega, theta = body["speed_rpm"] * math.pi / 30.0, math.radians(theta_deg)
    planes = [crank["position_m"] for crank in body["throws"]]
    middle = 0.5 * (min(planes) + max(planes))
    pushed: list[tuple[complex, float]] = []
    for body_throw in body["throws"]:
        radius, turn = (
            body_throw["crank_radius_m"],
            cmath.exp(1j * (math.radians(body_throw["crank_angle_deg"]) + s * theta)),
        )
        pushed.append((body_throw["rotating_mass_kg"] * radius * omega**2 * turn, body_throw["position_m"]))
        for line in body_throw["rows"]:
            axis = cmath.exp(1j * math.radians(line["axis_deg"]))
            lam = radius / line["connecting_rod"]["length_m"]
            own = (turn * axis.conjugate()).real, (turn * axis.conjugate()).imag
            w = 1.0 - (lam * own[1]) ** 2
            # second derivative of r cos phi + l cos beta, negated
            true = own[0] + lam * (own[0] ** 2 - own[1] ** 2) / math.sqrt(w)
            true += lam**3 * (own[0] * own[1]) ** 2 / w**1.5
            share = own[0] if first else true
            pushed.append((line["reciprocating_mass_kg"] * radius * omega**2 * share * axis, body_throw["position_m"]))
    turning = [(1, body["webs"], answer["counterweights"])]
    turning += [
        (balance_shaft["speed_ratio"], balance_shaft["webs"], optimum["counterweights"])
        for balance_shaft, optimum in zip(body["balance_shafts"], answer["balance_shafts"], strict=True)
    ]
    for ratio, places, fitted in turning:
        if first and abs(ratio) != 1:
            continue
        for place, counterweight in zip(places, fitted, strict=True):
            angle = math.radians(counterweight["angle_deg"]) + s * ratio * theta
            size = counterweight["mass_kg"] * place["counterweight_radius_m"] * (ratio * omega) ** 2
            pushed.append((size * cmath.exp(1j * angle), place["position_m"]))
    return sum(force for force, _ in pushed), sum((z - middle) * force for force, z in pushed)


def rolled(body: dict[str, Any], answer: dict[str, Any], theta_deg: float) -> float:
    """Moment about the crankshaft on the frame [N m], counter-clockwise, from the definitions alone; without gas.

    The pistons take the power that their kinetic energy rises by from the crankshaft, and the frame holds against the
    torque of that. A shaft beside the crankshaft pushes with the lever of its place.
    """
    s = 1.0 if body.get("rotation", "ccw") == "ccw" else -1.0
    omega, theta = body["speed_rpm"] * math.pi / 30.0, math.radians(theta_deg)
    actual_power = 0.0
    for crank in body["throws"]:
        radius, turn = crank["crank_radius_m"], cmath.exp(1j * (math.radians(crank["crank_angle_deg"]) + s * theta))
        for line in crank["rows"]:
            own = turn * cmath.exp(-1j * math.radians(line["axis_deg"]))
            cosine, sine, lam = own.real, s * own.imag, radius / line["connecting_rod"]["length_m"]
            w = 1.0 - (lam * sine) ** 2
            speed = -radius * omega * (sine + lam * sine * cosine / math.sqrt(w))
            outward = cosine + lam * (cosine**2 - sine**2) / math.sqrt(w) + lam**3 * (cosine * sine) ** 2 / w**1.5
            power = line["reciprocating_mass_kg"] * speed * -radius * omega**2 * outward
            actual_power += s * power / omega
    for balance_shaft, of_shaft in zip(body["balance_shafts"], answer["balance_shafts"], strict=True):
        for place, fitted in zip(balance_shaft["webs"], of_shaft["counterweights"], strict=True):
            angle = math.radians(fitted["angle_deg"]) + s * balance_shaft["speed_ratio"] * theta
            size = fitted["mass_kg"] * place["counterweight_radius_m"] * (balance_shaft["speed_ratio"] * omega) ** 2
            x, y = balance_shaft.get("x_m", 0.0), balance_shaft.get("y_m", 0.0)
            actual_power += size * (x * math.sin(angle) - y * math.cos(angle))
    return actual_power


class FirstOrder(NamedTuple):
    """What turns with the crankshaft and against it of force [kg m] and moment [kg m^2], over omega^2."""

    fixed: np.ndarray  # (2, 2) complex: of force and moment, with and against
    lever: np.ndarray  # (2, 2, places): what a kilogram at a place adds to each, of its unit vector
    span: float  # m

    def terms(self, weights: Any) -> list[Any]:
        """Weighted sizes as two sums of two vectors each: force and moment, with weights (places,) complex kg."""
        return [[self.fixed[n, way] + self.lever[n, way] @ weights for way in range(2)] for n in range(2)]


def every_place(body: dict[str, Any]) -> list[dict[str, Any]]:
    """Webs of the crankshaft, and behind them those of balance shafts."""
    return [*body["webs"], *(place for balance_shaft in body["balance_shafts"] for place in balance_shaft["webs"])]


def first_order(body: dict[str, Any]) -> FirstOrder:
    """From definitions: a row halves into what turns with and against the crankshaft, a shaft does what it does."""
    places = every_place(body)
    turns = [1] * len(body["webs"]) + [
        balance_shaft["speed_ratio"] for balance_shaft in body["balance_shafts"] for _ in balance_shaft["webs"]
    ]
    planes = [body_throw["position_m"] for body_throw in body["throws"]]
    middle = 0.5 * (min(planes) + max(planes))
    fixed = np.zeros((2, 2), complex)
    for single_throw in body["throws"]:
        arm = np.array([1.0, single_throw["position_m"] - middle])
        crank, radius = np.exp(1j * np.deg2rad(single_throw["crank_angle_deg"])), single_throw["crank_radius_m"]
        fixed[:, 0] += arm * single_throw["rotating_mass_kg"] * radius * crank
        for of_row in single_throw["rows"]:
            half = 0.5 * of_row["reciprocating_mass_kg"] * radius
            fixed[:, 0] += arm * half * crank
            fixed[:, 1] += arm * half * np.exp(2j * np.deg2rad(of_row["axis_deg"])) * np.conj(crank)
    radius = np.array([place["counterweight_radius_m"] for place in places])
    arms = np.array([[1.0] * len(places), [place["position_m"] - middle for place in places]])
    lever = np.stack([arms * radius * (np.array(turns) == way) for way in (1, -1)], axis=1)
    every = planes + [place["position_m"] for place in body["webs"]]
    return FirstOrder(fixed, lever, max(every) - min(every) or 1.0)
