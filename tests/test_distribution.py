"""Which process gets which tests."""

from types import SimpleNamespace
from typing import Any

import pytest

from tests.distribution import HALVES, LONG, TESTS, TOGETHER, WAITING, Distribution, waits


class Node:
    """A process that notes which tests it is sent."""

    shutting_down = False

    def __init__(self, collection: list[str], name: str) -> None:
        self.collection = collection
        self.gateway = SimpleNamespace(id=name)
        self.sent: list[str] = []

    def send_runtest_some(self, places: list[int]) -> None:
        self.sent += [self.collection[place] for place in places]

    def shutdown(self) -> None:
        self.shutting_down = True


def distributed(collection: list[str], processes: int) -> tuple[Distribution, list[Node]]:
    options = {"tx": [f"{processes}*popen"], "dist": "loadfile"}
    config: Any = SimpleNamespace(getvalue=options.get, option=SimpleNamespace(loadscopereorder=True))
    found = Distribution(config)
    nodes = [Node(collection, f"gw{number}") for number in range(processes)]
    for node in nodes:
        found.add_node(node)
    for node in nodes:
        found.add_node_collection(node, collection)
    found.schedule()
    return found, nodes


def names(file: str, count: int) -> list[str]:
    return [f"tests/{file}::test_{number}" for number in range(count)]


def test_half_begin_with_what_waits_and_half_with_what_computes() -> None:
    files = {"mechanics/test_rod.py": 40, "jobs/test_store.py": 4, "schemas/test_units.py": 9, "network/test_cut.py": 5}
    _, nodes = distributed([one for file, count in files.items() for one in names(file, count)], 4)
    assert [node.sent[0].split("::")[0].removeprefix("tests/") for node in nodes] == [
        "network/test_cut.py", "mechanics/test_rod.py", "jobs/test_store.py", "schemas/test_units.py",
    ]  # fmt: skip


def test_a_shared_server_is_started_by_one_process_and_what_is_long_comes_first() -> None:
    pages = [*names("browser/test_form.py", 3), *names("browser/test_link.py", 2)]
    collection = [*names("network/test_cut.py", 30), *pages, *names("program/test_cone.py", 30)]
    _, nodes = distributed(collection, 2)
    assert nodes[0].sent == pages
    assert nodes[1].sent == collection[-30:]


def test_a_folder_that_would_end_last_is_run_by_two() -> None:
    halves = names("browser/test_form.py", 3), [*names("browser/test_paper.py", 1), *names("browser/test_trials.py", 2)]
    _, nodes = distributed([*halves[0], *halves[1], *names("program/test_cone.py", 30)], 4)
    assert [node.sent for node in nodes[:3]] == [halves[1], names("program/test_cone.py", 30), halves[0]]


def test_nothing_is_left_or_sent_twice() -> None:
    collection = [one for number in range(9) for one in names(f"jobs/test_{number}.py", 1 + number % 4)]
    found, nodes = distributed(collection, 3)
    while not found.tests_finished:
        for node in nodes:
            done = [place for unit in found.assigned_work[node].values() for place, ended in unit.items() if not ended]
            if done:
                found.mark_test_complete(node, collection.index(done[0]))
    assert sorted(one for node in nodes for one in node.sent) == sorted(collection)


@pytest.mark.parametrize("name", [*LONG, *WAITING, *TOGETHER, *HALVES.values()])
def test_what_is_named_is_there(name: str) -> None:
    assert (TESTS / name).exists()


def test_both_kinds_are_there() -> None:
    assert {waits(name) for name in LONG} == {True, False}
