"""Laws that hold for every machine: what must happen when it is turned, mirrored, scaled, shuffled or moved."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from optimizer.mechanics.inertia import counterweights, reciprocating, rotating
from optimizer.mechanics.layout import layout
from optimizer.numerics.arrays import Complex
from schemas.machine.reciprocating import ReciprocatingMachine
from schemas.machine.throws import Row, Throw
from tests.builders import ANGLES, POSITIONS, force_scale, machines, moment_scale

ORDERS = (1, 2, 4)
UNBALANCE = np.array([0.3 - 0.1j, 0.05j, -0.2 + 0.7j])  # kg m, for as many webs as there are


def phasors(machine: ReciprocatingMachine) -> Complex:
    """Every phasor of the machine with counterweights, and of its rounding: (effects, 4) as force co and counter,
    moment co and counter, over omega^2."""
    arrays = layout(machine)
    effects = [rotating(arrays), counterweights(arrays, UNBALANCE[: len(machine.webs)])]
    effects += [reciprocating(arrays, order) for order in ORDERS]
    return np.array([[e.force.co, e.force.counter, e.moment.co, e.moment.counter] for e in effects])


def scale(machine: ReciprocatingMachine) -> Any:
    """Largest possible value of each, (4,)."""
    arrays = layout(machine)
    force = 16.0 * force_scale(arrays) + 2.0
    far = max([abs(w.position_m) for w in machine.webs], default=0.0) + abs(float(arrays.reference_plane))
    return np.array([force, force, 1.0, 1.0]) + np.array([0, 0, 1, 1]) * (16 * moment_scale(arrays) + 2 * far)


def assert_same(values: Complex, expected: Complex, machine: ReciprocatingMachine) -> None:
    assert np.all(np.abs(values - expected) <= 1e-12 * scale(machine))


def with_throws(machine: ReciprocatingMachine, change: Callable[[Throw], dict[str, Any]]) -> ReciprocatingMachine:
    return machine.model_copy(update={"throws": tuple(t.model_copy(update=change(t)) for t in machine.throws)})


def with_rows(machine: ReciprocatingMachine, change: Callable[[Row], dict[str, Any]]) -> ReciprocatingMachine:
    return with_throws(machine, lambda t: {"rows": tuple(r.model_copy(update=change(r)) for r in t.rows)})


def pinned(machine: ReciprocatingMachine) -> ReciprocatingMachine:
    """The same machine with its plane of moments written down."""
    return machine.model_copy(update={"reference_plane_m": float(layout(machine).reference_plane)})


@given(machines(), machines())
def test_superposition(machine: ReciprocatingMachine, second_machine: ReciprocatingMachine) -> None:
    machine = pinned(machine).model_copy(update={"webs": ()})
    second_machine = second_machine.model_copy(update={"webs": (), "reference_plane_m": machine.reference_plane_m})
    both = machine.model_copy(update={"throws": machine.throws + second_machine.throws})
    assert_same(phasors(both), phasors(machine) + phasors(second_machine), both)


@given(machines(), ANGLES)
def test_turning_the_machine_turns_every_vector(machine: ReciprocatingMachine, angle: float) -> None:
    turned = with_throws(machine, lambda t: {"crank_angle_deg": t.crank_angle_deg + angle})
    turned = with_rows(turned, lambda r: {"axis_deg": r.axis_deg + angle})
    expected = phasors(machine) * np.exp(1j * np.deg2rad(angle))
    expected[1] = phasors(machine)[1]  # the counterweights stayed where they were
    assert_same(phasors(turned), expected, machine)


@given(machines())
def test_mirroring_the_machine_mirrors_every_vector(machine: ReciprocatingMachine) -> None:
    """x -> -x, which also turns the sense of rotation round; z stays."""
    mirrored = with_throws(machine, lambda t: {"crank_angle_deg": 180.0 - t.crank_angle_deg})
    mirrored = with_rows(mirrored, lambda r: {"axis_deg": 180.0 - r.axis_deg})
    mirrored = mirrored.model_copy(update={"rotation": "cw" if machine.rotation == "ccw" else "ccw"})
    expected = -np.conj(phasors(machine))
    expected[1] = phasors(machine)[1]
    assert_same(phasors(mirrored), expected, machine)


@given(machines())
def test_the_sense_of_rotation_changes_no_phasor(machine: ReciprocatingMachine) -> None:
    """Angles are as drawn at shaft angle 0: turning the other way exchanges nothing but the direction of time."""
    variant = machine.model_copy(update={"rotation": "cw" if machine.rotation == "ccw" else "ccw"})
    assert np.array_equal(phasors(variant), phasors(machine))
    assert layout(variant).sense == -layout(machine).sense


@given(machines(), st.floats(1e-3, 1e3))
def test_forces_grow_with_mass(machine: ReciprocatingMachine, factor: float) -> None:
    def heavier(row: Row) -> dict[str, Any]:
        rod = row.connecting_rod
        assert rod is not None
        return {
            "reciprocating_mass_kg": factor * row.reciprocating_mass_kg,
            "connecting_rod": rod.model_copy(update={"mass_kg": factor * rod.mass_kg}),
        }

    heavy = with_throws(with_rows(machine, heavier), lambda t: {"rotating_mass_kg": factor * t.rotating_mass_kg})
    expected = factor * phasors(machine)
    expected[1] /= factor
    assert_same(phasors(heavy) / max(factor, 1.0), expected / max(factor, 1.0), machine)


@given(machines(), st.floats(0.01, 100.0))
def test_forces_grow_with_length_and_moments_with_its_square(machine: ReciprocatingMachine, factor: float) -> None:
    def longer(row: Row) -> dict[str, Any]:
        rod = row.connecting_rod
        assert rod is not None
        length = None if rod.length_m is None else factor * rod.length_m
        return {"offset_m": factor * row.offset_m, "connecting_rod": rod.model_copy(update={"length_m": length})}

    machine = pinned(machine).model_copy(update={"webs": ()})
    large = with_throws(
        with_rows(machine, longer),
        lambda t: {"position_m": factor * t.position_m, "crank_radius_m": factor * t.crank_radius_m},
    )
    assert machine.reference_plane_m is not None
    large = large.model_copy(update={"reference_plane_m": factor * machine.reference_plane_m})
    powers = np.array([factor, factor, factor**2, factor**2])
    # a large rod ratio magnifies the rounding of length over length
    assert np.all(np.abs(phasors(large) / powers - phasors(machine)) <= 1e-10 * scale(machine))


@given(machines(), st.floats(0.1, 10.0))
def test_speed_only_scales(machine: ReciprocatingMachine, factor: float) -> None:
    fast = machine.model_copy(update={"speed_rpm": factor * machine.speed_rpm})
    assert np.array_equal(phasors(fast), phasors(machine))
    np.testing.assert_allclose(layout(fast).omega, factor * layout(machine).omega, rtol=1e-15)


@given(machines(), st.randoms())
def test_the_order_of_throws_rows_and_webs_does_not_matter(machine: ReciprocatingMachine, random: Any) -> None:
    def shuffled(things: tuple[Any, ...]) -> tuple[Any, ...]:
        return tuple(random.sample(things, len(things)))

    order = shuffled(tuple(range(len(machine.webs))))
    mixed = with_throws(machine, lambda t: {"rows": shuffled(t.rows)})
    mixed = mixed.model_copy(update={"throws": shuffled(mixed.throws), "webs": tuple(machine.webs[k] for k in order)})
    expected = phasors(machine)
    arrays = layout(mixed)
    moved = counterweights(arrays, UNBALANCE[list(order)])
    expected_moved = np.array([moved.force.co, moved.force.counter, moved.moment.co, moved.moment.counter])
    harmonics = phasors(mixed)
    harmonics[1] = expected_moved
    assert_same(harmonics, expected, machine)


@given(machines(), POSITIONS)
def test_moving_the_reference_plane(machine: ReciprocatingMachine, plane: float) -> None:
    """C(z_ref + h) = C(z_ref) - h F, order by order."""
    moved = machine.model_copy(update={"reference_plane_m": plane})
    before, after = phasors(machine), phasors(moved)
    shift = plane - float(layout(machine).reference_plane)
    expected = before.copy()
    expected[:, 2:] -= shift * before[:, :2]
    assert np.array_equal(after[:, :2], before[:, :2])
    assert np.all(np.abs(after - expected) <= 1e-12 * (scale(machine) + scale(moved)))


@given(machines(), POSITIONS)
def test_a_pure_couple_has_no_plane(machine: ReciprocatingMachine, plane: float) -> None:
    """Every throw once more, half a turn on with its cylinders: no force of any order, one couple everywhere."""
    arrays = layout(machine.model_copy(update={"webs": ()}))

    def doubled(values: Any, sign: float = 1.0, shift: float = 0.0) -> Any:
        return np.concatenate([values, sign * values + shift])

    turning, moving = arrays.rotating, arrays.reciprocating
    pair = replace(
        arrays,
        rotating=replace(
            turning,
            mass=doubled(turning.mass),
            radius=doubled(turning.radius),
            direction=doubled(turning.direction, -1.0),
            position=doubled(turning.position, 1.0, 0.7),
        ),
        reciprocating=replace(
            moving,
            mass=doubled(moving.mass),
            crank_radius=doubled(moving.crank_radius),
            crank_direction=doubled(moving.crank_direction, -1.0),
            axis=doubled(moving.axis, -1.0),
            position=doubled(moving.position, 1.0, 0.7),
            rod_ratio=doubled(moving.rod_ratio),
        ),
    )
    elsewhere = replace(pair, reference_plane=np.asarray(plane))
    for effect in (rotating, *[lambda x, k=k: reciprocating(x, k) for k in ORDERS]):
        here, there = effect(pair), effect(elsewhere)
        assert here.force.peak == 0.0
        assert here.moment.co == there.moment.co
        assert here.moment.counter == there.moment.counter


@given(machines())
def test_a_row_beside_its_throw_is_a_row_on_another_throw(machine: ReciprocatingMachine) -> None:
    apart = pinned(machine)
    apart = apart.model_copy(
        update={
            "throws": tuple(
                piece
                for t in machine.throws
                for piece in (
                    t.model_copy(update={"rows": ()}),
                    *[
                        t.model_copy(
                            update={
                                "position_m": t.position_m + r.offset_m,
                                "rotating_mass_kg": 0.0,
                                "rows": (r.model_copy(update={"offset_m": 0.0}),),
                            }
                        )
                        for r in t.rows
                    ],
                )
            )
        }
    )
    assert_same(phasors(apart), phasors(machine), machine)
