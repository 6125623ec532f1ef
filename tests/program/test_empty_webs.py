"""What may stand for an optimum in which some webs are empty: analytic."""

import numpy as np
import pytest

from optimizer.program.methods.empty_webs import Optimum, _unit
from optimizer.program.points import Points
from tests.program.test_settled import in_planes


def _point(objective: float = 1.0, mass: float = 2.0, excess: float = 0.0) -> Points:
    return Points(np.zeros((1, 2), complex), *(np.array([each]) for each in (objective, mass, excess, 1e-12)))


@pytest.mark.parametrize(
    ("point", "admitted"),
    [
        (_point(), True),
        (_point(objective=1.0 + 0.9e-12), True),
        (_point(objective=1.0 + 1.1e-12), False),
        (_point(mass=2.0 + 1e-12), False),
        (_point(excess=1e-12), False),
        (_point(objective=0.5, mass=1.0, excess=-np.inf), True),
    ],
)
def test_a_point_is_no_worse_than_the_optimum_but_for_the_rounding_of_its_objective(
    point: Points, admitted: bool
) -> None:
    optimum = Optimum(np.array([1.0]), np.array([2.0]), np.array([0.0]), None)
    assert optimum.admits(point).tolist() == [admitted]


def test_webs_that_are_not_alike_are_emptied_one_by_one() -> None:
    program = in_planes([-1.0, 1.0, 0.3]).alone()
    assert [_unit(program, web).tolist() for web in range(3)] == np.eye(3, dtype=bool).tolist()
