"""The stages as data: what acts, what is left, and the iron of stage VII for any share."""

from typing import Any

import numpy as np
import pytest

from optimizer.mechanics.inertia import counterweights, reciprocating, rotating
from optimizer.mechanics.layout import layout
from schemas.answer.outputs import Stage
from tests.builders import OMEGA, RADIUS, all_stages, inline, machine, opposed, row, throw, web

F0 = 10.0 * RADIUS * OMEGA**2
TWO = [web("a", 0.5), web("b", -0.5)]


def stages_by_name(*throws: Any, unbalance: Any = (0, 0)) -> dict[str, Stage]:
    fitted = None if unbalance is None else np.asarray(unbalance, dtype=complex)
    return {stage.stage: stage for stage in all_stages(layout(machine(*throws, webs=TWO)), fitted)}


def test_a_single_row_published() -> None:
    """Balancing, slides, single row: rotating force along the crank; first and second order along the axis."""
    stages = stages_by_name(throw(0.0, row(90), rotating_kg=10.0))
    first, _, third, fourth, fifth, _ = (stages[name].acting[0] for name in ("I", "II", "III", "IV", "V", "VI"))
    assert (first.motion, first.direction_deg, first.peak) == ("with_shaft", 0.0, pytest.approx(F0))
    assert (third.motion, third.direction_deg, third.minor) == (
        "fixed",
        pytest.approx(90.0),
        pytest.approx(0, abs=1e-9),
    )
    assert (fourth.motion, fourth.direction_deg, fourth.unit) == ("none", None, "N m")
    assert (fifth.motion, fifth.order, fifth.direction_deg) == ("fixed", 2, pytest.approx(90.0))
    assert fifth.frequency_Hz == pytest.approx(2.0 * OMEGA / (2.0 * np.pi))
    # without counterweights all is left
    for name in ("I", "III", "V"):
        assert stages[name].left == stages[name].acting


def test_half_the_force_taken_leaves_a_circle_backward_published() -> None:
    """k = 1/2: a circle of F0/2 against the shaft."""
    iron = stages_by_name(throw(0.0, row(90)))["VII"].iron
    half = [0.5 * complex(stage_iron.reciprocating_x_kg_m, stage_iron.reciprocating_y_kg_m) for stage_iron in iron]
    (left,) = stages_by_name(throw(0.0, row(90)), unbalance=half)["III"].left or ()
    assert (left.motion, left.peak) == ("against_shaft", pytest.approx(F0 / 2.0))


@pytest.mark.parametrize("share", [0.0, 0.25, 0.5, 1.0])
def test_iron_of_any_share_leaves_the_rest_analytic(share: float) -> None:
    """Along the cylinders 1 - k of the first-order moment, across them k of it (two rows at 180 degrees)."""
    throws = inline([0, 180], [0.3, -0.3])
    stages = stages_by_name(*throws)
    iron = stages["VII"].iron
    assert [stage_iron.position_m for stage_iron in iron] == [-0.5, 0.5]
    turning = [complex(stage_iron.rotating_x_kg_m, stage_iron.rotating_y_kg_m) for stage_iron in iron]
    moving = [complex(stage_iron.reciprocating_x_kg_m, stage_iron.reciprocating_y_kg_m) for stage_iron in iron]
    # webs a and b stand in the planes the other way round
    unbalance = np.array([turn + share * move for turn, move in zip(turning, moving, strict=True)])[::-1]
    arrays = layout(machine(*throws, webs=TWO))
    whole = rotating(arrays).plus(reciprocating(arrays, 1)).plus(counterweights(arrays, unbalance))
    moment = float(stages["IV"].acting[0].peak) / OMEGA**2
    # cranks along x at angle 0, cylinders along y
    turn = np.array([np.pi / 2.0, 0.0])
    at = whole.moment.at(turn)
    assert np.abs(at[0]) == pytest.approx((1.0 - share) * moment, abs=1e-12)
    assert np.abs(at[1]) == pytest.approx(share * moment, abs=1e-12)
    assert whole.force.peak == pytest.approx(0.0, abs=1e-12)


def test_the_summary_names_all_that_is_left_published() -> None:
    """An opposed pair: no forces; a moment of each order in the plane of the axes."""
    left = stages_by_name(*opposed([0, 180], [0.3, -0.3]))["VIII"].left
    assert left is not None
    assert [(part.quantity, part.order, part.motion) for part in left if part.motion != "none"] == [
        ("moment", 1, "ellipse"), ("moment", 2, "fixed"),
    ]  # fmt: skip


def test_nothing_is_left_where_there_are_no_counterweights_to_show() -> None:
    stages = stages_by_name(throw(0.0, row(90)), unbalance=None)
    assert [stage.left for stage in stages.values()] == [None] * 8
    assert [len(stages[name].iron) for name in ("VI", "VII", "VIII")] == [0, 2, 0]


def test_iron_of_webs_far_from_the_machine_analytic() -> None:
    """Analytic: the lever rule, of webs 0.1 m apart that are 700 m away."""
    arrays = layout(machine(throw(0.0, row(90), z=700.0, rotating_kg=10.0), webs=[web("a", 0.0), web("b", 0.1)]))
    low, high = all_stages(arrays, None)[6].iron
    size = 10.0 * RADIUS
    assert low.rotating_x_kg_m == pytest.approx(size * (700.0 - 0.1) / 0.1, rel=1e-14)
    assert high.rotating_x_kg_m == pytest.approx(-size * 700.0 / 0.1, rel=1e-14)
