"""Compile the kernels, once for an installation: ``python -m optimizer.compile_kernels``.

Two processes take about as long: one the interior point for any limits, the other that for plain discs and what follows
the turn. What they have in common is inlined in both.
"""

import sys
import time
from multiprocessing import get_context

import numpy as np

from optimizer.warm_up import follow_a_turn, plain_discs, warm_up


def any_limits() -> None:
    """Compile the interior point for any limits: one web, one term, one row, no ceiling."""
    from optimizer.program.kernel.interior_point import Programs, solve

    shapes = (1, 1), (1, 0), (1, 1, 2), (1, 1, 1), (1, 1, 2), *5 * ((1, 1),)
    solve(Programs(np.zeros(1, np.int64), *map(np.ones, shapes)), True, np.full(1, 1e-6), np.full(1, 1e-9), 1e-6)


def all_else() -> None:
    """Compile what a machine of plain discs asks for, its loads over the whole turn, and what a budget is spent by."""
    from optimizer.kernel.knapsack import filled

    filled(np.ones((1, 1)), np.ones((1, 1)), np.ones(1))
    plain_discs()
    follow_a_turn()


def main() -> None:
    _say("compiling the kernels, once: half a minute on two cores")
    begun = time.perf_counter()
    beside = get_context("spawn").Process(target=all_else)
    beside.start()
    any_limits()
    beside.join()
    if beside.exitcode:
        raise SystemExit("the second process failed; what it said stands above")
    # nothing is left to compile, and all of it works
    warm_up()
    _say(f"compiled in {time.perf_counter() - begun:.0f} s")


def _say(what: str) -> None:
    sys.stdout.write(f"{what}\n")
    sys.stdout.flush()


if __name__ == "__main__":
    main()
