"""Cases that a search broke the service with, kept as they were found (found.json)."""

import json
from collections.abc import Iterator
from pathlib import Path

from tests.hard.cases.case import Case

_FILE = Path(__file__).with_name("found.json")


def cases() -> Iterator[Case]:
    for entry in json.loads(_FILE.read_text()):
        yield Case(
            f"found/{entry['name']}",
            entry["why"],
            entry["body"],
            entry.get("ordinary", False),
            entry.get("peaks_unique", True),
        )
