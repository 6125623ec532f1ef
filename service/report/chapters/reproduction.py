"""What was simulated and why, and all that it takes to compute the report again."""

import hashlib
import json
from collections.abc import Iterator, Mapping
from importlib.metadata import version
from typing import Any

from schemas.answer.answers import EffectUse
from schemas.base.version import package_version
from schemas.request.report import ReportRequest
from service.report.blocks import Chapter, Listing, Paragraph, facts
from service.report.chapters.verification import TIMES, Check

#: characters of a line of the listing
_LINE = 130
#: characters of a logo that are listed
_LOGO_LENGTH = 40
#: fields that are the document's own, and no part of the optimisation
_DOCUMENTS = ("document", "versions")
_PACKAGES = ("numpy", "scipy", "clarabel", "cvxpy")


def effects(uses: Mapping[str, EffectUse], outputs: tuple[str, ...]) -> Chapter:
    """Every effect, and whether it was simulated; GET /v1/effects says what each is for."""
    used = [name.replace("_", " ") for name, use in uses.items() if use.simulated]
    idle = [name.replace("_", " ") for name, use in uses.items() if not use.simulated]
    words = (
        f"Asked for: {', '.join(outputs)}. Only the effects that these need were simulated; the first order of force "
        "and moment needs nothing but masses and geometry."
    )
    sentences = [f"Simulated: {', '.join(used)}.", *([f"Not simulated: {', '.join(idle)}."] if idle else [])]
    return Chapter("Which effects were simulated", (Paragraph(words), Paragraph(" ".join(sentences))))


def versions() -> dict[str, str]:
    """Versions of the package and of what it computes with."""
    return {"counterweight": package_version(), **{name: version(name) for name in _PACKAGES}}


def body(request: ReportRequest) -> dict[str, Any]:
    """The request as it was read; fields of the document only if the client wrote them."""
    result = request.model_dump(mode="json")
    return {name: value for name, value in result.items() if name not in _DOCUMENTS or name in request.model_fields_set}


def _request_fields(request: ReportRequest) -> dict[str, Any]:
    """The request without the defaults of what nobody gave."""
    return request.model_dump(mode="json", exclude_unset=True)


def request_json(request: ReportRequest) -> str:
    """The request as it was read: SI units, defaults filled in, sorted keys, ASCII only."""
    return "\n".join(_lines(body(request), _LINE))


def _without_pixels(fields: dict[str, Any]) -> dict[str, Any]:
    """The request as it is listed: of a logo, which nobody reads, the beginning."""
    head = fields.get("document", {})
    if head.get("logo") is None:
        return fields
    return {**fields, "document": {**head, "logo": f"{head['logo'][:_LOGO_LENGTH]}..."}}


def _lines(value: Any, room: int, before: int = 0) -> Iterator[str]:
    """A value as lines of JSON: what fits on a line is not broken up, what is broken up fills its lines.

    Parameters
    ----------
    before : characters that go before the first line.
    """
    whole = json.dumps(value, sort_keys=True)
    if before + len(whole) <= room or not value or not isinstance(value, dict | list):
        yield whole
        return
    if isinstance(value, dict):
        start, end, items = "{", "}", [(f"{json.dumps(key)}: ", value[key]) for key in sorted(value)]
    else:
        start, end, items = "[", "]", [("", item) for item in value]
    yield start
    filled = ""
    for index, (name, item) in enumerate(items):
        first, *more = _lines(item, room - 1, len(name) + 1)
        lines = [f" {name}{first}", *(f" {line}" for line in more)]
        lines[-1] += "," if index < len(items) - 1 else ""
        if filled and (more or len(filled) + len(lines[0]) > room):
            yield filled
            filled = ""
        if more:
            yield from lines
        else:
            filled += lines[0]
    if filled:
        yield filled
    yield end


def digest(request: ReportRequest) -> str:
    """SHA-256 of the request as JSON without blanks, keys sorted, ASCII only."""
    content = json.dumps(body(request), sort_keys=True, separators=(",", ":"))
    return hashlib.sha256(content.encode()).hexdigest()


def appendix(request: ReportRequest, at: str, outcome: Check | None = None) -> Chapter:
    """The request, then versions, time and its digest.

    Parameters
    ----------
    outcome : the answer's check, where it was checked.
    """
    own = [name for name in _DOCUMENTS if name in request.model_fields_set]
    without = f" without {' and '.join(own)}" if own else ""
    words = (
        "This request, posted to /v1/report or given to the command counterweight report, makes this document again; "
        f"posted to /v1/optimize{without} it answers the same figures as JSON. It is the request as it was read, in SI "
        "units. Fields that nobody gave have their defaults; request.json in the PDF has them all, and has the digest."
    )
    check = (
        "Its digest is SHA-256 of the JSON without blanks and with sorted keys, in Python "
        'hashlib.sha256(json.dumps(request, sort_keys=True, separators=(",", ":")).encode()).hexdigest().'
    )
    used = ", ".join(f"{name} {version}" for name, version in versions().items())
    digests = [("digest of the request", digest(request))]
    if outcome is not None:
        outputs, times = ", ".join(outcome.outputs), " and ".join(TIMES)
        check += (
            f" That of the answer is of the JSON of /v1/optimize likewise, without {times}, where the request has the "
            f"outputs {outputs}."
        )
        digests.append(("digest of the answer", outcome.digest))
    origin = facts("", [("computed with", used), ("at", at), *digests])
    return Chapter(
        "Appendix: request",
        (
            Paragraph(words),
            Listing("\n".join(_lines(_without_pixels(_request_fields(request)), _LINE))),
            Paragraph(check),
            origin,
        ),
    )
