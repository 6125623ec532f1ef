"""Several cylinders on one piston rod: tandem and stepped, beside what they come to one by one."""

from typing import Any

import numpy as np
import pytest
from pydantic import ValidationError

from optimizer.analyze import analyze
from optimizer.errors import MissingInput
from optimizer.outputs.registry import OUTPUTS
from schemas.answer.answers import AnalyzeAnswer
from schemas.machine.reciprocating import ReciprocatingMachine
from schemas.request.requests import AnalyzeRequest

SECOND = {
    "bore_m": 0.3, "piston_rod_diameter_m": 0.08, "suction_pressure_Pa": 4e5, "discharge_pressure_Pa": 1.2e6,
    "relative_clearance": 0.14, "expansion_exponent": 1.3, "compression_exponent": 1.38,
}  # fmt: skip
FIRST = SECOND | {"bore_m": 0.5, "suction_pressure_Pa": 1e5, "discharge_pressure_Pa": 4e5, "relative_clearance": 0.1}
#: the trunk piston of a stepped cylinder: a full head side, and a ring on the crank side
HEAD = {"head_area_m2": 0.12, "crank_area_m2": 0.0, **{k: v for k, v in FIRST.items() if not k.endswith("_m")}}
RING = {"head_area_m2": 0.0, "crank_area_m2": 0.05, **{k: v for k, v in SECOND.items() if not k.endswith("_m")}}
DYNAMICS = ["gas", "piston_force", "rod_loads", "torque", "main_bearings"]


def machine(rows: list[dict[str, Any]], **more: Any) -> dict[str, Any]:
    """Opposed rows, each with the cylinders given."""
    throws = [
        {
            "position_m": 0.3 * k,
            "crank_radius_m": 0.12,
            "crank_angle_deg": 180.0 * k,
            "rows": [
                {"axis_deg": 180.0 * k, "reciprocating_mass_kg": 150.0, "connecting_rod": {"length_m": 0.6}} | row
            ],
        }
        for k, row in enumerate(rows)
    ]
    bearings = [{"name": str(k), "position_m": z} for k, z in enumerate((-0.2, 0.5))]
    return {"kind": "reciprocating", "speed_rpm": 600, "throws": throws, "bearings": bearings, **more}


def answer(rows: list[dict[str, Any]], **more: Any) -> AnalyzeAnswer:
    request = {"machine": machine(rows, **more), "outputs": DYNAMICS, "angles": {"step_deg": 5}}
    return analyze(AnalyzeRequest.model_validate(request))


def gas(analysis: AnalyzeAnswer, row: int = 0) -> Any:
    assert analysis.gas is not None
    return analysis.gas.rows[row]


def test_forces_of_a_tandem_row_add_analytic() -> None:
    both = answer([{"cylinders": [FIRST, SECOND]}, {"cylinder": SECOND}])
    first_answer, second_answer = answer([{"cylinder": FIRST}]), answer([{"cylinder": SECOND}, {"cylinder": SECOND}])
    summed = np.add(gas(first_answer).force_N, gas(second_answer).force_N)
    np.testing.assert_allclose(gas(both).force_N, summed, rtol=1e-13, atol=1e-9)
    assert gas(both).indicated_power_W == pytest.approx(
        gas(first_answer).indicated_power_W + gas(second_answer).indicated_power_W
    )
    # the row beside it has its two sides and no more, as if it were alone
    assert gas(both, 1) == gas(second_answer, 1)
    assert [(chamber.cylinder, chamber.side) for chamber in gas(both).chambers] == [
        (0, "head"), (0, "crank"), (1, "head"), (1, "crank"),
    ]  # fmt: skip
    assert [chamber.pressure_Pa for chamber in gas(both).chambers[2:]] == [
        chamber.pressure_Pa for chamber in gas(second_answer).chambers
    ]


def test_rod_loads_and_bearings_are_of_the_sum_analytic() -> None:
    """Of cylinders in the same state, one with both areas is the same row."""
    areas = [{"head_area_m2": 0.1, "crank_area_m2": 0.09}, {"head_area_m2": 0.06, "crank_area_m2": 0.05}]
    state = {name: value for name, value in FIRST.items() if not name.endswith("_m")}
    apart = answer([{"cylinders": [state | area for area in areas]}, {"cylinder": SECOND}])
    together = answer([{"cylinder": state | {"head_area_m2": 0.16, "crank_area_m2": 0.14}}, {"cylinder": SECOND}])
    for name in ("piston_force", "rod_loads", "torque", "main_bearings"):
        _same(getattr(apart, name).model_dump(), getattr(together, name).model_dump())


def _same(first: Any, second: Any) -> None:
    if isinstance(first, dict):
        for name in first:
            if not name.endswith("_deg"):  # of equal peaks either angle is right
                _same(first[name], second[name])
    elif isinstance(first, list | tuple):
        for figure, theirs in zip(first, second, strict=True):
            _same(figure, theirs)
    elif isinstance(first, float):
        assert first == pytest.approx(second, rel=1e-9, abs=1e-5)
    else:
        assert first == second


def test_a_step_has_a_side_without_area_analytic() -> None:
    """Piston of 0.12 m2 against the head, a ring of 0.05 m2 against the crank: F = -p A + p' A'; no ambient side."""
    pressures = gas(answer([{"cylinders": [HEAD, RING]}, {"cylinder": SECOND}]))
    head, ring = pressures.chambers[0], pressures.chambers[3]
    expected = -0.12 * np.array(head.pressure_Pa) + 0.05 * np.array(ring.pressure_Pa)
    np.testing.assert_allclose(pressures.force_N, expected, rtol=1e-13)
    assert [chamber.indicated_work_J == 0.0 for chamber in pressures.chambers] == [False, True, True, False]
    # analytic: the closed forms of the work are the mean torque's, by energy
    torque = answer([{"cylinders": [HEAD, RING]}]).torque
    assert torque is not None
    assert torque.mean_torque_Nm == pytest.approx(
        sum(chamber.indicated_work_J for chamber in pressures.chambers) / (2 * np.pi)
    )


def test_an_indicated_pressure_in_tandem_analytic() -> None:
    table = {"angle_deg": [0, 90, 180, 270, 360], "pressure_Pa": [4e5, 2e5, 1e5, 2e5, 4e5]}
    fields = {"head_area_m2": 0.12, "crank_area_m2": 0.0, "pressure": {"head": table}}
    both = gas(answer([{"cylinders": [SECOND, fields]}]))
    alone = gas(answer([{"cylinders": [fields]}]))
    pressures = gas(answer([{"cylinder": SECOND}]))
    np.testing.assert_allclose(both.force_N, np.add(alone.force_N, pressures.force_N), rtol=1e-13)
    assert alone.force_N[0] == -0.12 * 4e5
    assert both.chambers[2].indicated_work_J == pytest.approx(alone.chambers[0].indicated_work_J)


@pytest.mark.parametrize(
    ("row", "path"),
    [
        ({"cylinder": FIRST, "cylinders": [SECOND]}, ("cylinders",)),
        ({"cylinders": [FIRST | {"from_m": 1.0, "to_m": 1.5}, SECOND | {"from_m": 1.4, "to_m": 1.9}]},
         ("cylinders", 1, "from_m")),
        ({"cylinders": [FIRST | {"from_m": 1.0}]}, ("to_m",)),
        ({"cylinders": [FIRST | {"from_m": 1.0, "to_m": 0.9}]}, ("to_m",)),
        ({"cylinders": [FIRST | {"name": "I"}, SECOND | {"name": "I"}]}, ("cylinders", 1, "name")),
    ],
)  # fmt: skip
def test_bad_input_is_named(row: dict[str, Any], path: tuple[Any, ...]) -> None:
    with pytest.raises(ValidationError) as raised:
        ReciprocatingMachine.model_validate(machine([row]))
    problems = [problem for error in raised.value.errors() for problem in error["ctx"]["problems"]]
    assert any(problem.path[-len(path) :] == path for problem in problems)


def test_touching_bores_do_not_overlap() -> None:
    rows = [{"cylinders": [FIRST | {"from_m": 1.0, "to_m": 1.4}, SECOND | {"from_m": 1.4, "to_m": 1.9}]}]
    ReciprocatingMachine.model_validate(machine(rows))


def test_what_a_cylinder_of_several_lacks_is_named() -> None:
    lacking = {name: value for name, value in SECOND.items() if name != "relative_clearance"}
    with pytest.raises(MissingInput) as raised:
        answer([{"cylinders": [FIRST, lacking]}])
    assert [problem.path for problem in raised.value.problems] == [
        ("machine", "throws", 0, "rows", 0, "cylinders", 1, "relative_clearance")
    ]
    assert set(DYNAMICS) <= set(OUTPUTS)
