"""Costs that are common to all tests of a run: paid once by the process that collects, or not at all."""

import gc

from hypothesis import strategies

#: new objects until they are looked through for cycles, and so often until older ones are
_YOUNG, _OLDER, _FULL = 50_000, 10, 10


def collect_seldom() -> None:
    """Look for cycles after more objects; :func:`collect_young` after every file of tests."""
    gc.set_threshold(_YOUNG, _OLDER, _FULL)


def collect_young() -> None:
    """What a file of tests has left open in a cycle is found here, in that file."""
    gc.collect(1)


def make_characters() -> None:
    """Which characters there are, a second of hypothesis: each process that draws a text would make it."""
    strategies.text().validate()
