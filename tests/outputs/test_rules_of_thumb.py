"""The partial balances of seed 002, beside the ellipse that they leave."""

import numpy as np
import pytest

from optimizer.mechanics.inertia import reciprocating
from optimizer.mechanics.layout import layout
from optimizer.outputs.rules_of_thumb import force_rules, moment_rules
from optimizer.responses.response import Phasors
from schemas.answer.outputs import RuleOfThumb
from tests.builders import OMEGA, RADIUS, all_stages, ellipse, inline, machine, opposed, row, throw, web

F0 = 10.0 * RADIUS * OMEGA**2


def rules_of(*throws: object) -> tuple[RuleOfThumb, ...]:
    return force_rules(ellipse(reciprocating(layout(machine(*throws)), 1).force), OMEGA**2)


def pair(co: complex, counter: complex) -> Phasors:
    return Phasors(np.asarray(co), np.asarray(counter))


@pytest.mark.parametrize(
    ("axis_deg", "shares"),
    [
        pytest.param(90.0, (0.2, 0.3), id="published-vertical"),
        pytest.param(-90.0, (0.2, 0.3), id="published-upside-down"),
        pytest.param(60.0, (0.2, 0.3), id="analytic-nearer-vertical"),
        pytest.param(45.0, (0.3, 0.5), id="analytic-halfway-counts-as-horizontal"),
        pytest.param(135.0, (0.3, 0.5), id="analytic-the-other-halfway-too"),
        pytest.param(0.0, (0.3, 0.5), id="published-horizontal"),
        pytest.param(180.0, (0.3, 0.5), id="published-horizontal-other-way"),
    ],
)
def test_a_single_row(axis_deg: float, shares: tuple[float, ...]) -> None:
    """k F0 across and (1 - k) F0 along, with 2 m_np r_np = k m_s r (seed 002 lines 253-422)."""
    thumbs = rules_of(throw(20.0, row(axis_deg)))
    assert tuple(rule.transferred_share for rule in thumbs) == shares
    for rule in thumbs:
        k = rule.transferred_share
        assert rule.peak_along == pytest.approx((1 - k) * F0)
        assert rule.peak_across == pytest.approx(k * F0)
        assert rule.peak == pytest.approx(max(k, 1 - k) * F0)
        assert rule.total_mass_radius_kg_m == pytest.approx(k * 10.0 * RADIUS)


def test_the_peaks_are_those_of_the_remaining_ellipse_independent() -> None:
    """Along and across from the components of the force over a turn."""
    first = reciprocating(layout(machine(throw(0, row(60), row(120)))), 1).force
    (rule,) = force_rules(ellipse(first), OMEGA**2)
    left = pair(complex(first.co - rule.total_mass_radius_kg_m * first.co / abs(first.co)), first.counter)
    turn = left.at(np.linspace(0, 2 * np.pi, 3601)) * OMEGA**2
    assert rule.peak == pytest.approx(np.abs(turn).max(), rel=1e-6)
    assert rule.peak_along == pytest.approx(np.abs(turn.imag).max(), rel=1e-6)  # the bisector is y
    assert rule.peak_across == pytest.approx(np.abs(turn.real).max(), rel=1e-6)


def test_v_type_half_the_sum_of_the_extremes_published() -> None:
    """J_np = (J_max + J_min)/2 leaves (m1 - m2)/2 on both axes (seed 002 lines 837-863)."""
    (rule,) = rules_of(throw(0, row(0, 12.0), row(-90, 7.0)))
    assert rule.total_mass_radius_kg_m == pytest.approx(9.5 * RADIUS)
    for peak in (rule.peak, rule.peak_along, rule.peak_across):
        assert peak == pytest.approx(2.5 * RADIUS * OMEGA**2)


@pytest.mark.parametrize(
    ("co", "counter"),
    [
        pytest.param(1.0, 0.0, id="can be balanced completely"),
        pytest.param(0.0, 1.0, id="cannot be balanced at all"),
        pytest.param(0.0, 0.0, id="nothing"),
    ],
)
def test_no_rule_where_there_is_nothing_to_turn(co: float, counter: float) -> None:
    assert force_rules(ellipse(pair(co, counter)), 1.0) == ()
    assert moment_rules(ellipse(pair(co, counter)), 1.0, 1.0) == ()


@pytest.mark.parametrize(
    ("throws", "shares"),
    [
        pytest.param(inline([0, 180], [0.3, -0.3]), (0.15, 0.5), id="published-vertical"),
        pytest.param(opposed([0, 180], [0.3, -0.3]), (0.5,), id="published-horizontal"),
    ],
)
def test_moments(throws: list[object], shares: tuple[float, ...]) -> None:
    """m_np = k m_s (r / r_np)(l / l_np), twice (seed 002 lines 493-503)."""
    first = reciprocating(layout(machine(*throws)), 1).moment  # type: ignore[arg-type]
    thumbs = moment_rules(ellipse(first), OMEGA**2, 0.84)
    assert tuple(rule.transferred_share for rule in thumbs) == shares
    for rule in thumbs:
        k = rule.transferred_share
        assert rule.total_mass_radius_kg_m == pytest.approx(2 * k * 10.0 * RADIUS * 0.6 / 0.84)
        assert (rule.peak_along, rule.peak_across) == pytest.approx(((1 - k) * 0.6 * F0, k * 0.6 * F0))


def test_no_couple_without_two_planes_and_no_rule_for_other_moments() -> None:
    assert moment_rules(ellipse(pair(1.0, 1.0)), 1.0, 0.0) == ()
    assert moment_rules(ellipse(pair(1.0, 0.5)), 1.0, 1.0) == ()


def test_rules_stand_at_stages_iii_and_iv_only() -> None:
    throws = inline([0, 90], [0.3, -0.3])
    stages = all_stages(layout(machine(*throws, webs=[web("a", 0.42), web("b", -0.42)])), np.zeros(2, complex))
    assert [len(stage.rules_of_thumb) for stage in stages] == [0, 0, 2, 2, 0, 0, 0, 0]
    assert len(all_stages(layout(machine(*throws)), None)[3].rules_of_thumb) == 0
    names = [rule.name for stage in stages for rule in stage.rules_of_thumb]
    assert names[0] == "transfer 20 % of the first-order force"
    assert names[2] == "transfer 15 % of the first-order moment"
