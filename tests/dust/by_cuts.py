"""Plates by their own rounds beside plates by cuts: ``python -m tests.dust.by_cuts [--count 240]``.

What is not certified, what all but differs, and CPU time; figures of docs/decisions/0013-plates.md.
"""

import argparse
from collections.abc import Callable

import numpy as np
import pytest

from optimizer.solve.uncertain_program import Robust
from tests.dust.judgement import judgement

_MODE = "plates"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=240)
    count = parser.parse_args().count
    # without rounds of their own they are known by tangents that cuts are added to
    ways: dict[str, Callable[..., object]] = {"rounds": Robust._cut, "cuts": lambda *_: None}
    spent = {}
    for name, way in ways.items():
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(Robust, "_cut", way)
            judgements = [judgement(_MODE, seed) for seed in range(count)]
        spent[name] = np.array([verdict.cpu_s for verdict in judgements])
        left, unlike = sum(verdict.open for verdict in judgements), sum(bool(verdict.unlike) for verdict in judgements)
        print(f"{name:7} open {left:3}, unlike {unlike:3}, {spent[name].sum():6.1f} s CPU", flush=True)
    share = spent["cuts"] / spent["rounds"]
    print(f"cuts over rounds: median {np.median(share):.2f}, nine of ten below {np.quantile(share, 0.9):.1f}")


if __name__ == "__main__":
    main()
