"""The hard cases by theme."""

from tests.hard.cases import balance, ceilings, found, limits, rods, sizes, webs, weights
from tests.hard.cases.case import Case

_THEMES = (sizes, webs, limits, ceilings, weights, balance, rods, found)


def all_cases() -> tuple[Case, ...]:
    """Every case, theme by theme; names are unique."""
    every = tuple(case for theme in _THEMES for case in theme.cases())
    names = [case.name for case in every]
    assert len(set(names)) == len(names), "two cases have one name"
    return every
