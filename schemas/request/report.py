"""The request for a report: the optimisation, its head, and the versions that it compares."""

from collections.abc import Iterator
from datetime import date
from typing import Annotated

from pydantic import AfterValidator, Field, StringConstraints
from pydantic_core import PydanticCustomError

from schemas.base.images import png_url
from schemas.base.model import Model
from schemas.base.quantities import Name
from schemas.base.rules import Rule
from schemas.machine.fitted import GivenCounterweight, fitted_rules
from schemas.machine.machine import Machine
from schemas.machine.rotor import MAX_WEBS
from schemas.request.objective import Objective
from schemas.request.requests import OptimizeRequest

MAX_VERSIONS = 4
MAX_REVISIONS = 20


def day(text: str) -> str:
    """A day that there is."""
    try:
        date.fromisoformat(text)
    except ValueError:
        raise PydanticCustomError("day", "no day of the calendar") from None
    return text


Line = Annotated[str, StringConstraints(min_length=1, max_length=120, pattern=r"^[^\x00-\x1f\x7f]+$")]
Day = Annotated[str, StringConstraints(pattern=r"^[0-9]{4}-[0-9]{2}-[0-9]{2}$"), AfterValidator(day)]
Logo = Annotated[str, StringConstraints(max_length=300_000), AfterValidator(png_url)]
Notes = Annotated[str, StringConstraints(min_length=1, max_length=4000)]


class Revision(Model):
    """A line of the table of revisions."""

    revision: Line = Field(description="its letter or number", examples=["B"])
    date: Day | None = Field(None, description="its day, ISO 8601", examples=["2026-11-23"])
    change: Line | None = Field(None, description="what is changed", examples=["counterweights as cast"])
    author: Line | None = Field(None, description="who made it", examples=["M. Weber"])


class DocumentHead(Model):
    """What a design office writes on its documents."""

    company: Line | None = Field(None, description="company that issues it", examples=["Weber Compressors"])
    customer: Line | None = Field(None, description="whom it is for", examples=["Nordic Air"])
    project: Line | None = Field(None, description="project", examples=["Nitrogen plant"])
    number: Line | None = Field(None, description="number of the document", examples=["K-1047"])
    revision: Line | None = Field(None, description="revision of the document", examples=["B"])
    author: Line | None = Field(None, description="who made it", examples=["M. Weber"])
    checker: Line | None = Field(None, description="who checks it", examples=["A. Okafor"])
    approver: Line | None = Field(None, description="who approves it", examples=["L. Berg"])
    drawing: Line | None = Field(None, description="number of the drawing that it belongs to", examples=["D-2212"])
    date: Day | None = Field(
        None,
        description="day that it bears, ISO 8601, where the office is; null is today in UTC",
        examples=["2026-11-23"],
    )
    revisions: tuple[Revision, ...] = Field(
        (), max_length=MAX_REVISIONS, description="table of revisions", examples=[[{"revision": "B"}]]
    )
    logo: Logo | None = Field(
        None,
        description="logo of the company: a PNG file as a data URL, at most 2000 pixels a side",
        examples=[None],
    )
    notes: Notes | None = Field(None, description="notes, as paragraphs", examples=["For approval."])


class DesignVersion(Model):
    """Another version of the design, to be compared with the one of the report; what it does not give is that one's."""

    name: Name = Field(description="name of the version", examples=["as built"])
    machine: Machine | None = Field(None, description="its machine; null is the report's", examples=[None])
    objective: Objective | None = Field(None, description="its objective; null is the report's", examples=[None])
    counterweights: tuple[GivenCounterweight, ...] | None = Field(
        None,
        max_length=MAX_WEBS,
        description="what is fitted; null are the counterweights that are found to be best",
        examples=[[{"web": "1a", "mass_kg": 24.5, "angle_deg": 180}]],
    )


class ReportRequest(OptimizeRequest):
    """A document on a machine and its counterweights."""

    document: DocumentHead = Field(
        DocumentHead(), description="what its head says", examples=[{"number": "K-1047", "revision": "B"}]
    )
    versions: tuple[DesignVersion, ...] = Field(
        (),
        max_length=MAX_VERSIONS,
        description="other versions of the design, compared with this one",
        examples=[[{"name": "as built", "counterweights": [{"web": "1a", "mass_kg": 24.5, "angle_deg": 180}]}]],
    )

    def rules(self) -> Iterator[Rule]:
        yield from super().rules()
        names: set[str] = set()
        for index, version in enumerate(self.versions):
            place = ("versions", index)
            yield Rule(version.name in names, (*place, "name"), "another version has this name")
            names.add(version.name)
            if version.counterweights is not None:
                unasked = version.objective is not None
                yield Rule(
                    unasked, (*place, "objective"), "remove `objective`: this version has counterweights of its own"
                )
                machine = version.machine or self.machine
                for broken, path, message in fitted_rules(machine, version.counterweights):
                    yield Rule(broken, (*place, *path), message)
                continue
            for broken, path, message in self.request_for(version).rules():
                override = getattr(version, str(path[0]), None) is not None
                yield Rule(broken, (*place, *(path if override else ())), message)

    def request_for(self, version: DesignVersion) -> OptimizeRequest:
        """What is asked of a version for which counterweights are to be found."""
        own = {name: getattr(self, name) for name in OptimizeRequest.model_fields}
        changed = {name: getattr(version, name) for name in ("machine", "objective")}
        stated = {name: value for name, value in changed.items() if value is not None}
        return OptimizeRequest.model_construct(**{**own, **stated, "outputs": ("residual",), "fitted": ()})

    @property
    def alone(self) -> OptimizeRequest:
        """The request without what is the document's."""
        return OptimizeRequest.model_construct(**{name: getattr(self, name) for name in OptimizeRequest.model_fields})
