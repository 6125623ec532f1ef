"""How many small faults in the code its tests notice: ``python -m tests.mutation --count 300``; hours, for the night.

Each mutant is written into a copy of the tree, and the tests of its room run there until the first fails. What no test
fails for is listed: a test is missing, or the fault changes nothing (then it is said here, in EQUAL, why).
"""

import argparse
import os
import random
import shutil
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path
from typing import NamedTuple

from tests.mutation import mutants
from tests.mutation.mutants import Mutant

ROOT = Path(__file__).parents[2]
_COPIED = ("schemas", "optimizer", "service", "tests", "examples", "docs", "deploy")
_WITHIN_S = 1800.0


class Room(NamedTuple):
    """Files, the tests that are to notice a fault in them, and the least share that they notice."""

    files: str
    tests: tuple[str, ...]
    least: float


ROOMS = {
    "mechanics": Room(
        "optimizer/mechanics/*.py", ("tests/mechanics", "tests/outputs", "tests/examples", "tests/reference"), 0.9
    ),
    "program": Room("optimizer/program/**/*.py", ("tests/program", "tests/optimize/test_optimize.py"), 0.9),
    "formulation": Room("optimizer/formulation/*.py", ("tests/optimize",), 0.9),
    "verify": Room("examples/client/verify*.py", ("tests/verification",), 0.9),
    "guard": Room(
        "service/guard/*.py",
        tuple(
            f"tests/network/test_{name}.py"
            for name in ("access", "key_command", "size_limits", "hosts", "users", "accounts")
        ),
        0.9,
    ),
    "leases": Room("service/jobs/coordinator.py", ("tests/jobs/test_coordinator.py", "tests/jobs/test_store.py"), 0.8),
    "report": Room("service/report/**/*.py", ("tests/report_document",), 0.8),
}
#: faults that change nothing, `file: fault`, each with the reason
EQUAL: dict[str, str] = {}


def main() -> int:
    """Print survivors as they are found, and a line for each room."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=100, help="mutants of each room, by chance")
    parser.add_argument("--room", choices=ROOMS, action="append", help="all if not given")
    parser.add_argument("--seed", type=int, default=20261125)
    arguments = parser.parse_args()
    short = False
    with tempfile.TemporaryDirectory(prefix="counterweight-mutants-") as folder:
        copy = copied(Path(folder))
        for name in arguments.room or ROOMS:
            room = ROOMS[name]
            first = sample(room, 1, arguments.seed)[0][0]
            if noticed(copy, first, (ROOT / first).read_text(), room.tests):
                print(f"{name:<12} its tests fail without a fault: nothing can be said", flush=True)
                short = True
                continue
            outcomes = Counter[str]()
            for file, mutant in sample(room, arguments.count, arguments.seed):
                outcomes[_outcome(copy, file, mutant, room.tests)] += 1
                # a run that is ended has said what it knows
                print(f"{name:<12} {dict(outcomes)}", file=sys.stderr, flush=True)
            share = outcomes["killed"] / max(1, outcomes.total())
            print(f"{name:<12} {outcomes['killed']} of {outcomes.total()} noticed, {share:.0%}", flush=True)
            short |= share < room.least
    return int(short)


def sample(room: Room, count: int, seed: int) -> list[tuple[Path, Mutant]]:
    """Mutants of the files of a room by chance; compiled loops have references of their own."""
    texts = {path: path.read_text() for path in sorted(ROOT.glob(room.files)) if "kernel" not in path.parts}
    places = [(path, number) for path, text in texts.items() for number in range(mutants.count(text))]
    chosen = random.Random(seed).sample(places, min(count, len(places)))
    found = ((path.relative_to(ROOT), mutants.mutant(texts[path], number)) for path, number in chosen)
    return [(file, one) for file, one in found if f"{file}: {one.fault}" not in EQUAL]


def copied(folder: Path) -> Path:
    """The tree with its compiled kernels."""
    for name in _COPIED:
        shutil.copytree(ROOT / name, folder / name, ignore=shutil.ignore_patterns("*.pyc.*", "*.tmp*"), symlinks=True)
    for path in (*ROOT.glob("*.md"), *ROOT.glob("*.toml"), ROOT / "Makefile"):
        shutil.copy(path, folder)
    return folder


def noticed(copy: Path, file: Path, text: str, tests: tuple[str, ...]) -> bool:
    """Whether a test fails, or does not end, when a file has another text."""
    original = (copy / file).read_text()
    tests = (*own_tests(copy, file, tests), *tests)
    (copy / file).write_text(text)
    command = [sys.executable, "-m", "pytest", "-x", "-q", "-m", "not nightly", "-p", "no:cacheprovider", *tests]
    environment = {**os.environ, "PYTHONPATH": str(copy), "CHECKED_ANSWERS": "every"}
    try:
        ran = subprocess.run(command, cwd=copy, env=environment, capture_output=True, timeout=_WITHIN_S, check=False)
    except subprocess.TimeoutExpired:
        return True
    finally:
        (copy / file).write_text(original)
    return ran.returncode != 0


def own_tests(copy: Path, file: Path, tests: tuple[str, ...]) -> tuple[str, ...]:
    """Tests that bear the name of a file, which are the first to notice a fault in it: most mutants end there."""
    found = (path for one in tests for path in sorted((copy / one).rglob(f"test_{file.stem}.py")))
    return tuple(str(path.relative_to(copy)) for path in found)


def _outcome(copy: Path, file: Path, mutant: Mutant, tests: tuple[str, ...]) -> str:
    if noticed(copy, file, mutant.text, tests):
        return "killed"
    print(f"    survives: {file}:{mutant.line}: {mutant.fault}", flush=True)
    return "survived"


if __name__ == "__main__":
    sys.exit(main())
