"""Four counterweights in place of eight on the crankshaft of an in-line four, as SAE 2008-01-0088 has it."""

from typing import Any

import pytest

from optimizer.analyze import analyze
from schemas.answer.answers import AnalyzeAnswer
from schemas.request.requests import AnalyzeRequest

#: kg m of a throw, m between bearings
ROTATING, PITCH = 1.1 * 0.045, 0.09


def _four() -> dict[str, Any]:
    """Four throws between five bearings, webs a quarter of the pitch from them; the figures are those of a car."""
    rod = {"length_m": 0.15, "mass_kg": 0.0}
    throws, webs = [], []
    for k, angle in enumerate((0.0, 180.0, 180.0, 0.0)):
        rows = [{"axis_deg": 0.0, "reciprocating_mass_kg": 0.6, "connecting_rod": rod}]
        place = {"position_m": k * PITCH, "crank_radius_m": 0.045, "crank_angle_deg": angle}
        throws.append({**place, "rotating_mass_kg": 1.1, "rows": rows})
        for side in (-0.25, 0.25):
            name = f"{2 * k + (side > 0) + 1}"
            webs.append({"name": name, "position_m": (k + side) * PITCH, "throw": k})
    webs = [{**web, "counterweight_radius_m": 0.05, "max_mass_kg": 5} for web in webs]
    bearings = [{"name": f"{k + 1}", "position_m": (k - 0.5) * PITCH} for k in range(5)]
    return {"kind": "reciprocating", "speed_rpm": 6000, "throws": throws, "webs": webs, "bearings": bearings}


def _fitted(rate: float, webs: tuple[int, ...]) -> AnalyzeAnswer:
    """Every throw balanced at this rate by those of its webs that are named, opposite its crank."""
    actual_rate = rate * ROTATING * 4 / len(webs) / 0.05
    opposite = {web: 180.0 if web in (1, 2, 7, 8) else 0.0 for web in webs}
    counterweights = [{"web": f"{web}", "mass_kg": actual_rate, "angle_deg": opposite[web]} for web in webs]
    body = {
        "machine": _four(),
        "counterweights": counterweights,
        "outputs": ["main_bearings"],
        "angles": {"step_deg": 10},
    }
    return analyze(AnalyzeRequest.model_validate(body))


def _worst(answer: AnalyzeAnswer) -> float:
    assert answer.main_bearings is not None
    return max(bearing.after.peak_N for bearing in answer.main_bearings.bearings if bearing.after is not None)


def test_four_counterweights_at_a_lower_rate_load_the_bearings_like_eight() -> None:
    """Published (abstract): balance rates of the bays 80.3 % with eight, 56.6 % with four, bearing loads alike.

    Analytic: beside the bearing that they relieve, three quarters of four count where half of eight do, and
    0.566 * 3/4 is 0.4245 of the rotating mass, 0.803 / 2 is 0.4015.
    """
    bare, eight, four = (
        _fitted(0.0, tuple(range(1, 9))),
        _fitted(0.803, tuple(range(1, 9))),
        _fitted(0.566, (1, 4, 5, 8)),
    )
    assert [rate.rate for rate in eight.balance_rate] == pytest.approx([0.803] * 4)
    assert [rate.rate for rate in four.balance_rate] == pytest.approx([0.566] * 4)
    assert _worst(four) == pytest.approx(_worst(eight), rel=0.06)
    assert _worst(eight) < 0.75 * _worst(bare)
    # the lighter by 29.5 %; the engine of the paper by 1.42 kg
    assert four.total_mass_kg == pytest.approx(0.566 / 0.803 * eight.total_mass_kg, rel=1e-12)
