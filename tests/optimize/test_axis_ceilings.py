"""Ceilings on the peaks along one axis: where they bind, what they cost, when they conflict."""

import math
from typing import Any

import numpy as np
import pytest
from pydantic import ValidationError

from optimizer.pareto.pareto import pareto
from schemas.answers import OptimizeAnswer
from schemas.pareto import ParetoRequest
from schemas.requests import OptimizeRequest
from tests.optimize.machines import first_order, machine, random_machine, row, throw, web
from tests.verification.checking import optimized

OMEGA_SQUARED = (600 * math.pi / 30) ** 2
#: m r omega^2 of one row along y, 20 kg at 0.1 m
WHOLE = 20.0 * 0.1 * OMEGA_SQUARED
FIELDS = ("force_ceiling_x_N", "force_ceiling_y_N", "moment_ceiling_x_Nm", "moment_ceiling_y_Nm")


def upright() -> dict[str, Any]:
    return machine([throw(0.0, 90.0, [row(90.0, 20.0)])], [web("a", 0.0)])


def answer(body: dict[str, Any], **objective: Any) -> OptimizeAnswer:
    return optimized({"machine": body, "objective": objective})


def test_a_ceiling_along_the_axis_of_a_row_moves_force_to_the_other() -> None:
    # analytic: a share t of the row's unbalance opposite its crank leaves 1 - t along y and t along x, the larger
    # of which is the peak
    found = answer(upright(), force_ceiling_y_N=0.3 * WHOLE)
    after = found.residual.after
    assert (found.status, found.active_limits) == ("optimal", ("force_ceiling_y",))
    assert after.force.peak_y_N == pytest.approx(0.3 * WHOLE, rel=1e-8)
    assert after.force.peak_x_N == pytest.approx(0.7 * WHOLE, rel=1e-8)
    assert found.total_mass_kg == pytest.approx(0.7 * 20.0, rel=1e-6)
    price = next(one for one in found.shadow_prices if one.limit == "force_ceiling_y")
    assert price.unit == "N/N"
    assert price.value == pytest.approx(1.0, rel=1e-6)


def test_ceilings_of_both_axes_conflict_together() -> None:
    found = answer(upright(), force_ceiling_x_N=0.4 * WHOLE, force_ceiling_y_N=0.5 * WHOLE)
    assert found.status == "infeasible"
    why = found.infeasibility
    assert why.conflict == ("force_ceiling_x_N", "force_ceiling_y_N")
    # analytic: either axis alone can be made free of force
    assert [(one.response, one.ceiling_field) for one in why.smallest] == [
        ("force:x", "force_ceiling_x_N"),
        ("force:y", "force_ceiling_y_N"),
    ]
    assert [one.smallest for one in why.smallest] == pytest.approx([0.0, 0.0], abs=1e-6 * WHOLE)
    # each excess relative to the larger of ceiling and force without counterweights: (t - 0.4)/0.4 = (0.5 - t)/1
    closest = why.closest.first_order.force
    assert closest.peak_x_N == pytest.approx(0.6 / 1.4 * WHOLE, rel=1e-5)
    assert closest.peak_y_N == pytest.approx(0.8 / 1.4 * WHOLE, rel=1e-5)


def test_a_ceiling_that_cannot_be_kept_says_by_how_much() -> None:
    # analytic: 2 kg at 0.1 m take 0.1 off
    body = upright() | {"webs": [web("a", 0.0, 2.0)]}
    found = answer(body, force_ceiling_y_N=0.85 * WHOLE, moment_ceiling_x_Nm=1e6)
    assert found.infeasibility.conflict == ("force_ceiling_y_N",)
    reached = {one.response: one for one in found.infeasibility.smallest}["force:y"]
    assert reached.smallest == pytest.approx(0.9 * WHOLE, rel=1e-8)
    assert reached.lower_bound == pytest.approx(0.9 * WHOLE, rel=1e-7)


@pytest.mark.parametrize("seed", range(6))
def test_components_over_the_turn_stay_below_their_ceilings(seed: int) -> None:
    body = random_machine(seed)
    before, after = (getattr(answer(body).residual, when) for when in ("before", "after"))
    sizes = {
        name: 0.5 * (getattr(b, peak) + getattr(a, peak))
        for name, (a, b, peak) in zip(
            FIELDS,
            (
                (after.force, before.force, "peak_x_N"),
                (after.force, before.force, "peak_y_N"),
                (after.moment, before.moment, "peak_x_Nm"),
                (after.moment, before.moment, "peak_y_Nm"),
            ),
            strict=True,
        )
    }
    found = answer(body, **sizes)
    assert found.status == "optimal"
    fitted = [one.model_dump() for one in found.counterweights]
    # independent: forces and couples summed by hand over the turn
    turn = np.array([first_order(body, fitted, theta) for theta in np.arange(0.0, 360.0, 0.5)])
    peaks = np.max(np.abs([turn[:, 0].real, turn[:, 0].imag, turn[:, 1].real, turn[:, 1].imag]), axis=-1)
    assert np.all(peaks <= np.array(list(sizes.values())) * (1 + 1e-8) + 1e-9)


def test_a_front_keeps_them() -> None:
    body = {"machine": upright(), "objective": {"force_ceiling_x_N": 0.3 * WHOLE}, "points": 3}
    (front,) = pareto(ParetoRequest.model_validate(body)).fronts
    # analytic: force and moment are smallest together at t = 0.3 that the ceiling leaves
    (point,) = front.points
    assert point.force_peak_N == pytest.approx(0.7 * WHOLE, rel=1e-6)
    assert point.active_limits == ("force_ceiling_x",)


@pytest.mark.parametrize("field", FIELDS)
def test_they_are_of_the_first_order(field: str) -> None:
    with pytest.raises(ValidationError, match="of the first order") as refused:
        OptimizeRequest.model_validate({"machine": upright(), "objective": {"orders": "all", field: 10.0}})
    (problem,) = refused.value.errors()[0]["ctx"]["problems"]
    assert problem.path == (field,)
