"""Main-bearing loads and bending moments: textbook beams, laws that hold for every shaft, an independent solver."""

from collections.abc import Callable
from typing import Any, NamedTuple

import mpmath
import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from optimizer.mechanics.bearings import (
    bending_moment,
    continuous_beam,
    continuous_beam_influence,
    simple_spans,
    simple_spans_influence,
    unit_bending_moment,
)
from optimizer.numerics.arrays import Complex, Real

Model = Callable[[Real, Real, Complex], Complex]
Influence = Callable[[Real, Real], Real]
Numbers = tuple[float, ...]
MODELS = pytest.mark.parametrize("model", [simple_spans, continuous_beam])
INFLUENCES = pytest.mark.parametrize("influence", [simple_spans_influence, continuous_beam_influence])
ANGLES = 3
LEVER = 21.0  # 1 m of overhang on a span of 0.05 m: the most by which one end span enlarges a load


class Shaft(NamedTuple):
    bearing: Real
    position: Real
    load: Complex


@st.composite
def shafts(draw: st.DrawFn, bearings: tuple[int, int] = (2, 7)) -> Shaft:
    """Spans of 0.05 to 2 m, overhangs up to 1 m, loads of 1e-3 to 1e3 or none, some of them exactly at a bearing."""
    gaps = draw(st.lists(st.floats(0.05, 2.0), min_size=bearings[0] - 1, max_size=bearings[1] - 1))
    bearing = np.concatenate([[0.0], np.cumsum(gaps)]) + draw(st.floats(-3.0, 3.0))
    anywhere = st.floats(bearing[0] - 1.0, bearing[-1] + 1.0)
    position = draw(st.lists(anywhere | st.sampled_from(bearing.tolist()), min_size=1, max_size=8))
    size, count = st.floats(-1e3, 1e3).map(lambda x: x if abs(x) > 1e-3 else 0.0), 2 * ANGLES * len(position)
    load = np.array(draw(st.lists(size, min_size=count, max_size=count))).reshape(2, len(position), ANGLES)
    return Shaft(np.array(draw(st.permutations(bearing.tolist()))), np.array(position), load[0] + 1j * load[1])


def load_scale(shaft: Shaft, reaction: Complex) -> Any:
    """Largest sum of forces that can appear, (T,)."""
    return np.sum(np.abs(shaft.load), axis=0) + np.sum(np.abs(reaction), axis=0)


def assert_close(values: Complex, expected: Complex, scale: Any, tolerance: float = 1e-12) -> None:
    assert values.shape == expected.shape
    assert np.all(np.abs(values - expected) <= tolerance * scale)


def moment_at(model: Model, shaft: Shaft, station: Any) -> Complex:
    return bending_moment(shaft.bearing, model(*shaft), shaft.position, shaft.load, np.asarray(station))


def moment_scale(model: Model, shaft: Shaft) -> Any:
    return load_scale(shaft, model(*shaft)) * (np.ptp(shaft.bearing) + 2.0)


@INFLUENCES
@pytest.mark.parametrize(
    ("plane", "expected"),
    [(0.5, (1 / 2, 1 / 2)), (0.25, (3 / 4, 1 / 4)), (1.5, (-1 / 2, 3 / 2)), (-1.0, (2, -1)), (0.0, (1, 0))],
)
def test_two_bearings_analytic(influence: Influence, plane: float, expected: Numbers) -> None:
    """The lever rule; with two bearings the shaft is statically determinate, so the models agree."""
    actual_influence = influence(np.array([0.0, 1.0]), np.array([plane]))[:, 0]
    np.testing.assert_allclose(actual_influence, expected, rtol=0, atol=1e-15)


@INFLUENCES
@pytest.mark.parametrize("count", [2, 3, 6])
def test_a_load_at_a_bearing_is_carried_there_exactly(influence: Influence, count: int) -> None:
    """Analytic, to the last bit, for places that are no round numbers."""
    bearing = np.cumsum(np.random.default_rng(count).uniform(0.1, 1.0, count))
    assert np.array_equal(influence(bearing, bearing), np.eye(count))


def test_hinges_keep_a_load_in_its_span_analytic() -> None:
    influence = simple_spans_influence(np.array([0.0, 1.0, 3.0, 4.0]), np.array([1.5, 5.0, -2.0]))
    np.testing.assert_allclose(influence.T, [[0, 3 / 4, 1 / 4, 0], [0, 0, -1, 2], [3, -2, 0, 0]], rtol=0, atol=1e-15)


@pytest.mark.parametrize(
    ("spans", "loaded", "reactions", "moments"),
    [
        (2, (0,), (13 / 32, 22 / 32, -3 / 32), (-3 / 32,)),
        (2, (0, 1), (5 / 16, 22 / 16, 5 / 16), (-3 / 16,)),
        (3, (0,), (0.400, 0.725, -0.150, 0.025), (-0.100, 0.025)),
        (3, (1,), (-0.075, 0.575, 0.575, -0.075), (-0.075, -0.075)),
        (3, (0, 2), (0.425, 0.575, 0.575, 0.425), (-0.075, -0.075)),
        (3, (0, 1, 2), (0.350, 1.150, 1.150, 0.350), (-0.150, -0.150)),
        (4, (0, 1, 2, 3), (19 / 56, 68 / 56, 50 / 56, 68 / 56, 19 / 56), (-9 / 56, -6 / 56, -9 / 56)),
    ],
)
def test_equal_spans_loaded_at_mid_analytic(spans: int, loaded: Numbers, reactions: Numbers, moments: Numbers) -> None:
    """Three-moment equation by hand (5/16, 22/16, 5/16 also in Lindeburg, Civil Engineering Reference Manual)."""
    shaft = Shaft(np.arange(spans + 1.0), np.array(loaded) + 0.5, np.ones((len(loaded), 1)))
    np.testing.assert_allclose(continuous_beam(*shaft)[:, 0], reactions, rtol=0, atol=1e-15)
    np.testing.assert_allclose(moment_at(continuous_beam, shaft, shaft.bearing)[1:-1, 0], moments, rtol=0, atol=1e-15)


@pytest.mark.parametrize(
    ("whole", "reactions", "moments"),
    [
        (8, (3, 10), (1,)),
        (10, (4, 11), (1, 1)),
        (28, (11, 32, 26), (3, 2, 3)),
        (38, (15, 43, 37), (4, 3, 3, 4)),
        (104, (41, 118, 100, 106), (11, 8, 9, 8, 11)),
        (142, (56, 161, 137, 143), (15, 11, 12, 12, 11, 15)),
    ],
)
def test_uniform_load_on_equal_spans_published(whole: int, reactions: Numbers, moments: Numbers) -> None:
    """Hicks, Civil Engineering Formulas, table 2.1 (two to seven spans), here as 400 loads on every span."""
    spans, parts = len(moments) + 1, 400
    position = (np.arange(spans * parts) + 0.5) / parts
    shaft = Shaft(np.arange(spans + 1.0), position, np.full((position.size, 1), whole / parts))
    np.testing.assert_allclose(continuous_beam(*shaft)[: len(reactions), 0], reactions, rtol=1e-5)
    np.testing.assert_allclose(-moment_at(continuous_beam, shaft, shaft.bearing)[1:-1, 0], moments, rtol=1e-5)


@MODELS
@given(shaft=shafts())
def test_bearings_balance_force_and_couple(model: Model, shaft: Shaft) -> None:
    scheme = model(*shaft)
    scale = load_scale(shaft, scheme)
    assert_close(scheme.sum(axis=0), shaft.load.sum(axis=0), scale)
    centre = shaft.bearing.mean()
    arm = np.ptp(shaft.bearing) + 2.0
    assert_close((shaft.bearing - centre) @ scheme, (shaft.position - centre) @ shaft.load, scale * arm)


@given(shafts((2, 2)))
def test_two_bearings_are_one_model(shaft: Shaft) -> None:
    assert np.array_equal(simple_spans(*shaft), continuous_beam(*shaft))


@MODELS
@given(shaft=shafts(), factor=st.floats(1e-3, 1e3), angle=st.floats(0.0, 7.0), data=st.data())
def test_superposed_mirrored_scaled_turned_and_shuffled(
    model: Model, shaft: Shaft, factor: float, angle: float, data: st.DataObject
) -> None:
    """Bearing loads add, turn and grow with the loads, know no unit of length, no left and right, no order."""
    bearing, position, load = shaft
    scheme, turn = model(*shaft), factor * np.exp(1j * angle)
    # places are rounded anew: one part in 1e16 of 10 m, on a span of 0.05 m
    scale = LEVER**2 * load_scale(shaft, scheme)
    assert_close(model(bearing, position[1:], load[1:]) + model(bearing, position[:1], load[:1]), scheme, scale)
    assert_close(model(-bearing, -position, load), scheme, scale)
    assert_close(model(factor * bearing, factor * position, load), scheme, scale)
    assert_close(model(bearing, position, turn * load) / turn, scheme, scale)
    assert_close(model(bearing, position, load.real) + 1j * model(bearing, position, load.imag), scheme, scale)
    order, loads = np.argsort(bearing), data.draw(st.permutations(range(position.size)))
    assert_close(model(bearing[order], position[loads], load[loads]), scheme[order], scale)


@MODELS
@given(shaft=shafts())
def test_no_origin_is_far(model: Model, shaft: Shaft) -> None:
    """A shift by 1e6 m rounds the places themselves to 1e-10 m; a shift that rounds nothing costs not a bit."""
    scheme, far = model(*shaft), model(shaft.bearing + 1e6, shaft.position + 1e6, shaft.load)
    assert_close(far, scheme, load_scale(shaft, scheme), 1e-8)
    bearing, position = np.unique(np.round(shaft.bearing * 64) / 64), np.round(shaft.position * 64) / 64
    shifted = model(bearing + 2.0**20, position + 2.0**20, shaft.load)
    assert np.array_equal(shifted, model(bearing, position, shaft.load))


def macaulay(shaft: Shaft) -> Any:
    """Influence (B, L) from the deflection of the whole shaft, in 60 digits; knows no spans and no support moments.

    E I v(s) = c0 + c1 s + sum R <s - x>^3 / 6 - sum P <s - z>^3 / 6 with v = 0 at every bearing, and balance.
    """

    def rows(place: Any) -> Any:
        return np.vstack([np.maximum(x[:, None] - place, 0) ** 3 / 6, 0 * place + 1, place])

    with mpmath.workdps(60):
        x, z = (np.array([mpmath.mpf(float(plane)) for plane in places]) for places in shaft[:2])
        constants = np.vstack([np.column_stack([0 * x + 1, x]), np.zeros((2, 2))])
        system = mpmath.matrix(np.hstack([rows(x), constants]).tolist())
        solution = mpmath.inverse(system) * mpmath.matrix(rows(z).tolist())
    return np.array(solution.tolist(), dtype=float)[: x.size]


UNEQUAL = Shaft(np.array([0.0, 1e-4, 1.0, 11.0, 11.001, 50.0]), np.array([-1.0, 5e-5, 0.4, 3.0, 11.0005, 51.0]), None)


@given(shafts())
@example(UNEQUAL)
def test_continuous_beam_independent_deflection(shaft: Shaft) -> None:
    expected = macaulay(shaft)
    influence = continuous_beam_influence(shaft.bearing, shaft.position)
    assert np.all(np.abs(influence - expected) <= 1e-12 * (1.0 + np.max(np.abs(expected), axis=0)))


def test_moment_of_simple_beams_analytic() -> None:
    """P l / 4 under a midspan load, in the direction of the load; -P c over a bearing with an overhang c."""
    sagging = moment_at(simple_spans, Shaft(np.array([0.0, 2.0]), np.array([1.0]), np.array([[3j]])), [0.0, 0.5, 1.0])
    np.testing.assert_allclose(sagging[:, 0], [0, 0.75j, 1.5j], atol=1e-15)
    shaft = Shaft(np.array([0.0, 2.0]), np.array([2.5]), np.array([[4.0]]))
    hogging = moment_at(simple_spans, shaft, [0.0, 1.0, 2.0, 2.25, 2.5, 9.0])
    np.testing.assert_allclose(hogging[:, 0], [0, -1, -2, -1, 0, 0], atol=1e-15)


@given(shafts((3, 7)))
def test_support_moments_fulfil_the_three_moment_equation(shaft: Shaft) -> None:
    """As an integral: no kink at bearing i and no deflection there and at its neighbours, so that the moment times
    the hat function of bearing i integrates to zero."""
    x = np.sort(shaft.bearing)
    corners = np.unique(np.concatenate([x, np.clip(shaft.position, x[0], x[-1])]))
    # Simpson is exact for the product of two straight pieces
    stations = np.stack([corners[:-1], 0.5 * (corners[1:] + corners[:-1]), corners[1:]])
    weights = np.array([[1], [4], [1]]) * np.diff(corners) / 6
    moment = moment_at(continuous_beam, shaft, stations.ravel())
    for i in range(1, x.size - 1):
        hat = np.interp(stations, x[i - 1 : i + 2], [0.0, 1.0, 0.0])
        assert_close((weights * hat).ravel() @ moment, moment[0] * 0, moment_scale(continuous_beam, shaft) * np.ptp(x))


@MODELS
@given(shaft=shafts())
def test_moment_vanishes_beyond_the_ends_and_at_hinges(model: Model, shaft: Shaft) -> None:
    """Beyond the ends exactly, so that no rounding error of the bearing loads is drawn on a free end."""
    places = np.concatenate([shaft.bearing, shaft.position])
    assert not np.any(moment_at(model, shaft, [places.min() - 1.0, places.min(), places.max(), places.max() + 1e3]))
    hinges = moment_at(simple_spans, shaft, np.sort(shaft.bearing)[1:-1])
    assert np.all(np.abs(hinges) <= 1e-12 * moment_scale(simple_spans, shaft))


@MODELS
@given(shaft=shafts(), station=st.floats(-4.0, 17.0))
def test_moment_is_the_couple_of_the_forces_on_either_side(model: Model, shaft: Shaft, station: float) -> None:
    arm = np.concatenate([shaft.bearing, shaft.position]) - station
    force = np.concatenate([-model(*shaft), shaft.load])
    bending, scale = moment_at(model, shaft, [station])[0], 20.0 * load_scale(shaft, model(*shaft))
    assert_close(np.minimum(arm, 0.0) @ force, bending, scale)
    assert_close(-np.maximum(arm, 0.0) @ force, bending, scale)


@MODELS
def test_slope_of_the_moment_jumps_by_loads_and_bearing_loads(model: Model) -> None:
    """Analytic: no jump of M itself; dM/ds falls by P at a load, rises by R at a bearing, is constant elsewhere."""
    rng = np.random.default_rng(5)
    shaft = Shaft(np.array([0.0, 1.0, 1.6, 3.0]), np.array([-0.5, 0.4, 1.3, 2.2, 3.7]), rng.normal(size=(5, 2)) + 1j)
    reaction, step = model(*shaft), 1e-3
    place, jump = np.concatenate([shaft.position, shaft.bearing, [0.7]]), np.vstack([-shaft.load, reaction, [0, 0]])
    before, at, after = (moment_at(model, shaft, place + shift) for shift in (-step, 0.0, step))
    np.testing.assert_allclose((after - 2 * at + before) / step, jump, atol=1e-9)


@MODELS
def test_leading_axes_equal_a_loop(model: Model) -> None:
    rng = np.random.default_rng(3)
    bearing = rng.permuted(np.cumsum(rng.uniform(0.2, 1.0, (4, 1, 5)), axis=-1), axis=-1)
    position, stations = rng.uniform(-0.5, 5.0, (3, 6)), rng.uniform(-1.0, 5.0, (4, 3, 8))
    load = rng.normal(size=(4, 3, 6, 7)) + 1j * rng.normal(size=(4, 3, 6, 7))
    scheme = model(bearing, position, load)
    moment = bending_moment(bearing, scheme, position, load, stations)
    assert (scheme.shape, moment.shape) == ((4, 3, 5, 7), (4, 3, 8, 7))
    for i, j in np.ndindex(4, 3):
        actual_model = model(bearing[i, 0], position[j], load[i, j])
        assert_close(scheme[i, j], actual_model, 10.0)
        expected = bending_moment(bearing[i, 0], actual_model, position[j], load[i, j], stations[i, j])
        assert_close(moment[i, j], expected, 10.0)


@INFLUENCES
@given(shafts())
def test_moments_of_unit_loads_are_those_of_loads_one_by_one(influence: Any, shaft: Shaft) -> None:
    # independent: the moment of any loads, given those of one unit of load in each plane
    reaction = influence(shaft.bearing, shaft.position)
    stations = np.sort(np.concatenate([shaft.bearing, shaft.position, shaft.position + 0.1]))
    unit = np.eye(shaft.position.size)
    expected = bending_moment(shaft.bearing, reaction + 0j, shaft.position, unit + 0j, stations).real
    assert_close(unit_bending_moment(shaft.bearing, reaction, shaft.position, stations), expected, LEVER)


@MODELS
def test_shapes(model: Model) -> None:
    """One shaft for many loads, many shafts for one load; axes of length zero and one stay."""
    bearing, position, load = np.array([0.0, 1.0, 2.5]), np.array([0.5, 2.0]), np.ones((2, 4), complex)
    assert model(bearing, position, np.stack([load] * 9)).shape == (9, 3, 4)
    assert model(np.stack([bearing] * 9), position, load).shape == (9, 3, 4)
    assert model(bearing, np.stack([position] * 9), load).shape == (9, 3, 4)
    assert np.array_equal(model(bearing, np.zeros(0), np.zeros((0, 4))), np.zeros((3, 4)))
    assert model(bearing, np.zeros(1), np.zeros((1, 0))).shape == (3, 0)
    assert model(np.zeros((0, 3)), np.zeros(1), np.zeros((1, 4))).shape == (0, 3, 4)
    assert bending_moment(bearing, np.ones((3, 1)), np.zeros(1), np.ones((1, 1)), np.zeros(0)).shape == (0, 1)


FEW: list[Any] = [0.3, [], [0.3], [[0.3], [0.4]]]
COINCIDENT: list[Any] = [[1, 1], [0, 2, 0], [0, 1, 1 + 1e-12], [1e6, 1e6 + 1e-10], [[0, 1], [1, 1]], [0, np.nan]]


@MODELS
@pytest.mark.parametrize(
    ("sentence", "bearing"),
    [("two bearings at least", places) for places in FEW] + [("in the same place", places) for places in COINCIDENT],
)
def test_too_few_or_coincident_bearings_are_refused(model: Model, sentence: str, bearing: Any) -> None:
    with pytest.raises(ValueError, match=sentence):
        model(np.array(bearing), np.array([0.3]), np.ones((1, 1)))
