"""Points and directions: three numbers, or texts with a unit, as one list in the schema."""

import pytest
from pydantic import TypeAdapter, ValidationError

from schemas.base.vectors import Interval, Point
from schemas.request.shaft import ShaftRequest


def test_a_point_takes_three_numbers_or_texts() -> None:
    assert TypeAdapter(Point).validate_python([1, "20 mm", "3 in"]) == pytest.approx((1.0, 0.02, 0.0762))
    for wrong in ([1, 2], [1, 2, 3, 4], [1, 2, "3 kg"], [1, 2, float("nan")], 1):
        with pytest.raises(ValidationError):
            TypeAdapter(Point).validate_python(wrong)


def test_the_schema_is_a_list_of_like_numbers() -> None:
    for adapter, count in ((TypeAdapter(Point), 3), (TypeAdapter(Interval), 2)):
        schema = adapter.json_schema()
        assert "prefixItems" not in schema
        assert (schema["minItems"], schema["maxItems"], "items" in schema) == (count, count, True)
    # nowhere in a request
    assert "prefixItems" not in str(ShaftRequest.model_json_schema())
