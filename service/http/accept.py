"""What a client accepts: the one reader of the headers Accept and Accept-Encoding."""

from collections.abc import Iterator, Mapping, Sequence
from functools import lru_cache
from typing import TypeVar

from starlette.requests import Request

from service.common.coding import CODINGS, Coding
from service.common.headers import header_list

Offer = TypeVar("Offer")
Name = TypeVar("Name", bound=str)
#: headers that are kept with what they prefer: clients send the same few again and again
_SHORT, _CACHE_SIZE = 256, 256


class NotAcceptable(ValueError):
    """The client accepts none of the forms that there are."""

    def __init__(self, offered: Sequence[str]) -> None:
        super().__init__(f"The answer is there as {' and '.join(offered)}; say so in the header Accept.")


def preferred(header: str, offered: Sequence[Name]) -> Name | None:
    """Which of the media types or codings offered a client likes best; of the equally liked the first one.

    Parameters
    ----------
    header : as RFC 9110 section 12.5 has it, lists joined by commas; an empty one accepts everything.
    offered : without parameters, in lower case, the own preference first.

    Returns
    -------
    None where the client accepts none.
    """
    offered = tuple(offered)
    return (_cached if len(header) <= _SHORT else _preferred)(header, offered)


def _preferred(header: str, offered: tuple[Name, ...]) -> Name | None:
    ranges = dict(_range(part) for part in header.split(",") if part.strip()) or {"*/*": 1.0}
    qualities = {name: _quality(name, ranges) for name in offered}
    best = max(offered, key=qualities.__getitem__)
    return best if qualities[best] > 0 else None


_cached = lru_cache(_CACHE_SIZE)(_preferred)


def negotiate(request: Request, offered: Mapping[str, Offer]) -> Offer | None:
    """What the header Accept of a request likes best of what there is, by media type; None if it accepts nothing."""
    media_type = preferred(header_list(request.scope, b"accept"), tuple(offered))
    return None if media_type is None else offered[media_type]


def coding_of(request: Request) -> Coding | None:
    """What an answer may be compressed by; None for who takes it as it is, or says nothing."""
    return preferred(header_list(request.scope, b"accept-encoding") or "identity", CODINGS)


def _quality(name: str, ranges: Mapping[str, float]) -> float:
    """How much a form is liked: the most specific range that holds it says so."""
    return next((ranges[pattern] for pattern in _ranges(name) if pattern in ranges), 0.0)


def _ranges(name: str) -> Iterator[str]:
    yield name
    kind, slash, _ = name.partition("/")
    yield from (f"{kind}/*", "*/*") if slash else ("*",)


def _range(part: str) -> tuple[str, float]:
    name, *parameters = (piece.strip().lower() for piece in part.split(";"))
    values = dict(parameter.replace(" ", "").partition("=")[::2] for parameter in parameters)
    try:
        return name, float(values.get("q", "1"))
    except ValueError:
        return name, 0.0
