"""Genuine answers of every kind are drawn, and what is wrong with one of them is a fault."""

import itertools
from typing import Any

import pytest

from optimizer.studies.sweep import rows
from tests.night import but
from tests.verification import genuine
from tests.verification.genuine import KINDS, Kind, questions, run

_SEED = 1


def test_questions_of_every_kind_are_drawn() -> None:
    """Of twelve numbers two are sweeps of machines, four sweeps of pairs, and so on."""
    actual_questions = list(itertools.islice(questions(_SEED), 40))
    assert {actual_question.kind for actual_question in actual_questions} == KINDS.keys()
    assert len({actual_question.name for actual_question in actual_questions}) == len(actual_questions)


@pytest.mark.parametrize("kind", but({"sweep", "match"}, KINDS))
def test_genuine_answers_are_not_broken(kind: str) -> None:
    """By night python -m tests.verification.genuine draws a thousand."""
    verdicts, faults = run(1, _SEED, only=(kind,))
    assert not faults
    assert sum(verdicts[f"{kind} {text}"] for text in ("held", "not covered")) == 1


def test_a_row_that_is_broken_is_a_fault(monkeypatch: pytest.MonkeyPatch) -> None:
    function, answered = KINDS["sweep"]

    def falsified(value: Any) -> Any:
        return [row | {"force_peak_N": 1.01 * (row["force_peak_N"] or 0.0) + 1.0} for row in answered(value)]

    monkeypatch.setitem(genuine.KINDS, "sweep", Kind(function, falsified))
    verdicts, faults = run(1, _SEED, only=("sweep",))
    assert verdicts == {"sweep broken": 1}
    assert any("force_peak_N" in fault for fault in faults)


def test_a_row_that_computing_breaks_down_for_is_a_fault(monkeypatch: pytest.MonkeyPatch) -> None:
    def broken_down(*_: Any) -> Any:
        raise ArithmeticError("nothing is computed")

    monkeypatch.setattr(rows, "_fill_optima", broken_down)
    monkeypatch.setattr(rows, "_fill_singles", broken_down)
    verdicts, faults = run(1, _SEED, only=("sweep",))
    assert verdicts == {"sweep raised": 1}
    assert all("nothing is computed" in fault for fault in faults)
