"""What is loaded before a service says that it is ready."""

import subprocess
import sys
from importlib import import_module
from pathlib import Path

import pytest

from optimizer.choices.discrete.kernel import near_sums
from optimizer.compile_kernels import any_limits, budgets, misplacements, moving_curves, proofs
from optimizer.compile_kernels import near_sums as sums
from optimizer.mechanics.kernel import entry
from optimizer.numerics.kernel import circle, knapsack, meeting
from optimizer.numerics.kernel import sums as of_forces
from optimizer.program.kernel import (
    bounds,
    cancelling,
    disc_forms,
    discs,
    interior_point,
    judging,
    outlines,
    regions,
    settling,
    symmetries,
    values,
)
from optimizer.responses.kernel import motion
from optimizer.responses.kernel import outlines as of_curves
from optimizer.studies.matching.kernel import halves
from optimizer.warm_up import follow_a_turn, match_parts, plain_discs, warm_up

#: what most answers need, and what few do: it takes longer than all else
_NEEDED, _SELDOM = {"numba", "clarabel"}, {"cvxpy", "scipy.sparse", "scipy.spatial", "scipy.optimize", "openpyxl"}


def test_what_most_answers_need_has_run_and_nothing_else_is_loaded() -> None:
    """In a process of its own, as nothing may be loaded by another test."""
    code = "import sys; from service.workers import preload; print(preload.failure, *sys.modules)"
    ran = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=300, check=True)
    failure, *loaded = ran.stdout.split()
    assert failure == "None"
    assert (_NEEDED | _SELDOM) & set(loaded) == _NEEDED


def test_an_ordinary_answer_loads_no_scipy() -> None:
    """Its packages take some tenths of a second to load, which the first answer of a process would wait for."""
    code = "import sys; from optimizer.warm_up import plain_discs; plain_discs(); print(*sys.modules)"
    ran = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=300, check=True)
    assert {"numba", "scipy.linalg", "scipy.special"} & set(ran.stdout.split()) == {"numba"}


def test_what_is_compiled_is_what_answers_need() -> None:
    """Of other types it would be kept twice: once as it is compiled, once as it is called."""
    budgets()
    any_limits()
    follow_a_turn()
    misplacements()
    moving_curves()
    plain_discs()
    proofs()
    match_parts()
    sums()
    warm_up()
    version = f"py{sys.version_info.major}{sys.version_info.minor}"
    entries = {
        interior_point: ("run",),
        discs: ("solve",),
        bounds: ("bounds", "minorants"),
        judging: ("judge",),
        regions: ("bring",),
        values: ("values",),
        settling: ("rebalance", "settle"),
        symmetries: ("means",),
        outlines: ("worst_scaled", "worst_rotation"),
        cancelling: ("least_changes", "least_changes_of_real"),
        disc_forms: ("forms", "pairs", "scales"),
        entry: ("_over_turn",),
        knapsack: ("filled",),
        of_forces: ("force_and_couple",),
        circle: ("smallest",),
        of_curves: ("circles", "farthest", "nearer", "outlines"),
        motion: ("in_motion",),
        halves: ("best_below",),
        meeting: ("met",),
        near_sums: ("gridded", "near"),
    }
    for module, names in entries.items():
        parent = Path(str(module.__file__)).parent / "__pycache__"
        for name in names:
            file = Path(str(module.__file__)).stem
            assert len(list(parent.glob(f"{file}.{name}-*.{version}.*.nbc"))) <= 1, name


#: as `make` compiles kernels, then as a service warms up; what that had compiled beside them
_FIRST_START = """
import gc
from numba.core.dispatcher import Dispatcher
from optimizer.compile_kernels import PARTS, budgets
from optimizer.warm_up import warm_up

def compiled():
    entries = [entry for entry in gc.get_objects() if isinstance(entry, Dispatcher)]
    return {(entry.py_func.__qualname__, signature) for entry in entries for signature in entry.signatures}

budgets()
for parts in PARTS:
    for part in parts:
        part()
before = compiled()
warm_up()
print(len(before), *(name for name, _ in compiled() - before))
"""


def test_a_first_start_compiles_nothing() -> None:
    """In a process of its own, as other tests have kernels compiled."""
    command = [sys.executable, "-c", _FIRST_START]
    count, *late = subprocess.run(command, capture_output=True, text=True, timeout=300, check=True).stdout.split()
    assert int(count) > 20
    # of floors over the turn it is a part, and kept with them
    assert set(late) <= {"smallest"}


def test_a_wrong_answer_is_not_ready(monkeypatch: pytest.MonkeyPatch) -> None:
    def always(request: object) -> object:
        return type("Answer", (), {"status": "inaccurate"})

    monkeypatch.setattr(import_module("optimizer.optimize"), "optimize", always)
    with pytest.raises(RuntimeError, match="answered inaccurate"):
        warm_up()
