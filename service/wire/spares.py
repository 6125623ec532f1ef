"""Open files that are kept for the time when no other can be opened."""

import os


class Spares:
    """So many files that say nothing, any of which can be closed to make room for a connection."""

    def __init__(self, count: int) -> None:
        self._count = count
        self._lent = 0
        self._files: list[int] = []
        self.fill()

    def fill(self) -> None:
        """Open those that are missing, as far as there is room."""
        while len(self._files) < self._count - self._lent:
            try:
                self._files.append(os.open(os.devnull, os.O_RDONLY | os.O_CLOEXEC))
            except OSError:
                return

    def lend(self) -> bool:
        """Make room for one file more, which must be returned; whether there is any."""
        if not self._files:
            return False
        os.close(self._files.pop())
        self._lent += 1
        return True

    def give_back(self) -> None:
        """What was lent is closed."""
        self._lent -= 1
        self.fill()

    def close(self) -> None:
        """Keep none any more."""
        self._count = 0
        while self._files:
            os.close(self._files.pop())
