"""Regression: what the functions of the program come to, of programs of every kind, to 1e-10."""

import pytest

from tests.night import part
from tests.program.recorded import RECORD


@pytest.mark.parametrize("name", part(3, RECORD.cases))
def test_functions_come_to_what_they_did(name: str) -> None:
    assert RECORD.changes(name)[:4] == []


def test_nothing_is_recorded_that_is_not_tried() -> None:
    assert RECORD.cases.keys() == RECORD.prints.keys()
