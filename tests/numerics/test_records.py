"""What is made once, and what is made often: attributes that are kept, and frozen dataclasses made quickly."""

from dataclasses import field, fields, make_dataclass, replace

import pytest

from optimizer.numerics.arrays import variant
from optimizer.numerics.memoization import cached_property
from optimizer.numerics.records import record
from optimizer.program.methods.optima import Optima
from optimizer.program.solution import Solutions


@record(frozen=True)
class Pair:
    """Two numbers, and what was written down of them."""

    first: int
    second: int = 2
    notes: list[str] = field(default_factory=list)

    @cached_property
    def total(self) -> int:
        """Their sum."""
        self.notes.append("added")
        return self.first + self.second


@record(frozen=True)
class Triple(Pair):
    third: int = 3


def test_a_record_is_made_as_its_dataclass_says() -> None:
    """Analytic."""
    assert (Pair(1).first, Pair(1).second, Pair(1).notes) == (1, 2, [])
    assert Pair(1, second=5) == Pair(1, 5) != Pair(1, 6)
    assert (Triple(1, third=7).second, Triple(1, 2, [], 7).third) == (2, 7)
    assert replace(Pair(1), second=4) == Pair(1, 4)
    with pytest.raises(TypeError, match="first"):
        Pair()  # type: ignore[call-arg]
    with pytest.raises(TypeError, match="fourth"):
        Pair(1, fourth=4)  # type: ignore[call-arg]


def test_records_are_compared_and_shown_as_dataclasses_are() -> None:
    """Independent: as the standard library has it."""
    plain = make_dataclass("Plain", ["first", "second"], frozen=True)
    kind = make_dataclass("Shown", ["first", "second"], frozen=True, namespace={"__doc__": "Two."})
    actual_kind = record(frozen=True)(type("Shown", (), {"__annotations__": {"first": int, "second": int}}))
    for first, second in ((1, 2), (0, "text"), ((), None)):
        same, other = actual_kind(first, second), actual_kind(first, 7)
        assert (same == actual_kind(first, second), same == other, same == kind(first, second)) == (True, False, False)
        assert hash(same) == hash(plain(first, second))
        assert repr(same) == repr(kind(first, second))
    assert hash(Pair(1, 2, ())) == hash(Pair(1, 2, ()))  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="unhashable"):
        hash(Pair(1))
    with pytest.raises(TypeError, match="nothing is written"):
        record(frozen=False)


def test_no_two_records_share_what_a_factory_makes() -> None:
    """Analytic."""
    pair, second_pair = Pair(1), Pair(1)
    pair.notes.append("mine")
    assert second_pair.notes == []


def test_an_attribute_is_worked_out_once() -> None:
    """Analytic."""
    pair = Pair(1)
    assert (pair.total, pair.total, pair.notes) == (3, 3, ["added"])
    assert Pair.total.__doc__ == "Their sum."


def test_a_variant_keeps_nothing_of_what_was_worked_out() -> None:
    """Analytic: with another number there is another sum."""
    pair = Pair(1)
    assert (pair.total, variant(pair, second=9).total, pair.total) == (3, 10, 3)
    assert variant(Triple(1), third=8) == Triple(1, third=8)


def test_optima_begin_with_what_solutions_have() -> None:
    """They are made by the order of their fields."""
    names = [single_field.name for single_field in fields(Optima)]
    assert names[: len(fields(Solutions))] == [single_field.name for single_field in fields(Solutions)]
