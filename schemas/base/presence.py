"""Which fields of a model go together, for its JSON schema: conditions (if, then) that its rules state in words.

A field is present where it is there and not null.
"""

from typing import Any

Schema = dict[str, Any]

_NULL = {"type": "null"}


def present(*names: str) -> Schema:
    """All of some fields are present."""
    return {"properties": {name: {"not": _NULL} for name in names}, "required": list(names)}


def absent(*names: str) -> Schema:
    """None of some fields is present."""
    return {"properties": dict.fromkeys(names, _NULL)}


def filled(name: str) -> Schema:
    """A list holds something."""
    return {"properties": {name: {"minItems": 1}}, "required": [name]}


def empty(name: str) -> Schema:
    """A list holds nothing, or is left out."""
    return {"properties": {name: {"maxItems": 0}}}


def when(condition: Schema, then: Schema, otherwise: Schema | None = None) -> list[Schema]:
    """What holds under a condition, and what else."""
    return [{"if": condition, "then": then, **({} if otherwise is None else {"else": otherwise})}]


def either(first: str, *rest: str) -> list[Schema]:
    """Where the first field is present, the others are not."""
    return when(present(first), absent(*rest))


def alternatives(first: str, second: str) -> list[Schema]:
    """Exactly one of two fields is present."""
    return when(present(first), absent(second), present(second))


def together(first: str, second: str) -> list[Schema]:
    """Both of two fields are present, or none."""
    return when(present(first), present(second), absent(second))


def conditions(*lists: list[Schema]) -> Schema:
    """Of the configuration of a model: all of some conditions."""
    return {"allOf": [condition for part in lists for condition in part]}
