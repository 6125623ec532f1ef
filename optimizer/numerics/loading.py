"""What is loaded when it is first needed, such as the compiler, which takes a tenth of a second.

An import inside a function does so too, and looks for the module at each call: an answer calls a dozen kernels, and a
look takes as long as the shortest of them.
"""

from collections.abc import Callable
from importlib import import_module
from types import ModuleType
from typing import Any


def deferred(module: str, name: str) -> Callable[[], Any]:
    """A function that hands out something of a module, which is loaded at the first call."""
    found: ModuleType | None = None

    def load() -> Any:
        nonlocal found
        if found is None:
            found = import_module(module)
        return getattr(found, name)

    return load
