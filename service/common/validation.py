"""From bytes to a checked request; what is wrong is said field by field, for REST and command line alike."""

import json
import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from itertools import islice
from typing import TypeVar

from pydantic import ValidationError
from pydantic_core import ErrorDetails, from_json

from optimizer.errors import MissingInput, NotComputable, OutOfRange
from schemas.base.model import FieldProblem, Model
from schemas.base.rules import REQUIRED, Path
from service.common.problems import Fault, FaultTable

Request = TypeVar("Request", bound=Model)
MAX_ERRORS = 50
#: pydantic reports every bad item of every list, so the number of items bounds its work
MAX_LIST_ITEMS = 50_000
#: JSON that holds no more of them: an item takes two bytes at least
_FEW_BYTES = 2 * MAX_LIST_ITEMS
_LONGEST_NAME = 64
_LONGEST_INTEGER = 400
#: one search finds a long integer in a text whose digits are all replaced by 0
_LONG_INTEGER, _SAME_DIGITS = b"0" * _LONGEST_INTEGER, bytes.maketrans(b"123456789", b"000000000")
_BYTE_ORDER_MARK = b"\xef\xbb\xbf"
_DISCRIMINATORS = ("kind", "type")

_MESSAGES = {
    "missing": REQUIRED,
    "extra_forbidden": "unknown field",
    "model_type": "must be an object",
    "model_attributes_type": "must be an object",
    "tuple_type": "must be a list",
    "float_type": "must be a number",
    "int_type": "must be a whole number",
    "int_from_float": "must be a whole number",
    "int_parsing": "must be a whole number",
    "bool_type": "must be true or false",
    "greater_than": "must be greater than {gt:g}",
    "greater_than_equal": "must be at least {ge:g}",
    "less_than_equal": "must be at most {le:g}",
    "string_type": "must be a string",
    "string_unicode": "must be valid Unicode text",
    "string_pattern_mismatch": "must not contain control characters",
    "union_tag_not_found": REQUIRED,
    "union_tag_invalid": "must be one of {expected_tags}",
}
_SUBJECT = re.compile(r"^\w+ should")
_AFTERTHOUGHT = re.compile(r" after validation.*")


class UnreadableBody(ValueError):
    """The bytes are not what they are announced as; sending them again does not help."""


class UnreadableJson(UnreadableBody):
    """The bytes are not JSON."""


class InvalidRequest(ValueError):
    """The JSON does not describe a valid request; ``problems`` name fields by paths from the root of the body."""

    def __init__(self, problems: Iterable[FieldProblem]) -> None:
        errors = list(islice(problems, MAX_ERRORS + 1))
        self.problems = errors[:MAX_ERRORS]
        self.more = len(errors) > MAX_ERRORS
        super().__init__("invalid request")


def _fields(title: str, problems: Sequence[FieldProblem], more: bool) -> Fault:
    if more:
        detail = f"More than {MAX_ERRORS} fields are wrong; the first are listed."
    else:
        detail = "1 field is wrong." if len(problems) == 1 else f"{len(problems)} fields are wrong."
    return Fault(422, title, detail, problems)


def _not_computable(title: str) -> Callable[[NotComputable], Fault]:
    return lambda error: _fields(title, error.problems[:MAX_ERRORS], len(error.problems) > MAX_ERRORS)


#: what is said about bodies, and about requests that are well formed and still cannot be computed
FAULTS: FaultTable = {
    UnreadableJson: lambda error: Fault(400, "Unreadable JSON", f"The body is not JSON: {error}."),
    UnreadableBody: lambda error: Fault(400, "Unreadable body", f"The body is no workbook: {error}."),
    InvalidRequest: lambda error: _fields("Invalid request", error.problems, error.more),
    MissingInput: _not_computable("Missing input"),
    OutOfRange: _not_computable("Out of range"),
}


def read_request(model: type[Request], data: bytes) -> Request:
    """The JSON in ``data`` as a checked ``model``, in one pass; what is wrong is said by a second one.

    Raises
    ------
    UnreadableJson
    InvalidRequest
        naming the first fields that are wrong.
    """
    if len(data) <= _FEW_BYTES and not _has_long_integer(data):
        with suppress(ValidationError):
            return model.model_validate_json(data)
    return check(model, read_json(data), len(data))


def read_json(data: bytes) -> object:
    """The JSON value in ``data``; NaN and infinities pass here and are refused field by field later.

    Raises
    ------
    UnreadableJson
        if ``data`` is empty, not UTF-8, not JSON or nested too deeply.
    """
    data = data.removeprefix(_BYTE_ORDER_MARK)
    if not _has_long_integer(data):
        try:
            return from_json(data, cache_strings="keys")
        except ValueError:
            # what is wrong, and where, is said by the reader below; it reads lone surrogates too, in twice the time
            pass
    try:
        text = data.decode()
    except UnicodeDecodeError as error:
        raise UnreadableJson(f"not UTF-8 at byte {error.start}") from None
    if not text.strip():
        raise UnreadableJson("there is no JSON")
    return json_value(text)


def json_value(text: str) -> object:
    """The JSON value in ``text``, as :func:`read_json`.

    Raises
    ------
    UnreadableJson
    """
    try:
        return json.loads(text, parse_int=_integer if _has_long_integer(text.encode("ascii", "replace")) else None)
    except json.JSONDecodeError as error:
        raise UnreadableJson(f"line {error.lineno}, column {error.colno}: {error.msg}") from None
    except RecursionError:
        raise UnreadableJson("nested too deeply") from None


def _has_long_integer(text: bytes) -> bool:
    """Whether a number may be one that Python is not to read; a look at each number costs half as much again."""
    return _LONG_INTEGER in text.translate(_SAME_DIGITS)


def _integer(text: str) -> int | float:
    # longer ones overflow every field, and Python refuses to read the longest at all
    return int(text) if len(text) <= _LONGEST_INTEGER else float(text)


def check(model: type[Request], body: object, size: int | None = None) -> Request:
    """``body`` as a checked ``model``.

    Parameters
    ----------
    size : of the JSON that it was read from [bytes], where it was read from any.

    Raises
    ------
    InvalidRequest
        naming the first fields that are wrong.
    """
    if size is None or size > _FEW_BYTES:
        _limit_list_items(body)
    try:
        return model.model_validate(body)
    except ValidationError as error:
        details = error.errors(include_url=False, include_input=False)
        raise InvalidRequest(_problems(body, details)) from None


def pointer(path: Iterable[str | int]) -> str:
    """JSON pointer (RFC 6901) of a path."""
    return "".join("/" + str(element).replace("~", "~0").replace("/", "~1") for element in path)


def _limit_list_items(body: object) -> None:
    pending, items = [body], 0
    while pending:
        node = pending.pop()
        if isinstance(node, dict):
            pending += [value for value in node.values() if isinstance(value, (dict, list))]
        elif isinstance(node, list):
            items += len(node)
            if items > MAX_LIST_ITEMS:
                message = f"the lists of a request must not hold more than {MAX_LIST_ITEMS} items together"
                raise InvalidRequest([FieldProblem((), message)])
            pending += [value for value in node if isinstance(value, (dict, list))]


def _problems(body: object, details: Sequence[ErrorDetails]) -> Iterator[FieldProblem]:
    for detail in details:
        kind, loc, context = detail["type"], detail["loc"], detail.get("ctx", {})
        path = locate(body, loc, missing=kind == "missing")
        if kind == "cross_field":
            for problem in context["problems"]:
                yield FieldProblem((*path, *problem.path), problem.message)
        elif kind in ("union_tag_not_found", "union_tag_invalid"):
            yield FieldProblem((*path, context["discriminator"].strip("'")), message_of(detail))
        elif kind == "extra_forbidden":
            yield _unknown_field(path, str(loc[-1]))
        else:
            yield FieldProblem(path, message_of(detail))


def _unknown_field(path: Path, name: str) -> FieldProblem:
    if len(name) > _LONGEST_NAME:
        return FieldProblem(path[:-1], "holds an unknown field with a very long name")
    return FieldProblem(path, _MESSAGES["extra_forbidden"])


def message_of(detail: ErrorDetails) -> str:
    """The rule that is broken, in our words."""
    template = _MESSAGES.get(detail["type"])
    if template is not None:
        return template.format_map(detail.get("ctx", {}))
    return _AFTERTHOUGHT.sub("", _SUBJECT.sub("must", detail["msg"]))


def locate(body: object, loc: Path, missing: bool = False) -> Path:
    """Path in ``body`` of the place that pydantic calls ``loc``: without the tags of unions.

    Parameters
    ----------
    missing : whether the last element of ``loc`` names a field that is not there.
    """
    path: list[str | int] = []
    node, tagged = body, False
    for index, element in enumerate(loc):
        if not tagged and isinstance(node, dict) and element in [node.get(name) for name in _DISCRIMINATORS]:
            tagged = True
            continue
        if missing and index == len(loc) - 1:
            path.append(element)
        elif _holds(node, element):
            path.append(element)
            node, tagged = node[element], False  # type: ignore[index]
    return tuple(path)


def _holds(node: object, element: str | int) -> bool:
    if isinstance(node, Mapping):
        return element in node
    return isinstance(node, list) and isinstance(element, int) and element < len(node)
