"""Without limits of the webs all lines of a front are proven within the same ones: each speaks of all points."""

from importlib import import_module
from typing import Any

import numpy as np
import pytest

from optimizer.program.methods.implied_bounds import LARGEST
from optimizer.program.methods.optima import Optima, optima
from optimizer.program.statement import Statement
from optimizer.studies.pareto.front import Front, front
from optimizer.studies.pareto.trade import Trade
from schemas.front.pareto import ParetoRequest
from tests.hard.cases.case import Body, machine, row, throw, web
from tests.optimize import by_hand
from tests.studies.pareto.cases import ask, trade_of

POINTS = 3
Sector = tuple[float, float]  # centre and half-angle, degrees


def without_limits(sector: Sector | None, radius: float = 0.2) -> Body:
    """Two cranks and two webs without a limit, of which one alone helps; next to the shaft it would need much mass."""
    throws = [throw(0.0, 0.0, [row(0.0, 60.0)], rotating=10.0), throw(0.5, 100.0, [row(30.0, 40.0)], rotating=20.0)]
    webs = [web("a", -0.2, 3.0), web("b", 0.3, None, 0.2, (30.0, 5.0)), web("c", 0.7, None, radius, sector)]
    return machine(throws, webs)


def traded(body: Body) -> Trade:
    return trade_of(ParetoRequest.model_validate({"machine": body}))


@pytest.mark.parametrize(("sector", "radius"), [(None, 0.2), ((180.0, 30.0), 1e-6)])
def test_all_lines_of_a_front_are_within_the_same_limits(
    sector: Sector | None, radius: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Of a line with a nearer limit the corner is held against points of others that are beyond it (regression)."""
    limits: list[list[float]] = []

    def recorded(statement: Statement, gap: float, least_mass: bool) -> Optima:
        limits.append(statement.limits.max_mass[0].tolist())
        return optima(statement, gap, least_mass)

    monkeypatch.setattr(import_module(Trade.__module__), "optima", recorded)
    frontier = front(traded(without_limits(sector, radius)), POINTS, 1e-6, True)
    assert isinstance(frontier, Front)
    # before the lines each peak is made smallest within what is known to hold that
    lines = limits[2:]
    within = frontier.trade.minimax.limits.max_mass.tolist()
    assert len(lines) > POINTS
    assert all(line == within for line in lines)
    assert all(first <= second for limit in limits for first, second in zip(limit, within, strict=True))
    assert np.all(np.isfinite(frontier.trade.cap))
    for point in frontier.points:
        assert np.all(point.corner <= frontier.trade.cap)
        assert np.all(point.mass_limit <= frontier.trade.cap)
        peaks = frontier.trade.peaks(point.solution.unbalance)
        rounding = frontier.trade.rounding(point.solution.unbalance)
        assert not any(np.all(peaks + rounding < position.corner) for position in frontier.points)


def test_the_bounds_of_a_front_without_limits_are_proven_by_its_multipliers() -> None:
    """Recomputed in 60 digits (independent) with the limits that the front names."""
    body = without_limits((180.0, 30.0))
    request = ParetoRequest.model_validate({"machine": body, "points": POINTS, "multipliers": True})
    answer = ask(body, points=POINTS, multipliers=True).model_dump(mode="json")
    (only,) = answer["fronts"]
    assert only["status"] == "optimal"
    assert sorted(only["implied_max_mass_kg"]) == ["b", "c"]
    filled: dict[str, Any] = request.model_dump(mode="json")
    recomputed = by_hand.of_front(filled, only, answer["reference_plane_m"])
    assert len(recomputed) == 2 + 2 * POINTS
    for name, (exact, printed) in recomputed.items():
        assert 0 <= exact - printed <= 1e-6 * abs(printed), name


def test_the_reach_of_a_trade_holds_all_up_to_its_peaks() -> None:
    """Analytic: 10 kg m and one web in their plane, |10 + u| at most 30 kg m: u up to 40 kg m, at 0.2 m 200 kg."""
    body = machine([throw(0.0, 0.0, [], radius=1.0, rotating=10.0)], [web("a", 0.0, None)], reference_plane_m=0.0)
    assert traded(body).reach(np.array([30.0, 1.0])) == pytest.approx([200.0], rel=1e-8)


def test_the_reach_of_a_trade_grows_with_its_peaks() -> None:
    trade = traded(without_limits((180.0, 30.0)))
    near, far = (trade.reach(factor * trade.at_rest) for factor in (1.0, 3.0))
    assert np.all(near <= far)
    assert np.all(far[1:] < LARGEST)


def test_of_the_mass_of_what_is_beyond_the_limit_nothing_is_proven() -> None:
    """A mass is proven for peaks up to its limit: beyond it 0 kg for all, multipliers 0 (analytic)."""
    frontier = front(traded(without_limits(None)), POINTS, 1e-6, True)
    assert isinstance(frontier, Front)
    for point in frontier.points:
        there = point.solution.unbalance
        assert point.solution.mass_lower_bound > 0.0
        assert point.counting(frontier.trade, there) is point
        far = there + 1e3 * (1.0 + np.abs(there))
        peaks = frontier.trade.peaks(far)
        assert np.any(peaks > point.mass_limit)
        beyond = point.counting(frontier.trade, far)
        assert beyond.solution.mass_lower_bound == 0.0
        assert np.array_equal(beyond.mass_limit, np.maximum(point.mass_limit, peaks))
        assert beyond.mass_proof is not None
        assert not any(
            part.any() for part in (beyond.mass_proof.term, beyond.mass_proof.row, beyond.mass_proof.ceiling)
        )
