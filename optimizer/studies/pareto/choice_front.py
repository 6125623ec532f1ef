"""The front of peak force and peak moment of counterweights that are chosen: from a catalogue, heavy enough where they
are fitted, or cut from plates.

Such sets are not convex, and their front is no curve. Between two of its points lies a box: what neither of them beats
has less force than the one and less moment than the other. The optimum of the larger of both peaks, each as a share of
its edge of the box, is a point inside, or proves that there is none (weighted Chebyshev, Steuer and Choo 1983). Its
bound t proves that nothing is below the corner t times the edges. The largest box is searched next.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from optimizer.formulation.simulation import Prepared
from optimizer.numerics.arrays import Real
from optimizer.solve.answer_fields import touched_ceilings
from optimizer.solve.prices import touched_by_mass
from optimizer.solve.solution import Infeasible, Solution
from optimizer.solve.worst_case import worst_peaks
from optimizer.studies.pareto.choice_search import ChoicePoint, ChoiceSearch
from optimizer.studies.pareto.measures import sizes
from optimizer.studies.pareto.points import knee, undominated
from optimizer.studies.pareto.trades import needed
from schemas.answer.limits import MachineLimit
from schemas.base.responses import PAIR
from schemas.front.pareto import CornerCertificate, Ends, ParetoFront, ParetoPoint, ParetoRequest, Reason, Scale
from schemas.front.trade import Traded
from schemas.machine.machine import Machine

#: share of the time limit that either end has
_END = 0.2
#: share of the gap by which the peak that counts first may be above its smallest value at an end
_SLACK = 0.1
#: searches for each point that is asked for, at most
_SEARCHES = 4
#: an optimum no nearer to its box than this leaves it empty
_INSIDE = 1e-12
#: width of the brackets by which what is touched is told, as a share of ceilings
_CLOSE = 1e-10
#: of an optimum whose own yardstick is larger than the scale of the front
_WIDE = "The gap to the bound is wider than requested, relative to the scale of the front."


class _Box(NamedTuple):
    """What neither of two neighbours beats: force below that of ``right``, moment below that of ``left``."""

    left: ChoicePoint
    right: ChoicePoint

    @property
    def edges(self) -> Real:
        """(2,) force and moment that a point inside stays below."""
        return np.array([self.right.values[0], self.left.values[1]])

    @property
    def size(self) -> Real:
        """(2,) widths in force and moment."""
        return np.array([self.right.values[0] - self.left.values[0], self.left.values[1] - self.right.values[1]])


def choice_front(request: ParetoRequest, machine: Machine, scene: Prepared) -> ParetoFront:
    """The front of what can be chosen; all its searches together end at the time asked.

    Parameters
    ----------
    machine : that of the request under one limit of the total mass.
    """
    task = needed(request, PAIR, machine)
    scene = replace(scene, machine=machine, objective=task.objective)
    return _Boxes(task, PAIR, scene).front(request.points)


class _Boxes(ChoiceSearch):
    """The search of one front."""

    def front(self, count: int) -> ParetoFront:
        """Both ends, and what lies between them, of so many points at most."""
        machine, seconds = self.task.machine, _END * self.seconds
        # an end may exceed the smallest peak by the slack besides, and by what a ceiling may be exceeded by
        near = (1.0 - 2.0 * _SLACK) * self.gap
        force = self.optimum({PAIR[0]: 1.0}, near, seconds)
        moment = force if isinstance(force, Infeasible) else self.optimum({PAIR[1]: 1.0}, near, seconds)
        if isinstance(force, Infeasible) or isinstance(moment, Infeasible):
            return ParetoFront(
                max_total_mass_kg=machine.max_total_mass_kg,
                status="infeasible",
                points=(),
                infeasibility=moment.infeasibility if isinstance(moment, Infeasible) else None,
            )
        size = sizes(self.at_rest, np.maximum(self.gross(force), self.gross(moment)), self.square)
        bounds = force.corner[0], moment.corner[1]
        optima, reason = self._between(self._corner(force, 0, size), self._corner(moment, 1, size), size, count)
        first, last, points = (
            optima[0].values,
            optima[-1].values,
            tuple(self._point(optimum, size) for optimum in optima),
        )
        open_ends = max((first[0] - bounds[0]) / size[0], (last[1] - bounds[1]) / size[1]) > self.gap
        certified = not open_ends and all(point.status == "optimal" for point in points)
        return ParetoFront(
            max_total_mass_kg=machine.max_total_mass_kg,
            status="optimal" if certified else "inaccurate",
            points=points,
            reason=reason,
            knee=knee(points),
            ends=Ends(
                smallest_force_N=float(first[0]),
                smallest_force_lower_bound_N=float(bounds[0]),
                moment_at_smallest_force_Nm=float(first[1]),
                smallest_moment_Nm=float(last[1]),
                smallest_moment_lower_bound_Nm=float(bounds[1]),
                force_at_smallest_moment_N=float(last[0]),
            ),
            scale=Scale(force_N=float(size[0]), moment_Nm=float(size[1])),
        )

    def _corner(self, end: ChoicePoint, axis: int, size: Real) -> ChoicePoint:
        """Of all whose peak ``axis`` is the smallest, but for a share of the gap, the least of the other peak."""
        if end.values[1 - axis] == 0.0:
            return end
        objective, field = self.task.objective, ("force_ceiling_N", "moment_ceiling_Nm")[axis]
        across = objective.direction_weights
        backwards = any(response.counter_influence is not None for response in self.scene.responses)
        weighed = any(scenario.weight != 1.0 for scenario in self.task.scenarios)
        if (across.x, across.y) != (1.0, 1.0) or weighed or backwards or self.robust.scatter.share:
            # a ceiling is of a whole vector, of all scenarios alike, and of one length of it, which scatters with no
            # choice
            return self._steep_corner(end, axis, size)
        most = float(end.values[axis] + _SLACK * self.gap * size[axis])
        limit = getattr(objective, field)
        if limit is not None and limit <= most:
            return end
        corner = self.optimum({PAIR[1 - axis]: 1.0}, self.gap, _END * self.seconds, ceilings={field: most})
        if isinstance(corner, Infeasible) or corner.values[1 - axis] > end.values[1 - axis]:
            return end
        # what exceeds the ceiling by no more than this optimum has no less of the other peak
        proven = np.where(np.arange(2) == axis, max(most, float(corner.values[axis])), corner.corner)
        return replace(corner, corner=proven)

    def _steep_corner(self, end: ChoicePoint, axis: int, size: Real) -> ChoicePoint:
        """The same by the sum of both peaks, in which the one of ``axis`` is so dear that all of the other is worth no
        more than the share of the gap."""
        other = 1 - axis
        price = float(end.values[other] / (_SLACK * self.gap * size[axis]))
        worth = price * self.at_rest[axis] + self.at_rest[other]
        gap = float(self.gap * size[other] / worth) if worth > 0.0 else self.gap
        weights: dict[Traded, float] = {PAIR[axis]: price, PAIR[other]: 1.0}
        corner = self.optimum(weights, gap, _END * self.seconds, combine="sum")
        if isinstance(corner, Infeasible) or not corner.values[other] < end.values[other]:
            return end
        bound, value = corner.solution.certificate.lower_bound, float(corner.values[axis])
        # a little more than its share, for the gap of the sum
        most = float(end.values[axis] + 1.5 * _SLACK * self.gap * size[axis])
        if value > most:
            # the boxes show it
            return end
        if bound is not None and corner.solution.status == "optimal":
            # of what has less of the peak that is dear the other is no less than this
            least = bound - price * value
            if corner.values[other] - least <= self.gap * size[other]:
                return replace(corner, corner=np.where(np.arange(2) == axis, value, least))
        # both peaks may be of two scenarios, where a sum is of one, or time has ended the search: none has less of the
        # first, which is proven as it is of the end
        solution = replace(corner.solution, status=end.solution.status, reason=end.solution.reason)
        return replace(corner, solution=solution, corner=np.where(np.arange(2) == axis, end.corner, corner.values))

    def _between(
        self, force: ChoicePoint, moment: ChoicePoint, size: Real, points: int
    ) -> tuple[list[ChoicePoint], Reason | None]:
        """Points in the order of rising force, and why there are no more of them."""
        optima, boxes = _undominated([force, moment]), [_Box(force, moment)]
        if len(optima) == 1:
            return optima, "reached_together"
        undecided = False
        for _ in range(_SEARCHES * points):
            boxes = [candidate for candidate in boxes if np.all(candidate.size > self.gap * size)]
            left_s = self.left_s
            if not boxes or len(optima) >= points or left_s <= 0.0:
                break
            box = boxes.pop(int(np.argmax([np.prod(candidate.size / size) for candidate in boxes])))
            inside = self.first_along(box.edges, size, left_s / (points - len(optima)))
            if isinstance(inside, ChoicePoint) and np.all(inside.values < box.edges * (1.0 - _INSIDE)):
                optima = _undominated([*optima, inside])
                boxes += [_Box(box.left, inside), _Box(inside, box.right)]
            else:
                # nothing better is found; whether there is nothing tells the proof
                undecided |= isinstance(inside, Infeasible) or not bool(
                    np.all(inside.corner >= box.edges - self.gap * size)
                )
        if len(optima) >= points:
            return optima, None
        return optima, "time" if boxes or undecided else "complete"

    def _point(self, optimum: ChoicePoint, size: Real) -> ParetoPoint:
        best, proven = optimum.solution, bool(np.all(np.isfinite(optimum.corner)))
        placement = best.placement
        plain = self.scene.beside(placement.on_shafts).first_order(placement.on_crank)
        # of the peak that the optimum leaves room in nothing is claimed
        gap = float(np.max((optimum.values - optimum.corner) / size))
        wide = best.status == "optimal" and gap > self.gap
        return ParetoPoint(
            status="optimal" if best.status == "optimal" and not wide else "inaccurate",
            status_reason=_WIDE if wide else best.reason,
            force_peak_N=float(plain.force.peak),
            moment_peak_Nm=float(plain.moment.peak),
            weighted_force_peak_N=float(optimum.values[0]),
            weighted_moment_peak_Nm=float(optimum.values[1]),
            worst_case=worst_peaks(self.robust, best.unbalance) if self.task.uncertain else None,
            **placement.fields,
            # of the request: a search has ceilings of its own
            active_limits=self._touched(best),
            certificate=CornerCertificate(
                force_N=float(optimum.corner[0]) if proven else None,
                moment_Nm=float(optimum.corner[1]) if proven else None,
                relative_gap=max(gap, 0.0) if proven else None,
                yardstick=Scale(force_N=float(size[0]), moment_Nm=float(size[1])),
                mass_lower_bound_kg=None,
                mass_relative_gap=None,
                mass_yardstick_kg=None,
                mass_force_limit_N=None,
                mass_moment_limit_Nm=None,
                implied_max_mass_kg=best.certificate.implied_max_mass_kg,
                method=best.certificate.method,
            ),
        )

    def _touched(self, best: Solution) -> tuple[MachineLimit, ...]:
        """Limits of the machine, and ceilings in the worst case."""
        goals = self.robust.goals()
        goals = replace(goals, program=goals.anywhere)
        values = goals.program.values(best.unbalance, _CLOSE)
        masses = np.array([counterweight.mass_kg for counterweight in best.placement.counterweights])
        ceilings = touched_ceilings(self.task, goals, values)
        return tuple(dict.fromkeys((*touched_by_mass(self.task.machine, masses), *ceilings)))


def _undominated(optima: Sequence[ChoicePoint]) -> list[ChoicePoint]:
    return undominated(optima, lambda optimum: (float(optimum.values[0]), float(optimum.values[1])))
