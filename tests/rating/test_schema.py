"""The schemas of the request and the answer: described, with valid examples and a unit on every physical field."""

import inspect
from typing import Annotated, Any

import pytest
from jsonschema import Draft202012Validator
from pydantic import TypeAdapter, ValidationError
from pydantic.fields import FieldInfo

import schemas.rating
from schemas.base import Model
from schemas.rating import RatingRequest
from schemas.rating_answer import RatingAnswer
from tests.rating.design import body, request

#: suffix of a field's name -> unit; the longest suffix that fits counts
SUFFIXES = {
    "_m3_per_min": "m3/min",
    "_m_s": "m/s",
    "_m3": "m3",
    "_m2": "m2",
    "_m": "m",
    "_K": "K",
    "_Pa": "Pa",
    "_N": "N",
    "_W": "W",
    "_rpm": "rpm",
}
MODELS = [
    model
    for _, model in inspect.getmembers(schemas.rating, inspect.isclass)
    if issubclass(model, Model) and model.__module__ == "schemas.rating"
]
FIELDS = [(model, name, field) for model in MODELS for name, field in model.model_fields.items()]
IDS = [f"{model.__name__}.{name}" for model, name, _ in FIELDS]


def units_in(schema: Any) -> set[str]:
    if isinstance(schema, dict):
        own = {schema["x-unit"]} if "x-unit" in schema else set()
        return own.union(*(units_in(value) for value in schema.values()))
    return set().union(*(units_in(value) for value in schema)) if isinstance(schema, list) else set()


@pytest.mark.parametrize("mode", ["validation", "serialization"])
@pytest.mark.parametrize(("model", "name", "field"), FIELDS, ids=IDS)
def test_fields_are_described_and_carry_their_unit(model: type[Model], name: str, field: FieldInfo, mode: Any) -> None:
    assert field.description
    assert field.examples
    fitting = [suffix for suffix in SUFFIXES if name.endswith(suffix)]
    expected = {SUFFIXES[max(fitting, key=len)]} if fitting else set()
    assert units_in(model.model_json_schema(mode=mode)["properties"][name]) == expected


ASKED = [one for one in FIELDS if one[0].__name__ in ("RatingRequest", "CompressionStage", "RelativeLeaks")]


@pytest.mark.parametrize(("model", "name", "field"), ASKED, ids=[f"{m.__name__}.{n}" for m, n, _ in ASKED])
def test_examples_of_the_request_are_valid(model: type[Model], name: str, field: FieldInfo) -> None:
    adapter: TypeAdapter[Any] = TypeAdapter(Annotated[field.annotation, field])
    for example in field.examples or []:
        adapter.validate_python(example)


@pytest.mark.parametrize("model", [RatingRequest, RatingAnswer])
def test_the_schema_is_a_json_schema(model: type[Model]) -> None:
    schema = model.model_json_schema()
    Draft202012Validator.check_schema(schema)
    for part in (schema, *schema["$defs"].values()):
        assert part["additionalProperties"] is False
        assert part["description"]


def test_the_seeds_request_satisfies_the_published_schema() -> None:
    Draft202012Validator(RatingRequest.model_json_schema()).validate(body())


def test_a_request_is_written_as_it_was_read() -> None:
    one = request(interstage_pressures_Pa=["7.9 bar"])
    assert RatingRequest.model_validate_json(one.model_dump_json()) == one
    assert one.interstage_pressures_Pa == (790000.0,)


def test_models_are_frozen() -> None:
    with pytest.raises(ValidationError, match="frozen"):
        request().speed_rpm = 1.0  # type: ignore[misc]
