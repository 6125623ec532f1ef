"""A request that features are put on."""

from dataclasses import dataclass
from typing import Any

from tests.pairs.machines import Request


class NoPlace(Exception):
    """The machine has nothing that the feature is about."""


@dataclass(frozen=True)
class Subject:
    """A request that features are put on, and the machine that it began with."""

    base: str
    body: Request

    @property
    def machine(self) -> dict[str, Any]:
        found: dict[str, Any] = self.body["machine"]
        return found

    @property
    def webs(self) -> list[dict[str, Any]]:
        found: list[dict[str, Any]] = self.machine["webs"]
        return found

    @property
    def first(self) -> dict[str, Any]:
        if not self.webs:
            raise NoPlace
        return self.webs[0]

    @property
    def objective(self) -> dict[str, Any]:
        found: dict[str, Any] = self.body.setdefault("objective", {})
        return found

    @property
    def catalogue(self) -> dict[str, Any]:
        found: dict[str, Any] = self.machine.setdefault("catalogue", {})
        return found

    @property
    def throws(self) -> list[dict[str, Any]]:
        if "throws" not in self.machine:
            raise NoPlace
        found: list[dict[str, Any]] = self.machine["throws"]
        return found

    @property
    def rows(self) -> list[dict[str, Any]]:
        found = [row for throw in self.throws for row in throw["rows"]]
        if not found:
            raise NoPlace
        return found
