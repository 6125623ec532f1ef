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
        machine: dict[str, Any] = self.body["machine"]
        return machine

    @property
    def webs(self) -> list[dict[str, Any]]:
        webs: list[dict[str, Any]] = self.machine["webs"]
        return webs

    @property
    def first(self) -> dict[str, Any]:
        if not self.webs:
            raise NoPlace
        return self.webs[0]

    @property
    def objective(self) -> dict[str, Any]:
        fields: dict[str, Any] = self.body.setdefault("objective", {})
        return fields

    @property
    def catalogue(self) -> dict[str, Any]:
        fields: dict[str, Any] = self.machine.setdefault("catalogue", {})
        return fields

    @property
    def throws(self) -> list[dict[str, Any]]:
        if "throws" not in self.machine:
            raise NoPlace
        throws: list[dict[str, Any]] = self.machine["throws"]
        return throws

    @property
    def rows(self) -> list[dict[str, Any]]:
        rows = [row for throw in self.throws for row in throw["rows"]]
        if not rows:
            raise NoPlace
        return rows

    @property
    def pins(self) -> dict[str, Any]:
        """A request for the loads of pins."""
        if "machine" in self.body:
            raise NoPlace
        return self.body

    @property
    def scroll(self) -> dict[str, Any]:
        """What turns a scroll and what holds it: of its machine, or of a request for the loads of its pins."""
        return self.machine if "machine" in self.body else self.body
