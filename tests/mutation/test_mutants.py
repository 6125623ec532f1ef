"""The faults that are put in, and that a run tells a noticed one from one that nobody notices."""

from pathlib import Path

import pytest

from tests.mutation.__main__ import ROOMS, ROOT, noticed, own_tests, sample
from tests.mutation.mutants import count, mutant

SOURCE = """
def largest(values: list[float], low: float = 2.0) -> float:
    \"\"\"The largest value, not below 3.\"\"\"
    return max(low, *values) - 1 if values else -low
"""


def test_each_fault_once_and_none_in_what_is_not_computed() -> None:
    faults = [mutant(SOURCE, number).fault for number in range(count(SOURCE))]
    assert sorted(faults) == sorted(
        ["2.0 -> 2.021", "max(low, *values) - 1 -> max(low, *values) + 1", "max -> min", "1 -> 2", "-low -> +low"]
    )


def test_a_mutant_differs_in_its_fault_alone() -> None:
    found = [mutant(SOURCE, number) for number in range(count(SOURCE))]
    assert len({one.text for one in found}) == len(found)
    assert all(one.line in (2, 4) for one in found)


@pytest.mark.parametrize("name", ROOMS)
def test_every_room_has_mutants_and_tests(name: str) -> None:
    room = ROOMS[name]
    assert len(sample(room, 2, 1)) == 2
    assert all((ROOT / tests).exists() for tests in room.tests)


def test_what_is_noticed(tmp_path: Path) -> None:
    code, test = tmp_path / "code.py", tmp_path / "test_code.py"
    code.write_text("LIMIT = 3\nSPARE = 1\n")
    test.write_text("from code import LIMIT\n\ndef test_limit():\n    assert LIMIT == 3\n".replace("code", "coded"))
    code.rename(tmp_path / "coded.py")
    file = Path("coded.py")
    assert noticed(tmp_path, file, "LIMIT = 4\nSPARE = 1\n", ("test_code.py",))
    assert not noticed(tmp_path, file, "LIMIT = 3\nSPARE = 2\n", ("test_code.py",))
    assert (tmp_path / file).read_text() == "LIMIT = 3\nSPARE = 1\n"


def test_the_tests_of_a_file_come_first() -> None:
    tests = ROOMS["mechanics"].tests
    assert own_tests(ROOT, Path("optimizer/mechanics/rod.py"), tests) == ("tests/mechanics/test_rod.py",)
    assert own_tests(ROOT, Path("optimizer/mechanics/layout.py"), tests) == ()
