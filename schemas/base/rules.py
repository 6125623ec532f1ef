"""Rules between fields, each said once: for one request, and for the many of a sweep.

In a sweep a varied field holds a column (n,), one value for each design, and null in all of them or in none. Rules
are written with the operators that numbers and columns share (``<``, ``==``, ``&``, ``|``), so that a rule has one
verdict for all designs, or one for each. Every request is measured by all rules, and hardly one is broken: paths and
messages are made where something may be.
"""

from collections.abc import Iterable, Iterator
from functools import reduce
from typing import Any, NamedTuple, Self

from pydantic import model_validator
from pydantic_core import PydanticCustomError

from schemas.base.model import FieldProblem, Model

Path = tuple[str | int, ...]

#: what is said of a field that is missing
REQUIRED = "this field is required"


class Rule(NamedTuple):
    """Whether a rule is broken, by one request or by each of many; the field at fault, and what is said of it."""

    broken: Any
    path: Path
    message: str


class Ruled(Model):
    """A model with rules between its fields, and between those of the models in it."""

    @model_validator(mode="after")
    def _keep_rules(self) -> Self:
        """Raise one error that carries every rule that is broken.

        pydantic places an error raised by a model validator at the model; the paths in the context let the door
        (``service.common.validation``) point at the very field.

        Raises
        ------
        PydanticCustomError
            type ``cross_field``, context ``{"problems": [...]}``.
        """
        problems: list[FieldProblem] = []
        for broken, path, message in self.rules():
            if broken:
                problems.append(FieldProblem(path, message))
        if problems:
            raise PydanticCustomError(
                "cross_field", "{summary}", {"summary": problems[0].message, "problems": problems}
            )
        return self

    def rules(self) -> Iterator[Rule]:
        """The rules, with paths from this model."""
        raise NotImplementedError


def all_rules(model: Model) -> Iterator[Rule]:
    """The rules of a model and of all models in it, in the order in which a request is checked; paths from the model.

    Checking stops at a model whose parts are wrong, so of those that one design breaks the first is always said.
    """
    for name in type(model).model_fields:
        yield from _rules_in((name,), getattr(model, name))
    if isinstance(model, Ruled):
        yield from model.rules()


def _rules_in(path: Path, content: Any) -> Iterator[Rule]:
    if isinstance(content, Model):
        for broken, rest, message in all_rules(content):
            yield Rule(broken, (*path, *rest), message)
    elif isinstance(content, tuple):
        for index, item in enumerate(content):
            yield from _rules_in((*path, index), item)


def first_of(rules: Iterable[Rule]) -> Iterator[Rule]:
    """Rules of which only the first that is broken is said."""
    before: Any = False
    for broken, path, message in rules:
        after = before | broken
        yield Rule(after != before, path, message)
        before = after


def largest(values: list[Any]) -> Any:
    """The largest of finite numbers, or of each design where some of them are columns."""
    if set(map(type, values)) == {float}:
        return max(values)
    return reduce(_larger, values)


def _larger(first: Any, second: Any) -> Any:
    return first * (first >= second) + second * (second > first)
