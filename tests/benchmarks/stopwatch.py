"""How long parts of some work take."""

import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import ExitStack, contextmanager
from importlib import import_module
from typing import Any
from unittest.mock import patch


class Stopwatch:
    """Seconds by part; a part does not count what it calls of another."""

    def __init__(self, clock: Callable[[], float] = time.perf_counter) -> None:
        self.clock = clock
        self.seconds: dict[str, float] = {}
        self._running: list[str] = []
        self._since = 0.0

    @contextmanager
    def part(self, name: str) -> Iterator[None]:
        self._book()
        self._running.append(name)
        try:
            yield
        finally:
            self._book()
            self._running.pop()

    def _book(self) -> None:
        now = self.clock()
        if self._running:
            self.seconds[self._running[-1]] = self.seconds.get(self._running[-1], 0.0) + now - self._since
        self._since = now

    @contextmanager
    def over(self, parts: Mapping[str, tuple[str, ...]]) -> Iterator[None]:
        """Watch functions, "module:name" by part; what they call belongs to the innermost part."""
        with ExitStack() as patched:
            for name, functions in parts.items():
                for place in functions:
                    module, function = place.split(":")
                    home = import_module(module)
                    patched.enter_context(patch.object(home, function, self._watched(name, getattr(home, function))))
            yield

    def _watched(self, name: str, function: Callable[..., Any]) -> Callable[..., Any]:
        def timed(*arguments: Any, **options: Any) -> Any:
            with self.part(name):
                return function(*arguments, **options)

        return timed
