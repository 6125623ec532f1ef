"""The list of outputs and effects, and lists of names."""

from collections.abc import Iterator, Sequence

from schemas.answer.effects import EffectCatalogue
from service.report.blocks import Chapter, table


def names(title: str, entries: Sequence[tuple[str, str]]) -> Iterator[Chapter]:
    """Names with what they stand for."""
    yield Chapter(title, (table("", ["name", ""], entries),))


def effects(catalogue: EffectCatalogue) -> Iterator[Chapter]:
    """Outputs and effects, each with what it simulates and reads."""
    heads = ["name", "", "needs", "inputs beyond masses and geometry"]
    for title, entries in (("Outputs", catalogue.outputs), ("Effects", catalogue.effects)):
        rows = [(entry.name, entry.meaning, ", ".join(entry.needs), ", ".join(entry.inputs)) for entry in entries]
        yield Chapter(title, (table("", heads, rows),))
