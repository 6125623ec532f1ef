"""Machines for the tests of the whole flow, as JSON, and an independent simulation of their first order."""

import math
import random
from typing import Any

import numpy as np


def row(axis: float, mass: float, **more: Any) -> dict[str, Any]:
    return {"axis_deg": axis, "reciprocating_mass_kg": mass, **more}


def throw(position: float, angle: float, rows: list[dict[str, Any]], radius: float = 0.1, rotating: float = 0.0):
    return {
        "position_m": position,
        "crank_radius_m": radius,
        "crank_angle_deg": angle,
        "rotating_mass_kg": rotating,
        "rows": rows,
    }


def web(name: str, position: float, max_mass: float = 100.0, radius: float = 0.1, **more: Any) -> dict[str, Any]:
    return {
        "name": name,
        "position_m": position,
        "counterweight_radius_m": radius,
        "max_mass_kg": max_mass,
        **more,
    }


def machine(throws: list[dict[str, Any]], webs: list[dict[str, Any]], **more: Any) -> dict[str, Any]:
    return {"kind": "reciprocating", "speed_rpm": 600.0, "throws": throws, "webs": webs, **more}


def random_machine(seed: int) -> dict[str, Any]:
    """One to four throws with up to three rows each, two to six webs, any limits."""
    rng = random.Random(seed)
    throws = [
        throw(
            rng.uniform(-1, 1),
            rng.uniform(0, 360),
            [
                row(
                    rng.uniform(0, 360),
                    rng.uniform(0, 50),
                    offset_m=rng.uniform(-0.1, 0.1),
                    connecting_rod={"length_m": rng.choice([None, 0.6]), "mass_kg": rng.uniform(0, 20)},
                )
                for _ in range(rng.randint(0, 3))
            ],
            radius=rng.uniform(0.05, 0.2),
            rotating=rng.uniform(0, 20),
        )
        for _ in range(rng.randint(1, 4))
    ]
    webs = [
        web(
            str(k),
            rng.uniform(-1, 1),
            rng.choice([0.0, 5.0, 50.0, 500.0]),
            rng.uniform(0.1, 0.3),
            sector=rng.choice([None, {"centre_deg": rng.uniform(0, 360), "half_angle_deg": rng.choice([5, 60, 90])}]),
        )
        for k in range(rng.randint(2, 6))
    ]
    return machine(
        throws,
        webs,
        rotation=rng.choice(["cw", "ccw"]),
        speed_rpm=rng.uniform(100, 3000),
        reference_plane_m=rng.choice([None, 0.3]),
        max_total_mass_kg=rng.choice([None, 30.0]),
    )


def first_order(body: dict[str, Any], weights: list[dict[str, Any]], theta_deg: Any) -> np.ndarray:
    """First-order force [N] and couple [N m] (2, angles) at shaft angles, from the definitions of the contract alone.

    Independent of the package: row by row, cos of the row's own crank angle along its axis.
    """
    sense = 1 if body.get("rotation", "ccw") == "ccw" else -1
    omega = body["speed_rpm"] * math.pi / 30
    planes = [crank["position_m"] for crank in body["throws"]]
    reference = body.get("reference_plane_m")
    reference = 0.5 * (min(planes) + max(planes)) if reference is None else reference
    theta = np.asarray(theta_deg, float)
    both = np.zeros((2, *theta.shape), complex)

    def add(vector: np.ndarray, plane: float) -> None:
        both[0] += vector
        both[1] += (plane - reference) * vector

    def turned(angle_deg: float) -> np.ndarray:
        return np.asarray(np.exp(1j * np.radians(angle_deg + sense * theta)))

    for body_throw in body["throws"]:
        radius, angle, plane = body_throw["crank_radius_m"], body_throw["crank_angle_deg"], body_throw["position_m"]
        add(body_throw["rotating_mass_kg"] * radius * omega**2 * turned(angle), plane)
        for line in body_throw["rows"]:
            rod = line.get("connecting_rod") or {"mass_kg": 0.0}
            share = rod.get("reciprocating_share", 1 / 3)
            phi = np.radians(theta + sense * (angle - line["axis_deg"]))
            moving = line["reciprocating_mass_kg"] + share * rod["mass_kg"]
            axis = np.exp(1j * np.radians(line["axis_deg"]))
            own = plane + line.get("offset_m", 0.0)
            add(moving * radius * omega**2 * np.cos(phi) * axis, own)
            add((1 - share) * rod["mass_kg"] * radius * omega**2 * turned(angle), own)
    place = {body_web["name"]: body_web for body_web in body["webs"]}
    for weight in weights:
        at = place[weight["web"]]
        size = weight["mass_kg"] * at["counterweight_radius_m"] * omega**2
        add(size * turned(weight["angle_deg"]), at["position_m"])
    return both
