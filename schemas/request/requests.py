"""What a client asks: optimise or analyse a machine."""

from collections.abc import Iterator
from typing import Annotated, Any, Self, cast

from pydantic import (
    Field,
    GetJsonSchemaHandler,
    SerializerFunctionWrapHandler,
    Strict,
    model_serializer,
    model_validator,
)
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema

from schemas.base.model import Model
from schemas.base.quantities import Fraction
from schemas.base.responses import limited
from schemas.base.rules import Rule, Ruled
from schemas.base.units import Unit
from schemas.machine.catalogue import DISCRETE_GAP
from schemas.machine.fitted import FittedCounterweight, GivenCounterweight, fitted_rules
from schemas.machine.reciprocating import balance_shafts
from schemas.machine.rotor import MAX_WEBS, Choice
from schemas.request.cases import Case, case_rules, cases, stated
from schemas.request.objective import Objective
from schemas.request.scenarios import MAX_SCENARIOS, Scenario, Tolerances
from schemas.request.scene import Scene

#: ways round what does not go together, see docs/api/together.md
_FIX_THE_CHOICE = "choose without, then ask with the choice as fixed weights"
#: default of the certified gap for masses of any size
_GAP = 1e-6


class Accuracy(Model):
    """How close to the optimum the answer has to be."""

    relative_gap: Annotated[float, Strict()] = Field(
        _GAP,
        ge=1e-12,
        le=1,
        description="certified gap asked for, relative to the objective without counterweights; 1e-3 if not said where"
        " counterweights are chosen from a catalogue",
        examples=[1e-6],
    )
    time_limit_s: Annotated[float, Strict(), Unit("s")] = Field(
        5.0,
        gt=0,
        le=30,
        description="computing time after which a search over a revolution or among"
        " discrete choices ends and says its gap, and no further method begins where one does not suffice [s]",
        examples=[5.0],
    )

    def usual(self, discrete: bool) -> "Accuracy":
        """The same with the usual gap of such a machine, where none is said."""
        name = "relative_gap"
        if name in self.model_fields_set:
            return self
        gap = DISCRETE_GAP if discrete else _GAP
        if gap == self.relative_gap:
            return self
        accuracy = self.model_copy(update={name: gap})
        # it is still not said, and another machine has another one
        accuracy.model_fields_set.discard(name)
        return accuracy

    @model_serializer(mode="wrap")
    def _without_usual_gap(self, handler: SerializerFunctionWrapHandler) -> dict[str, Any]:
        """Without the gap where none is said: who reads it again takes the usual one of the machine."""
        fields: dict[str, Any] = handler(self)
        if "relative_gap" not in self.model_fields_set:
            fields.pop("relative_gap", None)
        return fields

    @classmethod
    def __get_pydantic_json_schema__(cls, schema: CoreSchema, handler: GetJsonSchemaHandler) -> JsonSchemaValue:
        # what is left out changes nothing of what the fields are
        return super().__get_pydantic_json_schema__(_fields_alone(schema), handler)


def _fields_alone(schema: CoreSchema) -> CoreSchema:
    return cast(CoreSchema, {name: part for name, part in schema.items() if name != "serialization"})


class OptimizeRequest(Scene, Ruled):
    """Choose the counterweights of a machine."""

    objective: Objective = Field(Objective(), description="what is to be small", examples=[{"combine": "sum"}])
    accuracy: Accuracy = Field(Accuracy(), description="how close to the optimum", examples=[{"relative_gap": 1e-6}])
    scenarios: tuple[Scenario, ...] = Field(
        (),
        max_length=MAX_SCENARIOS,
        description="operating points, loads or variants that the counterweights are to suit. The largest weighted"
        " objective of all counts, and ceilings hold in each. The unchanged machine counts only where it is listed,"
        " with no changes",
        examples=[[{"name": "overspeed", "changes": [{"path": "/machine/speed_rpm", "value": 600}]}]],
    )
    tolerances: Tolerances | None = Field(
        None,
        description="what may be off: the worst case is minimised, and ceilings hold in it",
        examples=[{"mass_relative": 0.02, "angle_deg": 2}],
    )

    fitted: tuple[FittedCounterweight, ...] = Field(
        (),
        max_length=MAX_WEBS,
        description="counterweights that are fitted, as cast and set: shown beside the optimum, and choose nothing;"
        " webs that are not named carry none but what is fixed",
        examples=[[{"web": "1a", "mass_kg": 24.5, "angle_deg": 180}]],
    )

    alternatives: tuple[Fraction, ...] = Field(
        (),
        max_length=8,
        description="allowances, shares of the smallest objective, within which cheaper choices from a catalogue are"
        " listed: less mass, fewer counterweights, fewer sizes. The best choice has 0.6 of the time limit then, they"
        " the rest; none are listed if it is empty",
        examples=[[0.01, 0.02, 0.05]],
    )

    @property
    def robust(self) -> bool:
        """Whether more counts than the unchanged machine."""
        return any(True for _ in stated(self)) or (self.tolerances is not None and self.tolerances.any)

    @property
    def uncertain(self) -> bool:
        """Whether an answer tells its worst case: of cases, or of tolerances, of nothing too."""
        return any(True for _ in stated(self)) or self.tolerances is not None

    @property
    def cases(self) -> tuple[Case, ...]:
        """Machines that the counterweights are to suit in place of the unchanged one, if any."""
        return cases(self)

    def rules(self) -> Iterator[Rule]:
        yield from case_rules(self)
        for broken, (_, *rest), message in fitted_rules(self.machine, self.fitted):
            yield Rule(broken, ("fitted", *rest), message)
        yield from self._shaft_rules()
        choice = self.machine.choice
        if self.alternatives:
            yield from self._alternative_rules(choice)
        if self.objective.priorities:
            yield from self._cost_rules(choice)
        if choice == "discrete":
            yield from self._catalogue_rules()
        if choice == "semicontinuous":
            yield from self._fitted_rules()
        if self.tolerances is not None and self.objective.over_the_turn:
            squares = self.objective.bearing_weight > 0 and self.objective.bearing_measure == "rms"
            scatters = squares and self.tolerances.reciprocating_mass_relative > 0
            message = "of peaks only: not with objective.bearing_measure rms"
            yield Rule(scatters, ("tolerances", "reciprocating_mass_relative"), message)

    def envelope_rules(self, message: str) -> Iterator[Rule]:
        """Envelopes where only a counterweight of a fixed radius is possible."""
        for broken, path, text in self.machine.no_envelopes(message):
            yield Rule(broken, ("machine", *path), text)

    def allowance_rules(self, message: str) -> Iterator[Rule]:
        """Allowances without a list of cheaper choices."""
        yield Rule(bool(self.alternatives), ("alternatives",), message)

    def _alternative_rules(self, choice: Choice | None) -> Iterator[Rule]:
        """What cheaper choices are listed of."""
        path = ("alternatives",)
        message = "give a catalogue too: cheaper choices are listed for counterweights from a catalogue only"
        yield Rule(choice != "discrete", path, message)
        message = "cheaper choices are listed beside one goal: remove them, or let a cost be the last goal"
        yield Rule(bool(self.objective.priorities), path, message)

    def _catalogue_rules(self) -> Iterator[Rule]:
        """What does not go with discrete choices."""
        machine = self.machine
        yield from self._choice_rules("a catalogue")
        for broken, path, message in machine.no_envelopes(
            "what is chosen from a catalogue has a radius: give that of the plate"
        ):
            yield Rule(broken, ("machine", *path), message)

    def _choice_rules(self, subject: str) -> Iterator[Rule]:
        """What does not go with either."""
        tolerances, goal = self.tolerances, self.objective
        if tolerances is None:
            return
        limited = any(getattr(goal, name) is not None for name in type(goal).model_fields if "_ceiling_" in name)
        for name in ("mass_relative", "angle_deg"):
            message = f"not with {subject} and a ceiling: {_FIX_THE_CHOICE}"
            yield Rule(limited and getattr(tolerances, name) > 0, ("tolerances", name), message)

    def _cost_rules(self, choice: Choice | None) -> Iterator[Rule]:
        """What counts castings needs some to choose from."""
        order = self.objective.priorities
        for i, priority in enumerate(() if choice == "discrete" else order):
            path = ("objective", "priorities", i, "goal")
            message = (
                "give a catalogue too: of any masses at any angles a counterweight may be next to nothing, and their"
                " number says little"
            )
            yield Rule(priority.goal in ("pieces", "sizes"), path, message)
            message = "without a catalogue the mass comes last: the minimum mass leaves no choice to goals after it"
            yield Rule(priority.goal == "mass" and i + 1 < len(order), path, message)

    def _fitted_rules(self) -> Iterator[Rule]:
        """What does not go with a least mass of what is fitted."""
        machine = self.machine
        yield from self._choice_rules("min_fitted_mass_kg")
        for broken, path, message in machine.no_envelopes(
            "not beside min_fitted_mass_kg: optimise without, then give the radius that is found"
        ):
            yield Rule(broken, ("machine", *path), message)
        message = "with min_fitted_mass_kg and web_groups the masses of all webs have a limit"
        for path, webs in machine.web_lists() if machine.web_groups else ():
            for k, web in enumerate(webs):
                endless = web.max_mass_kg is None and web.fixed is None and web.envelope is None
                yield Rule(endless, ("machine", *path, k, "max_mass_kg"), message)

    @property
    def _usual_accuracy(self) -> Accuracy:
        return self.accuracy.usual(self.machine.choice is not None)

    @property
    def with_usual_gap(self) -> Self:
        """The same with the default gap of its machine in place of None."""
        return self.model_copy(update={"accuracy": self._usual_accuracy})

    @model_validator(mode="after")
    def _usual_gap(self) -> Self:
        # frozen for all others: nobody has seen it yet
        self.__dict__["accuracy"] = self._usual_accuracy
        return self

    def _shaft_rules(self) -> Iterator[Rule]:
        """What does not go with balance shafts."""
        machine, goal = self.machine, self.objective
        shafts = balance_shafts(machine)
        rolling = not shafts and goal.roll_weight != 0
        if rolling is not False:
            message = "balance shafts alone change the roll moment, and the machine has none"
            yield Rule(rolling, ("objective", "roll_weight"), message)
        if any(shaft.speed_ratio == -1 for shaft in shafts):
            for name in (ceiling.field for ceiling in limited(goal) if ceiling.axis is None):
                whole = goal.orders == "first"
                message = "with a shaft that turns backwards the ceilings of the first order are those along x and y"
                yield Rule(whole, ("objective", name), message)


class AnalyzeRequest(Scene, Ruled):
    """The machine as it stands, or with given counterweights."""

    counterweights: tuple[GivenCounterweight, ...] = Field(
        (),
        max_length=MAX_WEBS,
        description="counterweights on the machine, at most one for each web, and others in planes of their own",
        examples=[[{"web": "1a", "mass_kg": 24.5, "angle_deg": 180}]],
    )

    @property
    def with_usual_gap(self) -> Self:
        """The same: it asks for no gap."""
        return self

    def rules(self) -> Iterator[Rule]:
        yield from fitted_rules(self.machine, self.counterweights)
