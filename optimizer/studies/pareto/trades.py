"""The front of any two or three responses: its ends, and points between them, each with its proof.

Points are looked for from anchors that are evenly apart on the chord, or in the triangle, between the ends
(normal-boundary intersection, Das and Dennis 1998): of any masses on lines, of choices as shares of the anchors.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from optimizer.errors import MissingInput
from optimizer.formulation.simulation import Prepared
from optimizer.formulation.task import Task
from optimizer.numerics.arrays import Real
from optimizer.outputs.requirements import missing
from optimizer.program.solution import OPTIMUM_SHARE
from optimizer.solve.solution import Infeasible, Solution
from optimizer.solve.uncertain_program import Robust
from optimizer.studies.pareto.choice_trades import ChoiceTrades
from optimizer.studies.pareto.lines import Lines
from optimizer.studies.pareto.measures import alone, unit_of
from optimizer.studies.pareto.points import TradeEnds
from schemas.front.pareto import ParetoRequest
from schemas.front.trade import TradedFront, TradedNames, TradedPoint, TradedResponse
from schemas.machine.machine import Machine


def needed(request: ParetoRequest, names: TradedNames, machine: Machine) -> Task:
    """One objective of all that is traded, under one limit of the total mass.

    Raises
    ------
    MissingInput
        if the machine lacks what a response needs.
    """
    task = replace(Task.of(request), machine=machine, objective=alone(request.objective, names))
    lacking = list(missing(task.machine, task.objective))
    if lacking:
        raise MissingInput(lacking)
    return task


def traded_front(request: ParetoRequest, names: TradedNames, machine: Machine, scene: Prepared) -> TradedFront:
    """The front of some responses, for one limit of the total mass; searches of choices end at the time asked."""
    task = needed(request, names, machine)
    # what is traded counts, whatever the objective weighs
    scene = replace(scene, machine=machine, objective=task.objective)
    places = _places(len(names), request.points)
    ends, points, decided = (
        _choice_course(task, names, scene, places)
        if request.is_nonconvex
        else _continuous_course(task, names, scene, places)
    )
    if not isinstance(ends, TradeEnds):
        return TradedFront(
            max_total_mass_kg=machine.max_total_mass_kg,
            status="infeasible",
            responses=(),
            points=(),
            infeasibility=ends.infeasibility if isinstance(ends, Infeasible) else None,
        )
    close = np.all(ends.smallest - ends.lower_bound <= max(task.relative_gap, OPTIMUM_SHARE) * ends.size)
    exact = decided and close and all(point.status == "optimal" for point in points)
    figures = (ends.at_rest, ends.smallest, ends.lower_bound)
    rest, smallest, bound = (figure * ends.square + ends.there for figure in figures)
    size = ends.size * ends.square
    return TradedFront(
        max_total_mass_kg=machine.max_total_mass_kg,
        status="optimal" if exact else "inaccurate",
        reason="reached_together" if len(points) == 1 else None,
        responses=tuple(
            TradedResponse(
                response=name,
                unit=unit_of(name, task.objective),
                without_counterweights=float(rest[i]),
                smallest=float(smallest[i]),
                lower_bound=float(bound[i]),
                yardstick=float(size[i]),
            )
            for i, name in enumerate(names)
        ),
        points=tuple(points),
    )


class _Course(NamedTuple):
    """Ends, and points between them; whether each was decided."""

    ends: TradeEnds | Infeasible | Solution
    points: Sequence[TradedPoint] = ()
    decided: bool = False


def _choice_course(task: Task, names: TradedNames, scene: Prepared, places: Real) -> _Course:
    search = ChoiceTrades(task, names, scene)
    ends = search.ends()
    return _Course(ends, *search.points(places, ends)) if isinstance(ends, TradeEnds) else _Course(ends)


def _continuous_course(task: Task, names: TradedNames, scene: Prepared, places: Real) -> _Course:
    """With all changes of masses that matter at any end or point; there are finitely many."""
    robust = Robust(task, scene, task.demand)
    while True:
        lines = Lines(robust, names)
        ends = lines.ends()
        course = _Course(ends, *lines.points(places, ends)) if isinstance(ends, TradeEnds) else _Course(ends)
        if not course.points or not lines.learnt:
            return course


def _places(count: int, points: int) -> Real:
    """Shares of the ends (n, D), evenly apart: as many as asked for, of three as make a whole triangle."""
    if count == 2:
        share = np.linspace(0.0, 1.0, points)
        return np.stack([1.0 - share, share], axis=-1)
    side = 1
    while (side + 2) * (side + 3) // 2 <= points:
        side += 1
    results = [(i, j, side - i - j) for i in range(side, -1, -1) for j in range(side - i, -1, -1)]
    return np.array(results) / side
