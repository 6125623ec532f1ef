"""What an optimisation is to do, read once from a request: whoever solves goes by it, and sees no request."""

from dataclasses import replace
from typing import NamedTuple

from optimizer.formulation.balance_shafts import DesignSpace, design_space
from optimizer.numerics.memoization import cached_property
from optimizer.numerics.records import record
from schemas.base.rules import Path
from schemas.machine.machine import Machine
from schemas.machine.rotor import Choice
from schemas.request.objective import Objective
from schemas.request.requests import Accuracy, OptimizeRequest
from schemas.request.scenarios import Tolerances, machine_of
from schemas.request.scene import Fidelity


class Demand(NamedTuple):
    """Target gap of an optimum, and time limit of its search."""

    relative_gap: float  # relative to the yardstick of the objective
    least_mass: bool  # take the least total mass among the optima
    time_limit_s: float


class ScenarioMachine(NamedTuple):
    """A machine that the counterweights are to suit in place of the unchanged one.

    changes : of the request, where they are stated.
    """

    name: str
    machine: Machine
    weight: float
    changes: Path


@record(frozen=True)
class Task:
    """A machine, and the demands on its counterweights.

    machine : unchanged, or with the radii of what is cut from its plates.
    scenarios : machines that count in its place, if any are stated.
    tolerances : what may be off; None where nothing is said of it.
    """

    machine: Machine
    objective: Objective
    fidelity: Fidelity
    relative_gap: float
    time_limit_s: float
    scenarios: tuple[ScenarioMachine, ...] = ()
    tolerances: Tolerances | None = None

    @classmethod
    def of(cls, request: OptimizeRequest) -> "Task":
        """What a request asks; its fields may hold columns, as in :func:`optimizer.mechanics.layout.layout`."""
        accuracy = request.accuracy
        return cls(
            request.machine,
            request.objective,
            request.fidelity,
            accuracy.relative_gap,
            accuracy.time_limit_s,
            tuple(
                ScenarioMachine(scenario.name, machine_of(request, scenario), scenario.weight, changes)
                for scenario, _, changes, _ in request.cases
            ),
            request.tolerances,
        )

    def nominal(self, time_limit_s: float) -> "Task":
        """The same of the unchanged machine alone, with nothing off."""
        return replace(self, scenarios=(), tolerances=None, time_limit_s=time_limit_s)

    @property
    def robust(self) -> bool:
        """Whether more counts than the unchanged machine."""
        return bool(self.scenarios) or (self.tolerances is not None and self.tolerances.any)

    @property
    def uncertain(self) -> bool:
        """Whether an answer tells its worst case: of scenarios, or of tolerances, of nothing too."""
        return bool(self.scenarios) or self.tolerances is not None

    @cached_property
    def choice(self) -> Choice | None:
        """The kind of options for counterweights; None is any mass at any angle."""
        return self.machine.choice

    @cached_property
    def space(self) -> DesignSpace:
        """All that its program chooses."""
        return design_space(self.machine, self.objective)

    @property
    def demand(self) -> Demand:
        """Target gap and time limit."""
        return Demand(self.relative_gap, self.objective.least_mass, self.time_limit_s)

    @property
    def of_any_mass(self) -> Demand:
        """The same of the optimum of any mass at any angle, that a search of choices begins with."""
        return Demand(Accuracy().relative_gap, False, self.time_limit_s)
