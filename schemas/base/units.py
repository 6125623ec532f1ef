"""Physical quantities: a number in the unit of the field's suffix, or a string with a unit.

Strings are read with a table and exact decimal arithmetic, never with an evaluator.
"""

import re
from dataclasses import dataclass
from decimal import Context, Decimal
from functools import lru_cache
from typing import Any

from pydantic import Field, GetCoreSchemaHandler, GetJsonSchemaHandler
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema, PydanticCustomError, core_schema

PI = Decimal("3.14159265358979323846264338327950288")

#: unit of the field -> accepted unit -> (value of one accepted unit in the unit of the field)
UNITS: dict[str, dict[str, Decimal]] = {
    "m": {
        "m": Decimal(1),
        "cm": Decimal("0.01"),
        "mm": Decimal("0.001"),
        "in": Decimal("0.0254"),
        "ft": Decimal("0.3048"),
    },
    "kg": {
        "kg": Decimal(1),
        "g": Decimal("0.001"),
        "t": Decimal(1000),
        "lb": Decimal("0.45359237"),
    },
    "deg": {"deg": Decimal(1), "rad": 180 / PI},
    "rpm": {"rpm": Decimal(1), "rad/s": 30 / PI, "Hz": Decimal(60)},
    "N": {"N": Decimal(1), "kN": Decimal(1000), "lbf": Decimal("4.4482216152605")},
    "Pa": {
        "Pa": Decimal(1),
        "kPa": Decimal(1000),
        "MPa": Decimal(1000000),
        "bar": Decimal(100000),
        "psi": Decimal("4.4482216152605") / Decimal("0.00064516"),
    },
    "N m": {
        "N m": Decimal(1),
        "N mm": Decimal("0.001"),
        "lbf ft": Decimal("4.4482216152605") * Decimal("0.3048"),
    },
}

_NUMBERS = (float, int)
#: more digits than any product of a number and a unit has
_EXACT = Context(prec=60)
_MAX_LENGTH = 48
_NUMBER = r"[+-]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][+-]?[0-9]{1,3})?"
# written out, because the schema's readers take \s for more than ASCII spaces
_SPACE = r"[ \t\r\n\f\v]*"
_QUANTITY = re.compile(rf"{_SPACE}({_NUMBER}){_SPACE}([A-Za-z][A-Za-z/ ]*?){_SPACE}")


# of one crank radius on all throws the text is read once
@lru_cache(maxsize=1024)
def parse_quantity(text: str, unit: str) -> float:
    """Value of ``text`` such as ``"140 mm"`` in ``unit``, correctly rounded.

    Parameters
    ----------
    text : a number followed by a unit, at most 48 characters.
    unit : the unit of the field, a key of :data:`UNITS`.

    Raises
    ------
    ValueError
        if the text is not a number with a unit, or the unit measures something else.
    """
    accepted = UNITS[unit]
    match = _QUANTITY.fullmatch(text) if len(text) <= _MAX_LENGTH else None
    if match is None:
        raise ValueError(f"must be a number in {unit}, or a string such as '1.5 {unit}'")
    number, symbol = match[1], " ".join(match[2].split())
    if symbol not in accepted:
        raise ValueError(f"unit must be one of {', '.join(accepted)}")
    return float(_EXACT.multiply(Decimal(number), accepted[symbol]))


@dataclass(frozen=True)
class Unit:
    """Annotation of a float field: the unit it is in, and the strings it accepts."""

    symbol: str

    def read(self, value: Any) -> Any:
        """What a client states, a string as the number that it is in the unit of the field."""
        if type(value) in _NUMBERS:
            return value
        if isinstance(value, bool):
            raise PydanticCustomError("quantity", f"must be a number in {self.symbol}, not true or false")
        if not isinstance(value, str):
            return value
        if self.symbol not in UNITS:
            raise PydanticCustomError("quantity", f"must be a number in {self.symbol}")
        try:
            return parse_quantity(value, self.symbol)
        except ValueError as error:
            raise PydanticCustomError("quantity", str(error)) from None

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        schema = handler(source)
        return schema if _reads_unit(schema) else core_schema.no_info_before_validator_function(self.read, schema)

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: GetJsonSchemaHandler) -> JsonSchemaValue:
        number = handler(schema)
        if handler.mode == "serialization" or self.symbol not in UNITS:
            return {**number, "x-unit": self.symbol}
        text = {
            "type": "string",
            "maxLength": _MAX_LENGTH,
            "pattern": rf"^{_SPACE}{_NUMBER}{_SPACE}({'|'.join(UNITS[self.symbol])}){_SPACE}$",
        }
        return {"anyOf": [number, text], "x-unit": self.symbol, "x-accepted-units": list(UNITS[self.symbol])}


def _reads_unit(schema: Any) -> bool:
    """Whether a number that may be null is one whose unit is read already."""
    number = schema["schema"] if schema["type"] == "nullable" else schema
    read = number["function"]["function"] if number["type"] == "function-before" else None
    return getattr(read, "__func__", None) is Unit.read


class AnswerUnit(Unit):
    """The same of a field of answers alone, which are numbers."""

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        return handler(source)

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: GetJsonSchemaHandler) -> JsonSchemaValue:
        return {**handler(schema), "x-unit": self.symbol}


def positive(largest: float) -> Any:
    """Constraint 0 < value <= largest."""
    return Field(gt=0, le=largest)


def between(smallest: float, largest: float) -> Any:
    """Constraint smallest <= value <= largest."""
    return Field(ge=smallest, le=largest)


def non_negative(largest: float) -> Any:
    """Constraint 0 <= value <= largest."""
    return Field(ge=0, le=largest)


def symmetric(largest: float) -> Any:
    """Constraint -largest <= value <= largest."""
    return Field(ge=-largest, le=largest)
