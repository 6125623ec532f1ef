"""(f) QOCOGEN: an interior point in C that is written for the one shape of program, and compiled for this processor.

All designs of a turn are one call of each stage, so that nothing of Python is in the time. QOCO: Chari and Acikmese,
QOCO: a quadratic objective conic optimizer with custom solver generation, arXiv 2503.12658.
"""

import contextlib
import ctypes
import io
import shutil
import subprocess
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import qocogen
from scipy import sparse

from optimizer.numerics.arrays import Real
from tests.benchmarks.sweep_case import Program
from tests.benchmarks.sweep_rivals import Direct, Stages, target, vectors_of

#: gap and feasibility, absolute and relative: what is enough for the gaps of the table
_TOLERANCE = 1e-7
#: one program after the other, in one memory
_DRIVER = """
#include "qoco_custom.h"
#include "workspace.h"

static Workspace work;

int solve_all(int count, double tolerance, double* c, double* G, double* h, double* x, double* z, double* value)
{
    int unsolved = 0;
    load_data(&work);
    set_default_settings(&work);
    work.settings.abstol = work.settings.reltol = tolerance;
    for (int k = 0; k < count; ++k) {
        update_c(&work, c + k * N);
        update_G(&work, G + k * NONZERO);
        update_h(&work, h + k * M);
        qoco_custom_solve(&work);
        for (int i = 0; i < N; ++i) x[k * N + i] = work.sol.x[i];
        for (int i = 0; i < M; ++i) z[k * M + i] = work.sol.z[i];
        value[k] = work.sol.obj;
        if (work.sol.status != QOCO_CUSTOM_SOLVED) ++unsolved;
    }
    return unsolved;
}
"""


def available() -> bool:
    """Whether there is a compiler."""
    return shutil.which("gcc") is not None


class Compiled:
    """One stage: minimise cost @ v subject to side - matrix @ v in the cones, of any data of one pattern."""

    def __init__(self, cost: Real, matrix: sparse.csc_matrix, side: Real, rows: int, planes: int) -> None:
        self._shape, self._nonzero, self.unsolved = matrix.shape, matrix.nnz, 0
        with tempfile.TemporaryDirectory() as folder:
            # the generator tells what it does
            with contextlib.redirect_stdout(io.StringIO()):
                qocogen.generate_solver(
                    cost.size, side.size, 0, None, cost, None, None, matrix, side, rows, planes, [3] * planes, folder
                )
            source = Path(folder) / "qoco_custom"
            (source / "driver.c").write_text(_DRIVER)
            command = ["gcc", "-O3", "-march=native", "-w", "-shared", "-fPIC", "-o", str(source / "all.so")]
            sizes = [f"-DN={cost.size}", f"-DM={side.size}", f"-DNONZERO={matrix.nnz}"]
            files = [str(file) for file in sorted(source.glob("*.c")) if file.name != "runtest.c"]
            subprocess.run([*command, *sizes, *files, "-lm"], check=True)
            self._library = ctypes.CDLL(str(source / "all.so"))

    def solve(self, cost: Real, values: Real, sides: Real) -> tuple[Real, Real, Real]:
        """Variables, multipliers and objectives of programs by their data (n, ...); so many are ``unsolved``."""
        count, (rows, columns) = len(values), self._shape
        assert values.shape == (count, self._nonzero)
        x, z, objective = np.empty((count, columns)), np.empty((count, rows)), np.empty(count)
        every = [np.ascontiguousarray(np.broadcast_to(cost, (count, columns))), values, sides, x, z, objective]
        pointers: list[Any] = [values.ctypes.data_as(ctypes.POINTER(ctypes.c_double)) for values in every]
        self.unsolved = int(self._library.solve_all(count, ctypes.c_double(_TOLERANCE), *pointers))
        return x, z, objective


class Generated:
    """Both stages, the data of all designs stacked beforehand."""

    def __init__(self, programs: Sequence[Program]) -> None:
        self._programs = programs
        self._terms, self._webs = programs[0].influence.shape
        direct = Direct(programs[0])
        prepared = [direct.prepare(program) for program in programs]
        self._values = [np.stack(values) for values in zip(*(stages.values for stages in prepared), strict=True)]
        self._sides = [np.stack(sides) for sides in zip(*(stages.sides for stages in prepared), strict=True)]
        self._costs = direct.first_cost, np.stack([stages.mass for stages in prepared])
        planes = self._webs + self._terms
        first, second = direct.matrices(programs[0])
        self._first = Compiled(self._costs[0], first, self._sides[0][0], 0, planes)
        self._second = Compiled(self._costs[1][0], second, self._sides[1][0], self._webs + 1, planes)

    def solve(self) -> list[Stages]:
        """Both stages of all designs.

        Raises
        ------
        ArithmeticError
            if one of them is left unsolved.
        """
        x, z, objective = self._first.solve(self._costs[0], self._values[0], self._sides[0])
        self._sides[1][:, self._webs] = [
            target(optimum, program) for optimum, program in zip(objective, self._programs, strict=True)
        ]
        x2, z2, _ = self._second.solve(self._costs[1], self._values[1], self._sides[1])
        if unsolved := self._first.unsolved + self._second.unsolved:
            raise ArithmeticError(f"{unsolved} of {2 * len(self._programs)} programs are left unsolved")
        duals = [values[:, -3 * self._terms :].reshape(-1, self._terms, 3)[..., 1:] for values in (z, z2)]
        places = [values[:, : 2 * self._webs].reshape(-1, self._webs, 2) for values in (x, x2)]
        return [
            Stages(p, p2, vectors_of(terms), vectors_of(terms2), price)
            for p, p2, terms, terms2, price in zip(*places, *duals, z2[:, self._webs], strict=True)
        ]
