"""Loads on the foundation: closed forms of one slider-crank, frames turned, sums of machines, as built."""

import json
from typing import Any

import numpy as np
import pytest
from pydantic import ValidationError

from optimizer.analyze import analyze
from optimizer.errors import OutOfRange
from optimizer.mechanics.slider_crank import acceleration_harmonic
from optimizer.optimize import optimize
from schemas.request.requests import AnalyzeRequest, OptimizeRequest
from service.documents.examples import bodies

MASS, RADIUS, ROD, SPEED, PLACE = 10.0, 0.1, 0.4, 600.0, 0.3
FORCE = MASS * RADIUS * (SPEED * np.pi / 30.0) ** 2
LOADS = {"force_x": "N", "force_y": "N", "couple_of_x_forces": "Nm", "couple_of_y_forces": "Nm"}


def throw(axis: float, crank: float = 0.0, place: float = PLACE, rotating: float = 0.0) -> dict[str, Any]:
    row = {"axis_deg": axis, "reciprocating_mass_kg": MASS, "connecting_rod": {"length_m": ROD}}
    return {
        "position_m": place,
        "crank_radius_m": RADIUS,
        "crank_angle_deg": crank,
        "rotating_mass_kg": rotating,
        "rows": [row],
    }


def machine(*throws: dict[str, Any], rotation: str = "ccw") -> dict[str, Any]:
    return {
        "kind": "reciprocating",
        "speed_rpm": SPEED,
        "rotation": rotation,
        "reference_plane_m": 0.0,
        "throws": throws,
        "webs": [],
    }


def loads(body: dict[str, Any], orders: tuple[int, ...] = (1, 2, 3, 4, 5, 6)) -> dict[int, dict[str, complex]]:
    """Phasors A e^{-j phase} of every load by order, without counterweights."""
    request = AnalyzeRequest.model_validate(
        {"machine": body, "outputs": ["foundation_loads"], "foundation_orders": orders}
    )
    foundation_loads = analyze(request).foundation_loads
    assert foundation_loads is not None
    return {foundation_load.order: phasors(foundation_load.before.model_dump()) for foundation_load in foundation_loads}


def phasors(of_set: dict[str, Any]) -> dict[str, complex]:
    return {
        name: complex(of_set[name][f"amplitude_{unit}"] * np.exp(-1j * np.deg2rad(of_set[name]["phase_deg"])))
        for name, unit in LOADS.items()
    }


@pytest.mark.parametrize("rotation", ["ccw", "cw"])
@pytest.mark.parametrize("crank", [0.0, 50.0])
def test_orders_of_one_slider_crank(rotation: str, crank: float) -> None:
    """Analytic: m r omega^2 A_k along the axis, in phase with the outer dead centre, and no odd order above 1."""
    document = loads(machine(throw(0.0, crank), rotation=rotation))
    for order in range(1, 7):
        size = FORCE * float(acceleration_harmonic(order, np.asarray(RADIUS / ROD)))
        assert document[order]["force_x"] == pytest.approx(size, rel=1e-13)
        assert document[order]["couple_of_x_forces"] == pytest.approx(PLACE * size, rel=1e-13)
        assert document[order]["force_y"] == document[order]["couple_of_y_forces"] == 0.0


@pytest.mark.parametrize(("rotation", "phase"), [("ccw", 90.0), ("cw", 270.0)])
def test_a_rotating_mass_comes_to_y_a_quarter_later(rotation: str, phase: float) -> None:
    """Analytic: the centrifugal force points along y a quarter revolution after x, or before it if cw."""
    body = machine({**throw(0.0, rotating=MASS)}, rotation=rotation)
    body["throws"][0]["rows"][0]["reciprocating_mass_kg"] = 0.0
    answer = analyze(AnalyzeRequest.model_validate({"machine": body, "outputs": ["foundation_loads"]}))
    assert answer.foundation_loads is not None
    first = answer.foundation_loads[0].before
    assert first.force_x.amplitude_N == pytest.approx(FORCE, rel=1e-13)
    assert first.force_x.phase_deg == 0.0
    assert first.force_y.phase_deg == pytest.approx(phase)


@pytest.mark.parametrize("angle", [90.0, 33.0, -120.0])
def test_a_turned_frame_turns_the_loads(angle: float) -> None:
    """Analytic: axes and cranks turned together turn the vector (x, y) of every order, phases as they were."""
    straight = loads(machine(throw(10.0, 70.0, rotating=3.0), throw(-40.0, 200.0, 0.8)))
    turned = loads(machine(throw(10.0 + angle, 70.0 + angle, rotating=3.0), throw(-40.0 + angle, 200.0 + angle, 0.8)))
    cos, sin = np.cos(np.deg2rad(angle)), np.sin(np.deg2rad(angle))
    for order in (1, 2, 4, 6):
        for x, y in (("force_x", "force_y"), ("couple_of_x_forces", "couple_of_y_forces")):
            was, now = straight[order], turned[order]
            assert now[x] == pytest.approx(cos * was[x] - sin * was[y], abs=1e-9)
            assert now[y] == pytest.approx(sin * was[x] + cos * was[y], abs=1e-9)


def test_loads_of_two_throws_add_up() -> None:
    """Analytic: superposition, both counted from the dead centre of the first."""
    first_throw, second_throw = throw(20.0, 0.0), throw(-50.0, 130.0, 0.9, 4.0)
    # a throw whose row weighs nothing keeps the dead centre
    still = json.loads(json.dumps(first_throw))
    still["rows"][0]["reciprocating_mass_kg"] = 0.0
    both, first, second = (
        loads(machine(*some)) for some in ((first_throw, second_throw), (first_throw,), (still, second_throw))
    )
    for order in (1, 2, 4, 6):
        for name in LOADS:
            assert both[order][name] == pytest.approx(first[order][name] + second[order][name], abs=1e-9)


def test_what_cancels_is_nothing() -> None:
    """Analytic: three throws 120 degrees apart leave no force of orders 1, 2 and 4."""
    document = loads(machine(*(throw(17.0, 17.0 + 120.0 * k, 0.7 * k - 0.7) for k in range(3))))
    assert [document[order][name] for order in (1, 2, 4) for name in ("force_x", "force_y")] == [0.0] * 6


def request(**rest: Any) -> dict[str, Any]:
    body = bodies()["2d12"]
    return {**body, "outputs": ["residual", "foundation_loads"], **rest}


def test_as_built_is_what_an_analysis_finds() -> None:
    """Independent: the same counterweights given to an analysis."""
    web = request()["machine"]["webs"][0]["name"]
    fitted = [{"web": web, "mass_kg": 20.0, "angle_deg": 170.0}]
    answer = optimize(OptimizeRequest.model_validate(request(fitted=fitted)))
    body = {"machine": request()["machine"], "counterweights": fitted, "outputs": ["foundation_loads"]}
    alone = analyze(AnalyzeRequest.model_validate(body))
    plain = optimize(OptimizeRequest.model_validate(request()))
    assert answer.foundation_loads is not None
    assert alone.foundation_loads is not None
    assert plain.foundation_loads is not None
    assert [foundation_load.as_built for foundation_load in answer.foundation_loads] == [
        foundation_load.after for foundation_load in alone.foundation_loads
    ]
    assert [foundation_load.after for foundation_load in answer.foundation_loads] == [
        foundation_load.after for foundation_load in plain.foundation_loads
    ]
    assert all(foundation_load.as_built is None for foundation_load in plain.foundation_loads)


def test_fitted_is_refused_at_its_field() -> None:
    for fitted in ([{"web": "none", "mass_kg": 1.0, "angle_deg": 0.0}],):
        with pytest.raises(ValidationError, match="no web of this name"):
            OptimizeRequest.model_validate(request(fitted=fitted))
    for orders in ([], [0], [7], [1, 1], [1.5]):
        with pytest.raises(ValidationError):
            OptimizeRequest.model_validate(request(foundation_orders=orders))


def test_fitted_beyond_an_envelope_is_refused() -> None:
    body = bodies()["plate-single"]
    plate = next(web["name"] for web in body["machine"]["webs"] if "envelope" in web)
    fitted = [{"web": plate, "mass_kg": 1e6, "angle_deg": 180.0}]
    with pytest.raises(OutOfRange) as refused:
        optimize(OptimizeRequest.model_validate({**body, "fitted": fitted}))
    assert refused.value.problems[0].path == ("fitted", 0, "mass_kg")
