"""The program of one task: of the unchanged machine, or of several; counterweights may be a little off.

Scenarios are cases of one program; without any the unchanged machine is the only one. Tolerances of counterweights are
part of it. Of reciprocating masses that scatter the worst corner of every peak depends on the counterweights. Such
corners are added as variants of their case until the counterweights have none that is worse. Then the program is that
of all corners.
"""

import time
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from optimizer.errors import MissingInput
from optimizer.formulation.balance_shafts import DesignSpace, design_space
from optimizer.formulation.formulate import active_responses, objective_ceilings, responses, weights
from optimizer.formulation.goals import Case, Goals, formulate
from optimizer.formulation.simulation import Prepared
from optimizer.formulation.task import Demand, Task
from optimizer.mechanics.scatter import changed, row_parts, weighted, worst_signs
from optimizer.mechanics.shapes import plates
from optimizer.mechanics.whole_turn import WholeTurn
from optimizer.numerics.arrays import Complex, Real
from optimizer.numerics.memoization import cached_property
from optimizer.numerics.records import record
from optimizer.outputs.registry import prepare
from optimizer.outputs.requirements import effects_of_objective, missing
from optimizer.program.cuts.cut import EXACT, Scatter
from optimizer.program.cuts.optimum import CertifiedOptimum, Conflict
from optimizer.program.cuts.semi_infinite import Problem
from optimizer.program.optimum import cone_program, optimum
from optimizer.responses.response import Phasors, Response
from optimizer.solve.plates import cut_optimum
from optimizer.solve.whole_turn import whole_turn_of
from schemas.base.model import FieldProblem
from schemas.base.target import pointer
from schemas.request.scenarios import Tolerances

#: a corner that is worse by less than this share is as good as one in the program
_ALIKE = 1e-14
#: times that corners are added before it ends with what is proven
MOST_ROUNDS = 60


class Measure(NamedTuple):
    """A peak of the first order: of a response by its place, with the weights of its components."""

    response: int
    weight_x: float
    weight_y: float


def scatter_of(tolerances: Tolerances | None) -> Scatter:
    """What counterweights may be off by: the farthest point of what mass and angle may make of a unit vector."""
    if tolerances is None:
        return EXACT
    angle = min(np.deg2rad(tolerances.angle_deg), np.pi)
    # |(1 + d) e^{ja} - 1|, without the digits that the difference of nearly equal numbers would lose
    shares = (tolerances.mass_relative, -tolerances.mass_relative)
    ends = [np.hypot(share, 2.0 * np.sqrt(1.0 + share) * np.sin(0.5 * angle)) for share in shares]
    return Scatter(float(max(ends)), tolerances.unbalance_kg_m)


@record(frozen=True)
class MachineOfCase:
    """The unchanged machine, or that of a scenario, with reciprocating masses that scatter."""

    space: DesignSpace  # with the webs of its balance shafts behind those of the crankshaft
    scene: Prepared
    scenario: str | None
    weight: float
    share: float  # by which its reciprocating masses may be off

    @cached_property
    def nominal(self) -> tuple[Response, ...]:
        """Responses with the masses as they should be."""
        every = self.scene.responses
        if self.space.objective.orders == "all":
            # nothing is mirrored
            every = tuple(response.unmirrored() for response in every)
        return (
            every if self.scenario is None else tuple(replace(response, scenario=self.scenario) for response in every)
        )

    @cached_property
    def parts(self) -> tuple[Phasors, ...]:
        """What every row adds to the responses, (rows,) each."""
        plan = self.scene.layout
        return tuple(response.baseline for response in responses(plan, row_parts(plan), self.space.objective))

    @property
    def scatters(self) -> bool:
        return self.share > 0.0 and self.scene.layout.reciprocating.mass.size > 0

    def corners(self, measure: Measure) -> Real:
        """Signs of the changes of all masses (corners, rows), among which a peak has its largest."""
        if not self.scatters:
            return np.zeros((1, self.parts[measure.response].co.size))
        return worst_signs(self.parts[measure.response], measure.weight_x, measure.weight_y)

    def sizes(self, measure: Measure, signs: Real, u: Complex) -> Real:
        """Peaks (corners,) with changes of these signs, counterweights as they should be; over omega^2."""
        r, weight_x, weight_y = measure
        vector = self.nominal[r].to(u) + changed(self.parts[r], signs, self.share)
        return weighted(vector, weight_x, weight_y).peak

    @cached_property
    def turn(self) -> WholeTurn:
        """The forces of its rows over the turn."""
        return whole_turn_of(self.scene, self.space.objective)

    def case(self, corners: Sequence[Real] = ()) -> Case:
        """What the program asks of it, with the masses as they should be or with changes of these signs (rows,)."""
        variants = tuple(
            tuple(
                replace(response, baseline=response.baseline + changed(part, signs, self.share))
                for response, part in zip(self.nominal, self.parts, strict=True)
            )
            for signs in corners
        )
        turn = (self.turn, self.scene.laden) if self.space.objective.of_the_revolution else None
        masses = self.share if self.scatters else 0.0
        arguments = self.scenario, self.weight, masses
        return Case(self.space.machine, self.scene.omega_squared, variants or (self.nominal,), turn, *arguments)


class Robust:
    """The program of one task, with the worst masses so far where they scatter."""

    def __init__(
        self, task: Task, scene: Prepared, demand: Demand, machines: Sequence[MachineOfCase] | None = None
    ) -> None:
        """Prepare the machines of all scenarios.

        Parameters
        ----------
        machines : those of the scenarios of the task, where another program of the same scene has prepared them.

        Raises
        ------
        MissingInput
            if one of them lacks what the objective needs.
        """
        self.task, self.scene, self.demand, self.space = task, scene, demand, task.space
        tolerances = task.tolerances
        self.scatter = scatter_of(tolerances)
        share = 0.0 if tolerances is None else tolerances.reciprocating_mass_relative
        if machines is None:
            machines = list(_scenarios(task, scene, share)) or [MachineOfCase(self.space, scene, None, 1.0, share)]
            for machine in machines:
                if machine.scene is not scene:
                    scene.simulated.join(machine.scene.simulated, "scenarios")
        self.machines = [entry if entry.share == share else replace(entry, share=share) for entry in machines]
        self._until = time.thread_time() + demand.time_limit_s
        #: signs of the changes of masses so far, of every machine
        self._signs: list[list[Real]] = [[] for _ in self.machines]
        if self.scatters:
            self.learnt(np.zeros(len(self.space.machine.webs), complex))

    @cached_property
    def scatters(self) -> bool:
        """Whether any reciprocating masses do."""
        return any(machine.scatters for machine in self.machines)

    @cached_property
    def measures(self) -> list[Measure]:
        """Peaks of the first order that count or are limited, each once."""
        return list(dict.fromkeys(_measures(self.task)))

    @property
    def left_s(self) -> float:
        """What is left of the time limit."""
        return max(self._until - time.thread_time(), 0.0)

    def goals(self) -> Goals:
        """The program with the changes of masses so far."""
        goals = self.goals_at(self._signs)
        return replace(goals, of_all_masses=self._of_all_masses) if self.scatters and self.measures else goals

    def goals_at(self, signs: Sequence[Sequence[Real]]) -> Goals:
        """The program with changes of masses of these signs (rows,), some for every machine."""
        cases = [machine.case(changes) for machine, changes in zip(self.machines, signs, strict=True)]
        (machine, objective), fidelity = self.space, self.task.fidelity
        return formulate(machine, objective, cases, self.scene.omega_squared, fidelity, self.scatter, self.scatters)

    def _of_all_masses(self) -> Problem:
        every = [np.concatenate([machine.corners(measure) for measure in self.measures]) for machine in self.machines]
        return self.goals_at([list(np.unique(corners, axis=0)) for corners in every]).program

    def learnt(self, *unbalances: Complex) -> bool:
        """Whether counterweights (K,), a set or several, show changes of masses that are worse than those so far."""
        # of all of them, so that the changes so far hold for each
        worse = [self._has_worse(u) for u in unbalances if self.scatters]
        return any(worse)

    def _has_worse(self, u: Complex) -> bool:
        """The same of one set, whose worse changes count from then on."""
        new = [
            list(self._worse(machine, changes, u)) for machine, changes in zip(self.machines, self._signs, strict=True)
        ]
        for changes, more in zip(self._signs, new, strict=True):
            changes += more
        return any(new)

    def _worse(self, machine: MachineOfCase, signs: Sequence[Real], u: Complex) -> Iterator[Real]:
        additions: list[Real] = []
        for measure in self.measures if machine.scatters else ():
            corners, so_far = machine.corners(measure), [*signs, *additions]
            size = machine.sizes(measure, corners, u)
            if not so_far or np.max(size) > (1.0 + _ALIKE) * np.max(machine.sizes(measure, np.stack(so_far), u)):
                additions.append(corners[np.argmax(size)])
        yield from additions

    def solved(self) -> tuple[Goals, CertifiedOptimum | Conflict]:
        """The program with all changes of masses that matter, and its proof."""
        gap, least = self.demand.relative_gap, self.demand.least_mass
        for _ in range(MOST_ROUNDS):
            goals = self.goals()
            result = self._cut(goals.program) or optimum(goals.program, gap, least, self.left_s)
            # what an earlier goal came to is judged like the answer
            if isinstance(result, Conflict) or not self.learnt(*result.every_unbalance):
                return goals, result
            if result.timed_out:
                break
        # judged by all changes so far: the gap is what stays open
        return self.goals(), result

    def _cut(self, program: Problem) -> CertifiedOptimum | Conflict | None:
        """The optimum of a cone program of plates; None of other problems.

        A budget holds of what is cut. This optimum has a budget of the tangents.
        """
        cut, budget = plates(self.space.machine), program.limits.max_total_mass < np.inf
        statement = None if cut is None or budget else cone_program(program, self.demand.least_mass)
        if cut is None or statement is None:
            return None
        return cut_optimum(self.space.machine, cut, program, statement, self.demand)


def _scenarios(task: Task, nominal: Prepared, share: float) -> Iterator[MachineOfCase]:
    objective = task.objective
    for name, machine, weight, changes in task.scenarios:
        lacking = list(missing(machine, objective))
        if lacking:
            raise MissingInput(FieldProblem(changes, f"{pointer(path)}: {message}") for path, message in lacking)
        scene = prepare(nominal.request, ("residual",), effects_of_objective(objective), machine)
        yield MachineOfCase(design_space(machine, objective), replace(scene, objective=objective), name, weight, share)


def _measures(task: Task) -> Iterator[Measure]:
    """Peaks of the first order that count or are limited."""
    objective = task.objective
    if objective.orders == "all":
        return
    across, weight_of = objective.direction_weights, weights(task.machine, objective)
    names = [quantity.name for quantity in active_responses(objective)]
    for r, name in enumerate(names):
        if weight_of[name] > 0:
            yield Measure(r, across.x, across.y)
    for ceiling, _ in objective_ceilings(objective):
        response = names.index(ceiling.response.partition(":")[0])
        yield Measure(response, float(ceiling.axis != "y"), float(ceiling.axis != "x"))
