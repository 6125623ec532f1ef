"""Work of the rows in closed form: what their torque integrates to, and what a flywheel takes up of it."""

from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest

from optimizer.effects.registry import run
from optimizer.mechanics.indicated import TURN
from optimizer.mechanics.kernel.crossings import _slope
from optimizer.mechanics.layout import layout
from optimizer.mechanics.row_work import RowWork
from optimizer.mechanics.turn import Turn, fluctuation, mean, panels
from optimizer.mechanics.whole_turn import WholeTurn, break_angles
from optimizer.numerics.arrays import Real
from schemas.machine.reciprocating import ReciprocatingMachine
from schemas.request.scene import Fidelity
from tests.analyze.driven import STYLES, random_driven


@dataclass(frozen=True)
class Case:
    """One machine: the work of its rows, their torque, and the angles between which that is smooth."""

    work: RowWork
    whole: WholeTurn
    breaks: Real

    def panels(self) -> Turn:
        return panels(self.breaks, np.deg2rad(5.0))

    def torque(self, turn: Turn) -> Real:
        """Of all rows, at the nodes of panels, N m."""
        total: Real = np.sum(self.whole.rows.crank_radius.T * self.whole.tangential(turn)[0], axis=0)
        return total


def case(seed: int, style: str, rod_ratio: float | None = None, **rest: Any) -> Case:
    body = random_driven(seed, style, **rest)
    for throw in body["throws"]:
        for row in throw["rows"]:
            if rod_ratio is not None:
                row["connecting_rod"]["length_m"] = throw["crank_radius_m"] / rod_ratio
    machine = ReciprocatingMachine.model_validate(body)
    plan = layout(machine)
    effects = run(machine, plan, ("gas", "friction", "whole_turn"), Fidelity(), np.zeros(1))
    friction = effects["friction"].magnitude if "friction" in effects else None
    return Case(
        RowWork(plan, friction, effects["gas"].chambers),
        effects["whole_turn"],
        break_angles(plan, effects["gas"].opens),
    )


@pytest.mark.parametrize("style", STYLES)
@pytest.mark.parametrize("seed", range(4))
def test_the_work_of_a_turn_is_that_of_the_torque(seed: int, style: str) -> None:
    instance = case(seed, style)
    turn = instance.panels()
    radius = instance.whole.rows.crank_radius[0]
    by_row = [TURN * float(mean(turn, force)) for force in radius[:, None] * instance.whole.tangential(turn)[0]]
    # independent: by Gauss quadrature of the tangential forces
    assert instance.work.of_a_turn == pytest.approx(np.array(by_row), rel=1e-11)


@pytest.mark.parametrize("style", STYLES)
@pytest.mark.parametrize("rod_ratio", [1e-6, None, 0.9])
@pytest.mark.parametrize("friction", [None, {"mechanical_efficiency": 0.9, "reciprocating_share": 0.6}])
def test_from_one_angle_to_another(style: str, rod_ratio: float | None, friction: dict[str, float] | None) -> None:
    instance = case(5, style, rod_ratio, friction=friction)
    turn = instance.panels()
    over_mean = instance.torque(turn) - np.sum(instance.work.of_a_turn) / TURN
    nodes = turn.rule.weights.size
    of_panel = over_mean.reshape(-1, nodes) @ turn.rule.weights * (0.5 * turn.width)
    # independent: by Gauss quadrature, from panel to panel
    running = np.concatenate([[0.0], np.cumsum(of_panel)])
    beside_mean = instance.work.beside_mean(np.append(turn.start, TURN))
    assert beside_mean - beside_mean[0] == pytest.approx(running, rel=1e-11, abs=1e-12 * np.max(np.abs(beside_mean)))


@pytest.mark.parametrize("style", STYLES)
@pytest.mark.parametrize("seed", range(4))
def test_its_range_is_what_a_flywheel_takes_up(seed: int, style: str) -> None:
    instance = case(seed, style)
    turn, span = instance.panels(), instance.work.fluctuation(instance.whole.torque)
    # independent: by the interpolants of the torque
    assert span.value == pytest.approx(float(fluctuation(turn, instance.torque(turn))), rel=1e-12)
    assert span.error <= 1e-9 * span.value


@pytest.mark.parametrize("rod_ratio", [0.99, 0.9999])
def test_the_error_covers_rods_hardly_longer_than_the_crank(rod_ratio: float) -> None:
    for seed in range(4):
        instance = case(seed, "v", rod_ratio)
        turn, span = instance.panels(), instance.work.fluctuation(instance.whole.torque)
        by_quadrature = float(fluctuation(turn, instance.torque(turn)))
        assert abs(span.value - by_quadrature) <= span.error + 1e-10 * by_quadrature


def test_more_angles_change_no_bit() -> None:
    instance = case(1, "w")
    angle = np.linspace(0.0, TURN, 7)
    together = instance.work.beside_mean(angle)
    assert np.array_equal(instance.work.beside_mean(angle[2:4]), together[2:4])


def test_the_slope_of_a_cubic_is_its_derivative() -> None:
    """Analytic: of 5 + 7 x - 2 x^2 + 3 x^3 at -1, 0 and 0.5."""
    actual = _slope.py_func([5.0, 7.0, -2.0, 3.0], np.array([-1.0, 0.0, 0.5]))
    assert actual == pytest.approx([20.0, 7.0, 7.25], rel=1e-14)
