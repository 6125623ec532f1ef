"""Forces of the rows as series: the values of the mechanics, what the cubics leave out, and the peaks of the turn."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from optimizer.mechanics.curve_series import forces
from optimizer.mechanics.friction import reciprocating_friction
from optimizer.mechanics.gas import gas_forces, switching_angles
from optimizer.mechanics.kernel.curves import _rising
from optimizer.mechanics.kinematics import motion
from optimizer.mechanics.reading import Reading
from optimizer.mechanics.rod import rod_forces, shaft_loads
from optimizer.mechanics.row_data import row_data, shared
from optimizer.mechanics.row_series import RowSeries
from optimizer.mechanics.whole_turn import TurnCurves, WholeTurn, break_angles, whole_turn
from optimizer.responses.curve import floors
from optimizer.responses.piecewise_cubics import Bracket
from tests import night
from tests.analyze.driven import STYLES, arrays, random_driven

READINGS = ("piston", "rod", "side", "tangential", "radial")
TURN = 2.0 * np.pi


def _driven(seed: int, style: str, exact: bool = True, friction: float = 0.0) -> tuple[WholeTurn, object, object]:
    plan, data = arrays(random_driven(seed, style))
    magnitude = np.full(plan.reciprocating.mass.shape, friction)
    cut = break_angles(plan, switching_angles(data, plan, exact))
    return whole_turn(row_data(plan, exact, magnitude, data), cut), plan, data


def _forces(plan, data, angle, exact, friction):  # type: ignore[no-untyped-def]
    """Piston forces and what they send into the mechanism, by the functions of the samples."""
    moving = motion(plan, angle, exact)
    force = plan.reciprocating.mass[:, None] * moving.acceleration + gas_forces(data, moving, plan).total
    force = force + reciprocating_friction(moving, np.full(plan.reciprocating.mass.shape, friction))
    return rod_forces(force, moving, plan), moving


def _peaks_of_rows(turn: WholeTurn, reading: str) -> TurnCurves:
    """One curve for every row."""
    count = turn.rows.crank_radius.shape[-1]
    return turn.curves(reading, np.eye(count)[None])  # type: ignore[arg-type]


@pytest.mark.parametrize("exact", night.part(2, [True, False]))
@pytest.mark.parametrize("style", STYLES)
def test_series_have_the_values_of_the_samples(style: str, exact: bool) -> None:
    # independent: the same forces by other formulas
    friction = 5e3
    turn, plan, data = _driven(3, style, exact, friction)
    angle = np.random.default_rng(0).uniform(0.0, TURN, 500)
    expected, moving = _forces(plan, data, angle, exact, friction)
    series = RowSeries(turn.rows, angle[None], None, angle[None], 0)
    for reading in READINGS:
        own, actual = forces(series, reading)[0, ..., 0], getattr(expected, reading)
        assert own == pytest.approx(actual, rel=1e-9, abs=1e-11 * np.max(np.abs(actual))), reading
    _, loads = shaft_loads(expected.piston, moving, plan, angle)
    count = plan.reciprocating.mass.size
    actual_forces = forces(series, "on_shaft")[0, ..., 0] * plan.reciprocating.crank_direction[:, None]
    assert actual_forces == pytest.approx(
        loads[:count] * np.exp(-1j * plan.sense * angle), rel=1e-9, abs=1e-11 * np.max(np.abs(loads))
    )


@pytest.mark.parametrize("style", STYLES)
@pytest.mark.parametrize("seed", range(2))
def test_no_curve_leaves_its_pieces(seed: int, style: str) -> None:
    # analytic: Taylor's theorem; every reading, at angles spread over every piece
    turn, _, _ = _driven(seed, style, friction=2e3)
    for reading in (*READINGS, "rod_without_gas", "rod_at_rest", "on_shaft"):
        curves = _peaks_of_rows(turn, reading)
        pieces = curves.pieces
        size = np.max(np.abs(pieces.cubic))
        for place in np.linspace(-1.0, 1.0, 9):
            curve, piece = np.nonzero(pieces.half > 0)
            angle = pieces.centre[curve, piece] + place * pieces.half[curve, piece]
            cubic = pieces.cubic[curve, piece] @ place ** np.arange(4)
            left_out = np.abs(curves.values(curve, piece, angle) - cubic)
            assert np.all(left_out <= pieces.rest[curve, piece] + 1e-12 * size), reading


@pytest.mark.parametrize("style", STYLES)
@pytest.mark.parametrize(("seed", "exact"), [(0, True), (1, True), (1, False)])
def test_brute_force_never_beats_a_peak(seed: int, exact: bool, style: str) -> None:
    # independent: samples of the mechanics at 0.01 degrees, and on both sides of every jump
    friction = 5e3
    turn, plan, data = _driven(seed, style, exact, friction)
    jumps = break_angles(plan, switching_angles(data, plan, exact))
    jumps = jumps[~np.isnan(jumps)]
    angle = np.concatenate([np.arange(0.0, TURN, np.deg2rad(0.01)), jumps - 1e-10, jumps + 1e-10])
    expected, _ = _forces(plan, data, angle, exact, friction)
    for reading in READINGS:
        values = getattr(expected, reading)
        pieces = _peaks_of_rows(turn, reading).pieces
        for sign in (1.0, -1.0):
            bracket = pieces.peaks(np.zeros(len(pieces.half)), 1e-8, sign=sign)
            brute = np.max(sign * values, axis=-1)
            size = np.max(np.abs(values))
            assert np.all(brute <= bracket.upper + 1e-9 * size), reading
            # a parabola misses h^2/8 of its second derivative, here at most 1e4 times the size
            assert np.all(bracket.lower <= brute + 4e-5 * size), reading
            assert np.all(bracket.upper - bracket.lower <= 1e-8 * np.abs(bracket.lower) + 1e-11 * size), reading


@pytest.mark.parametrize("style", STYLES)
def test_mean_and_variance_are_those_of_many_samples(style: str) -> None:
    # independent: the trapezoidal rule, which jumps and kinks keep from its full accuracy
    turn, _, _ = _driven(2, style, friction=1e3)
    curves = _peaks_of_rows(turn, "on_shaft")
    values = curves.at(np.arange(0.0, TURN, np.deg2rad(0.01)))
    mean, variance = np.mean(values, axis=-1), np.var(values, axis=-1)
    assert np.all(np.abs(curves.mean - mean) <= 1e-4 * np.sqrt(variance))
    assert curves.variance == pytest.approx(variance, rel=1e-4)


@pytest.mark.parametrize("most", night.part(2, [1, 512]))
@pytest.mark.parametrize("style", STYLES)
def test_root_mean_squares_are_off_by_no_more_than_is_told(
    style: str, most: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    # independent: twenty nodes in each of eight parts, by the values of the curve in every piece
    turn, _, _ = _driven(2, style, friction=1e3)
    monkeypatch.setattr("optimizer.mechanics.whole_turn._MOST_PARTS", most)
    curves = _peaks_of_rows(turn, "on_shaft")
    node, weight = np.polynomial.legendre.leggauss(20)
    within = ((2.0 * np.arange(8) - 7.0)[:, None] + node).ravel() / 8.0
    angle = curves.pieces.centre[..., None] + curves.pieces.half[..., None] * within
    curve, piece, _ = np.indices(angle.shape)
    there = curves.values(curve.ravel(), piece.ravel(), angle.ravel()).reshape(angle.shape)
    share = curves.pieces.half[..., None] * np.tile(weight / 8.0, 8) / TURN
    for constant in (0.0, 1e3 - 2e3j):
        exact = np.sqrt(np.sum(np.abs(there + constant) ** 2 * share, axis=(1, 2)))
        root = np.sqrt(curves.variance + np.abs(curves.mean + constant) ** 2)
        assert np.all(np.abs(root - exact) <= curves.rms_error + 1e-14 * curves.pieces.size)
    if most > 1:
        assert np.all(curves.rms_error <= 1e-9 * curves.pieces.size)


def _at(curves: TurnCurves, places: np.ndarray) -> np.ndarray:
    """Values (C, P, n) at places of every piece."""
    angle = curves.pieces.centre[..., None] + curves.pieces.half[..., None] * places
    curve, piece, _ = np.indices(angle.shape)
    return curves.values(curve.ravel(), piece.ravel(), angle.ravel()).reshape(angle.shape)


@pytest.mark.parametrize("style", STYLES)
def test_values_in_pieces_are_those_at_their_angles(style: str) -> None:
    turn, _, _ = _driven(2, style, friction=1e3)
    curves, places = _peaks_of_rows(turn, "on_shaft"), np.array([-0.9, 0.0, 0.35])
    values = _at(curves, places)
    array = curves.in_pieces(places).reshape(values.shape)
    assert np.all(np.abs(array - values) <= 1e-12 * np.max(curves.pieces.size))


def test_what_is_left_out_everywhere_is_counted_once_for_each_of_both() -> None:
    """Analytic: a root mean square and its quadrature, over a whole turn of 3 N that are left out."""
    turn, _, _ = _driven(2, STYLES[0])
    curves = _peaks_of_rows(turn, "on_shaft")
    pieces = curves.pieces
    vars(curves).update(_left_out=np.full(pieces.half.shape, 3.0), _parts=np.ones((1, pieces.half.shape[-1])))
    assert curves.rms_error == pytest.approx(6.0, abs=1e-11 * float(np.max(pieces.size)))


@pytest.mark.parametrize("style", STYLES)
def test_parts_of_a_curve_are_bounded_and_are_what_their_cubics_say(style: str) -> None:
    """Property: Taylor's theorem for every row, and all rows together below what they come to at most."""
    turn, _, _ = _driven(1, style)
    count = turn.rows.crank_radius.shape[-1]
    curves = turn.curves("piston", np.linspace(0.5, 2.0, 2 * count).reshape(1, 2, count))
    parts = curves.parts
    curve, piece = np.nonzero(curves.pieces.half > 0)
    centre, half = curves.pieces.centre[curve, piece], curves.pieces.half[curve, piece]
    cubics, largest = parts.cubics(curve, piece, centre, half), parts.largest[curve, piece]
    fourth = parts.fourth(curve, piece) * half[:, None] ** 4
    assert cubics.shape == (curve.size, count, 4)
    for place in (-1.0, -0.3, 0.6, 1.0):
        values = parts.values(curve, piece, centre + place * half)
        size = 1e-11 * np.max(largest)
        assert np.all(np.abs(values - cubics @ place ** np.arange(4)) <= fourth * place**4 + size)
        assert np.all(np.sum(np.abs(values), axis=-1) <= largest + size)


@pytest.mark.parametrize("reading", ["rod", "rod_at_rest", "rod_without_gas", "on_shaft"])
def test_designs_together_are_as_designs_alone(reading: Reading) -> None:
    # property: to the bit, whether what all designs have in common is worked out once or for each
    turn, _, _ = _driven(1, STYLES[0], friction=1e3)
    inertia = turn.rows.inertia * np.array([[1.0], [1.1], [0.7]])
    cut = [np.repeat(values, 3, axis=0) for values in (turn.centre, turn.half)]
    shared = replace(turn.rows, designs=3, inertia=inertia)
    apart = replace(shared, ahead=np.repeat(turn.rows.ahead, 3, axis=0))
    alone = [WholeTurn(replace(turn.rows, inertia=masses[None]), turn.centre, turn.half) for masses in inertia]
    expected = [_peaks(single_turn, reading) for single_turn in alone]
    for rows in (shared, apart):
        bracket = _peaks(WholeTurn(rows, *cut), reading)
        for part, expected_part in zip(bracket, zip(*expected, strict=True), strict=True):
            assert np.array_equal(part, np.concatenate(expected_part))


def test_what_all_designs_have_alike_stands_once() -> None:
    for designs in (1, 2, 3):
        same = np.broadcast_to([1.0, 2.0], (designs, 2)).copy()
        assert shared(same).tolist() == [[1.0, 2.0]]
        same[-1, 1] += designs - 1.0
        assert shared(same).tolist() == same.tolist()


def test_a_design_taken_alone_keeps_its_curves() -> None:
    # property: to the bit, with the weights and constants of that design
    turn, _, _ = _driven(1, STYLES[0], friction=1e3)
    inertia = turn.rows.inertia * np.array([[1.0], [1.1], [0.7]])
    cut = [np.repeat(values, 3, axis=0) for values in (turn.centre, turn.half)]
    weights = np.random.default_rng(2).normal(size=(3, 2, turn.rows.crank_radius.shape[-1]))
    whole = WholeTurn(replace(turn.rows, designs=3, inertia=inertia), *cut)
    curves = whole.curves("rod", weights, 1e3 * weights[..., 0])
    angle = np.linspace(0.1, 6.0, 7)
    for number, expected in enumerate(curves.at(angle).reshape(3, 2, -1)):
        np.testing.assert_array_equal(curves.of_designs(slice(number, number + 1)).at(angle), expected)


def _three_designs(reading: Reading) -> TurnCurves:
    """Two curves of each of three designs, the last of which has a piece without width more."""
    turn, _, _ = _driven(1, STYLES[0], friction=1e3)
    centre, half = (np.repeat(values, 3, axis=0) for values in (turn.centre, turn.half))
    half[2, 4] = 0.0
    weights = np.random.default_rng(2).normal(size=(3, 2, turn.rows.crank_radius.shape[-1]))
    # beside so large a constant nothing is left out, and one part of a piece is enough
    constant = np.array([[0.0, 0.0], [1e12, 1e12], [1e5, 0.0]])
    return WholeTurn(replace(turn.rows, designs=3), centre, half, squared=True).curves(reading, weights, constant)


@pytest.mark.parametrize("reading", ["on_shaft", "rod"])
def test_mean_squares_of_designs_are_those_of_each_alone(reading: Reading) -> None:
    # property: to the bit, though their quadratures have different numbers of nodes
    curves = _three_designs(reading)
    nodes = curves._quadrature[2]
    assert len(set(nodes.tolist())) > 1
    for name in ("mean", "variance", "rms_error"):
        part = getattr(curves, name).reshape(3, 2)
        for number in range(3):
            alone = curves.of_designs(slice(number, number + 1))
            np.testing.assert_array_equal(part[number], getattr(alone, name), err_msg=name)
            assert alone._quadrature[2] == nodes[number]


def test_floors_of_designs_are_those_of_each_alone() -> None:
    # property: to the bit, of designs in which the same pieces have a width
    curves = _three_designs("on_shaft")
    actual_floors = floors(curves, 1e-7, range(4), np.array([0, 1, 2, 2]))
    for number, group in enumerate(([0, 1], [0, 0])):
        alone = floors(curves.of_designs(slice(number, number + 1)), 1e-7, None, np.array(group))
        some = slice(2 * number, 2 * number + 2)
        np.testing.assert_array_equal(actual_floors.centre[some], alone.centre)
        np.testing.assert_array_equal(actual_floors.radius[some], alone.radius)
        np.testing.assert_array_equal(actual_floors.upper[some], alone.upper)
    held = actual_floors.floor(0)
    assert np.abs(held.value - held.circle.centre) == pytest.approx(held.circle.radius, rel=1e-12)


def test_every_design_has_its_own_means() -> None:
    """Analytic: the mean of a tangential force is that of its design, however many axes the designs come in."""
    turn, _, _ = _driven(1, STYLES[0])
    count = turn.rows.crank_radius.shape[-1]
    means = np.arange(6.0 * count).reshape(2, 3, count)
    rows = replace(turn.rows, designs=6, inertia=np.repeat(turn.rows.inertia, 6, axis=0))
    actual_means = whole_turn(rows, np.zeros((2, 3, 1)), means).means
    assert np.array_equal(actual_means, means.reshape(6, count))


def test_more_places_than_are_expanded_at_once_are_as_few() -> None:
    # property: 50,000 rows at places are expanded at once; every place as if it were alone, whatever its neighbours
    turn = _driven(3, "w")[0]
    curves = _peaks_of_rows(turn, "rod")
    count, pieces = curves.weights.shape[1], turn.centre.shape[1]
    number = np.random.default_rng(1).integers(0, count * pieces, 2 * 50_000 // count)
    curve, piece = np.divmod(number, pieces)
    together = curves.cubics(curve, piece, turn.centre[0, piece], turn.half[0, piece])
    for some in (slice(0, 40), slice(-40, None)):
        alone = curves.cubics(curve[some], piece[some], turn.centre[0, piece[some]], turn.half[0, piece[some]])
        np.testing.assert_array_equal(together[some], alone)


def _peaks(turn: WholeTurn, reading: Reading) -> Bracket:
    count, designs = turn.rows.crank_radius.shape[-1], len(turn.centre)
    pieces = turn.curves(reading, np.broadcast_to(np.eye(count), (designs, count, count))).pieces
    return pieces.peaks(np.zeros(designs * count), 1e-9)


@settings(max_examples=60, deadline=None)
@given(st.lists(st.floats(-10.0, 10.0), max_size=70))
def test_places_are_put_in_rising_order(values: list[float]) -> None:
    # independent: numpy's order; of equal ones any comes first
    places = np.array(values)
    order = _rising.py_func(places)
    assert sorted(order.tolist()) == list(range(places.size))
    assert places[order].tolist() == sorted(values)
