"""Formulas of the answers, written in ASCII, as text with raised and lowered parts."""

import re
from collections.abc import Iterator

from service.report.blocks import Formula, Run

_WORDS = {"omega": "ω", "theta": "θ", "sum": "Σ ", "lambda": "λ", "delta": "δ", "<=": "≤", ">=": "≥", "-": "−"}
_TOKEN = re.compile(
    r"(?P<word>omega|theta|sum |lambda|delta|<=|>=)"
    r"|\^\{(?P<long>[^{}]*)\}|\^(?P<power>\w)"
    r"|_\{(?P<index>[^{}]*)\}|_(?P<suffix>[A-Za-z0-9]+)"
    r"|(?<![A-Za-z0-9.])(?P<letter>[A-Za-z])(?P<number>[0-9])(?![A-Za-z0-9])"
)


def formula(text: str) -> Formula:
    """``|A1| + |B1| = omega^2/2 sum m_r e^{jd}`` as runs; what is no notation stays as it is."""
    return tuple(run for run in _runs(text) if run.text)


def _runs(text: str) -> Iterator[Run]:
    end = 0
    for match in _TOKEN.finditer(text):
        yield Run(_signs(text[end : match.start()]))
        end = match.end()
        result = match.groupdict()
        if result["letter"] is not None:
            yield Run(result["letter"])
            yield Run(result["number"], "sub")
        elif result["word"] is not None:
            yield Run(_WORDS[result["word"].strip()])
        elif result["long"] is not None or result["power"] is not None:
            yield Run(_inside(result["long"] or result["power"]), "sup")
        else:
            yield Run(_inside(result["index"] or result["suffix"]), "sub")
    yield Run(_signs(text[end:]))


def _inside(text: str) -> str:
    for word, sign in (("theta", "θ"), ("omega", "ω")):
        text = text.replace(word, sign)
    return _signs(text)


def _signs(text: str) -> str:
    """Minus signs between blanks or before a term; hyphens inside words stay."""
    return re.sub(r"(?<![A-Za-z])-(?![A-Za-z]{2})|(?<=\d)-(?=[A-Za-z0-9])", "−", text)
