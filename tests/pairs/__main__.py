"""Ask for all pairs and for random triples, and tell what came of it: ``python -m tests.pairs [--triples 2000]``."""

import argparse
from collections import Counter
from collections.abc import Iterable

from tests.pairs.asking import Outcome, ask
from tests.pairs.combinations import Combination, all_pairs, pairs_of_pins, random_triples

_SHOWN = 10


def _print_outcomes(title: str, combinations: Iterable[Combination], time_limit_s: float) -> int:
    """Print what combinations come to; how many are at fault."""
    outcomes: list[Outcome] = []
    for base, features in combinations:
        outcome = ask(base, features, time_limit_s)
        outcomes.append(outcome)
        if outcome.kind == "fault":
            print(f"  fault: {outcome.name} | {outcome.message}", flush=True)
    kinds = Counter(single_outcome.kind for single_outcome in outcomes)
    statuses = Counter(single_outcome.status for single_outcome in outcomes if single_outcome.kind == "answered")
    slow = sorted(outcomes, key=lambda single_outcome: -single_outcome.cpu_s)[:_SHOWN]
    print(
        f"{title}: legal {kinds['answered'] + kinds['fault']} ({dict(statuses)}), refused {kinds['refused']}, "
        f"no place {kinds['no place']}, faults {kinds['fault']}"
    )
    for second_outcome in slow:
        print(f"  {second_outcome.cpu_s:6.2f} s CPU  {second_outcome.status:10}  {second_outcome.name}")
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
    arguments = options.parse_args()
    faults = (
        0
        if arguments.no_pairs
        else _print_outcomes("all pairs", [*all_pairs(), *pairs_of_pins()], arguments.time_limit)
    )
    faults += _print_outcomes("random triples", random_triples(arguments.triples, arguments.seed), arguments.time_limit)
    return 1 if faults else 0


raise SystemExit(main())
