"""Text of a request, fit to stand in a document."""

import re

# control characters, what may stand in no XML, and marks that turn the direction of all that follows
_UNFIT = re.compile(
    "[\x00-\x08\x0b\x0c\x0e-\x1f\x7f-\x9f\u200e\u200f\u2028\u2029\u202a-\u202e\u2066-\u2069\ud800-\udfff\ufffe\uffff]"
)


def plain(text: str) -> str:
    """The text, with U+FFFD for every character that does not print or would reorder its neighbours."""
    return _UNFIT.sub("\ufffd", text)


#: a spreadsheet takes a text that begins like this for a formula
FORMULA = r"^[=+\-@\t\r]"


def inert(text: str) -> str:
    """The text of a cell of CSV: what a spreadsheet would run begins with an apostrophe."""
    return f"'{text}" if re.match(FORMULA, text) else text
