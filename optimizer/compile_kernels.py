"""Compile the kernels, once for an installation: ``python -m optimizer.compile_kernels``.

The budget's loop is compiled first, and with it what the compiler needs for any kernel. Three processes have that in
common and do the rest beside one another. The first compiles what follows the turn and moves curves. The second
compiles the interior point for discs, what proves and settles, what is off, and what compares sums of options. The
third compiles the interior point for any limits, what matches parts, and what orders designs and sums forces.
"""

import gc
import os
import sys
import time
from collections.abc import Callable, Sequence
from multiprocessing import get_context

import numpy as np

from optimizer.numerics.linking import link_first
from optimizer.numerics.shortcuts import take_shortcuts
from optimizer.warm_up import follow_a_turn, match_parts, plain_discs

#: how much nicer the shorter parts are than the longest: two cores are shared as long as each takes
_BEHIND = 0, 1, 2


def any_limits() -> None:
    """Compile the interior point for any limits: one web, one term, one row, no ceiling."""
    from optimizer.program.kernel.interior_point import Programs, solve

    shapes = (1, 1), (1, 0), (1, 1, 2), (1, 1, 1), (1, 1, 2), *5 * ((1, 1),)
    solve(Programs(np.zeros(1, np.int64), *map(np.ones, shapes)), True, np.full(1, 1e-6), np.full(1, 1e-9), 1e-6)


def budgets() -> None:
    """Compile what a budget is spent by: one program, one web."""
    from optimizer.numerics.kernel.knapsack import filled

    filled(np.ones((1, 1)), np.ones((1, 1)), np.ones(1))


def designs() -> None:
    """Compile what puts the designs of a Latin hypercube in their order, and what sums their forces."""
    from optimizer.numerics.sums import MANY, force_and_couple
    from optimizer.studies.sweep.designs import permuted

    permuted(np.zeros(1, np.int64), 1, 0, 0)
    force_and_couple(np.zeros((MANY, 1), complex), np.zeros((MANY, 1)))


def proofs() -> None:
    """Compile what proves bounds of single proofs, settles by itself or is for ceilings: one web, one term, one row."""
    from optimizer.program.ceilings import Ceilings
    from optimizer.program.certificate import affine_minorant, nothing_proven, objective_lower_bound
    from optimizer.program.kernel.disc_forms import pairs
    from optimizer.program.limits import Limits, within
    from optimizer.program.methods.compensation import near_limits
    from optimizer.program.methods.rounding import snap_to_limits
    from optimizer.program.norms import Norms
    from optimizer.program.points import points_at
    from optimizer.program.scaling import least_change
    from optimizer.program.statement import Names, Statement

    unit, first, vector = np.ones(1), np.zeros(1, int), np.ones(1, complex)
    limits, none = Limits(unit, unit, unit > 0, vector, unit, unit, np.array(1.0)), Norms(vector[:0], np.ones((0, 1)))
    no_ceilings = Ceilings((), none, unit[:0], unit[:0])
    program = Statement(Norms(vector, np.ones((1, 1))), first, first, unit, no_ceilings, limits, Names((), ()))
    affine_minorant(program, nothing_proven(program))
    objective_lower_bound(program, nothing_proven(program))
    near_limits(limits, np.ones((1, 1, 1)), np.ones((1, 1), complex), 0.0, 0.0)
    within(limits.region((1,)), (1,), np.ones((1, 1), complex))
    least_change(np.ones((1, 1, 1), complex), np.ones((1, 1), complex), 1)
    snap_to_limits(program.alone(), points_at(program.alone(), np.zeros((1, 1), complex)), unit, None)
    pairs(np.ones((1, 3, 1)), np.zeros(3, int), np.empty((1, 3)), np.empty((1, 2, 1)), np.empty(1, bool))


def misplacements() -> None:
    """Compile what counterweights come to that are off: one length, one web."""
    from optimizer.program.misplacement import farthest_by_angle, farthest_by_mass

    for farthest in (farthest_by_mass, farthest_by_angle):
        farthest(np.ones(1, complex), np.ones((1, 1), complex), 0.1)


def moving_curves() -> None:
    """Compile what brings curves into motion: one piece."""
    from optimizer.responses.kernel.motion import STILL, in_motion

    in_motion(STILL, np.ones(1), np.ones(1), np.ones((1, 4), complex), np.ones(1))


def near_sums() -> None:
    """Compile what sums of options are compared by: two sums each."""
    from optimizer.choices.discrete.kernel.near_sums import ALL, gridded, near

    lists, two, cells = (np.zeros((1, 2)), np.zeros((2, 2))), np.zeros(2), np.ones(2, np.int64)
    first, sums, _ = gridded(*lists, two, cells, two, 1.0, cells, ALL)
    near(first, sums, *lists, two, cells, two, 1.0, cells, ALL, np.zeros(4, np.int64), 1.0, cells)


#: three at a time, the longest first: so that two cores are busy until the end
PARTS: tuple[tuple[Callable[[], object], ...], ...] = (
    (follow_a_turn, moving_curves),
    (plain_discs, proofs, misplacements, near_sums),
    (any_limits, match_parts, designs),
)


def main() -> None:
    _say("compiling the kernels, once: half a minute on two cores")
    begun = time.perf_counter()
    # the compiler makes millions of objects and lets few go: looking for those is a sixth of its time
    gc.disable()
    link_first()
    take_shortcuts()
    budgets()
    processes = [get_context("fork").Process(target=_in_turn, args=parts) for parts in zip(_BEHIND, PARTS, strict=True)]
    for process in processes:
        process.start()
    for process in processes:
        process.join()
    if any(process.exitcode for process in processes):
        raise SystemExit("one of the processes failed; what it said stands above")
    _say(f"compiled in {time.perf_counter() - begun:.0f} s")


def _in_turn(behind: int, parts: Sequence[Callable[[], object]]) -> None:
    """In a process that ends thereafter, with so much less of a core than others have."""
    os.nice(behind)
    for left, part in zip(range(len(parts) - 1, -1, -1), parts, strict=True):
        begun = time.perf_counter()
        part()
        _say(f"  {part.__name__.replace('_', ' ')}: {time.perf_counter() - begun:.0f} s; {left} left in this process")
    # nor are they looked through at the end
    gc.freeze()


def _say(text: str) -> None:
    sys.stdout.write(f"{text}\n")
    sys.stdout.flush()


if __name__ == "__main__":
    main()
