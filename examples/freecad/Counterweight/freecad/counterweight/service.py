"""The client of the service, for the modules beside this one; the package says where it stands."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    # the same file: type checkers do not follow the path of a package
    from counterweight import Refused, Service
else:
    from .counterweight import Refused, Service

__all__ = ["Refused", "Service"]
