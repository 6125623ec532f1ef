"""Fields that go together: what the rules of a model refuse, its JSON schema refuses too (independent: jsonschema)."""

import json
from itertools import product
from typing import Any

import pytest
from jsonschema import Draft202012Validator
from pydantic import ValidationError

from schemas.base.model import Model
from schemas.machine.catalogue import Catalogue
from schemas.machine.cylinder import Cylinder, RowCylinder
from schemas.machine.drive import FlywheelData, Friction
from schemas.machine.fitted import GivenCounterweight
from schemas.machine.indicated import IndicatedPressure
from schemas.machine.scroll_machine import ScrollMachine
from schemas.machine.throws import ConnectingRod, Row
from schemas.machine.webs import Web
from schemas.match.request import MatchRequest
from schemas.rating.request import CompressionStage, RatingRequest
from schemas.sweep.axes import Axis
from service.documents.examples import bodies

LEFT_OUT = object()
TRACE = {"angle_deg": [0, 120, 240], "pressure_Pa": [1e5, 2e5, 3e5]}
ENVELOPE = {"shape": "sector", "inner_radius_m": 0.1, "outer_radius_m": 0.2, "thickness_m": 0.03}
ENVELOPE |= {"density_kg_m3": 7850, "max_half_angle_deg": 60}
CHOICES = ("rotation_torque_Nm", "tangential_gas_force_N", "leakage_coefficient", "relative_leaks")
CHOICES += ("motors", "installed_motor_power_W")
MACHINE = next(iter(bodies("match").values()))["machine"]
RATING = {key: value for key, value in next(iter(bodies("rating").values())).items() if key not in CHOICES}
STAGE = {key: value for key, value in RATING["stages"][0].items() if key not in CHOICES}
SCROLL = next(body["machine"] for body in bodies().values() if body["machine"]["kind"] == "scroll")
SCROLL = {key: value for key, value in SCROLL.items() if key not in CHOICES}

#: a model, what is always there, and fields with the values that they may have beside null and nothing
CASES: list[tuple[type[Model], dict[str, Any], dict[str, list[Any]]]] = [
    (Catalogue, {}, {"masses_kg": [[1.0, 2.0]], "mass_step_kg": [0.5]}),
    (
        Cylinder,
        {"piston_rod_diameter_m": 0.1},
        {"bore_m": [0.7], "head_area_m2": [0.4], "crank_area_m2": [0.3]},
    ),
    (RowCylinder, {}, {"from_m": [1.0], "to_m": [2.0], "bore_m": [0.7], "head_area_m2": [0.4]}),
    (
        Friction,
        {},
        {
            "mechanical_efficiency": [0.9],
            "reciprocating_force_N": [[100.0]],
            "rotating_torque_Nm": [30.0],
            "indicated_power_W": [[5e4]],
        },
    ),
    (FlywheelData, {}, {"irregularity": [0.01], "inertia_kg_m2": [1000.0]}),
    (
        ConnectingRod,
        {"mass_kg": 80},
        {"length_m": [0.7], "centre_of_mass_m": [0.2], "reciprocating_share": [1 / 3, 0.3]},
    ),
    (Row, {"axis_deg": 0}, {"reciprocating_mass_kg": [1.0], "parts": [[{"name": "p", "mass_kg": 1.0}]]}),
    (GivenCounterweight, {"mass_kg": 1, "angle_deg": 0}, {"web": ["a"], "position_m": [0.1], "radius_m": [0.2]}),
    (IndicatedPressure, {}, {"head": [TRACE], "crank": [TRACE]}),
    (ScrollMachine, SCROLL, {"rotation_torque_Nm": [10.0], "tangential_gas_force_N": [100.0]}),
    (
        Web,
        {"name": "a", "position_m": 0},
        {
            "counterweight_radius_m": [0.2],
            "max_mass_kg": [5.0],
            "envelope": [ENVELOPE],
            "fixed": [{"mass_kg": 1, "angle_deg": 0, "radius_m": 0.2}],
            "min_fitted_mass_kg": [1.0],
            "max_centrifugal_force_N": [1e4],
        },
    ),
    (CompressionStage, STAGE, {"leakage_coefficient": [0.94], "relative_leaks": [{}]}),
    (
        RatingRequest,
        RATING,
        {"motors": [[], [{"power_W": 1e5, "speed_rpm": 500}]], "installed_motor_power_W": [1e5]},
    ),
    (
        Axis,
        {"path": "/machine/speed_rpm"},
        {"values": [[1.0, 2.0]], "start": [1.0], "stop": [2.0], "count": [3]},
    ),
    (
        MatchRequest,
        {"machine": MACHINE},
        {
            "balance_nuts_kg": [[], [1.0]],
            "counterweights": [[]],
            "choose_counterweights": [True, False],
        },
    ),
]


@pytest.mark.parametrize(("model", "always", "fields"), CASES, ids=lambda value: getattr(value, "__name__", ""))
def test_the_schema_refuses_what_the_rules_refuse(
    model: type[Model], always: dict[str, Any], fields: dict[str, list[Any]]
) -> None:
    validator = Draft202012Validator(model.model_json_schema())
    verdicts: set[bool] = set()
    for values in product(*([LEFT_OUT, None, *some] for some in fields.values())):
        body = always | {name: value for name, value in zip(fields, values, strict=True) if value is not LEFT_OUT}
        try:
            model.model_validate_json(json.dumps(body))
        except ValidationError as error:
            accepted, why = False, str(error)
        else:
            accepted, why = True, ""
        assert validator.is_valid(body) is accepted, (
            body,
            why,
            [validator_error.message for validator_error in validator.iter_errors(body)],
        )
        verdicts.add(accepted)
    assert verdicts == {True, False}
