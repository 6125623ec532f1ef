"""What the JSON schema says to those who make forms of it: of every request's every field, and of any answer's."""

import json
from functools import cache
from itertools import pairwise
from typing import Annotated, Any

import pytest
from jsonschema import Draft202012Validator
from pydantic import Field

from schemas.base.form_groups import GROUPS
from schemas.base.model import Model
from schemas.base.quantities import Length, Mass, Name
from schemas.base.titles import field_title, model_title
from schemas.base.units import Unit
from schemas.match.request import MatchRequest
from schemas.sweep.request import SweepRequest
from service.computations.table import COMPUTATIONS
from tests.schemas.test_json_schema import MODELS, Mode, model_cases, schemas_of_all

REQUESTS = [*dict.fromkeys(computation.request_model for computation in COMPUTATIONS.values()), SweepRequest]
#: more fields than a form shows without headings
MANY = 8


class Table(Model):
    """Numbers in a table."""

    masses_kg: tuple[Mass, ...] = Field(description="masses", examples=[[1.0]])


class Held(Model):
    """One field of every kind."""

    bore_m: Length = Field(description="a quantity", examples=[0.1])
    stroke_m: Annotated[Length | None, Unit("m")] = Field(None, description="a quantity or null", examples=[0.1])
    radii_m: tuple[Length, ...] | None = Field(None, description="quantities or null", examples=[[0.1]])
    bracket_N: tuple[Annotated[float, Unit("N")], Annotated[float, Unit("N")]] = Field(
        description="two numbers", examples=[[1.0, 2.0]]
    )
    load_kg: Mass | Table | None = Field(None, description="a quantity or a table", examples=[1.0])
    table: Table | None = Field(None, description="a table or null", examples=[{"masses_kg": [1.0]}])
    names: dict[Name, Mass] = Field(description="quantities by name", examples=[{"a": 1.0}])


@cache
def definitions(model: type[Model]) -> dict[str, dict[str, Any]]:
    """All models in the schema of a request, itself included; nobody changes them."""
    schema = model.model_json_schema()
    return {**schema.get("$defs", {}), model.__name__: schema}


def alternatives(node: dict[str, Any]) -> list[dict[str, Any]]:
    return node.get("anyOf") or node.get("oneOf") or []


def deeper(node: Any) -> Any:
    """Every schema within one, not through references."""
    for single_node in node.values() if isinstance(node, dict) else node if isinstance(node, list) else ():
        yield single_node
        yield from deeper(single_node)


def test_one_field_of_every_kind() -> None:
    properties = Held.model_json_schema()["properties"]
    assert properties["bore_m"]["type"] == ["number", "string"]
    assert properties["stroke_m"]["type"] == ["number", "string", "null"]
    assert (properties["radii_m"]["type"], properties["radii_m"]["items"]["type"]) == (
        ["array", "null"],
        ["number", "string"],
    )
    assert [entry.get("type") for entry in properties["load_kg"]["anyOf"]] == [["number", "string"], None, "null"]
    assert [alternative.get("title") for alternative in properties["load_kg"]["anyOf"]] == ["One value", None, "None"]
    assert [alternative.get("type") for alternative in properties["table"]["anyOf"]] == [None, "null"]
    units = {name: attribute.get("x-unit") for name, attribute in properties.items()}
    assert units == {
        "bore_m": "m", "stroke_m": "m", "radii_m": "m", "bracket_N": "N", "load_kg": "kg", "table": None, "names": "kg",
    }  # fmt: skip


@pytest.mark.parametrize(
    ("body", "valid"),
    [
        ({"bore_m": "90 mm"}, True),
        ({"bore_m": 0.09, "stroke_m": None}, True),
        ({"bore_m": "90 kg"}, False),
        ({"bore_m": "0.09"}, False),
        ({"bore_m": -1}, False),
        ({"bore_m": None}, False),
        ({"bore_m": 1, "radii_m": [1, "5 mm"]}, True),
        ({"bore_m": 1, "radii_m": [None]}, False),
        ({"bore_m": 1, "load_kg": {"masses_kg": ["3 g"]}}, True),
        ({"bore_m": 1, "load_kg": "3 m"}, False),
    ],
)
def test_the_schema_takes_what_the_model_takes(body: dict[str, Any], valid: bool) -> None:
    whole = {"bracket_N": [1, 2], "names": {}, **body}
    assert Draft202012Validator(Held.model_json_schema()).is_valid(whole) is valid
    try:
        Held.model_validate_json(json.dumps(whole))
    except ValueError:
        assert not valid
    else:
        assert valid


@model_cases
@pytest.mark.parametrize("mode", ["validation", "serialization"])
def test_every_field_has_a_title_a_place_and_its_unit_beside_its_type(model: type[Model], mode: Mode) -> None:
    properties = schemas_of_all(mode)[model].get("properties", {})
    assert [attribute["x-order"] for attribute in properties.values()] == list(range(len(properties)))
    for name, single_property in properties.items():
        assert single_property["title"][:1].isupper(), name
        assert "_" not in single_property["title"], name
        assert not any(isinstance(part, dict) and "x-unit" in part for part in deeper(single_property)), name


@pytest.mark.parametrize("model", REQUESTS, ids=lambda model: model.__name__)
def test_a_field_has_one_input_unless_there_is_something_to_choose(model: type[Model]) -> None:
    """Alternatives are left where one of them is an object: there is one thing to choose, whether or which."""
    for owner, schema in definitions(model).items():
        titles = [attribute["title"] for attribute in schema.get("properties", {}).values()]
        assert len(set(titles)) == len(titles), owner
        for name, schema_property in schema.get("properties", {}).items():
            options = alternatives(schema_property)
            plain = [option for option in options if "type" in option and option["type"] != "null"]
            assert len(plain) <= 1, (owner, name)
            assert not options or any("$ref" in part for part in deeper(options) if isinstance(part, dict)), (
                owner,
                name,
            )


@pytest.mark.parametrize("model", REQUESTS, ids=lambda model: model.__name__)
def test_large_models_have_headings(model: type[Model]) -> None:
    for owner, schema in definitions(model).items():
        fields = schema.get("properties", {})
        groups = [field.get("x-group") for field in fields.values()]
        if len(fields) > MANY or owner in GROUPS:
            assert None not in groups, owner
        # a heading stands once: its fields follow one another
        assert (
            len(set(groups)) == 1 + sum(first != second_second for first, second_second in pairwise(groups))
            or not groups
        ), owner


def test_headings_name_fields_that_there_are() -> None:
    all_schemas = schemas_of_all("validation")
    properties = {model.__name__: set(all_schemas[model]["properties"]) for model in MODELS if model.__name__ in GROUPS}
    assert set(properties) == set(GROUPS)
    for model, groups in GROUPS.items():
        listed = [field for fields in groups.values() for field in fields]
        assert len(set(listed)) == len(listed), model
        assert model == "Rotor" or set(listed) <= properties[model], model


def test_titles_are_those_of_a_person() -> None:
    assert field_title("Throw", "crank_radius_m") == "Crank radius"
    assert field_title("Objective", "force_ceiling_x_N") == "Force ceiling along x"
    assert field_title("RatingRequest", "capacity_m3_per_min") == "Capacity"
    assert field_title("Web", "max_mass_kg") == "Largest mass"
    assert model_title("ConnectingRod") == "Connecting rod"
    assert MatchRequest.model_json_schema()["title"] == "Match request"
