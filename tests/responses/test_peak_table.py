"""Peaks by search, as arrays and in plain numbers."""

import numpy as np

from optimizer.responses.peak_table import PeakTable
from optimizer.responses.piecewise_cubics import Bracket


def _bracket(lower: list[float], width: float = 0.0) -> Bracket:
    values = np.array(lower)
    return Bracket(np.deg2rad(10.0 * np.arange(values.size)), values.astype(complex), values, values + width)


def test_rows_of_a_search_are_the_same_both_ways() -> None:
    # analytic
    table = PeakTable()
    table.add({("first",): slice(1), ("second",): slice(1, 5)}, _bracket([7.0, 1.0, 2.0, 3.0, 4.0], 0.5))
    table.add({("third",): slice(None)}, _bracket([9.0]))
    assert ("first",) in table
    assert ("fourth",) not in table
    np.testing.assert_array_equal(table.brackets(("second",)).lower, [1.0, 2.0, 3.0, 4.0])
    high, low = table.plain(("second",)).split(2)
    assert (high.lower, low.upper) == ([1.0, 2.0], [3.5, 4.5])
    np.testing.assert_allclose(high.angle_deg, [10.0, 20.0], rtol=1e-14)
    assert table.plain(("third",)).bracket() == (9.0, 9.0)
    assert [part.lower for part in table.plain(("third",)).part(slice(0)).split(2)] == [[], []]


def test_a_table_is_closed_where_all_brackets_are() -> None:
    # analytic: the second is wider than a thousandth of its larger end
    table = PeakTable()
    assert table.is_closed(0.0)
    table.add({("first",): slice(None)}, _bracket([-2000.0, 1000.0], 0.9))
    assert table.is_closed(1e-3)
    table.add({("second",): slice(None)}, _bracket([800.0], 0.9))
    assert not table.is_closed(1e-3)
    table.clear()
    assert table.is_closed(0.0)
    assert ("first",) not in table
