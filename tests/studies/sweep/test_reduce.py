"""Top and Pareto filters: what they keep, whatever the chunks."""

import numpy as np
import pyarrow as pa
import pytest
from hypothesis import given
from hypothesis import strategies as st

from optimizer.studies.sweep import ParetoFilter, Reducer, Top, reducer
from optimizer.studies.sweep.reduce import TooManyRows, unbeaten
from schemas.sweep.request import SweepRequest, TopFilter
from tests import night
from tests.studies.sweep.single import example, sweep, table

#: few different values, so that there are ties; None has nothing to compare
VALUES = st.one_of(st.none(), st.integers(0, 4).map(float))
POINTS = st.lists(st.tuples(VALUES, VALUES, VALUES), max_size=40)


def as_table(points: list[tuple[float | None, ...]]) -> pa.Table:
    columns = {name: pa.array([point[k] for point in points], pa.float64()) for k, name in enumerate("abc")}
    return pa.table({"index": pa.array(range(len(points)), pa.int64()), **columns})


def reduced(tool: Reducer, whole: pa.Table, cut: int, backwards: bool) -> list[int]:
    parts = [whole.slice(0, cut), whole.slice(cut)]
    for part in reversed(parts) if backwards else parts:
        tool.add(part)
    return tool.table()["index"].to_pylist()  # type: ignore[no-any-return]


def brute_force_front(points: list[tuple[float | None, ...]], size: int) -> list[int]:
    """Independent: the definition, pair by pair."""
    positions = {k: point[:size] for k, point in enumerate(points) if None not in point[:size]}

    def beats(first: tuple[float | None, ...], second: tuple[float | None, ...]) -> bool:
        pairs = list(zip(first, second, strict=True))
        return all(a <= b for a, b in pairs) and any(a < b for a, b in pairs)  # type: ignore[operator]

    return [k for k, point in positions.items() if not any(beats(position, point) for position in positions.values())]


@given(points=POINTS, cut=st.integers(0, 40), backwards=st.booleans(), size=st.sampled_from([2, 3]))
def test_the_front_is_that_of_the_definition(
    points: list[tuple[float | None, ...]], cut: int, backwards: bool, size: int
) -> None:
    whole = as_table(points)
    reduction = reduced(ParetoFilter("abc"[:size], whole.schema), whole, min(cut, len(points)), backwards)
    assert reduction == brute_force_front(points, size)


@given(
    points=POINTS,
    cut=st.integers(0, 40),
    backwards=st.booleans(),
    count=st.integers(1, 12),
    largest=st.booleans(),
)
def test_the_top_is_that_of_sorting(
    points: list[tuple[float | None, ...]], cut: int, backwards: bool, count: int, largest: bool
) -> None:
    whole = as_table(points)
    reduction = reduced(
        Top(TopFilter(by="b", count=count, largest=largest), whole.schema), whole, min(cut, len(points)), backwards
    )
    sign = -1.0 if largest else 1.0
    values = [(sign * point[1], k) for k, point in enumerate(points) if point[1] is not None]
    assert reduction == [k for _, k in sorted(values)[:count]]


@pytest.mark.parametrize("size", [2, 3, 4])
def test_a_front_that_holds_every_point(size: int) -> None:
    # analytic: on a sphere no point is beaten, and a point outside it is by the one in its direction
    rng = np.random.default_rng(size)
    directions = np.abs(rng.normal(size=(1500, size)))
    sphere = 1.0 - directions / np.linalg.norm(directions, axis=1, keepdims=True)
    assert np.all(unbeaten(sphere))
    both = np.concatenate([sphere, sphere + 1e-6])
    assert np.array_equal(unbeaten(both), np.arange(3000) < 1500)


@pytest.mark.parametrize("size", night.part(2, [2, 3, 4, 6]))
@pytest.mark.parametrize("levels", [2, 6, 40])
def test_ties_by_the_hundred(size: int, levels: int) -> None:
    points = np.random.default_rng(size * levels).integers(levels, size=(900, size)).astype(float)
    # independent: the definition, pair by pair
    no_larger = np.all(points[None, :, :] <= points[:, None, :], axis=-1)
    smaller = np.any(points[None, :, :] < points[:, None, :], axis=-1)
    assert np.array_equal(unbeaten(points), ~np.any(no_larger & smaller, axis=-1))


def test_a_long_comparison_can_be_ended() -> None:
    calls = 0

    def proceed() -> None:
        nonlocal calls
        calls += 1
        if calls == 20:
            raise TimeoutError

    with pytest.raises(TimeoutError):
        unbeaten(np.random.default_rng(0).random((5000, 4)), proceed)


def test_no_more_rows_than_may_be_kept() -> None:
    # analytic: what rises in one column falls in the other, so every row is on the front
    rows = as_table([(float(k), -float(k), 0.0) for k in range(100)])
    for most in (99, 100):
        tool = ParetoFilter("ab", rows.schema, most)
        tool.add(rows)
        if most == 100:
            assert tool.table().num_rows == 100
        else:
            with pytest.raises(TooManyRows, match="more than 99 rows"):
                tool.table()


def test_memory_is_that_of_what_is_kept() -> None:
    rng = np.random.default_rng(0)
    top = Top(TopFilter(by="a", count=5), as_table([]).schema)
    front = ParetoFilter("ab", as_table([]).schema)
    for _ in range(20):
        part = as_table([tuple(point) for point in rng.random((500, 3))])
        top.add(part)
        front.add(part)
        assert top.table().num_rows == 5
        assert top.table().nbytes < 5 * 4 * 16
        assert front.table().nbytes < 100 * 4 * 16


def reduced_sweep(**rest: object) -> SweepRequest:
    axis = {"path": "/machine/webs/0/max_mass_kg", "start": -5, "stop": 60, "count": 14}
    ceiling = {"path": "/objective/force_ceiling_N", "values": [None, 2]}
    return sweep(example("2d12"), axis, ceiling, **rest)


def test_rows_without_an_answer_are_not_among_the_best() -> None:
    request = reduced_sweep(top={"by": "moment_peak_Nm", "count": 3})
    rows = table(request)
    tool = reducer(request)
    tool.add(rows)
    best = tool.table().to_pylist()
    moment_peaks_Nm = sorted(row["moment_peak_Nm"] for row in rows.to_pylist() if row["status"] == "optimal")
    assert [row["moment_peak_Nm"] for row in best] == moment_peaks_Nm[:3]
    assert tool.table().schema.equals(rows.schema)


def test_the_front_of_a_sweep() -> None:
    request = reduced_sweep(pareto=["force_peak_N", "total_mass_kg", "moment_peak_Nm"])
    rows = table(request)
    tool = reducer(request)
    tool.add(rows.slice(0, 5))
    tool.add(rows.slice(5))
    names = request.pareto or ()
    points = [tuple(row[name] for name in names) for row in rows.to_pylist()]
    assert tool.table()["index"].to_pylist() == brute_force_front(points, 3)


def test_a_request_that_keeps_all_rows_has_no_reducer() -> None:
    with pytest.raises(ValueError, match="keeps all rows"):
        reducer(reduced_sweep())
