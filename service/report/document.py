"""From a request to its document: the answer of the service, chapter by chapter."""

from collections.abc import Iterator
from dataclasses import replace
from datetime import UTC, datetime

from optimizer.errors import MissingInput
from optimizer.optimize import optimize
from optimizer.outputs.registry import require_inputs
from schemas.answer.answers import OptimizeAnswer
from schemas.answer.outputs import OutputName
from schemas.base.images import png
from schemas.base.model import FieldProblem
from schemas.request.report import ReportRequest
from schemas.request.requests import OptimizeRequest
from service.report.blocks import Attachment, Chapter, Document, facts, table
from service.report.chapters import balance, inputs, reproduction, verdict
from service.report.chapters.alternatives import alternatives
from service.report.chapters.answers import outputs
from service.report.chapters.balance_quality import balance_quality
from service.report.chapters.foundation import foundation_loads
from service.report.chapters.layout import layout
from service.report.chapters.limits import prices
from service.report.chapters.order import workshop_order
from service.report.chapters.verification import Check, check, sentence
from service.report.chapters.versions import compared
from service.report.chapters.workshop import sheets
from service.report.chapters.worst_case import worst_case
from service.report.chapters.worth_knowing import worth_knowing
from service.tables.as_built import as_built

_STATUS = {
    "optimal": "optimal, certified",
    "inaccurate": "not certified to the accuracy asked for",
    "infeasible": "infeasible",
}
#: of the head of the document, as it is filed
_HEAD = (
    "company", "customer", "project", "number", "revision", "drawing", "author", "checker", "approver",
)  # fmt: skip
#: chapters of the first page, which the list of contents comes after
_OPENING = 3
#: outputs that are in every report on a machine that gives what they need
_USUAL: tuple[OutputName, ...] = ("stages", "foundation_loads")


def report(request: ReportRequest, at: datetime | None = None) -> Document:
    """The report on a machine: the request, the result, and the proof.

    The eight balancing stages and the loads on the foundation are in it wherever the machine gives what they need, the
    other outputs if the request names them.

    Parameters
    ----------
    at : time that the document bears; by default now. Nothing else in it changes from one time to the next.

    Raises
    ------
    MissingInput
        if the machine, or that of a version, lacks what a requested output needs.
    """
    full, missing = _with_usual(request.alone)
    answer = optimize(full)
    return document(request, answer, missing, at or datetime.now(UTC), check(full, answer))


def _with_usual(request: OptimizeRequest) -> tuple[OptimizeRequest, tuple[FieldProblem, ...]]:
    more = tuple(name for name in _USUAL if name not in request.outputs)
    try:
        require_inputs(request.machine, more)
    except MissingInput as error:
        return request, tuple(error.problems)
    return request.model_copy(update={"outputs": (*request.outputs, *more)}), ()


def document(
    request: ReportRequest,
    answer: OptimizeAnswer,
    missing: tuple[FieldProblem, ...],
    at: datetime,
    outcome: Check | None = None,
) -> Document:
    """The document that says what an answer says.

    Parameters
    ----------
    missing : what the machine lacks for the eight stages, where the answer does not hold them.
    at : time that the document bears.
    outcome : what became of the claims of the answer; None where they were not checked, which the document then lacks.
    """
    date = at.astimezone(UTC).strftime("%Y-%m-%dT%H:%M:%SZ")
    office = request.document
    day = datetime.fromisoformat(office.date) if office.date is not None else at.astimezone(UTC)
    head = facts(
        "",
        [
            *((name, value) for name in _HEAD if (value := getattr(office, name)) is not None),
            ("status", _STATUS[answer.status]),
            ("date", f"{day:%-d %B %Y}"),
        ],
    )
    changes = [(revision.revision, revision.date, revision.change, revision.author) for revision in office.revisions]
    return Document(
        title=request.machine.name or "Machine without a name",
        subject="Counterweights: report",
        date=date,
        status=answer.status,
        day=f"{day:%-d %B %Y}",
        head=head,
        revisions=table("Revisions", ["revision", "date", "<change", "author"], changes) if changes else None,
        logo=None if office.logo is None else png(office.logo),
        notes=tuple(filter(None, map(str.strip, (office.notes or "").splitlines()))),
        opening=_OPENING,
        chapters=tuple(_chapters(request, answer, missing, date, outcome)),
        file_stem=_file_stem(request),
        attachment=Attachment("request.json", reproduction.request_json(request)),
    )


def _file_stem(request: ReportRequest) -> str:
    """What a file of the document is called: machine, number, revision."""
    parts = (request.machine.name or "counterweights", request.document.number, request.document.revision)
    return " ".join(part for part in parts if part is not None)


def _chapters(
    request: ReportRequest,
    answer: OptimizeAnswer,
    missing: tuple[FieldProblem, ...],
    date: str,
    outcome: Check | None,
) -> Iterator[Chapter]:
    # on the first page: what it comes to, and what is to be made
    built = as_built(request, answer)
    yield verdict.result(request, answer, built)
    yield balance.counterweights(request, answer, built)
    yield from workshop_order(request.machine, answer)
    yield from alternatives(answer)
    if answer.foundation_loads is not None:
        yield foundation_loads(answer.foundation_loads)
    yield layout(request, answer, built)
    yield from compared(request, answer)
    yield inputs.inputs(request, answer.reference_plane_m)
    yield balance.stages(request.machine, answer.stages, missing)
    yield from worth_knowing(answer)
    yield from worst_case(answer)
    yield from balance_quality(request.machine, answer)
    yield balance.before_and_after(request, answer, built)
    proof = verdict.certificate(request, answer)
    if outcome is not None:
        proof = replace(proof, blocks=(*proof.blocks, sentence(outcome, reproduction.digest(request))))
    yield proof
    yield from prices(answer)
    # of the first page
    yield from outputs(request.machine, answer, but="foundation_loads")
    yield from sheets(request.machine, answer, built)
    yield reproduction.effects(answer.effects, request.outputs)
    yield reproduction.appendix(request, date, outcome)
