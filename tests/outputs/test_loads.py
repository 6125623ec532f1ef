"""Loads as a designer of parts asks for them: the 2D12, whose figures are published, and what follows by hand."""

import json
from functools import cache
from typing import Any

import numpy as np
import pytest

from optimizer.analyze import analyze
from optimizer.mechanics.weight import GRAVITY, guides
from optimizer.optimize import optimize
from optimizer.studies.sweep.rows import rows
from optimizer.studies.sweep.table import result_schema, result_table
from schemas.answer.answers import AnalyzeAnswer
from schemas.answer.loads import Loads
from schemas.request.requests import AnalyzeRequest, OptimizeRequest
from schemas.sweep.request import SweepRequest
from service.documents.examples import load
from tests.pairs.asking import body_of
from tests.verification.checking import optimized


def answer(outputs: tuple[str, ...] = ("loads", "torque", "rod_loads"), **machine: Any) -> AnalyzeAnswer:
    posted = json.loads(load("2d12"))["machine"] | machine
    request = {"machine": posted, "outputs": list(outputs), "angles": {"step_deg": 5}}
    return analyze(AnalyzeRequest.model_validate(request))


def loads_of(analysis: AnalyzeAnswer) -> Loads:
    assert analysis.loads is not None
    return analysis.loads


@cache
def both() -> AnalyzeAnswer:
    """With weight, and without a change else."""
    return answer(gravity_deg=270)


def test_gas_forces_at_the_dead_centres_published() -> None:
    """Design calculation of the 2D12, 1.11: -239491.5 and -239937.4 N outside, 228681.6 N inside, with pi = 3.14."""
    rows = loads_of(both()).rows
    outer, inner = ([getattr(row, f"stop_at_{end}_dead_centre_N") for row in rows] for end in ("outer", "inner"))
    assert outer == pytest.approx([-239491.5, -239937.4], rel=6e-4)
    assert inner[0] == pytest.approx(228681.6, rel=6e-4)
    # over the turn the lean of the rod adds little, and nothing at the dead centre itself
    assert both().rod_loads is not None
    for row, loaded in zip(rows, both().rod_loads.rows, strict=True):
        stop = next(case for case in loaded.cases if case.case == "sudden_stop")
        assert row.stop_over_the_turn_N == max(stop.tension_N, -stop.compression_N)
        assert row.stop_over_the_turn_N >= abs(row.stop_at_outer_dead_centre_N) * (1.0 - 1e-9)


def test_masses_published() -> None:
    """303.60 and 277.53 kg; 0.7 of each rod turns, with 12 kg of the throw."""
    loads = loads_of(both())
    assert [row.reciprocating_mass_kg for row in loads.rows] == pytest.approx([303.60, 277.53], abs=5e-3)
    assert [row.rod_rotating_mass_kg for row in loads.rows] == pytest.approx([0.7 * 86.025] * 2)
    assert [throw.rotating_mass_kg for throw in loads.throws] == pytest.approx([12.0 + 0.7 * 86.025] * 2)
    assert sum(bearing_weight.weight_N for bearing_weight in loads.bearing_weights) == pytest.approx(
        2 * (12.0 + 0.7 * 86.025) * GRAVITY
    )


def test_piston_rod_covers_and_frame_analytic() -> None:
    for row in loads_of(both()).rows:
        largest = (row.largest_gas_N, row.largest_inertia_N, row.largest_piston_force_N)
        assert row.piston_rod_N == max(largest)
        assert row.piston_rod_governed_by == "gas"
        head, crank = row.covers
        # at the outer dead centre the head side has its largest pressure, and the crank side its smallest
        assert head.largest_N - crank.smallest_N == pytest.approx(-row.stop_at_outer_dead_centre_N)
        frame = row.frame
        assert frame.tension_N == pytest.approx(-row.stop_at_outer_dead_centre_N)
        assert frame.tension_N == pytest.approx(frame.mean_N + frame.amplitude_N)
        assert frame.compression_N == pytest.approx(frame.mean_N - frame.amplitude_N)


def test_base_and_turning_masses_analytic() -> None:
    """J eps = driver less torque; over a turn the speed comes back, and its range is the irregularity asked for."""
    loads = loads_of(answer(outputs=("loads", "torque", "flywheel")))
    whole = answer()
    assert whole.torque is not None
    np.testing.assert_allclose(loads.shared_base_Nm, np.array(whole.torque.torque_Nm) - whole.torque.mean_torque_Nm)
    assert loads.driver_Nm == whole.torque.mean_torque_Nm
    assert loads.own_base_peak_Nm == whole.torque.peak_Nm
    assert loads.angular_acceleration_rad_s2 is not None
    assert abs(np.mean(loads.angular_acceleration_rad_s2)) < 2e-2 * np.max(np.abs(loads.angular_acceleration_rad_s2))
    omega = 500.0 * np.pi / 30.0
    speed = np.cumsum(loads.angular_acceleration_rad_s2) * np.deg2rad(5.0) / omega
    assert np.ptp(speed) / omega == pytest.approx(0.01, rel=0.05)
    assert loads_of(answer(flywheel=None)).angular_acceleration_rad_s2 is None


def test_one_of_two_opposed_crossheads_lifts_published() -> None:
    """Lecture slides: in one of two opposed rows the side force points up. In a machine that turns the other way, in
    the other row.
    """
    shares = [row.guide.lifted_share for row in loads_of(both()).rows if row.guide]
    analysis = answer(gravity_deg=270, rotation="cw")
    reversed_ = [row.guide.lifted_share for row in loads_of(analysis).rows if row.guide]
    assert max(shares) > 0.5 > min(shares)
    assert np.argmax(shares) != np.argmax(reversed_)
    warned = [warning for warning in both().warnings if warning.code == "crosshead_lifts"]
    assert f"/machine/throws/{np.argmax(shares)}/rows/0" in [warning.pointer for warning in warned]
    # without gravity nothing is said of it
    silent = answer()
    assert all(row.guide is None for row in loads_of(silent).rows)
    assert "crosshead_lifts" not in [warning.code for warning in silent.warnings]


def test_guides_by_hand_analytic() -> None:
    """Axis along +x, turning counter-clockwise, weight down: tension draws the crosshead up towards the crank pin.

    Only over the first half of the turn is the pin above the axis; the side force has that sign in it already.
    """
    side = np.array([[-50.0, 0.0, 200.0]])
    axis, down = np.array([1.0 + 0j]), np.asarray(-1j)
    horizontal = guides(np.array([10.0]), axis, np.asarray(1.0), down)
    np.testing.assert_allclose(horizontal.weight, [98.0665])
    np.testing.assert_allclose(horizontal.load(side), [[148.0665, 98.0665, -101.9335]])
    # an upright row has no lower guide
    assert guides(np.array([10.0]), np.array([1j]), np.asarray(1.0), down).weight == 0.0


def test_without_gas_only_inertia_loads() -> None:
    posted = json.loads(load("2d12"))["machine"]
    for throw in posted["throws"]:
        throw["rows"][0]["cylinder"] = None
    loads = loads_of(answer(throws=posted["throws"], friction=None))
    for row in loads.rows:
        assert (row.covers, row.stop_at_outer_dead_centre_N, row.frame.amplitude_N) == ((), 0.0, 0.0)
        # analytic: m r omega^2 (1 + lambda) at the outer dead centre, which is a sample
        omega = 500.0 * np.pi / 30.0
        assert row.largest_inertia_N == pytest.approx(row.reciprocating_mass_kg * 0.14 * omega**2 * 1.2)
        assert row.piston_rod_governed_by in ("inertia", "running")


@pytest.mark.parametrize("gravity", [None, 123.0])
def test_what_is_cut_from_a_plate_weighs_on_the_bearings(gravity: float | None) -> None:
    """Analytic: the lever rule with the masses that the answer shows; a row of a sweep has the same."""
    body = body_of("twin", ("plates, segments",), 2.0)
    assert body is not None
    body = {**body, "machine": {**body["machine"], "gravity_deg": gravity}, "outputs": ["loads"]}
    optimum = optimized(body)
    assert optimum.loads is not None
    plain = OptimizeRequest.model_validate({**body, "machine": {**body["machine"], "webs": []}})
    bare = optimize(plain).loads
    assert bare is not None
    vectors, bare_vectors = (
        np.array(
            [
                complex(bearing_weight.x_N or 0.0, bearing_weight.y_N or 0.0) if gravity else bearing_weight.weight_N
                for bearing_weight in loads.bearing_weights
            ]
        )
        for loads in (optimum.loads, bare)
    )
    mass = sum(counterweight.mass_kg for counterweight in optimum.counterweights)
    assert mass > 0
    assert abs(np.sum(vectors - bare_vectors)) == pytest.approx(mass * GRAVITY, rel=1e-9)
    speeds = {"path": "/machine/speed_rpm", "values": [body["machine"]["speed_rpm"]] * 2}
    sweep = SweepRequest.model_validate({"base": body, "axes": [speeds]})
    (first, *_) = result_table(rows(sweep, 0, sweep.total), result_schema(sweep, b"{}")).to_pylist()
    for weight in optimum.loads.bearing_weights:
        assert first[f"bearing_weight_N.{weight.name}"] == pytest.approx(weight.weight_N, rel=1e-9)
