"""Machines whose counterweights are chosen for the whole turn, and what all sets of them come to by statics."""

import json
from collections.abc import Sequence
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np

from optimizer.analyze import analyze
from schemas.answer.answers import Certificate, OptimizeAnswer
from schemas.request.requests import AnalyzeRequest
from tests.verification.checking import sound_answer

MASSES, HOLES = [4.0, 11.0], [0.0, 120.0, 240.0]
BEARINGS = {"a": -0.6, "b": 0.6}
FAST = {"name": "fast", "weight": 0.5, "changes": [{"path": "/machine/speed_rpm", "value": 1300}]}
SLOW = {"name": "slow", "changes": []}
#: of a smooth curve, what a degree leaves out at most
DEGREE = 3e-4


def twin(**more: Any) -> dict[str, Any]:
    """Two cranks at right angles between two bearings, four webs with three holes each."""
    path = Path(__file__).parents[2] / "examples" / "catalogue-twin.json"
    machine: dict[str, Any] = json.loads(path.read_bytes())["machine"]
    machine["bearings"] = [{"name": name, "position_m": z} for name, z in BEARINGS.items()]
    machine["catalogue"] = {"masses_kg": MASSES}
    machine["webs"] = [{**web, "hole_angles_deg": HOLES} for web in machine["webs"]]
    for throw in machine["throws"]:
        throw["rows"][0]["connecting_rod"] = {"length_m": 0.4, "mass_kg": 0}
    return machine | more


def request_body(machine: dict[str, Any], gap: float = 1e-6, **goal: Any) -> dict[str, Any]:
    return {
        "machine": machine,
        "objective": goal,
        "accuracy": {"relative_gap": gap, "time_limit_s": 30},
        "angles": {"step_deg": 30},
    }


class Loads:
    """Loads of both bearings over the turn by statics: of the machine from the analysis, of masses by levers."""

    def __init__(self, machine: dict[str, Any]) -> None:
        bare = {name: value for name, value in machine.items() if name not in ("catalogue", "max_counterweights")}
        bare["webs"] = [{k: v for k, v in web.items() if k != "hole_angles_deg"} for web in machine["webs"]]
        self.bare = bare
        answer = analyze(
            AnalyzeRequest.model_validate({"machine": bare, "outputs": ["main_bearings"], "angles": {"step_deg": 1}})
        )
        assert answer.main_bearings is not None
        self.theta = np.deg2rad(answer.main_bearings.angle_deg)
        self.still = np.array(
            [
                np.array(bearing.before.force_x_N) + 1j * np.array(bearing.before.force_y_N)
                for bearing in answer.main_bearings.bearings
            ]
        )
        self.square = (machine["speed_rpm"] * np.pi / 30.0) ** 2
        self.place = np.array([web["position_m"] for web in machine["webs"]])
        self.radius = np.array([web["counterweight_radius_m"] for web in machine["webs"]])
        self.at = np.array(list(BEARINGS.values()))

    def peak(self, u: np.ndarray) -> np.ndarray:
        """
        Largest load of a bearing (sets,) N with unbalances (sets, webs): turned back with the shaft, it is a constant
        more at every angle.
        """
        share = (self.place - self.at[0]) / (self.at[1] - self.at[0])
        added = np.stack([u @ (1.0 - share), u @ share], axis=-1)[..., None] * self.square
        still = self.still * np.exp(-1j * self.theta)
        square = (still.real + added.real) ** 2 + (still.imag + added.imag) ** 2
        return np.asarray(np.sqrt(np.max(square, axis=(-2, -1))))

    def frame(self, u: np.ndarray, plane: float) -> tuple[np.ndarray, np.ndarray]:
        """Peaks of the first-order force and moment about a plane: phasors with the shaft and against it."""
        co, counter = np.zeros((2, 2), complex)
        for throw in self.bare["throws"]:
            lever, crank = np.array([1.0, throw["position_m"] - plane]), np.deg2rad(throw["crank_angle_deg"])
            (row,) = throw["rows"]
            half = 0.5 * row["reciprocating_mass_kg"]
            co += lever * throw["crank_radius_m"] * (throw["rotating_mass_kg"] + half) * np.exp(1j * crank)
            back = 2 * np.deg2rad(row["axis_deg"]) - crank
            counter += lever * throw["crank_radius_m"] * half * np.exp(1j * back)
        added = np.stack([np.sum(u, axis=-1), u @ (self.place - plane)])
        force, moment = self.square * (np.abs(co[:, None] + added) + np.abs(counter)[:, None])
        return force, moment


def every_set(
    machine: dict[str, Any], masses: Sequence[float] = MASSES
) -> tuple[list[tuple[tuple[float, float], ...]], np.ndarray]:
    """Masses and angles of all sets, and their unbalances (sets, webs) kg m."""
    options = [(0.0, 0.0), *product(masses, HOLES)]
    sets = list(product(options, repeat=len(machine["webs"])))
    actual_sets = np.array(sets)
    radius = np.array([web["counterweight_radius_m"] for web in machine["webs"]])
    return sets, actual_sets[..., 0] * radius * np.exp(1j * np.deg2rad(actual_sets[..., 1]))


def certified(body: dict[str, Any]) -> tuple[OptimizeAnswer, Certificate]:
    answer = sound_answer(body)
    assert answer.status == "optimal", answer.status_reason
    assert answer.certificate is not None
    return answer, answer.certificate


def chosen(answer: OptimizeAnswer) -> np.ndarray:
    """(1, webs) kg m."""
    masses_kg = [
        counterweight.mass_kg * 0.12 * np.exp(1j * np.deg2rad(counterweight.angle_deg))
        for counterweight in answer.counterweights
    ]
    return np.array([masses_kg])


def two_webs() -> dict[str, Any]:
    """The same machine with a web at each end, at least 14 kg heavy or without a counterweight."""
    machine = twin()
    del machine["catalogue"]
    machine["webs"] = [
        {"name": web["name"], "position_m": web["position_m"], "counterweight_radius_m": 0.12, "max_mass_kg": 16.0,
         "min_fitted_mass_kg": 14.0}
        for web in (machine["webs"][0], machine["webs"][3])
    ]  # fmt: skip
    return machine
