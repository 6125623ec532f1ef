"""Points and directions in space."""

from typing import Annotated, Any

from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler, Strict
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema

from schemas.base.quantities import Metres, Position
from schemas.base.units import symmetric


class Triple:
    """Annotation of a tuple of three like numbers: the schema says so in words that generators of code know."""

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        return handler(source)

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: GetJsonSchemaHandler) -> JsonSchemaValue:
        made = dict(handler(schema))
        return {**made, "items": made.pop("prefixItems")[0]}


_Share = Annotated[float, Strict(), symmetric(1e9)]

#: of requests
Point = Annotated[tuple[Position, Position, Position], Triple()]
Direction = Annotated[tuple[_Share, _Share, _Share], Triple()]
#: of answers
PointOut = Annotated[tuple[Metres, Metres, Metres], Triple()]
DirectionOut = Annotated[tuple[float, float, float], Triple()]
