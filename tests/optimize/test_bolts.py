"""The largest centrifugal force of a counterweight at the highest speed of the machine; analytic values.

One crank with a rotating mass, and one web opposite: the counterweight m R takes m R omega^2 from the force.
"""

from typing import Any

import numpy as np
import pytest
from pydantic import ValidationError

from optimizer.studies.sweep import run_chunk
from schemas.request.requests import OptimizeRequest
from schemas.sweep.request import SweepRequest
from tests.verification.checking import broken, optimized

RADIUS, MOST = 0.2, 1500.0
SQUARE = (20.0 * np.pi) ** 2  # of 600 rpm


def body(**more: Any) -> dict[str, Any]:
    throw = {"position_m": 0, "crank_radius_m": 0.1, "crank_angle_deg": 30, "rotating_mass_kg": 10, "rows": []}
    web = {"name": "w", "position_m": 0, "counterweight_radius_m": RADIUS, "max_mass_kg": 20}
    web["max_centrifugal_force_N"] = MOST
    return {"machine": {"kind": "reciprocating", "speed_rpm": 600, "throws": [throw], "webs": [web], **more}}


@pytest.mark.parametrize(("more", "faster"), [({}, 1.0), ({"overspeed_rpm": 720}, 1.2)])
def test_it_is_kept_at_the_highest_speed(more: dict[str, Any], faster: float) -> None:
    answer = optimized(body(**more))
    (fitted,), (price,) = answer.counterweights, answer.shadow_prices
    assert answer.status == "optimal"
    assert fitted.centrifugal_force_N == pytest.approx(MOST, rel=1e-4)
    assert fitted.centrifugal_force_N <= MOST * (1 + 1e-12)
    assert fitted.active_limits == ("max_centrifugal_force",)
    assert (price.limit, price.unit) == ("max_centrifugal_force", "N/N")
    assert price.value == pytest.approx(1 / faster**2, rel=1e-6)
    assert answer.certificate is not None
    assert answer.certificate.objective == pytest.approx(SQUARE - MOST / faster**2, abs=1.1e-6 * SQUARE)


def test_the_checker_counts_with_it() -> None:
    payload = body()
    answer = optimized(payload).model_dump(mode="json")
    payload["machine"]["webs"][0]["max_centrifugal_force_N"] = 0.99 * MOST
    assert any("max_mass" in claim for claim in broken(payload, answer))


def test_rows_of_a_sweep_have_it() -> None:
    axes = [{"path": "/machine/overspeed_rpm", "values": [None, 600, 1200]}]
    request = SweepRequest.model_validate({"base": body(), "axes": axes})
    table = run_chunk(request.model_dump_json().encode(), 0, 3).to_pylist()
    allowed = np.array([MOST, MOST, MOST / 4]) / (RADIUS * SQUARE)
    assert [row["mass_kg.w"] for row in table] == pytest.approx(allowed, rel=1e-4)


@pytest.mark.parametrize(
    ("change", "path"),
    [
        ({"max_centrifugal_force_N": 0}, ("max_centrifugal_force_N",)),
        ({"max_centrifugal_force_N": "-3 kN"}, ("max_centrifugal_force_N",)),
    ],
)
def test_bad_input_names_the_field(change: dict[str, Any], path: tuple[str, ...]) -> None:
    payload = body()
    payload["machine"]["webs"][0] |= change
    with pytest.raises(ValidationError) as refused:
        OptimizeRequest.model_validate(payload)
    assert refused.value.errors()[0]["loc"][-1:] == path
