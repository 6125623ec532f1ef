"""Integrals over a turn: panels, means and fluctuation energies with known answers."""

from collections.abc import Callable

import numpy as np
import pytest

from optimizer.mechanics.turn import fluctuation, mean, panels
from optimizer.numerics.arrays import Real

TURN = 2.0 * np.pi
NONE = np.zeros(0)


@pytest.mark.parametrize(
    "breaks",
    [
        [],
        [0.0],
        [TURN],
        [0.0, TURN, -TURN],
        [np.nan, np.nan],
        [1.0, 1.0, 1.0],
        [-1e-18],
        [5.0, np.nan, -3.0, 40.0],
        list(np.linspace(0.0, TURN, 9)),
    ],
)
def test_panels_cover_the_turn_once(breaks: list[float]) -> None:
    turn = panels(np.array(breaks, dtype=float), 0.3)
    assert turn.start[0] == 0.0
    np.testing.assert_allclose(turn.start[1:], (turn.start + turn.width)[:-1], atol=1e-14)
    assert turn.start[-1] + turn.width[-1] == pytest.approx(TURN, abs=1e-14)
    assert np.all(turn.width >= 0.0)
    assert np.max(turn.width) <= 0.3 * (1 + 1e-12)
    assert np.sum(turn.width) == pytest.approx(TURN, rel=1e-14)
    angle = turn.angle
    assert np.all(np.diff(angle) >= 0.0)
    assert np.all((angle >= 0.0) & (angle <= TURN * (1 + 1e-15)))
    edges = np.append(turn.start, TURN)
    for edge in np.mod(np.array(breaks)[np.isfinite(breaks)], TURN):
        assert np.min(np.abs(edges - edge)) < 1e-12
    # analytic
    assert mean(turn, np.ones_like(angle)) == pytest.approx(1.0, rel=1e-14)
    assert fluctuation(turn, np.full_like(angle, 7e5)) == pytest.approx(0.0, abs=1e-8)


@pytest.mark.parametrize("power", range(12))
def test_mean_of_powers(power: int) -> None:
    turn = panels(np.array([1.0, 2.5]), 10.0)
    # analytic: exact up to the eleventh power, however wide the panels
    assert mean(turn, turn.angle**power) == pytest.approx(TURN**power / (power + 1), rel=1e-12)


@pytest.mark.parametrize("order", range(1, 13))
def test_sines(order: int) -> None:
    turn = panels(np.array([0.4]), np.deg2rad(5.0))
    values = 30.0 + 8.0 * np.sin(order * turn.angle)
    assert mean(turn, values) == pytest.approx(30.0, rel=1e-13)
    assert mean(turn, values**2) == pytest.approx(900.0 + 32.0, rel=1e-12)
    # analytic: 2 A / k; the crossing is a root of the interpolant
    assert fluctuation(turn, values) == pytest.approx(2.0 * 8.0 / order, rel=1e-12)


def test_fluctuation_converges_to_the_analytic_value() -> None:
    def error(finest: float) -> float:
        turn = panels(np.array([0.123]), finest)
        return abs(float(fluctuation(turn, np.cos(turn.angle) + 0.3 * np.sin(2.0 * turn.angle))) - expected)

    # independent: the extremes of sin x - 0.15 cos 2x on a fine grid around them
    x = np.linspace(0.0, TURN, 2_000_001)
    running = np.sin(x) - 0.15 * np.cos(2.0 * x)
    expected = float(running.max() - running.min())
    assert error(0.1) < 1e-11
    assert error(0.01) < 1e-11


def _square(x: Real) -> Real:
    return np.where((x > 1.0) & (x < 3.0), 50.0, -10.0)


def _saw(x: Real) -> Real:
    return x / TURN


@pytest.mark.parametrize("finest", [0.01, 0.3, 3.0])
@pytest.mark.parametrize(
    ("torque", "breaks", "middle", "energy"),
    [
        # analytic: 60 higher over 2 rad; the area above the mean is 60 (1 - 1/pi) 2
        (_square, [1.0, 3.0], -10.0 + 60.0 / np.pi, 120.0 * (1.0 - 1.0 / np.pi)),
        # analytic: a ramp from 0 to 1 has a triangle of pi/4 on either side of its mean
        (_saw, [], 0.5, np.pi / 4.0),
    ],
)
def test_torques_that_jump(
    torque: Callable[[Real], Real], breaks: list[float], middle: float, energy: float, finest: float
) -> None:
    turn = panels(np.array(breaks), finest)
    assert mean(turn, torque(turn.angle)) == pytest.approx(middle, rel=1e-13)
    assert fluctuation(turn, torque(turn.angle)) == pytest.approx(energy, rel=1e-12)


def test_where_the_turn_begins_is_of_no_account() -> None:
    def torque(x: Real) -> Real:
        return 5.0 + np.sin(x) + 2.0 * np.cos(3.0 * x) + np.where(np.mod(x, TURN) < 2.0, 1.0, 0.0)

    values = []
    for shift in np.linspace(0.0, 6.0, 7):
        turn = panels(np.array([0.0, 2.0]) - shift, 0.02)
        values.append(
            (float(mean(turn, torque(turn.angle + shift))), float(fluctuation(turn, torque(turn.angle + shift))))
        )
    np.testing.assert_allclose(values, [values[0]] * 7, rtol=2e-6)


def test_how_finely_it_is_divided_is_of_no_account() -> None:
    def torque(x: Real) -> Real:
        return np.exp(np.sin(x)) * np.where(x < 2.0, 3.0, -1.0)

    values = []
    for finest in (0.2, 0.05, 0.01):
        turn = panels(np.array([2.0]), finest)
        values.append((float(mean(turn, torque(turn.angle))), float(fluctuation(turn, torque(turn.angle)))))
    np.testing.assert_allclose(values, [values[-1]] * 3, rtol=1e-6)


def test_scale_and_offset() -> None:
    turn = panels(NONE, 0.1)
    values = np.sin(turn.angle) + np.cos(5.0 * turn.angle)
    assert fluctuation(turn, -3.0 * values + 11.0) == pytest.approx(3.0 * fluctuation(turn, values), rel=1e-12)


def test_a_batch_is_the_loop() -> None:
    rng = np.random.default_rng(0)
    breaks = rng.uniform(-10.0, 10.0, (5, 4))
    breaks[1, 2] = np.nan
    breaks[2, 1] = breaks[2, 0]
    turn = panels(breaks, 0.1)
    phase = rng.uniform(0.0, 6.0, (5, 1))

    def torque(x: Real, shift: Real) -> Real:
        return 2.0 + np.sin(3.0 * x + shift)

    means, energies = mean(turn, torque(turn.angle, phase)), fluctuation(turn, torque(turn.angle, phase))
    assert means.shape == energies.shape == (5,)
    for k in range(5):
        alone = panels(breaks[k], 0.1)
        values = torque(alone.angle, phase[k])
        assert means[k] == pytest.approx(float(mean(alone, values)), rel=1e-12)
        # the batch divides every gap into as many parts as its widest needs
        assert energies[k] == pytest.approx(float(fluctuation(alone, values)), rel=1e-4)
        row = type(turn)(turn.start[k], turn.width[k])
        assert energies[k] == pytest.approx(float(fluctuation(row, torque(row.angle, phase[k]))), rel=1e-13)
