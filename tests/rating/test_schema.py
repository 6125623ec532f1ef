"""The schemas of the request and the answer; their fields are looked at in tests/schemas."""

import pytest
from jsonschema import Draft202012Validator
from pydantic import ValidationError

from schemas.base.model import Model
from schemas.rating.answer import RatingAnswer
from schemas.rating.request import RatingRequest
from tests.rating.design import body, request


@pytest.mark.parametrize("model", [RatingRequest, RatingAnswer])
def test_the_schema_is_a_json_schema(model: type[Model]) -> None:
    schema = model.model_json_schema()
    Draft202012Validator.check_schema(schema)
    for part in (schema, *schema["$defs"].values()):
        assert part["additionalProperties"] is False
        assert part["description"]


def test_the_seeds_request_satisfies_the_published_schema() -> None:
    Draft202012Validator(RatingRequest.model_json_schema()).validate(body())


def test_a_request_is_written_as_it_was_read() -> None:
    query = request(interstage_pressures_Pa=["7.9 bar"])
    assert RatingRequest.model_validate_json(query.model_dump_json()) == query
    assert query.interstage_pressures_Pa == (790000.0,)


def test_models_are_frozen() -> None:
    with pytest.raises(ValidationError, match="frozen"):
        request().speed_rpm = 1.0  # type: ignore[misc]
