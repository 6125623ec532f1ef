"""What is left to the night, and what is not under mutants."""

import pytest
from hypothesis import settings

from tests import night


def _by_day(parameters: list[object]) -> list[object]:
    return [
        parameter
        for parameter in parameters
        if not any(mark.name == "nightly" for mark in getattr(parameter, "marks", ()))
    ]


@pytest.mark.parametrize(("everything", "count"), [(False, 2), (True, 4)])
def test_a_part_is_tried_by_day_and_all_under_mutants(
    everything: bool, count: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(night, "ALL", everything)
    for tried in (night.part(2, range(4)), night.part(2, [(n, n) for n in range(4)], rows=True)):
        assert len(tried) == 4
        assert len(_by_day(tried)) == count


@pytest.mark.parametrize("everything", [False, True])
def test_what_is_of_the_night_stays_so(everything: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(night, "ALL", everything)
    slow = pytest.param(1, marks=pytest.mark.nightly)
    assert len(_by_day(night.part(1, [slow, 2]))) == 1


@pytest.mark.parametrize(("everything", "counts"), [(False, [3, 3]), (True, [5, None])])
def test_examples_are_fewer_by_day_alone(
    everything: bool, counts: list[int | None], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(night, "ALL", everything)
    usual = settings.default.max_examples
    max_examples = [night.by_day(3, 5).max_examples, night.by_day(3).max_examples]
    assert max_examples == [usual if count is None else count for count in counts]


@pytest.mark.parametrize("everything", [False, True])
def test_what_others_stand_for_is_tried_at_night_and_under_mutants(
    everything: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(night, "ALL", everything)

    def test() -> None: ...

    marks = getattr(night.at_night(test), "pytestmark", [])
    assert [mark.name for mark in marks] == ([] if everything else ["nightly"])
