"""A request whose varied fields hold columns: one model stands for many designs."""

from collections.abc import Mapping
from typing import Any, TypeVar

from schemas.base.model import Model
from schemas.base.rules import Path

Varied = TypeVar("Varied", bound=Model)


def with_fields(request: Varied, values: Mapping[Path, Any]) -> Varied:
    """The request with other contents in some fields, nothing checked.

    The contents may be columns (n,), one value for each design, which the types of the fields do not say. The assembly
    of machines into arrays and the rules of :mod:`schemas.base.rules` take both.

    Parameters
    ----------
    values : contents by path from the root of the request.
    """
    replaced: Varied = _replaced(request, values)
    return replaced


def _replaced(node: Any, values: Mapping[Path, Any]) -> Any:
    if () in values:
        return values[()]
    inside: dict[str | int, dict[Path, Any]] = {}
    for path, value in values.items():
        inside.setdefault(path[0], {})[path[1:]] = value
    if isinstance(node, tuple):
        return tuple(_replaced(item, inside[k]) if k in inside else item for k, item in enumerate(node))
    return node.model_copy(
        update={str(name): _replaced(getattr(node, str(name)), rest) for name, rest in inside.items()}
    )
