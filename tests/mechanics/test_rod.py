"""Forces in the mechanism against geometry, virtual work and the shaking force."""

import mpmath
import numpy as np
import pytest

from optimizer.mechanics.friction import reciprocating_friction
from optimizer.mechanics.gas import gas_forces
from optimizer.mechanics.kinematics import motion
from optimizer.mechanics.layout import Layout, layout
from optimizer.mechanics.rod import rod_forces, shaft_loads
from optimizer.numerics.arrays import Complex, Real
from tests.analyze.driven import STYLES, arrays, random_driven
from tests.builders import RADIUS, machine, random_machine, row, stack, throw

THETA = np.deg2rad(np.arange(0.0, 360.0, 11.0))


def random_layout(seed: int) -> tuple[Layout, Real]:
    """A layout of any kind, and a piston force of either sign on every row."""
    rng = np.random.default_rng(seed)
    plan = layout(random_machine(rng))
    return plan, rng.uniform(-1e5, 1e5, (plan.reciprocating.mass.size, THETA.size))


def drawing(plan: Layout) -> tuple[Complex, Complex]:
    """Crank pins and crossheads as they lie across the shaft, from the triangle of crank and rod."""
    rows = plan.reciprocating
    radius = rows.crank_radius[:, None]
    pin = radius * rows.crank_direction[:, None] * np.exp(1j * plan.sense * THETA)
    across = pin * np.conj(rows.axis)[:, None]
    reach = across.real + np.sqrt((radius / rows.rod_ratio[:, None]) ** 2 - across.imag**2)
    return pin, rows.axis[:, None] * reach


def test_published_decomposition() -> None:
    plan = layout(machine(throw(0.0, row(0.0, length_m=RADIUS / 0.2))))
    forces = rod_forces(np.array([[50e3]]), motion(plan, np.deg2rad([50.0])), plan)
    # published: 50 kN at 50 degrees, rod ratio 0.2
    figures = [forces.side, forces.rod, forces.tangential, forces.radial, forces.torque, forces.overturning]
    expected = [7751.965489693671, 50597.36128449192, 43285.08952344164, 26201.030397697043] + 2 * [6059.91253328183]
    np.testing.assert_allclose(np.ravel(figures), expected, rtol=1e-12)


@pytest.mark.parametrize("seed", range(8))
def test_forces_are_those_of_the_drawing(seed: int) -> None:
    plan, force = random_layout(seed)
    forces = rod_forces(force, motion(plan, THETA), plan)
    pin, crosshead = drawing(plan)
    along, axis = crosshead - pin, plan.reciprocating.axis[:, None]
    along /= np.abs(along)
    # independent: the rod's pull along the axis holds the piston force; what it does to pin and guide
    pull = force / np.real(along * np.conj(axis))
    crank = pin / np.abs(pin)
    on_pin = pull * along * np.conj(crank)
    scale = 1e-12 * np.abs(force).max()
    np.testing.assert_allclose(forces.rod, pull, rtol=1e-12)
    np.testing.assert_allclose(forces.radial, on_pin.real, atol=scale)
    np.testing.assert_allclose(forces.tangential, -plan.sense * on_pin.imag, atol=scale)
    across = np.imag(-pull * along * np.conj(axis))  # of the rod on the crosshead, which the guide takes
    np.testing.assert_allclose(forces.side, plan.sense * across, atol=scale)
    lever = np.abs(crosshead)
    np.testing.assert_allclose(forces.overturning, forces.side * lever, rtol=1e-9, atol=scale)


@pytest.mark.parametrize("seed", range(8))
def test_overturning_is_torque_and_virtual_work_holds(seed: int) -> None:
    plan, force = random_layout(seed)
    moving = motion(plan, THETA)
    forces = rod_forces(force, moving, plan)
    scale = np.abs(force).max() * plan.reciprocating.crank_radius.max()
    np.testing.assert_allclose(forces.overturning, forces.torque, atol=1e-14 * scale)  # analytic
    # analytic: what the piston takes the shaft gives, at every instant
    np.testing.assert_allclose(force * moving.velocity, forces.torque * plan.omega, atol=1e-13 * scale * plan.omega)
    np.testing.assert_allclose(forces.tangential**2 + forces.radial**2, forces.rod**2, rtol=1e-12)
    np.testing.assert_allclose(force**2 + forces.side**2, forces.rod**2, rtol=1e-12)


def test_infinite_rod() -> None:
    plan = layout(machine(throw(0.0, row(0.0, length_m=None))))
    force = np.full((1, THETA.size), 1000.0)
    forces = rod_forces(force, motion(plan, THETA), plan)
    # analytic: a Scotch yoke
    np.testing.assert_array_equal(forces.rod, force)
    np.testing.assert_array_equal(forces.side, 0.0)
    np.testing.assert_allclose(forces.tangential[0], 1000.0 * np.sin(THETA), atol=1e-12)
    np.testing.assert_allclose(forces.radial[0], 1000.0 * np.cos(THETA), atol=1e-12)
    np.testing.assert_allclose(forces.overturning, forces.torque, atol=1e-12)


def _shaking(plan: Layout, theta: float) -> complex:
    """Shaking force at one instant, from masses at the ends of a drawn mechanism."""
    rows, masses = plan.reciprocating, plan.rotating
    omega, sense = float(plan.omega), float(plan.sense)

    def reach(k: int, t: mpmath.mpf) -> mpmath.mpf:
        first = complex(rows.crank_direction[k] / rows.axis[k])
        angle = mpmath.arg(mpmath.mpc(first)) + sense * t
        radius = mpmath.mpf(float(rows.crank_radius[k]))
        length = radius / mpmath.mpf(float(rows.rod_ratio[k]))
        return radius * mpmath.cos(angle) + mpmath.sqrt(length**2 - (radius * mpmath.sin(angle)) ** 2)

    force = sum(masses.mass * masses.radius * masses.direction) * omega**2 * np.exp(1j * sense * theta)
    with mpmath.workdps(40):
        for k in range(rows.mass.size):
            second = mpmath.diff(lambda t, k=k: reach(k, t), mpmath.mpf(theta), 2)
            force -= rows.mass[k] * omega**2 * float(second) * rows.axis[k]
    return complex(force)


@pytest.mark.parametrize("style", STYLES)
@pytest.mark.parametrize("seed", range(2))
def test_all_forces_on_the_frame_add_up_to_the_shaking_force(seed: int, style: str) -> None:
    plan, data = arrays(random_driven(seed, style))
    moving = motion(plan, THETA)
    gas = gas_forces(data, moving, plan).total
    friction = reciprocating_friction(moving, np.linspace(10.0, 1e4, gas.shape[0]))
    force = gas + friction + plan.reciprocating.mass[:, None] * moving.acceleration
    forces = rod_forces(force, moving, plan)
    axis = plan.reciprocating.axis[:, None]
    _, loads = shaft_loads(force, moving, plan, THETA)
    guides = 1j * plan.sense * forces.side * axis
    covers, cylinders = -gas * axis, -friction * axis
    on_frame = loads.sum(axis=0) + (guides + covers + cylinders).sum(axis=0)
    expected = np.array([_shaking(plan, theta) for theta in THETA])  # independent
    np.testing.assert_allclose(on_frame, expected, atol=1e-10 * np.abs(loads).max())


def test_shaft_loads_stand_in_their_planes() -> None:
    plan, force = random_layout(4)
    planes, loads = shaft_loads(force, motion(plan, THETA), plan, THETA)
    rows, masses = plan.reciprocating, plan.rotating
    np.testing.assert_array_equal(planes, [*rows.position, *masses.position])
    pin, crosshead = drawing(plan)
    along = (crosshead - pin) / np.abs(crosshead - pin)
    # independent: a rod in tension pulls its pin towards the crosshead
    pulled = along * force / np.real(along * np.conj(rows.axis[:, None]))
    np.testing.assert_allclose(loads[: rows.mass.size], pulled, rtol=1e-11)
    # analytic: centrifugal forces
    outward = (masses.mass * masses.radius * masses.direction * plan.omega**2)[:, None]
    np.testing.assert_allclose(loads[rows.mass.size :], outward * np.exp(1j * plan.sense * THETA), rtol=1e-13)


def test_torque_of_the_shaft_loads() -> None:
    plan, force = random_layout(11)
    _, loads = shaft_loads(force, motion(plan, THETA), plan, THETA)
    pin, _ = drawing(plan)
    # analytic: the pull times its arm about the shaft is the torque against rotation
    turning = -plan.sense * np.imag(np.conj(pin) * loads[: pin.shape[0]])
    torque = rod_forces(force, motion(plan, THETA), plan).torque
    np.testing.assert_allclose(turning, torque, atol=1e-12 * np.abs(torque).max())


def test_a_batch_is_the_loop() -> None:
    layouts = [arrays(random_driven(seed, "w", throws=2))[0] for seed in range(3)]
    plan = stack(layouts)
    angle = np.stack([THETA, 2.0 * THETA, 0.3 + THETA])
    force = np.random.default_rng(1).uniform(-1e4, 1e4, (3, 6, THETA.size))
    moving = motion(plan, angle)
    batch, (planes, loads) = rod_forces(force, moving, plan), shaft_loads(force, moving, plan, angle)
    for k, arrangement in enumerate(layouts):
        alone = motion(arrangement, angle[k])
        single = rod_forces(force[k], alone, arrangement)
        for name in ("rod", "side", "tangential", "radial", "torque", "overturning"):
            np.testing.assert_allclose(getattr(batch, name)[k], getattr(single, name), rtol=1e-12, atol=1e-9)
        own_planes, own_loads = shaft_loads(force[k], alone, arrangement, angle[k])
        np.testing.assert_array_equal(planes[k], own_planes)
        np.testing.assert_allclose(loads[k], own_loads, rtol=1e-12)
