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


def geared(ratio: int, **objective: Any) -> dict[str, Any]:
    """A row on its crank, and a shaft beside it with one web, in the plane of the crank."""
    row = {"axis_deg": 0.0, "reciprocating_mass_kg": 30.0, "connecting_rod": {"length_m": 0.3}}
    throw = {"position_m": 0, "crank_radius_m": 0.1, "crank_angle_deg": 0, "rotating_mass_kg": 0, "rows": [row]}
    web = {"name": "g", "position_m": 0, "counterweight_radius_m": RADIUS, "max_centrifugal_force_N": MOST}
    shaft = {"name": "s", "speed_ratio": ratio, "webs": [web | {"max_mass_kg": 20}]}
    machine = {"kind": "reciprocating", "speed_rpm": 600, "throws": [throw], "webs": [], "balance_shafts": [shaft]}
    return {"machine": machine, "objective": objective}


@pytest.mark.parametrize(("more", "faster"), [({}, 1.0), ({"overspeed_rpm": 720}, 1.2)])
def test_on_a_balance_shaft_it_counts_at_the_speed_of_that(more: dict[str, Any], faster: float) -> None:
    """Analytic: half of the force of a row turns backwards, and the shaft takes from it what its bolts bear."""
    payload = geared(-1)
    payload["machine"] |= more
    answer = optimized(payload)
    (fitted,), (price,) = answer.balance_shafts[0].counterweights, answer.shadow_prices
    assert fitted.mass_kg == pytest.approx(MOST / (RADIUS * SQUARE * faster**2), rel=1e-4)
    assert fitted.active_limits == ("max_centrifugal_force",)
    assert (price.limit, price.web, price.unit) == ("max_centrifugal_force", "g", "N/N")
    assert price.value == pytest.approx(1 / faster**2, rel=1e-6)
    assert answer.certificate is not None
    assert answer.certificate.objective == pytest.approx(3.0 * SQUARE - MOST / faster**2, rel=1.1e-6)


def test_at_twice_the_speed_bolts_hold_a_quarter() -> None:
    """Analytic: m R (2 omega)^2; the checker counts with it as well, and so do rows of a sweep."""
    payload = geared(2, orders="all")
    answer = optimized(payload)
    (fitted,) = answer.balance_shafts[0].counterweights
    assert fitted.mass_kg == pytest.approx(MOST / (4.0 * RADIUS * SQUARE), rel=1e-4)
    assert fitted.centrifugal_force_N == pytest.approx(MOST, rel=1e-4)
    assert fitted.centrifugal_force_N <= MOST * (1 + 1e-12)
    (price,) = answer.shadow_prices
    rise = 1.01
    payload["machine"]["balance_shafts"][0]["webs"][0]["max_centrifugal_force_N"] = rise * MOST
    after = optimized(payload)
    assert answer.certificate is not None
    assert after.certificate is not None
    fall = (answer.certificate.objective - after.certificate.objective) / ((rise - 1.0) * MOST)
    assert price.value == pytest.approx(fall, rel=1e-2)
    payload["machine"]["balance_shafts"][0]["webs"][0]["max_centrifugal_force_N"] = 0.99 * MOST
    assert any("max_mass" in claim or "limits" in claim for claim in broken(payload, answer.model_dump(mode="json")))
    path = "/machine/balance_shafts/0/webs/0/max_centrifugal_force_N"
    request = SweepRequest.model_validate({"base": geared(-1), "axes": [{"path": path, "values": [MOST, 2.0 * MOST]}]})
    table = run_chunk(request.model_dump_json().encode(), 0, 2).to_pylist()
    allowed = np.array([1.0, 2.0]) * MOST / (RADIUS * SQUARE)
    assert [row["mass_kg.g"] for row in table] == pytest.approx(allowed, rel=1e-4)


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
