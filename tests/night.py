"""What is tried by night alone: ``make nightly``, or ``pytest tests/folder/test_file.py`` for all of one file."""

import os
from collections.abc import Callable, Container, Iterable
from typing import Any

import pytest
from _pytest.mark.structures import ParameterSet
from hypothesis import settings

#: whether nothing is left to the night: as at night itself, and under mutants
ALL = os.environ.get("CHECKED_ANSWERS") == "every"


def every(count: int, values: Iterable[Any]) -> list[Any]:
    """Parameters of a test: by day the first of so many, and so on; all by night."""
    return [value if place % count == 0 else _by_night(value) for place, value in enumerate(values)]


def part(count: int, values: Iterable[Any], rows: bool = False) -> list[Any]:
    """Parameters of a test of one property: by day the first of so many, and so on; all by night and under mutants.

    ``rows`` is whether each of the values is a tuple of several parameters.
    """
    sets = [value if isinstance(value, ParameterSet) or not rows else pytest.param(*value) for value in values]
    return sets if ALL else every(count, sets)


def at_night(test: Callable[..., None]) -> Callable[..., None]:
    """A test that others stand for by day; under mutants it is run as they are."""
    return test if ALL else pytest.mark.nightly(test)


def by_day(examples: int, by_night: int | None = None) -> settings:
    """Of a property so many examples by day, where each takes long; by night and under mutants, if that is not said, as
    many as of others."""
    if ALL:
        return settings() if by_night is None else settings(max_examples=by_night)
    return settings(max_examples=examples)


def but(day: Container[Any], values: Iterable[Any]) -> list[Any]:
    """Parameters of a test: by day those that are named; all by night."""
    return [value if value in day else _by_night(value) for value in values]


def _by_night(value: Any) -> Any:
    if isinstance(value, ParameterSet):
        return value._replace(marks=[*value.marks, pytest.mark.nightly])
    return pytest.param(value, marks=pytest.mark.nightly)
