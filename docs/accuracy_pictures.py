"""Measure the examples of docs/accuracy.md and write its pictures and tables: ``python docs/accuracy_pictures.py``."""

import re
from collections.abc import Iterator
from pathlib import Path

from accuracy_conclusions import on_effects, on_ladders

from optimizer.accuracy.measure import accuracy
from schemas.accuracy import AccuracyAnswer, AccuracyRequest
from service.accuracy_picture import draw
from service.documents.examples import load
from service.report.chapters.accuracy import method_name

DOCS = Path(__file__).parent
DOCUMENT = DOCS / "accuracy.md"
EXAMPLES = ("single-horizontal", "2d12", "v8-cross-plane", "m-type-four")
REPEATS = 20
#: what the effects are shown for: with gas, and with inertia alone
EFFECTS = ("2d12", "v8-cross-plane")


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
        for one in answer.effects_ladder:
            cells = (one.quantity.replace("_", " "), method_name(one.method), one.setting)
            lines.append(f"| {' | '.join(cells)} | {one.time_ms:.2f} | {_scientific(one.relative_error)} |")
        yield f"effects {name}", "\n".join(lines)


def write() -> None:
    """Measure, draw, and put the tables between their marks."""
    text = DOCUMENT.read_text()
    for name in EXAMPLES:
        request = AccuracyRequest.model_validate_json(load(name)).model_copy(update={"repeats": REPEATS})
        answer = accuracy(request)
        (DOCS / f"accuracy-{name}.svg").write_text(draw(request.machine.name or name, answer))
        for mark, table in tables(name, answer):
            text = put(text, mark, table)
    DOCUMENT.write_text(conclude(text))


def conclude(text: str) -> str:
    """The document with the conclusions that its tables allow."""
    return put(put(text, "conclusions ladder", on_ladders(text)), "conclusions effects", on_effects(text))


def put(text: str, mark: str, block: str) -> str:
    """The text with a block between its marks.

    Raises
    ------
    LookupError
        if the document has no such marks.
    """
    pattern = re.compile(rf"(<!-- {mark} -->\n).*?(\n<!-- end -->)", re.DOTALL)
    text, count = pattern.subn(lambda found: found[1] + block + found[2], text)
    if count != 1:
        raise LookupError(f"{DOCUMENT.name} has no mark for {mark}")
    return text


if __name__ == "__main__":
    write()
