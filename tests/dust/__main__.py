"""Ask for random machines of all modes and print how many have dust: ``python -m tests.dust [--count 10000]``."""

import argparse
from itertools import groupby

from tests.dust.judgement import Judgement, judgement, seeds
from tests.dust.modes import MODES


def _summary(mode: str, found: list[Judgement]) -> int:
    """Print what a mode came to; how many machines are at fault."""
    dust, unlike = (sum(bool(getattr(each, name)) for each in found) for name in ("dust", "unlike"))
    needed = sum(each.needed for each in found)
    cpu_s = sum(each.cpu_s for each in found)
    print(
        f"{mode:17} machines {len(found):5}, answers {sum(each.answers for each in found):6}, "
        f"open {sum(each.open for each in found):3}, dust {dust:3}, needed {needed:2}, "
        f"unlike plates {unlike:3}, {cpu_s:6.1f} s CPU",
        flush=True,
    )
    for each in found:
        if each.dust or each.unlike:
            print(f"  seed {each.seed}: {'; '.join([*each.dust, *each.unlike])}", flush=True)
    return sum(bool(each.dust or each.unlike) for each in found)


def main() -> int:
    """The exit code: 0 where nothing is at fault."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=10_000, help="machines of all modes together")
    parser.add_argument("--mode", choices=list(MODES), help="this one alone")
    options = parser.parse_args()
    faults = 0
    for mode, some in groupby(seeds(options.count, options.mode), key=lambda each: each[0]):
        faults += _summary(mode, [judgement(mode, seed) for _, seed in some])
    print(f"at fault: {faults}")
    return 1 if faults else 0


raise SystemExit(main())
