"""Machines with parts to match, and what an assignment comes to by hand."""

from itertools import permutations, product
from typing import Any

import numpy as np

from optimizer.studies.matching.match import match
from schemas.match.answer import MatchAnswer
from schemas.match.request import MatchRequest

RADIUS, OMEGA = 0.12, 50.0


def machine(cranks_deg: list[float], axes_deg: list[float], webs: tuple[float, ...] = (), most: float = 20.0) -> Any:
    """One row of 12 kg on every throw, 0.3 m apart."""
    count = len(cranks_deg)
    return {
        "kind": "reciprocating",
        "speed_rpm": OMEGA * 30 / np.pi,
        "throws": [
            {
                "position_m": 0.3 * (k - (count - 1) / 2),
                "crank_radius_m": RADIUS,
                "crank_angle_deg": crank,
                "rows": [{"axis_deg": axis, "reciprocating_mass_kg": 12.0}],
            }
            for k, (crank, axis) in enumerate(zip(cranks_deg, axes_deg, strict=True))
        ],
        "webs": [
            {"name": f"w{k}", "position_m": place, "counterweight_radius_m": 0.1, "max_mass_kg": most}
            for k, place in enumerate(webs)
        ],
    }


def mirrored(rows: int) -> list[float]:
    """Cranks that are the same from both ends, all around: nothing is left where the masses are equal."""
    half = [720.0 * k / rows % 360.0 for k in range(rows // 2)]
    return [*half, *half[::-1]]


def parts(seed: int, *rows: int, scatter: float = 0.02) -> list[dict[str, Any]]:
    """A class for each number of rows, of 40 kg and what they scatter."""
    rng = np.random.default_rng(seed)
    return [
        {
            "class": f"class {c}",
            "names": [f"{c}.{k}" for k in range(count)],
            "masses_kg": np.round(40.0 * (1.0 + scatter * rng.standard_normal(count)), 3).tolist(),
        }
        for c, count in enumerate(rows)
    ]


def matched(body: dict[str, Any]) -> MatchAnswer:
    return match(MatchRequest.model_validate(body))


def objective(design: Any, row_masses: np.ndarray, moment_weight: float, force_weight: float = 1.0) -> np.ndarray:
    """Weighted peaks (...) of row masses (..., rows) by hand: a row pushes with m r w^2 cos(t + d - g)."""
    crank = np.exp(1j * np.deg2rad([throw["crank_angle_deg"] for throw in design["throws"]]))
    axis = np.exp(1j * np.deg2rad([throw["rows"][0]["axis_deg"] for throw in design["throws"]]))
    place = np.array([throw["position_m"] for throw in design["throws"]])
    co, counter = 0.5 * crank, 0.5 * axis**2 * np.conj(crank)
    force, moment = (
        sum(np.abs(row_masses @ (arm * part)) for part in (co, counter)) for arm in (np.ones_like(place), place)
    )
    size: np.ndarray = RADIUS * OMEGA**2 * (force_weight * force + moment_weight * moment)
    return size


def every(classes: list[dict[str, Any]], rows: int) -> np.ndarray:
    """Row masses (N, rows) of all assignments, where every class has a part for every row."""
    orders = [np.array(list(permutations(single_class["masses_kg"]))) for single_class in classes]
    return np.array([12.0 + sum(some, start=np.zeros(rows)) for some in product(*orders)])
