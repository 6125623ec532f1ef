"""Answers as JSON in bytes, as workers send them."""

import orjson

from schemas.base.curves import ARRAYS, curve_fields
from schemas.base.model import Model


def json_bytes(answer: Model) -> bytes:
    """An answer as JSON, in bytes at once: all outputs are half a megabyte, which text would copy twice more.

    Curves go out as the arrays that they are, by orjson. The bytes are those of pydantic, which writes an answer
    without curves sooner.
    """
    writer = answer.__pydantic_serializer__
    for name in curve_fields(type(answer)):
        if getattr(answer, name) is not None:
            return orjson.dumps(writer.to_python(answer, mode=ARRAYS), option=orjson.OPT_SERIALIZE_NUMPY)
    return writer.to_json(answer)
