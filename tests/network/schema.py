"""Schemathesis on this service, from its own document.

``python -m tests.network.schema`` runs every phase on every operation: the examples of the document, the bounds and
alternatives of every field (coverage), requests made up at random (fuzzing), and sequences of requests that follow the
links of answers (stateful). It prints how many requests there were and what failed.
"""

import argparse
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path

from tests.network.serving import service

PHASES = ("examples", "coverage", "fuzzing", "stateful")
#: rules between the numbers of a machine are more than a schema can say, so what fits a schema may be refused (422). A
#: body that breaks a bound may be too large to be read (413)
_CONFIG = """\
[checks.positive_data_acceptance]
expected-statuses = ["2xx", "304", 401, 403, 404, 406, 409, 413, 422, 429, 503]
[checks.negative_data_rejection]
expected-statuses = [400, 401, 403, 404, 405, 406, 409, 413, 415, 422, 429, 503]
"""
_LONGEST_LINE = 500
_GENERATED = re.compile(r"(\d+) generated")


def run(url: str, phases: Sequence[str], examples: int, *more: str) -> tuple[int, int, str]:
    """Run some phases with all checks: how the run has ended, how many requests it made, and what it has printed.

    Parameters
    ----------
    examples : requests made up for an operation.
    more : arguments of the command line, as ``--include-path``.
    """
    command = shutil.which("schemathesis", path=str(Path(sys.executable).parent))
    assert command is not None
    with tempfile.TemporaryDirectory() as folder:
        config = Path(folder) / "schemathesis.toml"
        config.write_text(_CONFIG)
        arguments = [
            *("--config-file", str(config), "run", f"{url}/openapi.json", "--no-color", "--phases", ",".join(phases)),
            *("--max-examples", str(examples), "--continue-on-failure", "--no-shrink", "--warnings", "off"),
            *("--suppress-health-check", "all", "--generation-database", "none", "--request-timeout", "600", *more),
        ]
        process = subprocess.run([command, *arguments], cwd=folder, capture_output=True, text=True, check=False)
    lines = [line[:_LONGEST_LINE] for line in (process.stdout + process.stderr).splitlines()]
    text = "\n".join(lines)
    match = _GENERATED.search(text)
    return process.returncode, int(match[1]) if match else 0, text


def main() -> int:
    """Every operation, or some of them."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--examples", type=int, default=50)
    parser.add_argument("--phases", nargs="+", choices=PHASES, default=PHASES)
    parser.add_argument("--path", nargs="*", default=[], help="of the operations; all of them by default")
    chosen = parser.parse_args()
    paths = [f"--include-path={path}" for path in chosen.path]
    with service(log_level="warning") as target:
        code, count, text = run(target.url, chosen.phases, chosen.examples, *paths)
        faults = target.faults()
    print(text)
    print(f"{count} requests, {len(faults)} faults logged", *(line[-_LONGEST_LINE:] for line in faults), sep="\n")
    return 1 if code or faults or not count else 0


if __name__ == "__main__":
    sys.exit(main())
