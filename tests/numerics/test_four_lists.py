"""Sums of four lists: enumeration where they are few, and lists of which nothing meets."""

from itertools import product

import numpy as np

from optimizer.numerics import four_lists
from optimizer.numerics.four_lists import nearest_sums


def test_of_few_sums_the_nearest_is_found() -> None:
    """Independent: all sums."""
    lists = list(np.random.default_rng(1).standard_normal((4, 9, 3)))
    values = np.array([0.3, -0.2, 0.1])
    places_of_best = nearest_sums(lists, 0.5 * values, values)
    places = product(*(range(len(numbers)) for numbers in lists))
    every = [sum(numbers[k] for numbers, k in zip(lists, place, strict=True)) for place in places]
    best = min(float(np.sum((total - values) ** 2)) for total in np.array(every))
    sums = sum(numbers[k] for numbers, k in zip(lists, places_of_best, strict=True))
    assert float(np.min(np.sum((sums - values) ** 2, axis=1))) == best
    assert places_of_best.shape == (4, four_lists._NEAREST)


def test_an_empty_list_has_no_sums() -> None:
    some = np.ones((3, 2))
    assert nearest_sums([some, some, np.zeros((0, 2)), some], np.ones(2), np.ones(2)).shape == (4, 0)
