"""Methods where something is off, or several machines count: each sees a part, and the worst case of all judges.

The steps are the nominal optimum, a scenario by itself, the scenarios that are worst at the optimum of the step before,
the corner of the masses that is worst by the derivatives, the corners that are worst at the optimum of the step before,
and the whole worst case with its proof. What a step leaves out only lowers its objective, so that its bound is one of
the worst case too. The unchanged machine may be none of the scenarios: beside these its optimum proves nothing.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from optimizer.formulation.goals import Goals
from optimizer.formulation.simulation import Prepared
from optimizer.formulation.task import Demand, Task
from optimizer.mechanics.scatter import weighted
from optimizer.numerics.arrays import Complex, Real
from optimizer.program.ceilings import CEILING_TOLERANCE
from optimizer.program.cuts.optimum import CertifiedOptimum, Conflict
from optimizer.program.cuts.row_generation import MANY
from optimizer.program.cuts.semi_infinite import Problem
from optimizer.program.optimum import optimum
from optimizer.program.statement import Statement
from optimizer.solve.answer_fields import bound_beside
from optimizer.solve.uncertain_program import MachineOfCase, Measure, Robust
from optimizer.solve.worst_case import nominal
from optimizer.studies.accuracy.judge import JudgeOfNorms
from optimizer.studies.accuracy.ladder import SOLVE_S
from optimizer.studies.accuracy.methods import GAPS, LadderProgram, Method, MethodResult, Run, methods
from schemas.request.objective import COSTS

#: gap asked of every step but those of the service
SHARPEST = 1e-9
#: times that corners are added
ROUNDS = (1, 2, 3)
#: norms that a method is tried with: an interior point factors three unknowns for each, in finer numbers slowly
MOST_NORMS, MOST_FINE_NORMS = 64, 16
#: a part of what is off, and the optimum by it
Step = Callable[[Robust], CertifiedOptimum | Conflict]
_UNREACHABLE = "no counterweights keep the ceilings"
_NO_SCATTER = "knows no scatter: it sees the machine as drawn, at its angles"
_NO_SCENARIOS = "knows no scenarios: it sees one machine, at its angles"
_ONE_SUM = "knows no scatter of {}: its program is one sum of norms"
_OF_CEILINGS, _OF_PEAKS = "counterweights under ceilings", "several peaks, each at a worst case of its own"
_MANY_SUMS = "too large: the sums of all scenarios at all corners are more than {} rows"
_MASSES = ("reciprocating_mass_relative",)
_COUNTERWEIGHTS = ("mass_relative", "angle_deg", "unbalance_kg_m")
_EVERYTHING = (*_MASSES, *_COUNTERWEIGHTS)


def whole_problem(task: Task, scene: Prepared) -> Problem:
    """The worst case of everything that may be off, whatever the counterweights."""
    return Robust(task, scene, task.demand).goals().anywhere


def uncertain_methods(steps: "Steps", judge: JudgeOfNorms) -> Iterator[Method]:
    """All methods: the steps to the worst case, then those of the unchanged machine.

    Parameters
    ----------
    judge : the whole worst case, of the webs that the program of the ladder has.
    """
    yield from parts(steps)
    for gap in GAPS:
        yield Method("service", f"relative gap {gap:.0e}", steps.run(gap, steps.whole))
    obstacle, single = _obstacle(judge), judge.single_sum
    absent = set[str]()
    for method in methods():
        reason = obstacle
        if method.name == "cone_program_matrices":
            if single is not None:
                yield replace(method, prepare=partial(_with_rows, method, single))
                continue
            reason = _MANY_SUMS.format(MANY)
        elif method.name == "sampled_angles":
            reason = _NO_SCENARIOS if steps.task.scenarios else _NO_SCATTER
        if method.name == "service" or method.name in absent:
            continue
        if reason is not None:
            absent.add(method.name)
            yield absence(method.name, reason)
        else:
            yield replace(method, prepare=partial(_with_terms, method), entries=partial(_entries, method))


def parts(steps: "Steps") -> Iterator[Method]:
    """The steps that see a part of the worst case."""
    scenarios = steps.task.scenarios
    # without scenarios the unchanged machine is a part of what may be
    proves = not scenarios
    yield Method("nominal", "nothing off", steps.run(SHARPEST, steps.nominal, proves))
    for n, scenario in enumerate(scenarios if len(scenarios) > 1 else ()):
        name = f"scenario {scenario.name}"
        yield Method("one_scenario", name, steps.run(SHARPEST, partial(steps.of_scenarios, [n])))
    for rounds in ROUNDS if len(scenarios) > 1 else ():
        if rounds <= len(scenarios):
            prepared = steps.run(SHARPEST, partial(steps.worst_scenarios, rounds))
            yield Method("worst_scenarios", rounds_in_words(rounds), prepared)
    worst = steps.robust(SHARPEST, SOLVE_S)
    if scenarios and (worst.scatters or any(worst.scatter)):
        yield Method("partly_off", "scenarios alone", steps.run(SHARPEST, partial(steps.without, _EVERYTHING)))
    if worst.scatters and any(worst.scatter):
        for name, zero in (("counterweights", _MASSES), ("masses", _COUNTERWEIGHTS)):
            yield Method("partly_off", f"{name} alone", steps.run(SHARPEST, partial(steps.without, zero)))
    if worst.scatters and worst.measures:
        yield Method("first_order", "corners by derivatives", steps.run(SHARPEST, steps.first_order))
        for rounds in ROUNDS:
            yield Method("corners", rounds_in_words(rounds), steps.run(SHARPEST, partial(steps.corners, rounds)))


def rounds_in_words(count: int) -> str:
    """The setting of a method by rounds."""
    return "1 round" if count == 1 else f"{count} rounds"


def _entries(method: Method, task: LadderProgram) -> int:
    return 0 if task.plain is None else method.entries(replace(task, statement=task.plain))


def _with_terms(method: Method) -> Run:
    """A method of machines as they are given, with what is off written as terms of their program."""
    run = method.prepare()
    most = MOST_FINE_NORMS if method.name == "interior_point_interpreted" else MOST_NORMS

    def result(task: LadderProgram, position: float, time_limit_s: float) -> MethodResult | str:
        assert task.plain is not None  # without it such methods are rows that say why
        norms = task.plain.norms.constant.size
        if norms > most:
            return f"too large: {norms} norms, at most {most} are tried"
        return run(replace(task, statement=task.plain), position, time_limit_s)

    return result


def _with_rows(method: Method, statement: Statement) -> Run:
    """A method that takes what is off as it is, with one sum of every row with every other."""
    run = method.prepare()
    return lambda task, position, limit: run(replace(task, statement=statement, sums=None), position, limit)


def absence(method: str, reason: str) -> Method:
    """The row of a method that cannot take part."""

    def run(task: LadderProgram, position: float, time_limit_s: float) -> str:
        return reason

    return Method(method, "none", lambda: run)


def plain(judge: JudgeOfNorms) -> Statement | None:
    """A program with what scatters as terms of its own; None where it is no single sum of norms."""
    return None if _obstacle(judge) else judge.statement.spelled()


def _obstacle(judge: JudgeOfNorms) -> str | None:
    if judge.statement.norms.scatter and judge.statement.ceilings.names:
        return _ONE_SUM.format(_OF_CEILINGS)
    return _ONE_SUM.format(_OF_PEAKS) if judge.statement.group[-1] > 0 else None


class Steps:
    """The steps of one task to the worst case."""

    def __init__(self, task: Task, scene: Prepared, usable: np.ndarray) -> None:
        """Prepare the machines.

        Parameters
        ----------
        usable : (K,) webs that the program of the ladder has.
        """
        self.task, self._scene, self._usable = task, scene, usable
        #: machines of the scenarios, which no run prepares again
        self._machines = Robust(task, scene, task.demand).machines
        goals = [priority.goal for priority in task.objective.priorities if priority.goal not in COSTS]
        self.has_several_goals = len(goals) > 1

    @property
    def senses(self) -> dict[str | None, float]:
        """Of rotation, 1 or -1, of the machine of every scenario."""
        return {machine.scenario: float(machine.scene.laden.sense) for machine in self._machines}

    def robust(self, relative_gap: float, time_limit_s: float) -> Robust:
        """The program of the whole worst case, for the smallest objective alone."""
        return self._robust(self.task, Demand(relative_gap, False, time_limit_s), self._machines)

    def _robust(self, task: Task, demand: Demand, machines: Sequence[MachineOfCase]) -> Robust:
        return Robust(task, self._scene, demand, machines)

    def run(self, gap: float, step: Step, proves: bool = True) -> Callable[[], Run]:
        """Prepare a method that takes a step.

        Parameters
        ----------
        proves : whether its bound is one of the worst case.
        """

        def run(task: LadderProgram, position: float, time_limit_s: float) -> MethodResult | str:
            result = step(self.robust(gap, time_limit_s))
            if isinstance(result, Conflict):
                return _UNREACHABLE if proves else f"{_UNREACHABLE} of the unchanged machine"
            # under goals of a part, which are smaller, the last of them may be larger than in the whole
            return self.result(result, proves and not self.has_several_goals)

        return lambda: run

    def result(self, optimum: CertifiedOptimum, proves: bool = True) -> MethodResult:
        """An optimum as that of a method."""
        point = optimum.point
        bound = bound_beside(optimum.proof, point.values.excess) if proves else -np.inf
        return MethodResult(point.unbalance[self._usable], float(point.values.goals[-1]), lambda: bound)

    @staticmethod
    def nominal(worst: Robust) -> CertifiedOptimum | Conflict:
        """The optimum with nothing off."""
        return _optimum(nominal(worst), worst)

    def without(self, fields: tuple[str, ...], worst: Robust) -> CertifiedOptimum | Conflict:
        """The optimum with some of the tolerances 0."""
        tolerances = worst.task.tolerances
        assert tolerances is not None  # there is a ladder of them
        less = tolerances.model_copy(update=dict.fromkeys(fields, 0.0))
        return self._robust(replace(self.task, tolerances=less), worst.demand, self._machines).solved()[1]

    def of_scenarios(self, places: Sequence[int], worst: Robust) -> CertifiedOptimum | Conflict:
        """The optimum with some of the scenarios, by their places."""
        return self._subset(places, worst).solved()[1]

    def _subset(self, places: Sequence[int], worst: Robust) -> Robust:
        task = replace(self.task, scenarios=tuple(self.task.scenarios[n] for n in places))
        return self._robust(task, worst.demand, [self._machines[n] for n in places])

    def worst_scenarios(self, rounds: int, worst: Robust) -> CertifiedOptimum | Conflict:
        """The optimum with the scenarios that so many rounds know; the first knows the worst without counterweights."""
        every = [self._subset([n], worst) for n in range(len(self.task.scenarios))]
        u, places = np.zeros(len(worst.space.machine.webs), complex), list[int]()
        result: CertifiedOptimum | Conflict
        for _ in range(rounds):
            place = _worst(every, u)
            if place in places:
                break
            places.append(place)
            result = self.of_scenarios(places, worst)
            if isinstance(result, Conflict):
                break
            u = result.point.unbalance
        return result

    def first_order(self, worst: Robust) -> CertifiedOptimum | Conflict:
        """The optimum at the corners of the masses that are worst by the derivatives at the nominal optimum."""
        result = self.nominal(worst)
        # where nominal ceilings cannot be kept, at what comes closest to them
        u = (result.closest if isinstance(result, Conflict) else result.point).unbalance
        signs = [[_steepest(machine, measure, u) for measure in worst.measures] for machine in worst.machines]
        return _optimum(worst.goals_at(signs), worst)

    def corners(self, rounds: int, worst: Robust) -> CertifiedOptimum | Conflict:
        """The optimum with the corners that so many rounds know; the first knows those without counterweights."""
        result = _optimum(worst.goals(), worst)
        for _ in range(rounds - 1):
            if isinstance(result, Conflict) or not worst.learnt(result.point.unbalance):
                break
            result = _optimum(worst.goals(), worst)
        return result

    @staticmethod
    def whole(worst: Robust) -> CertifiedOptimum | Conflict:
        """The optimum of the whole worst case."""
        return worst.solved()[1]


def _optimum(goals: Goals, worst: Robust) -> CertifiedOptimum | Conflict:
    return optimum(goals.program, worst.demand.relative_gap, worst.demand.least_mass, worst.left_s)


def _worst(scenarios: Sequence[Robust], u: Complex) -> int:
    """The scenario that is worst with counterweights (K,): whose ceilings are exceeded most, else by its objective."""
    figures = []
    for scenario in scenarios:
        scenario.learnt(u)
        values = scenario.goals().program.values(u, SHARPEST)
        figures.append((max(values.excess, CEILING_TOLERANCE), float(values.goals[-1])))
    return max(range(len(figures)), key=figures.__getitem__)


def _steepest(machine: MachineOfCase, measure: Measure, u: Complex) -> Real:
    """Signs of the changes of all masses (rows,) by which a peak grows, to first order, with counterweights (K,)."""
    response, *weights = measure
    vector, parts = (
        weighted(phasors, *weights) for phasors in (machine.nominal[response].to(u), machine.parts[response])
    )
    growth = _along(vector.co, parts.co) + _along(vector.counter, parts.counter)
    return np.where(growth >= 0.0, 1.0, -1.0)


def _along(vector: Complex, change: Complex) -> Real:
    """What the length of a vector grows by for small changes (...); of no vector nothing is known to first order."""
    size = np.abs(vector)
    return np.real(np.conj(vector) * change) / size if size > 0.0 else np.zeros(change.shape)
