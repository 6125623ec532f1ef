"""From a request to its document: the answer of the service, chapter by chapter."""

from collections.abc import Iterator
from datetime import UTC, datetime

from optimizer.errors import MissingInput
from optimizer.optimize import optimize
from optimizer.outputs.registry import require_inputs
from schemas.answer.answers import OptimizeAnswer
from schemas.base.model import FieldProblem
from schemas.request.report import ReportRequest
from schemas.request.requests import OptimizeRequest
from service.report.blocks import Attachment, Chapter, Document, facts
from service.report.chapters import balance, inputs, reproduction, verdict
from service.report.chapters.answers import outputs
from service.report.chapters.balance_quality import balance_quality
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
_HEAD = ("project", "number", "revision", "drawing", "author", "checker")
#: chapters of the first page, which the list of contents comes after
_OPENING = 2


def report(request: ReportRequest, at: datetime | None = None) -> Document:
    """The report on a machine: what was asked, what was found, and the proof.

    The eight balancing stages are in it wherever the machine gives what they need, the other outputs as asked for.

    Parameters
    ----------
    at : time that the document bears; now if not given. Nothing else in it changes from one time to the next.

    Raises
    ------
    MissingInput
        if the machine, or that of a version, lacks what a requested output needs.
    """
    full, missing = _with_stages(request.alone)
    return document(request, optimize(full), missing, at or datetime.now(UTC))


def _with_stages(request: OptimizeRequest) -> tuple[OptimizeRequest, tuple[FieldProblem, ...]]:
    if "stages" in request.outputs:
        return request, ()
    try:
        require_inputs(request.machine, ("stages",))
    except MissingInput as error:
        return request, tuple(error.problems)
    return request.model_copy(update={"outputs": (*request.outputs, "stages")}), ()


def document(
    request: ReportRequest, answer: OptimizeAnswer, missing: tuple[FieldProblem, ...], at: datetime
) -> Document:
    """The document that says what an answer says.

    Parameters
    ----------
    missing : what the machine lacks for the eight stages, where the answer does not hold them.
    at : time that the document bears.
    """
    date = at.astimezone(UTC).strftime("%Y-%m-%dT%H:%M:%SZ")
    used = ", ".join(f"{name} {version}" for name, version in reproduction.versions().items())
    head = facts(
        "",
        [
            *((name, value) for name in _HEAD if (value := getattr(request.document, name)) is not None),
            ("status", _STATUS[answer.status]),
            ("date", date),
            ("computed with", used),
            ("digest of the request", reproduction.digest(request)),
        ],
    )
    return Document(
        title=request.machine.name or "Machine without a name",
        subject="Counterweights: report",
        date=date,
        status=answer.status,
        head=head,
        notes=tuple(filter(None, map(str.strip, (request.document.notes or "").splitlines()))),
        opening=_OPENING,
        chapters=tuple(_chapters(request, answer, missing)),
        file_stem=_file_stem(request),
        attachment=Attachment("request.json", reproduction.request_json(request)),
    )


def _file_stem(request: ReportRequest) -> str:
    """What a file of the document is called: machine, number, revision."""
    known = (request.machine.name or "counterweights", request.document.number, request.document.revision)
    return " ".join(each for each in known if each is not None)


def _chapters(request: ReportRequest, answer: OptimizeAnswer, missing: tuple[FieldProblem, ...]) -> Iterator[Chapter]:
    # on the first page: what it comes to, and what is to be made
    built = as_built(request, answer)
    yield verdict.result(request, answer, built)
    yield balance.counterweights(request, answer, built)
    yield balance.layout(request, answer, built)
    yield from compared(request, answer)
    yield inputs.inputs(request, answer.reference_plane_m)
    yield balance.stages(request.machine, answer.stages, missing)
    yield from worth_knowing(answer)
    yield from worst_case(answer)
    yield from balance_quality(request.machine, answer)
    yield balance.before_and_after(request, answer)
    yield verdict.certificate(answer.certificate, answer.infeasibility)
    yield from outputs(request.machine, answer)
    yield from sheets(request.machine, answer, built)
    yield reproduction.effects(answer.effects, request.outputs)
    yield reproduction.appendix(request)
