"""Methods where something is off: each sees a part of what may be, and the worst case of all of it judges.

The steps are the nominal optimum, the corner of the masses that is worst by the derivatives there, the corners that are
worst at the optimum of the step before, and the whole worst case with its proof. What a step leaves out only lowers its
objective, so that its bound is one of the worst case too.
"""

from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial

import numpy as np

from optimizer.formulation.goals import Goals
from optimizer.formulation.simulation import Prepared
from optimizer.formulation.task import Demand, Task
from optimizer.mechanics.scatter import weighted
from optimizer.numerics.arrays import Complex, Real
from optimizer.program.cuts.optimum import CertifiedOptimum, Conflict
from optimizer.program.optimum import optimum
from optimizer.program.statement import Statement
from optimizer.solve.answer_fields import bound_beside
from optimizer.solve.uncertain_program import MachineOfCase, Measure, Robust
from optimizer.solve.worst_case import nominal
from optimizer.studies.accuracy.ladder import SOLVE_S
from optimizer.studies.accuracy.methods import GAPS, LadderProgram, Method, MethodResult, Run, methods

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
_ONE_SUM = "knows no scatter of {}: its program is one sum of norms"
_OF_CEILINGS, _OF_PEAKS = "counterweights under ceilings", "several peaks, each at a worst case of its own"
#: those that a program with what is off can be handed to as it is
_KNOWING = ("service", "cone_program_matrices")
_MASSES = ("reciprocating_mass_relative",)
_COUNTERWEIGHTS = ("mass_relative", "angle_deg", "unbalance_kg_m")


def robust(task: Task, scene: Prepared, relative_gap: float, time_limit_s: float) -> Robust:
    """The program of a task, for the smallest objective alone."""
    return Robust(task, scene, Demand(relative_gap, False, time_limit_s))


def whole_worst_case(task: Task, scene: Prepared) -> Statement:
    """The worst case of everything that may be off, whatever the counterweights."""
    return Robust(task, scene, task.demand).goals().anywhere.begun


def uncertain_methods(task: Task, scene: Prepared, usable: np.ndarray, statement: Statement) -> Iterator[Method]:
    """All methods: the steps to the worst case, then those of a machine as it is given.

    Parameters
    ----------
    usable : (K,) webs that the program of the ladder has.
    statement : that program, of the whole worst case.
    """
    steps = _Steps(task, scene, usable)
    obstacle = _obstacle(statement)
    yield Method("nominal", "nothing off", steps.run(SHARPEST, steps.nominal))
    worst = robust(task, scene, SHARPEST, SOLVE_S)
    if worst.scatters and any(worst.scatter):
        for name, zero in (("counterweights", _MASSES), ("masses", _COUNTERWEIGHTS)):
            yield Method("partly_off", f"{name} alone", steps.run(SHARPEST, partial(steps.without, zero)))
    if worst.scatters:
        yield Method("first_order", "corners by derivatives", steps.run(SHARPEST, steps.first_order))
        for rounds in ROUNDS:
            name = "1 round" if rounds == 1 else f"{rounds} rounds"
            yield Method("corners", name, steps.run(SHARPEST, partial(steps.corners, rounds)))
    for gap in GAPS:
        yield Method("service", f"relative gap {gap:.0e}", steps.run(gap, steps.whole))
    absent = set[str]()
    for method in methods():
        if method.name == "cone_program_matrices":
            yield method
        elif method.name not in _KNOWING and method.name not in absent:
            reason = _NO_SCATTER if method.name == "sampled_angles" else obstacle
            if reason is None:
                yield replace(method, prepare=partial(_with_terms, method), entries=partial(_entries, method))
            else:
                absent.add(method.name)
                yield Method(method.name, "none", partial(_absent, reason))


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


def _absent(reason: str) -> Run:
    return lambda task, position, time_limit_s: reason


def plain(statement: Statement) -> Statement | None:
    """A program with what scatters as terms of its own; None where it is no single sum of norms."""
    return None if _obstacle(statement) else statement.spelled()


def _obstacle(statement: Statement) -> str | None:
    if statement.norms.scatter and statement.ceilings.names:
        return _ONE_SUM.format(_OF_CEILINGS)
    return _ONE_SUM.format(_OF_PEAKS) if statement.group[-1] > 0 else None


class _Steps:
    """The steps of one task to the worst case."""

    def __init__(self, task: Task, scene: Prepared, usable: np.ndarray) -> None:
        self._task, self._scene, self._usable = task, scene, usable

    def run(self, gap: float, step: Step) -> Callable[[], Run]:
        """Prepare a method that takes a step, with what it proves."""

        def run(task: LadderProgram, position: float, time_limit_s: float) -> MethodResult | str:
            result = step(robust(self._task, self._scene, gap, time_limit_s))
            if isinstance(result, Conflict):
                return _UNREACHABLE
            point, bound = result.point, bound_beside(result.proof, result.point.values.excess)
            return MethodResult(point.unbalance[self._usable], float(point.values.goals[-1]), lambda: bound)

        return lambda: run

    @staticmethod
    def nominal(worst: Robust) -> CertifiedOptimum | Conflict:
        """The optimum with nothing off."""
        return _optimum(nominal(worst), worst)

    def without(self, fields: tuple[str, ...], worst: Robust) -> CertifiedOptimum | Conflict:
        """The optimum with some of the tolerances 0."""
        tolerances = worst.task.tolerances
        assert tolerances is not None  # there is a ladder of them
        less = tolerances.model_copy(update=dict.fromkeys(fields, 0.0))
        return robust(replace(self._task, tolerances=less), self._scene, *worst.demand[::2]).solved()[1]

    def first_order(self, worst: Robust) -> CertifiedOptimum | Conflict:
        """The optimum at the corners of the masses that are worst by the derivatives at the nominal optimum."""
        result = self.nominal(worst)
        if isinstance(result, Conflict):
            return result
        u = result.point.unbalance
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
