"""The published JSON schema: described, with examples that are valid and with a unit on every physical field."""

import importlib
import pkgutil
from typing import Annotated, Any

import pytest
from jsonschema import Draft202012Validator
from pydantic import BaseModel, TypeAdapter
from pydantic.fields import FieldInfo

import schemas
from schemas.base import Model
from schemas.requests import AnalyzeRequest, OptimizeRequest

#: suffix of a field's name -> unit; the longest suffix that fits counts
SUFFIXES = {
    "_kg_m2": "kg m2",
    "_kg_m": "kg m",
    "_m2": "m2",
    "_m": "m",
    "_kg": "kg",
    "_deg": "deg",
    "_rpm": "rpm",
    "_N": "N",
    "_Nm": "N m",
    "_Pa": "Pa",
    "_W": "W",
    "_J": "J",
    "_ms": "ms",
    "_K": "K",
    "_m3": "m3",
    "_m3_per_min": "m3/min",
    "_m_s": "m/s",
    "_m_s2": "m/s2",
    "_N_per_m": "N/m",
}


def all_models() -> list[type[Model]]:
    for module in pkgutil.iter_modules(schemas.__path__):
        importlib.import_module(f"schemas.{module.name}")
    found, rest = [], [Model]
    while rest:
        children = [c for c in rest.pop().__subclasses__() if c.__module__.startswith("schemas.")]
        found += children
        rest += children
    return sorted(set(found), key=lambda model: model.__name__)


FIELDS = [(model, name, field) for model in all_models() for name, field in model.model_fields.items()]
IDS = [f"{model.__name__}.{name}" for model, name, _ in FIELDS]


def unit_of(name: str) -> str | None:
    fitting = [suffix for suffix in SUFFIXES if name.endswith(suffix)]
    return SUFFIXES[max(fitting, key=len)] if fitting else None


def units_in(schema: Any) -> set[str]:
    """Every x-unit in the schema of one field, not looking into other models."""
    if isinstance(schema, dict):
        own = {schema["x-unit"]} if "x-unit" in schema else set()
        return own.union(*(units_in(value) for value in schema.values()))
    return set().union(*(units_in(value) for value in schema)) if isinstance(schema, list) else set()


@pytest.mark.parametrize(("model", "name", "field"), FIELDS, ids=IDS)
def test_every_field_is_described_with_an_example(model: type[Model], name: str, field: FieldInfo) -> None:
    assert field.description
    assert field.description[0].islower() or field.description[0].isupper()
    assert field.examples


@pytest.mark.parametrize("mode", ["validation", "serialization"])
@pytest.mark.parametrize(("model", "name", "field"), FIELDS, ids=IDS)
def test_every_physical_field_carries_its_unit(model: type[Model], name: str, field: FieldInfo, mode: Any) -> None:
    schema = model.model_json_schema(mode=mode)["properties"][name]
    expected = unit_of(name)
    assert units_in(schema) == ({expected} if expected else set())


def test_every_model_is_described() -> None:
    assert [model.__name__ for model in all_models() if not model.__doc__] == []


@pytest.mark.parametrize("request_model", [OptimizeRequest, AnalyzeRequest])
def test_the_schema_of_a_request_is_a_json_schema(request_model: type[BaseModel]) -> None:
    schema = request_model.model_json_schema()
    Draft202012Validator.check_schema(schema)
    for part in (schema, *schema["$defs"].values()):
        assert part.get("additionalProperties", False) is False


REQUESTS = [f for f in FIELDS if f[0].__module__ in ("schemas.machine", "schemas.cylinder", "schemas.requests")]


@pytest.mark.parametrize(
    ("model", "name", "field"), REQUESTS, ids=[f"{model.__name__}.{name}" for model, name, _ in REQUESTS]
)
def test_examples_of_requests_are_valid(model: type[Model], name: str, field: FieldInfo) -> None:
    adapter: TypeAdapter[Any] = TypeAdapter(Annotated[field.annotation, field])
    for example in field.examples or []:
        adapter.validate_python(example)


NUMBERS = [f for f in FIELDS if f[2].annotation in (float, int, str)]


@pytest.mark.parametrize(
    ("model", "name", "field"), NUMBERS, ids=[f"{model.__name__}.{name}" for model, name, _ in NUMBERS]
)
def test_examples_of_single_values_are_valid(model: type[Model], name: str, field: FieldInfo) -> None:
    adapter: TypeAdapter[Any] = TypeAdapter(Annotated[field.annotation, field])
    for example in field.examples or []:
        adapter.validate_python(example)
