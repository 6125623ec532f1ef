"""From numbers to designs: the same whatever the range asked for, and what each design promises."""

from itertools import pairwise, product

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from optimizer.studies.sweep.designs import axis_values, permuted, uniform
from schemas.sweep.request import SweepRequest
from tests.studies.sweep.single import example, sweep

SPEED, MASS = "/machine/speed_rpm", "/machine/webs/0/max_mass_kg"
CEILING = "/objective/force_ceiling_N"
DESIGNS = [
    {"design": "grid"},
    {"design": "paired"},
    {"design": "latin_hypercube", "samples": 36, "seed": 3},
]


def three(**rest: object) -> SweepRequest:
    paired = rest.get("design") == "paired"
    return sweep(
        example("2d12"),
        {"path": SPEED, "start": 100, "stop": "10 Hz", "count": 36 if paired else 3},
        {"path": MASS, "values": [5, "20 kg", 60, 10] * (9 if paired else 1)},
        {"path": CEILING, "values": [None, 1000, "2 kN"] * (12 if paired else 1)},
        **rest,
    )


@pytest.mark.parametrize("design", DESIGNS)
@given(cuts=st.lists(st.integers(0, 36), max_size=4))
def test_values_do_not_depend_on_the_chunks(design: dict[str, object], cuts: list[int]) -> None:
    request = three(**design)
    whole = axis_values(request, 0, request.total)
    edges = sorted({0, request.total, *cuts})
    parts = [axis_values(request, a, b) for a, b in pairwise(edges)]
    for number, column in enumerate(whole):
        np.testing.assert_array_equal(np.concatenate([part[number] for part in parts]), column)


def test_a_grid_counts_like_nested_loops() -> None:
    # analytic: the last axis is the innermost loop
    actual_axis_values = np.stack(axis_values(three(design="grid"), 0, 36), axis=-1)
    expected = list(product([100.0, 350.0, 600.0], [5.0, 20.0, 60.0, 10.0], [np.nan, 1000.0, 2000.0]))
    np.testing.assert_array_equal(actual_axis_values, expected)


def test_paired_axes_go_side_by_side() -> None:
    speed, mass, ceiling = axis_values(three(design="paired"), 0, 36)
    np.testing.assert_allclose(speed, np.linspace(100.0, 600.0, 36), rtol=1e-15)
    assert mass.tolist() == [5.0, 20.0, 60.0, 10.0] * 9
    np.testing.assert_array_equal(ceiling, [np.nan, 1000.0, 2000.0] * 12)


@pytest.mark.parametrize("spacing", ["linear", "log"])
def test_ranges_hold_their_ends_exactly(spacing: str) -> None:
    axis = {"path": SPEED, "start": 0.1, "stop": 699.7, "count": 7, "spacing": spacing}
    (speed,) = axis_values(sweep(example("2d12"), axis), 0, 7)
    assert (speed[0], speed[-1]) == (0.1, 699.7)
    # analytic: equal differences, or equal quotients
    steps = np.diff(speed) if spacing == "linear" else speed[1:] / speed[:-1]
    np.testing.assert_allclose(steps, steps[0], rtol=1e-12)


def test_a_range_of_one_value_is_its_start() -> None:
    (speed,) = axis_values(sweep(example("2d12"), {"path": SPEED, "start": 300, "stop": 500, "count": 1}), 0, 1)
    assert speed.tolist() == [300.0]


@given(count=st.integers(1, 3000), seed=st.integers(0, 2**63 - 1), axis=st.integers(0, 63))
def test_permutations_hold_every_number_once(count: int, seed: int, axis: int) -> None:
    values = permuted(np.arange(count), count, seed, axis)
    np.testing.assert_array_equal(np.sort(values), np.arange(count))


def test_a_place_of_a_huge_permutation_costs_only_itself() -> None:
    some = permuted(np.array([0, 1, 9_999_999]), 10_000_000, 1, 0)
    assert len(set(some.tolist())) == 3
    assert permuted(np.array([9_999_999]), 10_000_000, 1, 0)[0] == some[2]


@pytest.mark.parametrize("count", [4, 50])
def test_permutations_of_different_seeds_are_unrelated(count: int) -> None:
    # analytic: the correlation of two random permutations has mean 0 and variance 1 / (n - 1)
    many = np.stack([permuted(np.arange(count), count, seed, seed % 5) for seed in range(300)])
    correlation = np.corrcoef(many)[np.triu_indices(300, 1)]
    assert abs(np.mean(correlation)) < 0.02
    assert np.var(correlation) * (count - 1) == pytest.approx(1.0, rel=0.1)


@pytest.mark.parametrize("samples", [1, 2, 7, 36, 1000])
def test_a_latin_hypercube_has_one_design_in_every_stratum(samples: int) -> None:
    axes = [{"path": SPEED, "start": 100, "stop": 600}, {"path": MASS, "start": 60, "stop": 5}]
    request = sweep(example("2d12"), *axes, design="latin_hypercube", samples=samples, seed=9)
    for column, (low, high) in zip(axis_values(request, 0, samples), [(100, 600), (5, 60)], strict=True):
        strata = np.floor((column - low) / (high - low) * samples).astype(int)
        np.testing.assert_array_equal(np.sort(strata), np.arange(samples))


def test_levels_of_a_latin_hypercube_come_equally_often() -> None:
    request = three(design="latin_hypercube", samples=120)
    for column, levels in zip(axis_values(request, 0, 120), (3, 4, 3), strict=True):
        values, counts = np.unique(column, return_counts=True)
        assert values.size == levels
        assert set(counts.tolist()) == {120 // levels}


def test_seeds_and_axes_differ() -> None:
    axes = [{"path": SPEED, "start": 0.1, "stop": 1}, {"path": MASS, "start": 0.1, "stop": 1}]
    first, second = (
        axis_values(sweep(example("2d12"), *axes, design="latin_hypercube", samples=200, seed=seed), 0, 200)
        for seed in (0, 1)
    )
    for a, b in ((first[0], second[0]), (first[0], first[1]), (first[1], second[1])):
        assert abs(np.corrcoef(a, b)[0, 1]) < 0.25


def test_uniform_numbers_fill_the_unit_interval() -> None:
    number = uniform(0, 100_000, 4, 2)
    assert number.min() >= 0.0
    assert number.max() < 1.0
    # analytic: mean 1/2 and variance 1/12
    assert number.mean() == pytest.approx(0.5, abs=0.005)
    assert number.var() == pytest.approx(1 / 12, rel=0.02)
    np.testing.assert_array_equal(number[13:29], uniform(13, 29, 4, 2))
