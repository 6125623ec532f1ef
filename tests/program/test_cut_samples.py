"""Samples of quantities over the turn: what they tell is true, and close to peaks and floors."""

import itertools
from dataclasses import replace

import numpy as np
import pytest

from optimizer.formulation.goals import bearing_responses
from optimizer.numerics.arrays import Complex, Real
from optimizer.numerics.enclosing_circle import smallest_circle
from optimizer.outputs.registry import prepare
from optimizer.program.cuts import samples
from optimizer.program.cuts.brackets import Brackets
from optimizer.program.cuts.cut import EXACT, Evaluation, Pool, Quantity, Scatter, distinct
from optimizer.program.cuts.dominance import deciding, spare
from optimizer.program.cuts.samples import Samples
from optimizer.responses.curve import TurnResponse, floor, peaks
from optimizer.responses.mass_scatter import peaks_astray
from optimizer.solve.whole_turn import whole_turn_of
from schemas.machine.reciprocating import ReciprocatingMachine
from tests.benchmarks.whole_turn import six_with_gas
from tests.optimize.whole_turn import ALONE, request_of
from tests.program.test_scalars import quantity
from tests.program.turning import bearings, largest, quantities
from tests.responses.fourier import FourierCurves
from tests.responses.test_scattered import _responses


def bearings_with_gas() -> tuple[Quantity, ...]:
    """Of the in-line six: loads jump where rows reverse and have kinks where valves open."""
    request = request_of(six_with_gas(), **ALONE, bearing_weight=1)
    scene = prepare(request, request.outputs)
    assert isinstance(scene.machine, ReciprocatingMachine)
    turn = whole_turn_of(scene, request.objective)
    return tuple(map(Quantity, bearing_responses(scene.machine, request.fidelity, turn, scene.laden)))


def drawn(seed: int, webs: int) -> Complex:
    values: Complex = np.random.default_rng(seed).normal(size=(webs, 2)) @ [1, 1j]
    return values


def none(count: int) -> Real:
    """Nothing matters but what is largest."""
    return np.full(count, np.inf)


@pytest.mark.parametrize("seed", range(5))
def test_what_is_told_is_the_curve_at_the_angle_that_is_told(seed: int) -> None:
    """Independent: the Fourier series by themselves."""
    every, u = quantities(np.random.default_rng(seed), 4, 6), drawn(seed, 6)
    for every_quantity, evaluations in zip(every, Samples(every).highest(u, EXACT, np.zeros(4)), strict=True):
        for evaluation in evaluations:
            assert evaluation.cut.angle_deg is not None
            there = every_quantity.response.at(np.deg2rad([evaluation.cut.angle_deg]))[0]
            assert evaluation.cut.constant == pytest.approx(there, rel=1e-12)
            assert evaluation.lower == pytest.approx(abs(there + every_quantity.response.offset(u)), rel=1e-12)
        assert [single_evaluation.lower for single_evaluation in evaluations] == sorted(
            (single_evaluation.lower for single_evaluation in evaluations), reverse=True
        )


@pytest.mark.parametrize("gas", [False, True])
def test_the_highest_that_is_told_is_the_peak_but_for_little(gas: bool) -> None:
    """Independent: brackets; no more than they prove, and as close as parabolas are."""
    every = bearings_with_gas() if gas else quantities(np.random.default_rng(7), 4, 6)
    webs = every[0].response.influence.size
    size = max(abs(single_quantity.response.mean) for single_quantity in every)
    for seed in range(3):
        u = 0.3 * size * drawn(seed, webs)
        bracket = peaks([single_quantity.response for single_quantity in every], u, 1e-10)
        samples = Samples(every)
        lowers = np.array([evaluations[0].lower for evaluations in samples.highest(u, EXACT, none(len(every)))])
        assert np.all(lowers <= bracket.upper)
        np.testing.assert_allclose(lowers, bracket.lower, rtol=1e-9)
        np.testing.assert_allclose(samples.sizes(u, EXACT), bracket.lower, rtol=1e-2)


def test_the_highest_with_masses_that_are_off_is_that_of_their_worst_signs() -> None:
    """Independent: brackets over all masses; what is told is the curve with some of them."""
    responses = _responses("vee", True, "simple_spans")[:2]
    u = 0.02 * drawn(4, responses[0].influence.size)
    worst = peaks_astray(responses, [0.3] * 2, u, np.full(2, 1e-6))
    samples = Samples([Quantity(reply, masses=0.3) for reply in responses])
    lowers = np.array([evaluations[0].lower for evaluations in samples.highest(u, EXACT, none(2))])
    assert np.all(lowers <= worst.upper)
    np.testing.assert_allclose(lowers, worst.lower, rtol=1e-4)
    np.testing.assert_allclose(samples.sizes(u, EXACT), worst.lower, rtol=1e-2)
    for index, ((first, *_), response) in enumerate(zip(samples.highest(u, EXACT, none(2)), responses, strict=True)):
        assert first.cut.angle_deg is not None
        there = np.deg2rad([first.cut.angle_deg])
        parts = 0.3 * response.curves.parts.at(response.number, there)
        signs = np.array(list(itertools.product((-1.0, 1.0), repeat=parts.shape[-1])))
        apart = np.abs(response.at(there) + signs @ parts[0] - first.cut.constant)
        assert np.min(apart) <= 1e-6 * lowers[index]


@pytest.mark.parametrize("gas", [False, True])
def test_first_cuts_hold_the_largest_floor(gas: bool) -> None:
    """Independent: the smallest circle around the curve, by brackets."""
    every = bearings_with_gas() if gas else quantities(np.random.default_rng(3), 4, 6)
    radii = [floor(single_quantity.response, 1e-9).circle.radius for single_quantity in every]
    held = [smallest_circle(np.array([cut.constant for cut in cuts])).radius for cuts in Samples(every).first()]
    worst = int(np.argmax(radii))
    assert held[worst] == pytest.approx(radii[worst], rel=1e-6)
    assert np.all(np.array(held) <= np.array(radii) * (1.0 + 1e-9))


def test_more_local_maxima_are_told_where_they_matter() -> None:
    """Analytic: |1/2 + e^{3 j theta}| is largest at 0, 120 and 240 degrees; of what does not matter one is told."""
    orders = np.arange(0.0, 4.0)
    curves = FourierCurves(orders, np.array([[0.5, 0.0, 0.0, 1.0]]) + 0j)
    samples, u = Samples([Quantity(TurnResponse("bearing", "N", np.zeros(1), curves, 0))]), np.zeros(1, complex)
    (evaluations,) = samples.highest(u, EXACT, np.zeros(1))
    angles = np.mod([(evaluation.cut.angle_deg or 0.0) + 60.0 for evaluation in evaluations], 360.0)
    np.testing.assert_allclose(sorted(angles[:3]), [60.0, 180.0, 300.0], atol=1e-2)
    np.testing.assert_allclose([evaluation.lower for evaluation in evaluations[:3]], 1.5, rtol=1e-9)
    assert [len(sample_evaluations) for sample_evaluations in samples.highest(u, EXACT, none(1))] == [3]
    assert [len(sample_evaluations) for sample_evaluations in Samples([constant()]).highest(u, EXACT, none(1))] == [1]


def constant() -> Quantity:
    curves = FourierCurves(np.zeros(1), np.ones((1, 1)) + 0j)
    return Quantity(TurnResponse("bearing", "N", np.zeros(1), curves, 0))


@pytest.mark.parametrize("scalar", [False, True])
def test_what_turns_is_told_with_what_counterweights_add_there(scalar: bool) -> None:
    """Independent: brackets of the curve that moves."""
    rng = np.random.default_rng(5)
    actual_quantity, u = quantity(rng, rng.choice([-2.0, -1.0, 0.0, 1.0], 6), scalar, "roll"), drawn(5, 6)
    scatter = Scatter(0.01, 0.0)
    bracket, more = peaks([actual_quantity.response], u, 1e-10), scatter.of(actual_quantity.response.influence, u)
    ((highest, *_),) = Samples([actual_quantity]).highest(u, scatter, none(1))
    assert highest.lower <= bracket.upper[0] + more
    assert highest.lower == pytest.approx(bracket.lower[0] + more, rel=1e-6)


def test_a_coarse_bracket_never_hides_what_decides() -> None:
    """Property: a program comes to what sharp brackets of every quantity say, whatever is known of the others."""
    for seed in range(10):
        program, u = bearings(seed, count=5), 0.3 * drawn(seed, 6)
        values = program.values(u, 1e-9)
        bracket = peaks([program_quantity.response for program_quantity in program.quantities], u, 1e-12)
        assert values.goals[-1] == pytest.approx(np.max(bracket.upper), rel=1e-8)
        assert all(evaluation.lower <= high for evaluation, high in zip(values.reached, bracket.upper, strict=True))
        assert all(evaluation.upper >= low for evaluation, low in zip(values.reached, bracket.lower, strict=True))
        assert program.at_rest.goals[-1] == pytest.approx(
            max(evaluation.upper for evaluation in program.at_rest.reached), rel=1e-12
        )


def test_what_may_be_the_largest_has_no_room() -> None:
    """Analytic: a quarter of what each is below the largest, and of nothing that is the largest."""
    groups = (largest(0, 3), largest(2, 4, weight=2.0))
    np.testing.assert_allclose(spare(groups, np.array([4.0, 2.0, 1.0, 1.0])), [0.0, 0.25, 0.0, 0.0])
    evaluations = bearings(0, count=4).values(np.zeros(6, complex), 1e-9).reached
    most = int(np.argmax([evaluation.upper for evaluation in evaluations]))
    assert deciding((largest(0, 4),), evaluations).tolist() == [q == most for q in range(4)]


def test_what_is_known_of_an_unbalance_tells_of_what_is_near_it() -> None:
    """Property: no narrower than asked, never wrong, and nothing is bracketed again."""
    every, u = quantities(np.random.default_rng(1), 4, 6), drawn(1, 6)
    brackets = Brackets(every, [False] * 4, EXACT)
    evaluations = brackets.evaluate(u, np.full(4, 1e-10))
    assert brackets.evaluate(u, np.full(4, 1e-10)) == evaluations
    beside = u * (1.0 + 1e-14)
    near, bracket = (
        brackets.evaluate(beside, np.full(4, 1e-9)),
        peaks([single_quantity.response for single_quantity in every], beside, 1e-12),
    )
    for evaluation, of, low, high in zip(near, evaluations, bracket.lower, bracket.upper, strict=True):
        assert evaluation.cut is of.cut
        assert evaluation.lower <= low
        assert high <= evaluation.upper <= evaluation.lower * (1.0 + 1e-9)
    # what is asked more closely, or lies farther away, is bracketed by itself
    assert brackets.evaluate(u, np.full(4, 1e-13))[0].cut is not evaluations[0].cut
    assert brackets.evaluate(u * 1.001, np.full(4, 1e-10))[0].cut is not evaluations[0].cut


@pytest.mark.parametrize(
    ("values", "step", "highest"),
    [
        # analytic: 3 - (x - 0.25)^2 / 2 at -1, 0 and 1
        ((2.21875, 2.96875, 2.71875), 0.25, 3.0),
        # the vertex lies outside: the end, and what is there
        ((0.0, 1.0, 1.9), 1.0, 1.9),
        ((1.9, 1.0, 0.0), -1.0, 1.9),
        # bent upwards by however little, or not at all: the step that is named
        ((1.0, 0.5, 1.0), -1.0, 1.0),
        ((1.00025, 1.0, 1.00025), -1.0, 1.00025),
        ((1.0, 1.2501, 1.5005), -1.0, 1.0),
        ((2.0, 2.0, 2.0), -1.0, 2.0),
    ],
)
def test_a_parabola_is_highest_at_its_vertex_or_at_an_end(
    values: tuple[float, ...], step: float, highest: float
) -> None:
    """Over leading axes as by themselves."""
    around = np.array([[values, (0.0, 1.0, 0.0)]])
    array, peak = samples._vertex(around, np.full((1, 2), -1))
    assert array == pytest.approx(np.array([[step, 0.0]]), abs=1e-12)
    assert peak == pytest.approx(np.array([[highest, 1.0]]))


def test_equal_norms_are_one_cut_whatever_their_angle() -> None:
    """Analytic: of what turns with the shaft all angles are one norm; of a quarter turn's symmetry there are two."""
    still = TurnResponse("bearing", "N", np.ones(2), FourierCurves(np.zeros(1), np.array([[3.0 + 4.0j]])), 0)
    twice = TurnResponse("bearing", "N", np.ones(2), FourierCurves(np.array([2.0]), np.array([[1.0 + 0.0j]])), 0)
    angles = np.array([0.0, 0.5, 1.0, 1.5]) * np.pi
    for response, count in ((still, 1), (twice, 2)):
        entry = Quantity(response)
        cuts = [entry.cut(angle, value) for angle, value in zip(angles.tolist(), response.at(angles), strict=True)]
        assert len(distinct(cuts)) == count
        # beside what turns by itself no two angles are the same norm
        moving = Quantity(replace(response, turning=np.array([1.0, 0.0])))
        cuts = [moving.cut(angle, value) for angle, value in zip(angles.tolist(), response.at(angles), strict=True)]
        assert len(distinct(cuts)) == 4
        pool = Pool([cuts[:1]], EXACT)
        again = [Evaluation(9.0, 9.0, cut) for cut in cuts]
        assert pool.add([again], np.zeros(2, complex), np.zeros(1))
        assert pool.count() == 4
