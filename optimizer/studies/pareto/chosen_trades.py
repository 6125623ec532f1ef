"""The front of any two or three responses of counterweights that are chosen from a catalogue, or heavy enough.

Such sets are not convex, and no line from an anchor meets their front. A point is the optimum of the largest of the
responses, each as a share of an anchor, with the mass under a budget where it is traded as well (weighted Chebyshev,
Steuer and Choo 1983; epsilon constraint, Haimes, Lasdon and Wismer 1971). A bound t_low of that search proves that no
choice within the budget is below t_low times the anchor in every other response. The anchors are evenly apart on the
chord, or in the triangle, between the ends.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from time import thread_time

import numpy as np

from optimizer.formulation.formulate import weighing
from optimizer.formulation.formulate import weights as own_weights
from optimizer.formulation.simulation import Prepared
from optimizer.mechanics.fixed_weights import fixed_masses
from optimizer.numerics.arrays import Complex, Real
from optimizer.optimize import optimize
from optimizer.program.solution import OPTIMUM_SHARE
from optimizer.solve.solution import finite_or_null
from optimizer.solve.whole_turn import whole_turn_of
from optimizer.studies.pareto.measures import Measures, measures, sizes, unit_of
from schemas.answer.answers import Certificate, OptimizeAnswer
from schemas.answer.infeasibility import Infeasibility
from schemas.front.trade import Traded, TradedCertificate, TradedFront, TradedPoint, TradedResponse
from schemas.request.objective import Objective
from schemas.request.requests import Accuracy, OptimizeRequest

#: of the time limit that of the ends
_ENDS = 0.4
#: an anchor is no smaller than this share of what gaps are relative to
_NARROW = 1e-6
#: budgets that are tried for the lightest that keep the ceilings
_BUDGETS = 24
_LEAST_GAP, _LEAST_TIME = 1e-12, 1e-3
#: fields of the weights of what is traded inside the shaft
_INSIDE: Mapping[Traded, str] = {"bearings": "bearing_weight", "bending": "bending_weight"}


@dataclass(frozen=True)
class _Chosen:
    """Counterweights, what they come to in every response (D,), and the corner that nothing is below (D,)."""

    answer: OptimizeAnswer
    values: Real
    corner: Real  # nan where nothing is proven


@dataclass(frozen=True)
class _Unkept:
    """A search without counterweights to show."""

    proven: bool  # that there are none
    why: Infeasibility | None


def chosen_trades(
    asked: OptimizeRequest, names: tuple[Traded, ...], points: Sequence[Real], scene: Prepared
) -> TradedFront:
    """The front of the responses that are named; all its searches together end at the time asked.

    Parameters
    ----------
    asked : the request that weighs them all, under one limit of the total mass.
    points : (D,) shares of the ends, for each point that is asked for.
    """
    search = _Search(asked, names, scene)
    ends = search.ends()
    if isinstance(ends, _Unkept):
        return TradedFront(
            max_total_mass_kg=asked.machine.max_total_mass_kg,
            status="infeasible",
            responses=(),
            points=(),
            infeasibility=ends.why,
        )
    at, bound, size = ends
    results = [search.point(share @ at, size, (len(points) - n)) for n, share in enumerate(points)]
    decided = all(not isinstance(each, _Unkept) or each.proven for each in results)
    kept = _best([each for each in results if isinstance(each, _Chosen)])
    told = [search.told(each, size) for each in kept]
    close = np.all(np.diag(at) - bound <= max(asked.accuracy.relative_gap, OPTIMUM_SHARE) * size)
    exact = decided and close and all(point.status == "optimal" for point in told)
    rest = search.values(search.nothing)
    return TradedFront(
        max_total_mass_kg=asked.machine.max_total_mass_kg,
        status="optimal" if exact else "inaccurate",
        reason="reached_together" if len(told) == 1 else None,
        responses=tuple(
            TradedResponse(
                response=name,
                unit=unit_of(name, asked.objective),
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

    def __init__(self, asked: OptimizeRequest, names: tuple[Traded, ...], scene: Prepared) -> None:
        self.asked, self.names = asked, names
        turn = whole_turn_of(scene, asked.objective) if asked.objective.of_the_revolution else None
        self.traded: Measures = measures(asked, names, scene, turn)
        self.square = np.array([1.0 if name == "mass" else scene.omega_squared for name in names])
        self.fixed = float(np.sum(fixed_masses(asked.machine)))
        self.nothing = np.zeros(len(asked.machine.webs), complex)
        self.gap, self.seconds = asked.accuracy.relative_gap, asked.accuracy.time_limit_s
        self.until = thread_time() + self.seconds

    def values(self, u: Complex) -> Real:
        """What unbalances (K,) come to (D,)."""
        result = self.traded.values(u) * self.square
        return np.where(self._mass, result + self.fixed, result)

    def ends(self) -> tuple[Real, Real, Real] | _Unkept:
        """Values where each counts first (D, D), what is proven of each by itself (D,), and yardsticks (D,)."""
        at, bound, gross = [], [], np.zeros(len(self.names))
        seconds = _ENDS * self.seconds / len(self.names)
        alone: dict[int, _Chosen] = {}
        for i, name in enumerate(self.names):
            if name == "mass":
                continue
            result = self._optimum({name: 1.0}, self.asked.machine.max_total_mass_kg, self.gap, seconds)
            if isinstance(result, _Unkept):
                return result
            alone[i] = result
            gross = np.maximum(gross, self.traded.one_by_one(self._unbalance(result.answer)) * self.square)
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

    def point(self, anchor: Real, size: Real, left: int) -> _Chosen | _Unkept:
        """The best choice as shares of an anchor (D,), with no more mass than that where it is traded.

        Parameters
        ----------
        left : points that are still to be found, which share what is left of the time.
        """
        budget = self.asked.machine.max_total_mass_kg
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
        if isinstance(result, _Unkept):
            return result
        proven = result.answer.certificate
        lowest = np.nan if proven is None or proven.lower_bound is None else proven.lower_bound
        return replace(result, corner=np.where(self._mass, np.nan if budget is None else budget, lowest * anchor))

    def told(self, chosen: _Chosen, size: Real) -> TradedPoint:
        """A point with its proof."""
        answer, after = chosen.answer, chosen.answer.residual.after
        proof = answer.certificate
        assert proof is not None
        assert after is not None
        assert answer.total_mass_kg is not None
        gap = float(np.max((chosen.values - chosen.corner) / size))
        proven = bool(np.isfinite(gap))
        exact = proven and answer.status == "optimal" and gap <= self.gap
        return TradedPoint(
            status="optimal" if exact else "inaccurate",
            status_reason=answer.status_reason,
            values=tuple(chosen.values.tolist()),
            force_peak_N=after.force.peak_N,
            moment_peak_Nm=after.moment.peak_Nm,
            total_mass_kg=answer.total_mass_kg,
            counterweights=answer.counterweights,
            certificate=TradedCertificate(
                corner=tuple(finite_or_null(each) if proven else None for each in chosen.corner),
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

    def _lightest(self, known: Sequence[_Chosen], size: float, seconds: float) -> tuple[Real, float]:
        """What the lightest that keep the ceilings come to (D,), and the mass that is proven to be needed."""
        if self.traded.excess(self.nothing) <= 0.0:
            return self.values(self.nothing), self.fixed
        place = int(np.flatnonzero(self._mass)[0])
        best, least = min(known, key=lambda each: float(each.values[place])), self.fixed
        first = next(name for name in self.names if name != "mass")
        until = thread_time() + seconds
        for _ in range(_BUDGETS):
            most = float(best.values[place])
            if most - least <= self.gap * size or thread_time() >= until:
                break
            middle = 0.5 * (least + most)
            result = self._optimum({first: 1.0}, middle, 1.0, until - thread_time())
            if isinstance(result, _Chosen):
                best = result
            elif result.proven:
                least = middle
            else:
                break
        return best.values, least

    def _optimum(
        self, weights: Mapping[Traded, float], budget: float | None, gap: float, seconds: float
    ) -> _Chosen | _Unkept:
        """The best choice for the largest of the responses times their weights."""
        machine = self.asked.machine.model_copy(update={"max_total_mass_kg": budget})
        answer = optimize(
            # by a copy: a budget below what is fixed is no legal request
            self.asked.model_copy(
                update={
                    "machine": machine,
                    "objective": self._weighing(weights),
                    "accuracy": Accuracy(
                        relative_gap=min(max(gap, _LEAST_GAP), 1.0),
                        time_limit_s=min(max(seconds, _LEAST_TIME), self.seconds),
                    ),
                }
            )
        )
        if not isinstance(answer.certificate, Certificate):
            return _Unkept(answer.status == "infeasible", answer.infeasibility)
        values = self.values(self._unbalance(answer))
        assert answer.total_mass_kg is not None  # only what is infeasible has none
        values = np.where(self._mass, answer.total_mass_kg, values)
        bound = answer.certificate.lower_bound
        corner = np.array(
            [np.nan if bound is None else bound / weights[name] if name in weights else 0.0 for name in self.names]
        )
        return _Chosen(answer, values, corner)

    def _weighing(self, weights: Mapping[Traded, float]) -> Objective:
        """The largest of the responses times their weights; the objective itself times its own."""
        objective = self.asked.objective
        if "objective" in weights:
            own = own_weights(self.asked.machine, objective)
            more = {name: float(each) * weights["objective"] for name, each in own.items()}
            return weighing(objective, more)
        inside = {field: weights.get(name, 0.0) for name, field in _INSIDE.items()}
        return weighing(objective, weights, combine="max", **inside)

    def _unbalance(self, answer: OptimizeAnswer) -> Complex:
        """Of what is chosen (K,), kg m."""
        return np.array([complex(each.x_kg_m, each.y_kg_m) * (not each.fixed) for each in answer.counterweights])


def _best(found: Sequence[_Chosen]) -> list[_Chosen]:
    """Those that no other equals or beats in every response, of two responses in the order of the rising first."""
    kept: list[_Chosen] = []
    for n, each in enumerate(found):
        others = [one.values for k, one in enumerate(found) if k != n]
        beaten = any(np.all(one <= each.values) and np.any(one < each.values) for one in others)
        # of several that are the same, the one of which most is proven
        same = [one for one in found if np.all(one.values == each.values)]
        sharpest = max(same, key=lambda one: float(np.nan_to_num(np.min(one.corner / np.maximum(one.values, 1e-300)))))
        if not beaten and each is sharpest:
            kept.append(each)
    return sorted(kept, key=lambda one: tuple(one.values.tolist())) if kept and kept[0].values.size == 2 else kept
