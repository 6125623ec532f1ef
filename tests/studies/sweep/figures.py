"""Every number of the outputs of a single answer that stands by itself, found by their models."""

from collections.abc import Iterator
from types import NoneType
from typing import Annotated, Any, Literal, get_args, get_origin

from pydantic import BaseModel

from schemas.answer.answers import BalanceRate
from schemas.answer.first_order import Residual
from schemas.answer.outputs import OutputFields
from schemas.base.curves import Curve


def every_figure() -> tuple[str, ...]:
    """Their paths from the answer; brackets stand for every item."""
    beside: dict[str, Any] = {"residual": Residual, "balance_rate": tuple[BalanceRate, ...]}
    fields = {name: field.annotation for name, field in OutputFields.model_fields.items()}
    return tuple(path for name, kind in (beside | fields).items() for path in _numbers(name, kind))


def _numbers(path: str, kind: Any) -> Iterator[str]:
    """Series and brackets are no figures by themselves, nor are words."""
    origin, inside = get_origin(kind), get_args(kind)
    if origin is Annotated:
        yield from _numbers(path, inside[0])
    elif origin in (tuple, Curve):
        # models one after the other, if only two of them; else a series or a bracket
        if _is_model(inside[0]):
            yield from _numbers(f"{path}[]", inside[0])
    elif _is_model(kind):
        for name, field in kind.model_fields.items():
            yield from _numbers(f"{path}.{name}", field.annotation)
    elif kind in (int, float):
        yield path
    elif origin is not Literal:
        for value in inside:
            if value is not NoneType:
                yield from _numbers(path, value)


def _is_model(kind: Any) -> bool:
    return isinstance(kind, type) and issubclass(kind, BaseModel)
