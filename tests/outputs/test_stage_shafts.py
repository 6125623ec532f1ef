"""What the eight stages say is left where balance shafts stand beside the counterweights."""

from typing import Any

import numpy as np
import pytest

from optimizer.analyze import analyze
from optimizer.outputs.registry import prepare
from optimizer.outputs.stages import amounts
from schemas.answer.outputs import Stage
from schemas.request.requests import AnalyzeRequest
from tests.optimize.machines import throw, web
from tests.optimize.shafts import WHOLE, in_line_four, shaft, single
from tests.verification.checking import optimized


def _by_number(stages: Any) -> dict[str, Stage]:
    return {stage.stage: stage for stage in stages}


def _optimum(body: dict[str, Any], **objective: Any) -> Any:
    return optimized({"machine": body, "objective": objective, "outputs": ["stages"]})


def test_a_shaft_backwards_takes_the_circle_that_counterweights_leave_published() -> None:
    # Lanchester: half of the reciprocating mass on either shaft cancels the first order, and no more
    answer = _optimum(single([shaft("back", -1, radius=0.05)]))
    stages = _by_number(answer.stages)
    assert stages["III"].value == pytest.approx(WHOLE)
    assert stages["III"].remaining <= 2e-6 * WHOLE
    assert stages["V"].remaining == stages["V"].value
    assert stages["VIII"].remaining == pytest.approx(stages["V"].value, rel=1e-5)
    assert stages["VIII"].plane.startswith("second-order force")
    # what turns backwards is not iron that is missing on the crankshaft
    assert stages["VII"].remaining == pytest.approx(0.0, abs=2e-6 * stages["VII"].value)


def test_shafts_at_twice_the_speed_take_the_second_order_published() -> None:
    # Lanchester: two shafts that turn against each other, of an in-line four
    answer = _optimum(in_line_four([shaft("with", 2, 0.18), shaft("against", -2, 0.18)]), orders="all")
    stages = _by_number(answer.stages)
    assert stages["V"].value > 0.0
    assert stages["V"].remaining <= 0.02 * stages["V"].value
    (force, *_) = stages["V"].left
    assert force.peak == pytest.approx(stages["V"].remaining)


@pytest.mark.parametrize("ratio", [-2, -1, 1, 2])
@pytest.mark.parametrize("rotation", ["ccw", "cw"])
def test_stages_add_up_to_the_orders_and_sweeps_have_the_same(ratio: int, rotation: str) -> None:
    """Independent: the first two orders of the machine with what is on it, which no stage is part of."""
    row = {"axis_deg": 50.0, "reciprocating_mass_kg": 12.0, "connecting_rod": {"length_m": 0.35}}
    body = single([shaft("one", ratio, 0.3)]) | {
        "throws": [throw(0.0, 20.0, [row], rotating=3.0), throw(0.4, 150.0, [], rotating=1.0)],
        "webs": [web("a", -0.1, 4.0), web("b", 0.6, 2.0)],
        "rotation": rotation,
    }
    weights = [{"web": "a", "mass_kg": 2.0, "angle_deg": 210.0}, {"web": "one web", "mass_kg": 1.5, "angle_deg": 70.0}]
    payload = {"machine": body, "counterweights": weights, "outputs": ["stages", "orders", "residual"]}
    request = AnalyzeRequest.model_validate(payload)
    answer = analyze(request)
    stages, after = _by_number(answer.stages), answer.residual.orders.after
    assert stages["VIII"].remaining == pytest.approx(after[0].force.peak_N + after[1].force.peak_N, rel=1e-12)
    assert stages["V"].remaining == pytest.approx(after[1].force.peak_N, rel=1e-12)
    assert stages["VI"].remaining == pytest.approx(after[1].moment.peak_Nm, rel=1e-12)
    summed = {(part.quantity, part.order): part.peak for part in stages["VIII"].left}
    assert summed["moment", 1] == pytest.approx(after[0].moment.peak_Nm, rel=1e-12)
    scene = prepare(request, request.outputs)
    turning, first, second = (
        scene.results[name] for name in ("rotating_inertia", "reciprocating_inertia", "second_order")
    )
    radii = [place["counterweight_radius_m"] for place in (*body["webs"], *body["balance_shafts"][0]["webs"])]
    vectors = np.array([2.0, 0.0, 1.5]) * radii * np.exp(1j * np.deg2rad([210.0, 0.0, 70.0]))
    sizes = amounts(scene.layout, turning, first, second, vectors[:2], vectors[2:])
    np.testing.assert_allclose(sizes, [stages[name].remaining for name in stages], rtol=1e-9, atol=1e-9 * WHOLE)


def test_what_shafts_carry_without_shafts_is_refused() -> None:
    request = AnalyzeRequest.model_validate({"machine": single([]), "outputs": ["stages"]})
    scene = prepare(request, request.outputs)
    parts = [scene.results[name] for name in ("rotating_inertia", "reciprocating_inertia", "second_order")]
    with pytest.raises(ValueError, match="the machine has none"):
        amounts(scene.layout, *parts, np.zeros(1, complex), np.ones(1, complex))
