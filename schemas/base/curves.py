"""Curves of answers: as many numbers as there are samples, held as one array and read like a tuple.

An answer of 16 rows has 137,000 such numbers. Nearly all of them go from the arrays of the optimiser into JSON; a
Python float of each would cost a third of the answer. This module does without numpy, as all schemas do: an array is
identified by its type's name, and read by what every array has.
"""

import sys
from array import array
from collections.abc import Iterable, Iterator, Sequence
from functools import cache
from math import isfinite, prod
from types import GenericAlias
from typing import Any, SupportsIndex, TypeVar, get_args, overload

from pydantic import (
    BaseModel,
    GetCoreSchemaHandler,
    ValidatorFunctionWrapHandler,
)
from pydantic_core import CoreSchema, core_schema

#: a float with its unit
_Number = TypeVar("_Number", bound=float)
_DOUBLE = "<f8" if sys.byteorder == "little" else ">f8"


class Curve(Sequence[_Number]):
    """Finite numbers (n,) over shaft angles: a sequence of floats that cannot be changed.

    It equals a tuple or list of the same numbers, hashes as the tuple does, and its slices are tuples.
    ``numpy.asarray`` looks at it without a copy. As a field it is ``Curve[Newtons]``: a list or tuple is read as
    ``tuple[Newtons, ...]`` would be, an array of numpy is taken over.

    values : an array of numpy, float64 (n,), which is kept where it is read-only and copied where it is not; or
        numbers.

    Raises
    ------
    ValueError
        if a number is infinite or not a number.
    """

    __slots__ = ("_values",)

    _values: Any

    def __init__(self, values: Iterable[float]) -> None:
        series = _series(values)
        if series is None:
            series = array("d", values)
            if not all(map(isfinite, series)):
                raise ValueError("the numbers of a curve are finite")
        self._values = series

    @staticmethod
    def rows(values: Any) -> list[Any]:
        """Curves of the rows of an array of numpy, float64 (..., T), in order: a quarter of the time of one by one.

        Where a number is not finite they are arrays, which a model refuses by the place of the number.
        """
        rows = _storage(values).reshape(prod(values.shape[:-1]), values.shape[-1])
        # to iterate over an array ends with an error that takes as long as the numbers do
        every = map(rows.__getitem__, range(len(rows)))
        return [*map(_curve, every)] if _is_double(rows) and _is_finite(rows.reshape(-1)) else [*every]

    def __len__(self) -> int:
        return len(self._values)

    def __iter__(self) -> Iterator[_Number]:
        return iter(self._values.tolist())

    @overload
    def __getitem__(self, index: SupportsIndex) -> _Number: ...
    @overload
    def __getitem__(self, index: slice) -> tuple[_Number, ...]: ...
    def __getitem__(self, index: SupportsIndex | slice) -> Any:
        if isinstance(index, slice):
            return tuple(self._values[index].tolist())
        return float(self._values[index])

    def __eq__(self, other: object) -> bool:
        if isinstance(other, Curve | tuple | list):
            return len(self) == len(other) and tuple(self) == tuple(other)
        return NotImplemented

    def __hash__(self) -> int:
        return hash(tuple(self))

    def __repr__(self) -> str:
        if len(self) < 4:
            return f"Curve({[*self]})"
        return f"Curve([{self[0]}, {self[1]}, ..., {self[-1]}], {len(self)} numbers)"

    def __reduce__(self) -> tuple[Any, ...]:
        return Curve, (self._values,)

    @property
    def __array_interface__(self) -> dict[str, Any]:
        """The numbers, for numpy: read-only."""
        numbers = memoryview(self._values).toreadonly()
        return {"version": 3, "shape": (len(self),), "typestr": _DOUBLE, "data": numbers}

    @property
    def numbers(self) -> Any:
        """The numbers as they are held, an array of numpy that cannot be changed; or a list of those that came one by
        one."""
        values = self._values
        return values.tolist() if type(values) is array else values

    @classmethod
    def __get_pydantic_core_schema__(cls, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        number = next(iter(get_args(source)), float)
        series_schema = handler.generate_schema(GenericAlias(tuple, (number, ...)))
        # what is text in JSON alone stays as it is elsewhere, and is not looked through
        stays = core_schema.any_schema(serialization=core_schema.to_string_ser_schema(when_used="json"))
        content, numbers, jsonable = (
            core_schema.plain_serializer_function_ser_schema(tuple, return_schema=stays),
            core_schema.plain_serializer_function_ser_schema(tuple, return_schema=series_schema),
            core_schema.plain_serializer_function_ser_schema(tuple, when_used="json"),
        )
        return core_schema.json_or_python_schema(
            core_schema.no_info_after_validator_function(cls, {**series_schema, "serialization": numbers}),
            core_schema.no_info_wrap_validator_function(
                _read, {**series_schema, "serialization": content}, serialization=jsonable
            ),
        )


def _is_array(values: object) -> bool:
    kind = type(values)
    return kind.__name__ == "ndarray" and kind.__module__ == "numpy"


def _is_double(values: Any) -> bool:
    """Whether it is an array of numpy of 64-bit floats, in the order of this machine."""
    return _is_array(values) and values.dtype.char == "d" and values.dtype.isnative


def _is_finite(values: Any) -> bool:
    """Whether all of an array (n,) are finite numbers: by the places of the largest and smallest, in half the time of a
    look at each. Where a number is not finite, one of these is it."""
    return not len(values) or (isfinite(values[values.argmax()]) and isfinite(values[values.argmin()]))


def _storage(values: Any) -> Any:
    """An array as curves hold it: nobody changes what is read-only, and JSON is written of numbers side by side."""
    flags = values.flags
    return values.copy() if flags.writeable or not flags.c_contiguous else values


def _series(values: Any) -> Any:
    """An array of finite numbers (n,) as a curve holds it; None of all else."""
    return _storage(values) if _is_double(values) and values.ndim == 1 and _is_finite(values) else None


def _curve(series: Any) -> Curve[Any]:
    """Of an array that is looked at already."""
    curve: Curve[Any] = Curve.__new__(Curve)
    curve._values = series  # noqa: SLF001 - it would be looked at once more
    return curve


def _read(value: Any, handler: ValidatorFunctionWrapHandler) -> Curve[Any]:
    """A curve, or of an array or of numbers one; what is wrong with a number is said by its place."""
    if type(value) is Curve:
        return value
    series = _series(value)
    if series is None:
        return Curve(handler(value.tolist() if _is_array(value) else value))
    return _curve(series)


@cache
def curve_fields(model: type[BaseModel]) -> tuple[str, ...]:
    """Fields of a model that are curves or hold some."""
    return tuple(name for name, field in model.model_fields.items() if _has_curves(field.annotation))


def _has_curves(annotation: Any) -> bool:
    kind = getattr(annotation, "__origin__", annotation)
    if isinstance(kind, type) and issubclass(kind, Curve):
        return True
    if isinstance(kind, type) and issubclass(kind, BaseModel):
        return bool(curve_fields(kind))
    return any(map(_has_curves, get_args(annotation)))
