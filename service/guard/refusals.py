"""Requests that are refused before anybody looks at what they ask."""

from collections.abc import Sequence


class Unauthorized(Exception):
    """There is no key, or it is wrong; ``wrong`` says which."""

    def __init__(self, wrong: bool) -> None:
        self.wrong = wrong
        super().__init__(
            "The key is wrong or has expired." if wrong else "Send a key as Authorization: Bearer, or as X-API-Key."
        )


class Forbidden(Exception):
    """The key does not allow this."""

    def __init__(self, scopes: Sequence[str]) -> None:
        super().__init__(f"This needs a key with the scope {' or '.join(scopes)}.")


class ForeignHost(Exception):
    """The request is for a host that this service does not answer for."""

    def __init__(self) -> None:
        super().__init__(
            "Nobody needs a key here, so this service answers only for hosts that it knows: this machine, and those of "
            "COUNTERWEIGHT_ALLOWED_HOSTS."
        )


class BadHeader(ValueError):
    """A header holds what it must not."""
