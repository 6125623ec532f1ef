"""Forces of the rows of many designs, a few designs at a time, against those of each design by itself."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from optimizer.mechanics.gas import switching_angles
from optimizer.mechanics.indicated import Trace
from optimizer.mechanics.reading import Reading
from optimizer.mechanics.row_data import RowData, row_data
from optimizer.mechanics.whole_turn import WholeTurn, break_angles, whole_turn
from optimizer.numerics.arrays import Real
from tests import night
from tests.analyze.driven import STYLES, arrays, random_driven

#: more than one block, of which the last is less than full
DESIGNS = 37
READINGS: tuple[Reading, ...] = ("tangential", "piston", "rod_without_gas", "on_shaft")
#: what differs between the designs, in the first row alone
VARIED = ("rod", "pressure", "mass", "area", "nothing")


def _turn(seed: int, style: str) -> WholeTurn:
    plan, data = arrays(random_driven(seed, style))
    friction = np.full(plan.reciprocating.mass.shape, 3e3)
    return whole_turn(row_data(plan, True, friction, data), break_angles(plan, switching_angles(data, plan, True)))


def _of_many(values: Real, factor: Real) -> Real:
    """Values (1, R, ...) of every design, those of the first row times a factor (N,)."""
    result = np.repeat(values, len(factor), axis=0)
    result[:, 0] *= factor.reshape(-1, *(1,) * (values.ndim - 2))
    return result


def _varied(rows: RowData, column: str, factor: Real) -> RowData:
    if column == "rod":
        ratio = _of_many(rows.rod_ratio, factor)
        return replace(rows, designs=len(factor), rod_ratio=ratio, rod_margin=1.0 - ratio)
    name = {"pressure": "suction", "mass": "inertia", "area": "area", "nothing": None}[column]
    some = {} if name is None else {name: _of_many(getattr(rows, name), factor)}
    return replace(rows, designs=len(factor), **some)


def _designs(turn: WholeTurn, column: str, moved: float, generator: np.random.Generator) -> WholeTurn:
    """Designs some pieces of which differ in a share of the designs."""
    rows = _varied(turn.rows, column, generator.uniform(0.9, 1.0, DESIGNS))
    centre, half = (np.repeat(array, DESIGNS, axis=0) for array in (turn.centre, turn.half))
    narrow = generator.random(half.shape) < moved
    half[narrow] *= generator.uniform(0.3, 1.0, np.count_nonzero(narrow))
    return WholeTurn(rows, centre, half, readings=READINGS)


@settings(deadline=None, max_examples=150 if night.ALL else 12)
@given(st.integers(0, 10**6), st.sampled_from(STYLES), st.sampled_from(VARIED), st.sampled_from([0.0, 0.02, 1.0]))
def test_many_designs_have_the_curves_of_each(seed: int, style: str, column: str, moved: float) -> None:
    generator = np.random.default_rng(seed)
    every = _designs(_turn(seed, style), column, moved, generator)
    count = every.rows.crank_radius.shape[-1]
    for reading in READINGS:
        weights = generator.normal(size=(DESIGNS, 2, count)) + 1j * generator.normal(size=(DESIGNS, 2, count))
        curves = every.curves(reading, weights, 5.0)
        assert every.forces is not None
        for n in (0, 1, 9, DESIGNS - 1):
            # independent: by what forces of one machine are made of
            alone = curves.of_designs(slice(n, n + 1))
            assert alone.whole.forces is None
            own = slice(2 * n, 2 * n + 2)
            for name in ("cubic", "rest", "size"):
                part = getattr(curves.pieces, name)[own]
                np.testing.assert_array_equal(part, getattr(alone.pieces, name), err_msg=f"{reading} {name}")


def test_designs_with_tables_of_their_own_differ() -> None:
    # independent: each design by itself
    turn = _turn(1, STYLES[0])
    angle = np.array([np.linspace(0.0, 2.0 * np.pi, 9)])
    pressure = np.concatenate([np.linspace(1e5, 5e5, 9)[None], np.linspace(2e5, 9e5, 9)[None]])
    table = np.arange(DESIGNS) % 2
    trace = Trace(0, 0, 1, np.repeat(angle, 2, axis=0), pressure, table, np.zeros(1))
    rows = replace(turn.rows, designs=DESIGNS, traces=(trace,))
    centre, half = (np.repeat(array, DESIGNS, axis=0) for array in (turn.centre, turn.half))
    curves = WholeTurn(rows, centre, half, readings=("piston",)).of_rows("piston")
    count = rows.crank_radius.shape[-1]
    for n in range(2):
        alone = curves.of_designs(slice(n, n + 1))
        np.testing.assert_array_equal(curves.pieces.cubic[n * count : (n + 1) * count], alone.pieces.cubic)
    assert curves.pieces.cubic[0] != pytest.approx(curves.pieces.cubic[count])


def test_readings_that_nobody_foretold_are_made_by_themselves() -> None:
    turn = _designs(_turn(2, STYLES[0]), "rod", 0.0, np.random.default_rng(0))
    curves = turn.of_rows("side")
    # independent: each design by itself
    np.testing.assert_array_equal(
        curves.pieces.rest[: curves.weights.shape[1]], curves.of_designs(slice(0, 1)).pieces.rest
    )


def test_what_mean_squares_are_asked_of_is_bounded_to_a_higher_order() -> None:
    turn = _designs(_turn(2, STYLES[0]), "rod", 0.0, np.random.default_rng(0))
    assert turn.forces is not None
    assert replace(turn, squared=True).forces is None
    assert replace(turn, readings=()).forces is None
