"""Several operating points or variants of a machine, and what may be off: what one set of counterweights is to suit."""

from collections.abc import Iterator, Sequence
from typing import Annotated, Any

from pydantic import Field, Strict

from schemas.base.model import Model
from schemas.base.quantities import Fraction, Name
from schemas.base.rules import Path, Rule
from schemas.base.target import BadPointer, Target, Value, find_target
from schemas.base.units import Unit, non_negative, positive
from schemas.base.variation import with_fields
from schemas.machine.machine import Machine
from schemas.request.scene import Scene

MAX_SCENARIOS, MAX_CHANGES = 32, 64


class Change(Model):
    """Another number in one field of the machine."""

    path: Annotated[str, Field(max_length=512)] = Field(
        description="JSON pointer (RFC 6901) of a numeric field of the machine, from the root of the request",
        examples=["/machine/speed_rpm"],
    )
    value: Value = Field(
        description="the value, as the field itself takes it: a number, a string with a unit, null where it may be",
        examples=[600.0],
    )


class Scenario(Model):
    """An operating point, a load or a variant of the machine that the counterweights are to suit as well."""

    name: Name = Field(description="name, unique among the scenarios", examples=["overspeed"])
    weight: Annotated[float, Strict(), positive(1e12)] = Field(
        1.0, description="what its objective is multiplied by before the largest of all counts", examples=[1.0]
    )
    changes: tuple[Change, ...] = Field(
        (),
        max_length=MAX_CHANGES,
        description="what differs from the unchanged machine; empty is that machine",
        examples=[[{"path": "/machine/speed_rpm", "value": 600}]],
    )


class Tolerances(Model):
    """What may be off, all of it at once and whichever way is worst."""

    mass_relative: Fraction = Field(
        0.0, description="share of its mass by which a counterweight may be off", examples=[0.02]
    )
    angle_deg: Annotated[float, non_negative(1e6), Unit("deg")] = Field(
        0.0, description="angle by which a counterweight may be off", examples=[2.0]
    )
    unbalance_kg_m: Annotated[float, non_negative(1e15), Unit("kg m")] = Field(
        0.0, description="unbalance that may be there besides at every web, in any direction", examples=[0.001]
    )
    reciprocating_mass_relative: Fraction = Field(
        0.0,
        description="share by which the reciprocating mass of every row, its part of the rod included, may be off; of"
        " peaks only, not of a root mean square",
        examples=[0.01],
    )

    @property
    def any(self) -> bool:
        """Whether anything may be off."""
        return any(getattr(self, name) > 0 for name in type(self).model_fields)


def machine_of(request: Scene, scenario: Scenario) -> Machine:
    """The machine of a scenario that keeps the rules."""
    values = {}
    for change in scenario.changes:
        target = find_target(request, change.path)
        values[target.path[1:]] = _number(target, change.value)
    return with_fields(request.machine, values)


def change_rules(request: Scene, scenarios: Sequence[Scenario]) -> Iterator[Rule]:
    """What is wrong with the changes of scenarios of a request whose other parts are right; paths from its root."""
    for i, scenario in enumerate(scenarios):
        for broken, rest, message in _change_rules(request, scenario):
            yield Rule(broken, ("scenarios", i, "changes", *rest), message)


def _change_rules(request: Scene, scenario: Scenario) -> Iterator[Rule]:
    """What is wrong with the changes one by one; paths from the changes."""
    earlier: set[Path] = set()
    for j, change in enumerate(scenario.changes):
        try:
            target = find_target(request, change.path)
        except BadPointer as error:
            yield Rule(True, (j, "path"), str(error))
            continue
        refused = _refused(target.path)
        if refused or target.path in earlier:
            yield Rule(True, (j, "path"), refused or "another change of this scenario is in this field")
            continue
        earlier.add(target.path)
        try:
            value = target.number(change.value)
        except ValueError as error:
            yield Rule(True, (j, "value"), str(error))
            continue
        if value is not None:
            yield from (Rule(True, (j, "value"), message) for broken, _, message in target.rules(value) if broken)


def _refused(path: Path) -> str | None:
    """Why a scenario may not change a field."""
    if path[0] != "machine":
        return "only numbers of the machine can change"
    of_webs = "webs" in path and path[-1] != "position_m"
    if of_webs or path[1] == "max_total_mass_kg":
        return "the counterweights and their limits are the same in all scenarios"
    return None


def _number(target: Target, entry: Any) -> float | int | None:
    value = target.number(entry)
    return int(value) if target.integer and value is not None else value
