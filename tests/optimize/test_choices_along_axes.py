"""Choices under ceilings along an axis on force and moment of all orders: what trying every set comes to."""

from functools import cache
from typing import Any

import numpy as np
import pytest

from optimizer.choices.discrete import branch, search
from optimizer.choices.discrete.search import TREE
from tests import night
from tests.optimize.choices import DEGREE, Loads, certified, chosen, every_set, request_body, twin, two_webs
from tests.optimize.whole_turn import ALONE
from tests.verification.checking import optimized

GOAL: dict[str, Any] = {"orders": "all", "bearing_weight": 1, "force_weight": 0.5, "moment_weight": 1.0}
CEILINGS = ("force_ceiling_x_N", "force_ceiling_y_N", "moment_ceiling_x_Nm", "moment_ceiling_y_Nm")


def of_frame(machine: dict[str, Any], u: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Force and moment about 0 of all orders (sets, angles) by the kinematics of crank and rod, which has no mass."""
    theta = np.deg2rad(np.arange(0.0, 360.0, 0.5))
    force, moment = np.zeros((2, theta.size), complex)
    for throw in machine["throws"]:
        (row,) = throw["rows"]
        r, length = throw["crank_radius_m"], row["connecting_rod"]["length_m"]
        crank, axis = theta + np.deg2rad(throw["crank_angle_deg"]), np.deg2rad(row["axis_deg"])
        phi = crank - axis
        # x = r cos phi + s, s^2 = l^2 - r^2 sin^2 phi, and what it becomes by deriving twice
        s = np.sqrt(length**2 - (r * np.sin(phi)) ** 2)
        rise = -(r**2) * np.sin(phi) * np.cos(phi)
        bent = -r * np.cos(phi) - r**2 * np.cos(2 * phi) / s - rise**2 / s**3
        rotating_mass_kg = throw["rotating_mass_kg"] * r * np.exp(1j * crank) - row[
            "reciprocating_mass_kg"
        ] * bent * np.exp(1j * axis)
        force, moment = force + rotating_mass_kg, moment + rotating_mass_kg * throw["position_m"]
    square = (machine["speed_rpm"] * np.pi / 30.0) ** 2
    place = np.array([web["position_m"] for web in machine["webs"]])
    turning = np.exp(1j * theta)
    added = np.stack([np.sum(u, axis=-1), u @ place])[..., None] * turning
    return square * (force + added[0]), square * (moment + added[1])


def along(machine: dict[str, Any], u: np.ndarray) -> dict[str, np.ndarray]:
    """Largest force and moment along either axis (sets,)."""
    return along_axes(*of_frame(machine, u))


def along_axes(force: np.ndarray, moment: np.ndarray) -> dict[str, np.ndarray]:
    components = (force.real, force.imag, moment.real, moment.imag)
    return {name: np.max(np.abs(values), axis=-1) for name, values in zip(CEILINGS, components, strict=True)}


@cache
def every_value(webs: int) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    """Of all sets of so many webs the objective, and what ceilings hold (sets,)."""
    machine = plane_at_0(webs)
    _, u = every_set(machine)
    force, moment = of_frame(machine, u)
    shaking = 0.5 * np.max(np.abs(force), axis=-1) + np.max(np.abs(moment), axis=-1)
    return shaking + Loads(machine).peak(u), along_axes(force, moment)


def plane_at_0(webs: int = 4) -> dict[str, Any]:
    machine = twin(reference_plane_m=0.0)
    machine["webs"] = machine["webs"][:webs]
    return machine


@pytest.mark.parametrize(
    ("by_tree", "webs", "share"),
    night.part(
        2,
        [
            (False, 4, {"force_ceiling_x_N": 0.9, "moment_ceiling_y_Nm": 0.9}),
            (True, 3, {"moment_ceiling_y_Nm": 0.95}),
            pytest.param(True, 4, {"force_ceiling_x_N": 0.9, "moment_ceiling_y_Nm": 0.9}, marks=pytest.mark.nightly),
            (False, 4, {"force_ceiling_y_N": 0.99}),
            (False, 4, {"moment_ceiling_x_Nm": 0.8}),
        ],
        rows=True,
    ),
)
def test_no_set_by_hand_is_better(
    monkeypatch: pytest.MonkeyPatch, by_tree: bool, webs: int, share: dict[str, float]
) -> None:
    """Independent: of all 2,401 sets, or 343 of three webs, those that keep ceilings which the best of all does not."""
    if by_tree:
        monkeypatch.setattr(search, "_SUMS", 0)
        monkeypatch.setattr(branch, "_SETS", 50)
    machine, (value, fields) = plane_at_0(webs), every_value(webs)
    least = np.argmin(value)
    ceilings = {name: float(part * fields[name][least]) for name, part in share.items()}
    optimum, proof = certified(request_body(machine, 1e-3, **GOAL, **ceilings))
    assert (proof.method == TREE) == by_tree
    best = float(np.min(value[np.all([fields[name] <= ceiling for name, ceiling in ceilings.items()], axis=0)]))
    assert best > 1.05 * float(value[least])
    assert best * (1 - 1e-9) <= proof.objective <= best * (1 + DEGREE + 1e-3)
    assert proof.lower_bound is not None
    assert proof.lower_bound <= best * (1 + DEGREE)
    here = along(machine, chosen(optimum))
    assert all(float(here[name][0]) <= ceiling * (1 + 1e-9) for name, ceiling in ceilings.items())


def test_none_keeps_them() -> None:
    """Independent: no set comes below the least of all sets, though other masses do."""
    machine = plane_at_0()
    least = float(np.min(every_value(4)[1]["moment_ceiling_y_Nm"]))
    answer = optimized(request_body(machine, **GOAL, moment_ceiling_y_Nm=0.999 * least))
    assert answer.status == "infeasible"
    assert answer.status_reason.startswith("Proven infeasible: no set")
    assert answer.infeasibility is not None
    assert answer.infeasibility.conflict == ("moment_ceiling_y_Nm",)


@night.at_night
def test_least_masses() -> None:
    """Independent: of both of two webs fitted, one or none, those of a grid that keep a ceiling."""
    machine = two_webs()
    machine["reference_plane_m"] = 0.0
    free, _ = certified(request_body(machine, 1e-3, bearing_weight=1, orders="all", **ALONE))
    ceiling = 0.95 * float(along(machine, chosen(free))["force_ceiling_y_N"][0])
    goal = {"bearing_weight": 1, "orders": "all", **ALONE, "force_ceiling_y_N": ceiling}
    optimum, proof = certified(request_body(machine, 1e-3, **goal))
    assert all(
        counterweight.mass_kg == 0.0 or counterweight.mass_kg >= 14.0 for counterweight in optimum.counterweights
    )
    assert float(along(machine, chosen(optimum))["force_ceiling_y_N"][0]) <= ceiling * (1 + 1e-9)
    turned = np.exp(1j * np.deg2rad(np.arange(0.0, 360.0, 8.0)))
    values = 0.12 * np.append(0.0, np.multiply.outer(np.linspace(14.0, 16.0, 3), turned).ravel())
    loads, best = Loads(machine), np.inf
    for objective in values:
        u = np.stack([np.full(values.size, objective), values], axis=-1)
        mask = along(machine, u)["force_ceiling_y_N"] <= ceiling
        if np.any(mask):
            best = min(best, float(np.min(loads.peak(u[mask]))))
    # a grid is above what it is a grid of
    assert proof.lower_bound is not None
    assert proof.lower_bound <= best
    assert 0.9 * best <= proof.objective <= best * (1 + 1e-3)
