"""Masses and angles of unbalances, and what an answer says of them (analytic)."""

from typing import Any

import numpy as np
import pytest

from optimizer.formulation.balance_shafts import design_space, fitted, placement_of
from optimizer.formulation.counterweights import (
    counterweights,
    mass_and_angle,
    masses_and_angles,
    too_heavy,
    unbalance,
)
from optimizer.formulation.limits import limits
from optimizer.mechanics.shapes import fitted_masses, plates
from schemas.base.variation import with_fields
from schemas.machine.fitted import GivenCounterweight
from schemas.machine.reciprocating import ReciprocatingMachine
from schemas.request.objective import Objective
from tests.formulation.test_limits import limited
from tests.optimize.machines import machine, row, throw, web


def _sector(centre: float, half: float, most: float = 5.0) -> ReciprocatingMachine:
    webs = [web("a", 0.1, most, 0.2, sector={"centre_deg": centre, "half_angle_deg": half}), web("b", 0.2, most, 0.1)]
    return ReciprocatingMachine.model_validate(machine([throw(0.0, 0.0, [row(90.0, 5.0)])], webs))


def _masses_and_angles(plan: ReciprocatingMachine, *vectors: complex) -> tuple[Any, Any]:
    return masses_and_angles(plan, np.array(vectors, complex), limits(plan))


def _at(mass: float, radius: float, angle_deg: float) -> complex:
    return complex(mass * radius * np.exp(1j * np.deg2rad(angle_deg)))


@pytest.mark.parametrize("centre", [100.0, 350.0, 10.0, 999680.0, -720.0])
def test_unbalances_are_masses_and_angles_within_their_sector(centre: float) -> None:
    plan = _sector(centre, 30.0)
    mass, angle = _masses_and_angles(plan, _at(2.0, 0.2, centre + 20.0), _at(3.0, 0.1, 200.0))
    assert mass == pytest.approx([2.0, 3.0], rel=1e-12)
    assert angle == pytest.approx([(centre + 20.0) % 360.0, 200.0], abs=1e-7)
    for side in (-1.0, 1.0):
        # by 10 degrees outside: the nearest there is, as far along the edge as its projection
        mass, angle = _masses_and_angles(plan, _at(2.0, 0.2, centre + side * 40.0), 0.0)
        assert mass[0] == pytest.approx(2.0 * np.cos(np.deg2rad(10.0)), rel=1e-9)
        assert angle[0] == (centre % 360.0 + side * 30.0) % 360.0
        # behind, where nothing is near
        mass, angle = _masses_and_angles(plan, _at(2.0, 0.2, centre + side * 130.0), 0.0)
        assert (mass[0], angle[0]) == (0.0, 0.0)
        # next to an edge it is at the edge, to the last digit
        mass, angle = _masses_and_angles(plan, _at(2.0, 0.2, centre % 360.0 + side * (30.0 - 1e-13)), 0.0)
        assert angle[0] == (centre % 360.0 + side * 30.0) % 360.0
        assert mass[0] == pytest.approx(2.0, rel=1e-13)
        mass, angle = _masses_and_angles(plan, _at(2.0, 0.2, centre % 360.0 + side * (30.0 - 1e-9)), 0.0)
        assert angle[0] != (centre % 360.0 + side * 30.0) % 360.0


def test_masses_next_to_a_limit_are_the_limit_and_nothing_has_no_angle() -> None:
    plan = _sector(0.0, 30.0, 5.0)
    for share, full in ((1.0 - 1e-15, True), (1.0 + 1e-15, True), (1.0 - 1e-13, False)):
        mass, _ = _masses_and_angles(plan, _at(5.0 * share, 0.2, 0.0), _at(5.0 * share, 0.1, 70.0))
        assert [mass_kg == 5.0 for mass_kg in mass] == [full, full]
    mass, angle = _masses_and_angles(plan, 0.0, 0.0)
    assert (mass.tolist(), angle.tolist()) == ([0.0, 0.0], [0.0, 0.0])
    free = with_fields(plan, {("webs", 0, "sector"): None})
    mass, angle = _masses_and_angles(free, 0.0, _at(1.0, 0.1, 70.0))
    assert angle == pytest.approx([0.0, 70.0])


def test_a_batch_is_each_alone() -> None:
    plan, rng = _sector(40.0, 30.0), np.random.default_rng(1)
    vectors = 0.3 * (rng.normal(size=(2, 3, 2, 2)) @ [1, 1j])
    wide = masses_and_angles(plan, vectors, limits(plan, (2, 3)))
    for place in np.ndindex(2, 3):
        for part, alone in zip(wide, masses_and_angles(plan, vectors[place], limits(plan)), strict=True):
            np.testing.assert_array_equal(part[place], alone)


def test_what_is_answered_of_a_counterweight() -> None:
    mass, angle = np.array([3.0, 2.0, 4.0, 1.5]), np.array([220.0, 10.0, 350.0, 30.0])
    plan = fitted_masses(limited(), mass)
    assert isinstance(plan, ReciprocatingMachine)
    first, second, third, fixed = counterweights(plan, mass, angle)
    assert (first.web, first.mass_kg, first.angle_deg, first.position_m, first.radius_m) == (
        "a",
        3.0,
        220.0,
        -0.4,
        0.12,
    )
    assert first.mass_radius_kg_m == pytest.approx(0.36)
    vector = _at(3.0, 0.12, 220.0)
    assert (first.x_kg_m, first.y_kg_m) == (pytest.approx(vector.real), pytest.approx(vector.imag))
    # at the overspeed
    assert first.centrifugal_force_N == pytest.approx(0.36 * (660.0 * np.pi / 30.0) ** 2)
    assert (first.throw, first.angle_from_crank_deg) == (0, 220.0)
    assert (first.fixed, first.shape, first.active_limits) == (False, None, ())
    assert "max_centrifugal_force" in second.active_limits
    assert third.shape is not None
    assert third.shape.outer_radius_m == 0.2
    half = np.deg2rad(third.shape.half_angle_deg)
    assert third.shape.chord_height_m == pytest.approx(0.2 * np.cos(half))
    assert third.mass_radius_kg_m == pytest.approx(4.0 * plan.webs[2].radius_m)
    assert (fixed.fixed, fixed.active_limits) == (True, ())
    # unbalances that are known are said as they are
    actual_counterweights = counterweights(plan, mass, angle, np.arange(4) + 1j)
    assert [
        (actual_counterweight.x_kg_m, actual_counterweight.y_kg_m) for actual_counterweight in actual_counterweights
    ] == [(float(n), 1.0) for n in range(4)]
    nothing = counterweights(plan, np.zeros(4), np.zeros(4))
    assert [(counterweight.angle_from_crank_deg, counterweight.shape) for counterweight in nothing] == [
        (None, None)
    ] * 4
    # a crank elsewhere is what angles count from, and a hair below it is no whole turn
    turned = with_fields(plan, {("throws", 0, "crank_angle_deg"): 230.0})
    assert [counterweight.angle_from_crank_deg for counterweight in counterweights(turned, mass, angle)] == [
        350.0,
        140.0,
        120.0,
        160.0,
    ]
    hair = counterweights(turned, mass, np.array([230.0 - 1e-14, 230.0 - 3e-14, 230.0, 0.0]))
    assert all(0.0 <= (counterweight.angle_from_crank_deg or 0.0) < 360.0 for counterweight in hair)
    # without an overspeed the speed counts
    slow = with_fields(plan, {("overspeed_rpm",): None})
    assert counterweights(slow, mass, angle)[0].centrifugal_force_N == pytest.approx(0.36 * (600.0 * np.pi / 30.0) ** 2)


def test_masses_and_angles_of_a_request_stand_web_by_web() -> None:
    plan = limited()
    actual_counterweights = [
        GivenCounterweight(web="b", mass_kg=2.0, angle_deg=-30.0),
        GivenCounterweight(web="a", mass_kg=1.0, angle_deg=400.0),
    ]
    mass, angle = mass_and_angle(plan, actual_counterweights)
    assert mass.tolist() == [1.0, 2.0, 0.0, 1.5]
    assert angle.tolist() == [40.0, 330.0, 0.0, 30.0]
    radius = np.array([plane.radius_m for plane in plan.every_web])
    vectors = unbalance(mass, angle, radius)
    np.testing.assert_allclose(vectors, mass * radius * np.exp(1j * np.deg2rad(angle)), atol=1e-15)


def test_no_plate_is_given_more_than_it_holds() -> None:
    plan = limited()
    cut = plates(plan)
    assert cut is not None
    most = float(cut.mass(cut.most)[0])
    for share, wrong in ((1.0, False), (1.0 + 1e-13, False), (1.0 + 1e-11, True), (1.1, True)):
        actual_counterweights = [
            GivenCounterweight(web="a", mass_kg=99.0, angle_deg=0.0),
            GivenCounterweight(web="plate", mass_kg=share * most, angle_deg=0.0),
        ]
        problems = list(too_heavy(plan, actual_counterweights, "counterweights"))
        assert [problem.path for problem in problems] == ([("counterweights", 1, "mass_kg")] if wrong else [])
        assert all(f"{most:.6g} kg" in problem.message for problem in problems)


_SHAFTS = [
    {"name": "back", "speed_ratio": -1, "x_m": 0.2, "y_m": 0.1,
     "webs": [web("s", 0.1, 8.0, 0.09, sector={"centre_deg": 50.0, "half_angle_deg": 20.0})]},
    {"name": "twice", "speed_ratio": 2, "x_m": 0.2, "y_m": 0.1,
     "webs": [web("t", 0.1, 8.0, 0.08), web("u", 0.2, 8.0, 0.07)]},
]  # fmt: skip


def _geared() -> ReciprocatingMachine:
    webs = [web("a", 0.1, 5.0, 0.2)]
    return ReciprocatingMachine.model_validate(
        machine([throw(0.0, 0.0, [row(90.0, 5.0)])], webs, balance_shafts=_SHAFTS)
    )


@pytest.mark.parametrize(("orders", "mirrored"), [("first", True), ("all", False)])
def test_webs_of_shafts_that_turn_backwards_stand_for_their_mirror_image(orders: str, mirrored: bool) -> None:
    plan = _geared()
    objective = Objective.model_validate({"orders": orders})
    space = design_space(plan, objective)
    assert [weight.name for weight in space.machine.webs] == ["a", "s", "t", "u"]
    sector = space.machine.webs[1].sector
    assert sector is not None
    assert (sector.centre_deg, sector.half_angle_deg) == (-50.0 if mirrored else 50.0, 20.0)
    mass, angle = np.array([1.0, 2.0, 3.0, 0.0]), np.array([10.0, 310.0, 200.0, 0.0])
    fitting = placement_of(plan, objective, mass, angle)
    assert [weight.angle_deg for weight in fitting.counterweights] == [10.0]
    assert [[weight.angle_deg for weight in shaft.counterweights] for shaft in fitting.balance_shafts] == [
        [50.0 if mirrored else 310.0], [200.0, 0.0],
    ]  # fmt: skip
    assert (fitting.total_mass_kg, [shaft.total_mass_kg for shaft in fitting.balance_shafts]) == (1.0, [2.0, 3.0])
    assert fitting.fields["balance_shafts_mass_kg"] == 5.0
    assert [weight.web for weight in fitting.every_weight] == ["a", "s", "t", "u"]
    assert fitting.on_crank == pytest.approx([_at(1.0, 0.2, 10.0)])
    assert fitting.on_shafts is not None
    at = 50.0 if mirrored else 310.0
    assert fitting.on_shafts == pytest.approx([_at(2.0, 0.09, at), _at(3.0, 0.08, 200.0), 0.0])
    back, twice = fitting.balance_shafts
    assert back.gearing == f"Turns against the crankshaft at its speed; at shaft angle 0 s at {at:.2f} deg."
    assert twice.gearing == "Turns with the crankshaft at twice its speed; at shaft angle 0 t at 200.00 deg."
    # what turns twice as fast bears four times the force
    omega = 600.0 * np.pi / 30.0
    assert twice.counterweights[0].centrifugal_force_N == pytest.approx(3.0 * 0.08 * (2.0 * omega) ** 2)
    assert back.counterweights[0].centrifugal_force_N == pytest.approx(2.0 * 0.09 * omega**2)
    assert fitting.active_limits(())[None] == ()
    assert set(fitting.active_limits(())) == {None, "a", "s", "t", "u"}


def test_without_balance_shafts_there_are_none() -> None:
    plan = _sector(0.0, 30.0)
    fitting = fitted(plan, np.array([1.0, 2.0]), np.array([0.0, 90.0]))
    assert (fitting.balance_shafts, fitting.on_shafts, fitting.fields["balance_shafts_mass_kg"]) == ((), None, None)
    assert fitting.total_mass_kg == 3.0
    assert design_space(plan, Objective()).machine is plan
    bare = fitted(_geared(), np.zeros(4), np.zeros(4))
    assert bare.balance_shafts[0].gearing.endswith("at shaft angle 0 it carries nothing.")
