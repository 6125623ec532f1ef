"""Versions of a design beside the one of the report: what differs, and what each comes to."""

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple

from optimizer.analyze import analyze
from optimizer.errors import MissingInput
from optimizer.optimize import optimize
from schemas.answer.answers import OptimizeAnswer
from schemas.answer.counterweights import Counterweight, every_counterweight
from schemas.answer.first_order import FirstOrder
from schemas.base.model import FieldProblem
from schemas.request.report import DesignVersion, ReportRequest
from schemas.request.requests import AnalyzeRequest
from service.common.figures import digits, typeset
from service.common.validation import pointer
from service.report.blocks import Block, Chapter, Paragraph, Table, table
from service.report.chapters.balance import best_set, best_set_label, carried
from service.tables.whole_mass import whole_mass

#: differences of a version that are listed; of more it is said how many there are
_MOST = 30
_OWN_NAME = "this one"
_MISSING = object()


class Column(NamedTuple):
    """A version, computed."""

    name: str
    status: str
    left: FirstOrder | None
    mass_kg: float | None
    fitted: Sequence[Counterweight]


def compared(request: ReportRequest, answer: OptimizeAnswer) -> Iterator[Chapter]:
    """The chapter, where there are versions.

    Raises
    ------
    MissingInput
        if the machine of a version lacks what its objective needs.
    """
    if not request.versions:
        return
    columns = [
        _optimum(_OWN_NAME, answer),
        *(_column(request, place) for place in range(len(request.versions))),
    ]
    yield Chapter("Versions compared", (_figures(columns), _weights(columns), *_differences(request)))


def _column(request: ReportRequest, place: int) -> Column:
    version = request.versions[place]
    try:
        if version.counterweights is not None:
            machine = version.machine or request.machine
            analysis = analyze(AnalyzeRequest(machine=machine, counterweights=version.counterweights))
            left = analysis.residual.after if analysis.residual is not None else None
            return Column(version.name, "given", left, whole_mass(analysis), every_counterweight(analysis))
        result = optimize(request.request_for(version))
    except MissingInput as error:
        raise MissingInput(
            FieldProblem(("versions", place, *path), message) for path, message in error.problems
        ) from None
    return _optimum(version.name, result)


def _optimum(name: str, answer: OptimizeAnswer) -> Column:
    """What an optimisation came to: where none keep the ceilings, peaks and masses of the best compromise."""
    fitted, left = carried(answer), best_set(answer)[1]
    if answer.infeasibility is None:
        return Column(name, answer.status, left, whole_mass(answer), fitted)
    mass_kg = math.fsum(counterweight.mass_kg for counterweight in fitted)
    return Column(name, f"{answer.status}: {best_set_label(answer)}", left, mass_kg, fitted)


def _figures(columns: Sequence[Column]) -> Table:
    """Key figures, a column for each version, and by how much each differs from the first."""
    rows: list[tuple[str | float | None, ...]] = [("counterweights", *(column.status for column in columns))]
    figures = (
        ("peak force, N", [column.left.force.peak_N if column.left else None for column in columns]),
        ("peak moment, N m", [column.left.moment.peak_Nm if column.left else None for column in columns]),
        ("total mass, kg", [column.mass_kg for column in columns]),
    )
    for name, values in figures:
        rows.append((name, *values))
        rows.append(("difference", "", *(_change(values[0], value) for value in values[1:])))
    return table("Peaks of the first order, and mass", ["", *(f"#{column.name}" for column in columns)], rows)


def _change(was: float | None, now: float | None) -> str:
    if was is None or now is None:
        return "–"
    if not was:
        return "0 %" if not now else "–"
    # zero has no sign
    return typeset(f"{100 * (now - was) / was + 0.0:+.2f} %") if now != was else "0 %"


def _weights(columns: Sequence[Column]) -> Table:
    """Mass and angle on every web of any version."""
    webs = dict.fromkeys(counterweight.web for column in columns for counterweight in column.fitted)
    by_web = [{counterweight.web: counterweight for counterweight in column.fitted} for column in columns]
    rows = [(web, *(_weight(fitted.get(web)) for fitted in by_web)) for web in webs]
    return table("Counterweights: mass, kg, and angle, deg", ["web", *(column.name for column in columns)], rows)


def _weight(counterweight: Counterweight | None) -> str:
    return (
        "none"
        if counterweight is None or not counterweight.mass_kg
        else f"{digits(counterweight.mass_kg)} at {digits(counterweight.angle_deg)}"
    )


def _differences(request: ReportRequest) -> Iterator[Block]:
    """What each version changes in machine and objective."""
    rows: list[tuple[str, ...]] = []
    for version in request.versions:
        changes = list(_changes(request, version))
        rows += [(version.name, *change) for change in changes[:_MOST]]
        if len(changes) > _MOST:
            rows.append((version.name, f"and {len(changes) - _MOST} more", "", ""))
    if rows:
        yield table("What differs", ["version", "<field", "this one", "there"], rows)
    else:
        yield Paragraph("Machine and objective are the same in all of them.")


def _changes(request: ReportRequest, version: DesignVersion) -> Iterator[tuple[str, str, str]]:
    for name in ("machine", "objective"):
        part = getattr(version, name)
        if part is not None:
            yield from _apart((name,), getattr(request, name).model_dump(mode="json"), part.model_dump(mode="json"))


def _apart(path: tuple[str | int, ...], here: Any, there: Any) -> Iterator[tuple[str, str, str]]:
    """Fields that differ: pointer, value here, value there."""
    if isinstance(here, Mapping) and isinstance(there, Mapping):
        for key in dict.fromkeys([*here, *there]):
            yield from _apart((*path, key), here.get(key, _MISSING), there.get(key, _MISSING))
    elif isinstance(here, list) and isinstance(there, list) and len(here) == len(there):
        for index, pair in enumerate(zip(here, there, strict=True)):
            yield from _apart((*path, index), *pair)
    elif here != there:
        yield pointer(path), _short(here), _short(there)


def _short(value: Any) -> str:
    """A value in words."""
    if value is None or value is _MISSING:
        return "none"
    if isinstance(value, list):
        return f"{len(value)} of them"
    if isinstance(value, Mapping):
        return "given"
    return digits(value) if isinstance(value, float) else str(value)
