"""Seed figures, requests in shorthand, and random patterns of pins."""

import json
from pathlib import Path
from typing import Any

import numpy as np
from hypothesis import strategies as st

from optimizer.mechanics.angles import direction
from optimizer.numerics.arrays import Real
from optimizer.pins.answer import pin_loads
from optimizer.pins.loads import Pins
from schemas.scroll.pin_loads import PinLoadsAnswer, PinLoadsRequest

CHECKS = {check["id"]: check for check in json.loads((Path(__file__).parent / "seed_pins.json").read_text())["checks"]}
TORQUE = 12.0  # N m, that of the seed's figures
TABLE = {"angle_deg": [0, 70, 115, 260], "torque_Nm": [12, 20, 9, 15]}


def ask(**body: Any) -> PinLoadsAnswer:
    return pin_loads(PinLoadsRequest.model_validate({"rotation_torque_Nm": TORQUE, **body}))


def even(count: int, **body: Any) -> PinLoadsAnswer:
    return ask(**{"pin_count": count, "pin_circle_radius_m": 0.06, **body})


def pins_at(angles_deg: Any, **options: Any) -> list[dict[str, Any]]:
    """Pins at these angles; every other field is one value for all, or a list."""
    fields = {"radius_m": 0.06, **options}
    return [
        {"angle_deg": angle, **{name: value[i] if isinstance(value, list) else value for name, value in fields.items()}}
        for i, angle in enumerate(angles_deg)
    ]


def loads(answer: PinLoadsAnswer) -> Real:
    """(T, n) N; nan at dead points."""
    return np.array([pin.load_N for pin in answer.pins], dtype=float).T


def even_pins(count: int, radius: float = 0.06) -> Pins:
    return Pins(radius * direction(360.0 * np.arange(count) / count), np.ones(count))


def random_pins(rng: np.random.Generator, count: int, *leading: int) -> Pins:
    """Pins all round, unequal in everything; stiffnesses within a factor of 10."""
    angle = 360.0 / count * (np.arange(count) + rng.uniform(-0.4, 0.4, (*leading, count)))
    place = rng.uniform(0.03, 0.09, (*leading, count)) * direction(angle)
    return Pins(place, 1e7 * 10.0 ** rng.uniform(0.0, 1.0, (*leading, count)))


seeds = st.integers(0, 2**32 - 1)
