"""The faults that are put in, and that a run tells a noticed one from one that nobody notices."""

from pathlib import Path

import pytest

from tests.mutation.__main__ import ROOMS, ROOT, Room, covering, sample
from tests.mutation.choice import Trial, chosen, places
from tests.mutation.equal import EQUAL
from tests.mutation.mutants import count, mutant, names
from tests.mutation.runs import Loaded, noticed

SOURCE = """
def largest(values: list[float], low: float = 2.0) -> float:
    \"\"\"The largest value, not below 3.\"\"\"
    return max(low, *values) - 1 if values else -low
"""


def test_each_fault_once_and_none_in_what_is_not_computed() -> None:
    faults = [mutant(SOURCE, number).fault for number in range(count(SOURCE))]
    assert sorted(faults) == sorted(
        [
            "2.0 -> 2.021",
            "max(low, *values) - 1 -> max(low, *values) + 1",
            "max -> min",
            "max(low, *values) - 1 -> max(low, *values) - 2",
            "-low -> +low",
        ]
    )


def test_a_mutant_differs_in_its_fault_alone() -> None:
    mutants = [mutant(SOURCE, number) for number in range(count(SOURCE))]
    assert len({element.text for element in mutants}) == len(mutants)
    assert all(fault.line in (2, 4) for fault in mutants)
    assert {fault.lines for fault in mutants} == {frozenset({2}), frozenset({4})}
    assert mutant("LIMIT = 3", 0).lines == frozenset()


@pytest.mark.parametrize("name", ROOMS)
def test_every_room_has_mutants_and_tests(name: str) -> None:
    room = ROOMS[name]
    assert len(sample(room, 2, 1)) == 2
    assert all((ROOT / tests).exists() for tests in room.tests)


_LINES = frozenset({1})


def test_tests_that_run_a_line_are_chosen_the_shortest_first() -> None:
    used = {"coded.py": _LINES}
    tests = [Trial("a::short", 0.1, used), Trial("b::elsewhere", 0.2, {"coded.py": frozenset({9})})]
    assert chosen([*tests, Trial("c::long", 50.0, used)], used, 45.0) == ["a::short"]
    assert chosen([Trial("c::long", 50.0, used)], used, 45.0) == ["c::long"]
    assert chosen(tests, {"other.py": _LINES}, 45.0) == []
    # of what is used nobody knows where, any: those first that run its file
    beside = Trial("d::beside", 0.3, {"other.py": _LINES})
    assert chosen([*tests, beside], {"other.py": frozenset()}, 45.0) == ["d::beside", "a::short", "b::elsewhere"]


def test_every_file_of_tests_has_its_turn() -> None:
    used = {"coded.py": _LINES}
    many = [Trial(f"a::{number}", 1.0 + 0.001 * number, used) for number in range(60)]
    choice = chosen([*many, Trial("b::longer", 6.0, used)], used, 45.0)
    assert "b::longer" in choice
    assert choice[:3] == ["a::0", "a::1", "a::2"]


def test_others_of_a_file_may_look_at_what_the_first_has_computed() -> None:
    """A fixture of the file, or a result that is kept: only the first test runs the lines."""
    used = {"coded.py": _LINES}
    first, second = Trial("a::first", 2.0, used), Trial("a::second", 0.1, {})
    assert sorted(chosen([second, first, Trial("b::other", 0.1, {})], used, 45.0)) == ["a::first", "a::second"]
    assert chosen([Trial("a::second", 0.1, {}, used), Trial("b::other", 0.1, {})], used, 45.0) == ["a::second"]


def test_a_constant_is_where_it_is_used() -> None:
    texts = {
        Path("coded.py"): "LIMIT = 3\nTWICE = 2 * LIMIT\n\n\ndef f():\n    return TWICE\n",
        Path("other.py"): "from coded import LIMIT\n\n\ndef g():\n    return LIMIT\n",
    }
    of = mutant(texts[Path("coded.py")], 0)
    assert (of.of, of.lines) == ("LIMIT", frozenset())
    assert places(of, Path("coded.py"), texts) == {"coded.py": frozenset({6}), "other.py": frozenset({5})}


@pytest.mark.nightly
def test_what_is_noticed(tmp_path: Path) -> None:
    """A test of a tree: which lines it runs, and that it fails for one fault and not for the other."""
    (tmp_path / "tests").symlink_to(ROOT / "tests")
    (tmp_path / "coded.py").write_text("def limit():\n    return 3\n\n\ndef spare():\n    return 1\n")
    (tmp_path / "test_coded.py").write_text("from coded import limit\n\n\ndef test_limit():\n    assert limit() == 3\n")
    file, test = Path("coded.py"), "test_coded.py::test_limit"
    assert noticed(tmp_path, file, "def limit():\n    return 4\n", [test])
    assert not noticed(tmp_path, file, "def limit():\n    return 3\n", [test])
    assert not noticed(tmp_path, file, "def limit():\n    return 4\n", [])
    assert (tmp_path / file).read_text().startswith("def limit():\n    return 3\n")
    notes = tmp_path / "notes" / "room.json"
    room = Room("coded.py", ("test_coded.py",), 0.9)
    trials = covering(tmp_path, room, notes)
    assert trials is not None
    assert [(trial.name, trial.lines) for trial in trials] == [(test, {"coded.py": frozenset({1, 2})})]
    noted = notes.read_text()
    assert covering(tmp_path, room, notes) == trials
    assert notes.read_text() == noted
    (tmp_path / file).write_text("def limit():\n    return 4\n")
    assert covering(tmp_path, room, notes) is None
    assert notes.read_text() == "{}"


def test_what_serves_a_file_is_noted_for_all_its_tests(tmp_path: Path) -> None:
    (tmp_path / "tests").symlink_to(ROOT / "tests")
    (tmp_path / "coded.py").write_text("def limit():\n    return 3\n\n\ndef other():\n    return 1\n")
    (tmp_path / "test_coded.py").write_text(
        "import pytest\nfrom coded import limit, other\n\nONE = other()\n\n\n"
        "@pytest.fixture(scope='module')\ndef three():\n    return limit()\n\n\n"
        "def test_first(three):\n    pass\n\n\ndef test_second(three):\n    assert three == 3\n"
    )
    trials = covering(tmp_path, Room("coded.py", ("test_coded.py",), 0.9), tmp_path / "notes" / "room.json")
    assert trials is not None
    assert [trial.lines for trial in trials] == [{"coded.py": frozenset({1, 2})}, {}]
    assert {frozenset(trial.shared["coded.py"]) for trial in trials} == {frozenset({1, 2, 5, 6})}


_CODED = """START = 3


def first():
    return START


LIMIT = first()


def above(x, least=1):
    return x > LIMIT + least
"""


@pytest.mark.nightly
def test_a_fault_in_what_is_loaded_is_noticed_as_one_that_is_imported(tmp_path: Path) -> None:
    """A function is given other code; what importing has called, tables and defaults are imported again."""
    (tmp_path / "tests").symlink_to(ROOT / "tests")
    (tmp_path / "coded.py").write_text(_CODED)
    (tmp_path / "test_coded.py").write_text(
        "from coded import above\n\n\ndef test_above():\n    assert [above(4), above(5)] == [False, True]\n"
    )
    file, test = Path("coded.py"), "test_coded.py::test_above"
    faults = {mutant(_CODED, number).fault: mutant(_CODED, number).text for number in range(count(_CODED))}
    with Loaded(tmp_path, ["test_coded.py"], "coded.py") as loaded:
        again = {fault: loaded.ran(file, _CODED, text, [test]) is None for fault, text in faults.items()}
        assert [fault for fault, verdict in again.items() if verdict] == ["3 -> 4", "1 -> 2"]
        assert all(noticed(tmp_path, file, text, [test], loaded) for text in faults.values())
        assert not noticed(tmp_path, file, _CODED.replace("x > LIMIT + least", "LIMIT + least < x"), [test], loaded)
        assert noticed(tmp_path, file, _CODED.replace("return START", "return START + 1"), [test], loaded)
        assert loaded.ran(file, _CODED, _CODED.replace("return START", "return START + 1"), [test]) is None


@pytest.mark.parametrize("file", sorted({key.partition(" ")[0] for key in EQUAL}))
def test_what_changes_nothing_is_told_of_mutants_that_there_are(file: str) -> None:
    labels = {name for key in EQUAL for where, _, name in [key.partition(" ")] if where == file}
    assert labels <= names((ROOT / file).read_text())


def test_numbers_of_one_function_are_told_apart() -> None:
    """What is said of one of them hides no other."""
    labels = names("def f(a):\n    return g(a, 0) + (a[0] if a > 0 else -0)\n")
    assert {"f: g(a, 0) -> g(a, 1)", "f: a[0] -> a[1]", "f: a > 0 -> a > 1"} <= labels


def test_fields_of_one_function_are_told_apart() -> None:
    labels = names("def f(a, b):\n    return np.maximum(np.max(a), np.max(b)) + a.lower[-1]\n")
    assert {"f: np.max(a) -> np.min(a)", "f: np.max(b) -> np.min(b)"} <= labels
    assert {"f: a.lower[-1] -> a.upper[-1]", "f: a.lower[-1] -> a.lower[+1]"} <= labels


def test_the_length_that_numpy_finds_is_no_number() -> None:
    """Of any negative one it is the same; the sign counts."""
    labels = names("def f(a):\n    return a.reshape(-1), a.reshape(3, -1), a.sum(-1), a.reshape(1, a[-1])\n")
    assert {"f: a.reshape(-1) -> a.reshape(+1)", "f: a.sum(-1) -> a.sum(-2)", "f: a[-1] -> a[-2]"} <= labels
    assert not any("-2)" in label for label in labels if "reshape" in label)
