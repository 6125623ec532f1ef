"""Samples of quantities over the turn: what they tell is true, and close to peaks and floors."""

import itertools

import numpy as np
import pytest

from optimizer.formulation.goals import bearing_responses
from optimizer.numerics.arrays import Complex, Real
from optimizer.numerics.enclosing_circle import smallest_circle
from optimizer.outputs.registry import prepare
from optimizer.program.cuts import samples
from optimizer.program.cuts.brackets import Brackets
from optimizer.program.cuts.cut import EXACT, Quantity, Scatter
from optimizer.program.cuts.dominance import deciding, spare
from optimizer.program.cuts.samples import Samples
from optimizer.responses.curve import TurnResponse, floor, peaks
from optimizer.responses.mass_scatter import peaks_astray
from optimizer.solve.whole_turn import whole_turn_of
from schemas.machine.reciprocating import ReciprocatingMachine
from tests.benchmarks.whole_turn import six_with_gas
from tests.optimize.whole_turn import ALONE, asked
from tests.program.test_scalars import quantity
from tests.program.turning import bearings, largest, quantities
from tests.responses.fourier import FourierCurves
from tests.responses.test_scattered import _responses


def bearings_with_gas() -> tuple[Quantity, ...]:
    """Of the in-line six: loads jump where rows reverse and have kinks where valves open."""
    request = asked(six_with_gas(), **ALONE, bearing_weight=1)
    scene = prepare(request, request.outputs)
    assert isinstance(scene.machine, ReciprocatingMachine)
    turn = whole_turn_of(scene, request.objective)
    return tuple(map(Quantity, bearing_responses(scene.machine, request.fidelity, turn, scene.laden)))


def drawn(seed: int, webs: int) -> Complex:
    found: Complex = np.random.default_rng(seed).normal(size=(webs, 2)) @ [1, 1j]
    return found


def none(count: int) -> Real:
    """Nothing matters but what is largest."""
    return np.full(count, np.inf)


@pytest.mark.parametrize("seed", range(5))
def test_what_is_told_is_the_curve_at_the_angle_that_is_told(seed: int) -> None:
    """Independent: the Fourier series by themselves."""
    every, u = quantities(np.random.default_rng(seed), 4, 6), drawn(seed, 6)
    for each, told in zip(every, Samples(every).highest(u, EXACT, np.zeros(4)), strict=True):
        for one in told:
            assert one.cut.angle_deg is not None
            there = each.response.at(np.deg2rad([one.cut.angle_deg]))[0]
            assert one.cut.constant == pytest.approx(there, rel=1e-12)
            assert one.lower == pytest.approx(abs(there + each.response.offset(u)), rel=1e-12)
        assert [one.lower for one in told] == sorted((one.lower for one in told), reverse=True)


@pytest.mark.parametrize("gas", [False, True])
def test_the_highest_that_is_told_is_the_peak_but_for_little(gas: bool) -> None:
    """Independent: brackets; no more than they prove, and as close as parabolas are."""
    every = bearings_with_gas() if gas else quantities(np.random.default_rng(7), 4, 6)
    webs = every[0].response.influence.size
    size = max(abs(each.response.mean) for each in every)
    for seed in range(3):
        u = 0.3 * size * drawn(seed, webs)
        bracket = peaks([each.response for each in every], u, 1e-10)
        samples = Samples(every)
        told = np.array([each[0].lower for each in samples.highest(u, EXACT, none(len(every)))])
        assert np.all(told <= bracket.upper)
        np.testing.assert_allclose(told, bracket.lower, rtol=1e-9)
        np.testing.assert_allclose(samples.sizes(u, EXACT), bracket.lower, rtol=1e-2)


def test_the_highest_with_masses_that_are_off_is_that_of_their_worst_signs() -> None:
    """Independent: brackets over all masses; what is told is the curve with some of them."""
    responses = _responses("vee", True, "simple_spans")[:2]
    u = 0.02 * drawn(4, responses[0].influence.size)
    worst = peaks_astray(responses, [0.3] * 2, u, np.full(2, 1e-6))
    samples = Samples([Quantity(each, masses=0.3) for each in responses])
    told = np.array([each[0].lower for each in samples.highest(u, EXACT, none(2))])
    assert np.all(told <= worst.upper)
    np.testing.assert_allclose(told, worst.lower, rtol=1e-4)
    np.testing.assert_allclose(samples.sizes(u, EXACT), worst.lower, rtol=1e-2)
    for each, ((first, *_), response) in enumerate(zip(samples.highest(u, EXACT, none(2)), responses, strict=True)):
        assert first.cut.angle_deg is not None
        there = np.deg2rad([first.cut.angle_deg])
        parts = 0.3 * response.curves.parts.at(response.number, there)
        signs = np.array(list(itertools.product((-1.0, 1.0), repeat=parts.shape[-1])))
        apart = np.abs(response.at(there) + signs @ parts[0] - first.cut.constant)
        assert np.min(apart) <= 1e-6 * told[each]


@pytest.mark.parametrize("gas", [False, True])
def test_first_cuts_hold_the_largest_floor(gas: bool) -> None:
    """Independent: the smallest circle around the curve, by brackets."""
    every = bearings_with_gas() if gas else quantities(np.random.default_rng(3), 4, 6)
    known = [floor(each.response, 1e-9).circle.radius for each in every]
    held = [smallest_circle(np.array([cut.constant for cut in cuts])).radius for cuts in Samples(every).first()]
    worst = int(np.argmax(known))
    assert held[worst] == pytest.approx(known[worst], rel=1e-6)
    assert np.all(np.array(held) <= np.array(known) * (1.0 + 1e-9))


def test_more_local_maxima_are_told_where_they_matter() -> None:
    """Analytic: |1/2 + e^{3 j theta}| is largest at 0, 120 and 240 degrees; of what does not matter one is told."""
    orders = np.arange(0.0, 4.0)
    curves = FourierCurves(orders, np.array([[0.5, 0.0, 0.0, 1.0]]) + 0j)
    samples, u = Samples([Quantity(TurnResponse("bearing", "N", np.zeros(1), curves, 0))]), np.zeros(1, complex)
    (told,) = samples.highest(u, EXACT, np.zeros(1))
    angles = np.mod([(one.cut.angle_deg or 0.0) + 60.0 for one in told], 360.0)
    np.testing.assert_allclose(sorted(angles[:3]), [60.0, 180.0, 300.0], atol=1e-2)
    np.testing.assert_allclose([one.lower for one in told[:3]], 1.5, rtol=1e-9)
    assert [len(each) for each in samples.highest(u, EXACT, none(1))] == [3]
    assert [len(each) for each in Samples([constant()]).highest(u, EXACT, none(1))] == [1]


def constant() -> Quantity:
    curves = FourierCurves(np.zeros(1), np.ones((1, 1)) + 0j)
    return Quantity(TurnResponse("bearing", "N", np.zeros(1), curves, 0))


@pytest.mark.parametrize("scalar", [False, True])
def test_what_turns_is_told_with_what_counterweights_add_there(scalar: bool) -> None:
    """Independent: brackets of the curve that moves."""
    rng = np.random.default_rng(5)
    each, u = quantity(rng, rng.choice([-2.0, -1.0, 0.0, 1.0], 6), scalar, "roll"), drawn(5, 6)
    scatter = Scatter(0.01, 0.0)
    bracket, more = peaks([each.response], u, 1e-10), scatter.of(each.response.influence, u)
    ((highest, *_),) = Samples([each]).highest(u, scatter, none(1))
    assert highest.lower <= bracket.upper[0] + more
    assert highest.lower == pytest.approx(bracket.lower[0] + more, rel=1e-6)


def test_a_coarse_bracket_never_hides_what_decides() -> None:
    """Property: a program comes to what sharp brackets of every quantity say, whatever is known of the others."""
    for seed in range(10):
        program, u = bearings(seed, count=5), 0.3 * drawn(seed, 6)
        values = program.values(u, 1e-9)
        bracket = peaks([each.response for each in program.quantities], u, 1e-12)
        assert values.goals[-1] == pytest.approx(np.max(bracket.upper), rel=1e-8)
        assert all(each.lower <= high for each, high in zip(values.reached, bracket.upper, strict=True))
        assert all(each.upper >= low for each, low in zip(values.reached, bracket.lower, strict=True))
        assert program.at_rest.goals[-1] == pytest.approx(
            max(each.upper for each in program.at_rest.reached), rel=1e-12
        )


def test_what_may_be_the_largest_has_no_room() -> None:
    """Analytic: a quarter of what each is below the largest, and of nothing that is the largest."""
    groups = (largest(0, 3), largest(2, 4, weight=2.0))
    np.testing.assert_allclose(spare(groups, np.array([4.0, 2.0, 1.0, 1.0])), [0.0, 0.25, 0.0, 0.0])
    told = bearings(0, count=4).values(np.zeros(6, complex), 1e-9).reached
    most = int(np.argmax([each.upper for each in told]))
    assert deciding((largest(0, 4),), told).tolist() == [q == most for q in range(4)]


def test_what_is_known_of_an_unbalance_tells_of_what_is_near_it() -> None:
    """Property: no narrower than asked, never wrong, and nothing is bracketed again."""
    every, u = quantities(np.random.default_rng(1), 4, 6), drawn(1, 6)
    brackets = Brackets(every, [False] * 4, EXACT)
    known = brackets.evaluate(u, np.full(4, 1e-10))
    assert brackets.evaluate(u, np.full(4, 1e-10)) == known
    beside = u * (1.0 + 1e-14)
    near, bracket = brackets.evaluate(beside, np.full(4, 1e-9)), peaks([each.response for each in every], beside, 1e-12)
    for each, of, low, high in zip(near, known, bracket.lower, bracket.upper, strict=True):
        assert each.cut is of.cut
        assert each.lower <= low
        assert high <= each.upper <= each.lower * (1.0 + 1e-9)
    # what is asked more closely, or lies farther away, is bracketed by itself
    assert brackets.evaluate(u, np.full(4, 1e-13))[0].cut is not known[0].cut
    assert brackets.evaluate(u * 1.001, np.full(4, 1e-10))[0].cut is not known[0].cut


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
    found, peak = samples._vertex(around, np.full((1, 2), -1))
    assert found == pytest.approx(np.array([[step, 0.0]]), abs=1e-12)
    assert peak == pytest.approx(np.array([[highest, 1.0]]))
