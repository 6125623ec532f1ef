"""How many small faults in the code its tests notice: ``nice -n 19 python -m tests.mutation --room guard --count 25``.

The tests of a room run once, and it is noted which lines each of them runs (``tests.mutation.cover``). Each mutant is
written into a copy of the tree. Then the tests that run its line do so again (``tests.mutation.choice``), until one
fails. What no test fails for is listed: a test is missing, or the fault changes nothing (then tests.mutation.equal says
why).
"""

import argparse
import contextlib
import os
import random
import shutil
import signal
import sys
import tempfile
from collections import Counter
from pathlib import Path
from typing import NamedTuple

from tests.mutation import mutants
from tests.mutation.choice import Trial, chosen, places
from tests.mutation.equal import EQUAL
from tests.mutation.line_map import FOLDER, line_map
from tests.mutation.mutants import Mutant

ROOT = Path(__file__).parents[2]
_COPIED = ("schemas", "optimizer", "service", "tests", "examples", "docs", "deploy")
#: seconds of the tests of a room, and of those of a mutant
_ROOM_S, _MUTANT_S = 3600.0, 240.0
#: a test that waits may do so for so many times as long as it may compute
_WAITS = 20
#: loaded once for all mutants
_HEAVY = ("numpy", "numba", "scipy.sparse", "scipy.special", "clarabel", "pydantic", "fastapi", "hypothesis", "pytest")
_OWN = ("schemas", "optimizer", "service", "tests")


class Room(NamedTuple):
    """Files, the tests that are to notice a fault in them, and the least share that they notice."""

    files: str
    tests: tuple[str, ...]
    least: float


ROOMS = {
    "mechanics": Room(
        "optimizer/mechanics/*.py",
        (
            *(f"tests/{room}" for room in ("mechanics", "outputs", "analyze", "scroll", "crankshaft")),
            *(f"tests/optimize/test_{name}.py" for name in ("balance_shafts", "fixed", "roll", "shapes")),
        ),
        0.9,
    ),
    "program": Room(
        "optimizer/program/**/*.py",
        (
            "tests/program",
            *(
                f"tests/optimize/test_{name}.py"
                for name in (
                    "optimize",
                    "few_webs",
                    "min_fitted",
                    "misplaced",
                    "tolerances",
                    "turn_prices",
                    "whole_turn",
                )
            ),
        ),
        0.9,
    ),
    "formulation": Room("optimizer/formulation/*.py", ("tests/optimize", "tests/outputs/test_counterweights.py"), 0.9),
    "verify": Room("examples/client/verify*.py", ("tests/verification",), 0.9),
    "guard": Room(
        "service/guard/*.py",
        tuple(
            f"tests/network/test_{name}.py"
            for name in ("caller", "access", "key_command", "size_limits", "hosts", "users", "accounts")
        ),
        0.9,
    ),
    "leases": Room(
        "service/jobs/coordinator.py",
        tuple(f"tests/jobs/test_{name}.py" for name in ("steps", "coordinator", "store")),
        0.8,
    ),
    "report": Room(
        "service/report/**/*.py",
        ("tests/report_document", "tests/studies/accuracy/test_document.py", "tests/optimize/test_alternatives.py"),
        0.8,
    ),
}


def main() -> int:
    """Print survivors as they are found, and a line for each room."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=100, help="mutants of each room, by chance")
    parser.add_argument("--room", choices=ROOMS, action="append", help="all if not given")
    parser.add_argument("--seed", type=int, default=20261125)
    arguments = parser.parse_args()
    for name in _HEAVY:
        __import__(name)
    short = False
    with tempfile.TemporaryDirectory(prefix="counterweight-mutants-") as folder:
        copy = copied(Path(folder))
        for name in arguments.room or ROOMS:
            room = ROOMS[name]
            tests = covering(copy, room, ROOT / FOLDER / f"{name}.json")
            if tests is None:
                print(f"{name:<12} its tests fail without a fault: nothing can be said", flush=True)
                short = True
                continue
            outcomes = Counter[str]()
            for file, mutant in sample(room, arguments.count, arguments.seed):
                outcomes[_outcome(copy, file, mutant, chosen(tests, places(mutant, file, texts(room))))] += 1
                # a run that is ended has said what it knows
                print(f"{name:<12} {dict(outcomes)}", file=sys.stderr, flush=True)
            share = outcomes["killed"] / max(1, outcomes.total())
            print(f"{name:<12} {outcomes['killed']} of {outcomes.total()} noticed, {share:.0%}", flush=True)
            short |= share < room.least
    return int(short)


def sample(room: Room, count: int, seed: int) -> list[tuple[Path, Mutant]]:
    """Mutants of the files of a room by chance."""
    files = texts(room)
    every = [(path, number) for path, text in files.items() for number in range(mutants.count(text))]
    numbers = random.Random(seed).sample(every, min(count, len(every)))
    found = ((path, mutants.mutant(files[path], number)) for path, number in numbers)
    return [
        (file, one) for file, one in found if not {f"{file} {one.of}", f"{file} {one.of}: {one.fault}"} & EQUAL.keys()
    ]


def texts(room: Room) -> dict[Path, str]:
    """Files of a room; compiled loops have references of their own."""
    paths = [path for path in sorted(ROOT.glob(room.files)) if "kernel" not in path.parts]
    return {path.relative_to(ROOT): path.read_text() for path in paths}


def copied(folder: Path) -> Path:
    """The tree with its compiled kernels."""
    for name in _COPIED:
        shutil.copytree(ROOT / name, folder / name, ignore=shutil.ignore_patterns("*.pyc.*", "*.tmp*"), symlinks=True)
    for path in (*ROOT.glob("*.md"), *ROOT.glob("*.toml"), ROOT / "Makefile"):
        shutil.copy(path, folder)
    return folder


def covering(copy: Path, room: Room, notes: Path) -> list[Trial] | None:
    """The tests of a room with the lines that they run; None where one fails without a fault."""

    def run(arguments: list[str], environment: dict[str, str]) -> int:
        return ran(copy, arguments, environment, _ROOM_S)

    return line_map(notes, copy, room.files, room.tests, run)


def noticed(copy: Path, file: Path, text: str, tests: list[str]) -> bool:
    """Whether a test fails, or does not end, when a file has another text."""
    original = (copy / file).read_text()
    (copy / file).write_text(text)
    try:
        return bool(tests) and ran(copy, ["-x", *tests], {}, _MUTANT_S) != 0
    finally:
        (copy / file).write_text(original)


def ran(copy: Path, arguments: list[str], environment: dict[str, str], seconds: float) -> int:
    """Exit code of pytest in a process of its own, which has loaded what is heavy; not 0 where it does not end."""
    sys.stdout.flush()
    child = os.fork()
    if child == 0:
        os.setsid()
        # of computing, so that a busy machine makes no fault noticed; what waits for ever ends too
        for ended in (signal.SIGALRM, signal.SIGPROF):
            signal.signal(ended, signal.SIG_DFL)
        signal.setitimer(signal.ITIMER_PROF, seconds)
        signal.alarm(_WAITS * int(seconds))
        os._exit(_pytest(copy, arguments, environment))
    _, status = os.waitpid(child, 0)
    with contextlib.suppress(ProcessLookupError):
        # what a test has left behind
        os.killpg(child, signal.SIGKILL)
    return os.waitstatus_to_exitcode(status)


def _pytest(copy: Path, arguments: list[str], environment: dict[str, str]) -> int:
    """Of the child: nothing of the tree itself is loaded before."""
    try:
        os.environ.update(environment, PYTHONPATH=str(copy), PYTHONDONTWRITEBYTECODE="1", CHECKED_ANSWERS="every")
        os.chdir(copy)
        sys.dont_write_bytecode = True
        sys.path[:] = [str(copy), *(one for one in sys.path if one not in ("", str(ROOT)))]
        for name in [one for one in sys.modules if one.partition(".")[0] in _OWN]:
            del sys.modules[name]
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, 1)
        os.dup2(nowhere, 2)
        import pytest

        options = ["-q", "-n", "0", "-m", "not nightly", "-p", "no:cacheprovider", "-W", "ignore"]
        return int(pytest.main([*options, *arguments]))
    except BaseException:
        return 99


def _outcome(copy: Path, file: Path, mutant: Mutant, tests: list[str]) -> str:
    if noticed(copy, file, mutant.text, tests):
        return "killed"
    why = f"{len(tests)} tests run it" if tests else "no test runs it"
    print(f"    survives: {file}:{mutant.line} {mutant.of}: {mutant.fault} ({why})", flush=True)
    return "survived"


if __name__ == "__main__":
    sys.exit(main())
