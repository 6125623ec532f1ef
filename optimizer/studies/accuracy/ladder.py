"""Times and true errors of methods on one program.

First every method runs at every position of its grid: that gives errors and set-up times. Then come rounds,
in which each method runs once, at the position of its largest error, so that a slow moment of the machine
meets them all.
"""

import statistics
import time
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple, TypeVar

from optimizer.numerics.records import record
from optimizer.program.ceilings import CEILING_TOLERANCE
from optimizer.studies.accuracy.methods import LadderProgram, Method, MethodResult, Run

Answer = TypeVar("Answer")

#: what one method may hand to its solver; beyond it a single solve takes many seconds
MAX_ENTRIES = 600_000
#: one solve of a method that knows a limit of time, s
SOLVE_S = 5.0
#: all timed rounds of one method, s; its median is then over fewer runs
ROUNDS_S = 3.0
#: the whole ladder, s; what has not begun by then is skipped
LADDER_S = 60.0


@record(frozen=True)
class Judged:
    """One run, evaluated by the judge of all; in units of the objective."""

    position: float
    objective: float
    excess: float
    claimed: float | None
    bound: float
    goals: tuple[float, ...]  # before the last


@dataclass
class Trial:
    """A method and what has been seen of it."""

    method: Method
    run: Run
    judged: list[Judged] = field(default_factory=list)
    first_s: float | None = None  # of the whole run, whatever it solves at once; likewise below
    times_s: list[float] = field(default_factory=list)
    skipped: str | None = None

    @property
    def worst(self) -> Judged:
        """The run with the largest objective; broken ceilings are worse than any objective."""
        return max(self.judged, key=lambda run: (run.excess > CEILING_TOLERANCE, run.objective))


@record(frozen=True)
class Clock:
    """When the work has to end."""

    end_s: float

    @classmethod
    def of(cls, seconds: float) -> "Clock":
        return cls(time.perf_counter() + seconds)

    @property
    def left_s(self) -> float:
        return self.end_s - time.perf_counter()


class FirstRun(NamedTuple):
    """A run before the ladder, which is the first of its method."""

    method: str
    setting: str
    result: MethodResult
    elapsed_s: float


def survey(
    task: LadderProgram, methods: Iterable[Method], clock: Clock, earlier: FirstRun | None = None
) -> list[Trial]:
    """Every method once at each position of its grid.

    Parameters
    ----------
    earlier : a run that is not repeated, of a method without a grid.
    """
    return [_run_before(task, method, earlier) or _trial(task, method, clock) for method in methods]


def _run_before(task: LadderProgram, method: Method, earlier: FirstRun | None) -> Trial | None:
    if earlier is None or (method.name, method.setting) != earlier[:2]:
        return None
    judged = [_judge(task, method.positions[0], earlier.result)]
    return Trial(method, method.prepare(), judged, earlier.elapsed_s)


def time_rounds(task: LadderProgram, trials: Sequence[Trial], repeats: int, clock: Clock) -> None:
    """Rounds in which every method that has an answer runs once."""
    for _ in range(repeats):
        for trial in trials:
            if trial.skipped or sum(trial.times_s) > ROUNDS_S or (clock.left_s <= 0 and trial.times_s):
                continue
            # the clock of the ladder ends rounds, not solves: each method is timed at least once
            start = time.perf_counter()
            outcome = trial.run(task, trial.worst.position, SOLVE_S)
            elapsed = time.perf_counter() - start
            if isinstance(outcome, MethodResult):
                trial.times_s.append(elapsed)


def _trial(task: LadderProgram, method: Method, clock: Clock) -> Trial:
    trial = Trial(method, method.prepare())
    entries = method.entries(task)
    if entries > MAX_ENTRIES:
        trial.skipped = f"too large: {entries} entries, at most {MAX_ENTRIES} are tried"
        return trial
    for position in method.positions:
        if clock.left_s <= 0:
            trial.skipped = f"the {LADDER_S:.0f} s of the whole ladder were used up"
            return trial
        start = time.perf_counter()
        outcome = trial.run(task, position, min(SOLVE_S, clock.left_s))
        elapsed = time.perf_counter() - start
        if isinstance(outcome, str):
            trial.skipped = outcome
            return trial
        trial.first_s = elapsed if trial.first_s is None else trial.first_s
        trial.judged.append(_judge(task, position, outcome))
    return trial


def _judge(task: LadderProgram, position: float, weights: MethodResult) -> Judged:
    return Judged(
        position,
        objective=task.objective(weights.unbalance),
        excess=task.judge.excess(weights.unbalance),
        claimed=weights.claimed,
        bound=weights.prove(),
        goals=task.judge.goals(weights.unbalance),
    )


def timed(ways: Sequence[Callable[[], Answer]], repeats: int) -> tuple[list[Answer], list[float], list[list[float]]]:
    """What each way comes to, time of its first run and of every later one [s]; the ways take turns.

    After the first round there are only as many as the time of one method allows.
    """
    results: list[Answer] = []
    first: list[float] = []
    times: list[list[float]] = [[] for _ in ways]
    for way in ways:
        start = time.perf_counter()
        results.append(way())
        first.append(time.perf_counter() - start)
    clock = Clock.of(ROUNDS_S)
    for rounds in range(repeats):
        if rounds and clock.left_s <= 0:
            break
        for series, way in zip(times, ways, strict=True):
            start = time.perf_counter()
            way()
            series.append(time.perf_counter() - start)
    return results, first, times


def median_ms(times_s: Sequence[float], programs: int = 1) -> float | None:
    """Median for one of the programs that a run solves."""
    return statistics.median(times_s) * 1e3 / programs if times_s else None


def frontier(points: Sequence[tuple[float, float] | None], resolution: float) -> list[bool]:
    """Which (time, error) no other point beats: none is as good in both and better in one.

    Parameters
    ----------
    points : None is no candidate.
    resolution : errors below it are the same.
    """
    pairs = [None if point is None else (point[0], max(point[1], resolution)) for point in points]
    candidates = [pair for pair in pairs if pair is not None]

    def beaten(point: tuple[float, float]) -> bool:
        return any(rival != point and rival[0] <= point[0] and rival[1] <= point[1] for rival in candidates)

    return [pair is not None and not beaten(pair) for pair in pairs]
