"""What each method of matching closes of the gap: ``python -m tests.studies.matching.methods [--seeds 4]``.

Rows, classes and cranks; the median relative gap by sorting and exchange (and halves, where those are few), with sets
of parts besides, and with four lists besides; how many are proven to the asked gap; the seconds of all methods.
"""

import argparse
import time
from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np
import pytest

from optimizer.studies.matching import fitted
from optimizer.studies.matching.row_halves import Exhausted
from schemas.match.answer import MatchAnswer
from tests.studies.matching.cases import machine, matched, mirrored, parts

ROWS = (6, 8, 9, 10, 12)
CRANKS = ("the same from both ends", "in order", "by chance")
#: what is left out, method by method
WITHOUT = (("exhausted", "near_to_nothing"), ("near_to_nothing",), ())


class Case(NamedTuple):
    """Machines of one kind."""

    rows: int
    classes: int
    cranks: str

    def body(self, seed: int) -> dict[str, Any]:
        n = self.rows
        if self.cranks == "the same from both ends":
            cranks = mirrored(n)
        elif self.cranks == "in order":
            cranks = [720.0 * k / n % 360.0 for k in range(n)]
        else:
            cranks = (15.0 * np.random.default_rng([seed, n]).integers(0, 24, n)).tolist()
        return {
            "machine": machine(cranks, [0.0] * n),
            "parts": parts(seed, *[n] * self.classes),
            "objective": {"moment_weight": 1.0},
            "accuracy": {"time_limit_s": 3.0},
        }


def cases() -> Iterator[Case]:
    for rows in ROWS:
        for classes in (1, 2):
            for cranks in CRANKS:
                if cranks != "the same from both ends" or rows % 2 == 0:
                    yield Case(rows, classes, cranks)


def answer(case: Case, seed: int, without: tuple[str, ...]) -> MatchAnswer:
    """The answer without some of the methods."""
    nothing: dict[str, Any] = {
        "exhausted": lambda _, cut, objective, *rest: Exhausted(None, objective, cut.least, False),
        "near_to_nothing": lambda _, mass, *rest: mass,
    }
    with pytest.MonkeyPatch.context() as patch:
        for name in without:
            patch.setattr(fitted, name, nothing[name])
        return matched(case.body(seed))


def gap(match: MatchAnswer) -> float:
    """Relative gap; 0 where nothing is left to prove."""
    return match.certificate.relative_gap or 0.0


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seeds", type=int, default=4)
    seeds = range(parser.parse_args().seeds)
    print("rows classes cranks                    exchange      sets  four lists   proven        s CPU")
    for case in cases():
        gaps, proven, spent = [], [], 0.0
        for without in WITHOUT:
            began = time.process_time()
            answers = [answer(case, seed, without) for seed in seeds]
            spent = (time.process_time() - began) / len(seeds)
            gaps.append(float(np.median([gap(reply) for reply in answers])))
            proven.append(sum(reply.status == "optimal" for reply in answers))
        columns = "  ".join(f"{single_gap:8.1e}" for single_gap in gaps)
        print(f"{case.rows:4} {case.classes:7} {case.cranks:24} {columns}   {proven}   {spent:6.2f}", flush=True)


if __name__ == "__main__":
    main()
