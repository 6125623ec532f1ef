"""The base of every model, and what is wrong with a field."""

from collections.abc import Mapping
from typing import Any, NamedTuple, Self

from pydantic import BaseModel, ConfigDict, Field, GetCoreSchemaHandler, GetJsonSchemaHandler
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema, PydanticCustomError, core_schema

from schemas.base.form_hints import add_hints
from schemas.base.notebook import html, line
from schemas.base.version import package_version


class Model(BaseModel):
    """Frozen, refuses unknown fields, NaN and infinities."""

    model_config = ConfigDict(
        frozen=True,
        extra="forbid",
        allow_inf_nan=False,
        hide_input_in_errors=True,
        use_attribute_docstrings=False,
        # a process builds the models that it meets; all of them are a sixth of an import
        defer_build=True,
    )

    @classmethod
    def of_figures(cls, fields: Mapping[str, Any]) -> Self:
        """One of figures that this package computes: checked as any, but that no unknown field is looked for.

        That takes a quarter of the time of a check, and keywords take as much. The names are those of the package; a
        test holds that they are fields, in the models within as well.
        """
        return cls.__pydantic_validator__.validate_python(fields, extra="ignore")

    @classmethod
    def __get_pydantic_json_schema__(cls, schema: CoreSchema, handler: GetJsonSchemaHandler) -> JsonSchemaValue:
        document = handler(schema)
        add_hints(cls, handler.resolve_ref_schema(document))
        return document


class Displayable(Model):
    """What an answer consists of, or an answer: short in a terminal, tables in a notebook."""

    def __repr__(self) -> str:
        return line(self)

    def __str__(self) -> str:
        return line(self)

    def _repr_html_(self) -> str:
        """What a notebook shows."""
        return html(self)


class Answer(Displayable):
    """An answer of a computation, which says who computed it."""

    version: str = Field(
        default_factory=package_version, description="version of the package that answered", examples=["0.2.0"]
    )


class NotEmpty:
    """Annotation of a tuple that holds at least one thing.

    pydantic's own min_length counts the things that are valid, and so reports a tuple as too short
    because one of them is not.
    """

    @staticmethod
    def _check(value: tuple[object, ...]) -> tuple[object, ...]:
        if not value:
            raise PydanticCustomError("too_short", "must hold at least one item")
        return value

    def __get_pydantic_core_schema__(self, source: object, handler: GetCoreSchemaHandler) -> CoreSchema:
        return core_schema.no_info_after_validator_function(self._check, handler(source))

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: GetJsonSchemaHandler) -> JsonSchemaValue:
        return {**handler(schema), "minItems": 1}


class FieldProblem(NamedTuple):
    """One thing wrong with one field; ``path`` is relative to the model that found it."""

    path: tuple[str | int, ...]
    message: str
