"""How many small faults in the code its tests notice: ``nice -n 19 python -m tests.mutation --room guard --count 25``.

The tests of a room run once, and it is noted which lines each of them runs (``tests.mutation.cover``). Each mutant is
written into a copy of the tree. Then the tests that run its line do so again (``tests.mutation.choice``), until one
fails. What no test fails for is listed: a test is missing, or the fault changes nothing (then tests.mutation.equal says
why).
"""

import argparse
import random
import shutil
import sys
import tempfile
from collections import Counter
from itertools import islice
from pathlib import Path
from typing import NamedTuple

from tests.mutation import mutants
from tests.mutation.choice import Trial, chosen, places
from tests.mutation.equal import EQUAL
from tests.mutation.line_map import FOLDER, line_map
from tests.mutation.mutants import Mutant
from tests.mutation.runs import ROOM_S, Loaded, load_what_is_heavy, noticed, ran

ROOT = Path(__file__).parents[2]
_COPIED = ("schemas", "optimizer", "service", "tests", "examples", "docs", "deploy")


class Room(NamedTuple):
    """Files, the tests that are to notice a fault in them, and the least share that they notice."""

    files: str
    tests: tuple[str, ...]
    least: float


_JOBS = tuple(
    f"tests/jobs/test_{name}.py" for name in ("leases", "steps", "coordinator", "store", "damage", "races", "schema")
)

ROOMS = {
    "mechanics": Room(
        "optimizer/mechanics/*.py",
        (
            *(f"tests/{room}" for room in ("mechanics", "outputs", "analyze", "scroll")),
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
    "formulation": Room(
        "optimizer/formulation/*.py",
        ("tests/formulation", "tests/optimize", "tests/outputs/test_counterweights.py"),
        0.9,
    ),
    "verify": Room("examples/client/verify*.py", ("tests/verification",), 0.9),
    "guard": Room(
        "service/guard/*.py",
        tuple(
            f"tests/network/test_{name}.py"
            for name in ("caller", "access", "key_command", "key_file", "size_limits", "hosts", "users", "accounts")
        ),
        0.9,
    ),
    "leases": Room("service/jobs/leases.py", _JOBS, 0.8),
    "coordinator": Room("service/jobs/coordinator.py", _JOBS, 0.8),
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
    parser.add_argument("--tests", action="append", help="these alone, instead of those of the room")
    parser.add_argument("--seconds", type=float, default=45.0, help="of the tests that a mutant meets")
    parser.add_argument("--seed", type=int, default=20261125)
    arguments = parser.parse_args()
    load_what_is_heavy()
    short = False
    with tempfile.TemporaryDirectory(prefix="counterweight-mutants-") as folder:
        copy = copied(Path(folder))
        for name in arguments.room or ROOMS:
            room = ROOMS[name]
            if arguments.tests:
                room = room._replace(tests=tuple(arguments.tests))
            tests = covering(copy, room, ROOT / FOLDER / f"{name}.json")
            if tests is None:
                print(f"{name:<12} its tests fail without a fault: nothing can be said", flush=True)
                short = True
                continue
            outcomes = Counter[str]()
            files = texts(room)
            with Loaded(copy, room.tests, room.files) as loaded:
                for file, mutant in sample(room, arguments.count, arguments.seed):
                    run = chosen(tests, places(mutant, file, files), arguments.seconds)
                    outcomes[_outcome(copy, file, mutant, run, loaded)] += 1
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
    random.Random(seed).shuffle(every)
    values = ((path, mutants.mutant(files[path], number)) for path, number in every)
    unequal = (
        (file, mutant)
        for file, mutant in values
        if not {f"{file} {mutant.of}", f"{file} {mutant.of}: {mutant.fault}"} & EQUAL.keys()
    )
    return list(islice(unequal, count))


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
        return ran(copy, arguments, environment, ROOM_S)

    return line_map(notes, copy, room.files, room.tests, run)


def _outcome(copy: Path, file: Path, mutant: Mutant, tests: list[str], loaded: Loaded) -> str:
    if noticed(copy, file, mutant.text, tests, loaded):
        return "killed"
    why = f"{len(tests)} tests run it" if tests else "no test runs it"
    print(f"    survives: {file}:{mutant.line} {mutant.of}: {mutant.fault} ({why})", flush=True)
    return "survived"


if __name__ == "__main__":
    sys.exit(main())
