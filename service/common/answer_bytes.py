"""Answers as JSON in bytes, as workers send them."""

from typing import Any

import orjson

from schemas.base.curves import Curve, curve_fields
from schemas.base.model import Model


def json_bytes(answer: Model) -> bytes:
    """An answer as JSON, in bytes at once: all outputs are half a megabyte, which text would copy twice more.

    The bytes are those of pydantic. Answers that may have curves are written by orjson, which takes a third of the
    time and writes curves as the arrays that they are; a test holds that their fields go out as they stand.
    """
    if curve_fields(type(answer)):
        return orjson.dumps(answer, default=_content, option=orjson.OPT_SERIALIZE_NUMPY)
    return answer.__pydantic_serializer__.to_json(answer)


def _content(part: Any) -> Any:
    """What orjson writes of a curve or a model."""
    return part.numbers if type(part) is Curve else vars(part)
