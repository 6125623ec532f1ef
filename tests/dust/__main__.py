"""Ask for random machines of all modes and print how many have dust: ``python -m tests.dust [--count 10000]``."""

import argparse
from itertools import groupby

from tests.dust.judgement import Judgement, judgement, seeds
from tests.dust.modes import MODES


def _summary(mode: str, judgements: list[Judgement]) -> int:
    """Print what a mode came to; how many machines are at fault."""
    dust, unlike = (sum(bool(getattr(verdict, name)) for verdict in judgements) for name in ("dust", "unlike"))
    needed = sum(verdict.needed for verdict in judgements)
    cpu_s = sum(verdict.cpu_s for verdict in judgements)
    print(
        f"{mode:17} machines {len(judgements):5}, answers {sum(verdict.answers for verdict in judgements):6}, "
        f"open {sum(verdict.open for verdict in judgements):3}, dust {dust:3}, needed {needed:2}, "
        f"unlike plates {unlike:3}, {cpu_s:6.1f} s CPU",
        flush=True,
    )
    for finding in judgements:
        if finding.dust or finding.unlike:
            print(f"  seed {finding.seed}: {'; '.join([*finding.dust, *finding.unlike])}", flush=True)
    return sum(bool(verdict.dust or verdict.unlike) for verdict in judgements)


def main() -> int:
    """The exit code: 0 where nothing is at fault."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=10_000, help="machines of all modes together")
    parser.add_argument("--mode", choices=list(MODES), help="this one alone")
    options = parser.parse_args()
    faults = 0
    for mode, some in groupby(seeds(options.count, options.mode), key=lambda seed: seed[0]):
        faults += _summary(mode, [judgement(mode, seed) for _, seed in some])
    print(f"at fault: {faults}")
    return 1 if faults else 0


raise SystemExit(main())
