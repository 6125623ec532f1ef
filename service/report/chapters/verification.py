"""What became of the claims of an answer."""

from collections.abc import Iterator

from schemas.request.verify import Claim, VerifyAnswer
from service.report.blocks import Cell, Chapter, Number, table


def verified(answer: VerifyAnswer) -> Iterator[Chapter]:
    """One row for each kind of claim, and for what was not looked at."""
    rows = [(one.claim, one.verdict, _margin(one), one.where) for one in answer.claims]
    rows += [("", "not covered", "", name) for name in answer.not_covered]
    title = f"Claims: {answer.checked} of {answer.leaves} are checked"
    yield Chapter(title, (table("", ["claim", "verdict", "#margin", "where"], rows),))


def _margin(one: Claim) -> Cell:
    return "" if one.margin is None else Number(one.margin, f"{one.margin:.1e}")
