"""Figures as they are printed, in documents and in drawings."""

import re

#: between thousands, as SI has it
NARROW = "\N{NARROW NO-BREAK SPACE}"
_THOUSANDS = re.compile(r"(?<=[0-9])(?=(?:[0-9]{3})+$)")


def typeset(figure: str) -> str:
    """A figure as it is printed: a true minus, thousands set apart; a terminal may not have them and keeps neither."""
    whole, mark, rest = figure.partition(".")
    return _THOUSANDS.sub(NARROW, whole).replace("-", "\N{MINUS SIGN}") + mark + rest.replace("-", "\N{MINUS SIGN}")


def digits(value: float) -> str:
    """Six significant digits; the integer part is never cut below a thousand million."""
    if 1e5 <= abs(value) < 1e9:
        return f"{value:.0f}"
    return f"{value + 0.0:.6g}"
