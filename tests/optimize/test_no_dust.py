"""What is fitted is fitted: no dust, no mass a hair below its limit, no angle a hair inside its sector."""

from typing import Any

import numpy as np
import pytest

from optimizer.optimize import optimize
from optimizer.studies.sweep import run_chunk
from tests.hard.cases.case import Body, machine, row, throw
from tests.optimize.whole_turn import ALONE, inline_six, request_of
from tests.studies.sweep.single import sweep
from tests.verification.checking import optimized


def crank(webs: int, rng: np.random.Generator, **limits: Any) -> Body:
    """Two throws at a right angle and more webs than are needed; ``limits`` are of every web."""
    throws = [
        throw(z, a, [row(a, float(rng.uniform(5, 20)))], rotating=float(rng.uniform(5, 10)))
        for z, a in ((-0.3, 0.0), (0.3, 90.0))
    ]
    places = [
        {"name": str(k), "position_m": z, "counterweight_radius_m": float(rng.uniform(0.15, 0.25)), **limits}
        for k, z in enumerate(np.linspace(-0.4, 0.4, webs).tolist())
    ]
    return {"machine": machine(throws, places)}


@pytest.mark.parametrize("seed", range(8))
@pytest.mark.parametrize("largest", [3.0, 1000.0])
def test_masses_are_something_or_nothing(seed: int, largest: float) -> None:
    """With ample limits no lightest optimum needs all of seven webs, of which an interior point leaves none empty."""
    answer = optimized(crank(7, np.random.default_rng(seed), max_mass_kg=largest))
    assert answer.status == "optimal"
    mass = np.array([counterweight.mass_kg for counterweight in answer.counterweights])
    fitted = mass > 0
    assert np.all(mass[fitted] > 1e-3 * np.max(mass))
    assert np.all((mass == largest) | (mass < largest * (1 - 1e-4)))
    assert [counterweight.angle_deg for counterweight in answer.counterweights if counterweight.mass_kg == 0] == [
        0.0
    ] * int(np.sum(~fitted))
    assert largest < 10.0 or not np.all(fitted)
    assert [counterweight.active_limits for counterweight in answer.counterweights] == [
        ("max_mass",) if m == largest else () for m in mass
    ]


@pytest.mark.parametrize("seed", range(4))
def test_angles_at_an_edge_are_the_edge(seed: int) -> None:
    body = crank(
        4, np.random.default_rng(seed), max_mass_kg=1000.0, sector={"centre_deg": 200.0, "half_angle_deg": 7.0}
    )
    answer = optimized(body)
    assert answer.status == "optimal"
    at_edge = [
        counterweight.angle_deg for counterweight in answer.counterweights if "sector" in counterweight.active_limits
    ]
    assert at_edge
    assert set(at_edge) <= {193.0, 207.0}


@pytest.mark.parametrize("goal", [{"bearing_measure": "peak", **ALONE}, {"bearing_measure": "rms"}])
def test_over_the_turn_too(goal: dict[str, Any]) -> None:
    """Two webs or more of an inline six carry nothing: 4e-9 of the largest before they were taken away."""
    six = inline_six()
    for web in six["webs"]:
        web["max_mass_kg"] = 0.5
    answer = optimize(request_of(six, bearing_weight=1, **goal))
    assert answer.status == "optimal"
    mass = np.array([counterweight.mass_kg for counterweight in answer.counterweights])
    assert np.all((mass == 0) | (mass > 1e-3 * np.max(mass)))
    assert 0 < np.sum(mass == 0) < 12
    assert np.all((mass == 0.5) | (mass < 0.5 * (1 - 1e-4)))


def test_a_sweep_fits_what_a_request_does() -> None:
    body = crank(7, np.random.default_rng(0), max_mass_kg=3.0)
    request = sweep(body, {"path": "/machine/webs/2/max_mass_kg", "values": [0.5, 3.0, 30.0]})
    rows = run_chunk(request.model_dump_json().encode(), 0, 3).to_pylist()
    for line, mass in zip(rows, (0.5, 3.0, 30.0), strict=True):
        body["machine"]["webs"][2]["max_mass_kg"] = mass
        for counterweight in optimized(body).counterweights:
            assert (line[f"mass_kg.{counterweight.web}"], line[f"angle_deg.{counterweight.web}"]) == (
                counterweight.mass_kg,
                counterweight.angle_deg,
            )


def _with_sectors(rng: np.random.Generator) -> Body:
    """One to five throws with two webs each, most of them in a sector opposite the crank."""
    throws, webs = [], []
    for k in range(int(rng.integers(1, 6))):
        crank = float(rng.choice([0, 90, 120, 180, 240, 270, rng.uniform(0, 360)]))
        rows = [
            row(float(rng.choice([0, 45, 90, 180])), float(10 ** rng.uniform(0, 2.5))) for _ in range(rng.integers(3))
        ]
        throws.append(throw(0.4 * k, crank, rows, rotating=float(10 ** rng.uniform(-1, 2))))
        for side in (-1, 1):
            web: Body = {"name": f"{k}{side}", "position_m": 0.4 * k + 0.1 * side, "counterweight_radius_m": 0.2}
            web["max_mass_kg"] = float(10 ** rng.uniform(0.5, 2.2))
            if rng.random() < 0.8:
                half = float(rng.choice([10, 30, 60, 90]))
                web["sector"] = {"centre_deg": (crank + 180) % 360, "half_angle_deg": half}
            webs.append(web)
    return {"machine": machine(throws, webs)}


def test_sectors_leave_no_dust() -> None:
    """Regression: eight of 150 machines had counterweights of 1e-9 to 1e-4 of their largest, as the least mass had used
    all that optima may differ by. What is left beside a sector's edge has room now."""
    rng = np.random.default_rng(2)
    dusty = 0
    for _ in range(150):
        answer = optimized(_with_sectors(rng))
        assert answer.status == "optimal"
        mass = np.array([counterweight.mass_kg for counterweight in answer.counterweights])
        dusty += bool(np.any((mass > 0) & (mass <= 1e-4 * np.max(mass))))
    assert dusty == 0
