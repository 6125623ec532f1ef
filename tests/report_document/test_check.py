"""The report says how many claims of its answer were checked, and of which request and answer."""

import hashlib
import json
from typing import Any

import pytest

from optimizer.optimize import optimize
from schemas.request.report import ReportRequest
from schemas.request.requests import OptimizeRequest
from service.documents.examples import bodies
from service.report.blocks import Document, Paragraph, Table
from service.report.chapters.reproduction import body
from service.report.chapters.verification import SHORT, Check, check, sentence
from service.report.document import document, report
from service.report.html import html
from service.verification import checker
from tests.report_document.conftest import AT


@pytest.fixture(scope="module")
def request_and_report() -> tuple[ReportRequest, Document]:
    request = ReportRequest.model_validate(bodies("")["two-rows-90"])
    return request, report(request, AT)


def _line(record: Document) -> str:
    (certificate,) = [chapter for chapter in record.chapters if chapter.title == "Certificate"]
    last = certificate.blocks[-1]
    assert isinstance(last, Paragraph)
    return last.text


def _digests(record: Document) -> dict[str, str]:
    rows = [row for block in record.chapters[-1].blocks if isinstance(block, Table) for row in block.rows]
    return {str(row[0]): str(row[1]) for row in rows if str(row[0]).startswith("digest")}


def _digest(value: Any) -> str:
    """As the appendix says that it is computed."""
    return hashlib.sha256(json.dumps(value, sort_keys=True, separators=(",", ":")).encode()).hexdigest()


def test_the_digests_are_those_of_what_is_posted_and_answered(
    request_and_report: tuple[ReportRequest, Document],
) -> None:
    """Independent: the answer of /v1/optimize to the outputs that the appendix names, computed once more."""
    request, record = request_and_report
    (words,) = [b.text for b in record.chapters[-1].blocks if isinstance(b, Paragraph) and "SHA-256" in b.text]
    outputs = words.rpartition("outputs ")[2].rstrip(".").split(", ")
    again = optimize(OptimizeRequest.model_validate({**bodies("")["two-rows-90"], "outputs": outputs}))
    answer = json.loads(again.model_dump_json())
    del answer["timing"], answer["effects"]
    digests = _digests(record)
    assert digests == {"digest of the request": _digest(body(request)), "digest of the answer": _digest(answer)}
    short = [digest[:SHORT] for digest in digests.values()]
    assert _line(record).endswith(f"Digests: request {short[0]}, answer {short[1]}.")


def test_the_line_says_what_the_checker_finds(request_and_report: tuple[ReportRequest, Document]) -> None:
    """Independent: the checker, asked as a stranger asks it."""
    request, record = request_and_report
    file = {**json.loads(request.alone.model_dump_json()), "outputs": ["residual", "stages", "foundation_loads"]}
    answer = json.loads(optimize(OptimizeRequest.model_validate(file)).model_dump_json())
    outcome = checker().verify(file, answer)
    assert outcome["verdict"] == "held"
    count = f"{outcome['checked']} of {outcome['leaves']} claims"
    assert f" {count}" in _line(record)
    assert "Not covered" not in _line(record)
    assert count in html(record).decode()


def test_the_line_follows_the_answer(request_and_report: tuple[ReportRequest, Document]) -> None:
    request, _ = request_and_report
    plain = request.alone
    answer = optimize(plain)
    held = document(request, answer, (), AT, check(plain, answer))
    assert "and every one holds" in _line(held)
    assert answer.total_mass_kg is not None
    wrong = answer.model_copy(update={"total_mass_kg": answer.total_mass_kg * 1.001})
    broken = document(request, wrong, (), AT, check(plain, wrong))
    assert "Broken: total_mass (total_mass_kg)" in _line(broken)
    assert _digests(broken)["digest of the answer"] != _digests(held)["digest of the answer"]
    # the time that it took is no part of the answer
    later = answer.model_copy(update={"timing": answer.timing.model_copy(update={"total_ms": 1e6})})
    assert check(plain, later) == check(plain, answer)


def test_what_holds_too_much_is_said_not_to_be_checked() -> None:
    paragraph = sentence(Check(None, "b" * 64, ("residual",)), "a" * 64)
    assert (paragraph.tone, "nothing was checked" in paragraph.text) == ("warning", True)
    assert paragraph.text.endswith(f"Digests: request {'a' * SHORT}, answer {'b' * SHORT}.")


def test_what_is_not_covered_is_named() -> None:
    """The bound of a choice from a catalogue: no tree is searched again."""
    request = OptimizeRequest.model_validate(bodies("")["catalogue-twin"])
    paragraph = sentence(check(request, optimize(request)), "a" * 64)
    assert "nothing is broken. Not covered: " in paragraph.text
    assert "bound" in paragraph.text
