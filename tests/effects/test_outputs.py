"""An output costs its own effects, needs their inputs, and never changes another."""

import math
from dataclasses import replace
from typing import Any

import pytest

from optimizer.effects import registry
from optimizer.effects.effect import Context
from optimizer.effects.registry import EFFECTS, closure, effects_of
from optimizer.errors import MissingInput
from optimizer.outputs.registry import MAX_SAMPLES, OUTPUTS
from schemas.machine.reciprocating import ReciprocatingMachine
from tests.analyze.driven import ask
from tests.effects.machines import EVERY, SCROLL, complete, figures, outputs_with_counterweight

_EXACT = ("residual", "balance_rate", "hodograph", "orders", "foundation_loads", "stages", "internal_moment")
SAMPLED = tuple(name for name in EVERY if name not in _EXACT)


def _never(_context: Context) -> Any:
    raise AssertionError("this effect was not asked for")


@pytest.mark.parametrize("friction", [True, False])
@pytest.mark.parametrize("output", EVERY)
def test_an_output_does_with_its_own_effects_and_never_changes_another(
    output: str, friction: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    body = complete() if friction else complete(friction=None)
    together = figures(outputs_with_counterweight(*EVERY, body=body))
    needed = closure(ReciprocatingMachine.model_validate(body), OUTPUTS[output].needs)
    broken = {
        name: effect if name in needed else replace(effect, simulate=_never, problems=_never)
        for name, effect in EFFECTS.items()
    }
    monkeypatch.setattr(registry, "EFFECTS", broken)
    alone = outputs_with_counterweight(output, body=body)
    assert figures(alone)[output] == together[output]  # to the bit
    assert figures(alone)[output] is not None
    # the balance rate stands in every answer
    assert {name for name in EVERY if figures(alone)[name] is not None} == {output, "balance_rate"}
    for name, use in alone.effects.items():
        assert use.simulated == (name in needed)
        assert use.needed_by == ((output,) if name in needed else ())
        assert (use.time_ms > 0.0) == (name in needed)


@pytest.mark.parametrize("seed", range(3))
def test_the_order_of_the_outputs_is_of_no_account(seed: int) -> None:
    body = complete(seed)
    assert figures(outputs_with_counterweight(*EVERY, body=body)) == figures(
        outputs_with_counterweight(*reversed(EVERY), body=body)
    )


def test_needed_by() -> None:
    uses = outputs_with_counterweight("torque", "gas", "residual").effects
    assert uses["kinematics"].needed_by == ("torque", "gas")
    assert uses["gas"].needed_by == ("torque", "gas")
    assert uses["torque"].needed_by == ("torque",)
    assert uses["rotating_inertia"].needed_by == ("residual",)
    assert uses["flywheel"].needed_by == ()
    assert list(uses) == list(EFFECTS)


def test_friction_is_not_simulated_where_there_is_none() -> None:
    body = complete(friction=None)
    answer = outputs_with_counterweight("torque", "piston_force", body=body)
    assert not answer.effects["friction"].simulated
    assert answer.effects["friction"].needed_by == ()
    assert answer.torque.friction_power_W == answer.torque.rotating_friction_Nm == 0.0
    assert {force for row in answer.piston_force.rows for force in row.friction_N} == {0.0}


def test_friction_given_as_nothing_is_no_friction() -> None:
    none = outputs_with_counterweight(*EVERY, body=complete(friction=None))
    zero = outputs_with_counterweight(*EVERY, body=complete(friction={"rotating_torque_Nm": 0.0}))
    assert zero.effects["friction"].simulated
    assert figures(none) == figures(zero)


@pytest.mark.parametrize("output", SAMPLED)
def test_the_floor_is_null_where_no_output_asks_for_the_first_order(output: str) -> None:
    assert outputs_with_counterweight(output).floor is None
    assert (
        outputs_with_counterweight(output, "residual").floor == outputs_with_counterweight("residual").floor is not None
    )


def _refused(output: str, body: dict[str, Any]) -> set[tuple[str | int, ...]]:
    """Fields that are named as missing; none where the output is answered."""
    try:
        outputs_with_counterweight(output, body=body)
    except MissingInput as missing:
        return {problem.path for problem in missing.problems if f"output '{output}'" in problem.message}
    return set()


ROW = ("machine", "throws", 1, "rows", 0)
#: outputs that look at pressures, by what their effects need
_GAS = {output for output in EVERY if "gas" in effects_of(OUTPUTS[output].needs)}


@pytest.mark.parametrize("output", EVERY)
@pytest.mark.parametrize(
    ("drop", "named", "reached"),
    [
        ("suction_pressure_Pa", (*ROW, "cylinder", "suction_pressure_Pa"), _GAS),
        ("cylinder", (*ROW, "cylinder"), {"gas"}),
        ("connecting_rod", (*ROW, "connecting_rod"), {"orders", "foundation_loads", "stages", *SAMPLED}),
        ("flywheel", ("machine", "flywheel"), {"flywheel"}),
        ("bearings", ("machine", "bearings"), {"main_bearings"}),
    ],
)
def test_a_missing_input_is_named_only_if_it_is_reached(
    output: str, drop: str, named: tuple[str | int, ...], reached: set[str]
) -> None:
    body = complete()
    row = body["throws"][1]["rows"][0]
    for owner in (body, row, row["cylinder"]):
        if drop in owner:
            del owner[drop]
    row.get("cylinder", {}).update(head=None, crank=None)
    assert _refused(output, body) == ({named} if output in reached else set())


@pytest.mark.parametrize("output", EVERY)
def test_a_chamber_that_never_delivers_is_named_only_if_it_is_reached(output: str) -> None:
    body = complete()
    cylinder = body["throws"][0]["rows"][1]["cylinder"]
    cylinder.update(relative_clearance=90.0, head=None, crank=None)
    named = ("machine", "throws", 0, "rows", 1, "cylinder", "relative_clearance")
    assert _refused(output, body) == ({named} if output in _GAS else set())


def test_all_that_is_missing_is_named_at_once() -> None:
    body = complete(flywheel=None, bearings=[])
    del body["throws"][0]["rows"][0]["cylinder"]
    with pytest.raises(MissingInput) as refused:
        outputs_with_counterweight(*EVERY, body=body)
    problems = {problem.path: problem.message for problem in refused.value.problems}
    row = ("machine", "throws", 0, "rows", 0, "cylinder")
    assert set(problems) == {row, ("machine", "flywheel"), ("machine", "bearings")}
    assert problems[row].endswith("needed by output 'gas'")


@pytest.mark.parametrize("output", SAMPLED)
def test_a_scroll_has_no_rows_to_simulate(output: str) -> None:
    with pytest.raises(MissingInput) as refused:
        scroll_effects(output)
    assert [problem.path for problem in refused.value.problems] == [("machine", "kind")]


def scroll_effects(*outputs: str) -> Any:
    return ask(SCROLL, *outputs, step_deg=15.0)


def test_a_scroll_has_its_first_order() -> None:
    assert scroll_effects("residual", "hodograph", "orders", "foundation_loads", "stages").residual is not None


def test_order_2_is_the_series() -> None:
    series = outputs_with_counterweight("kinematics", "orders", "stages", fidelity={"kinematics": "order_2"})
    exact = outputs_with_counterweight("kinematics", "orders", "stages")
    body = complete()
    assert series.orders.before[0] == exact.orders.before[0]
    assert series.orders.before[1] != exact.orders.before[1]
    assert [order.force.peak_N for order in series.orders.before[2:]] == [0.0, 0.0]
    omega = body["speed_rpm"] * math.pi / 30.0
    for row, line, throw in zip(series.kinematics.rows, exact.kinematics.rows, (0, 0, 1, 1), strict=True):
        radius = body["throws"][throw]["crank_radius_m"]
        length = body["throws"][row.throw]["rows"][row.row]["connecting_rod"]["length_m"]
        # analytic: r w^2 (cos phi + lam cos 2 phi)
        phi = [math.radians(angle) for angle in row.crank_angle_deg]
        expected = [radius * omega**2 * (math.cos(p) + radius / length * math.cos(2 * p)) for p in phi]
        assert row.acceleration_m_s2 == pytest.approx(expected, rel=1e-9, abs=1e-9 * radius * omega**2)
        assert row.crank_angle_deg == line.crank_angle_deg
        assert row.acceleration_m_s2 != line.acceleration_m_s2


def test_fidelity_of_the_shaft_changes_the_bearings_alone() -> None:
    body = complete()
    hinged = figures(outputs_with_counterweight(*EVERY, body=body))
    continuous = figures(outputs_with_counterweight(*EVERY, body=body, fidelity={"shaft": "continuous"}))
    # loads have the weights on the bearings
    assert {name for name in EVERY if hinged[name] != continuous[name]} == {"main_bearings", "loads"}


PINS = {"type": "crank_pins", "count": 3, "pin_circle_radius_m": 0.05, "position_m": 0.03}


def test_pin_loads_of_a_scroll_machine() -> None:
    body = SCROLL | {"anti_rotation": PINS, "rotation_torque_Nm": 12.5}
    answer = ask(body, "pin_loads", step_deg=15.0)
    assert answer.pin_loads.peak_N == pytest.approx(2 * 12.5 / (3 * 0.05), rel=1e-12)  # published, seed 003 eq (3)
    assert answer.pin_loads.equilibrium.holds
    assert {name for name, use in answer.effects.items() if use.simulated} == {"pin_loads"}
    gas = SCROLL | {"anti_rotation": PINS, "tangential_gas_force_N": 5000.0}
    both = ask(gas, "pin_loads", "residual", step_deg=15.0)
    assert both.pin_loads.rotation_torque_Nm[0] == pytest.approx(5000.0 * 0.005 / 2)
    assert both.residual is not None


@pytest.mark.parametrize(
    ("body", "path"),
    [
        (SCROLL | {"rotation_torque_Nm": 1.0}, ("machine", "anti_rotation", "type")),
        (SCROLL | {"anti_rotation": PINS}, ("machine", "rotation_torque_Nm")),
        (
            SCROLL | {"anti_rotation": PINS, "tangential_gas_force_N": 1.0, "orbit_radius_m": 1e-9},
            ("machine", "orbit_radius_m"),
        ),
        (complete(), ("machine", "kind")),
    ],
)
def test_what_pin_loads_miss_is_named(body: dict[str, Any], path: tuple[str, ...]) -> None:
    with pytest.raises(MissingInput) as caught:
        ask(body, "pin_loads", step_deg=15.0)
    assert [problem.path for problem in caught.value.problems] == [path]


def test_more_pins_than_can_be_sampled_are_refused() -> None:
    body = SCROLL | {"anti_rotation": PINS | {"count": 1000}, "rotation_torque_Nm": 1.0}
    with pytest.raises(MissingInput) as caught:
        ask(body, "pin_loads", step_deg=0.1)
    assert [problem.path for problem in caught.value.problems] == [("angles", "step_deg")]


def test_more_rows_than_can_be_sampled_are_refused() -> None:
    body = complete()
    count = sum(len(throw["rows"]) for throw in body["throws"]) + len(body["bearings"])
    with pytest.raises(MissingInput) as caught:
        ask(body | {"throws": body["throws"] * 3}, "gas", "residual", step_deg=0.01)
    assert ("angles", "step_deg") in [problem.path for problem in caught.value.problems]
    assert count * 36000 * 3 > MAX_SAMPLES
    # outputs without series are not sampled
    assert ask(body, "residual", step_deg=0.01).residual is not None
