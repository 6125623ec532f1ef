"""Text of a request, fit to stand in a document."""

import re

# control characters, what may stand in no XML, marks that turn the direction of all that follows, what takes no room
# and joins nothing; joiners and breaks that scripts need stay
_UNFIT = re.compile(
    "[\x00-\x08\x0b\x0c\x0e-\x1f\x7f-\x9f\u061c\u180e\u200e\u200f\u2028\u2029\u202a-\u202e\u2060-\u206f\ufeff\ufff9-\ufffb"
    "\ud800-\udfff\ufdd0-\ufdef\ufffe\uffff\U000e0000-\U000e007f"
    + "".join(f"{chr(plane + 0xFFFE)}{chr(plane + 0xFFFF)}" for plane in range(0x10000, 0x110000, 0x10000))
    + "]"
)


def plain(text: str) -> str:
    """The text, with U+FFFD for every character that does not print or would reorder its neighbours."""
    return _UNFIT.sub("\ufffd", text)


# what a spreadsheet skips, or does not show, before a formula
_BLANK = (
    r"\x00-\x20\x7f"
    "\u0080-\u00a0\u00ad\u034f\u061c\u115f\u1160\u1680\u180b-\u180f\u2000-\u200f\u2028-\u202f\u205f-\u206f\u2800\u3000"
    "\u3164\ufe00-\ufe0f\ufeff\uffa0\ufff9-\ufffb"
)
# also in the widths of other scripts, which programs set to such take for these
_SIGN = r"=+\-@" "\u2212\ufe62\ufe63\ufe66\ufe6b\uff0b\uff0d\uff1d\uff20"
#: a spreadsheet takes a text that begins like this for a formula, and one with a separator of its own for two cells.
#: The readers are those of expressions of Python and of Arrow
FORMULA = rf"^(?:[{_BLANK}]*[{_SIGN}]|[\t\r\n])"
SECOND_CELL = rf'([;\t\r\n][{_BLANK}"]*)([{_SIGN}])'
#: what stands in place of such a second cell
TEXT_CELL = r"\1'\2"


def inert(text: str) -> str:
    """The text of a cell of CSV: what a spreadsheet would run begins with an apostrophe."""
    quoted = re.sub(SECOND_CELL, TEXT_CELL, text)
    return f"'{quoted}" if re.match(FORMULA, text) else quoted
