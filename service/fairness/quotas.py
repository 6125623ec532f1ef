"""What one client may hold at a time of what all share, so that its legal traffic harms nobody else."""

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

from starlette.requests import Request

from service.settings import Settings

Kind = Literal["events", "rows", "bodies", "answers", "files"]
_MB = 1_000_000


class OverShare(Exception):
    """The client holds as much as it may; a retry helps when it has let go of something."""


@dataclass(frozen=True)
class Share:
    """So much for each client, so much altogether, and so much that each has even then."""

    each: int
    altogether: int
    assured: int
    refusal: str


class Shares:
    """What is held, by kind and by client."""

    def __init__(self, settings: Settings) -> None:
        megabytes = settings.held_mb_each * _MB, settings.held_mb * _MB
        self._shares: Mapping[Kind, Share] = {
            "events": Share(settings.event_streams_each, settings.event_streams, 1, "Too many streams of events"),
            "rows": Share(settings.row_streams_each, settings.row_streams, 1, "Too many streams of rows"),
            # a body is as good as computed, an answer is: one of each is always taken
            "bodies": Share(*megabytes, settings.max_body_bytes, "Too many bytes of requests"),
            "answers": Share(*megabytes, _MB, "Too many bytes of answers"),
            "files": Share(8 * megabytes[0], 8 * megabytes[1], 8 * _MB, "Too many bytes of large answers"),
        }
        self._held: Mapping[Kind, Counter[str]] = {kind: Counter() for kind in self._shares}

    def take(self, kind: Kind, who: str, amount: int) -> None:
        """Have a client hold more.

        Raises
        ------
        OverShare
        """
        share, held = self._shares[kind], self._held[kind]
        then = held[who] + amount
        if then > share.assured and (then > share.each or held.total() + amount > share.altogether):
            raise OverShare(f"{share.refusal} are open for this client; try again when some of them have ended.")
        held[who] = then

    def give(self, kind: Kind, who: str, amount: int) -> None:
        """Have a client hold less."""
        held = self._held[kind]
        held[who] -= amount
        if not held[who]:
            del held[who]

    def held(self, kind: Kind, who: str) -> int:
        """What a client holds."""
        return self._held[kind][who]


@dataclass
class Holding:
    """What one request holds until it has been answered."""

    shares: Shares
    who: str
    _held: Counter[Kind] = field(default_factory=Counter)

    def take(self, kind: Kind, amount: int = 1) -> None:
        """Hold more.

        Raises
        ------
        OverShare
        """
        self.shares.take(kind, self.who, amount)
        self._held[kind] += amount

    def give(self, kind: Kind, amount: int) -> None:
        """Hold less."""
        self.shares.give(kind, self.who, amount)
        self._held[kind] -= amount

    def end(self) -> None:
        """Hold nothing any more."""
        for kind, amount in self._held.items():
            self.shares.give(kind, self.who, amount)
        self._held.clear()


def holding(request: Request) -> Holding:
    """What a request holds; :class:`~service.guard.access.Access` has made it, and ends it."""
    found: Holding = request.state.holding
    return found
