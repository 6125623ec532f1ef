"""The sizes that an operator allows, below those of the schemas; what is larger is refused field by field."""

from collections.abc import Iterator
from dataclasses import dataclass

from schemas.base.angles import Angles
from schemas.base.model import FieldProblem, Model
from schemas.base.rules import Path
from schemas.machine.machine import Machine
from schemas.machine.reciprocating import ReciprocatingMachine
from schemas.request.report import ReportRequest
from schemas.request.scene import Scene
from schemas.sweep.request import SweepRequest
from service.common.validation import InvalidRequest
from service.settings import Settings

#: what says how many designs there are, where it is not the axes
_COUNT_FIELDS = {"latin_hypercube": "samples", "crank_orders": "angles_deg"}


@dataclass(frozen=True)
class SizeLimits:
    """Largest numbers of throws, rows, webs, samples in a turn and designs of a sweep."""

    throws: int
    rows: int
    webs: int
    angles: int
    designs: int

    @classmethod
    def of(cls, settings: Settings) -> "SizeLimits":
        return cls(
            throws=settings.max_throws,
            rows=settings.max_rows,
            webs=settings.max_webs,
            angles=settings.max_angles,
            designs=settings.max_sweep_designs,
        )

    def require(self, request: Model) -> None:
        """Check that a request is not larger than allowed.

        Raises
        ------
        InvalidRequest
            naming every field that is too large.
        """
        problems = list(self._problems(request, ()))
        if problems:
            raise InvalidRequest(problems)

    def _problems(self, request: Model, at: Path) -> Iterator[FieldProblem]:
        if isinstance(request, SweepRequest):
            if request.total > self.designs:
                field = (_COUNT_FIELDS.get(request.design, "axes"),)
                message = f"a sweep may hold at most {self.designs} designs here; these are {request.total}"
                yield FieldProblem(field, message)
            yield from self._problems(request.base, ("base",))
            return
        if isinstance(request, Scene):
            yield from self._machine_problems(request.machine, (*at, "machine"))
        if isinstance(request, ReportRequest):
            for index, version in enumerate(request.versions):
                if version.machine is not None:
                    yield from self._machine_problems(version.machine, ("versions", index, "machine"))
        angles = getattr(request, "angles", None)
        if isinstance(angles, Angles) and angles.count > self.angles:
            message = f"a revolution may hold at most {self.angles} samples here"
            yield FieldProblem((*at, "angles", "step_deg"), message)

    def _machine_problems(self, machine: Machine, at: Path) -> Iterator[FieldProblem]:
        counts = {"webs": (len(machine.webs), self.webs, "webs")}
        if isinstance(machine, ReciprocatingMachine):
            counts["throws"] = (len(machine.throws), self.throws, "throws")
            rows = sum(len(throw.rows) for throw in machine.throws)
            if rows > self.rows:
                yield FieldProblem((*at, "throws"), f"a machine may have at most {self.rows} rows here, not {rows}")
        for field, (count, most, name) in counts.items():
            if count > most:
                yield FieldProblem((*at, field), f"a machine may have at most {most} {name} here, not {count}")
