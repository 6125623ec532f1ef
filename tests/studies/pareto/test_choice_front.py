"""Fronts of force and moment where counterweights are chosen, heavy enough or cut from plates; all sets by hand."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from pydantic import ValidationError

from optimizer.studies.pareto.choice_search import ChoicePoint, ChoiceSearch
from optimizer.studies.pareto.pareto import pareto
from schemas.front.pareto import ParetoFront, ParetoRequest
from tests.hard.bodies import drawn
from tests.hard.cases.case import Body
from tests.studies.pareto.test_counts import Sets, body, every_set
from tests.verification.checking import optimized

STEP_DEG, MASSES = 45.0, (7.5, 16.0)


def front(request: Body) -> ParetoFront:
    (pareto_front,) = pareto(ParetoRequest.model_validate(request)).fronts
    return pareto_front


def plain(**fields: Any) -> Body:
    """Two cranks and four webs without a catalogue."""
    request = body(STEP_DEG, MASSES, **fields)
    del request["machine"]["catalogue"]
    request["accuracy"] = {"time_limit_s": 30}
    return request


def undominated(force: np.ndarray, moment: np.ndarray) -> np.ndarray:
    """(n, 2) what none equals or beats in both by more than rounding, in the order of rising force."""
    pairs: list[tuple[float, float]] = []
    for pair in sorted(zip((force * (1 - 1e-12)).tolist(), moment.tolist(), strict=True)):
        if not pairs or pair[1] < pairs[-1][1] * (1 - 1e-9):
            if pairs and pair[0] <= pairs[-1][0] * (1 + 1e-9):
                pairs.pop()
            pairs.append(pair)
    return np.array(pairs)


def peaks_of(pareto_front: ParetoFront) -> np.ndarray:
    return np.array([(point.weighted_force_peak_N, point.weighted_moment_peak_Nm) for point in pareto_front.points])


def ends_are_closed(pareto_front: ParetoFront, gap: float) -> None:
    """Both smallest peaks are within a gap of what is proven of them."""
    ends, scale = pareto_front.ends, pareto_front.scale
    assert ends is not None
    assert scale is not None
    assert ends.smallest_force_N - ends.smallest_force_lower_bound_N <= gap * scale.force_N
    assert ends.smallest_moment_Nm - ends.smallest_moment_lower_bound_Nm <= gap * scale.moment_Nm


def nothing_is_below(pareto_front: ParetoFront, sets: Sets, among: np.ndarray | None = None) -> None:
    """No set is below a corner in both peaks, and every point is within the asked gap of its own."""
    some = np.ones(sets.force.size, bool) if among is None else among
    if pareto_front.status == "optimal":
        # regression: the share that is left to the other peak was added to the gap
        ends_are_closed(pareto_front, 1e-6)
    for point in pareto_front.points:
        proof = point.certificate
        assert proof.force_N is not None
        assert proof.moment_Nm is not None
        below = (sets.force < proof.force_N * (1 - 1e-9)) & (sets.moment < proof.moment_Nm * (1 - 1e-9))
        assert not np.any(below & some)
        over = (point.force_peak_N - proof.force_N) / proof.yardstick.force_N
        assert proof.relative_gap == pytest.approx(
            max(over, (point.moment_peak_Nm - proof.moment_Nm) / proof.yardstick.moment_Nm, 0.0), abs=1e-12
        )


def test_the_whole_front_of_a_catalogue() -> None:
    """Independent: 83,521 sets, of which no other beats six."""
    pareto_front, sets = front(body(STEP_DEG, MASSES, points=40)), every_set(STEP_DEG, MASSES)
    assert (pareto_front.status, pareto_front.reason) == ("optimal", "complete")
    assert peaks_of(pareto_front) == pytest.approx(undominated(sets.force, sets.moment), rel=1e-9)
    nothing_is_below(pareto_front, sets)
    assert pareto_front.ends is not None
    assert pareto_front.ends.smallest_force_lower_bound_N == pytest.approx(np.min(sets.force), rel=1e-9)
    assert pareto_front.ends.smallest_moment_lower_bound_Nm == pytest.approx(np.min(sets.moment), rel=1e-9)
    for point in pareto_front.points:
        assert all(counterweight.mass_kg in (0.0, *MASSES) for counterweight in point.counterweights)


def test_fewer_points_than_there_are_are_some_of_them() -> None:
    """Independent: the ends, and the point in the largest box between them."""
    pareto_front, sets = front(body(STEP_DEG, MASSES, points=3)), every_set(STEP_DEG, MASSES)
    whole = undominated(sets.force, sets.moment)
    assert pareto_front.reason is None
    points = peaks_of(pareto_front)
    assert len(points) == 3
    assert points[[0, -1]] == pytest.approx(whole[[0, -1]], rel=1e-9)
    assert np.min(np.max(np.abs(whole / points[1] - 1.0), axis=-1)) < 1e-9


def test_under_a_budget_and_with_so_many_counterweights() -> None:
    """Independent: the sets that keep the limits."""
    sets = every_set(STEP_DEG, MASSES)
    request = body(STEP_DEG, MASSES, points=40, total_mass_budgets_kg=[24.0, 40.0])
    request["machine"]["max_counterweights"] = 2
    fronts = pareto(ParetoRequest.model_validate(request)).fronts
    for pareto_front, budget in zip(fronts, (24.0, 40.0), strict=True):
        mask = (sets.mass <= budget) & (sets.weights <= 2)
        assert pareto_front.max_total_mass_kg == budget
        assert (pareto_front.status, pareto_front.reason) in {("optimal", "complete"), ("optimal", "reached_together")}
        assert peaks_of(pareto_front) == pytest.approx(undominated(sets.force[mask], sets.moment[mask]), rel=1e-9)
        nothing_is_below(pareto_front, sets, mask)


def test_ceilings_cut_the_front() -> None:
    """Independent: what is above a ceiling is no point."""
    sets = every_set(STEP_DEG, MASSES)
    request = body(STEP_DEG, MASSES, points=40, objective={"force_ceiling_N": 5000.0})
    pareto_front, mask = front(request), sets.force <= 5000.0
    assert peaks_of(pareto_front) == pytest.approx(undominated(sets.force[mask], sets.moment[mask]), rel=1e-9)
    nothing_is_below(pareto_front, sets, mask)
    request["objective"] = {"force_ceiling_N": 100.0}
    none = front(request)
    assert (none.status, none.points) == ("infeasible", ())
    assert none.infeasibility is not None


def test_direction_weights_are_of_what_is_traded() -> None:
    """Property: weights of 1/2 halve both peaks, and leave the front; others have no more of either peak."""
    half = front(body(STEP_DEG, MASSES, points=40, objective={"direction_weights": {"x": 0.5, "y": 0.5}}))
    whole = front(body(STEP_DEG, MASSES, points=40))
    assert peaks_of(half) == pytest.approx(0.5 * peaks_of(whole), rel=1e-9)
    across = front(body(STEP_DEG, MASSES, points=40, objective={"direction_weights": {"x": 1.0, "y": 0.3}}))
    assert (across.status, across.reason) == ("optimal", "complete")
    assert np.all(np.diff(peaks_of(across), axis=0) * [1, -1] > 0)
    assert across.points[0].weighted_force_peak_N < across.points[0].force_peak_N


def _leasts() -> Body:
    request = plain(points=6)
    for web in request["machine"]["webs"]:
        web |= {"min_fitted_mass_kg": 12.0, "max_mass_kg": 30.0}
    request["machine"]["max_total_mass_kg"] = 28.0
    return request


def _plates() -> Body:
    request = plain(points=6)
    for web in request["machine"]["webs"]:
        for field in ("counterweight_radius_m", "max_mass_kg"):
            del web[field]
        web["envelope"] = {
            "shape": "segment", "inner_radius_m": 0.05, "outer_radius_m": 0.14, "thickness_m": 0.03,
            "max_half_angle_deg": 80,
        }  # fmt: skip
    return request


@pytest.mark.parametrize("request_of", [_leasts, _plates])
def test_every_point_is_the_optimum_under_its_own_force(request_of: Any) -> None:
    """Independent: the least moment of all with no more force, as a single answer has it."""
    request = request_of()
    pareto_front = front(request)
    assert pareto_front.status == "optimal"
    assert len(pareto_front.points) == 6
    assert np.all(np.diff(peaks_of(pareto_front), axis=0) * [1, -1] > 0)
    for point in pareto_front.points[1:-1]:
        objective = {"force_weight": 0, "moment_weight": 1, "force_ceiling_N": point.force_peak_N}
        least = optimized({"machine": request["machine"], "objective": objective}).certificate
        proof = point.certificate
        assert least is not None
        assert least.lower_bound is not None
        assert proof.moment_Nm is not None
        # the point keeps this ceiling, and nothing of less force is below its corner
        assert least.lower_bound <= point.moment_peak_Nm * (1 + 1e-9)
        assert point.moment_peak_Nm <= least.objective + 2e-3 * least.yardstick
    for point in pareto_front.points:
        for counterweight in point.counterweights:
            assert counterweight.mass_kg == 0.0 or request_of is _plates or counterweight.mass_kg >= 12.0


def test_equal_castings_and_fixed_weights_go_with_it() -> None:
    """Independent: the sets of two pairs of equal castings, one of them where it is."""
    request = body(STEP_DEG, MASSES, points=40)
    request["machine"]["web_groups"] = [{"name": "pair", "webs": ["a", "b"]}]
    pareto_front = front(request)
    assert (pareto_front.status, pareto_front.reason) == ("optimal", "complete")
    for point in pareto_front.points:
        a, b, *_ = point.counterweights
        assert (a.mass_kg, a.angle_deg if a.mass_kg else None) == (b.mass_kg, b.angle_deg if b.mass_kg else None)
    free = every_set(STEP_DEG, MASSES)
    # of fewer sets nothing is below what is proven of all
    nothing_is_below(pareto_front, free, np.zeros(free.force.size, bool))
    del request["machine"]["web_groups"]
    request["machine"]["webs"][0]["fixed"] = {"mass_kg": 16.0, "angle_deg": 180.0}
    fixed = front(request)
    assert (fixed.status, fixed.reason) == ("optimal", "complete")
    # one of the catalogue, where it is: of the whole front nothing is above it
    whole = peaks_of(front(body(STEP_DEG, MASSES, points=40)))
    for force, moment in peaks_of(fixed):
        assert np.any((whole[:, 0] <= force * (1 + 1e-9)) & (whole[:, 1] <= moment * (1 + 1e-9)))
        assert fixed.points[0].counterweights[0].fixed


def test_a_search_without_time_says_so() -> None:
    request = body(5.0, (3.0, 7.5, 16.0, 22.0), points=30)
    request["accuracy"] = {"time_limit_s": 0.05, "relative_gap": 1e-9}
    pareto_front = front(request)
    assert pareto_front.reason == "time"
    assert pareto_front.status == "inaccurate" or all(point.status == "optimal" for point in pareto_front.points)


def test_multipliers_do_not_go_with_it() -> None:
    with pytest.raises(ValidationError) as refusal:
        ParetoRequest.model_validate(body(STEP_DEG, MASSES, multipliers=True))
    problems = [problem.path for error in refusal.value.errors() for problem in error["ctx"]["problems"]]
    assert ("multipliers",) in problems


def test_of_moments_that_nothing_makes_a_unit_that_turns_is_the_scale() -> None:
    """Analytic: 1 kg m^2 at the speed of the shaft, as where nothing is chosen; it was 1 N m at any speed."""
    throw = {"position_m": 0.0, "crank_radius_m": 0.1, "crank_angle_deg": 0.0, "rotating_mass_kg": 3.0, "rows": []}
    machine = {"kind": "reciprocating", "throws": [throw], "speed_rpm": 30.0 / np.pi * 0.2, "webs": []}
    payload: Body = {"machine": machine, "objective": {"moment_weight": 1.0}, "points": 2}
    chosen = payload | {"machine": machine | {"catalogue": {"masses_kg": [1.0]}, "max_counterweights": 1}}
    for request in (payload, chosen):
        scale = front(request).scale
        assert scale is not None
        assert scale.moment_Nm == pytest.approx(0.04)
        assert scale.force_N == pytest.approx(3.0 * 0.1 * 0.04)


def test_of_moments_that_cancel_what_each_makes_is_the_scale() -> None:
    """Analytic: two of 1 kg at 0.1 m, 0.05 m on either side; it was 1 kg m^2, or the rounding of their sum."""
    throw = {"position_m": 0.0, "crank_radius_m": 0.1, "crank_angle_deg": 0.0, "rotating_mass_kg": 3.0, "rows": []}
    web = {"counterweight_radius_m": 0.1, "max_mass_kg": 1.0}
    webs = [web | {"name": str(z), "position_m": z} for z in (-0.05, 0.05)]
    machine = {"kind": "reciprocating", "throws": [throw], "speed_rpm": 30.0 / np.pi * 0.2, "webs": webs}
    catalogue = {"masses_kg": [1.0], "angle_step_deg": 90.0}
    pareto_front = front({"machine": machine | {"catalogue": catalogue, "max_counterweights": 2}, "points": 2})
    assert pareto_front.status == "optimal"
    assert pareto_front.scale is not None
    assert pareto_front.scale.moment_Nm == pytest.approx(2.0 * 0.1 * 0.05 * 0.04)
    assert pareto_front.points[-1].force_peak_N == pytest.approx((3.0 - 2.0) * 0.1 * 0.04)


def test_a_gap_wider_than_requested_on_the_scale_of_the_front_is_no_optimum(monkeypatch: pytest.MonkeyPatch) -> None:
    """Regression: a point was optimal by its own yardstick, beside a gap of five times the request."""
    search = ChoiceSearch.optimum

    def wide(self: ChoiceSearch, *args: Any, **ceilings: float) -> Any:
        best = search(self, *args, **ceilings)
        return replace(best, corner=best.values - 0.1 * self.at_rest) if isinstance(best, ChoicePoint) else best

    assert front(body(STEP_DEG, MASSES)).status == "optimal"
    monkeypatch.setattr(ChoiceSearch, "optimum", wide)
    pareto_front = front(body(STEP_DEG, MASSES))
    assert pareto_front.status == "inaccurate"
    assert {point.status for point in pareto_front.points} == {"inaccurate"}
    assert all("wider than requested" in point.status_reason for point in pareto_front.points)


def test_ends_of_plates_are_as_near_to_their_bounds_as_points_are() -> None:
    """Regression: what is left to the other peak at an end was not within the gap, but beside it."""
    drawing = drawn(428, 77, "plates")
    request = {
        "machine": drawing["machine"],
        "objective": drawing["objective"],
        "points": 2,
        "accuracy": drawing["accuracy"],
    }
    frontier = front(request)
    assert frontier.status == "optimal"
    ends_are_closed(frontier, drawing["accuracy"]["relative_gap"])
