"""Peers where webs have sectors, a budget and a ceiling: generated C and clarabel, tuned or not, beside ours.

``python -m tests.benchmarks.sweep_limits``; part of `make bench`. In turns on one core, by the time of the processor,
as :mod:`tests.benchmarks.sweep`: the peers get their matrices for nothing, prove nothing and write nothing.

Both stages: |p_k| <= f_k <= 1, p_k in its sector, mass @ f within the budget, |constant_j + influence_j p| <= t_j for
the terms, and at most a cap for a limited response. The first minimises the sum of t, the second mass @ f with the sum
of t at most the target.
"""

from tests.benchmarks.single_core import pin, single_thread

if __name__ == "__main__":
    single_thread("tests.benchmarks.sweep_limits")

import argparse
import io
import json
import time
from collections.abc import Callable, Sequence
from typing import NamedTuple

import clarabel
import numpy as np
import pyarrow.parquet as pq
from rich.console import Console
from rich.table import Table
from scipy import sparse

from optimizer.numerics.arrays import Real
from schemas.sweep.request import SweepRequest
from tests.benchmarks import sweep_generated
from tests.benchmarks.sweep import Rate, our_rows
from tests.benchmarks.sweep_case import Program, programs, sweep
from tests.benchmarks.sweep_rivals import Gaps, Stages, gaps, settings, target, vectors_of

#: half of what a counterweight may turn by, deg; kg of all; N, which every design keeps
_HALF_ANGLE, _BUDGET, _CEILING = 60.0, 12.0, 1e5
OURS = "(d) ours, axes to Parquet"
#: what is limited -> fields of the machine and of the objective
CASES: dict[str, tuple[bool, dict[str, float]]] = {
    "sectors": (False, {}),
    "sectors, a budget": (True, {}),
    "sectors, a budget, a ceiling": (True, {"force_ceiling_N": _CEILING}),
}


def limited(samples: int, case: str) -> SweepRequest:
    """The sweep of the plain programs, with limits."""
    body = json.loads(sweep(samples).model_dump_json(exclude_unset=True))
    budget, body["base"]["objective"] = CASES[case]
    machine = body["base"]["machine"]
    for number, web in enumerate(machine["webs"]):
        web["sector"] = {"centre_deg": 180.0 if number >= 4 else 0.0, "half_angle_deg": _HALF_ANGLE}
    if budget:
        machine["max_total_mass_kg"] = _BUDGET
    return SweepRequest.model_validate(body)


class Stage(NamedTuple):
    """Minimise cost @ v subject to side - matrix @ v in the cones: planes of 3, after numbers that are not negative."""

    cost: Real
    matrix: sparse.csc_matrix
    side: Real
    numbers: int
    planes: int


def stage(program: Program, second: bool) -> Stage:
    """A stage of a design: variables p (x and y of each web in turn), f, t."""
    limits, ceilings = program.statement.limits, program.statement.ceilings
    terms, webs = program.influence.shape
    place, size = np.eye(2 * webs, 3 * webs + terms), np.eye(3 * webs + terms)[2 * webs :]
    share, reached = size[:webs], size[webs:]
    rows, sides = [share], [np.ones(webs)]
    # |Im v| cos <= Re v sin of v = p conj(centre)
    along = limits.centre.real[:, None] * place[0::2] + limits.centre.imag[:, None] * place[1::2]
    across = limits.centre.real[:, None] * place[1::2] - limits.centre.imag[:, None] * place[0::2]
    for sign in (1.0, -1.0):
        rows.append(sign * limits.half_angle_cos[:, None] * across - limits.half_angle_sin[:, None] * along)
        sides.append(np.zeros(webs))
    if np.isfinite(limits.max_total_mass):
        rows.append((program.mass @ share)[None])
        sides.append(limits.max_total_mass[None] / program.mass_unit)
    if second:
        rows.append(np.ones((1, terms)) @ reached)
        sides.append(np.zeros(1))
    numbers = sum(map(len, rows))
    norms, unit = ceilings.norms, program.unit
    for web in range(webs):
        rows.append(-np.stack([share[web], place[2 * web], place[2 * web + 1]]))
        sides.append(np.zeros(3))
    vectors = program.constant, program.influence, [(-row, 0.0) for row in reached]
    caps = [(np.zeros(3 * webs + terms), cap) for cap in (ceilings.cap / unit).tolist()]
    bare = np.stack([norms.constant.real, norms.constant.imag], axis=-1) / unit
    limited = bare, norms.influence * limits.reach / unit, caps
    for constant, influence, heads in (vectors, limited):
        for (x, y), of_webs, (head, top) in zip(constant, influence, heads, strict=True):
            rows.append(np.stack([head, -(of_webs @ place[0::2]), -(of_webs @ place[1::2])]))
            sides.append(np.array([top, x, y]))
    cost = program.mass @ share if second else np.ones(terms) @ reached
    planes = webs + terms + len(caps)
    return Stage(cost, sparse.csc_matrix(np.vstack(rows)), np.concatenate(sides), numbers, planes)


def stages_of(program: Program, x: Sequence[Real], z: Sequence[Real], numbers: int) -> Stages:
    """What both stages found, from their variables and multipliers."""
    terms, webs = program.influence.shape
    last = len(program.statement.ceilings.names)
    duals = [vectors_of(values[-3 * (terms + last) :].reshape(-1, 3)[:, 1:]) for values in z]
    places = [values[: 2 * webs].reshape(-1, 2) for values in x]
    of_terms, of_ceilings = ([dual[:terms] for dual in duals], [dual[terms:] for dual in duals])
    return Stages(*places, *of_terms, z[1][numbers - 1], *of_ceilings)


class Direct:
    """clarabel, both stages prepared, only their data updated."""

    def __init__(self, prepared: Sequence[tuple[Stage, Stage]], tuned: bool) -> None:
        self._solvers = []
        for level in prepared[0]:
            cones = [clarabel.NonnegativeConeT(level.numbers), *[clarabel.SecondOrderConeT(3)] * level.planes]
            none = sparse.csc_matrix((level.cost.size, level.cost.size))
            self._solvers.append(
                clarabel.DefaultSolver(none, level.cost, level.matrix, level.side, cones, settings(tuned))
            )

    def solve(self, program: Program, both: tuple[Stage, Stage]) -> Stages:
        (level, two), (first, second) = both, self._solvers
        first.update(q=level.cost, A=level.matrix.data, b=level.side)
        smallest = first.solve()
        two.side[two.numbers - 1] = target(smallest.obj_val, program)
        second.update(q=two.cost, A=two.matrix.data, b=two.side)
        pair = smallest, second.solve()
        return stages_of(
            program,
            [np.array(variable.x) for variable in pair],
            [np.array(variable.z) for variable in pair],
            two.numbers,
        )


class Generated:
    """C for both stages, all designs in one call of each."""

    def __init__(self, chosen: Sequence[Program], prepared: Sequence[tuple[Stage, Stage]]) -> None:
        self._programs, self._stages = chosen, [list(level) for level in zip(*prepared, strict=True)]
        self._compiled = [
            sweep_generated.Compiled(level.cost, level.matrix, level.side, level.numbers, level.planes)
            for level in prepared[0]
        ]
        self._values = [np.stack([stage.matrix.data for stage in level]) for level in self._stages]
        self._sides = [np.stack([stage.side for stage in level]) for level in self._stages]
        self._costs = [np.stack([stage.cost for stage in level]) for level in self._stages]

    @property
    def unsolved(self) -> int:
        """Programs of the last turn that are left unsolved."""
        return sum(compiled.unsolved for compiled in self._compiled)

    def solve(self) -> list[Stages]:
        numbers, solutions = self._stages[1][0].numbers, []
        for k, compiled in enumerate(self._compiled):
            if k == 1:
                values = solutions[0][2]
                pairs = zip(values, self._programs, strict=True)
                self._sides[1][:, numbers - 1] = [target(optimum, program) for optimum, program in pairs]
            solutions.append(compiled.solve(self._costs[k], self._values[k], self._sides[k]))
        every = zip(self._programs, *(solutions[k][i] for i in range(2) for k in range(2)), strict=True)
        return [stages_of(program, [x, x2], [z, z2], numbers) for program, x, x2, z, z2 in every]


def compare(request: SweepRequest, designs: tuple[int, int], turns: int) -> tuple[dict[str, Rate], int]:
    """Rates of all methods, with gaps that 99 of 100 designs keep; and programs that the generated C left unsolved.

    Parameters
    ----------
    designs : in a turn of clarabel and of the generated C, spread over the sweep; ours takes all.
    """
    chosen = programs(request, np.linspace(0, request.total - 1, max(designs), dtype=int))
    prepared = [(stage(program, False), stage(program, True)) for program in chosen]
    some = range(designs[0])
    direct, tuned = Direct(prepared, False), Direct(prepared, True)
    methods: dict[str, tuple[int, Callable[[], list[Stages]]]] = {
        "(a) clarabel, prepared matrices": (designs[0], lambda: [direct.solve(chosen[i], prepared[i]) for i in some]),
        "(b) clarabel, tuned": (designs[0], lambda: [tuned.solve(chosen[i], prepared[i]) for i in some]),
    }
    generated = Generated(chosen, prepared) if sweep_generated.available() else None
    if generated is not None:
        methods["(c) QOCOGEN, C for this program"] = (len(chosen), generated.solve)
    rates = {name: Rate(count) for name, (count, _) in methods.items()} | {OURS: Rate(request.total)}
    our_rows(request)
    content = b""
    for turn in range(turns + 1):
        for name, (count, method) in methods.items():
            began = time.process_time()
            levels = method()
            if turn:
                rates[name].seconds.append(time.process_time() - began)
            actual_gaps = [gaps(program, stages) for program, stages in zip(chosen[:count], levels, strict=True)]
            rates[name].worst = Gaps(*(float(np.percentile(part, 99)) for part in zip(*actual_gaps, strict=True)))
        began = time.process_time()
        content = our_rows(request)
        if turn:
            rates[OURS].seconds.append(time.process_time() - began)
    rows = pq.read_table(io.BytesIO(content))
    # of designs whose ceiling is proven out of reach there is no gap
    assert set(rows["status"].to_pylist()) <= {"optimal", "infeasible"}
    every = [rows[name].to_numpy() for name in ("relative_gap", "mass_relative_gap")]
    rates[OURS].worst = Gaps(*(float(np.nanmax(values)) for values in every))
    return rates, 0 if generated is None else generated.unsolved


def show(console: Console, case: str, request: SweepRequest, rates: dict[str, Rate], unsolved: int) -> None:
    title = f"{request.total} designs of the 2D12 with 8 webs, {case}, both stages, one core, in turns"
    table = Table(title=title, caption="gaps: of ours the worst, of others what 99 of 100 designs keep")
    for heading in ("method", "designs/s", "us a design", "ours is faster by", "gap", "gap of the mass"):
        table.add_column(heading, justify="left" if heading == "method" else "right")
    for name, rate in rates.items():
        table.add_row(
            name,
            f"{rate.per_second:,.0f}",
            f"{1e6 / rate.per_second:,.1f}",
            f"{rates[OURS].times(rate):.1f}",
            f"{rate.worst.objective:.1e}",
            f"{rate.worst.mass:.1e}",
        )
    console.print(table)
    if unsolved:
        console.print(f"the generated C says of {unsolved} programs that it has not solved them")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--designs", type=int, default=5_000)
    parser.add_argument("--turns", type=int, default=5)
    arguments = parser.parse_args()
    console = Console(width=120)
    console.print(f"on core {pin()}")
    for case in CASES:
        request = limited(arguments.designs, case)
        show(console, case, request, *compare(request, (300, 1000), arguments.turns))


if __name__ == "__main__":
    main()
