"""Orders of crank angles compared by counterweights as a workshop makes them: each row certified, none left out."""

from collections.abc import Callable
from itertools import permutations
from typing import Any

import numpy as np
import pytest
from pydantic import ValidationError

from optimizer.optimize import optimize
from optimizer.studies.sweep.chunk import run_chunk
from schemas.sweep.request import SweepRequest
from tests.night import every

Machine = dict[str, Any]
EVEN = [0.0, 90.0, 180.0, 270.0]
#: no rotation and no mirror makes these of themselves
UNEVEN = [0.0, 70.0, 200.0, 310.0]
#: asked of every row and every single answer, of the yardstick
GAP = 1e-6


def machine(**changes: Any) -> Machine:
    """Four equal rows in line with a web beside each crank, which cannot carry all that is wanted; the same from both
    ends."""
    places = (-0.6, -0.2, 0.2, 0.6)
    throws = [
        {"position_m": z, "crank_radius_m": 0.1, "crank_angle_deg": 0, "rotating_mass_kg": 3.0,
         "rows": [{"axis_deg": 90, "reciprocating_mass_kg": 4.0}]}
        for z in places
    ]  # fmt: skip
    webs = [
        {"name": str(n), "position_m": z, "throw": n, "counterweight_radius_m": 0.12, "max_mass_kg": 3.0}
        for n, z in enumerate(places)
    ]
    return {"kind": "reciprocating", "speed_rpm": 600, "throws": throws, "webs": webs, **changes}


def steps() -> Machine:
    return machine(catalogue={"masses_kg": [1.0, 2.5], "angle_step_deg": 60})


def skew() -> Machine:
    """Webs whose cranks are not those of their images: the other end is another machine."""
    design = steps()
    design["webs"][1]["throw"], design["webs"][2]["throw"] = 0, 2
    return design


def holes() -> Machine:
    design = machine(catalogue={"masses_kg": [1.0, 2.5]})
    for web in design["webs"]:
        web["hole_angles_deg"] = [10.0, 120.0, 200.0]
    return design


def heavy() -> Machine:
    design = machine(max_total_mass_kg=7.0)
    for web in design["webs"]:
        web["min_fitted_mass_kg"] = 2.5
    return design


def cut() -> Machine:
    design = machine(max_total_mass_kg=4.0)
    for web in design["webs"]:
        del web["counterweight_radius_m"], web["max_mass_kg"]
        web["envelope"] = {"shape": "sector", "inner_radius_m": 0.05, "outer_radius_m": 0.13, "thickness_m": 0.01}
    return design


def alike(mirror: bool) -> Machine:
    return machine(web_groups=[{"name": "some", "webs": ["0", "1", "3"], "mirror": mirror}])


#: machines and the number of orders; analytic, of 24 sequences: turned and mirrored they are 3, from both ends 12
KINDS: dict[str, tuple[Callable[[], Machine], int]] = {
    "steps": (steps, 3),
    "steps at uneven angles": (steps, 12),
    "steps of other cranks at uneven angles": (skew, 24),
    "groups at uneven angles": (lambda: alike(False), 24),
    "holes": (holes, 12),
    "minimum masses": (heavy, 3),
    "plates under a budget": (cut, 3),
    "groups": (lambda: alike(False), 3),
    "mirrored groups": (lambda: alike(True), 3),
    "steps in groups": (lambda: {**steps(), "web_groups": [{"name": "some", "webs": ["0", "1"]}]}, 3),
    "two castings of one size": (
        lambda: machine(
            catalogue={"mass_step_kg": 0.5, "angle_step_deg": 30, "max_part_numbers": 1}, max_counterweights=2
        ),
        3,
    ),
}


def body(fields: Machine, angles: list[float] = EVEN) -> dict[str, Any]:
    base = {"machine": fields, "accuracy": {"relative_gap": GAP, "time_limit_s": 30}}
    return {"base": base, "design": "crank_orders", "angles_deg": angles}


def objectives(design: Machine, sequence: list[float]) -> tuple[np.ndarray, float]:
    """Of every sequence by itself (independent of what is the same machine), and the largest yardstick."""
    values: list[tuple[float, float]] = []
    for angles in permutations(sequence):
        throws = [{**throw, "crank_angle_deg": angle} for throw, angle in zip(design["throws"], angles, strict=True)]
        answer = optimize({**body(design)["base"], "machine": {**design, "throws": throws}})
        assert answer.certificate is not None
        values.append((answer.certificate.objective, answer.certificate.yardstick))
    every, sizes = np.array(values).T
    return every, float(np.max(sizes))


@pytest.mark.parametrize("kind", every(6, KINDS))
def test_every_order_stands_for_its_sequences(kind: str) -> None:
    """Brute force over the 24 sequences: the rows have all their objectives and no other."""
    function, count = KINDS[kind]
    angles = UNEVEN if kind.endswith("uneven angles") else EVEN
    request = SweepRequest.model_validate(body(function(), angles))
    assert request.total == count
    table = run_chunk(request.model_dump_json().encode(), 0, request.total)
    assert set(table["status"].to_pylist()) == {"optimal"}
    rows, (every, size) = table["objective"].to_numpy(), objectives(function(), angles)
    apart = np.abs(rows[:, None] - every)
    assert np.all(np.min(apart, axis=0) <= 2 * GAP * size)
    assert np.all(np.min(apart, axis=1) <= 2 * GAP * size)
    bound = table["lower_bound"].to_numpy()
    assert np.all(bound <= rows + 1e-9 * size)


def test_orders_that_a_group_does_not_allow_are_rows_that_say_so() -> None:
    """Sectors stand as drawn: where two cranks do not, their webs are no equal castings."""
    design = alike(False)
    design["web_groups"][0]["webs"] = ["0", "1"]
    for web in design["webs"][:2]:
        web["sector"] = {"centre_deg": 180.0, "half_angle_deg": 40.0}
    request = SweepRequest.model_validate(body(design))
    table = run_chunk(request.model_dump_json().encode(), 0, request.total)
    assert set(table["status"].to_pylist()) == {"invalid"}
    assert all("web_groups" in message for message in table["message"].to_pylist())


def test_too_many_orders_to_search() -> None:
    """Independent: 10176 orders of nine angles, by another program; of any masses they are rows of a batch."""
    throws = [
        {"position_m": 0.3 * k, "crank_radius_m": 0.1, "crank_angle_deg": 0,
         "rows": [{"axis_deg": 90, "reciprocating_mass_kg": 4.0}]}
        for k in range(9)
    ]  # fmt: skip
    webs = [{"name": "m", "position_m": 1.2, "counterweight_radius_m": 0.1, "max_mass_kg": 3.0, "throw": 4}]
    design = machine(throws=throws, webs=webs)
    payload = {**body(design), "angles_deg": [40.0 * n for n in range(9)]}
    assert SweepRequest.model_validate(payload).total == 10176
    design["catalogue"] = {"masses_kg": [1.0], "angle_step_deg": 90}
    with pytest.raises(ValidationError, match="at most 10000 designs are searched one by one; these make 10176"):
        SweepRequest.model_validate(payload)


def test_what_is_analyzed_has_no_choice() -> None:
    with pytest.raises(ValidationError, match="a sweep of what is analyzed"):
        SweepRequest.model_validate({**body(steps()), "task": "analyze", "base": {"machine": steps()}})
