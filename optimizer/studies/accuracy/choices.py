"""What accuracy costs where counterweights are as a workshop makes them: gap, mass and pieces against time.

Chosen from a catalogue, at least so heavy, alike in groups, or cut from plates: the ways are the service itself with
several limits of time and several gaps, and the optimum of any masses put on what is nearest.
"""

import logging
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, Literal, NamedTuple

import numpy as np

from optimizer.choices.catalogue_options import part_numbers
from optimizer.choices.construction import options_of, takes_options
from optimizer.choices.discrete.options import EQUAL
from optimizer.formulation.balance_shafts import web_paths
from optimizer.formulation.counterweights import unbalance
from optimizer.formulation.goals import cone_program
from optimizer.formulation.groups import alike_webs
from optimizer.formulation.simulation import Prepared
from optimizer.formulation.task import Task
from optimizer.mechanics.fixed_weights import fixed_mass
from optimizer.mechanics.layout import stacked
from optimizer.mechanics.shapes import closed, every_plate
from optimizer.numerics.arrays import Complex, Real
from optimizer.numerics.memoization import cached_property
from optimizer.numerics.records import record
from optimizer.program.ceilings import CEILING_TOLERANCE
from optimizer.solve.solution import Infeasible
from optimizer.solve.solve import solve
from optimizer.studies.accuracy.judge import Judge, JudgeOfNorms, judge_of
from optimizer.studies.accuracy.ladder import LADDER_S, ROUNDS_S, frontier, median_ms
from optimizer.studies.accuracy.uncertain import whole_problem
from schemas.base.rules import Path
from schemas.base.variation import with_fields
from schemas.machine.choices import KINDS as CHOICES
from schemas.machine.machine import Machine
from schemas.request.accuracy import AccuracyRequest, ChoiceRow, Reference
from schemas.request.requests import Accuracy

_LOG = logging.getLogger(__name__)
#: limits of time up to that of the request, s, and gaps
LIMITS_S = (0.1, 0.3, 1.0, 3.0, 10.0)
GAPS = (1e-2, 1e-3, 1e-4)
#: asked of a search that a limit of time is to end
_CLOSEST = EQUAL
#: the shortest limit of time that is asked for, s
_SHORTEST_S = 1e-3
Aim = Literal["gap", "time", "none"]
#: of the rungs of one aim the first that ends so leaves nothing to those after it, and what these say
_ENDS: Mapping[Aim, str] = {"gap": "inaccurate", "time": "optimal"}
_BEYOND: Mapping[Aim, str] = {"gap": "{} was not reached within the limit of time", "time": "{} sufficed"}
_UNREACHABLE = "no counterweights keep the ceilings"
#: of a total mass, relative: by which sums are rounded
_ROUNDING = 1e-12


class Candidate(NamedTuple):
    """Counterweights that one way comes to."""

    mass: Real  # (K + S,) kg, those on balance shafts behind those of the crankshaft, fixed weights apart
    objective: float  # as it is answered
    bound: float | None
    feasible: bool
    status: str | None


class Nothing(NamedTuple):
    """Why a way comes to none."""

    reason: str


@dataclass
class Rung:
    """One way, and what has been seen of it."""

    method: Literal["service", "rounding"]
    setting: str
    aim: Aim
    run: Callable[[float], Candidate | Nothing]  # of the seconds that are left
    candidate: Candidate | None = None
    times_s: list[float] = field(default_factory=list)
    skipped: str | None = None

    @property
    def feasible(self) -> bool:
        """Whether there are counterweights, and they keep the limits."""
        return self.candidate is not None and self.candidate.feasible


class Ladder(NamedTuple):
    """What the ways come to; no reference where limits are out of reach or a bound is above a value."""

    reference: Reference | None
    rows: tuple[ChoiceRow, ...]
    unreachable: bool


def at_rest(request: AccuracyRequest, scene: Prepared) -> Judge:
    """The program of any masses, of the worst case where there is more than the unchanged machine; plates are not
    opened yet, and reach as far as they can."""
    task = Task.of(request)
    if task.robust or task.objective.of_the_revolution:
        return judge_of(whole_problem(task, scene))
    (machine, objective), square = task.space, np.array([scene.omega_squared])
    return JudgeOfNorms(cone_program(closed(machine), objective, scene.responses, square).subset(0))


def choices_ladder(request: AccuracyRequest, scene: Prepared) -> Ladder:
    """Every way once, then in rounds those that are quick.

    Raises
    ------
    OutOfRange
        where the options of a web cannot be told, or webs of a group are unlike.
    """
    ways = _Ways(request, scene)
    ways.warm_up()
    end, rungs = time.thread_time() + LADDER_S, list(ways.rungs())
    enough = dict[Aim, str]()
    for rung in rungs:
        _first(rung, end - time.thread_time(), enough.get(rung.aim))
        if rung.skipped == _UNREACHABLE:
            return Ladder(None, (), True)
        if rung.candidate is not None and rung.aim in _ENDS and rung.candidate.status == _ENDS[rung.aim]:
            enough.setdefault(rung.aim, _BEYOND[rung.aim].format(rung.setting))
    for _ in range(request.repeats - 1):
        for rung in rungs:
            left_s = end - time.thread_time()
            if rung.candidate is not None and sum(rung.times_s) < ROUNDS_S and left_s > 0:
                _timed(rung, left_s)
    return ways.judged(rungs)


def _first(rung: Rung, left_s: float, enough: str | None) -> None:
    if enough is not None or left_s <= 0:
        rung.skipped = enough or f"the {LADDER_S:.0f} s of the whole ladder were used up"
        return
    outcome = _timed(rung, left_s)
    if isinstance(outcome, Nothing):
        rung.skipped = outcome.reason
    else:
        rung.candidate = outcome


def _timed(rung: Rung, left_s: float) -> Candidate | Nothing:
    # of this thread alone, as limits of time are
    start = time.thread_time()
    outcome = rung.run(left_s)
    rung.times_s.append(time.thread_time() - start)
    return outcome


@record(frozen=True)
class _Ways:
    """What is asked, and the ways to it."""

    request: AccuracyRequest
    scene: Prepared

    @cached_property
    def judge(self) -> Judge:
        return at_rest(self.request, self.scene)

    @cached_property
    def task(self) -> Task:
        return Task.of(self.request)

    @cached_property
    def free(self) -> Task:
        """Any mass at any angle on every web; plates stay plates."""
        task, usual = self.task, Accuracy()
        scenarios = tuple(scenario._replace(machine=_free(scenario.machine)) for scenario in task.scenarios)
        return replace(
            task,
            machine=_free(task.machine),
            scenarios=scenarios,
            relative_gap=usual.relative_gap,
            time_limit_s=usual.time_limit_s,
        )

    def rungs(self) -> Iterator[Rung]:
        machine, longest = self.request.machine, self.request.accuracy.time_limit_s
        for gap in GAPS:
            yield Rung("service", f"relative gap {gap:.0e}", "gap", self._service(gap, longest))
        if machine.choice is not None:
            # groups and plates alone are no search
            for limit in (*(seconds for seconds in LIMITS_S if seconds < longest), longest):
                yield Rung("service", f"{limit:g} s", "time", self._service(_CLOSEST, limit))
        if every_plate(machine) is None:
            yield Rung("rounding", "nearest", "none", lambda _: self._rounded())

    def warm_up(self) -> None:
        """Compile what is compiled once; the widest gap ends every search at once."""
        self._service(1.0, self.request.accuracy.time_limit_s)(LADDER_S)

    def _service(self, gap: float, limit_s: float) -> Callable[[float], Candidate | Nothing]:
        def run(left_s: float) -> Candidate | Nothing:
            limit = min(limit_s, max(left_s, _SHORTEST_S))
            return self._optimum(replace(self.task, relative_gap=gap, time_limit_s=limit))

        return run

    def _optimum(self, task: Task) -> Candidate | Nothing:
        answer = solve(task, self.scene, in_full=False)
        if isinstance(answer, Infeasible):
            return Nothing(_UNREACHABLE if answer.status == "infeasible" else answer.reason)
        mass, proof = answer.mass, answer.certificate
        return Candidate(
            mass, proof.objective, proof.lower_bound, self._keeps_limits(mass, answer.unbalance), answer.status
        )

    def _rounded(self) -> Candidate | Nothing:
        """The optimum of any masses, of a group the mean, each on what is nearest of its web."""
        free = solve(self.free, self.scene, in_full=False)
        if isinstance(free, Infeasible):
            return Nothing(free.reason)
        mass, angle = _nearest(self.task, free.unbalance)
        u = unbalance(mass, angle, _radius(self.request.machine))
        value = self.judge.objective(u) * self.scene.omega_squared
        return Candidate(mass, value, None, self._keeps_limits(mass, u), None)

    def _keeps_limits(self, mass: Real, u: Complex) -> bool:
        """Whether masses (K + S,) kg of unbalances (K + S,) kg m keep ceilings, budget and numbers."""
        return bool(self.judge.excess(u) <= CEILING_TOLERANCE) and _counts(self.task, mass)

    def judged(self, rungs: Sequence[Rung]) -> Ladder:
        """What is known of all rows together, and each against it."""
        results = [rung.candidate for rung in rungs if rung.candidate is not None]
        rest = self.judge.at_rest * self.scene.omega_squared
        objective = min((entry.objective for entry in results if entry.feasible), default=np.nan)
        bound = max((entry.bound for entry in results if entry.bound is not None), default=-np.inf)
        if not bound <= objective + EQUAL * rest:
            _LOG.error("a lower bound is above the value of an answer: %.17g above %.17g", bound, objective)
            return Ladder(None, (), False)
        bound, any_mass = min(bound, objective), self._optimum(self.free)
        figures = [_figures(rung, bound, rest, self.task) for rung in rungs]
        reference = Reference(
            objective=objective,
            lower_bound=bound,
            objective_without_counterweights=rest,
            objective_of_any_mass=any_mass.objective if isinstance(any_mass, Candidate) else None,
            resolution=max((objective - bound) / rest, EQUAL),
        )
        candidates = [
            None if figure is None or not rung.feasible else (figure.time_ms, figure.relative_error)
            for rung, figure in zip(rungs, figures, strict=True)
        ]
        fastest = frontier(candidates, reference.resolution)
        rows = tuple(_row(*entry) for entry in zip(rungs, figures, fastest, strict=True))
        return Ladder(reference, rows, False)


def _free(machine: Machine) -> Machine:
    """The machine with any mass at any angle on every web; plates stay plates."""
    own = [(*web, field) for web in web_paths(machine) for field in (*CHOICES, "min_fitted_mass_kg")]
    nothing: dict[Path, Any] = dict.fromkeys([*own, ("catalogue",), ("max_counterweights",)])
    nothing |= {("web_groups",): ()}
    return with_fields(machine, nothing)


def _radius(machine: Machine) -> Real:
    """Of all webs (K + S,) m."""
    radius: Real = stacked([web.radius_m for web in machine.every_web])
    return radius


def _castings(task: Task) -> np.ndarray:
    """Webs whose pieces are counted (K + S,): those that take options, without any those of the crankshaft."""
    if task.choice == "discrete":
        return takes_options(task)
    return np.arange(len(task.space.machine.webs)) < len(task.machine.webs)


def _nearest(task: Task, u: Complex) -> tuple[Real, Real]:
    """Masses [kg] and angles [deg] (K + S,) nearest to unbalances (K + S,) kg m; beside castings of any mass."""
    machine = task.machine
    alike, own = alike_webs(machine), len(machine.webs)
    if alike is not None and not machine.discrete:
        u = np.append(alike.nearest(u[:own]), u[own:])
    mass, angle = np.abs(u) / _radius(machine), np.rad2deg(np.angle(u))
    least = stacked([web.min_fitted_mass_kg or 0.0 for web in machine.every_web])
    mass = np.where(mass < 0.5 * least, 0.0, np.maximum(mass, least))
    if machine.discrete:
        catalogue, castings = options_of(task), takes_options(task)
        units = catalogue.options.alike
        near = catalogue.options.nearest(u[castings] if units is None else units.means(u[castings]))
        mass[castings], angle[castings] = catalogue.fitted(near)
    return mass, np.where(mass > 0.0, np.mod(angle, 360.0), 0.0)


def _counts(task: Task, mass: Real) -> bool:
    """Whether masses (K + S,) keep the budget, and the numbers of castings and of sizes."""
    machine = task.machine
    budget, most = machine.max_total_mass_kg, machine.max_counterweights
    sizes = machine.catalogue.max_part_numbers if machine.catalogue is not None else None
    total, castings = float(np.sum(mass) + fixed_mass(machine)), mass[_castings(task)]
    return (
        (budget is None or total <= budget * (1.0 + _ROUNDING))
        and (most is None or int(np.sum(castings > 0)) <= most)
        and (sizes is None or part_numbers(castings) <= sizes)
    )


class _ChoiceFigures(NamedTuple):
    """What the answer tells of counterweights, by its names."""

    time_ms: float
    objective: float
    lower_bound: float | None
    relative_error: float
    certified_gap: float | None
    total_mass_kg: float
    pieces: int
    sizes: int


_NOTHING: Mapping[str, None] = dict.fromkeys(_ChoiceFigures._fields)


def _figures(rung: Rung, bound: float, rest: float, task: Task) -> _ChoiceFigures | None:
    candidate, time_ms = rung.candidate, median_ms(rung.times_s)
    if candidate is None or time_ms is None:
        return None
    castings = candidate.mass[_castings(task)]
    return _ChoiceFigures(
        time_ms,
        candidate.objective,
        candidate.bound,
        (candidate.objective - bound) / rest,
        None if candidate.bound is None else (candidate.objective - candidate.bound) / rest,
        float(np.sum(candidate.mass)) + float(fixed_mass(task.machine)),
        int(np.sum(castings > 0.0)),
        part_numbers(castings),
    )


def _row(rung: Rung, figures: _ChoiceFigures | None, on_frontier: bool) -> ChoiceRow:
    return ChoiceRow(
        method=rung.method,
        setting=rung.setting,
        status=None if rung.candidate is None else rung.candidate.status,
        limits_kept=rung.feasible,
        on_frontier=on_frontier,
        runs=0 if rung.candidate is None else len(rung.times_s),
        skipped=rung.skipped,
        **(_NOTHING if figures is None else figures._asdict()),
    )
