"""Curves of answers: they read like tuples of floats, are validated like these, and hold an array."""

import copy
import json
import pickle
from collections.abc import Callable, Sequence
from typing import Annotated, Any

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from pydantic import BaseModel, TypeAdapter, ValidationError

from schemas.base.curves import Curve, curve_fields
from schemas.base.model import Model
from schemas.base.quantities import Newtons
from schemas.base.units import Unit

FINITE = st.floats(allow_nan=False, allow_infinity=False)
NUMBERS = st.lists(FINITE, max_size=12)


class Held(Model):
    """A model with a curve."""

    force_N: Curve[Newtons]
    turns: Annotated[Curve[float] | None, Unit("rad/s2")] = None


class Listed(Model):
    """The same with tuples."""

    force_N: tuple[Newtons, ...]
    turns: Annotated[tuple[float, ...] | None, Unit("rad/s2")] = None


class Whole(Model):
    """A model whose parts have curves."""

    name: str
    parts: tuple[Held, ...] | None = None
    numbers: tuple[float, ...] = ()


@given(NUMBERS)
def test_it_reads_like_a_tuple_of_floats(numbers: list[float]) -> None:
    expected = tuple(numbers)
    for curve in (Curve(numbers), Curve(np.array(numbers)), Curve(np.repeat(np.array(numbers), 2)[::2])):
        assert isinstance(curve, Sequence)
        assert (len(curve), tuple(curve)) == (len(expected), expected)
        assert curve == expected
        assert expected == curve
        assert curve == Curve(expected)
        assert curve == numbers
        assert hash(curve) == hash(expected)
        assert curve[1:] == expected[1:]
        assert type(curve[1:]) is tuple
        assert [curve[k] for k in range(-len(curve), len(curve))] == numbers * 2
        assert {type(number) for number in (*curve, *curve[:2], *[curve[0] for _ in numbers])} <= {float}
        assert [*reversed(curve)] == numbers[::-1]


@given(st.lists(st.tuples(FINITE, FINITE, FINITE), max_size=4))
def test_rows_of_an_array_are_curves_in_order(rows: list[tuple[float, ...]]) -> None:
    array = np.array(rows, float).reshape(-1, 3)
    for values in (array, array[:, None], np.asfortranarray(array)):
        assert Curve.rows(values) == rows
        assert {type(curve) for curve in Curve.rows(values)} <= {Curve}
    assert Curve.rows(np.zeros((2, 0))) == [(), ()]


def test_rows_are_not_copied_where_they_are_read_only() -> None:
    array = np.arange(6.0).reshape(2, 3)
    held = Curve.rows(array)
    array[0] = 7.0
    assert held == [(0.0, 1.0, 2.0), (3.0, 4.0, 5.0)]
    array.flags.writeable = False
    assert all(np.shares_memory(np.asarray(curve), array) for curve in Curve.rows(array))


@pytest.mark.parametrize("wrong", [np.nan, np.inf, -np.inf])
def test_a_model_refuses_rows_that_are_not_finite(wrong: float) -> None:
    sound, unsound = Curve.rows(np.array([[1.0, 2.0], [1.0, wrong]]))
    assert Held(force_N=sound).force_N == (1.0, 2.0)
    with pytest.raises(ValidationError) as raised:
        Held(force_N=unsound)
    assert [(error["loc"], error["type"]) for error in raised.value.errors()] == [(("force_N", 1), "finite_number")]
    assert [*map(tuple, Curve.rows(np.array([[1, 2]])))] == [(1, 2)]


def test_it_differs_from_other_things() -> None:
    curve = Curve([1.0, 2.0])
    assert curve != (1.0, 3.0)
    assert curve != (1.0,)
    assert curve != "12"
    assert curve != {1.0, 2.0}
    with pytest.raises(IndexError):
        curve[2]


@pytest.mark.parametrize("numbers", [[1.0, -0.0, 3.0], np.array([1.0, -0.0, 3.0])])
def test_it_cannot_be_changed(numbers: Any) -> None:
    curve = Curve(numbers)
    numbers[0] = 7.0
    assert curve == (1.0, 0.0, 3.0)
    actual_curve = np.asarray(curve)
    assert (actual_curve.dtype, actual_curve.shape) == (np.float64, (3,))
    assert np.signbit(actual_curve[1])
    with pytest.raises(ValueError, match="read-only"):
        actual_curve[0] = 7.0
    with pytest.raises(AttributeError):
        curve.other = 1  # type: ignore[attr-defined]


def test_a_read_only_array_is_held_without_a_copy() -> None:
    rows = np.arange(8.0).reshape(2, 4)
    rows.flags.writeable = False
    assert np.shares_memory(np.asarray(Curve(rows[1])), rows)
    assert not np.shares_memory(np.asarray(Curve(rows[:, 1])), rows)


@pytest.mark.parametrize("copied", [copy.copy, copy.deepcopy, lambda curve: pickle.loads(pickle.dumps(curve))])
@pytest.mark.parametrize("numbers", [[], [1.0, 2.5], np.array([1.0, 2.5])])
def test_copies_are_equal_and_cannot_be_changed(copied: Callable[[Any], Any], numbers: Any) -> None:
    curve = copied(Curve(numbers))
    assert curve == Curve(numbers)
    assert not np.asarray(curve).flags.writeable


def test_it_is_short_in_a_terminal() -> None:
    assert repr(Curve([])) == "Curve([])"
    assert repr(Curve([1.0, 2.0])) == "Curve([1.0, 2.0])"
    assert repr(Curve(np.arange(360.0))) == "Curve([0.0, 1.0, ..., 359.0], 360 numbers)"


@pytest.mark.parametrize("wrong", [[1.0, np.nan], [1.0, np.inf], [1.0, -np.inf], [1.0, -np.inf, np.inf, np.nan]])
@pytest.mark.parametrize("kind", [list, np.array])
def test_its_numbers_are_finite(wrong: list[float], kind: Callable[[Any], Any]) -> None:
    with pytest.raises(ValueError, match="finite"):
        Curve(kind(wrong))
    with pytest.raises(ValidationError) as raised:
        Held(force_N=kind(wrong))
    places = [(("force_N", k), "finite_number") for k in range(1, len(wrong))]
    assert [(error["loc"], error["type"]) for error in raised.value.errors()] == places


# analytic: their sum is beyond the largest float
def test_large_numbers_are_finite() -> None:
    numbers = np.array([-1.7e308, -1.7e308])
    assert Curve(numbers) == Held(force_N=numbers).force_N == (-1.7e308, -1.7e308)


@pytest.mark.parametrize(
    "value",
    [
        [1, 2.5],
        (),
        "x",
        None,
        3.0,
        {"a": 1},
        [1.0, "a"],
        ["1.5"],
        [[1.0]],
        [True],
        [1.0, None],
        [10**400],
    ],
)
def test_what_is_not_an_array_is_validated_like_a_tuple(value: Any) -> None:
    def outcome(model: type[BaseModel], *, of_json: bool) -> Any:
        fields = {"force_N": value, "turns": value}
        try:
            read = model.model_validate_json(json.dumps(fields)) if of_json else model.model_validate(fields)
        except ValidationError as error:
            return error.errors(include_url=False)
        return read.model_dump(), read.model_dump(mode="json"), read.model_dump_json()

    for of_json in (False, True):
        assert outcome(Held, of_json=of_json) == outcome(Listed, of_json=of_json)


@pytest.mark.parametrize("array", [np.arange(3), np.arange(3, dtype=np.float32), np.arange(3.0).astype(">f8")])
def test_arrays_of_other_numbers_are_read_number_by_number(array: np.ndarray) -> None:
    assert Held(force_N=array).force_N == (0.0, 1.0, 2.0)


@pytest.mark.parametrize("array", [np.zeros((2, 2)), np.array(1.0), np.array(["a"]), np.array([1j])])
def test_other_arrays_are_refused(array: np.ndarray) -> None:
    with pytest.raises(ValidationError):
        Held(force_N=array)


@pytest.mark.parametrize("mode", ["validation", "serialization"])
def test_its_schema_is_that_of_a_tuple(mode: Any) -> None:
    assert json.dumps(TypeAdapter(Held).json_schema(mode=mode)["properties"]) == json.dumps(
        TypeAdapter(Listed).json_schema(mode=mode)["properties"]
    )


@given(NUMBERS)
@example([-0.0, 5e-324, 1e15, 1e16, 1e21, 1e22])
def test_dumped_models_hold_tuples_and_json_lists(numbers: list[float]) -> None:
    held, listed = Held(force_N=np.array(numbers), turns=numbers), Listed(force_N=tuple(numbers), turns=tuple(numbers))
    assert held.model_dump() == listed.model_dump()
    assert type(held.model_dump()["force_N"]) is tuple
    assert held.model_dump(mode="json") == listed.model_dump(mode="json")
    assert type(held.model_dump(mode="json")["force_N"]) is list
    assert held.model_dump_json() == listed.model_dump_json()
    assert Held.model_validate_json(held.model_dump_json()) == held
    assert Held(force_N=held.force_N).force_N is held.force_N


def test_a_model_names_its_fields_with_curves() -> None:
    assert curve_fields(Held) == ("force_N", "turns")
    assert curve_fields(Whole) == ("parts",)
    assert curve_fields(Listed) == ()
