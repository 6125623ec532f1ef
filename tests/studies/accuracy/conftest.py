"""A ready service, as the service's own tests have it."""

from tests.service.conftest import client, post

__all__ = ["client", "post"]
