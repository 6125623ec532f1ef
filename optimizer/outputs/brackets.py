"""Brackets of peaks, and other numbers, in the models of an answer."""

from collections.abc import Iterator
from functools import cache
from typing import Any, get_args

from schemas.base.curves import Curve
from schemas.base.model import Model


def has_brackets(model: type[Model]) -> bool:
    """Whether a model or those within it have fields for brackets; most have none."""
    return any(_fields(model))


def brackets(field: Any) -> list[tuple[str, tuple[float, float]]]:
    """Names and contents of all brackets in the models of an answer."""
    if isinstance(field, tuple):
        return [bracket for item in field for bracket in brackets(item)]
    if not isinstance(field, Model):
        return []
    own, holders = _fields(field.__class__)
    every = [(name, getattr(field, name)) for name in own]
    result = [(name, content) for name, content in every if content is not None]
    for name in holders:
        result += brackets(getattr(field, name))
    return result


@cache
def _fields(model: type[Model]) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Fields of a model that are brackets, and those that hold some; most answers have none of both."""
    fields = model.model_fields
    own = tuple(name for name in fields if "_bracket_" in name)
    holders = (name for name in fields if any(any(_fields(model)) for model in _models(fields[name].annotation)))
    return own, tuple(holders)


def _models(annotation: Any) -> Iterator[type[Model]]:
    """Models that a type names, within others too."""
    parts = get_args(annotation)
    if not parts and isinstance(annotation, type) and issubclass(annotation, Model):
        yield annotation
    for part in parts:
        yield from _models(part)


def numbers(field: Any) -> Iterator[tuple[str, Any]]:
    """Names and contents of all fields of numbers in the models of an answer."""
    if isinstance(field, Model):
        for name in type(field).model_fields:
            content = getattr(field, name)
            if isinstance(content, float | Curve) or (
                isinstance(content, tuple) and content and isinstance(content[0], float)
            ):
                yield name, content
            else:
                yield from numbers(content)
    elif isinstance(field, tuple):
        for item in field:
            yield from numbers(item)
