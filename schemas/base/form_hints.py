"""How the JSON schema of a model reads to those who make forms of it.

Every field has its title, its place and its heading beside its type, and its unit always there, never deeper. What
takes plain values of several types, such as 0.09, "90 mm" and null, is one schema with a list of types in place of
alternatives. A form then has one input for it and nothing to choose.
"""

from collections.abc import Iterator
from itertools import pairwise
from typing import Any

from schemas.base.form_groups import headings
from schemas.base.titles import field_title, model_title

Schema = dict[str, Any]

_UNIT = ("x-unit", "x-accepted-units")
#: the order of a list of types; forms that know one type only take the first
_TYPES = ("number", "integer", "string", "boolean", "object", "array", "null")
#: what holds for values of every type, so that it cannot stand beside a second one
_ANY_TYPE = ("enum", "const")
_NULL = "null"


def add_hints(model: type, schema: Schema) -> None:
    """Add to the schema of a model what a form needs; models without fields have none of it."""
    if "properties" not in schema:
        return
    schema["title"] = model_title(model.__name__)
    _condition(schema)
    heading = headings([base.__name__ for base in model.__mro__])
    properties: Schema = schema["properties"]
    names = _in_groups(list(properties), heading)
    schema["properties"] = {
        name: {
            **_collapsed(_without_unit(properties[name])),
            "title": field_title(model.__name__, name),
            **_unit(properties[name]),
            "x-order": place,
            **({"x-group": heading[name]} if name in heading else {}),
        }
        for place, name in enumerate(names)
    }


def _in_groups(fields: list[str], heading: dict[str, str]) -> list[str]:
    """Fields in the order of a form; one that is in no group joins that of the field before it, behind all of it."""
    for before, name in pairwise(fields if heading else ()):
        if name not in heading and before in heading:
            heading[name] = heading[before]
    groups = list(dict.fromkeys(heading.values()))
    names = sorted((name for name in heading if name in fields), key=lambda name: groups.index(heading[name]))
    return names + [name for name in fields if name not in heading]


def _condition(schema: Schema) -> None:
    """Of fields that go together, the usual ones are required unless others are there. Alternatives of a whole model
    would be a choice in a form, and no type at all in languages.
    """
    usual, *alternatives = schema.get("anyOf", [{}])
    if alternatives:
        del schema["anyOf"]
        schema |= {"if": {"not": {"anyOf": alternatives}}, "then": usual}


def _unit(node: Any) -> Schema:
    """The unit of a field, wherever in it that is said; what a reference leads to has its own."""
    if isinstance(node, dict):
        if _UNIT[0] in node:
            return {key: node[key] for key in _UNIT if key in node}
        node = list(node.values())
    return next(filter(None, map(_unit, node)), {}) if isinstance(node, list) else {}


def _without_unit(node: Any) -> Any:
    if isinstance(node, dict):
        return {key: _without_unit(value) for key, value in node.items() if key not in _UNIT}
    return [_without_unit(item) for item in node] if isinstance(node, list) else node


def _collapsed(node: Schema) -> Schema:
    """The same schema, with as few alternatives as there can be."""
    inner = {key: _collapsed(node[key]) for key in ("items",) if key in node}
    options: list[Schema] = []
    for option in _options(node):
        # a unit may be said twice, of a quantity and of the quantity or null
        options += [option] if option not in options else []
    if options == [node]:
        return node | inner
    own = {key: value for key, value in node.items() if key not in ("anyOf", "oneOf")} | inner
    plain = sorted((option for option in options if _plain(option)), key=lambda option: _TYPES.index(option["type"]))
    rest = [option for option in options if not _plain(option)]
    if not rest and _joinable(plain):
        return own | _union(plain)
    null = [{"type": _NULL, "title": "None"}] if any(option["type"] == _NULL for option in plain) else []
    values = [option for option in plain if option["type"] != _NULL]
    if _joinable(values):
        values = [{**_union(values), "title": "One value"}]
    return {**own, "anyOf": [*values, *rest, *null]}


def _options(node: Schema) -> Iterator[Schema]:
    """All alternatives, however deep; those that a field of theirs tells apart stay one."""
    alternatives = node.get("anyOf") or node.get("oneOf")
    if alternatives is None or "discriminator" in node:
        yield node
        return
    for alternative in alternatives:
        yield from _options(_collapsed(alternative) if "items" in alternative else alternative)


def _plain(node: Schema) -> bool:
    return isinstance(node.get("type"), str)


def _joinable(options: list[Schema]) -> bool:
    """Whether one schema with a list of types says the same: no two of a type, nothing that holds for all of them."""
    types = [option["type"] for option in options]
    values = [option for option in options if option["type"] != _NULL]
    mixed = len(values) > 1 and any(key in value for key in _ANY_TYPE for value in values)
    return bool(options) and len(set(types)) == len(types) and not mixed


def _union(options: list[Schema]) -> Schema:
    types = [option["type"] for option in options]
    union = {key: value for option in options for key, value in option.items() if key not in ("title", "description")}
    if _NULL in types:
        values = union.get("enum", [union["const"]] if "const" in union else None)
        union |= {} if values is None else {"enum": [*values, None]}
        union.pop("const", None)
    return {**union, "type": types if len(types) > 1 else types[0]}
