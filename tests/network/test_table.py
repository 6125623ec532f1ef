"""The table of shares: the document shows it, and what is answered is what it says."""

from math import inf
from pathlib import Path

import pytest

from service.fairness.faults import FAULTS, Busy, OverShare, TooManyConnections
from service.fairness.table import Refusal, Share, shares
from service.settings import Settings

DOCUMENT = Path(__file__).parents[2] / "docs" / "operation.md"
TABLE = shares(Settings(concurrent_solves=2))


def amount(share: Share, value: float) -> str:
    if value in (0, inf):
        return {0: "", inf: "any"}[value]
    return f"{value / 1e6:g} MB" if share.unit.startswith("bytes") else f"{value:g}"


def row(share: Share) -> str:
    assured = amount(share, share.assured)
    if share.reserve not in (0, inf):
        assured += f", of {share.reserve:g} more"
    answer = " ".join(map(str, share.answer)) if isinstance(share.answer, Refusal) else share.answer
    cells = (share.unit, amount(share, share.per_client), amount(share, share.altogether), assured, answer)
    return f"| {' | '.join(cells)} |".replace("|  |", "| |")


def test_the_document_shows_the_table() -> None:
    """Of a service with the defaults on two cores."""
    head = "| at a time | each client | altogether | assured to each | to more |\n|---|---|---|---|---|\n"
    assert head + "\n".join(map(row, TABLE.values())) + "\n\n" in DOCUMENT.read_text()


@pytest.mark.parametrize(
    ("error", "resource"), [(TooManyConnections(), "connections"), (Busy(1, 1), "waiting"), (OverShare(), "rows")]
)
def test_what_is_answered_is_in_the_table(error: Exception, resource: str) -> None:
    fault = FAULTS[type(error)](error)
    assert (fault.status, fault.title) == next(share.answer for name, share in TABLE.items() if name == resource)
