"""An answer for a person: a line of its figures, and HTML for a notebook.

In HTML figures stand in a table, lists of things as tables below, series by their length.
"""

from collections.abc import Iterator
from html import escape
from itertools import chain

from pydantic import BaseModel

from schemas.base.curves import Curve

#: figures of a line, and the longest text in it
_FIGURES, _TEXT = 8, 40
#: things of a list that are shown; more are counted
_MOST = 50


def line(model: BaseModel) -> str:
    """The answer on one line: its first figures and words, and of lists how much they hold."""
    figures = [f"{name}={_short(value)}" for name, value in _content(model)]
    return f"{type(model).__name__}({', '.join([*figures[:_FIGURES], *(['...'] if len(figures) > _FIGURES else [])])})"


def _short(value: object) -> str:
    if isinstance(value, BaseModel):
        return f"{type(value).__name__}(...)"
    if isinstance(value, tuple | Curve | dict):
        return f"[{len(value)}]"
    if isinstance(value, str):
        return repr(value if len(value) <= _TEXT else f"{value[:_TEXT]}...")
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def html(model: BaseModel) -> str:
    """The answer as tables; what is null or empty is left out."""
    return f"<h4>{escape(type(model).__name__)}</h4>{_fields(model)}"


def _fields(model: BaseModel) -> str:
    rows = "".join(f"<tr><th>{escape(name)}</th><td>{_value(value)}</td></tr>" for name, value in _content(model))
    return f"<table>{rows}</table>"


def _content(model: BaseModel) -> Iterator[tuple[str, object]]:
    for name, value in model:
        if not (value is None or (isinstance(value, tuple | Curve | dict) and not value)):
            yield name, value


def _value(value: object) -> str:
    if isinstance(value, BaseModel):
        return _fields(value)
    if isinstance(value, dict):
        rows = (f"<tr><th>{escape(str(name))}</th><td>{_value(item)}</td></tr>" for name, item in value.items())
        return f"<table>{''.join(rows)}</table>"
    if isinstance(value, Curve):
        return _several(tuple(value))
    if isinstance(value, tuple):
        return _several(value)
    return escape(f"{value:.6g}" if isinstance(value, float) else str(value))


def _several(values: tuple[object, ...]) -> str:
    models = [value for value in values if isinstance(value, BaseModel)]
    if len(models) < len(values):
        numbers = len(values) > 1 and all(isinstance(value, float | None) for value in values)
        return f"{len(values)} numbers" if numbers else ", ".join(map(_value, values))
    # a column for every field that one of them has
    names = list(dict.fromkeys(chain.from_iterable((name for name, _ in _content(model)) for model in models)))
    head = "".join(f"<th>{escape(name)}</th>" for name in names)
    rows = (dict(_content(model)) for model in models[:_MOST])
    body = "".join(f"<tr>{''.join(f'<td>{_value(row.get(name, str()))}</td>' for name in names)}</tr>" for row in rows)
    more = f"<caption>{len(models)}, the first {_MOST} of them</caption>" if len(models) > _MOST else ""
    return f"<table>{more}<tr>{head}</tr>{body}</table>"
