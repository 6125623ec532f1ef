"""Gap, kilograms and pieces against seconds: the service beside SCIP, HiGHS and rounding, for docs/accuracy.md.

``python -m tests.benchmarks.choices_ladder [catalogue] [lattice]`` prints a table for each, in minutes of one core.
"""

import sys
import time
from collections.abc import Callable, Iterator
from typing import Any, NamedTuple

import numpy as np

from optimizer.choices.catalogue_options import part_numbers, stock
from optimizer.studies.accuracy.measure import accuracy
from schemas.request.accuracy import AccuracyAnswer, AccuracyRequest
from service.report.chapters.accuracy import method_name
from tests.benchmarks.discrete import choice
from tests.choices.any_mass import of_any_mass
from tests.choices.highs import highs
from tests.choices.scip import Chosen, scip

#: s; SCIP and HiGHS begin anew with each
RIVAL_LIMITS_S = (1.0, 10.0)
#: asked of rivals, of the yardstick
_GAP = 1e-6
#: runs until a rival had nearly its time, and by how much longer the next may be
_TRIES, _NEARLY, _LONGEST = 3, 0.8, 20.0
_RIVALS: dict[str, Callable[..., Chosen]] = {"SCIP, circles": scip, "HiGHS, polygons": highs}
HEAD = "| method | setting | time, s | objective | error | certified gap | kg | pieces |"
_RULE = "|---|---|--:|--:|--:|--:|--:|--:|"


def four_throws() -> dict[str, Any]:
    """A machine of four opposed throws whose counterweights are cast in steps of 0.5 kg and set in steps of 5 degrees.

    Source: the compressor of issue 30; the continuous optimum is 85.7 kg on two webs, at 40,549 N.
    """
    rows = zip((-1.35, -0.45, 0.45, 1.35), (420, 395, 410, 388), (0, 180, 0, 180), (0, 180, 90, 270), strict=True)
    throws, webs = [], []
    for n, (z, mass, axis, crank) in enumerate(rows):
        throws.append(
            {"position_m": z, "crank_radius_m": 0.1, "crank_angle_deg": crank, "rotating_mass_kg": 60,
             "rows": [{"axis_deg": axis, "reciprocating_mass_kg": mass}]}
        )  # fmt: skip
        webs += [
            {"name": f"{n + 1}{side}", "throw": n, "position_m": z + off, "counterweight_radius_m": 0.26,
             "max_mass_kg": 90, "sector": {"centre_deg": (crank + 180) % 360, "half_angle_deg": 60}}
            for side, off in (("a", -0.15), ("b", 0.15))
        ]  # fmt: skip
    machine = {"kind": "reciprocating", "speed_rpm": 600, "throws": throws, "webs": webs}
    steps = {"mass_step_kg": 0.5, "angle_step_deg": 5}
    return {"machine": machine | {"catalogue": steps}, "objective": {"moment_weight": 1 / 3}}


#: a request, and whether the others are tried on it as well
CASES = {"catalogue": choice(8, 12), "lattice": four_throws()}


class Row(NamedTuple):
    """Cells of a table."""

    method: str
    setting: str
    seconds: float | None
    objective: float | None
    bound: float | None
    mass_kg: float | None
    pieces: int | None


def ours(answer: AccuracyAnswer) -> Iterator[Row]:
    """What the ladder of the service has."""
    for row in answer.choices_ladder:
        if row.skipped is None:
            seconds = None if row.time_ms is None else row.time_ms / 1e3
            figures = (row.objective, row.lower_bound, row.total_mass_kg, row.pieces)
            yield Row(method_name(row.method), row.setting, seconds, *figures)


def theirs(request: AccuracyRequest) -> Iterator[Row]:
    """What others find in the time, on the same options."""
    relaxed, size = of_any_mass(request)
    square = float(relaxed.certificate["yardstick"][0]) / size
    program, held = relaxed.program.subset(0), stock(request.machine)
    for name, rival in _RIVALS.items():
        for limit in RIVAL_LIMITS_S:
            answers, seconds = _timed(
                lambda wall, function=rival: function(program, held.options, _GAP, size, wall), limit, _GAP * size
            )
            bound = answers.lower_bound * square if np.isfinite(answers.lower_bound) else None
            if answers.selection is None:
                yield Row(name, f"{limit:g} s", seconds, None, bound, None, None)
                continue
            mass, _ = held.fitted(answers.selection)
            pieces = int(np.sum(mass > 0.0))
            assert part_numbers(mass) <= pieces
            objective = float(program.objective(held.options.carried(answers.selection))) * square
            yield Row(name, f"{limit:g} s", seconds, objective, bound, float(np.sum(mass)), pieces)
            if bound is not None and objective - bound <= _GAP * size * square:
                break


def _timed(run: Callable[[float], Chosen], limit_s: float, near: float) -> tuple[Chosen, float]:
    """What a rival finds in so many seconds of the processor; HiGHS counts those of the wall, which may be more."""
    wall = limit_s
    for _ in range(_TRIES):
        start = time.process_time()
        outcome = run(wall)
        seconds = time.process_time() - start
        if seconds >= _NEARLY * limit_s or (outcome.selection is not None and outcome.lower_bound >= outcome.objective):
            break
        wall *= min(limit_s / seconds, _LONGEST)
    return outcome, seconds


def table(name: str) -> str:
    """The table of a case."""
    request = AccuracyRequest.model_validate({**CASES[name], "accuracy": {"time_limit_s": 10}, "repeats": 3})
    answer = accuracy(request)
    reference = answer.reference
    assert reference is not None
    rows = [*ours(answer), *theirs(request)]
    # of all bounds the best, whoever proves it; those of others hold to their tolerances
    rest, best = reference.objective_without_counterweights, reference.lower_bound
    lines = [HEAD, _RULE]
    for row in rows:
        error = None if row.objective is None else (row.objective - best) / rest
        gap = None if row.objective is None or row.bound is None else (row.objective - row.bound) / rest
        cells = (
            row.method,
            row.setting,
            _figure(row.seconds, "{:.2f}"),
            _figure(row.objective, "{:.0f}"),
            _figure(error, "{:.1e}"),
            _figure(gap, "{:.1e}"),
            _figure(row.mass_kg, "{:.1f}"),
            _figure(row.pieces, "{}"),
        )
        lines.append(f"| {' | '.join(cells)} |")
    return "\n".join(lines)


def _figure(figure: float | None, form: str) -> str:
    return "-" if figure is None else form.format(figure)


def main() -> None:
    """Measure and print."""
    for name in sys.argv[1:] or CASES:
        print(f"{name}\n{table(name)}\n", flush=True)


if __name__ == "__main__":
    main()
