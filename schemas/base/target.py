"""Numeric fields of a request by JSON pointer (RFC 6901), and what they accept."""

import math
import re
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from typing import Annotated, Any, get_args, get_origin

from pydantic import BeforeValidator, Field, Strict, TypeAdapter
from pydantic_core import PydanticCustomError

from schemas.base.model import Model
from schemas.base.rules import Path, Rule
from schemas.base.units import UNITS, parse_quantity

_INDEX = re.compile(r"0|[1-9][0-9]{0,8}")
_BAD_ESCAPE = re.compile(r"~(?![01])")


def _number_or_text(value: Any) -> Any:
    if isinstance(value, bool) or not isinstance(value, int | float | str | None):
        raise PydanticCustomError("quantity", "must be a number, or a string with a unit")
    if isinstance(value, int | float) and not abs(value) <= sys.float_info.max:
        raise PydanticCustomError("quantity", "must be a finite number")
    return value


Text = Annotated[str, Field(max_length=48)]
#: what may stand in a numeric field, whatever its unit and range
Value = Annotated[Annotated[float, Strict()] | Text | None, BeforeValidator(_number_or_text)]


class BadPointer(ValueError):
    """A pointer leads to no numeric field; the message says why."""


@dataclass(frozen=True)
class Target:
    """A numeric field: where it is and which numbers it takes.

    path : names and indices from the root of the request.
    unit : of the field, None for plain numbers.
    lowest, highest : of the range; the lowest itself belongs to it unless ``above``, likewise ``below``.
    """

    path: Path
    unit: str | None
    nullable: bool
    integer: bool
    takes_text: bool
    lowest: float
    highest: float
    above: bool
    below: bool

    def number(self, entry: float | str | None) -> float | None:
        """A value as it may stand in the field, in the unit of the field; its range is not looked at.

        Raises
        ------
        ValueError
            if the field takes no such value.
        """
        if entry is None:
            if not self.nullable:
                raise ValueError("this field may not be null")
            return None
        if isinstance(entry, str):
            if not self.takes_text or self.unit is None:
                raise ValueError("must be a number" + (f" in {self.unit}" if self.unit else ""))
            value = parse_quantity(entry, self.unit)
            if math.isinf(value):
                raise ValueError("must be a finite number")
            return value
        return float(entry)

    def rules(self, value: Any) -> Iterator[Rule]:
        """What a value, or each of a column, must keep; nan stands for null and breaks none of them."""
        if not math.isinf(self.lowest):
            broken = value <= self.lowest if self.above else value < self.lowest
            words = "greater than" if self.above else "at least"
            yield Rule(broken, self.path, f"must be {words} {self.lowest:g}")
        if not math.isinf(self.highest):
            broken = value >= self.highest if self.below else value > self.highest
            words = "less than" if self.below else "at most"
            yield Rule(broken, self.path, f"must be {words} {self.highest:g}")
        if self.integer:
            yield Rule(value % 1 > 0, self.path, "must be a whole number")


def pointer(path: Path) -> str:
    """JSON pointer (RFC 6901) of a path."""
    return "".join("/" + str(part).replace("~", "~0").replace("/", "~1") for part in path)


def find_target(request: Model, text: str) -> Target:
    """The numeric field of a request that a JSON pointer names.

    Raises
    ------
    BadPointer
        if the pointer is malformed, leads nowhere, or to what is no number.
    """
    if not text.startswith("/"):
        raise BadPointer("must be a JSON pointer from the root of the base, such as /machine/speed_rpm")
    if _BAD_ESCAPE.search(text):
        raise BadPointer("a JSON pointer escapes ~ as ~0 and / as ~1")
    parts = [part.replace("~1", "/").replace("~0", "~") for part in text[1:].split("/")]
    path: list[str | int] = []
    node: Any = request
    declared: Any = type(request)
    for part in parts:
        if isinstance(node, Model):
            field = type(node).model_fields.get(part)
            if field is None:
                raise BadPointer(f"{pointer(tuple(path)) or 'the base'} has no field of this name")
            declared = Annotated[(field.annotation, *field.metadata)] if field.metadata else field.annotation
            node = getattr(node, part)
            path.append(part)
        elif isinstance(node, tuple):
            if not _INDEX.fullmatch(part) or int(part) >= len(node):
                raise BadPointer(f"{pointer(tuple(path))} has {len(node)} item(s), counted from 0")
            declared, node = _item(declared), node[int(part)]
            path.append(int(part))
        elif node is None:
            raise BadPointer(f"{pointer(tuple(path))} is null in the base")
        else:
            raise BadPointer(f"{pointer(tuple(path))} holds no other fields")
    return _target(tuple(path), declared)


def _item(declared: Any) -> Any:
    """Declared type of the items of a tuple, through annotations and the null that may stand for it."""
    if get_origin(declared) is Annotated:
        return _item(get_args(declared)[0])
    if get_origin(declared) is tuple:
        return get_args(declared)[0]
    for option in get_args(declared):
        item = _item(option)
        if item is not None:
            return item
    return None


def _target(path: Path, declared: Any) -> Target:
    accepted = _accepted(declared)
    if accepted is None:
        raise BadPointer("this field is no number")
    return Target(path, *accepted)


@lru_cache(maxsize=256)
def _accepted(declared: Any) -> tuple[str | None, bool, bool, bool, float, float, bool, bool] | None:
    """What a type accepts, read from its JSON schema; None where that is no number."""
    options = list(_options(TypeAdapter(declared).json_schema()))
    numbers = [option for option in options if option.get("type") in ("number", "integer")]
    if len(numbers) != 1 or "enum" in numbers[0]:
        return None
    number = numbers[0]
    above, below = "exclusiveMinimum" in number, "exclusiveMaximum" in number
    unit = next((option["x-unit"] for option in options if "x-unit" in option), None)
    return (
        unit,
        any(option.get("type") == "null" for option in options),
        number["type"] == "integer",
        unit in UNITS and any(option.get("type") == "string" for option in options),
        float(number["exclusiveMinimum" if above else "minimum"]) if above or "minimum" in number else -math.inf,
        float(number["exclusiveMaximum" if below else "maximum"]) if below or "maximum" in number else math.inf,
        above,
        below,
    )


def _options(schema: dict[str, Any]) -> Any:
    """A schema and all alternatives in it."""
    yield schema
    for option in (*schema.get("anyOf", ()), *schema.get("oneOf", ())):
        yield from _options(option)
