"""The form of an answer as its models have it: what the checker's own table, which knows no model, has to say."""

from types import UnionType
from typing import Annotated, Any, Union, get_args, get_origin

from pydantic import BaseModel

from schemas.answer.answers import OptimizeAnswer
from schemas.answer.outputs import OutputFields
from schemas.front.pareto import ParetoAnswer
from schemas.match.answer import MatchAnswer

#: parts of which nothing is looked at, whatever they hold
_UNKNOWN = {"counts"}
#: outputs of which the checker knows the form
_FORMS = ("hodograph", "orders", "foundation_loads", "stages")
_OUTPUTS = {*OutputFields.model_fields} - {*_FORMS}
#: evidence without which no more than less is proven, as in answers of before
_EVIDENCE = {"share"}


def fields(model: type[BaseModel] = OptimizeAnswer, path: str = "") -> dict[str, tuple[str, ...]]:
    """Names of the fields of every object of an answer, by its place; `*` for all of a list."""
    named = {name: field.alias or name for name, field in model.model_fields.items() if name not in _EVIDENCE}
    actual_fields = {
        path: tuple(alias for name, alias in named.items() if path or name not in OutputFields.model_fields)
    }
    for name, field in model.model_fields.items():
        if path or name not in _OUTPUTS:
            for where, inner in _models(field.annotation, f"{path}/{name}"):
                actual_fields |= fields(inner, where)
    return actual_fields


def _models(annotation: Any, path: str) -> list[tuple[str, type[BaseModel]]]:
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return [(path, annotation)]
    origin, inner = get_origin(annotation), get_args(annotation)
    if origin is Annotated:
        return _models(inner[0], path)
    if origin in (Union, UnionType):
        return [model for part in inner for model in _models(part, path)]
    if origin is tuple or origin is list:
        return [model for part in inner for model in _models(part, f"{path}/*")]
    # of a map the names are free
    return []


def all_fields() -> dict[str, tuple[str, ...]]:
    """Of single answers, of matching, and of fronts but for those of counts, each by its place."""
    fronts = fields(ParetoAnswer, "/pareto").items()
    labels = {path: names for path, names in fronts if not _UNKNOWN & {*path.split("/")}}
    return fields() | fields(MatchAnswer, "/match") | labels


def nulls(model: type[BaseModel], path: str = "") -> dict[str, set[str]]:
    """Names of the fields that may hold null, by the places of their objects."""
    empty = {
        path: {
            field.alias or name
            for name, field in model.model_fields.items()
            if type(None) in get_args(field.annotation)
        }
    }
    for name, field in model.model_fields.items():
        if path or name not in _OUTPUTS:
            for where, inner in _models(field.annotation, f"{path}/{name}"):
                empty |= nulls(inner, where)
    return empty


def all_nulls() -> dict[str, set[str]]:
    """The same of all answers."""
    return nulls(OptimizeAnswer) | nulls(MatchAnswer, "/match") | nulls(ParetoAnswer, "/pareto")
