"""The front of any two or three responses that are chosen: its ends, and points as shares of anchors between them."""

from collections.abc import Sequence
from dataclasses import replace
from time import thread_time

import numpy as np

from optimizer.numerics.arrays import Real
from optimizer.solve.solution import Infeasible, finite_or_null
from optimizer.studies.pareto.choice_search import ChoicePoint, ChoiceSearch
from optimizer.studies.pareto.measures import sizes
from optimizer.studies.pareto.points import TradeEnds
from schemas.front.trade import TradedCertificate, TradedPoint

#: of the time limit that of the ends
_ENDS = 0.4
#: an anchor is no smaller than this share of what gaps are relative to
_NARROW = 1e-6
#: budgets that are tried for the lightest that keep the ceilings
_BUDGETS = 24
#: what is as heavy as a budget to rounding is within it
_ROUNDED = 1.0 + 1e-12


class ChoiceTrades(ChoiceSearch):
    """The searches of one front; all figures are in the units of the answer."""

    def ends(self) -> TradeEnds | Infeasible:
        """What all come to where each is smallest by itself."""
        seconds = _ENDS * self.seconds / len(self.names)
        alone: dict[int, ChoicePoint] = {}
        for i, name in enumerate(self.names):
            if name != "mass":
                result = self.optimum({name: 1.0}, self.gap, seconds)
                if isinstance(result, Infeasible):
                    return result
                alone[i] = result
        gross = np.max([self.gross(point) for point in alone.values()], axis=0)
        size = sizes(self.traded.at_rest * self.square, gross)
        values, bound = [], []
        for i, name in enumerate(self.names):
            if name == "mass":
                light, least = self._lightest(list(alone.values()), float(size[i]), seconds)
                values.append(light)
                bound.append(least)
            else:
                values.append(alone[i].values)
                bound.append(float(alone[i].corner[i]))
        at = np.array(values)
        return TradeEnds(at, np.diag(at), np.nan_to_num(np.array(bound), nan=0.0), size, self.at_rest)

    def points(self, shares: Real, ends: TradeEnds) -> tuple[list[TradedPoint], bool]:
        """What is best for shares of the ends (n, D) and not beaten, and whether each was decided."""
        results = [
            self._along(share @ ends.values, ends.size, max(self.left_s, 0.0) / (len(shares) - n))
            for n, share in enumerate(shares)
        ]
        decided = all(isinstance(result, ChoicePoint) or _none_proven(result) for result in results)
        best = _best([result for result in results if isinstance(result, ChoicePoint)])
        return [self._traded_point(point, ends.size) for point in best], decided

    def _along(self, anchor: Real, size: Real, seconds: float) -> ChoicePoint | Infeasible:
        """The best choice as shares of an anchor (D,), with no more mass than that where it is traded."""
        budget = float(anchor[self.is_mass][0]) * _ROUNDED if np.any(self.is_mass) else None
        anchor = np.maximum(anchor, _NARROW * size)
        result = self.first_along(anchor, size, seconds, budget)
        if isinstance(result, Infeasible):
            return result
        bound = result.solution.certificate.lower_bound
        lowest = np.nan if bound is None else bound
        return replace(result, corner=np.where(self.is_mass, np.nan if budget is None else budget, lowest * anchor))

    def _traded_point(self, point: ChoicePoint, size: Real) -> TradedPoint:
        """A point with its proof."""
        best = point.solution
        placement, proof = best.placement, best.certificate
        after = self.scene.beside(placement.on_shafts).first_order(placement.on_crank)
        gap = float(np.max((point.values - point.corner) / size))
        proven = bool(np.isfinite(gap))
        exact = proven and best.status == "optimal" and gap <= self.gap
        return TradedPoint(
            status="optimal" if exact else "inaccurate",
            status_reason=best.reason,
            values=tuple(point.values.tolist()),
            nominal_values=self._nominal(point),
            force_peak_N=float(after.force.peak),
            moment_peak_Nm=float(after.moment.peak),
            **placement.fields,
            certificate=TradedCertificate(
                corner=tuple(finite_or_null(value) if proven else None for value in point.corner),
                relative_gap=max(gap, 0.0) if proven else None,
                mass_lower_bound_kg=None,
                mass_relative_gap=None,
                cuts=proof.cuts or 0,
                rounds=proof.rounds or 0,
                method=proof.method,
            ),
        )

    def _nominal(self, point: ChoicePoint) -> tuple[float, ...] | None:
        """What it comes to with nothing off, where anything may be."""
        values = self.nominal_values(point.solution.unbalance)
        return None if values is None else tuple(np.where(self.is_mass, point.values, values).tolist())

    def _lightest(self, choices: Sequence[ChoicePoint], size: float, seconds: float) -> tuple[Real, float]:
        """What the lightest that keep the ceilings come to (D,), and the mass that is proven to be needed."""
        if self.traded.excess(self.nothing) <= 0.0:
            return self.at_rest, self.fixed
        place = int(np.flatnonzero(self.is_mass)[0])
        best, least = min(choices, key=lambda choice: float(choice.values[place])), self.fixed
        first = next(name for name in self.names if name != "mass")
        until = thread_time() + seconds
        for _ in range(_BUDGETS):
            most = float(best.values[place])
            if most - least <= self.gap * size or thread_time() >= until:
                break
            middle = 0.5 * (least + most)
            result = self.optimum({first: 1.0}, 1.0, until - thread_time(), middle)
            if isinstance(result, ChoicePoint):
                best = result
            elif _none_proven(result):
                least = middle
            else:
                break
        return best.values, least


def _none_proven(none: Infeasible) -> bool:
    """Whether there is nothing to show, and not only nothing that a search has come upon."""
    return none.status == "infeasible"


def _best(choices: Sequence[ChoicePoint]) -> list[ChoicePoint]:
    """Those that no other equals or beats in every response, of two responses in the order of the rising first."""
    front: list[ChoicePoint] = []
    for n, choice in enumerate(choices):
        rest = [rival.values for k, rival in enumerate(choices) if k != n]
        beaten = any(np.all(values <= choice.values) and np.any(values < choice.values) for values in rest)
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
