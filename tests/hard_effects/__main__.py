"""Summary of the hard cases of the effects: ``python -m tests.hard_effects [words in the names of cases]``."""

import sys
import time
from collections import defaultdict

from tests.hard_effects.battery import CASES
from tests.hard_effects.case import Finding


def main(texts: list[str]) -> int:
    """Run the cases and print a line for every quantity; 1 if any demand is not met."""
    worst: dict[tuple[str, str], tuple[Finding, str]] = {}
    count: dict[tuple[str, str], set[str]] = defaultdict(set)
    failed, slowest = [], (0.0, "")
    for case in CASES:
        if not all(word in case.id for word in texts):
            continue
        start = time.perf_counter()
        for finding in case.findings():
            key = (case.subject, finding.quantity)
            count[key].add(case.name)
            if key not in worst or finding.error > worst[key][0].error:
                worst[key] = (finding, case.name)
            if not finding.error <= finding.demanded:
                failed.append(f"{case.id}: {finding.quantity} {finding.error:.1e} > {finding.demanded:.1e}")
        slowest = max(slowest, (time.perf_counter() - start, case.id))
    print(f"{'subject':9} {'quantity':34} {'cases':>5} {'worst error':>11} {'demanded':>9}  worst case")
    for (subject, quantity), (finding, name) in worst.items():
        cases = len(count[subject, quantity])
        print(f"{subject:9} {quantity:34} {cases:5} {finding.error:11.1e} {finding.demanded:9.0e}  {name}")
    total = len({(subject, name) for (subject, _), names in count.items() for name in names})
    print(f"\n{total} cases, {len(failed)} demands not met; slowest {slowest[1]}, {slowest[0]:.1f} s")
    for line in failed:
        print("  " + line)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
