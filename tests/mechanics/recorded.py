"""``python -m tests.mechanics.recorded``: writes down what the functions of the mechanics come to."""

import json
from collections.abc import Callable
from functools import cache, partial
from pathlib import Path
from typing import Any

from tests.mechanics.functions import FUNCTIONS, together
from tests.mechanics.machines import OF_MACHINES
from tests.prints import print_of

_FILE = Path(__file__).with_name("recorded.json")


def cases() -> dict[str, Callable[[], Any]]:
    """What is written down, by name."""
    found: dict[str, Callable[[], Any]] = {name: partial(_of_designs, name) for name in FUNCTIONS}
    found |= {
        f"{what} of {name}": partial(function, name)
        for what, (names, function) in OF_MACHINES.items()
        for name in names
    }
    return found


def _of_designs(name: str) -> Any:
    return FUNCTIONS[name](together())


@cache
def records() -> dict[str, list[Any]]:
    """Prints of the cases as they were."""
    found: dict[str, list[Any]] = json.loads(_FILE.read_text())
    return found


def main() -> None:
    """Writes the file, a line for each case."""
    lines = [f"{json.dumps(name)}: {json.dumps(print_of(case()))}" for name, case in cases().items()]
    _FILE.write_text("{\n" + ",\n".join(lines) + "\n}\n")


if __name__ == "__main__":
    main()
