"""Which process gets which tests."""

import pytest

from tests.distribution import (
    HALVES,
    LONG,
    TESTS,
    TOGETHER,
    WAITING,
    Distribution,
    begins_with_what_waits,
    divides,
    waits,
)


def taken(collection: list[str], *waiting: bool) -> list[list[str]]:
    """The tests that processes get one after the other, which want tests that wait, or others."""
    distribution = Distribution(collection)
    return [[collection[place] for place in distribution.take(verdict)] for verdict in waiting]


def names(file: str, count: int) -> list[str]:
    return [f"tests/{file}::test_{number}" for number in range(count)]


@pytest.mark.parametrize(("processes", "computing"), [(2, 1), (4, 1), (7, 2)])
def test_some_compute_from_the_beginning(processes: int, computing: int) -> None:
    assert [begins_with_what_waits(number) for number in range(processes)].count(False) == computing


def test_some_begin_with_what_waits_and_others_with_what_computes() -> None:
    files = {"mechanics/test_rod.py": 40, "jobs/test_store.py": 4, "schemas/test_units.py": 9, "network/test_cut.py": 5}
    collection = [name for file, count in files.items() for name in names(file, count)]
    units = taken(collection, True, False, True, False, True)
    assert [{text.split("::")[0].removeprefix("tests/") for text in unit} for unit in units] == [
        {"network/test_cut.py"}, {"mechanics/test_rod.py"}, {"jobs/test_store.py"}, {"schemas/test_units.py"}, set(),
    ]  # fmt: skip


def test_a_shared_server_is_started_by_one_process_and_what_is_long_comes_first() -> None:
    pages = [*names("browser/test_form.py", 3), *names("browser/test_link.py", 2)]
    collection = [*names("network/test_cut.py", 30), *pages, *names("program/test_cone.py", 30)]
    assert taken(collection, True, False) == [pages, collection[-30:]]


def test_a_folder_that_would_end_last_is_run_by_two() -> None:
    halves = names("browser/test_form.py", 3), [*names("browser/test_paper.py", 1), *names("browser/test_trials.py", 2)]
    computing = names("program/test_cone.py", 30)
    assert taken([*halves[0], *halves[1], *computing], True, False, True) == [halves[1], computing, halves[0]]


def test_who_wants_tests_that_wait_gets_others_when_there_are_none() -> None:
    collection = [*names("program/test_cone.py", 3), *names("jobs/test_store.py", 2)]
    assert taken(collection, True, True) == [collection[3:], collection[:3]]
    assert taken(collection, False, False) == [collection[:3], collection[3:]]


def test_nothing_is_left_or_taken_twice() -> None:
    collection = [name for number in range(9) for name in names(f"jobs/test_{number}.py", 1 + number % 4)]
    units = taken(collection, *[True, False] * 5)
    assert units[-1] == []
    assert sorted(text for unit in units for text in unit) == sorted(collection)


@pytest.mark.parametrize("name", [*LONG, *WAITING, *TOGETHER, *HALVES.values()])
def test_what_is_named_is_there(name: str) -> None:
    assert (TESTS / name).exists()


def test_who_shares_a_server_stays_together() -> None:
    names = ("tests/browser/test_form.py", "tests/browser/test_trials.py", "tests/jobs/test_store.py")
    assert [divides(f"{name}::test_1") for name in names] == [False, False, True]


def test_whether_any_waits_is_known_before() -> None:
    assert Distribution([*names("program/test_cone.py", 2), *names("jobs/test_store.py", 1)]).waits
    assert not Distribution(names("program/test_cone.py", 2)).waits


def test_a_file_may_wait_where_its_folder_computes() -> None:
    assert [waits(f"studies/accuracy/test_{name}.py") for name in ("service", "ladder")] == [True, False]


def test_both_kinds_are_there() -> None:
    assert {waits(name) for name in LONG} == {True, False}
