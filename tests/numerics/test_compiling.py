"""Machine code that is kept from one process to the next."""

import importlib
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

_CODE = """
from typing import NamedTuple

from optimizer.numerics.compiling import kernel


class Pair(NamedTuple):
    first: float
    second: float


@kernel
def total(pair):
    return pair.first + pair.second
"""


def test_what_is_kept_of_types_that_are_no_more_is_compiled_anew(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    # an upgrade leaves such files behind; by time and size of its source this one looks as it did
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.setattr(sys, "dont_write_bytecode", True)
    source = tmp_path / "kept_kernel.py"
    for name in ("Pair", "Both"):
        source.write_text(_CODE.replace("Pair", name), "utf-8")
        os.utime(source, (1e9, 1e9))
        monkeypatch.delitem(sys.modules, "kept_kernel", raising=False)
        importlib.invalidate_caches()
        module = importlib.import_module("kept_kernel")
        assert module.total(getattr(module, name)(1.5, 2.0)) == 3.5
        (index,) = (tmp_path / "__pycache__").glob("kept_kernel.total-*.nbi")
        assert name.encode() in index.read_bytes()


_LINKED = """
from optimizer.numerics.compiling import kernel


@kernel
def doubled(values):
    return 2.0 * values


@kernel
def quadrupled(values):
    return doubled(doubled(values))
"""


def test_a_kernel_is_linked_with_one_that_was_kept(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.setattr(sys, "dont_write_bytecode", True)
    (tmp_path / "linked_kernels.py").write_text(_LINKED, "utf-8")
    values = np.array([1.0, 2.5])
    # analytic; the second time what was called the first time has been kept
    for name, factor, count in (("doubled", 2.0, 0), ("quadrupled", 4.0, 1)):
        monkeypatch.delitem(sys.modules, "linked_kernels", raising=False)
        module = importlib.import_module("linked_kernels")
        assert getattr(module, name)(values).tolist() == (factor * values).tolist()
        assert sum(module.doubled.stats.cache_hits.values()) == count


def test_an_answer_reads_nothing_that_only_a_compiler_reads() -> None:
    """In a process of its own, as other tests compile."""
    code = (
        "import sys\n"
        "from llvmlite import binding\n"
        "from numba.core.runtime import nrtdynmod\n"
        "binding.parse_bitcode = nrtdynmod.compile_nrt_functions = None\n"
        "from optimizer.warm_up import warm_up\n"
        "warm_up()\n"
        "assert 'numba.np.arrayobj' not in sys.modules"
    )
    subprocess.run([sys.executable, "-c", code], timeout=300, check=True)
