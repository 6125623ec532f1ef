"""What one should know beside the answer: its warnings, and how much of each crank is balanced."""

from collections.abc import Iterator

from schemas.answer.answers import AnalyzeAnswer, OptimizeAnswer
from service.report.blocks import Block, Chapter, Paragraph, table

_HEADS = ["throw", "#balance rate", "#sideways"]


def worth_knowing(answer: OptimizeAnswer | AnalyzeAnswer) -> Iterator[Chapter]:
    """Nothing where there is neither."""
    blocks: list[Block] = [Paragraph(caution.message, "warning") for caution in answer.warnings]
    rates = [(share.name or str(share.throw + 1), share.rate, share.sideways) for share in answer.balance_rate]
    if rates:
        blocks.append(table("Share of the rotating mass of each throw that its own webs balance", _HEADS, rates))
    if blocks:
        yield Chapter("Worth knowing", tuple(blocks))
