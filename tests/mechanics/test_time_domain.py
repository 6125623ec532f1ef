"""The key independent check: every mass moved through one turn by geometry alone, then transformed.

No phase formula and no harmonic of the slider-crank is used here. The pin of a row lies on the cylinder axis at one
rod length from the crank pin; a mass at position p(theta) pushes on the frame with -m p'', which for the k-th Fourier
coefficient is m k^2 p_k.
"""

import numpy as np
import pytest

from optimizer.mechanics.inertia import Wrench, counterweights, reciprocating, rotating
from optimizer.mechanics.layout import layout
from optimizer.numerics.arrays import Complex
from optimizer.responses.response import Phasors
from schemas.machine.reciprocating import ReciprocatingMachine
from tests.builders import force_scale, moment_scale, random_machine

POINTS = 512
THETA = 2.0 * np.pi * np.arange(POINTS) / POINTS


def moment_of_position(machine: ReciprocatingMachine, plane: float) -> tuple[Complex, Complex]:
    """Sum of m p and of (z - plane) m p over a turn, from throws and rows as posted."""
    sense = 1.0 if machine.rotation == "ccw" else -1.0
    total, couple = np.zeros(POINTS, complex), np.zeros(POINTS, complex)

    def add(mass: float, position: Complex, z: float) -> None:
        nonlocal total, couple
        total = total + mass * position
        couple = couple + (z - plane) * mass * position

    for throw in machine.throws:
        pin = throw.crank_radius_m * np.exp(1j * (np.deg2rad(throw.crank_angle_deg) + sense * THETA))
        add(throw.rotating_mass_kg, pin, throw.position_m)
        for row in throw.rows:
            axis = np.exp(1j * np.deg2rad(row.axis_deg))
            along, across = (pin * np.conj(axis)).real, (pin * np.conj(axis)).imag
            z = throw.position_m + row.offset_m
            rod = row.connecting_rod
            assert rod is not None
            # an infinite rod only shifts the pin by a constant, which does not accelerate
            reach = 0.0 if rod.length_m is None else np.sqrt(rod.length_m**2 - across**2)
            add(row.reciprocating_mass_kg + rod.reciprocating_share * rod.mass_kg, (along + reach) * axis, z)
            add((1 - rod.reciprocating_share) * rod.mass_kg, pin, z)
    return total, couple


def phasors(position: Complex, order: int, clockwise: bool) -> Phasors:
    spectrum = np.fft.fft(position) / POINTS * order**2
    forward, backward = spectrum[order], spectrum[-order]
    return Phasors(backward, forward) if clockwise else Phasors(forward, backward)


@pytest.mark.parametrize("style", ["v", "star", "opposed", "offset", "cw", "plane", "any"])
@pytest.mark.parametrize("seed", range(8))
def test_phasors_independent(style: str, seed: int) -> None:
    machine = random_machine(np.random.default_rng([seed, len(style)]), style)
    arrays = layout(machine)
    force, couple = moment_of_position(machine, float(arrays.reference_plane))
    for order in (1, 2, 3, 4, 6):
        wrench = reciprocating(arrays, order)
        if order == 1:
            wrench = wrench.plus(rotating(arrays))
        clockwise = machine.rotation == "cw"
        _assert_same(wrench.force, phasors(force, order, clockwise), order**2 * force_scale(arrays))
        _assert_same(wrench.moment, phasors(couple, order, clockwise), order**2 * moment_scale(arrays))


def _assert_same(harmonics: Phasors, expected: Phasors, scale: float) -> None:
    assert harmonics.co == pytest.approx(complex(expected.co), abs=1e-13 * scale)
    assert harmonics.counter == pytest.approx(complex(expected.counter), abs=1e-13 * scale)


@pytest.mark.parametrize("seed", range(4))
def test_force_at_every_angle_independent(seed: int) -> None:
    """The sum of orders 1 to 40 at 512 angles, in newtons, against the second derivative of the positions."""
    machine = random_machine(np.random.default_rng(seed), "any", (0.05, 0.4))
    arrays = layout(machine)
    position, _ = moment_of_position(machine, 0.0)
    orders = np.fft.fftfreq(POINTS, 1.0 / POINTS)
    square = (machine.speed_rpm * np.pi / 30.0) ** 2
    expected = np.fft.ifft(np.fft.fft(position) * orders**2) * square
    angle = arrays.sense * THETA
    total = rotating(arrays).force.at(angle) + sum(reciprocating(arrays, k).force.at(angle, k) for k in range(1, 41))
    np.testing.assert_allclose(total * square, expected, atol=1e-8 * square * force_scale(arrays))


def test_counterweights_independent() -> None:
    """A counterweight of mass m at R e^{ja} in plane z is one more mass that turns with the shaft."""
    machine = random_machine(np.random.default_rng(5), "any")
    arrays = layout(machine)
    rng = np.random.default_rng(6)
    mass, angle = rng.uniform(0, 20, 3), rng.uniform(0, 360, 3)
    sense = float(arrays.sense)
    at = [
        m * w.counterweight_radius_m * np.exp(1j * (np.deg2rad(a) + sense * THETA))
        for m, a, w in zip(mass, angle, machine.webs, strict=True)
    ]
    radius = np.array([w.counterweight_radius_m for w in machine.webs])
    wrench: Wrench = counterweights(arrays, mass * radius * np.exp(1j * np.deg2rad(angle)))
    plane = float(arrays.reference_plane)
    couple = sum(p * (w.position_m - plane) for p, w in zip(at, machine.webs, strict=True))
    _assert_same(wrench.force, phasors(sum(at), 1, sense < 0), 100.0)
    _assert_same(wrench.moment, phasors(couple, 1, sense < 0), 100.0)
