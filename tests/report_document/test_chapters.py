"""Parts of chapters by themselves: listings as JSON, scales of rounding, figures in words (analytic)."""

import json
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from optimizer.optimize import optimize
from schemas.answer.outputs import OrdersComparison
from service.report.blocks import Number, Paragraph, Table, angle, extremes, figure_beside, turns_of
from service.report.chapters.orders import orders
from service.report.chapters.reproduction import _lines
from tests.report_document.conftest import request_of

_VALUES = st.recursive(
    st.none() | st.booleans() | st.integers(-999, 999) | st.text("abcdefgh", max_size=30),
    lambda inner: (
        st.lists(inner, max_size=6) | st.dictionaries(st.text("xyz", min_size=1, max_size=5), inner, max_size=6)
    ),
    max_leaves=30,
)


@given(_VALUES, st.integers(20, 90))
def test_a_listing_is_the_json_that_it_lists(value: Any, room: int) -> None:
    """Property: read again it is the same, in lines that are no longer than what cannot be broken up."""
    lines = list(_lines(value, room))
    assert json.loads("\n".join(lines)) == value
    whole = json.dumps(value, sort_keys=True)
    if len(whole) <= room:
        assert lines == [whole]
    # a text that is longer than the room, with its name, brackets and commas
    assert max(map(len, lines)) <= max(room + 1, 30 + 5 + 20)
    assert all(line.strip() for line in lines)


def _comparison(force: float, moment: float) -> OrdersComparison:
    """Two orders of the 2D12; of the second the peaks, and of the first the scales, are put down by hand."""
    comparison = optimize(request_of("2d12", outputs=["orders"]).alone).orders
    assert comparison is not None
    first, second = comparison.before[:2]

    def with_peaks(order: Any, of_force: float, of_moment: float) -> Any:
        changes = {
            "force": order.force.model_copy(update={"peak_N": of_force}),
            "moment": order.moment.model_copy(update={"peak_Nm": of_moment}),
        }
        return order.model_copy(update=changes)

    return comparison.model_copy(
        update={"before": (with_peaks(first, 1e6, 1.0), with_peaks(second, force, moment)), "after": None}
    )


@pytest.mark.parametrize(
    ("force", "moment", "texts"),
    # a millionth of the first order's own force or moment is what rounding leaves
    [(2e3, 0.5, ("2000", "0.5")), (0.9, 0.5, ("0", "0.5")), (2e3, 0.9e-6, ("2000", "0"))],
)
def test_orders_are_settled_by_force_and_moment_of_the_first(
    force: float, moment: float, texts: tuple[str, str]
) -> None:
    chapter = orders(_comparison(force, moment))
    (listed,) = (block for block in chapter.blocks if isinstance(block, Table))
    row = next(row for row in listed.rows if row[0] == "2")
    assert [cell.text if isinstance(cell, Number) else cell for cell in row] == ["2", texts[0], "–", texts[1], "–"]
    assert not any("thousandth" in block.text for block in chapter.blocks if isinstance(block, Paragraph))


@pytest.mark.parametrize(
    ("figure", "scale", "gap", "text"),
    [(None, 1.0, 0.0, "–"), (0.9e-6, 1.0, 0.0, "0"), (-0.9e-6, -1.0, 0.0, "0"), (1.1e-6, 1.0, 0.0, "1.1e-06"),
     (0.02, 1.0, 0.031, "< 0.04"), (0.031, 1.0, 0.031, "0.031"), (-0.02, 1.0, 0.031, "-0.02"),
     (0.02, 1.0, 0.03, "< 0.03")],
)  # fmt: skip
def test_what_rounding_leaves_is_nothing_and_what_a_gap_outweighs_is_below_it(
    figure: float | None, scale: float, gap: float, text: str
) -> None:
    cell = figure_beside(figure, scale, gap)
    assert (cell.text if isinstance(cell, Number) else cell) == text


@pytest.mark.parametrize(
    ("angle_deg", "text"), [(None, "–"), (12.34567, "12.3457"), (359.99999, "0"), (-359.99999, "0"), (359.9999, "0")]
)
def test_angles_are_told_to_a_ten_thousandth(angle_deg: float | None, text: str) -> None:
    cell = angle(angle_deg)
    assert (cell.text if isinstance(cell, Number) else cell) == text


def test_extremes_stand_where_they_are_first() -> None:
    table = extremes(
        "", [0.0, 10.0, 20.0, 30.0], [("a", [1.0, 5.0, None, 5.0]), ("b", [None] * 4), ("c", [2.0, 2.0, 1.0, 1.0])]
    )
    rows = [[cell.value if isinstance(cell, Number) else cell for cell in row] for row in table.rows]
    assert rows == [["a", 5.0, 10.0, 1.0, 0.0], ["b", *4 * ["–"]], ["c", 2.0, 0.0, 1.0, 20.0]]


@pytest.mark.parametrize(("last", "turns"), [(350.0, 1), (359.99, 1), (360.0, 2), (710.0, 2)])
def test_samples_go_over_one_turn_or_two(last: float, turns: int) -> None:
    assert turns_of([0.0, last]) == turns
    assert turns_of([]) == 1
