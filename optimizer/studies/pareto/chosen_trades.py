"""The front of any two or three responses of counterweights that are chosen from a catalogue, or heavy enough.

Such sets are not convex, and no line from an anchor meets their front. A point is the optimum of the largest of the
responses, each as a share of an anchor, with the mass under a budget where it is traded as well (weighted Chebyshev,
Steuer and Choo 1983; epsilon constraint, Haimes, Lasdon and Wismer 1971). A bound t_low of that search proves that no
choice within the budget is below t_low times the anchor in every other response. The anchors are evenly apart on the
chord, or in the triangle, between the ends.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from time import thread_time

import numpy as np

from optimizer.formulation.formulate import weighing
from optimizer.formulation.formulate import weights as own_weights
from optimizer.formulation.simulation import Prepared
from optimizer.formulation.task import Task
from optimizer.mechanics.fixed_weights import fixed_masses
from optimizer.numerics.arrays import Complex, Real
from optimizer.program.reference.solver import Solver
from optimizer.program.solution import OPTIMUM_SHARE
from optimizer.solve.solution import Infeasible, finite_or_null
from optimizer.solve.solve import solve
from optimizer.solve.whole_turn import whole_turn_of
from optimizer.studies.pareto.measures import Measures, measures, sizes, unit_of
from optimizer.studies.pareto.points import ChosenPoint
from schemas.base.variation import with_fields
from schemas.front.trade import Traded, TradedCertificate, TradedFront, TradedPoint, TradedResponse
from schemas.request.objective import Objective

#: of the time limit that of the ends
_ENDS = 0.4
#: an anchor is no smaller than this share of what gaps are relative to
_NARROW = 1e-6
#: budgets that are tried for the lightest that keep the ceilings
_BUDGETS = 24
_LEAST_GAP, _LEAST_TIME = 1e-12, 1e-3
#: fields of the weights of what is traded inside the shaft
_INSIDE: Mapping[Traded, str] = {"bearings": "bearing_weight", "bending": "bending_weight"}


def chosen_trades(
    task: Task, names: tuple[Traded, ...], points: Sequence[Real], scene: Prepared, solver: Solver
) -> TradedFront:
    """The front of the responses that are named; all its searches together end at the time task.

    Parameters
    ----------
    task : weighs them all, under one limit of the total mass.
    points : (D,) shares of the ends, for each point that is asked for.
    """
    search = _Search(task, names, scene, solver)
    ends = search.ends()
    if isinstance(ends, Infeasible):
        return TradedFront(
            max_total_mass_kg=task.machine.max_total_mass_kg,
            status="infeasible",
            responses=(),
            points=(),
            infeasibility=ends.infeasibility,
        )
    at, bound, size = ends
    results = [search.point(share @ at, size, (len(points) - n)) for n, share in enumerate(points)]
    decided = all(isinstance(result, ChosenPoint) or _none_proven(result) for result in results)
    kept = _best([result for result in results if isinstance(result, ChosenPoint)])
    told = [search.traded_point(each, size) for each in kept]
    close = np.all(np.diag(at) - bound <= max(task.relative_gap, OPTIMUM_SHARE) * size)
    exact = decided and close and all(point.status == "optimal" for point in told)
    rest = search.values(search.nothing)
    return TradedFront(
        max_total_mass_kg=task.machine.max_total_mass_kg,
        status="optimal" if exact else "inaccurate",
        reason="reached_together" if len(told) == 1 else None,
        responses=tuple(
            TradedResponse(
                response=name,
                unit=unit_of(name, task.objective),
                without_counterweights=float(rest[i]),
                smallest=float(at[i, i]),
                lower_bound=float(bound[i]),
                yardstick=float(size[i]),
            )
            for i, name in enumerate(names)
        ),
        points=tuple(told),
    )


class _Search:
    """What the searches of one front share; all figures are in the units of the answer."""

    def __init__(self, task: Task, names: tuple[Traded, ...], scene: Prepared, solver: Solver) -> None:
        self.task, self.names, self.scene, self.solver = task, names, scene, solver
        turn = whole_turn_of(scene, task.objective) if task.objective.of_the_revolution else None
        self.traded: Measures = measures(task, names, scene, turn)
        self.square = np.array([1.0 if name == "mass" else scene.omega_squared for name in names])
        self.fixed = float(np.sum(fixed_masses(task.machine)))
        self.nothing = np.zeros(len(task.machine.webs), complex)
        self.gap, self.seconds = task.relative_gap, task.time_limit_s
        self.until = thread_time() + self.seconds

    def values(self, u: Complex) -> Real:
        """What unbalances (K,) come to (D,)."""
        result = self.traded.values(u) * self.square
        return np.where(self._mass, result + self.fixed, result)

    def ends(self) -> tuple[Real, Real, Real] | Infeasible:
        """Values where each counts first (D, D), what is proven of each by itself (D,), and yardsticks (D,)."""
        at, bound, gross = [], [], np.zeros(len(self.names))
        seconds = _ENDS * self.seconds / len(self.names)
        alone: dict[int, ChosenPoint] = {}
        for i, name in enumerate(self.names):
            if name == "mass":
                continue
            result = self._optimum({name: 1.0}, self.task.machine.max_total_mass_kg, self.gap, seconds)
            if isinstance(result, Infeasible):
                return result
            alone[i] = result
            gross = np.maximum(gross, self.traded.gross(result.solution.unbalance) * self.square)
        size = sizes(self.traded.at_rest * self.square, gross)
        for i, name in enumerate(self.names):
            if name == "mass":
                light, least = self._lightest(list(alone.values()), float(size[i]), seconds)
                at.append(light)
                bound.append(least)
            else:
                at.append(alone[i].values)
                bound.append(float(alone[i].corner[i]))
        return np.array(at), np.nan_to_num(np.array(bound), nan=0.0), size

    def point(self, anchor: Real, size: Real, left: int) -> ChosenPoint | Infeasible:
        """The best choice as shares of an anchor (D,), with no more mass than that where it is traded.

        Parameters
        ----------
        left : points that are still to be found, which share what is left of the time.
        """
        budget = self.task.machine.max_total_mass_kg
        if np.any(self._mass):
            # what is as heavy to rounding counts
            budget = float(anchor[self._mass][0]) * (1.0 + 1e-12)
        anchor = np.maximum(anchor, _NARROW * size)
        weights = {name: 1.0 / float(a) for name, a in zip(self.names, anchor, strict=True) if name != "mass"}
        # gaps are relative to the largest share without counterweights, and are asked for of every response
        some = ~self._mass
        yardstick = float(np.max((self.values(self.nothing) / anchor)[some])) or 1.0
        gap = self.gap * float(np.min((size / anchor)[some])) / yardstick
        result = self._optimum(weights, budget, gap, max(self.until - thread_time(), 0.0) / left)
        if isinstance(result, Infeasible):
            return result
        bound = result.solution.certificate.lower_bound
        lowest = np.nan if bound is None else bound
        return replace(result, corner=np.where(self._mass, np.nan if budget is None else budget, lowest * anchor))

    def traded_point(self, chosen: ChosenPoint, size: Real) -> TradedPoint:
        """A point with its proof."""
        best = chosen.solution
        proof, after = best.certificate, self.scene.first_order(best.shown.on_crank)
        gap = float(np.max((chosen.values - chosen.corner) / size))
        proven = bool(np.isfinite(gap))
        exact = proven and best.status == "optimal" and gap <= self.gap
        return TradedPoint(
            status="optimal" if exact else "inaccurate",
            status_reason=best.reason,
            values=tuple(chosen.values.tolist()),
            force_peak_N=float(after.force.peak),
            moment_peak_Nm=float(after.moment.peak),
            total_mass_kg=best.shown.total_mass_kg,
            counterweights=best.shown.counterweights,
            certificate=TradedCertificate(
                corner=tuple(finite_or_null(value) if proven else None for value in chosen.corner),
                relative_gap=max(gap, 0.0) if proven else None,
                mass_lower_bound_kg=None,
                mass_relative_gap=None,
                cuts=proof.cuts or 0,
                rounds=proof.rounds or 0,
                method=proof.method,
            ),
        )

    @property
    def _mass(self) -> np.ndarray:
        """Which response is the mass (D,)."""
        return np.array([name == "mass" for name in self.names])

    def _lightest(self, choices: Sequence[ChosenPoint], size: float, seconds: float) -> tuple[Real, float]:
        """What the lightest that keep the ceilings come to (D,), and the mass that is proven to be needed."""
        if self.traded.excess(self.nothing) <= 0.0:
            return self.values(self.nothing), self.fixed
        place = int(np.flatnonzero(self._mass)[0])
        best, least = min(choices, key=lambda choice: float(choice.values[place])), self.fixed
        first = next(name for name in self.names if name != "mass")
        until = thread_time() + seconds
        for _ in range(_BUDGETS):
            most = float(best.values[place])
            if most - least <= self.gap * size or thread_time() >= until:
                break
            middle = 0.5 * (least + most)
            result = self._optimum({first: 1.0}, middle, 1.0, until - thread_time())
            if isinstance(result, ChosenPoint):
                best = result
            elif _none_proven(result):
                least = middle
            else:
                break
        return best.values, least

    def _optimum(
        self, weights: Mapping[Traded, float], budget: float | None, gap: float, seconds: float
    ) -> ChosenPoint | Infeasible:
        """The best choice for the largest of the responses times their weights."""
        # nothing checked: a budget below what is fixed leaves no counterweights
        machine, goal = with_fields(self.task.machine, {("max_total_mass_kg",): budget}), self._weighing(weights)
        limit = min(max(seconds, _LEAST_TIME), self.seconds)
        task = Task(machine, goal, self.task.fidelity, min(max(gap, _LEAST_GAP), 1.0), limit)
        best = solve(task, replace(self.scene, machine=machine, objective=goal), self.solver, in_full=False)
        if isinstance(best, Infeasible):
            return best
        values = np.where(self._mass, best.shown.total_mass_kg, self.values(best.unbalance))
        bound = best.certificate.lower_bound
        corner = np.array(
            [np.nan if bound is None else bound / weights[name] if name in weights else 0.0 for name in self.names]
        )
        return ChosenPoint(best, values, corner)

    def _weighing(self, weights: Mapping[Traded, float]) -> Objective:
        """The largest of the responses times their weights; the objective itself times its own."""
        objective = self.task.objective
        if "objective" in weights:
            own = own_weights(self.task.machine, objective)
            more = {name: float(each) * weights["objective"] for name, each in own.items()}
            return weighing(objective, more)
        inside = {field: weights.get(name, 0.0) for name, field in _INSIDE.items()}
        return weighing(objective, weights, combine="max", **inside)


def _none_proven(none: Infeasible) -> bool:
    """Whether there is nothing to show, and not only nothing that a search has come upon."""
    return none.status == "infeasible"


def _best(choices: Sequence[ChosenPoint]) -> list[ChosenPoint]:
    """Those that no other equals or beats in every response, of two responses in the order of the rising first."""
    front: list[ChosenPoint] = []
    for n, choice in enumerate(choices):
        others = [rival.values for k, rival in enumerate(choices) if k != n]
        beaten = any(np.all(values <= choice.values) and np.any(values < choice.values) for values in others)
        # of several that are the same, the one of which most is proven
        same = [rival for rival in choices if np.all(rival.values == choice.values)]
        sharpest = max(
            same, key=lambda rival: float(np.nan_to_num(np.min(rival.corner / np.maximum(rival.values, 1e-300))))
        )
        if not beaten and choice is sharpest:
            front.append(choice)
    return (
        sorted(front, key=lambda point: tuple(point.values.tolist())) if front and front[0].values.size == 2 else front
    )
