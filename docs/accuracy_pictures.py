"""Measure the examples of docs/accuracy.md and write its pictures and tables: ``python docs/accuracy_pictures.py``."""

import re
from collections.abc import Iterator
from pathlib import Path

from accuracy_conclusions import on_effects, on_ladders, on_peaks

from optimizer.mechanics.layout import layout
from optimizer.studies.accuracy.measure import accuracy
from optimizer.studies.accuracy.peaks import peaks_ladder
from schemas.request.accuracy import AccuracyAnswer, AccuracyRequest
from service.documents.examples import load
from service.report.accuracy_picture import draw
from service.report.chapters.accuracy import method_name

DOCS = Path(__file__).parent
DOCUMENT = DOCS / "accuracy.md"
EXAMPLES = ("single-horizontal", "2d12", "v8-cross-plane", "m-type-four")
REPEATS = 20
#: what the effects are shown for: with gas, and with inertia alone
EFFECTS = ("2d12", "v8-cross-plane")
#: and the peaks: with valves and friction that jump, and over two turns
PEAKS = ("2d12", "inline-four-engine")


def _scientific(value: float | None) -> str:
    return "-" if value is None else f"{value:.1e}"


def tables(name: str, answer: AccuracyAnswer) -> Iterator[tuple[str, str]]:
    """Blocks of the document by name."""
    lines = [
        "| method | setting | time, ms | first, ms | error | as drawn | certified gap | frontier |",
        "|---|---|--:|--:|--:|--:|--:|---|",
    ]
    for row in answer.ladder:
        times = (f"{value:.2f}" if value is not None else "-" for value in (row.time_ms, row.first_ms))
        errors = map(_scientific, (row.relative_error, row.as_drawn_error, row.certified_gap))
        cells = (method_name(row.method), row.setting, *times, *errors, "yes" if row.on_frontier else "")
        lines.append(f"| {' | '.join(cells)} |")
    yield f"ladder {name}", "\n".join(lines)
    if name in EFFECTS:
        lines = ["| figure | method | setting | time, ms | error |", "|---|---|---|--:|--:|"]
        for rung in answer.effects_ladder:
            cells = (rung.quantity.replace("_", " "), method_name(rung.method), rung.setting)
            lines.append(f"| {' | '.join(cells)} | {rung.time_ms:.2f} | {_scientific(rung.relative_error)} |")
        yield f"effects {name}", "\n".join(lines)


def peaks(name: str) -> tuple[str, str]:
    """The table of the peaks of an example."""
    machine = AccuracyRequest.model_validate_json(load(name)).machine
    lines = [
        "| peak | method | setting | angles | time, ms | missed | certified gap |",
        "|---|---|---|--:|--:|--:|--:|",
    ]
    for row in peaks_ladder(machine, layout(machine), REPEATS):
        cells = (row.quantity.removeprefix("peak_").replace("_", " "), method_name(row.method), row.setting)
        figures = ("-" if row.angles is None else str(row.angles), f"{row.time_ms:.2f}", _missed(row.relative_error))
        lines.append(f"| {' | '.join((*cells, *figures))} | {_scientific(row.certified_gap)} |")
    return f"peaks {name}", "\n".join(lines)


def _missed(error: float) -> str:
    """A share of a peak; below its rounding nothing."""
    return "0" if error < 1e-12 else _scientific(error)


def write() -> None:
    """Measure, draw, and put the tables between their marks."""
    text = with_peaks(DOCUMENT.read_text())
    for name in EXAMPLES:
        request = AccuracyRequest.model_validate_json(load(name)).model_copy(update={"repeats": REPEATS})
        answer = accuracy(request)
        (DOCS / f"accuracy-{name}.svg").write_text(draw(request.machine.name or name, answer))
        for mark, table in tables(name, answer):
            text = put(text, mark, table)
    DOCUMENT.write_text(conclude(text))


def with_peaks(text: str) -> str:
    """The document with the tables of the peaks measured anew."""
    for name in PEAKS:
        text = put(text, *peaks(name))
    return text


def conclude(text: str) -> str:
    """The document with the conclusions that its tables allow."""
    functions = {"ladder": on_ladders, "effects": on_effects, "peaks": on_peaks}
    for mark, conclusions in functions.items():
        text = put(text, f"conclusions {mark}", conclusions(text))
    return text


def put(text: str, mark: str, block: str) -> str:
    """The text with a block between its marks.

    Raises
    ------
    LookupError
        if the document has no such marks.
    """
    pattern = re.compile(rf"(<!-- {mark} -->\n).*?(\n<!-- end -->)", re.DOTALL)
    text, count = pattern.subn(lambda match: match[1] + block + match[2], text)
    if count != 1:
        raise LookupError(f"{DOCUMENT.name} has no mark for {mark}")
    return text


if __name__ == "__main__":
    write()
