"""The request for a matching: which weighed part goes on which row."""

from collections.abc import Iterator
from typing import Annotated

from pydantic import ConfigDict, Field, Strict

from schemas.base.model import Model
from schemas.base.presence import conditions, empty, filled, when
from schemas.base.quantities import Count, Flag, Mass, Name
from schemas.base.responses import ceilings
from schemas.base.rules import Path, Rule, Ruled
from schemas.base.units import Unit
from schemas.machine.fitted import FittedCounterweight, fitted_rules
from schemas.machine.reciprocating import MAX_ROWS_TOGETHER, ReciprocatingMachine
from schemas.machine.rotor import MAX_WEBS
from schemas.request.objective import Objective
from schemas.request.requests import OptimizeRequest

MAX_CLASSES = 8
#: a larger limit of a counterweight is none, kg
_LARGEST = 1e15


class RowPlace(Model):
    """A row of the machine."""

    throw: Annotated[Count, Field(ge=0)] = Field(description="number of the throw in the machine, from 0", examples=[0])
    row: Annotated[Count, Field(ge=0)] = Field(description="number of the row on its throw, from 0", examples=[0])


class Parts(Model):
    """Parts of one kind, weighed one by one."""

    model_config = ConfigDict(validate_by_name=True, serialize_by_alias=True)

    kind: Name = Field(alias="class", description="what they are, unique in the request", examples=["crosshead"])
    names: tuple[Name, ...] = Field(
        max_length=MAX_ROWS_TOGETHER,
        description="their names, each once; as many as there are rows for them",
        examples=[["K1", "K2"]],
    )
    masses_kg: tuple[Mass, ...] = Field(
        max_length=MAX_ROWS_TOGETHER, description="what each weighs, in the order of the names", examples=[[93.1, 91.4]]
    )
    rows: tuple[RowPlace, ...] | None = Field(
        None,
        max_length=MAX_ROWS_TOGETHER,
        description="rows that take one each; null is every row of the machine",
        examples=[[{"throw": 0, "row": 0}, {"throw": 1, "row": 0}]],
    )


class MatchAccuracy(Model):
    """How close to the best assignment the answer has to be."""

    relative_gap: Annotated[float, Strict()] = Field(
        1e-3,
        ge=1e-12,
        le=1,
        description="certified gap asked for, relative to the objective with the parts as they are listed",
        examples=[1e-3],
    )
    time_limit_s: Annotated[float, Strict(), Unit("s")] = Field(
        5.0,
        gt=0,
        le=30,
        description="computing time after which a search looks at no more assignments and says its gap [s]",
        examples=[5.0],
    )


class MatchRequest(Ruled):
    """Which weighed part goes on which row, each once?"""

    model_config = ConfigDict(
        json_schema_extra=conditions(
            when(empty("parts"), filled("balance_nuts_kg")),
            when(
                {"properties": {"choose_counterweights": {"const": True}}, "required": ["choose_counterweights"]},
                empty("counterweights"),
            ),
        )
    )

    machine: ReciprocatingMachine = Field(
        description="the machine; the parts are not in its reciprocating masses",
        examples=[
            {
                "kind": "reciprocating",
                "speed_rpm": 500,
                "throws": [
                    {
                        "position_m": 0.0,
                        "crank_radius_m": 0.14,
                        "crank_angle_deg": 0,
                        "rows": [
                            {"axis_deg": 0, "reciprocating_mass_kg": 100},
                            {"axis_deg": 180, "reciprocating_mass_kg": 100},
                        ],
                    }
                ],
            }
        ],
    )
    parts: tuple[Parts, ...] = Field(
        (),
        max_length=MAX_CLASSES,
        description="parts class by class; what a row gets is added to its reciprocating mass",
        examples=[[{"class": "crosshead", "names": ["K1", "K2"], "masses_kg": [93.1, 91.4]}]],
    )
    balance_nuts_kg: tuple[Mass, ...] = Field(
        (),
        max_length=MAX_ROWS_TOGETHER,
        description="masses of the balance nuts at hand, each to be used once or not at all, at most one on a row",
        examples=[[1.5, 2.0]],
    )
    counterweights: tuple[FittedCounterweight, ...] = Field(
        (),
        max_length=MAX_WEBS,
        description="counterweights that are on the machine, at most one for each web",
        examples=[[{"web": "1a", "mass_kg": 24.5, "angle_deg": 180}]],
    )
    choose_counterweights: Flag = Field(
        False,
        description="choose the counterweights together with the parts, within their limits. They are of any mass,"
        " from a catalogue, at least so heavy, equal or cut from plates, as the machine states. Else these fields play"
        " no part",
        examples=[False],
    )
    objective: Objective = Field(
        Objective(), description="what is to be small; of the first order, without ceilings", examples=[{}]
    )
    accuracy: MatchAccuracy = Field(
        MatchAccuracy(), description="how close to the best assignment", examples=[{"relative_gap": 1e-3}]
    )

    @property
    def places(self) -> tuple[RowPlace, ...]:
        """Every row of the machine."""
        throws = self.machine.throws
        return tuple(RowPlace(throw=t, row=i) for t, throw in enumerate(throws) for i in range(len(throw.rows)))

    def rules(self) -> Iterator[Rule]:
        if self.choose_counterweights:
            # they are those of an optimum
            yield from OptimizeRequest.model_construct(machine=self.machine, objective=self.objective).rules()
        rows = self.places
        yield Rule(not rows, ("machine", "throws"), "parts need at least one row")
        yield Rule(not self.parts and not self.balance_nuts_kg, ("parts",), "nothing to match: give parts or nuts")
        kinds = [part.kind for part in self.parts]
        for k, part in enumerate(self.parts):
            yield Rule(part.kind in kinds[:k], ("parts", k, "class"), "this class is named already")
            yield from _parts_rules(("parts", k), part, rows)
        yield from fitted_rules(self.machine, self.counterweights)
        is_twice = self.choose_counterweights and bool(self.counterweights)
        yield Rule(is_twice, ("counterweights",), "give either `counterweights` or `choose_counterweights`")
        message = f"a match that chooses counterweights needs a limit of at most {_LARGEST:g} kg here"
        for place, webs in self.machine.web_lists() if self.choose_counterweights else ():
            for k, web in enumerate(webs):
                endless = (
                    web.fixed is None
                    and web.envelope is None
                    and (web.max_mass_kg is None or web.max_mass_kg > _LARGEST)
                )
                yield Rule(endless, ("machine", *place, k, "max_mass_kg"), message)
        for name in self.objective.over_the_turn:
            yield Rule(True, ("objective", name), "remove it: parts are matched for first-order force and moment")
        for ceiling in ceilings():
            presence = getattr(self.objective, ceiling.field) is not None
            yield Rule(presence, ("objective", ceiling.field), "remove it: parts are matched without ceilings")


def _parts_rules(path: Path, parts: Parts, rows: tuple[RowPlace, ...]) -> Iterator[Rule]:
    """Of one class."""
    for i, name in enumerate(parts.names):
        yield Rule(name in parts.names[:i], (*path, "names", i), "this part is named already; each is there once")
    unlike = len(parts.masses_kg) != len(parts.names)
    yield Rule(unlike, (*path, "masses_kg"), "give one mass for each name")
    places = rows if parts.rows is None else parts.rows
    yield Rule(not places and bool(rows), (*path, "rows"), "name at least one row")
    for i, place in enumerate(parts.rows or ()):
        yield Rule(place not in rows, (*path, "rows", i), "the machine has no such row")
        yield Rule(place in places[:i], (*path, "rows", i), "this row is named already")
    are = "there is 1 row" if len(places) == 1 else f"there are {len(places)} rows"
    of_parts = "1 part" if len(parts.names) == 1 else f"{len(parts.names)} parts"
    count = f"{are} for {of_parts}; every row takes one, and none is left over"
    yield Rule(len(parts.names) != len(places), (*path, "names"), count)
