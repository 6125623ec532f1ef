"""Counterweights cut from plates with goals over a revolution, in their order, in scenarios, with tolerances, under
ceilings and a budget at once. They are held against every opening of two plates, by mechanics of their own.

Independent: one row on two webs, whose counterweights stand against the crank. Force, moment and loads come from the
exact stroke, masses and unbalances from the integrals over a sector and a segment.
"""

import copy
import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest
from numpy.typing import NDArray

from optimizer.optimize import optimize
from optimizer.studies.pareto.pareto import pareto
from optimizer.studies.sweep.rows import rows
from optimizer.studies.sweep.table import result_schema, result_table
from schemas.front.pareto import ParetoRequest
from schemas.request.requests import OptimizeRequest
from schemas.sweep.request import SweepRequest
from tests.night import part
from tests.verification.checking import optimized

Real = NDArray[np.float64]
Body = dict[str, Any]

EXAMPLE = Path(__file__).parents[2] / "examples/plate-single.json"
CRANK, ROD, ROTATING, PISTON, OMEGA = 0.06, 0.22, 1.5, 4.0, 1000 * np.pi / 30
PLACES, SPAN, BEARINGS = np.array([-0.06, 0.06]), 0.12, (-0.15, 0.11)
ANGLES = np.linspace(0.0, 2 * np.pi, 721)[:-1]


def plate_example(**more: Any) -> Body:
    """The example, whose counterweights stand against the crank, between two bearings."""
    body: Body = json.loads(EXAMPLE.read_text())
    machine = body["machine"]
    for web in machine["webs"]:
        web["sector"] = {"centre_deg": 270, "half_angle_deg": 1e-3}
    machine["bearings"] = [{"name": str(n), "position_m": z} for n, z in enumerate(BEARINGS)]
    machine |= more.pop("machine", {})
    return body | more


class Cut(NamedTuple):
    """Openings (n, 2) with what they come to."""

    mass: Real  # (n,) kg
    unbalance: Real  # (n, 2) kg m


def cut(front: Real, rear: Real) -> Cut:
    """A segment and an annular sector, by half of their openings in rad."""
    areal = 0.03 * 7850

    def beyond(radius: float, height: Real) -> tuple[Real, Real]:
        angle = np.arccos(np.minimum(height / radius, 1.0))
        return radius**2 * (angle - np.sin(angle) * np.cos(angle)), 2 / 3 * (radius * np.sin(angle)) ** 3

    outer, hub = (beyond(radius, 0.095 * np.cos(front)) for radius in (0.095, 0.03))
    mass = areal * (outer[0] - hub[0]) + 0.026 * 7850 * rear * (0.095**2 - 0.045**2)
    sector = 2 / 3 * 0.026 * 7850 * (0.095**3 - 0.045**3) * np.sin(rear)
    return Cut(mass, np.stack([areal * (outer[1] - hub[1]), sector], axis=-1))


def openings(answer: Any = None) -> Cut:
    """All openings of both plates, and closer ones about an answer."""
    most = np.deg2rad([90.0, 60.0])
    grids = [[np.linspace(0.0, limit_kg, 81) for limit_kg in most]]
    if answer is not None:
        shapes = [counterweight.shape for counterweight in answer.counterweights]
        half = np.deg2rad([0.0 if shape is None else shape.half_angle_deg for shape in shapes])
        grids += [
            [np.clip(a + width * np.linspace(-1, 1, 25), 0.0, m) for a, m in zip(half, most, strict=True)]
            for width in (3e-2, 1e-3, 3e-5)
        ]
    front, rear = (
        np.concatenate(grid_masses)
        for grid_masses in zip(*(map(np.ravel, np.meshgrid(*g)) for g in grids), strict=True)
    )
    return cut(front, rear)


@dataclass(frozen=True)
class Figures:
    """What unbalances (n, 2) against the crank come to, off by a share and by so much besides, each at its worst."""

    unbalance: Real
    piston: float = PISTON
    omega: float = OMEGA
    off: tuple[float, float] = (0.0, 0.0)

    @property
    def scattered(self) -> Real:
        return self.off[0] * self.unbalance + self.off[1]

    @property
    def turned(self) -> NDArray[np.complex128]:
        """Pull of crank and row over the turn as the crank sees it, over the square of the speed."""
        # exact: x = r cos t + l cos b, sin b = r/l sin t; d2x/dt2 by the Fourier series of a periodic function
        stroke = CRANK * np.cos(ANGLES) + np.sqrt(ROD**2 - (CRANK * np.sin(ANGLES)) ** 2)
        series = np.fft.rfft(stroke)
        row = -self.piston * np.fft.irfft(-(np.arange(series.size) ** 2) * series, ANGLES.size)
        turned: NDArray[np.complex128] = row * np.exp(-1j * ANGLES) + ROTATING * CRANK
        return turned

    def _peak(self, share: float, taken: Real) -> Real:
        """Largest |share * pull - taken| over the turn (n,)."""
        pull = share * self.turned
        square = np.max(np.abs(pull) ** 2 - 2 * np.outer(taken, pull.real), axis=-1) + taken**2
        return np.sqrt(np.maximum(square, 0.0))

    @property
    def force(self) -> Real:
        """Of the first order, N."""
        half = self.piston * CRANK / 2
        left = np.abs(ROTATING * CRANK + half - np.sum(self.unbalance, axis=-1))
        return (left + half + np.sum(self.scattered, axis=-1)) * self.omega**2

    @property
    def moment(self) -> Real:
        """N m."""
        return (np.abs(self.unbalance @ PLACES) + self.scattered @ np.abs(PLACES)) * self.omega**2

    @property
    def all_force(self) -> Real:
        """Of all orders, N."""
        return (self._peak(1.0, np.sum(self.unbalance, axis=-1)) + np.sum(self.scattered, axis=-1)) * self.omega**2

    @property
    def across(self) -> Real:
        """Its component along x, across the row that stands at 90 degrees: what turns with the crank, N."""
        return np.abs(ROTATING * CRANK - np.sum(self.unbalance, axis=-1)) * self.omega**2

    @property
    def load(self) -> Real:
        """The larger peak of both bearings, N."""
        peaks = []
        for here, there in (BEARINGS, BEARINGS[::-1]):
            share = (there - PLACES) / (there - here)
            peak = self._peak(there / (there - here), self.unbalance @ share)
            peaks.append(peak + self.scattered @ np.abs(share))
        return np.max(peaks, axis=0) * self.omega**2


def external(figures: Figures) -> Real:
    return figures.force + figures.moment / SPAN


def all_orders(figures: Figures) -> Real:
    return figures.all_force + figures.moment / SPAN


def with_bearings(figures: Figures) -> Real:
    return external(figures) + figures.load


OFF = (float(np.hypot(0.02, 2 * np.sqrt(1.02) * np.sin(np.deg2rad(1.0)))), 0.004)
TOLERANCES = {"mass_relative": 0.02, "angle_deg": 2, "unbalance_kg_m": 0.004}
HEAVIER = [
    {"name": "as it is"},
    {"name": "other", "changes": [
        {"path": "/machine/throws/0/rows/0/reciprocating_mass_kg", "value": 6.0},
        {"path": "/machine/speed_rpm", "value": 900},
    ]},
]  # fmt: skip


def in_scenarios(u: Real, goal: Callable[[Figures], Real]) -> Real:
    return np.maximum(goal(Figures(u)), goal(Figures(u, 6.0, OMEGA * 0.9)))


class Case(NamedTuple):
    body: Body
    objective: Callable[[Real], Real]
    mask: Callable[[Real], NDArray[np.bool_]] = lambda u: np.ones(len(u), bool)


CASES: Mapping[str, Case] = {
    "all orders": Case(plate_example(objective={"orders": "all"}), lambda u: all_orders(Figures(u))),
    "a ceiling along an axis": Case(
        plate_example(objective={"orders": "all", "force_ceiling_x_N": 800}),
        lambda u: all_orders(Figures(u)),
        lambda u: Figures(u).across <= 800,
    ),
    "bearings": Case(plate_example(objective={"bearing_weight": 1}), lambda u: with_bearings(Figures(u))),
    "scenarios": Case(plate_example(scenarios=HEAVIER), lambda u: in_scenarios(u, external)),
    "scenarios of all orders": Case(
        plate_example(scenarios=HEAVIER, objective={"orders": "all"}), lambda u: in_scenarios(u, all_orders)
    ),
    "tolerances": Case(plate_example(tolerances=TOLERANCES), lambda u: external(Figures(u, off=OFF))),
    "tolerances of bearings": Case(
        plate_example(tolerances=TOLERANCES, objective={"bearing_weight": 1}),
        lambda u: with_bearings(Figures(u, off=OFF)),
    ),
    "ceilings": Case(
        plate_example(objective={"moment_ceiling_Nm": 20}),
        lambda u: external(Figures(u)),
        lambda u: Figures(u).moment <= 20,
    ),
}


@pytest.mark.parametrize("budget", [None, 2.4])
@pytest.mark.parametrize("name", part(3, CASES))
def test_no_opening_beats_what_is_proven(name: str, budget: float | None) -> None:
    body, objective, function = CASES[name]
    body = copy.deepcopy(body)
    body["machine"]["max_total_mass_kg"] = budget
    answer = optimized(body)
    assert (answer.status, answer.status_reason[:14]) == ("optimal", "Proven optimal")
    proof = answer.certificate
    assert proof is not None
    assert proof.lower_bound is not None
    assert proof.mass_lower_bound_kg is not None
    assert proof.mass_objective_limit is not None
    every = openings(answer)
    objectives, allowed = objective(every.unbalance), function(every.unbalance)
    allowed &= every.mass <= (np.inf if budget is None else budget * (1 + 1e-12))
    best = np.min(objectives[allowed])
    assert proof.lower_bound <= best * (1 + 1e-9)
    assert proof.yardstick is not None
    assert proof.objective <= best + 1.1e-6 * proof.yardstick
    optima = allowed & (objectives <= proof.mass_objective_limit)
    assert np.min(every.mass[optima], initial=np.inf) >= proof.mass_lower_bound_kg * (1 - 1e-9)
    assert answer.total_mass_kg == pytest.approx(proof.mass_lower_bound_kg, rel=1e-4)
    # what is answered is what is cut
    shapes = [
        0.0 if counterweight.shape is None else np.deg2rad(counterweight.shape.half_angle_deg)
        for counterweight in answer.counterweights
    ]
    own = cut(*(np.array([shape]) for shape in shapes))
    assert answer.total_mass_kg == pytest.approx(own.mass[0], rel=1e-9)
    assert proof.objective == pytest.approx(objective(own.unbalance)[0], rel=1e-6)


@pytest.mark.parametrize("budget", [None, 2.4])
def test_goals_in_their_order_are_kept_and_bounded(budget: float | None) -> None:
    order = [{"goal": "external", "allowance": 0.05}, {"goal": "bearings", "allowance": 0.02}, {"goal": "mass"}]
    body = plate_example(objective={"bearing_weight": 1, "priorities": order})
    body["machine"]["max_total_mass_kg"] = budget
    answer = optimized(body)
    assert answer.status == "optimal"
    assert answer.certificate is not None
    first, second, mass = answer.certificate.goals
    every = openings(answer)
    allowed = every.mass <= (np.inf if budget is None else budget * (1 + 1e-12))
    figures = Figures(every.unbalance[allowed])
    outside, load, weight = external(figures), figures.load, every.mass[allowed]
    assert first.lower_bound is not None
    assert second.lower_bound is not None
    assert mass.lower_bound is not None
    assert np.min(outside) >= first.lower_bound * (1 - 1e-9)
    mask = outside <= first.limit
    assert np.min(load[mask]) >= second.lower_bound * (1 - 1e-9)
    assert np.min(weight[mask & (load <= second.limit)]) >= mass.lower_bound * (1 - 1e-9)
    # what was allowed is used
    assert second.lower_bound < np.min(load[outside <= first.lower_bound * 1.01])


@pytest.mark.parametrize("names", part(3, [["force", "bearings"], ["force", "mass"], ["moment", "bearings", "mass"]]))
def test_no_opening_is_below_the_corner_of_a_point(names: list[str]) -> None:
    body = plate_example()
    front = pareto(ParetoRequest.model_validate({"machine": body["machine"], "responses": names, "points": 4}))
    assert front.status == "optimal"
    for point in front.trades[0].points:
        every = openings(point)
        figures = Figures(every.unbalance)
        of = {"force": figures.force, "moment": figures.moment, "bearings": figures.load, "mass": every.mass}
        corner = [0.0 if coordinate is None else coordinate for coordinate in point.certificate.corner]
        below = [of[name] < least * (1 - 1e-9) for name, least in zip(names, corner, strict=True)]
        assert not np.any(np.all(below, axis=0))


@pytest.mark.parametrize("objective", [{"force_ceiling_N": 1500}, {"orders": "all", "force_ceiling_N": 2200}])
def test_ceilings_that_no_opening_within_the_budget_keeps(objective: Body) -> None:
    body = plate_example(objective=objective)
    assert optimized(body).status == "optimal"
    body["machine"]["max_total_mass_kg"] = 2.0
    answer = optimized(body)
    assert (answer.status, answer.infeasibility is None) == ("infeasible", False)
    every = openings()
    figures = Figures(every.unbalance[every.mass <= 2.0])
    peak = figures.all_force if "orders" in objective else figures.force
    assert np.min(peak) > objective["force_ceiling_N"]


def test_a_row_of_a_sweep_is_the_answer() -> None:
    body = plate_example(objective={"bearing_weight": 1})
    axis = {"path": "/machine/max_total_mass_kg", "values": [2.2, 2.8]}
    request = SweepRequest.model_validate({"base": body, "axes": [axis]})
    table = result_table(rows(request, 0, request.total), result_schema(request, b"{}")).to_pylist()
    for row in table:
        body["machine"]["max_total_mass_kg"] = row["/machine/max_total_mass_kg"]
        answer = optimize(OptimizeRequest.model_validate(body))
        assert (row["status"], row["total_mass_kg"]) == ("optimal", answer.total_mass_kg)
        shapes = {
            counterweight.web: counterweight.shape.half_angle_deg
            for counterweight in answer.counterweights
            if counterweight.shape is not None
        }
        assert {web: row[f"half_angle_deg.{web}"] for web in shapes} == pytest.approx(shapes)
