"""Sentence lengths and discouraged words of texts; ``python -m tests.docs.sentences`` prints them by file."""

import ast
import re
from functools import cache
from pathlib import Path
from statistics import median
from typing import NamedTuple

from tests.docs.reading import ROOT

#: the longest median and the longest ninetieth percentile that a text may have, words
LONGEST_MEDIAN, LONGEST_P90 = 18, 30

#: words that are no nouns of the field, with what is written in their place; names in code are not read
DISCOURAGED = {
    r"yardsticks?": "reference value",
    r"(?:a|the|whole|per|every|half|one|two|over) turns?": "revolution",
    r"told|tells?|telling": "reported, states",
    r"least (?:total |fitted |possible )?mass(?:es)?": "minimum mass",
    r"astray": "off their nominal values",
    r"ample": "large",
    r"dust": "negligible mass",
    r"what (?:remains|is left)": "residual",
    r"(?:this|that|another|in the same|which|a) ways?": "method",
    r"alike": "equal",
}
_DISCOURAGED = {re.compile(rf"\b(?:{pattern})\b", re.IGNORECASE): better for pattern, better in DISCOURAGED.items()}
_BLOCK_START = re.compile(r"^\s*(?:[*+-] |\d+\. |>|#{1,6} |$)")
_SENTENCE_END = re.compile(r"(?<=[.!?])[\")]*\s+(?=[\"(]*[A-Z0-9_])")
#: a cell of a table with fewer words is a label
_LABEL = 8
#: a text in code with fewer words is a name
_SPOKEN = 5
_PACKAGES = {f"texts in {package}/": package for package in ("schemas", "optimizer", "service")}


class Lengths(NamedTuple):
    """Number of sentences of a text, and their median and ninetieth percentile in words."""

    sentences: int
    median: float
    p90: float

    @property
    def within_limits(self) -> bool:
        """Whether the text is as short of breath as the style page asks."""
        return self.median <= LONGEST_MEDIAN and self.p90 <= LONGEST_P90


def prose(text: str) -> str:
    """A text in Markdown without blocks of code, pictures and targets of links; a name in code is one word `_`."""
    text = re.sub(r"^(`{3,}|\$\$).*?^\1\s*$", "", text, flags=re.DOTALL | re.MULTILINE)
    text = re.sub(r"^(?: {4}|\t)\S.*$", "", text, flags=re.MULTILINE)
    text = re.sub(r"<!--.*?-->", "", text, flags=re.DOTALL)
    text = re.sub(r"!\[[^\]]*\]\([^)]*\)", "", text)
    text = re.sub(r"\]\([^)]*\)", "]", text)
    return re.sub(r"(`+)(?:.|\n)+?\1|\$[^$\n]+\$", "_", text)


def sentences(text: str) -> list[str]:
    """Sentences of paragraphs and list items, and the cells of tables that are more than a label."""
    blocks: list[list[str]] = [[]]
    for line in prose(text).splitlines():
        if line.lstrip().startswith("|"):
            cells = (cell.strip() for cell in line.strip().strip("|").split("|"))
            blocks += [[cell] for cell in cells if len(cell.split()) > _LABEL]
            blocks.append([])
        elif line.startswith("#"):
            blocks.append([])
        else:
            if _BLOCK_START.match(line):
                blocks.append([])
            blocks[-1].append(re.sub(r"^\s*(?:[*+-]|\d+\.|>)\s+", "", line).strip())
    paragraphs = (" ".join(block).strip() for block in blocks)
    return [part for paragraph in paragraphs if paragraph for part in _SENTENCE_END.split(paragraph)]


def lengths(tally: list[str]) -> Lengths:
    """Statistics of sentences; zeros where there are none."""
    words = sorted(len(re.findall(r"\w+(?:[^\w\s]\w+)*", words)) for words in tally)
    if not words:
        return Lengths(0, 0.0, 0.0)
    return Lengths(len(words), float(median(words)), float(words[(9 * len(words) - 1) // 10]))


def discouraged(text: str) -> list[tuple[str, str]]:
    """Discouraged words in the order of the list, each with what is written in its place."""
    plain = " ".join(prose(text).split())
    return [(match[0], better) for pattern, better in _DISCOURAGED.items() for match in pattern.finditer(plain)]


def literals(package: Path) -> str:
    """Texts of five words or more in the code of a package, as paragraphs; docstrings are for readers of the code."""
    tally = []
    for path in sorted(package.rglob("*.py")):
        nodes = list(ast.walk(ast.parse(path.read_text())))
        docstrings = {
            id(node.value) for node in nodes if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)
        }
        joined = [node for node in nodes if isinstance(node, ast.JoinedStr)]
        parts = {id(part) for node in joined for part in ast.walk(node) if part is not node}
        texts = [
            "".join(str(part.value) if isinstance(part, ast.Constant) else "`_`" for part in node.values)
            for node in joined
            if id(node) not in parts
        ]
        texts += [
            node.value
            for node in nodes
            if isinstance(node, ast.Constant) and isinstance(node.value, str) and not {id(node)} & (docstrings | parts)
        ]
        tally += [text.strip() for text in texts if len(re.findall(r"[A-Za-z]+", text)) >= _SPOKEN and " " in text]
    return "\n\n".join(tally)


def names() -> list[str]:
    """Every document by its path, and the packages by what their texts are called; nothing of it is read."""
    documents = [ROOT / f"{name}.md" for name in ("README", "CHANGELOG", "CONTRIBUTING")]
    documents += sorted((ROOT / "docs").rglob("*.md"))
    return [*(str(path.relative_to(ROOT)) for path in documents), *_PACKAGES]


@cache
def text(name: str) -> str:
    """The document of a name, or the texts in the code of a package."""
    if name in _PACKAGES:
        return literals(ROOT / _PACKAGES[name])
    tally = (ROOT / name).read_text()
    # the table of the style page quotes what it advises against
    return re.sub(r"^\|.*$", "", tally, flags=re.MULTILINE) if name == "docs/style.md" else tally


def main() -> None:
    """Print a row for each."""
    print(f"{'text':<58} sentences median p90 discouraged")
    for name in names():
        tally = lengths(sentences(text(name)))
        print(
            f"{name:<58} {tally.sentences:9d} {tally.median:6.1f} {tally.p90:3.0f} {len(discouraged(text(name))):11d}"
        )


if __name__ == "__main__":
    main()
