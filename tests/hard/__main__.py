"""``python -m tests.hard``: the whole battery with its summary; exit code 1 if any case misses what is demanded."""

import argparse
import sys
from fnmatch import fnmatch

from rich.console import Console

from tests.hard import stored
from tests.hard.battery import run, summary, warm_up
from tests.hard.cases import all_cases


def main() -> int:
    parser = argparse.ArgumentParser(prog="python -m tests.hard", description=__doc__)
    parser.add_argument("--only", default="*", metavar="PATTERN", help="names of the cases, such as 'webs/*'")
    parser.add_argument("--no-reference", action="store_true", help="hold answers against their own claims only")
    parser.add_argument("--write-reference", action="store_true", help="compute missing reference values and stop")
    arguments = parser.parse_args()
    if arguments.write_reference:
        unproven = stored.write(all_cases())
        print(*unproven, sep="\n")
        return int(bool(unproven))
    chosen = [case for case in all_cases() if fnmatch(case.name, arguments.only)]
    if not chosen:
        parser.error(f"no case is named {arguments.only}")
    content = {} if arguments.no_reference else stored.read()
    missing = [case.name for case in chosen if stored.digest(case.body) not in content]
    if missing and not arguments.no_reference:
        parser.error(f"no reference for {', '.join(missing)}: --write-reference first")
    warm_up(chosen)
    verdicts = [run(case, content.get(stored.digest(case.body))) for case in chosen]
    summary(verdicts, Console())
    return int(any(verdict.faults for verdict in verdicts))


if __name__ == "__main__":
    sys.exit(main())
