"""Where a document shows each figure of an answer: found by changing one at a time and looking at what changes.

``python -m tests.report_document.follow`` prints the table of follows.txt. A place that the table does not name, or one
that no longer changes, fails tests/report_document/test_follows.py: a field printed in the place of another does both.
"""

import re
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping
from copy import deepcopy
from dataclasses import dataclass
from functools import cache, cached_property
from itertools import takewhile
from pathlib import Path
from typing import Any, NamedTuple, get_args

from optimizer.optimize import optimize
from schemas.answer.answers import OptimizeAnswer
from schemas.answer.outputs import OutputName
from schemas.base.model import Model
from schemas.request.report import ReportRequest
from service.report.blocks import Chapter, Document, Figure, Number, Paragraph, Table
from service.report.document import document
from tests.report_document.conftest import AT, request_of

TABLE = Path(__file__).with_name("follows.txt")
#: the example whose answer has most kinds of figures, with all that it can be asked for
EXAMPLE = "2d12"
#: a list of more numbers than this is a series over the cycle
_SERIES = 16
#: of the largest of a kind of leaf, what counts as equal to it
_EQUAL = 0.99
NOWHERE = "nowhere"

Step = str | int
Path_ = tuple[Step, ...]
#: a place of a document, with what stands there
Places = Mapping[str, object]


class Change(NamedTuple):
    """A leaf of the answer, and how it is changed: a little, or above or below all of its series."""

    path: Path_
    how: str

    @property
    def name(self) -> str:
        """Its path, without the places in lists, and the sense."""
        return pattern(self.path) + {"little": "", "above": " above", "below": " below"}[self.how]


def pattern(path: Path_) -> str:
    """A path without the places in lists."""
    return ".".join("[]" if isinstance(step, int) else step for step in path).replace(".[]", "[]")


@dataclass(frozen=True)
class Subject:
    """What a document is about, and how the document is made of it; nothing is computed but what chapters derive."""

    about: Model
    rendered: Callable[[Any], Iterable[Chapter]]
    #: how the names of leaves begin that no document shows
    left_out: tuple[str, ...] = ()

    @cached_property
    def body(self) -> dict[str, Any]:
        """What it is about, as plain values."""
        return self.about.model_dump()

    @cached_property
    def unchanged(self) -> Places:
        """Places of the document on what was found."""
        return places(self.rendered(self.about))

    @cached_property
    def changes(self) -> list[Change]:
        """One for each kind of leaf: the last of the largest; of a series its last number, both ways."""
        kinds: dict[str, list[tuple[Path_, float]]] = {}
        for path, value in leaves(self.body):
            kinds.setdefault(pattern(path), []).append((path, abs(value)))
        changes = []
        for name, members in kinds.items():
            if name.startswith(self.left_out):
                continue
            largest = max(size for _, size in members)
            series = self._in_series(members[-1][0])
            # what is equal but for rounding is equal on every machine
            path = [path for path, size in members if series or size >= _EQUAL * largest][-1]
            changes += [Change(path, how) for how in (("above", "below") if series else ("little",))]
        return changes

    def _in_series(self, path: Path_) -> bool:
        """Whether a number is one of a series of ordinates; an abscissa keeps its place in the order."""
        if not isinstance(path[-1], int) or str(path[-2]).endswith(("angle_deg", "position_m")):
            return False
        return len(_at(self.body, path[:-1])) > _SERIES

    def changed(self, change: Change) -> tuple[float, float, Any]:
        """The number before and after, and the answer with nothing else changed."""
        body = deepcopy(self.body)
        *above, key = change.path
        home = _at(body, tuple(above))
        if isinstance(home, tuple):
            home = list(home)
            _at(body, tuple(above[:-1]))[above[-1]] = home
        old = home[key]
        if change.how == "little":
            # an angle of a series stays below the next turn
            new = old + 0.37 if isinstance(key, int) else 1.0137 * old or 0.0137
        else:
            # beside all others by a third of what they span, with digits of its own
            beyond = max(home) - min(home) or 1.0
            new = max(home) + 0.31337 * beyond if change.how == "above" else min(home) - 0.31337 * beyond
        home[key] = new
        return old, new, type(self.about).model_validate(body)

    def changed_together(self) -> tuple[dict[str, float], Any]:
        """All but series changed at once, each a little and by a share of its own: the new numbers by their names."""
        body, numbers = deepcopy(self.body), dict[str, float]()
        for number, change in enumerate(variant for variant in self.changes if variant.how == "little"):
            *above, key = change.path
            for length, step in enumerate(above):
                home = _at(body, tuple(above[:length]))
                home[step] = list(home[step]) if isinstance(home[step], tuple) else home[step]
            home = _at(body, tuple(above))
            home[key] = numbers[change.name] = (home[key] or 1.0) * (1.001 + 1e-5 * number)
        return numbers, type(self.about).model_validate(body)

    def follows(self, change: Change) -> list[str]:
        """Places that change with a leaf: `=` those that show it itself, `~` those that follow from it."""
        old, new, value = self.changed(change)
        before, after = self.unchanged, places(self.rendered(value))
        actual_places = [place for place in {**before, **after} if before.get(place) != after.get(place)]
        texts = [
            ("= " if after.get(place) == new and (change.how != "little" or before.get(place) == old) else "~ ") + place
            for place in actual_places
        ]
        return texts or [NOWHERE]

    def written(self) -> Iterator[str]:
        """The table: a line for every kind of leaf, the places below it."""
        for change in self.changes:
            yield f"{change.name}\n" + "".join(f"    {place}\n" for place in self.follows(change))


@cache
def request() -> ReportRequest:
    """What the document is asked for."""
    outputs = [name for name in get_args(OutputName) if name != "pin_loads"]
    return request_of(EXAMPLE, outputs=outputs, angles={"step_deg": 10})


@cache
def answer() -> OptimizeAnswer:
    """What was found."""
    return optimize(request().alone)


def rendered(optimum: OptimizeAnswer) -> Document:
    """The report on an answer, without versions and check."""
    return document(request(), optimum, (), AT)


@cache
def subject() -> Subject:
    """The answer with its report."""
    return Subject(answer(), lambda value: rendered(value).chapters)


def leaves(node: Any, path: Path_ = ()) -> Iterator[tuple[Path_, float]]:
    """The physical numbers of an answer; whole ones count or name something."""
    if isinstance(node, Mapping):
        for key, value in node.items():
            yield from leaves(value, (*path, key))
    elif isinstance(node, (list, tuple)):
        for place, value in enumerate(node):
            yield from leaves(value, (*path, place))
    elif isinstance(node, float):
        yield path, node


def _at(node: Any, path: Path_) -> Any:
    for step in path:
        node = node[step]
    return node


def places(chapters: Iterable[Chapter]) -> Places:
    """Every number, text and drawing of a document, by chapter, table, row and column."""
    fields: dict[str, object] = {}
    for chapter in chapters:
        for block in chapter.blocks:
            for name, value in _of_block(block):
                label = f"{chapter.title} | {name}"
                while label in fields:
                    label += "'"
                fields[label] = value
    return fields


def _of_block(block: object) -> Iterator[tuple[str, object]]:
    if isinstance(block, Table):
        titles = _columns(block)
        for row in block.rows:
            # the texts that a row begins with
            head = ", ".join(cell for cell in takewhile(lambda cell: isinstance(cell, str), row) if cell)
            for title, cell in zip(titles, row, strict=True):
                value = cell.value if isinstance(cell, Number) else cell
                yield " | ".join(filter(None, (block.title, head, title))), value
    elif isinstance(block, Figure):
        for drawing in block.drawings:
            yield f"figure: {_first(block.caption or drawing.label)}", drawing.svg()
        if block.samples is not None:
            for name, line in block.samples.lines:
                yield f"samples: {block.samples.title}, {block.samples.unit} | {name}", tuple(line)
    elif isinstance(block, Paragraph):
        yield f"text: {_first(block.text)}", block.text


def _columns(block: Table) -> list[str]:
    """Titles of the columns; one that comes again is named with the one that it follows."""
    titles = [column.title for column in block.columns]
    texts, last = [], ""
    for title in titles:
        if titles.count(title) > 1 and title:
            texts.append(f"{last}: {title}")
        else:
            last = title
            texts.append(title)
    return texts


def _first(text: str) -> str:
    """The beginning of a text, up to its first figure."""
    return re.split(r"[\d.:;,]", text, maxsplit=1)[0][:40].strip()


def stored(table: Path = TABLE) -> dict[str, list[str]]:
    """The table as it is in the file."""
    entries = re.split(r"\n(?! )", table.read_text().strip())
    return {name: [place.strip() for place in places] for name, *places in map(str.splitlines, entries)}


if __name__ == "__main__":
    sys.stdout.writelines(subject().written())
