"""What is made once for all that asks for it: an answer asks the same of one machine many times."""

from collections.abc import Callable
from functools import wraps
from typing import TYPE_CHECKING, Any, TypeVar

Machine = TypeVar("Machine")
Part = TypeVar("Part")
Result = TypeVar("Result")

if TYPE_CHECKING:
    from functools import cached_property as cached_property
else:

    class cached_property:  # noqa: N801
        """As that of functools without its lock, which CPython 3.12 gives up too: it takes longer than most of what is
        kept here. Two threads may make the same twice."""

        def __init__(self, function: Callable[[Any], Any]) -> None:
            self.function = function
            self.__doc__ = function.__doc__

        def __set_name__(self, owner: type, name: str) -> None:
            self.name = name

        def __get__(self, instance: Any, owner: type | None = None) -> Any:
            if instance is None:
                return self
            value = instance.__dict__[self.name] = self.function(instance)
            return value


def remembered(function: Callable[[Machine], Result]) -> Callable[[Machine], Result]:
    """The function, which remembers its result for the last machine.

    Machines are frozen, so that the very same one has the same of everything; whoever gets an array writes nothing
    to it. So are the parts of a machine as arrays.
    """
    # both at once, for another thread may ask too
    last: tuple[Any, Any] = (object(), None)

    @wraps(function)
    def memoized(machine: Machine) -> Result:
        nonlocal last
        subject, result = last
        if subject is not machine:
            result = function(machine)
            last = machine, result
        return result

    return memoized


def remembered_of_pair(function: Callable[[Part, Machine], Result]) -> Callable[[Part, Machine], Result]:
    """The same of a function of two."""
    last: tuple[Part, Machine, Result] | None = None

    @wraps(function)
    def memoized(part: Part, machine: Machine) -> Result:
        nonlocal last
        memory = last
        if memory is None or memory[0] is not part or memory[1] is not machine:
            last = memory = (part, machine, function(part, machine))
        return memory[2]

    return memoized
