"""Frozen dataclasses of which an answer makes dozens."""

from dataclasses import fields, make_dataclass
from typing import Any, TypeVar

Kind = TypeVar("Kind")


def record(kind: type[Kind]) -> type[Kind]:
    """Have a frozen dataclass set its fields as one that is not frozen does, in a quarter of the time.

    That nobody writes to one is left to the type checker, which takes it for frozen all the same.
    """
    every: Any = kind
    own = [(field.name, field.type, field) for field in fields(every)]
    twin: Any = make_dataclass(kind.__name__, own, namespace={"__doc__": ""}, repr=False, eq=False, match_args=False)
    every.__init__ = twin.__init__
    del every.__setattr__, every.__delattr__
    return kind
