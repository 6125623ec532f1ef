"""Lines that the tests of a room run, noted once: a file of tests runs again when it, or the code, is another."""

import hashlib
import json
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

from tests.mutation.choice import Trial

#: what is noted, in the tree itself
FOLDER = ".mutation"


def line_map(
    notes: Path, copy: Path, pattern: str, tests: Iterable[str], run: Callable[[list[str], dict[str, str]], int]
) -> list[Trial] | None:
    """Tests with the lines that they run; None where one fails without a fault.

    notes is the file that they are noted in, copy the tree that they run in, pattern says the files that are looked at.
    """
    document: dict[str, Any] = json.loads(notes.read_text()) if notes.exists() else {}
    code = b"".join(path.read_bytes() for path in sorted(copy.glob(pattern)))
    keys = {
        str(path.relative_to(copy)): hashlib.sha256(code + path.read_bytes()).hexdigest()
        for name in tests
        for path in sorted((copy / name).rglob("test_*.py") if (copy / name).is_dir() else [copy / name])
    }
    missing = [name for name, key in keys.items() if name not in document or document[name]["key"] != key]
    if missing:
        written = copy / "covered.json"
        written.unlink(missing_ok=True)
        run(["-p", "tests.mutation.cover", *missing], {"COVERED_FILES": pattern, "COVERED_TO": str(written)})
        record = json.loads(written.read_text()) if written.exists() else {}
        empty = {"passed": written.exists(), "tests": {}, "shared": {}}
        document |= {name: {"key": keys[name]} | record.get(name, empty) for name in missing}
        notes.parent.mkdir(exist_ok=True)
        notes.write_text(json.dumps({name: file for name, file in document.items() if file["passed"]}))
    if not all(document[name]["passed"] for name in keys):
        return None
    return [
        Trial(test, seconds, _sets(lines), shared)
        for name in keys
        for shared in [_sets(document[name]["shared"])]
        for test, (seconds, lines) in document[name]["tests"].items()
    ]


def _sets(lines: dict[str, list[int]]) -> dict[str, frozenset[int]]:
    return {name: frozenset(line) for name, line in lines.items()}
