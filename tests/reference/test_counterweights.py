"""Masses and counterweights of the seeds, through the schema, the mechanics and the rules of thumb."""

from typing import Any

import numpy as np
import pytest

from optimizer.mechanics.inertia import counterweights, first_order_responses, reciprocating, rotating
from optimizer.mechanics.layout import layout
from optimizer.outputs.rules_of_thumb import force_rules, moment_rules
from schemas.machine.throws import ConnectingRod, Row
from tests.builders import OMEGA, ellipse, machine, row, throw, web
from tests.reference.seed_figures import RTOL, check, checks


@pytest.mark.parametrize("case", [0, 1], ids=["published-share-0.3", "published-share-0.4"])
def test_rod_is_shared_between_crosshead_and_pin(case: int) -> None:
    inputs, expected = check("001-masses")
    rod = ConnectingRod(length_m=0.7, mass_kg=inputs["m_conrod"], reciprocating_share=inputs["share_recip"][case])
    moving = inputs["m_piston"] + inputs["m_rod"] + inputs["m_crosshead"]
    arrays = layout(
        machine(
            throw(0, Row(axis_deg=0, reciprocating_mass_kg=moving, connecting_rod=rod), rotating_kg=inputs["m_crank"])
        )
    )
    assert arrays.reciprocating.mass[0] == pytest.approx(expected["m_s"][case], rel=RTOL)
    assert arrays.rotating.mass.sum() == pytest.approx(expected["m_r"][case], rel=RTOL)


def test_rotating_mass_of_a_v_published() -> None:
    inputs, expected = check("002-V-rotmass")
    rod = ConnectingRod(length_m=0.7, mass_kg=inputs["m_conrod"])  # a third reciprocates, as by default
    rows = [Row(axis_deg=45 + 90 * i, reciprocating_mass_kg=0, connecting_rod=rod) for i in range(inputs["n_rods"])]
    # the webs' unbalance is referred to the crank radius by the client, as the contract says
    referred = inputs["m_pin"] + inputs["m_webs"] * inputs["rho"] / inputs["r"]
    arrays = layout(machine(throw(0, *rows, rotating_kg=referred, radius_m=inputs["r"])))
    assert arrays.rotating.mass.sum() == pytest.approx(expected["m_r"], rel=RTOL)


def test_force_of_a_counterweight_and_moment_of_a_pair_published() -> None:
    inputs, expected = check("002-cw-force")
    half = inputs["l_np"] / 2
    arrays = layout(machine(throw(0), webs=[web("a", half), web("b", -half)]))
    unbalance = inputs["m_np"] * inputs["r_np"]
    square = inputs["omega"] ** 2
    assert counterweights(arrays, np.array([unbalance + 0j, 0])).force.peak * square == pytest.approx(
        expected["J"], rel=RTOL
    )
    pair = counterweights(arrays, np.array([unbalance + 0j, -unbalance]))
    assert pair.force.peak == 0.0
    assert pair.moment.peak * square == pytest.approx(expected["M"], rel=RTOL)


def test_counterweights_against_a_rotating_moment_published() -> None:
    inputs, expected = check("002-rot-moment-cw")
    half = inputs["l_np"] / 2
    throws = [
        throw(d, z=z, rotating_kg=inputs["m_r"], radius_m=inputs["r"])
        for d, z in ((0.0, inputs["l"] / 2), (180.0, -inputs["l"] / 2))
    ]
    arrays = layout(machine(*throws, webs=[web("a", half), web("b", -half)]))
    # the two masses for which force and moment vanish
    responses = first_order_responses(arrays, rotating(arrays))
    unbalance = np.linalg.solve(
        np.array([r.influence for r in responses], dtype=complex), -np.array([r.baseline.co for r in responses])
    )
    np.testing.assert_allclose(np.abs(unbalance) / inputs["r_np"], expected["m_each"], rtol=RTOL)
    left = rotating(arrays).plus(counterweights(arrays, unbalance))
    assert left.force.peak == pytest.approx(0.0, abs=1e-12)
    assert left.moment.peak == pytest.approx(0.0, abs=1e-12)


def test_partial_balance_of_a_horizontal_row_analytic() -> None:
    inputs, expected = check("002-partial-horizontal")
    arrays = layout(machine(throw(0, row(0, inputs["m_s"]), radius_m=inputs["r"])))
    rules = force_rules(ellipse(reciprocating(arrays, 1).force), OMEGA**2)
    assert [rule.transferred_share for rule in rules] == inputs["k"]
    total_mass_radii_kg_m = [rule.total_mass_radius_kg_m / 2 / inputs["r_np"] for rule in rules]
    np.testing.assert_allclose(total_mass_radii_kg_m, expected["m_each"], rtol=RTOL)


def test_partial_balance_of_the_moment_of_two_rows_published() -> None:
    inputs, expected = check("002-two180-moment-cw")
    half = inputs["l"] / 2
    arrays = layout(
        machine(*[throw(d, row(90, inputs["m_s"]), z=z, radius_m=inputs["r"]) for d, z in ((0, half), (180, -half))])
    )
    rules = moment_rules(ellipse(reciprocating(arrays, 1).moment), OMEGA**2, inputs["l_np"])
    assert [rule.transferred_share for rule in rules] == inputs["k"]
    total_mass_radii_kg_m = [rule.total_mass_radius_kg_m / 2 / inputs["r_np"] for rule in rules]
    np.testing.assert_allclose(total_mass_radii_kg_m, expected["m_each"], rtol=RTOL)


def test_no_figure_is_left_out() -> None:
    tested = {"001-masses", "002-V-rotmass", "002-cw-force", "002-rot-moment-cw", "002-partial-horizontal"}
    tested |= {"002-two180-moment-cw"}
    carried: list[Any] = [p.values[0]["id"] for topic in ("masses", "counterweights") for p in checks(topic)]
    assert set(carried) == tested
    assert len(checks("layout")) == 22


def test_unequal_opposed_rows_leave_their_difference_published() -> None:
    """2D12 of seed 004, section 2.9: masses 303.60 and 277.53 kg at 52.33 rad/s, kinematics of order 2."""
    throws = [throw(0, row(0, 303.60), z=0.175), throw(180, row(180, 277.53), z=-0.175)]
    square = 52.33**2
    arrays = layout(machine(*throws))
    assert reciprocating(arrays, 1).force.peak * square == pytest.approx(9994.7, abs=0.1)
    assert reciprocating(arrays, 1).moment.peak * square == pytest.approx(0.35 * 111396.8, abs=0.1)
