"""Friction: sign, dead centres, and the losses it stands for."""

import numpy as np
import pytest

from optimizer.mechanics.friction import reciprocating_friction, share_of_losses
from optimizer.mechanics.kinematics import motion
from optimizer.mechanics.layout import layout
from tests.builders import OMEGA, RADIUS, machine, random_machine, row, throw


@pytest.mark.parametrize("rotation", ["ccw", "cw"])
def test_friction_acts_against_the_motion(rotation: str) -> None:
    arrays = layout(machine(throw(20.0, row(80.0), row(-30.0)), rotation=rotation))
    moving = motion(arrays, np.linspace(0.001, 6.3, 997))
    friction = reciprocating_friction(moving, np.array([100.0, 7.0]))
    # published: positive (rod in tension) on the stroke to the shaft, negative on the return
    np.testing.assert_array_equal(friction, np.sign(moving.velocity) * np.array([[100.0], [7.0]]))


def test_no_friction_at_the_dead_centres() -> None:
    arrays = layout(machine(throw(0.0, row(0.0))))
    at = np.pi * np.array([-2.0, -1.0, 0.0, 1.0, 2.0, 3.0])
    np.testing.assert_array_equal(reciprocating_friction(motion(arrays, at), np.array([5.0])), 0.0)
    beside = reciprocating_friction(motion(arrays, np.array([-1e-9, 1e-9])), np.array([5.0]))
    np.testing.assert_array_equal(beside, [[-5.0, 5.0]])


@pytest.mark.parametrize("seed", range(5))
def test_shares_give_the_losses_back(seed: int) -> None:
    rng = np.random.default_rng(seed)
    arrays = layout(random_machine(rng))
    stroke = 2.0 * arrays.reciprocating.crank_radius
    indicated = rng.uniform(1e3, 1e6, stroke.shape)
    efficiency, share = rng.uniform(0.7, 1.0), rng.uniform(0.0, 1.0)
    force, torque = share_of_losses(indicated, np.asarray(efficiency), np.asarray(share), stroke, arrays.omega)
    losses = indicated / efficiency - indicated  # analytic: shaft power less indicated power
    np.testing.assert_allclose(force * 2.0 * stroke * arrays.omega / (2.0 * np.pi), share * losses, rtol=1e-12)
    assert torque * arrays.omega == pytest.approx((1.0 - share) * losses.sum(), rel=1e-12)
    # independent: mean power of the friction force over the turn
    middle = 2.0 * np.pi * (np.arange(20000) + 0.5) / 20000
    moving = motion(arrays, middle)
    power = np.mean(reciprocating_friction(moving, force) * moving.velocity, axis=-1)
    np.testing.assert_allclose(power, share * losses, rtol=1e-4)


def test_published_losses() -> None:
    indicated = np.array([608300.0, 583000.0])
    arguments = (indicated, np.asarray(0.94), np.asarray(0.7), np.full(2, 0.28))
    force, torque = share_of_losses(*arguments, np.asarray(500.0 * np.pi / 30.0))
    np.testing.assert_allclose(force, [5824.1, 5581.9], atol=0.06)  # published
    assert torque / 0.14 == pytest.approx(3112.0, abs=0.06)  # analytic: the source's 3113.6 with an exact pi
    _, rounded = share_of_losses(*arguments, np.asarray(500.0 * 3.14 / 30.0))
    assert rounded / 0.14 == pytest.approx(3113.6, abs=0.06)  # published


def test_a_perfect_machine_has_none() -> None:
    values = np.asarray(1.0)
    force, torque = share_of_losses(
        np.array([5e3]), values, np.asarray(0.7), np.array([2.0 * RADIUS]), np.asarray(OMEGA)
    )
    np.testing.assert_array_equal([*force, torque], 0.0)


def test_a_batch_is_the_loop() -> None:
    rng = np.random.default_rng(3)
    indicated, stroke = rng.uniform(1.0, 9.0, (4, 3)), rng.uniform(0.1, 0.4, (4, 3))
    efficiency, share, omega = rng.uniform(0.5, 1.0, 4), rng.uniform(0.0, 1.0, 4), rng.uniform(10.0, 90.0, 4)
    force, torque = share_of_losses(indicated, efficiency, share, stroke, omega)
    for k in range(4):
        alone = share_of_losses(indicated[k], efficiency[k], share[k], stroke[k], omega[k])
        np.testing.assert_allclose(force[k], alone[0], rtol=1e-15)
        assert torque[k] == pytest.approx(alone[1], rel=1e-15)


def test_losses_are_in_proportion_to_the_power_however_small() -> None:
    """Property: of gas that takes power and of gas that gives it."""
    facts = (np.asarray(0.9), np.asarray(0.6), np.array([0.2, 0.3]), np.asarray(50.0))
    power = np.array([700.0, -300.0])
    force, torque = share_of_losses(power, *facts)
    for factor in (1e-6, 1e6):
        less, turning = share_of_losses(factor * power, *facts)
        np.testing.assert_allclose(less, factor * force, rtol=1e-12)
        np.testing.assert_allclose(turning, factor * torque, rtol=1e-12)
