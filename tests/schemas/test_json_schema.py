"""The published JSON schema: described, with examples that are valid and with a unit on every physical field."""

import importlib
import pkgutil
from functools import cache
from typing import Annotated, Any, Literal

import pytest
from jsonschema import Draft202012Validator
from pydantic import BaseModel, TypeAdapter
from pydantic.json_schema import models_json_schema

import schemas
from schemas.base.model import Model
from schemas.request.requests import AnalyzeRequest, OptimizeRequest

Mode = Literal["validation", "serialization"]
#: suffix of a field's name -> unit; the longest suffix that fits counts
SUFFIXES = {
    "_kg_m2": "kg m2",
    "_kg_m3": "kg/m3",
    "_kg_m": "kg m",
    "_m2": "m2",
    "_m": "m",
    "_kg": "kg",
    "_deg": "deg",
    "_per_deg": "1/deg",
    "_rpm": "rpm",
    "_N": "N",
    "_Nm": "N m",
    "_Pa": "Pa",
    "_W": "W",
    "_J": "J",
    "_ms": "ms",
    "_s": "s",
    "_K": "K",
    "_m3": "m3",
    "_m3_per_min": "m3/min",
    "_m_s": "m/s",
    "_Hz": "Hz",
    "_rad_s2": "rad/s2",
    "_mm_s": "mm/s",
    "_m_s2": "m/s2",
    "_N_per_m": "N/m",
}


def all_models() -> list[type[Model]]:
    for module in pkgutil.walk_packages(schemas.__path__, "schemas."):
        importlib.import_module(module.name)
    kinds, rest = [], [Model]
    while rest:
        children = [c for c in rest.pop().__subclasses__() if c.__module__.startswith("schemas.")]
        kinds += children
        rest += children
    return sorted(set(kinds), key=lambda model: model.__name__)


MODELS = all_models()
model_cases = pytest.mark.parametrize("model", MODELS, ids=lambda model: model.__name__)


@cache
def schemas_of_all(mode: Mode) -> dict[type[Model], Any]:
    """The schema of every model, made together: what they share is made once."""
    references, fields = models_json_schema([(model, mode) for model in MODELS])
    names = {model: reference["$ref"].rpartition("/")[2] for (model, _), reference in references.items()}
    return {model: fields["$defs"][names[model]] for model in MODELS}


def unit_of(name: str) -> str | None:
    fitting = [suffix for suffix in SUFFIXES if name.endswith(suffix)]
    return SUFFIXES[max(fitting, key=len)] if fitting else None


def units_in(schema: Any) -> set[str]:
    """Every x-unit in the schema of one field, not looking into other models."""
    if isinstance(schema, dict):
        own = {schema["x-unit"]} if "x-unit" in schema else set()
        return own.union(*(units_in(value) for value in schema.values()))
    return set().union(*(units_in(value) for value in schema)) if isinstance(schema, list) else set()


def of_a_request(model: type[Model]) -> bool:
    return model.__module__ in (
        "schemas.machine.machine",
        "schemas.machine.throws",
        "schemas.machine.webs",
        "schemas.request.objective",
        "schemas.machine.cylinder",
        "schemas.request.requests",
        "schemas.rating.request",
    )


@model_cases
def test_every_field_is_described_with_an_example(model: type[Model]) -> None:
    poor = [
        name
        for name, field in model.model_fields.items()
        if not (field.description and field.description[0].isalpha() and field.examples)
    ]
    assert poor == []


@pytest.mark.parametrize("mode", ["validation", "serialization"])
@model_cases
def test_every_physical_field_carries_its_unit(model: type[Model], mode: Mode) -> None:
    properties = schemas_of_all(mode)[model].get("properties", {})
    names = [field.alias or name for name, field in model.model_fields.items()]
    expected = {name: {unit} if (unit := unit_of(name)) else set() for name in names}
    assert {name: units_in(properties[name]) for name in names} == expected


def test_every_model_is_described() -> None:
    assert [model.__name__ for model in MODELS if not model.__doc__] == []


@pytest.mark.parametrize("request_model", [OptimizeRequest, AnalyzeRequest])
def test_the_schema_of_a_request_is_a_json_schema(request_model: type[BaseModel]) -> None:
    schema = request_model.model_json_schema()
    Draft202012Validator.check_schema(schema)
    for part in (schema, *schema["$defs"].values()):
        assert part.get("additionalProperties", False) is False


@model_cases
def test_examples_are_valid(model: type[Model]) -> None:
    """Of requests all, of answers those of single values."""
    for field in model.model_fields.values():
        if of_a_request(model) or field.annotation in (float, int, str):
            # the name under which it crosses the boundary is the model's, not the value's
            plain = field.merge_field_infos(field, alias=None, validation_alias=None, serialization_alias=None)
            adapter: TypeAdapter[Any] = TypeAdapter(Annotated[field.annotation, plain])
            for example in field.examples or []:
                adapter.validate_python(example)
