"""What is made of a machine once for all that asks for it: an answer asks the same of one machine many times."""

from collections.abc import Callable
from functools import wraps
from typing import TypeVar

Machine = TypeVar("Machine")
Made = TypeVar("Made")


def remembered(function: Callable[[Machine], Made]) -> Callable[[Machine], Made]:
    """The function, which remembers what it made of the last machine that it was given.

    Machines are frozen, so that the very same one has the same of everything; whoever gets an array writes nothing
    to it.
    """
    last: tuple[Machine, Made] | None = None

    @wraps(function)
    def memoized(machine: Machine) -> Made:
        nonlocal last
        known = last
        if known is None or known[0] is not machine:
            last = known = (machine, function(machine))
        return known[1]

    return memoized
