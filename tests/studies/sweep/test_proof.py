"""The multipliers of a row prove its bounds, evaluated again from the design and the row alone."""

import json
import math
from collections.abc import Iterator
from typing import Any

import pytest

from optimizer.studies.sweep import run_chunk
from optimizer.studies.sweep.rows import rows
from schemas.request.requests import OptimizeRequest
from schemas.sweep.request import SweepRequest
from service.verification import checker
from tests.hard.cases.case import machine, throw, web
from tests.optimize import by_hand
from tests.optimize.machines import random_machine

PLANE = 0.3
#: a bound of the mass holds for all that counts as keeping the ceilings, which costs digits where they bind
CLOSE = 1e-6


def swept(body: dict[str, Any], ceilings: list[float | None], limits: list[float], **more: Any) -> SweepRequest:
    axes = [
        {"path": "/objective/force_ceiling_N", "values": ceilings},
        {"path": "/machine/webs/0/max_mass_kg", "values": limits},
    ]
    return SweepRequest.model_validate({"base": body, "axes": axes, **more})


def designs(body: dict[str, Any], request: SweepRequest) -> Iterator[tuple[dict[str, Any], dict[str, Any]]]:
    """Each row with the request of its design, defaults filled in."""
    table = rows(request, 0, request.total)
    for k in range(request.total):
        row = {name: column[k] for name, column in table.items()}
        row = {name: None if isinstance(value, float) and math.isnan(value) else value for name, value in row.items()}
        design = json.loads(json.dumps(body))
        design["objective"]["force_ceiling_N"] = row["/objective/force_ceiling_N"]
        design["machine"]["webs"][0]["max_mass_kg"] = row["/machine/webs/0/max_mass_kg"]
        yield json.loads(OptimizeRequest.model_validate(design).model_dump_json()), row


@pytest.mark.parametrize("combine", ["sum", "max"])
@pytest.mark.parametrize("seed", range(3))
def test_every_row_carries_the_proof_of_its_bounds(seed: int, combine: str) -> None:
    """With and without ceilings, kept or in conflict, webs that carry nothing among them (independent, 60 digits)."""
    design = {**random_machine(seed), "reference_plane_m": PLANE}
    body = {"machine": design, "objective": {"combine": combine, "force_ceiling_N": 1.0}}
    statuses = set()
    for request, row in designs(body, swept(body, [1e-3, 3e3, 1e5, None], [0.0, 3.0, 1e3], multipliers=True)):
        statuses.add(row["status"])
        recomputed = by_hand.of_row(request, PLANE, row)
        assert len(recomputed) == (1 if row["status"] == "infeasible" else 2)
        for name, (exact, printed) in recomputed.items():
            if name == "conflict":
                assert exact > 0
            else:
                assert 0 <= exact - printed <= CLOSE * abs(printed) + 1e-11, name
    assert "optimal" in statuses


def test_rows_show_their_multipliers_only_if_asked() -> None:
    body = {"machine": random_machine(1), "objective": {"force_ceiling_N": 1e9}}
    plain, query = swept(body, [1e9], [1.0]), swept(body, [1e9], [1.0], multipliers=True)
    assert "multipliers" not in rows(plain, 0, 1)
    assert [column.name for column in query.column_selection] == [
        *(c.name for c in plain.column_selection),
        "multipliers",
    ]
    chosen = swept(body, [1e9], [1.0], multipliers=True, columns=["force_peak_N"])
    assert [column.name for column in chosen.column_selection] == ["index", "status", "force_peak_N", "multipliers"]


def test_rows_that_are_no_valid_designs_have_no_multipliers() -> None:
    body = {"machine": random_machine(1), "objective": {"force_ceiling_N": 1e9}}
    (text,) = rows(swept(body, [1e9], [-1.0], multipliers=True), 0, 1)["multipliers"]
    assert text is None


def test_what_is_analyzed_has_no_multipliers() -> None:
    body = {"machine": random_machine(1), "counterweights": []}
    axes = [{"path": "/machine/speed_rpm", "values": [500.0]}]
    with pytest.raises(ValueError, match="no certificate"):
        SweepRequest.model_validate({"task": "analyze", "base": body, "axes": axes, "multipliers": True})


def test_rows_say_which_limits_their_bounds_count_with() -> None:
    """A web without a limit: the row by itself is checked as the answer to its design is; the budget is its reach."""
    throws = [throw(0.0, 0.0, [], radius=1.0, rotating=10.0)]
    webs = [web("A", 0.0, 0.32, 2.0), web("B", 0.0, None, 1.0)]
    base = {"machine": machine(throws, webs, omega=1.0, reference_plane_m=0.0), "objective": {}}
    for ceiling in (None, 1e-3):
        base["objective"] = {"force_ceiling_N": ceiling}
        axis = {"path": "/machine/max_total_mass_kg", "values": [1.0]}
        body = {"base": base, "axes": [axis], "multipliers": True}
        row = run_chunk(SweepRequest.model_validate(body).model_dump_json().encode(), 0, 1).to_pylist()[0]
        assert json.loads(row["multipliers"])["implied_max_mass_kg"] == {"B": pytest.approx(1.0)}
        assert checker().verify(body, [row])["verdict"] == "held"
