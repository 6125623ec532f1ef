"""Engines with indicated pressures: half orders, both turns, work, firing orders, bearings, and what the ideal says."""

import copy
from itertools import permutations
from typing import Any

import numpy as np
import pytest

from optimizer.errors import MissingInput
from optimizer.mechanics.gas import gas_forces, switching_angles
from optimizer.mechanics.kinematics import motion, own_angle
from optimizer.numerics.arrays import Complex, Real
from schemas.answer.answers import AnalyzeAnswer
from tests.analyze.driven import arrays, ask, random_driven
from tests.analyze.engines import FOUR, RADIUS, cylinder, engine, trace

LOADS = ("piston_force", "rod_loads", "torque", "overturning", "main_bearings")


def order(values: Real, multiple: float) -> complex:
    """Complex coefficient of e^{j k theta} in samples over 720 degrees."""
    angle = 2.0 * np.linspace(0.0, 2.0 * np.pi, values.size, endpoint=False)
    return complex(np.mean(values * np.exp(-1j * multiple * angle)))


def coefficient(angle: Real, pressure: Real, multiple: float) -> complex:
    """Closed form of the same for a curve that is linear between its entries (the second derivative is impulses)."""
    slope = np.diff(np.append(pressure, pressure[0])) / np.diff(np.append(angle, angle[0] + 4.0 * np.pi))
    jumps = slope - np.roll(slope, 1)
    return complex(-np.sum(jumps * np.exp(-1j * multiple * angle)) / (4.0 * np.pi * multiple**2))


def test_half_orders_of_a_known_trace() -> None:
    # analytic: with an infinite rod the torque is -p A r sin theta, so its order k holds p of the orders k -+ 1
    record = {"angle_deg": [0.0, 10.0, 35.0, 150.0, 500.0, 700.0], "pressure_Pa": [4e6, 8e6, 2e6, 1e5, 2e5, 3e6]}
    body = engine([90.0], [cylinder(record, dead_centre_deg=450.0)])
    body["throws"][0]["rows"][0] |= {"reciprocating_mass_kg": 0.0, "connecting_rod": {"length_m": None}}
    body["throws"][0]["rows"][0]["cylinder"]["ambient_pressure_Pa"] = 0.0
    torque = ask(body, "torque", step_deg=0.1).torque
    assert torque is not None
    assert len(torque.torque_Nm) == 7200
    assert torque.angle_deg[-1] == pytest.approx(719.9)
    start, area = np.deg2rad(450.0), 0.25 * np.pi * 0.1**2
    entries, pressure = np.deg2rad(record["angle_deg"]) + start, np.array(record["pressure_Pa"])
    for k in (0.5, 1.5, 2.5, 4.5):
        # about its own dead centre sin(theta - start) = (e^{j(theta - start)} - conj) / 2j
        below, above = (coefficient(entries, pressure, k + off) for off in (-1.0, 1.0))
        expected = -area * RADIUS * (below * np.exp(-1j * start) - above * np.exp(1j * start)) / 2j
        # but for the aliases of the samples
        assert order(np.array(torque.torque_Nm), k) == pytest.approx(expected, abs=2e-7 * torque.peak_Nm)
    assert abs(order(np.array(torque.torque_Nm), 0.5)) > 10.0


def test_an_even_engine_has_no_half_orders() -> None:
    # analytic: four cylinders that fire evenly repeat every half turn
    torque = ask(engine(FOUR), "torque", step_deg=1.0).torque
    assert torque is not None
    values = np.array(torque.torque_Nm)
    for k in (0.5, 1.0, 1.5, 2.5, 3.0):
        assert abs(order(values, k)) < 1e-9 * abs(order(values, 2.0))


def halves() -> tuple[dict[str, Any], dict[str, Any]]:
    """A machine with traces of one turn, and the same with two equal halves of a cycle of two turns."""
    once = trace(7.5, 1)
    twice = {
        "angle_deg": [*once["angle_deg"], *(360.0 + angle for angle in once["angle_deg"][1:])],
        "pressure_Pa": [*once["pressure_Pa"], *once["pressure_Pa"][1:]],
    }
    first, second = ([cylinder(fields, turns) for _ in range(2)] for fields, turns in ((once, 1), (twice, 2)))
    return engine([0.0, 200.0], first), engine([0.0, 200.0], second)


def test_a_cycle_of_one_turn_is_two_equal_halves_of_two() -> None:
    # analytic
    answer, two = (ask(body, "gas", *LOADS, "flywheel", step_deg=10.0) for body in halves())
    assert answer.torque is not None
    assert two.torque is not None
    assert len(two.torque.torque_Nm) == 72
    for half in (two.torque.torque_Nm[:36], two.torque.torque_Nm[36:]):
        np.testing.assert_allclose(half, answer.torque.torque_Nm, rtol=1e-9, atol=1e-9)
    assert_alike(answer, two)


def assert_alike(answer: AnalyzeAnswer, two: AnalyzeAnswer, rel: float = 1e-8) -> None:
    """What both come to over the turn, whatever the samples."""
    assert summary(two) == pytest.approx(summary(answer), rel=rel, abs=1e-9)


def summary(answer: AnalyzeAnswer) -> dict[str, float]:
    assert answer.gas is not None
    assert answer.torque is not None
    assert answer.flywheel is not None
    assert answer.piston_force is not None
    assert answer.rod_loads is not None
    assert answer.overturning is not None
    assert answer.main_bearings is not None
    fields = {
        "power": answer.gas.indicated_power_W,
        "energy": answer.torque.fluctuation_energy_J,
        "mean": answer.torque.mean_torque_Nm,
        "torque": answer.torque.peak_Nm,
        "inertia": answer.flywheel.inertia_J_kg_m2,
        "rod": answer.rod_loads.governing_load_N,
        "couple": answer.overturning.peak_Nm,
        "bending": answer.main_bearings.bending.peak_Nm,
        "bending floor": answer.main_bearings.bending.floor_Nm,
    }
    for k, row in enumerate(answer.piston_force.rows):
        fields |= {f"push {k}": row.peak_compression_N, f"pull {k}": row.peak_tension_N}
    for bearing in answer.main_bearings.bearings:
        fields |= {
            f"peak {bearing.name}": bearing.before.peak_N,
            f"rms {bearing.name}": bearing.before.rms_N,
            f"floor {bearing.name}": bearing.before.floor_N,
        }
    return fields


def cycle_as_trace(body: dict[str, Any], step_deg: float) -> dict[str, Any]:
    """The ideal cycles of a machine as traces, with entries where its valves open."""
    plan, data = arrays(body)
    ahead, opens = own_angle(plan, np.zeros(1))[:, 0], switching_angles(data, plan)
    machine = copy.deepcopy(body)
    for k, row in enumerate(row for throw in machine["throws"] for row in throw["rows"]):
        row["cylinder"]["pressure"] = {}
        for side, name in enumerate(("head", "crank")):
            even = np.deg2rad(np.arange(0.0, 360.0 + 0.5 * step_deg, step_deg))
            own = np.unique([*even, *(values[k, side] for values in opens if data.closed[k, side])])
            pressure = gas_forces(data, motion(plan, own - ahead[k]), plan).pressure[k, side]
            row["cylinder"]["pressure"][name] = {
                "angle_deg": np.rad2deg(own).tolist(),
                "pressure_Pa": pressure.tolist(),
            }
    return machine


def test_a_trace_that_samples_a_cycle_gives_what_the_cycle_gives() -> None:
    # independent: the closed forms of the four processes
    body = random_driven(3, "v", throws=2)
    exact = summary(ask(body, "gas", *LOADS, "flywheel"))
    off = []
    for step in (2.0, 0.5):
        actual_summary = summary(ask(cycle_as_trace(body, step), "gas", *LOADS, "flywheel"))
        off.append(max(abs(actual_summary[name] - figure) / abs(figure) for name, figure in exact.items() if figure))
    # linear between the entries: the error falls with the square of the step
    assert off[1] < 2e-4
    assert off[1] < 0.2 * off[0]


def vectors(answer: AnalyzeAnswer) -> Complex:
    assert answer.main_bearings is not None
    return np.array(
        [np.array(b.before.force_x_N) + 1j * np.array(b.before.force_y_N) for b in answer.main_bearings.bearings]
    )


@pytest.mark.parametrize("rotation", ["ccw", "cw"])
@pytest.mark.parametrize("shaft", ["simple_spans", "continuous"])
def test_bearings_carry_what_rods_and_throws_put_on_the_shaft_in_both_turns(rotation: str, shaft: str) -> None:
    body = engine(FOUR, rotation=rotation)
    answer = ask(body, "rod_loads", "main_bearings", step_deg=5.0, fidelity={"shaft": shaft})
    assert answer.rod_loads is not None
    sense = 1.0 if rotation == "ccw" else -1.0
    turned = sense * np.deg2rad(np.arange(0.0, 720.0, 5.0))
    omega = body["speed_rpm"] * np.pi / 30.0
    external, couple = np.zeros(144, complex), np.zeros(144, complex)
    for throw, row in zip(body["throws"], answer.rod_loads.rows, strict=True):
        out = np.exp(1j * (turned + np.deg2rad(throw["crank_angle_deg"])))
        # a rod in tension pulls outward along the crank, and against the rotation
        pulled = (np.array(row.radial_N) - 1j * sense * np.array(row.tangential_N)) * out
        rod = throw["rows"][0]["connecting_rod"]
        whirled = (throw["rotating_mass_kg"] + rod["mass_kg"] * 2.0 / 3.0) * RADIUS * omega**2 * out
        external += pulled + whirled
        couple += throw["position_m"] * (pulled + whirled)
    carried = vectors(answer)
    places = np.array([bearing["position_m"] for bearing in body["bearings"]])
    # analytic: force and couple are in balance at every instant
    np.testing.assert_allclose(carried.sum(axis=0), external, atol=1e-10 * np.max(np.abs(external)))
    np.testing.assert_allclose(places @ carried, couple, atol=1e-10 * np.max(np.abs(external)))


def test_brackets_hold_the_samples_of_both_turns() -> None:
    # independent: the sampled outputs, at a step that meets no entry but the dead centres
    body = engine([0.0, 240.0, 480.0], [cylinder(trace(11.25)) for _ in range(3)])
    answer = ask(body, *LOADS, step_deg=0.1)
    assert answer.torque is not None
    assert answer.main_bearings is not None
    low, high = answer.torque.peak_bracket_Nm
    assert np.max(np.abs(answer.torque.torque_Nm)) <= high <= low * (1.0 + 1e-8)
    assert np.max(np.abs(answer.torque.torque_Nm)) == pytest.approx(low, rel=1e-3)
    for bearing, load in zip(answer.main_bearings.bearings, vectors(answer), strict=True):
        low, high = bearing.before.peak_bracket_N
        assert np.max(np.abs(load)) <= high <= low * (1.0 + 1e-8)
        assert np.max(np.abs(load)) == pytest.approx(low, rel=1e-3)
        assert bearing.before.rms_N == pytest.approx(float(np.sqrt(np.mean(np.abs(load) ** 2))), rel=1e-5)
        at = int(np.argmax(np.abs(load))) * 0.1
        assert bearing.before.peak_angle_deg == pytest.approx(at, abs=0.2)


def test_energy_is_in_balance_and_efficiency_takes_from_what_an_engine_gives() -> None:
    fields = {"mechanical_efficiency": 0.85, "reciprocating_share": 0.6}
    answer = ask(engine(FOUR, friction=fields), "gas", "torque")
    assert answer.gas is not None
    assert answer.torque is not None
    torque = answer.torque
    assert answer.gas.indicated_power_W < 0.0
    # analytic: an engine gives its efficiency's share of the indicated power to the shaft
    assert torque.shaft_power_W == pytest.approx(0.85 * answer.gas.indicated_power_W, rel=1e-10)
    assert torque.friction_power_W == pytest.approx(-0.15 * answer.gas.indicated_power_W, rel=1e-10)
    assert torque.mean_torque_error_Nm < 1e-6 * abs(torque.mean_torque_Nm)


def test_a_turn_later_is_the_other_half() -> None:
    # analytic: every cylinder fires a turn later
    answer, two = (
        ask(engine([f + off for f in FOUR]), *LOADS, "gas", "flywheel", step_deg=5.0) for off in (0.0, 360.0)
    )
    np.testing.assert_allclose(np.roll(vectors(two), -72, axis=-1), vectors(answer), atol=1e-6)
    assert_alike(answer, two)


def test_firing_orders_of_an_in_line_four() -> None:
    """Cylinders on the same cranks may fire a turn apart: torque stays, bearing loads are exchanged or mirrored."""
    answers = {}
    for inner in permutations((180.0, 540.0)):
        for outer in permutations((0.0, 360.0)):
            firing = [outer[0], inner[0], inner[1], outer[1]]
            answer = ask(engine(firing), *LOADS, "gas", "flywheel", step_deg=5.0)
            answers[tuple(firing)] = answer
    base = answers[0.0, 180.0, 540.0, 360.0]
    assert base.torque is not None
    for analysis in answers.values():
        assert analysis.torque is not None
        # analytic: equal cylinders, whichever fires
        np.testing.assert_allclose(analysis.torque.torque_Nm, base.torque.torque_Nm, atol=1e-8)
    # analytic: the mirror image in z of 1-2-4-3 fires a turn apart as 1-3-4-2 does
    mirrored = answers[360.0, 540.0, 180.0, 0.0]
    np.testing.assert_allclose(vectors(mirrored)[::-1], vectors(base), atol=1e-6)
    # and the two firing orders of a four are each other's mirror image
    peaks = [
        sorted(b.before.peak_N for b in analyze_answer.main_bearings.bearings)
        for analyze_answer in answers.values()
        if analyze_answer.main_bearings is not None
    ]
    np.testing.assert_allclose(peaks, [peaks[0]] * 4, rtol=1e-8)


def test_cycles_of_one_turn_beside_those_of_two() -> None:
    """A compressor on the shaft of an engine: all takes two turns, its own cylinder repeats."""
    body = engine([0.0, 200.0, 90.0])
    ideal = {
        "bore_m": 0.2, "piston_rod_diameter_m": 0.03, "suction_pressure_Pa": 1e5, "discharge_pressure_Pa": 4e5,
        "relative_clearance": 0.1, "expansion_exponent": 1.2, "compression_exponent": 1.3,
    }  # fmt: skip
    body["throws"][2]["rows"][0]["cylinder"] = ideal
    body["throws"][1]["rows"][0]["cylinder"] = None
    answer = ask(body, "piston_force", "rod_loads", "torque", "overturning", "main_bearings", step_deg=5.0)
    assert answer.piston_force is not None
    assert answer.torque is not None
    fired, none, compressor = (np.array(row.gas_N) for row in answer.piston_force.rows)
    assert fired.size == 144
    assert np.max(np.abs(fired[:72] - fired[72:])) > 1e4
    np.testing.assert_array_equal(none, 0.0)
    np.testing.assert_allclose(compressor[:72], compressor[72:], rtol=1e-9, atol=1e-6)
    # independent: the compressor alone over one turn
    body["throws"][0]["rows"][0]["cylinder"] = None
    alone = ask(body, "piston_force", "torque", step_deg=5.0)
    assert alone.piston_force is not None
    assert len(alone.piston_force.rows[2].gas_N) == 72
    np.testing.assert_allclose(alone.piston_force.rows[2].gas_N, compressor[:72], rtol=1e-9)
    assert answer.torque.shaft_power_W == pytest.approx(answer.torque.indicated_power_W, rel=1e-9)


def test_outputs_without_gas_stay_with_one_turn() -> None:
    answer = ask(engine(FOUR), "hodograph", "kinematics", step_deg=10.0)
    assert answer.hodograph is not None
    assert answer.kinematics is not None
    assert len(answer.hodograph.angle_deg) == len(answer.kinematics.angle_deg) == 36
    both = ask(engine(FOUR), "hodograph", "torque", step_deg=10.0)
    assert both.torque is not None
    assert both.hodograph == answer.hodograph
    assert len(both.torque.angle_deg) == 72


def omissions(body: dict[str, Any], *outputs: str) -> dict[str, str]:
    """What a machine lacks, by field."""
    with pytest.raises(MissingInput) as caught:
        ask(body, *outputs)
    return {"/".join(map(str, path)): message for path, message in caught.value.problems}


def test_only_what_the_sides_without_a_pressure_need_is_asked_for() -> None:
    body = engine([0.0])
    actual_cylinder = body["throws"][0]["rows"][0]["cylinder"]
    at = "machine/throws/0/rows/0/cylinder"
    for field in ("ambient_pressure_Pa", "bore_m"):
        without = copy.deepcopy(body)
        del without["throws"][0]["rows"][0]["cylinder"][field]
        assert list(omissions(without, "gas")) in ([f"{at}/{field}"], [f"{at}/{field}", f"{at}/crank_area_m2"])
    # no piston rod is none of a trunk piston
    trunk = copy.deepcopy(body)
    del trunk["throws"][0]["rows"][0]["cylinder"]["piston_rod_diameter_m"]
    assert ask(trunk, "gas").gas == ask(body, "gas").gas
    # a pressure on the open side needs no ambient one
    actual_cylinder["pressure"]["crank"] = {"angle_deg": [0, 200, 400, 720], "pressure_Pa": [1.1e5, 1e5, 1.2e5, 1.1e5]}
    del actual_cylinder["ambient_pressure_Pa"]
    ask(body, "gas")
    # and a side that acts without one needs a cycle
    del actual_cylinder["pressure"]["crank"]
    actual_cylinder["acting"] = "double"
    text = omissions(body, "gas")
    assert len(text) == 5
    assert "on the crank side, which has no indicated pressure" in text[f"{at}/relative_clearance"]


def test_more_entries_than_can_be_worked_on_are_refused() -> None:
    firing = [0.01 * k for k in range(40)]
    fine = trace(1.0)
    body = engine(firing, [cylinder(fine, dead_centre_deg=angle) for angle in firing])
    assert "at most 200000" in omissions(body, "gas")["machine/throws/0/rows/0/cylinder/pressure"]
    # the same entries on all rows are as many as on one
    ask(engine([0.0] * 40, [cylinder(fine) for _ in firing]), "gas", step_deg=30.0)
