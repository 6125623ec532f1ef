"""Every example can be posted as it stands, says what is assumed, and balances as the textbooks say."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from jsonschema import Draft202012Validator

from optimizer.mechanics.inertia import Wrench, first_order_responses, reciprocating, rotating
from optimizer.mechanics.layout import Layout, layout
from optimizer.mechanics.slider_crank import acceleration_harmonic
from optimizer.optimize import optimize
from optimizer.studies.sweep.whole import sweep_table
from schemas.machine.reciprocating import ReciprocatingMachine
from schemas.request.requests import OptimizeRequest
from schemas.sweep.request import SweepRequest

FILES = sorted((Path(__file__).parents[2] / "examples").glob("*.json"))
NAMES = [file.stem for file in FILES]
EXPECTED = {
    "2d12", "forked-rod", "inline-four-engine", "inline-six", "m-type-four", "opposed-pair", "opposed-triple",
    "scroll-oldham", "scroll-three-pins", "single-horizontal", "single-vertical", "six-columns", "two-rows-180",
    "two-rows-90", "v60", "v8-cross-plane", "v90-equal", "v90-unequal", "w60",
}  # fmt: skip


def request_of(name: str) -> OptimizeRequest:
    return OptimizeRequest.model_validate_json(FILES[NAMES.index(name)].read_text())


def arrays_of(name: str) -> Layout:
    return layout(request_of(name).machine)


def first(arrays: Layout) -> Wrench:
    return rotating(arrays).plus(reciprocating(arrays, 1))


def test_all_examples_are_there() -> None:
    assert set(NAMES) >= EXPECTED


@pytest.mark.parametrize("file", FILES, ids=NAMES)
def test_an_example_is_a_valid_body(file: Path) -> None:
    body: dict[str, Any] = json.loads(file.read_text())
    OptimizeRequest.model_validate(body)
    errors = list(Draft202012Validator(OptimizeRequest.model_json_schema()).iter_errors(body))
    assert errors == []


@pytest.mark.parametrize("name", NAMES)
def test_an_example_says_what_it_is_and_what_is_assumed(name: str) -> None:
    machine = request_of(name).machine
    assert machine.name
    assert machine.description is not None
    assert "ssumed" in machine.description
    assert name.replace("-", "").isalnum()
    assert name == name.lower()


def test_names_are_unique() -> None:
    assert len({request_of(name).machine.name for name in NAMES}) == len(NAMES)


@pytest.mark.parametrize("name", NAMES)
def test_an_example_has_webs_and_rods_for_every_output(name: str) -> None:
    arrays = arrays_of(name)
    assert arrays.webs.position.size >= 2
    assert np.ptp(arrays.webs.position) > 0
    for order in (1, 2, 4, 6):
        assert np.isfinite(reciprocating(arrays, order).moment.peak)


def features() -> set[str]:
    names = set()
    for name in NAMES:
        request = request_of(name)
        machine, objective = request.machine, request.objective
        names |= {machine.kind, machine.rotation, objective.combine}
        names |= {"sector"} if any(web.sector for web in machine.webs) else set()
        names |= {"budget"} if machine.max_total_mass_kg is not None else set()
        names |= {"ceiling"} if objective.moment_ceiling_Nm is not None else set()
        names |= {"directions"} if objective.direction_weights.x != objective.direction_weights.y else set()
        names |= {"unit"} if '"140 mm"' in FILES[NAMES.index(name)].read_text() else set()
        if isinstance(machine, ReciprocatingMachine):
            rows = [row for throw in machine.throws for row in throw.rows]
            cylinders = [row.cylinder for row in rows if row.cylinder]
            names |= {"gas"} if cylinders else set()
            names |= {"indicated"} if any(cylinder.pressure for cylinder in cylinders) else set()
            names |= {"offset"} if any(row.offset_m for row in rows) else set()
    return names


def test_the_examples_show_what_the_service_can_do() -> None:
    texts = {"reciprocating", "scroll", "ccw", "cw", "sum", "max", "sector", "budget", "ceiling", "directions"}
    assert features() >= texts | {"unit", "gas", "indicated", "offset"}


@pytest.mark.parametrize("name", ["six-columns", "opposed-triple", "forked-rod", "inline-six"])
def test_what_balances_itself_is_exactly_zero_analytic(name: str) -> None:
    arrays = arrays_of(name)
    for wrench in (rotating(arrays), reciprocating(arrays, 1), reciprocating(arrays, 2)):
        assert (wrench.force.peak, wrench.moment.peak) == (0.0, 0.0)


@pytest.mark.parametrize("name", ["v90-equal", "w60", "v8-cross-plane", "scroll-three-pins"])
def test_complete_balance_is_possible_analytic(name: str) -> None:
    """Nothing of the first order turns against the shaft."""
    force, moment = first(arrays_of(name))
    assert (abs(force.counter), abs(moment.counter)) == (0.0, 0.0)
    assert force.peak + moment.peak > 0


@pytest.mark.parametrize("name", ["opposed-pair", "two-rows-180", "m-type-four", "v8-cross-plane"])
def test_forces_that_cancel_analytic(name: str) -> None:
    force, moment = first(arrays_of(name))
    assert force.peak == 0.0
    assert moment.peak > 0


@pytest.mark.parametrize(
    ("name", "force", "moment"),
    [
        pytest.param("opposed-pair", 0.0, 1.0, id="analytic-opposed-pair"),
        pytest.param("two-rows-180", 1.0, 0.0, id="analytic-two-rows-180"),
        pytest.param("two-rows-90", 0.0, 1.0, id="published-two-rows-90"),
        pytest.param("m-type-four", 0.0, 0.0, id="analytic-m-type-four"),
        pytest.param("v8-cross-plane", 0.0, 0.0, id="published-v8-cross-plane"),
        pytest.param("v90-equal", 1.0, 0.0, id="analytic-v90-equal"),
    ],
)
def test_second_order(name: str, force: float, moment: float) -> None:
    """Which second-order terms are left: 1 for some, 0 for none at all."""
    wrench = reciprocating(arrays_of(name), 2)
    assert (wrench.force.peak > 0, wrench.moment.peak > 0) == (bool(force), bool(moment))


def test_unequal_v_keeps_half_the_difference_analytic() -> None:
    """Seed 002 case 2: (m1 - m2)/2 turns against the shaft."""
    force, _ = first(arrays_of("v90-unequal"))
    assert abs(force.counter) == pytest.approx(0.5 * (16.5 - 11.0) * 0.07)


def test_v60_keeps_half_analytic() -> None:
    """cos 60 of m r turns against the shaft, m r with it (rod: a third of 4.5 kg)."""
    arrays = arrays_of("v60")
    force = reciprocating(arrays, 1).force
    assert abs(force.co) == pytest.approx(11.5 * 0.06)
    assert abs(force.counter) == pytest.approx(0.5 * 11.5 * 0.06)
    assert arrays.sense == -1.0


def test_oldham_keeps_half_its_ring_analytic() -> None:
    force, _ = first(arrays_of("scroll-oldham"))
    assert abs(force.counter) == pytest.approx(0.5 * 0.12 * 0.005)


@pytest.mark.parametrize("name", ["v90-equal", "w60", "scroll-three-pins"])
def test_the_iron_is_enough_for_complete_balance(name: str) -> None:
    """Two planes take all of it within their limits."""
    machine, arrays = request_of(name).machine, arrays_of(name)
    responses = first_order_responses(arrays, first(arrays))
    unbalance = np.linalg.solve(
        np.array([r.influence for r in responses], dtype=complex), -np.array([r.baseline.co for r in responses])
    )
    limits = [web.max_mass_kg * web.counterweight_radius_m for web in machine.webs]
    assert np.all(np.abs(unbalance) <= limits)


def test_the_2d12_has_the_masses_of_its_source_published() -> None:
    """Seed 004: 303.60 and 277.53 kg reciprocate, 26.07 kg make the force."""
    arrays = arrays_of("2d12")
    np.testing.assert_allclose(arrays.reciprocating.mass, [303.60, 277.53], atol=0.006)
    assert reciprocating(arrays, 1).force.peak == pytest.approx(26.07 * 0.14)
    np.testing.assert_allclose(arrays.reciprocating.rod_ratio, 0.2)


def test_balance_shafts_take_what_counterweights_leave() -> None:
    single = optimize(request_of("single-balance-shaft"))
    # analytic: of reciprocating masses counterweights alone leave half; 0.9 kg and a third of the rod at 45 mm
    half = 0.5 * 1.2 * 0.045 * (1500.0 * np.pi / 30.0) ** 2
    assert single.residual.after is not None
    assert single.residual.after.force.peak_N <= 1e-5 * half
    assert single.balance_shafts_mass_kg == pytest.approx(0.5 * 1.2 * 0.045 / 0.03, rel=1e-5)
    four = optimize(request_of("lanchester-four"))
    assert four.certificate is not None
    # analytic: m r A_2 / 2 on each shaft of 20 mm, up to what the fourth order asks for besides
    second = acceleration_harmonic(2, np.asarray(0.3))
    assert four.balance_shafts_mass_kg == pytest.approx(2 * 0.5 * 0.7 * 0.045 * second / 0.02, rel=2e-3)
    assert four.certificate.objective < 0.03 * four.certificate.objective_without_counterweights


def test_a_twin_from_a_catalogue() -> None:
    body = json.loads(FILES[NAMES.index("catalogue-twin")].read_text())
    answer = optimize(OptimizeRequest.model_validate(body))
    assert answer.status_reason.startswith("Proven optimal: of all sets")
    masses = [counterweight.mass_kg for counterweight in answer.counterweights]
    assert set(masses) <= {0.0, *body["machine"]["catalogue"]["masses_kg"]}
    assert len(set(masses) - {0.0}) <= 2
    # the web at the drive end has holes of its own
    assert answer.counterweights[-1].angle_deg in (0.0, *body["machine"]["webs"][-1]["hole_angles_deg"])


def test_a_row_with_plates_keeps_half_of_what_reciprocates_analytic() -> None:
    answer = optimize(request_of("plate-single"))
    assert answer.residual.after is not None
    half = 0.5 * 4.0 * 0.06 * (1000.0 * np.pi / 30.0) ** 2
    assert answer.residual.after.force.peak_N == pytest.approx(half, rel=1e-5)
    assert [counterweight.shape is not None for counterweight in answer.counterweights] == [True, True]


def test_crank_orders_of_an_eight() -> None:
    """Published: three of the 183 orders leave no moment of order 1 or 2; with counterweights four are on the front."""
    body = json.loads((Path(__file__).parents[2] / "examples/sweeps/inline-eight-crank-orders.json").read_text())
    del body["pareto"]
    table = sweep_table(SweepRequest.model_validate(body))
    assert table.num_rows == 183
    assert set(table["status"].to_pylist()) == {"optimal"}
    # m r A_2 and the pitch: what the second order leaves is told apart at a thousandth of it
    size = 1e-3 * 43.0 * 0.13 * (750.0 * np.pi / 30.0) ** 2 * 0.4 / 4.0
    second = np.array(table["moment_peak_Nm.order_2"].to_pylist())
    bare = [mass < 1e-9 for mass in table["total_mass_kg"].to_pylist()]
    assert int(np.sum((second < size) & bare)) == 3
