"""Sweeps of groups of webs that choose: from a catalogue, or at least so heavy or not there."""

from typing import Any

import numpy as np
import pytest

from tests.optimize.test_grouped_choices import request_body
from tests.optimize.test_mirrored_groups import PAIRS, grouped
from tests.optimize.test_web_groups import ANGLES, NAMES
from tests.studies.sweep.single import assert_row_is_the_single_answer, sweep, table

_LEAST, _GAP = 8.0, 1e-2


def answers(base: dict[str, Any], *axes: dict[str, Any]) -> tuple[list[str], list[dict[str, Any]]]:
    """Rows of a sweep, each the answer to its design alone (property)."""
    request = sweep(base, *axes)
    rows = table(request).to_pylist()
    return [assert_row_is_the_single_answer(request, row) for row in rows], rows


def castings(row: dict[str, Any]) -> np.ndarray:
    """Mass and place on the own crank (webs,), kg."""
    mass = np.array([row[f"mass_kg.{name}"] for name in NAMES])
    angle = np.array([row[f"angle_deg.{name}"] for name in NAMES]) - np.repeat(ANGLES, 2)
    weight: np.ndarray = mass * np.exp(1j * np.radians(angle))
    return weight


def assert_alike(row: dict[str, Any], mirror: bool) -> np.ndarray:
    """Analytic: one weight in every pair, in the same or in the mirrored place; its masses (pairs,)."""
    first, second = castings(row).reshape(-1, 2).T
    assert np.allclose(np.conj(second) if mirror else second, first, rtol=0, atol=1e-9)
    mass = np.array([[row[f"mass_kg.{name}"] for name in pair] for pair in PAIRS])
    assert np.all(mass[:, 0] == mass[:, 1])
    return mass[:, 0]


@pytest.mark.parametrize(
    ("mirror", "limit", "most"),
    [(False, "/machine/catalogue/max_part_numbers", 1), (True, "/machine/max_counterweights", 3)],
)
def test_groups_from_a_catalogue(mirror: bool, limit: str, most: int) -> None:
    base = request_body(PAIRS, mirror, [3.0, 6.0, 9.0], 60.0)
    replies, rows = answers(base, {"path": limit, "values": [None, most]})
    assert replies == ["optimal"] * 2
    masses = [assert_alike(row, mirror) for row in rows]
    assert set(np.ravel(masses)) <= {0.0, 3.0, 6.0, 9.0}
    # of three webs a pair takes two
    count = len(set(masses[1][masses[1] > 0])) if most == 1 else 2 * int(np.sum(masses[1] > 0))
    assert count <= most
    for row in rows:
        # all that can be chosen were compared
        assert row["lower_bound"] == pytest.approx(row["objective"], rel=1e-9)
    # analytic: a limit makes nothing better; this one costs something
    assert rows[0]["objective"] < rows[1]["objective"]


@pytest.mark.parametrize(
    ("mirror", "rotating"), [(False, [30]), pytest.param(True, [20, 30], marks=pytest.mark.nightly)]
)
def test_groups_that_are_at_least_so_heavy(mirror: bool, rotating: list[float]) -> None:
    base = grouped(PAIRS, mirror, max_mass_kg=12.0)
    for web in base["machine"]["webs"]:
        web["min_fitted_mass_kg"] = _LEAST
    base["accuracy"] = {"relative_gap": _GAP, "time_limit_s": 30}
    replies, rows = answers(base, {"path": "/machine/throws/0/rotating_mass_kg", "values": rotating})
    assert set(replies) == {"optimal"}
    for row in rows:
        mass = assert_alike(row, mirror)
        assert np.all((mass == 0) | (mass >= _LEAST))
        assert row["lower_bound"] <= row["objective"] <= row["lower_bound"] + _GAP * row["yardstick"]


def test_a_group_of_unlike_least_masses_is_an_invalid_design() -> None:
    base = grouped(PAIRS, False, max_mass_kg=12.0)
    for web in base["machine"]["webs"]:
        web["min_fitted_mass_kg"] = _LEAST
    base["accuracy"] = {"relative_gap": _GAP, "time_limit_s": 30}
    replies, rows = answers(base, {"path": "/machine/webs/1/min_fitted_mass_kg", "values": [_LEAST, 5]})
    assert replies == ["optimal", "invalid"]
    assert "/machine/web_groups/0/webs/1" in rows[1]["message"]
