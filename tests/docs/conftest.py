"""The service that the calls of the documents go to."""

from tests.clients.conftest import url

__all__ = ["url"]
