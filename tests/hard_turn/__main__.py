"""``python -m tests.hard_turn``: hard cases over the whole turn; exit code 1 if any misses what is demanded."""

import argparse
import sys
from collections import Counter
from fnmatch import fnmatch

from tests.hard_turn.cases import all_cases
from tests.hard_turn.judge import run


def main() -> int:
    parser = argparse.ArgumentParser(prog="python -m tests.hard_turn", description=__doc__)
    parser.add_argument("--only", default="*", metavar="PATTERN", help="names of the cases, such as 'webs/*'")
    arguments = parser.parse_args()
    chosen = [case for case in all_cases() if fnmatch(case.name, arguments.only)]
    if not chosen:
        parser.error(f"no case is named {arguments.only}")
    verdicts = [run(case) for case in chosen]
    failed = [verdict for verdict in verdicts if verdict.faults]
    for verdict in failed:
        print(f"{verdict.case.name} ({verdict.case.why})", *verdict.faults, sep="\n    ")
    for verdict in verdicts:
        # allowed where the case says so, and said all the same
        if verdict.status == "inaccurate" and not verdict.faults:
            print(f"{verdict.case.name} ({verdict.case.why}) is inaccurate: {verdict.reason}")
    for theme in dict.fromkeys(verdict.case.theme for verdict in verdicts):
        of_theme = [verdict for verdict in verdicts if verdict.case.theme == theme]
        statuses = ", ".join(
            f"{name} {count}" for name, count in Counter(judgement.status for judgement in of_theme).items()
        )
        optimal = [judgement for judgement in of_theme if judgement.status == "optimal"]
        gap, mass_gap = (
            max((getattr(judgement, name) for judgement in optimal), default=0.0) for name in ("gap", "mass_gap")
        )
        longest = max(judgement.seconds for judgement in of_theme)
        print(f"{theme}: {statuses}; largest gaps {gap:.1e}, of the mass {mass_gap:.1e}; longest {longest:.1f} s")
    print(f"{len(verdicts)} cases, {len(failed)} failed")
    return int(bool(failed))


if __name__ == "__main__":
    sys.exit(main())
