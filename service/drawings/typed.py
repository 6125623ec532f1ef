"""The valid part of a layout that somebody is typing: a value that cannot be read is taken away, and named."""

from collections.abc import Iterator
from itertools import islice
from typing import Any

from pydantic import ValidationError
from pydantic_core import ErrorDetails

from schemas.base.model import FieldProblem
from schemas.base.rules import REQUIRED, Path
from service.common.validation import MAX_ERRORS, locate, message_of
from service.drawings.layout import CrankMachine, Layout

#: from the root down to the axis of a row
_DEEPEST = 8


def partial_layout(typed: dict[str, Any]) -> tuple[Layout | None, list[FieldProblem]]:
    """The valid part of a layout that is half-typed, and why the rest is missing.

    A value that cannot be read is taken away; where it has to be there, what it is part of goes with it.

    Returns
    -------
    Layout, None where nothing can be drawn; the first reasons, by their paths.
    """
    rest, why = _copied(typed, _DEEPEST), dict[Path, str]()
    layout: Layout | None = None
    while layout is None:
        try:
            layout = Layout.model_validate(rest)
        except ValidationError as error:
            if not _cut(rest, error, why):
                break
    if layout and isinstance(layout.machine, CrankMachine) and not (layout.machine.cranks or layout.machine.places):
        why.setdefault(("machine", "throws"), REQUIRED)
        layout = None
    return layout, [FieldProblem(*reason) for reason in islice(why.items(), MAX_ERRORS)]


def _copied(value: Any, deep: int) -> Any:
    """JSON as far down as anything is drawn: what somebody types may be nested as deeply as can be read."""
    if isinstance(value, dict):
        return {key: _copied(item, deep - 1) for key, item in value.items()} if deep else None
    if isinstance(value, list | tuple):
        return [_copied(item, deep - 1) for item in value] if deep else None
    return value


def _cut(rest: dict[str, Any], error: ValidationError, why: dict[Path, str]) -> bool:
    """Take away what is wrong, and note why; false where that would be all."""
    wrong = []
    for detail in error.errors(include_url=False, include_input=False):
        missing = detail["type"] == "missing"
        path = locate(rest, detail["loc"], missing)
        place = (*path, *_discriminator(detail)) if path else path
        why.setdefault(place, message_of(detail))
        wrong.append(path[:-1] if missing else path)
    for path in wrong:
        if len(path) < 2:
            return False
        _take_away(rest, path)
    return True


def _discriminator(detail: ErrorDetails) -> Iterator[str]:
    """The field that tells kinds apart, where that is wrong."""
    if detail["type"] in ("union_tag_not_found", "union_tag_invalid"):
        yield detail["ctx"]["discriminator"].strip("'")


def _take_away(rest: Any, path: Path) -> None:
    """Leave a gap in a list, so that places keep their numbers; elsewhere nothing."""
    *around, last = path
    inner: Any = rest
    for element in around:
        # gone already, with what it is part of
        inner = inner[element] if inner else None
    if isinstance(inner, list):
        inner[int(last)] = None
    elif inner:
        inner.pop(last, None)
