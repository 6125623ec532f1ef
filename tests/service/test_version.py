"""The processor that an answer names is the one that numba compiles for."""

import os
import subprocess
import sys

import pytest

from service.routes.version import processor
from tests.commands import ROOT
from tests.night import part

_NAMES = ("NUMBA_CPU_NAME", "NUMBA_CPU_FEATURES")
#: what numba compiles for, and what this machine is and has
_USED = """
from llvmlite import binding
from numba.core.codegen import get_host_cpu_features
from numba.core.registry import cpu_target
_, name, features = cpu_target.target_context.codegen().magic_tuple()
own = features == get_host_cpu_features() != ""
print("host" if name == binding.get_host_cpu_name() and own else (name or "generic") + ("+host" if own else ""))
"""


@pytest.mark.parametrize(
    ("variables", "named"),
    part(
        2,
        [
            ({}, "host"),
            ({"NUMBA_CPU_NAME": "generic"}, "generic"),
            # as the entrypoint of the image has it
            ({"NUMBA_CPU_NAME": "x86-64-v3", "NUMBA_CPU_FEATURES": ""}, "x86-64-v3"),
            ({"NUMBA_CPU_NAME": "x86-64-v3"}, "x86-64-v3+host"),
            ({"NUMBA_CPU_NAME": ""}, "generic+host"),
        ],
        rows=True,
    ),
)
def test_the_processor_is_the_one_that_kernels_are_compiled_for(
    monkeypatch: pytest.MonkeyPatch, variables: dict[str, str], named: str
) -> None:
    """Independent: numba itself."""
    for name in _NAMES:
        monkeypatch.delenv(name, raising=False)
    for name, value in variables.items():
        monkeypatch.setenv(name, value)
    assert processor() == named
    command = [sys.executable, "-c", _USED]
    used = subprocess.run(command, cwd=ROOT, env=dict(os.environ), capture_output=True, text=True, check=True)
    assert used.stdout.strip() == named
