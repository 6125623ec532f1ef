"""What a machine decides by itself where a request leaves it open: analytic."""

from math import pi

import pytest

from optimizer.formulation.formulate import with_weights_of
from optimizer.formulation.limits import _force_per_kg
from schemas.machine.reciprocating import ReciprocatingMachine
from schemas.request.objective import Objective
from tests.optimize.machines import machine, row, throw, web
from tests.program.test_problem import problem


def _machine(**more: object) -> ReciprocatingMachine:
    """Planes from -0.4 to 0.5 m."""
    throws = [throw(-0.3, 0.0, [row(0.0, 1.0)]), throw(0.4, 90.0, [row(0.0, 1.0)])]
    webs = [web("a", -0.4, 4.0, 0.1), web("b", 0.5, 4.0, 0.2)]
    return ReciprocatingMachine.model_validate(machine(throws, webs, **more))


def test_a_moment_weighs_as_a_force_at_the_span_of_the_machine() -> None:
    usual = with_weights_of(_machine(), Objective())
    assert (usual.force_weight, usual.moment_weight) == (Objective().force_weight, pytest.approx(1.0 / 0.9, rel=1e-15))
    assert with_weights_of(_machine(), Objective(moment_weight=3.0)).moment_weight == 3.0


def test_a_kilogram_pulls_by_its_radius_and_the_square_of_the_highest_speed() -> None:
    omega = 600.0 * pi / 30.0
    assert _force_per_kg(_machine()) == pytest.approx([0.1 * omega**2, 0.2 * omega**2], rel=1e-14)
    fast = _force_per_kg(_machine(overspeed_rpm=1200.0))
    assert fast == pytest.approx([0.4 * omega**2, 0.8 * omega**2], rel=1e-14)


@pytest.mark.parametrize(("later", "allowance"), [((), 0.0), ((("mass", 0.2),), 0.1)])
def test_what_nothing_comes_after_may_not_be_exceeded(later: tuple[tuple[str, float], ...], allowance: float) -> None:
    """A goal keeps its allowance for those after it; the least mass that always follows has none of it."""
    order = [{"goal": goal, "allowance": part} for goal, part in (("external", 0.1), *later)]
    assert [goal.allowance for goal in problem("v60", priorities=order).goals] == [allowance]
