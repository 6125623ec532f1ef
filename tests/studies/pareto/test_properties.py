"""What holds of every front, on random machines; figures are compared with an independent simulation."""

import itertools
import random
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from optimizer.program.verdict import MASS_GAP
from schemas.front.pareto import ParetoFront
from tests.night import part
from tests.optimize.machines import first_order, random_machine
from tests.studies.pareto.cases import ask, below_a_corner, four_webs, front, straight, traded
from tests.verification.checking import optimized

SEEDS = st.integers(0, 10_000)
# a front is dozens of optima
MACHINES = settings(max_examples=settings.default.max_examples // 6, deadline=None)


def weighted_ends(body: dict[str, Any], **objective: float) -> tuple[float, float]:
    """Objective and its lower bound of one optimum."""
    answer = optimized({"machine": body, "objective": objective})
    assert answer.certificate is not None
    return answer.certificate.objective, answer.certificate.lower_bound


def check(pareto_front: ParetoFront, gap: float = 1e-6) -> None:
    """What every front promises about itself."""
    assert pareto_front.scale is not None
    assert pareto_front.ends is not None
    peaks = [traded(point) for point in pareto_front.points]
    assert peaks == sorted(peaks)
    assert all(first[1] > second_second[1] for first, second_second in itertools.pairwise(peaks))
    assert (pareto_front.ends.smallest_force_N, pareto_front.ends.moment_at_smallest_force_Nm) == peaks[0]
    assert (pareto_front.ends.force_at_smallest_moment_N, pareto_front.ends.smallest_moment_Nm) == peaks[-1]
    for point, (force, moment) in zip(pareto_front.points, peaks, strict=True):
        proof = point.certificate
        assert proof.force_N <= force
        assert proof.moment_Nm <= moment
        over = max(
            (force - proof.force_N) / pareto_front.scale.force_N,
            (moment - proof.moment_Nm) / pareto_front.scale.moment_Nm,
        )
        # a peak may be many times what it is divided by, and the difference is rounded as the peak is
        size = max(1.0, force / pareto_front.scale.force_N, moment / pareto_front.scale.moment_Nm)
        assert proof.relative_gap == pytest.approx(over, abs=1e-15 * size)
        assert force >= pareto_front.ends.smallest_force_lower_bound_N
        assert moment >= pareto_front.ends.smallest_moment_lower_bound_Nm
        assert not below_a_corner(force, moment, pareto_front, 1e-12)
        assert proof.mass_lower_bound_kg is not None
        assert proof.mass_lower_bound_kg <= point.total_mass_kg
        assert proof.mass_relative_gap is not None
        honest = proof.relative_gap <= gap and proof.mass_relative_gap <= MASS_GAP
        assert (point.status == "optimal") == honest
        total = sum(counterweight.mass_kg for counterweight in point.counterweights)
        assert point.total_mass_kg == pytest.approx(total, rel=1e-14)
    if len(pareto_front.points) == 1:
        assert pareto_front.reason == "reached_together"
    if pareto_front.knee is not None:
        assert 0 < pareto_front.knee < len(pareto_front.points) - 1


@given(SEEDS)
@MACHINES
def test_a_front_is_what_it_says(seed: int) -> None:
    body = random_machine(seed)
    pareto_front = front(body, points=5)
    check(pareto_front)
    # independent: the peaks of a simulation over the turn, sampled every degree
    for point in pareto_front.points[:: max(1, len(pareto_front.points) - 1)]:
        weights = [counterweight.model_dump() for counterweight in point.counterweights]
        turn = np.max(np.abs(first_order(body, weights, np.arange(360.0))), axis=-1)
        for peak, sampled in zip((point.force_peak_N, point.moment_peak_Nm), turn, strict=True):
            assert sampled <= peak * (1 + 1e-9) + 1e-6
            assert sampled >= peak * (1 - 2e-4) - 1e-6


@given(SEEDS, st.lists(st.floats(-3, 3), min_size=3, max_size=3), st.sampled_from(["sum", "max"]))
@MACHINES
def test_no_optimum_with_other_weights_is_below_the_front(seed: int, exponents: list[float], combine: str) -> None:
    body = random_machine(seed)
    pareto_front = front(body, points=5)
    assert pareto_front.scale is not None
    for exponent in exponents:
        objective = {
            "combine": combine,
            "force_weight": 1.0 / pareto_front.scale.force_N,
            "moment_weight": 10.0**exponent / pareto_front.scale.moment_Nm,
        }
        answer = optimized({"machine": body, "objective": objective})
        after = answer.residual.after
        assert after is not None
        assert not below_a_corner(after.force.peak_N, after.moment.peak_Nm, pareto_front, 1e-12)
        # nor is the front below what is proven of that objective
        assert answer.certificate is not None
        for force, moment in map(traded, pareto_front.points):
            parts = (objective["force_weight"] * force, objective["moment_weight"] * moment)
            value = sum(parts) if combine == "sum" else max(parts)
            assert value >= answer.certificate.lower_bound * (1 - 1e-12)


@given(SEEDS)
@MACHINES
def test_the_ends_are_the_optima_of_each_peak_alone(seed: int) -> None:
    body = random_machine(seed)
    pareto_front = front(body, points=2)
    assert pareto_front.ends is not None
    assert pareto_front.scale is not None
    force, force_bound = weighted_ends(body, force_weight=1.0, moment_weight=0.0)
    moment, moment_bound = weighted_ends(body, force_weight=0.0, moment_weight=1.0)
    assert pareto_front.ends.smallest_force_N == pytest.approx(force, abs=2e-6 * pareto_front.scale.force_N)
    assert pareto_front.ends.smallest_moment_Nm == pytest.approx(moment, abs=2e-6 * pareto_front.scale.moment_Nm)
    assert pareto_front.ends.smallest_force_N >= force_bound * (1 - 1e-12)
    assert pareto_front.ends.smallest_moment_Nm >= moment_bound * (1 - 1e-12)


@given(SEEDS)
@MACHINES
def test_a_larger_budget_is_never_worse(seed: int) -> None:
    rng = random.Random(seed)
    small = rng.uniform(0.0, 30.0)
    answer = ask(random_machine(seed), points=4, total_mass_budgets_kg=[small, small + rng.uniform(0.1, 30.0)])
    tight, loose = answer.fronts
    assert (tight.max_total_mass_kg or 0.0) < (loose.max_total_mass_kg or 0.0)
    for pareto_front in answer.fronts:
        check(pareto_front)
        assert pareto_front.max_total_mass_kg is not None
        assert all(point.total_mass_kg <= pareto_front.max_total_mass_kg * (1 + 1e-12) for point in pareto_front.points)
    assert not any(below_a_corner(*traded(point), loose, 1e-12) for point in tight.points)
    assert tight.ends is not None
    assert loose.ends is not None
    assert loose.scale is not None
    assert loose.ends.smallest_force_N <= tight.ends.smallest_force_N + 1e-6 * loose.scale.force_N
    assert loose.ends.smallest_moment_Nm <= tight.ends.smallest_moment_Nm + 1e-6 * loose.scale.moment_Nm


@pytest.mark.parametrize("across", [{"x": 1.0, "y": 0.25}, {"x": 0.0, "y": 1.0}, {"x": 3.0, "y": 3.0}])
def test_direction_weights_are_traded_and_both_peaks_are_shown(across: dict[str, float]) -> None:
    body = four_webs()
    pareto_front = front(body, points=5, objective={"direction_weights": across})
    check(pareto_front)
    assert len(pareto_front.points) == 5
    for point in pareto_front.points:
        assert point.certificate.relative_gap <= 1e-6
        weights = [counterweight.model_dump() for counterweight in point.counterweights]
        vectors = first_order(body, weights, np.arange(0.0, 360.0, 0.25))
        # independent: sampled components, weighed one by one; four samples a degree miss 1e-5 of a peak
        sampled = np.max(np.hypot(across["x"] * vectors.real, across["y"] * vectors.imag), axis=-1)
        assert traded(point) == pytest.approx(tuple(sampled), rel=2e-5)
        plain = np.max(np.abs(vectors), axis=-1)
        assert (point.force_peak_N, point.moment_peak_Nm) == pytest.approx(tuple(plain), rel=2e-5)


def test_force_and_moment_weights_play_no_part() -> None:
    plain, pareto_front = (
        front(four_webs(), objective=objective)
        for objective in ({}, {"force_weight": 7.0, "moment_weight": 0.0, "combine": "max"})
    )
    assert plain == pareto_front


def test_without_least_mass_nothing_is_claimed_about_it() -> None:
    pareto_front = front(four_webs(), points=4, objective={"least_mass": False})
    lightest = front(four_webs(), points=4)
    assert pareto_front.status == "optimal"
    for point, light in zip(pareto_front.points, lightest.points, strict=True):
        assert point.certificate.mass_lower_bound_kg is None
        assert point.certificate.mass_relative_gap is None
        assert point.total_mass_kg >= light.total_mass_kg * (1 - 1e-3)


@pytest.mark.parametrize("gap", part(2, [1e-3, 1e-6, 1e-8]))
def test_the_asked_gap_is_reached(gap: float) -> None:
    pareto_front = front(four_webs(), points=5, accuracy={"relative_gap": gap})
    check(pareto_front, gap)
    assert pareto_front.status == "optimal"


def test_a_gap_that_cannot_be_reached_is_reported() -> None:
    pareto_front = front(straight(), points=3, accuracy={"relative_gap": 1e-12}, objective={"least_mass": False})
    assert pareto_front.status == "inaccurate"
    assert max(point.certificate.relative_gap for point in pareto_front.points) > 1e-12


def test_infeasible_under_one_budget_only() -> None:
    free = front(four_webs(), points=2)
    assert free.ends is not None
    ceiling = 1.2 * free.ends.smallest_force_N
    answer = ask(four_webs(), points=3, objective={"force_ceiling_N": ceiling}, total_mass_budgets_kg=[60.0, 0.0])
    assert [pareto_front.status for pareto_front in answer.fronts] == ["optimal", "infeasible"]
    assert answer.status == "infeasible"
    assert all(point.force_peak_N <= ceiling * (1 + 1e-8) for point in answer.fronts[0].points)
    assert answer.fronts[1].infeasibility is not None
    assert answer.fronts[1].infeasibility.conflict == ("force_ceiling_N",)


def test_the_rest_of_the_answer() -> None:
    answer = ask(four_webs(reference_plane_m=0.1), outputs=["residual", "torque"])
    optimum = optimized({"machine": four_webs(reference_plane_m=0.1)})
    assert answer.floor == optimum.floor
    assert answer.without_counterweights == optimum.residual.before
    assert answer.reference_plane_m == 0.1
    assert {name for name, use in answer.effects.items() if use.simulated} == {
        name for name, use in optimum.effects.items() if use.simulated
    }
    assert answer.timing.total_ms > answer.timing.solve_ms > 0
