"""Answers as bytes: with their curves as arrays they are what pydantic writes."""

import json
from collections.abc import Iterator
from typing import Any, get_args

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from pydantic import PlainSerializer, WrapSerializer

from optimizer.analyze import analyze
from optimizer.errors import MissingInput
from optimizer.optimize import optimize
from optimizer.outputs.registry import OUTPUTS, require_inputs
from optimizer.pins.answer import pin_loads
from schemas.answer.answers import AnalyzeAnswer, OptimizeAnswer
from schemas.answer.outputs import Hodograph, Hodographs
from schemas.base.curves import Curve, curve_fields
from schemas.base.model import Answer, Model
from schemas.request.requests import OptimizeRequest
from schemas.scroll.pin_loads import PinLoadsAnswer
from service.common.answer_bytes import json_bytes
from service.documents.examples import bodies
from tests import night

#: functions of a model by which pydantic writes it otherwise
WRITERS = ("model_serializers", "field_serializers", "computed_fields")
FINITE = st.floats(allow_nan=False, allow_infinity=False)


class Drawn(Answer):
    """An answer with curves."""

    name: str
    hodograph: Hodographs | None = None
    figures: tuple[float, ...] = ()


def _drawn(name: str, numbers: list[float]) -> Drawn:
    curve, again = np.array(numbers), Curve[float](numbers)
    part = Hodograph(force_x_N=again, force_y_N=-curve, moment_x_Nm=numbers, moment_y_Nm=curve[::-1])
    return Drawn(
        version="1", name=name, hodograph=Hodographs(angle_deg=again, before=part, after=part), figures=numbers
    )


def _possible(request: OptimizeRequest) -> Iterator[str]:
    for name in OUTPUTS:
        try:
            require_inputs(request.machine, (name,), request.angles.count)
        except MissingInput:
            continue
        yield name


# independent: pydantic's own writer, of floats made one by one
def _same(answer: Answer) -> bytes:
    actual_json_bytes = json_bytes(answer)
    assert actual_json_bytes == answer.model_dump_json().encode()
    assert json.loads(actual_json_bytes) == answer.model_dump(mode="json")
    return actual_json_bytes


@pytest.mark.parametrize("name", night.part(2, bodies("")))
def test_every_example_with_all_outputs(name: str) -> None:
    request = OptimizeRequest.model_validate(bodies("")[name])
    outputs = tuple(_possible(request))
    assert set(outputs) & {"hodograph", "pin_loads"}
    variant = request.model_copy(update={"outputs": outputs})
    answer = optimize(variant)
    assert b'"angle_deg":[0.0,' in _same(answer)
    _same(optimize(request))
    _same(analyze({"machine": bodies("")[name]["machine"], "outputs": outputs}))


def test_pins_asked_for_alone() -> None:
    _same(pin_loads(next(iter(bodies("pin-loads").values()))))


# borders: where decimals give way to exponents, signed zero, the smallest and the largest numbers
@given(st.text(st.characters(exclude_categories=["Cs"])), st.lists(FINITE, max_size=20))
@example(
    '\x00\x1f\x7f\u2028"\\/\U0001f600', [-0.0, 5e-324, 2.2250738585072014e-308, 1.7976931348623157e308, 0.1, 1 / 3]
)
@example(
    "",
    [
        sign * digits * 10.0**power
        for sign in (1, -1)
        for digits in (1, 1.5, 9.999999999999999)
        for power in range(-8, 24)
    ],
)
@example("", [float(2**power + k) for power in (52, 53, 54, 63, 64, 70) for k in (-1, 0, 1)])
def test_any_numbers_and_any_text(name: str, numbers: list[float]) -> None:
    _same(_drawn(name, numbers))


def test_nothing_infinite_goes_out_as_null() -> None:
    with pytest.raises(ValueError, match="finite"):
        _drawn("", [1.0, np.nan])


WITH_CURVES = [OptimizeAnswer, AnalyzeAnswer, PinLoadsAnswer]


def _models(annotation: Any) -> Iterator[type[Model]]:
    """A type's models, and those in them."""
    if isinstance(annotation, type) and issubclass(annotation, Model):
        yield annotation
        for field in annotation.model_fields.values():
            yield from _models(field.annotation)
    for part in get_args(annotation):
        yield from _models(part)


# a writer that knows no pydantic takes what a model holds by the names of its fields
@pytest.mark.parametrize("model", WITH_CURVES)
def test_fields_of_answers_with_curves_go_out_as_they_stand(model: type[Any]) -> None:
    models = set(_models(model))
    assert len(models) > 3
    for part in models:
        assert not any(getattr(part.__pydantic_decorators__, kind) for kind in WRITERS)
        for field in part.model_fields.values():
            assert field.serialization_alias is None
            assert not field.exclude
            assert not any(isinstance(metadata, PlainSerializer | WrapSerializer) for metadata in field.metadata)


@pytest.mark.parametrize("model", WITH_CURVES)
def test_answers_with_curves_are_known(model: type[Any]) -> None:
    assert set(curve_fields(model)) >= ({"angle_deg"} if model is PinLoadsAnswer else {"hodograph", "torque", "roll"})
