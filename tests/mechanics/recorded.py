"""``python -m tests.mechanics.recorded``: writes down what the functions of the mechanics come to."""

from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

from tests.mechanics.functions import FUNCTIONS, together
from tests.mechanics.machines import OF_MACHINES
from tests.prints import Record


def cases() -> dict[str, Callable[[], Any]]:
    """What is written down, by name."""
    functions: dict[str, Callable[[], Any]] = {name: partial(_of_designs, name) for name in FUNCTIONS}
    functions |= {
        f"{kind} of {name}": partial(function, name)
        for kind, (names, function) in OF_MACHINES.items()
        for name in names
    }
    return functions


def _of_designs(name: str) -> Any:
    return FUNCTIONS[name](together())


RECORD = Record(Path(__file__).with_name("recorded.json"), cases())


if __name__ == "__main__":
    RECORD.write()
