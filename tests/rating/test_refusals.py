"""What a rating refuses, each with the field that is wrong."""

import contextlib
import math
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import ValidationError

from optimizer.errors import OutOfRange
from optimizer.rating.rate import rate
from schemas.rating.answer import RatingAnswer
from schemas.rating.request import RatingRequest
from tests.rating.design import SEED, body, request

Path = tuple[str | int, ...]


def refused(changes: dict[str, Any]) -> list[Path]:
    """Paths of the fields that the request model refuses."""
    with pytest.raises(ValidationError) as caught:
        RatingRequest.model_validate(body(**changes))
    locs: list[Path] = []
    for error in caught.value.errors():
        problems = error["ctx"]["problems"] if error["type"] == "cross_field" else None
        locs += [error["loc"]] if problems is None else [(*error["loc"], *p.path) for p in problems]
    return locs


@pytest.mark.parametrize(
    ("changes", "path"),
    [
        ({"discharge_pressure_Pa": 0.3e6}, ("discharge_pressure_Pa",)),
        ({"discharge_pressure_Pa": 0.2e6, "interstage_pressures_Pa": [0.5e6]}, ("discharge_pressure_Pa",)),
        ({"interstage_pressures_Pa": [0.3e6]}, ("interstage_pressures_Pa", 0)),
        ({"interstage_pressures_Pa": [2.1e6]}, ("interstage_pressures_Pa", 0)),
        ({"interstage_pressures_Pa": []}, ("interstage_pressures_Pa",)),
        ({"interstage_pressures_Pa": [0.5e6, 0.9e6]}, ("interstage_pressures_Pa",)),
        ({"suction_pressure_Pa": 0}, ("suction_pressure_Pa",)),
        ({"suction_pressure_Pa": "3 mm"}, ("suction_pressure_Pa",)),
        ({"isentropic_exponent": 1.0}, ("isentropic_exponent",)),
        ({"isentropic_exponent": 1 + 2**-52}, ("isentropic_exponent",)),
        ({"isentropic_exponent": "1.4"}, ("isentropic_exponent",)),
        ({"stages/0/expansion_exponent": 1}, ("stages", 0, "expansion_exponent")),
        ({"stages/1/compression_exponent": 0.9}, ("stages", 1, "compression_exponent")),
        ({"mechanical_efficiency": 0}, ("mechanical_efficiency",)),
        ({"mechanical_efficiency": 1.01}, ("mechanical_efficiency",)),
        ({"drive_efficiency": -0.5}, ("drive_efficiency",)),
        ({"relative_humidity": 1.1}, ("relative_humidity",)),
        ({"stages/1/relative_clearance": 0}, ("stages", 1, "relative_clearance")),
        ({"stages/1/relative_clearance": -0.1}, ("stages", 1, "relative_clearance")),
        ({"stages/0/bore_m": 0.11}, ("stages", 0, "piston_rod_diameter_m")),
        ({"stages/0/bore_m": 0.05}, ("stages", 0, "piston_rod_diameter_m")),
        ({"stages/0/leakage_coefficient": 0.95}, ("stages", 0, "leakage_coefficient")),
        ({"stages/0/relative_leaks": None}, ("stages", 0, "leakage_coefficient")),
        ({"stages/0/suction_pressure_loss": 1}, ("stages", 0, "suction_pressure_loss")),
        ({"stages/0/side_flow_coefficient": 0.9}, ("stages", 0, "side_flow_coefficient")),
        ({"stages/1/name": "I"}, ("stages", 1, "name")),
        ({"stages/1/suction_temperature_K": 260}, ("stages", 1, "suction_temperature_K")),
        ({"stages/0/suction_temperature_K": 700}, ("stages", 0, "suction_temperature_K")),
        ({"stages/0/suction_temperature_K": "40 C"}, ("stages", 0, "suction_temperature_K")),
        ({"stages/0/cylinders": 0}, ("stages", 0, "cylinders")),
        ({"stages/0/cylinders": 1.5}, ("stages", 0, "cylinders")),
        ({"stages/0/acting": "both"}, ("stages", 0, "acting")),
        ({"stages": []}, ("stages",)),
        ({"stages": SEED["stages"] * 7}, ("stages",)),
        ({"bore_series": "R10"}, ("bore_series",)),
        ({"colour": "blue"}, ("colour",)),
    ],
    ids=str,
)
def test_the_field_that_is_wrong_is_named(changes: dict[str, Any], path: Path) -> None:
    assert refused(changes) == [path]


def test_dry_gas_may_be_cold() -> None:
    answer = rate(request(("stages/0/suction_temperature_K", 250), relative_humidity=0))
    assert [stage.saturation_pressure_Pa for stage in answer.stages] == [None, None]
    assert [stage.condensate_coefficient for stage in answer.stages] == [1.0, 1.0]


def test_unnamed_stages_need_no_names() -> None:
    answer = rate(request(("stages/0/name", None), ("stages/1/name", None)))
    assert [stage.name for stage in answer.stages] == [None, None]


@pytest.mark.parametrize(
    ("changes", "path"),
    [
        # eps^(1/m) - 1 = 1.178 at the nominal ratio, 1.397 in the cylinder
        ({"stages/0/relative_clearance": 0.9}, ("stages", 0, "relative_clearance")),
        ({"stages/0/relative_clearance": 0.8}, ("stages", 0, "relative_clearance")),
        ({"stages/0/piston_rod_diameter_m": 1.0}, ("stages", 0, "piston_rod_diameter_m")),
        ({"stages/1/piston_rod_diameter_m": 0.7}, ("stages", 1, "piston_rod_diameter_m")),
        ({"capacity_m3_per_min": 1e6, "stroke_m": 1e-4}, ("capacity_m3_per_min",)),
        ({"stages/1/bore_m": 0.2}, ("stages", 1, "bore_m")),
        ({"stages/1/bore_m": 0.9}, ("stages", 0, "bore_m")),
        ({"mean_piston_speed_m_s": 20}, ("stages", 0, "suction_pressure_loss")),
        (
            {"stages/0/suction_temperature_K": 410},
            ("relative_humidity",),
        ),
    ],
    ids=str,
)
def test_what_no_machine_can_do_names_its_field(changes: dict[str, Any], path: Path) -> None:
    with pytest.raises(OutOfRange) as caught:
        rate(request(*changes.items()))
    assert path in [problem.path for problem in caught.value.problems]
    assert str(caught.value)


def test_rounding_a_bore_must_not_swallow_the_rod() -> None:
    """Calculated 101.9 mm around a rod of 101 mm, rounded to 100 mm."""
    payload = body(capacity_m3_per_min=1, discharge_pressure_Pa=0.9e6, bore_series="R20")
    stage = {**payload["stages"][0], "acting": "head", "piston_rod_diameter_m": 0.0}
    bore = rate(RatingRequest.model_validate({**payload, "stages": [stage]})).stages[0].calculated.bore_m
    small = {**payload, "capacity_m3_per_min": (0.1019 / bore) ** 2}
    with pytest.raises(OutOfRange, match="rounded") as caught:
        rate(RatingRequest.model_validate({**small, "stages": [{**stage, "piston_rod_diameter_m": 0.101}]}))
    assert [problem.path for problem in caught.value.problems] == [("stages", 0, "piston_rod_diameter_m")]


def numbers(value: Any, path: Path = ()) -> list[Path]:
    """Paths of all numbers in a body."""
    if isinstance(value, dict | list):
        items = value.items() if isinstance(value, dict) else enumerate(value)
        return [number for key, value in items for number in numbers(value, (*path, key))]
    return [path] if isinstance(value, int | float) and not isinstance(value, bool) else []


NUMBERS = ["/".join(map(str, path)) for path in numbers(SEED)]
EXTREMES = [0, -1, 1e-300, 1e-9, 1e-4, 0.01, 0.5, 0.999999, 1, 1.0001, 10, 100, 1e4, 1e6, 1e10, 1e300]


@given(st.lists(st.tuples(st.sampled_from(NUMBERS), st.sampled_from(EXTREMES)), min_size=1, max_size=6))
def test_anything_is_answered_or_refused(changes: list[tuple[str, float]]) -> None:
    """Numbers at the ends of their ranges never reach an overflow, a division by zero or an invalid answer."""
    answered_or_refused(changes)


@given(st.data())
def test_the_ends_of_all_ranges_are_answered_or_refused(data: st.DataObject) -> None:
    ends: dict[str, list[Any]] = {
        "capacity_m3_per_min": [1e-9, 1e6],
        "capacity_pressure_Pa": [1, 1e10],
        "capacity_temperature_K": [50, 2000],
        "suction_pressure_Pa": [1, 1e10 - 1],
        "discharge_pressure_Pa": [1.0000001, 1e10],
        "isentropic_exponent": [1.0001, 10],
        "relative_density": [0.001, 1000],
        "relative_humidity": [0, 5e-324, 1],
        "speed_rpm": [0.1, 1e6],
        "stroke_m": [1e-4, 10],
        "mean_piston_speed_m_s": [5e-324, 1, 1000],
        "ambient_pressure_Pa": [1, 1e10],
        "mechanical_efficiency": [0.01, 1],
        "drive_efficiency": [0.01, 1],
        "motor_margin": [0, 10],
        "stages/0/cylinders": [1, 100],
        "stages/0/acting": ["head", "crank"],
        "stages/0/piston_rod_diameter_m": [0, 1e-300, 100],
        "stages/1/bore_m": [1e-4, 100],
        "stages/1/suction_temperature_K": [50, 2000],
        "stages/0/relative_clearance": [5e-324, 10],
        "stages/0/expansion_exponent": [1.0001, 10, None],
        "stages/0/compression_exponent": [1.0001, 10],
        "stages/1/pressure_coefficient": [0.01, 1, None],
        "stages/1/temperature_coefficient": [0.01, 1],
        "stages/1/side_flow_coefficient": [0.01, 100],
        "stages/0/suction_pressure_loss": [0, 0.999, None],
        "stages/0/discharge_pressure_loss": [0, 0.999, None],
    }
    paths = data.draw(st.lists(st.sampled_from(sorted(ends)), unique=True, max_size=12))
    changes = [(path, data.draw(st.sampled_from(ends[path]))) for path in paths]
    answered_or_refused(changes)


def answered_or_refused(changes: list[tuple[str, Any]]) -> None:
    """A request is refused, or no machine can do it, or every figure of the answer is finite."""
    try:
        query = RatingRequest.model_validate(body(*changes))
    except ValidationError:
        return
    # outside the try: an invalid answer is an error
    with contextlib.suppress(OutOfRange):
        answer = rate(query)
        assert all(math.isfinite(x) for x in _values(answer.model_dump()))
        assert RatingAnswer.model_validate_json(answer.model_dump_json()) == answer


def _values(value: Any) -> list[float]:
    if isinstance(value, dict):
        return [x for value in value.values() for x in _values(value)]
    if isinstance(value, list | tuple):
        return [x for value in value for x in _values(value)]
    return [value] if isinstance(value, float) else []
