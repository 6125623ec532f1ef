"""Compile the kernels, once for an installation: ``python -m optimizer.compile_kernels``.

The interior point is one tree of functions, each kept on disk when it is compiled. A second process begins at its end
and goes on with what stands beside it, so that the first finds that done.
"""

import sys
import time
from multiprocessing import get_context

import numpy as np

from optimizer.warm_up import follow_a_turn, warm_up


def last_first() -> None:
    """Compile, by one use of each, what an answer comes to last."""
    from optimizer.kernel.knapsack import filled
    from optimizer.program.kernel.cancelling import least_changes
    from optimizer.program.kernel.disc_steps import LANES, OWN, WEB, correct, eliminate, find_step, go, look
    from optimizer.program.kernel.lanes import Lanes, new_work, state_size, views
    from optimizer.program.kernel.newton import direction, longest_step, second_order, take_step
    from optimizer.program.kernel.outlines import worst_turned
    from optimizer.program.kernel.symmetries import Alike, means

    # one web, one term, one row, no ceiling, one lane
    one = Lanes(np.zeros(1, np.int64), *(np.ones(shape) for shape in (
        (1, 1), (0, 1), (2, 1), (1, 1), (2, 1), 1, 1, (3, 1), 1, 1, 1
    )))  # fmt: skip
    state, work = views(np.ones((state_size(1, 1, 1), 1)), 1, 1, 1), new_work(1, 1, 1, 1, 1)
    take_step(one, state, work)
    second_order(np.ones(1), work)
    longest_step(one, state, work, 1.0)
    direction(False, one, state, work)
    vectors = np.ones((1, 1), complex)
    alike = Alike(np.ones((1, 1)), np.ones((1, 1)), np.ones((1, 1), bool), vectors, np.ones((1, 1)))
    means(vectors, np.ones((1, 1, 1)), alike, np.zeros(1, np.int64), vectors)
    worst_turned(vectors, np.ones(1, complex), 0.1)
    least_changes(np.ones((1, 1, 1), complex), vectors, 1)
    filled(np.ones((1, 1)), np.ones((1, 1)), np.ones(1))
    web, own, matrix, step = (np.ones(size) for size in (WEB, OWN, 25 * LANES, 5 * LANES))
    look(False, 1, web, own)
    eliminate(False, own, matrix)
    find_step(False, 1, web, own, matrix, step)
    correct(False, 1, web, own, step)
    go(1, web, own, step)
    follow_a_turn()


def main() -> None:
    _say("compiling the kernels, once: a minute on two quiet cores")
    begun = time.perf_counter()
    beside = get_context("spawn").Process(target=last_first)
    beside.start()
    warm_up()
    beside.join()
    if beside.exitcode:
        raise SystemExit("the second process failed; what it said stands above")
    _say(f"compiled in {time.perf_counter() - begun:.0f} s")


def _say(what: str) -> None:
    sys.stdout.write(f"{what}\n")
    sys.stdout.flush()


if __name__ == "__main__":
    main()
