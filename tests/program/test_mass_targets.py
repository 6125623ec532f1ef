"""A bound on the mass holds for all that come to no more than a largest objective: which point it says something of."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from optimizer.program.certificate import Multipliers, mass_lower_bound
from optimizer.program.methods.cascade import _better_of
from optimizer.program.methods.optima import optima
from optimizer.program.solution import ConeSolution
from tests.hard.bodies import drawn, tried
from tests.program.cases import COMBINATIONS, random_statement

_SHARE = 1.0


def _solution(objective: float, mass: float, bound: float, target: float) -> ConeSolution:
    nothing = Multipliers(np.zeros(0, complex), np.zeros(0), np.zeros(0, complex))
    return ConeSolution(np.zeros(0), objective, 0.0, mass, bound, -np.inf, nothing, mass_target=target)


def test_a_lighter_point_beyond_the_target_of_a_proof_does_not_take_it_over() -> None:
    """Regression: the bound of the heavier one was above the mass of the lighter one, a contradiction of no account."""
    lighter, proven = _solution(0.9, 18.1522, 17.9, 0.95), _solution(0.8, 18.1551, 18.1539, 0.83)
    for solution in (_better_of(lighter, proven, _SHARE), _better_of(proven, lighter, _SHARE)):
        assert (solution.mass, solution.mass_lower_bound, solution.mass_target) == (18.1551, 18.1539, 0.83)


def test_a_proof_that_counts_both_goes_to_the_lighter_one() -> None:
    lighter, proven = _solution(0.9, 18.1541, 17.9, 0.95), _solution(0.8, 18.1551, 18.1539, 0.95)
    solution = _better_of(lighter, proven, _SHARE)
    assert (solution.mass, solution.mass_lower_bound, solution.objective) == (18.1541, 18.1539, 0.9)


def test_a_contradiction_is_not_passed_over() -> None:
    """A proof that counts a point which is lighter than its bound is chosen, so that it is said."""
    lighter, false = _solution(0.9, 18.0, 17.9, 0.95), _solution(0.8, 18.2, 18.1, 0.95)
    solution = _better_of(lighter, false, _SHARE)
    assert (solution.mass, solution.mass_lower_bound) == (18.0, 18.1)


_SOLUTIONS = st.builds(
    lambda objective, mass, gap, room: _solution(objective, mass, mass - gap, objective + room),
    st.floats(0.0, 1.0),
    st.floats(1.0, 2.0),
    st.floats(0.0, 1.0),
    st.floats(0.0, 1.0),
)


@given(_SOLUTIONS, _SOLUTIONS)
def test_of_two_optima_the_proof_counts_what_it_goes_with(first: ConeSolution, second: ConeSolution) -> None:
    solution = _better_of(first, second, _SHARE)
    assert solution.objective <= solution.mass_target
    assert solution.mass - solution.mass_lower_bound <= min(
        minimum.mass - minimum.mass_lower_bound for minimum in (first, second)
    )


@pytest.mark.parametrize("case", COMBINATIONS[::5])
def test_a_larger_target_is_proven_by_the_same_multipliers(case: tuple) -> None:
    """Independent: the bound of these multipliers at that target, evaluated in full."""
    program = random_statement(7, *case).alone()
    body = optima(program, 1e-6, True)
    assert body.counting(program, body.objective) is body
    for more in (0.01, 0.3):
        objective = body.mass_target + more * program.at_rest
        counted = body.counting(program, objective)
        assert counted.mass_target == objective
        bound = mass_lower_bound(program, body.mass_multipliers, objective)
        assert counted.mass_lower_bound == pytest.approx(bound, rel=1e-9, abs=1e-12)
    nothing = replace(body, mass_target=np.array([np.inf]))
    assert nothing.counting(program, body.objective) is nothing


@pytest.mark.nightly
def test_plates_that_were_contradicted() -> None:
    """Regression: a cut beyond the target of the proof beside it was called a fault of the service, and is an optimum.

    A ceiling of nothing is kept to rounding, which is worth a tenth of what optima may differ by here.
    """
    body = drawn(519, 31, "plates")
    assert tried(519, 31, "plates") == "optimal", body
