"""What became of the claims of an answer."""

import hashlib
import json
from collections.abc import Iterator
from typing import NamedTuple

from schemas.answer.answers import OptimizeAnswer
from schemas.request.requests import OptimizeRequest
from schemas.request.verify import Claim, VerifyAnswer, VerifyRequest
from service.common.answer_bytes import json_bytes
from service.common.validation import InvalidRequest
from service.report.blocks import Cell, Chapter, Number, Paragraph, table
from service.verification import verify

#: fields of an answer that say how long it took, and differ from one time to the next
TIMES = ("timing", "effects")
#: characters of a digest that are printed beside a figure; all of them stand in the appendix
SHORT = 16
#: names of what is not covered that are printed in a line
_MOST_NAMES = 6


def verified(answer: VerifyAnswer) -> Iterator[Chapter]:
    """One row for each kind of claim, and for what was not looked at."""
    rows = [(claim.claim, claim.verdict, _margin(claim), claim.where) for claim in answer.claims]
    rows += [("", "not covered", "", name) for name in answer.not_covered]
    title = f"Claims: {answer.checked} of {answer.leaves} are checked"
    yield Chapter(title, (table("", ["claim", "verdict", "#margin", "where"], rows),))


def _margin(claim: Claim) -> Cell:
    return "" if claim.margin is None else Number(claim.margin, f"{claim.margin:.1e}")


class Check(NamedTuple):
    """The check of an answer by the files that share nothing with what computed it; None: too much to be checked."""

    verification: VerifyAnswer | None
    digest: str  # SHA-256 of the answer
    outputs: tuple[str, ...]  # of the request


def check(request: OptimizeRequest, answer: OptimizeAnswer) -> Check:
    """The claims of the answer to a request."""
    try:
        result = verify(VerifyRequest(request=request.model_dump(mode="json"), answer=json.loads(json_bytes(answer))))
    except InvalidRequest:
        return Check(None, digest(answer), request.outputs)
    return Check(result, digest(answer), request.outputs)


def digest(answer: OptimizeAnswer) -> str:
    """SHA-256 of an answer as JSON without blanks, keys sorted, ASCII only, without the times that it took."""
    body = json.loads(answer.model_dump_json(exclude={*TIMES}))
    content = json.dumps(body, sort_keys=True, separators=(",", ":"))
    return hashlib.sha256(content.encode()).hexdigest()


def sentence(outcome: Check, request: str) -> Paragraph:
    """How many claims were checked, what became of them, and of which request and answer.

    Parameters
    ----------
    request : digest of the request.
    """
    digests = f"Digests: request {request[:SHORT]}, answer {outcome.digest[:SHORT]}."
    if outcome.verification is None:
        return Paragraph(f"The answer holds more than is checked at a time: nothing was checked. {digests}", "warning")
    result = outcome.verification
    count = f"Checked by files that share nothing with what computed it: {result.checked} of {result.leaves} claims"
    if result.verdict == "broken":
        broken = ", ".join(
            f"{claim.claim} ({_words(claim.where)})" for claim in result.claims if claim.verdict == "broken"
        )
        return Paragraph(f"{count}. Broken: {broken}. {digests}", "warning")
    if result.verdict == "held":
        return Paragraph(f"{count}, and every one holds. {digests}")
    open_claims = (claim.where for claim in result.claims if claim.verdict == "not covered")
    names = [*dict.fromkeys(map(_words, (*open_claims, *result.not_covered)))]
    more = f" and {len(names) - _MOST_NAMES} more" if len(names) > _MOST_NAMES else ""
    return Paragraph(f"{count}; nothing is broken. Not covered: {', '.join(names[:_MOST_NAMES])}{more}. {digests}")


def _words(pointer: str) -> str:
    """Fields of a place in an answer or a request."""
    return " ".join(part.replace("~1", "/").replace("~0", "~") for part in pointer.split("/")[2:])
