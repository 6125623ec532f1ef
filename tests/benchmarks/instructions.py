"""What an answer costs a core, counted: ``python -m tests.benchmarks.instructions``.

valgrind counts instructions, and misses of caches of the size of a server's core. No neighbour disturbs a count, so a
change of one per cent shows on a busy machine. valgrind must be installed (Debian: ``valgrind``). It knows no AVX-512,
so kernels are compiled once more, into a folder of their own.
"""

import argparse
import gc
import json
import os
import shutil
import subprocess
import sys
from collections import defaultdict
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

from rich.console import Console
from rich.table import Table

from optimizer.analyze import analyze
from optimizer.optimize import optimize
from schemas.request.requests import AnalyzeRequest, OptimizeRequest
from service.common.answer_bytes import json_bytes
from tests.benchmarks.cases import example
from tests.benchmarks.outputs import RECIPROCATING, sixteen_rows
from tests.commands import ROOT

_UNDER_VALGRIND = "COUNTERWEIGHT_BENCHMARK_UNDER_VALGRIND"
#: first instructions, first data and second level, of a server's core: bytes, ways, bytes of a line
_CACHES = ("--I1=32768,8,64", "--D1=49152,12,64", "--LL=2097152,16,64")
#: what valgrind knows of a processor, as numba names it
_PROCESSOR = {
    "NUMBA_CPU_NAME": "haswell",
    "NUMBA_CPU_FEATURES": "+64bit,+avx,+avx2,+bmi,+bmi2,+cmov,+f16c,+fma,+lzcnt,+movbe,+popcnt,+sse4.1,+sse4.2,+ssse3",
}


def _all_outputs() -> bytes:
    return json.dumps(json.loads(example("2d12")()) | {"outputs": RECIPROCATING}).encode()


def _optimum(body: bytes) -> bytes:
    return json_bytes(optimize(OptimizeRequest.model_validate_json(body)))


def _analysis(body: bytes) -> bytes:
    return json_bytes(analyze(AnalyzeRequest.model_validate_json(body)))


CASES: dict[str, tuple[Callable[[bytes], bytes], Callable[[], bytes]]] = {
    "ordinary": (_optimum, example("2d12")),
    "all-outputs": (_optimum, _all_outputs),
    "sixteen-rows": (
        _analysis,
        lambda: json.dumps({"machine": sixteen_rows(), "outputs": RECIPROCATING}).encode(),
    ),
}


@dataclass
class Cost:
    """Of one answer, or of the part of it that a library has.

    first_instructions, first_data : misses of the first level.
    second : misses of the second level, of instructions and data.
    """

    instructions: float = 0.0
    first_instructions: float = 0.0
    first_data: float = 0.0
    second: float = 0.0

    def add(self, events: dict[str, int], answers: int) -> None:
        """Add a line of counts, by name of the event."""
        self.instructions += events.get("Ir", 0) / answers
        self.first_instructions += events.get("I1mr", 0) / answers
        self.first_data += (events.get("D1mr", 0) + events.get("D1mw", 0)) / answers
        self.second += sum(events.get(name, 0) for name in ("ILmr", "DLmr", "DLmw")) / answers


def by_library(lines: Iterable[str], answers: int) -> dict[str, Cost]:
    """Read a file of counts of callgrind: what each library cost itself, for one answer.

    Source: manual of valgrind, "Callgrind Format Specification". A number behind a name in parentheses stands for it
    from then on. The line behind "calls=" counts what was called, which has its own lines.
    """
    names: dict[str, str] = {}
    costs: dict[str, Cost] = defaultdict(Cost)
    events: list[str] = []
    library, of_calls = "", False
    for line in lines:
        kind, _, value = line.rstrip("\n").partition("=")
        if line.startswith("events:"):
            events = line.split()[1:]
        elif kind in ("ob", "cob"):
            number, _, name = value.partition(" ")
            names[number] = name or names[number]
            library = Path(names[number]).name if kind == "ob" else library
        elif kind == "calls":
            of_calls = True
        elif line[:1].isdigit() or line[:1] in ("+", "-", "*"):
            if not of_calls:
                costs[library].add(dict(zip(events, map(int, line.split()[1:]), strict=False)), answers)
            of_calls = False
    return dict(costs)


def measure(case: str, answers: int, cache: Path) -> dict[str, Cost]:
    """Count what answers cost that follow others of their kind.

    Raises
    ------
    CalledProcessError
        if valgrind or the computation fails.
    """
    command = [sys.executable, "-m", "tests.benchmarks.instructions", "--case", case, "--answers", str(answers)]
    environment = os.environ | _PROCESSOR | {"NUMBA_CACHE_DIR": str(cache), "OPENBLAS_NUM_THREADS": "1"}
    with TemporaryDirectory(prefix="counterweight-instructions-") as folder:
        counts = Path(folder) / "counts"
        subprocess.run(command, check=True, cwd=ROOT, env=environment | {_UNDER_VALGRIND: "0"})
        valgrind = ["valgrind", "--quiet", f"--log-file={folder}/log", "--tool=callgrind", "--instr-atstart=no"]
        caches = ["--cache-sim=yes", *_CACHES, f"--callgrind-out-file={counts}"]
        subprocess.run([*valgrind, *caches, *command], check=True, cwd=ROOT, env=environment | {_UNDER_VALGRIND: "1"})
        with counts.open() as lines:
            return by_library(lines, answers)


def _control(*switches: str) -> None:
    subprocess.run(["callgrind_control", *switches, str(os.getpid())], check=True, capture_output=True)


def warm_answers(case: str, answers: int, counted: bool) -> None:
    """What runs under valgrind: answers that make things warm, then those that count."""
    answer, body = CASES[case]
    content = body()
    for _ in range(4):
        answer(content)
    gc.collect()
    gc.freeze()
    if counted:
        _control("--instr=on")
        for _ in range(3):
            answer(content)
        _control("--zero")
        for _ in range(answers):
            answer(content)
        _control("--instr=off")


def table(case: str, costs: dict[str, Cost]) -> Table:
    """Libraries with most instructions first; those below a hundredth of all count in the last row only."""
    total = sum(cost.instructions for cost in costs.values())
    figures = Table(title=f"one answer, {case}: thousands", title_justify="left")
    for heading in ("", "instructions", "misses of L1, instructions", "misses of L1, data", "misses of L2"):
        figures.add_column(heading, justify="left" if heading == "" else "right")
    whole = Cost()
    for cost in costs.values():
        for name, count in vars(cost).items():
            setattr(whole, name, getattr(whole, name) + count)
    ordered = sorted(costs.items(), key=lambda pair: -pair[1].instructions)
    large = [(library, cost) for library, cost in ordered if cost.instructions > 0.01 * total]
    for library, cost in [*large, ("all", whole)]:
        name = "compiled kernels" if library in ("", "???") else library
        figures.add_row(name, *(f"{count / 1e3:,.1f}" for count in vars(cost).values()))
    return figures


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--case", choices=CASES, action="append", help="all of them without")
    parser.add_argument("--answers", type=int, default=10, help="that are counted")
    parser.add_argument("--kernels", type=Path, default=ROOT / "build" / "instructions", help="folder of the kernels")
    options = parser.parse_args()
    if _UNDER_VALGRIND in os.environ:
        warm_answers(options.case[0], options.answers, os.environ[_UNDER_VALGRIND] == "1")
        return
    if options.answers < 1:
        parser.error("--answers: at least 1")
    if shutil.which("callgrind_control") is None:
        parser.error("valgrind is not installed (Debian: valgrind)")
    console = Console(width=120)
    console.print("each case takes half a minute, the first one two: kernels are compiled once for valgrind")
    for case in options.case or CASES:
        console.print(table(case, measure(case, options.answers, options.kernels)))


if __name__ == "__main__":
    main()
