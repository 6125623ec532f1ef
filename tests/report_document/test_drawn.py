"""How pictures look: every shape of them, with its place, its size and its colour (regression).

After a change that is wanted: ``python -m tests.report_document.drawn > tests/report_document/drawn.txt``, and look.
"""

import pytest

from tests.report_document.drawn import NAMES, TABLE, written

STORED = TABLE.read_text().splitlines()


@pytest.mark.parametrize("name", NAMES)
def test_a_picture_looks_as_it_did(name: str) -> None:
    assert written(name) == [line for line in STORED if line.startswith(f"{name}: ")]


def test_no_other_picture_is_in_the_table() -> None:
    assert {line.partition(": ")[0] for line in STORED} == {*NAMES}
