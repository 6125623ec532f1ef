"""Points and directions in space."""

from typing import Annotated, Any

from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler, Strict
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema

from schemas.base.quantities import Metres, Position
from schemas.base.units import symmetric


class Uniform:
    """Annotation of a tuple of so many like numbers: the schema says so in words that generators of code know."""

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        return handler(source)

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: GetJsonSchemaHandler) -> JsonSchemaValue:
        document = dict(handler(schema))
        first, *_ = document.pop("prefixItems")
        return {**document, "items": first}


_Share = Annotated[float, Strict(), symmetric(1e9)]

#: of requests
Interval = Annotated[tuple[Position, Position], Uniform()]
Point = Annotated[tuple[Position, Position, Position], Uniform()]
Direction = Annotated[tuple[_Share, _Share, _Share], Uniform()]
#: of answers
PointOut = Annotated[tuple[Metres, Metres, Metres], Uniform()]
DirectionOut = Annotated[tuple[float, float, float], Uniform()]
