"""What counts the strata of a hypercube finds them all, and finds what is wrong."""

import numpy as np
import pytest

from optimizer.studies.sweep.designs import axis_values
from tests.benchmarks.hypercube import Strata, request


@pytest.mark.parametrize("samples", [1, 64, 10_007])
def test_every_stratum_of_twelve_axes_holds_one_design(samples: int) -> None:
    sampled = request(samples, 12)
    whole = axis_values(sampled, 0, samples)
    assert len(whole) == 12
    for number, column in enumerate(whole):
        axis = Strata(samples)
        for first in range(0, samples, 1000):
            part = axis_values(sampled, first, min(first + 1000, samples))[number]
            np.testing.assert_array_equal(part, column[first : first + 1000])
            axis.add(part)
        assert axis.wrong == 0


def test_two_designs_in_one_stratum_are_found() -> None:
    # analytic: strata 0, 1, 1 and 3 of four; one is empty and one has two
    axis = Strata(4)
    axis.add(1.0 + np.array([0.5, 1.2, 1.7, 3.5]) / 4)
    assert axis.wrong == 2


def test_a_design_on_a_border_belongs_to_the_stratum_that_is_free() -> None:
    axis = Strata(4)
    axis.add(1.0 + np.array([0.5, 1.5, 2.0, 3.0]) / 4)
    assert axis.wrong == 0
