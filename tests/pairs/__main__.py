"""Ask for all pairs and for random triples, and tell what came of it: ``python -m tests.pairs [--triples 2000]``."""

import argparse
from collections import Counter
from collections.abc import Iterable

from tests.pairs.asking import Outcome, ask
from tests.pairs.combinations import Combination, all_pairs, random_triples

_SHOWN = 10


def _told(title: str, combinations: Iterable[Combination], time_limit_s: float) -> int:
    """Print what combinations come to; how many are at fault."""
    outcomes: list[Outcome] = []
    for base, features in combinations:
        found = ask(base, features, time_limit_s)
        outcomes.append(found)
        if found.kind == "fault":
            print(f"  fault: {found.name} | {found.message}", flush=True)
    kinds = Counter(each.kind for each in outcomes)
    statuses = Counter(each.status for each in outcomes if each.kind == "answered")
    slow = sorted(outcomes, key=lambda each: -each.cpu_s)[:_SHOWN]
    print(
        f"{title}: legal {kinds['answered'] + kinds['fault']} ({dict(statuses)}), refused {kinds['refused']}, "
        f"no place {kinds['no place']}, faults {kinds['fault']}"
    )
    for each in slow:
        print(f"  {each.cpu_s:6.2f} s CPU  {each.status:10}  {each.name}")
    return kinds["fault"]


def main() -> int:
    """The exit code: 0 where nothing is at fault."""
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--triples", type=int, default=2_000)
    options.add_argument("--no-pairs", action="store_true")
    options.add_argument("--seed", type=int, default=1)
    options.add_argument(
        "--time-limit", type=float, default=0.5, help="accuracy.time_limit_s of requests that say none"
    )
    asked = options.parse_args()
    faults = 0 if asked.no_pairs else _told("all pairs", all_pairs(), asked.time_limit)
    faults += _told("random triples", random_triples(asked.triples, asked.seed), asked.time_limit)
    return 1 if faults else 0


raise SystemExit(main())
