import numpy as np
import pytest

from optimizer.program.rows import combined, statement, weighted_peak
from tests.night import part
from tests.program.cases import COMBINATIONS, random_limits, random_point, random_responses, random_statement


@pytest.mark.parametrize("weights", part(2, [(1.0, 1.0), (2.0, 0.5), (0.3, 1.0), (0.0, 1.0), (1.0, 0.0)]))
def test_weighted_peak_is_the_peak_over_a_turn(weights: tuple[float, float]) -> None:
    # independent: the weighted components on a grid of shaft angles, refined by the exact maximum nearby
    rng = np.random.default_rng(7)
    for _ in range(20):
        limits = random_limits(rng, 3, False, False)
        response, _ = random_responses(rng, 3)
        u = random_point(rng, limits)
        peak = weighted_peak(response, 1.5, *weights)
        exact = peak.floor + np.sum(np.abs(peak.norms.at(u)))
        turn = np.exp(1j * np.linspace(0, 2 * np.pi, 200001))
        pair = response.to(u)
        force = pair.co * turn + pair.counter * np.conj(turn)
        sampled = 1.5 * np.max(np.hypot(weights[0] * force.real, weights[1] * force.imag))
        assert sampled <= exact * (1 + 1e-12)
        assert sampled == pytest.approx(exact, rel=1e-8)


def test_sum_and_max_combine_the_same_peaks() -> None:
    rng = np.random.default_rng(3)
    limits = random_limits(rng, 4, False, False)
    peaks = [weighted_peak(response, 1.0, 1.0, 0.2) for response in random_responses(rng, 4)]
    u = random_point(rng, limits)
    values = [peak.floor + np.sum(np.abs(peak.norms.at(u))) for peak in peaks]
    assert statement(combined(peaks, "sum"), [], limits).objective(u) == pytest.approx(sum(values), rel=1e-14)
    assert statement(combined(peaks, "max"), [], limits).objective(u) == pytest.approx(max(values), rel=1e-14)


@pytest.mark.parametrize("case", COMBINATIONS)
def test_objective_is_convex_along_lines(case: tuple) -> None:
    problem = random_statement(11, *case)
    rng = np.random.default_rng(5)
    a, b = random_point(rng, problem.limits), random_point(rng, problem.limits)
    middle = problem.objective(0.3 * a + 0.7 * b)
    assert middle <= 0.3 * problem.objective(a) + 0.7 * problem.objective(b) + 1e-12
