"""Machine code that is kept from one process to the next."""

import importlib
import os
import sys
from pathlib import Path

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
