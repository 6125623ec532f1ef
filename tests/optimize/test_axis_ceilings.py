"""Ceilings on the peaks along one axis: where they bind, what they cost, when they conflict."""

import math
from typing import Any

import numpy as np
import pytest

from optimizer.studies.pareto.pareto import pareto
from schemas.answer.answers import OptimizeAnswer
from schemas.front.pareto import ParetoRequest
from tests.hard_turn import machines
from tests.optimize.machines import first_order, machine, random_machine, row, throw, web
from tests.optimize.whole_turn import single_throw
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
    optimum = answer(upright(), force_ceiling_y_N=0.3 * WHOLE)
    after = optimum.residual.after
    assert (optimum.status, optimum.active_limits) == ("optimal", ("force_ceiling_y",))
    assert after.force.peak_y_N == pytest.approx(0.3 * WHOLE, rel=1e-8)
    assert after.force.peak_x_N == pytest.approx(0.7 * WHOLE, rel=1e-8)
    assert optimum.total_mass_kg == pytest.approx(0.7 * 20.0, rel=1e-6)
    price = next(shadow_price for shadow_price in optimum.shadow_prices if shadow_price.limit == "force_ceiling_y")
    assert price.unit == "N/N"
    assert price.value == pytest.approx(1.0, rel=1e-6)


def test_ceilings_of_both_axes_conflict_together() -> None:
    optimum = answer(upright(), force_ceiling_x_N=0.4 * WHOLE, force_ceiling_y_N=0.5 * WHOLE)
    assert optimum.status == "infeasible"
    why = optimum.infeasibility
    assert why.conflict == ("force_ceiling_x_N", "force_ceiling_y_N")
    # analytic: either axis alone can be made free of force
    assert [(peak.response, peak.ceiling_field) for peak in why.smallest] == [
        ("force:x", "force_ceiling_x_N"),
        ("force:y", "force_ceiling_y_N"),
    ]
    assert [peak.smallest for peak in why.smallest] == pytest.approx([0.0, 0.0], abs=1e-6 * WHOLE)
    # each excess relative to the larger of ceiling and force without counterweights: (t - 0.4)/0.4 = (0.5 - t)/1
    closest = why.closest.first_order.force
    assert closest.peak_x_N == pytest.approx(0.6 / 1.4 * WHOLE, rel=1e-5)
    assert closest.peak_y_N == pytest.approx(0.8 / 1.4 * WHOLE, rel=1e-5)


def test_a_ceiling_that_cannot_be_kept_says_by_how_much() -> None:
    # analytic: 2 kg at 0.1 m take 0.1 off
    body = upright() | {"webs": [web("a", 0.0, 2.0)]}
    optimum = answer(body, force_ceiling_y_N=0.85 * WHOLE, moment_ceiling_x_Nm=1e6)
    assert optimum.infeasibility.conflict == ("force_ceiling_y_N",)
    reached = {peak.response: peak for peak in optimum.infeasibility.smallest}["force:y"]
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
    optimum = answer(body, **sizes)
    assert optimum.status == "optimal"
    fitted = [counterweight.model_dump() for counterweight in optimum.counterweights]
    # independent: forces and couples summed by hand over the turn
    force, moment = first_order(body, fitted, np.arange(0.0, 360.0, 0.5))
    peaks = np.max(np.abs([force.real, force.imag, moment.real, moment.imag]), axis=-1)
    assert np.all(peaks <= np.array(list(sizes.values())) * (1 + 1e-8) + 1e-9)


def test_a_front_keeps_them() -> None:
    body = {"machine": upright(), "objective": {"force_ceiling_x_N": 0.3 * WHOLE}, "points": 3}
    (front,) = pareto(ParetoRequest.model_validate(body)).fronts
    # analytic: force and moment are smallest together at t = 0.3 that the ceiling leaves
    (point,) = front.points
    assert point.force_peak_N == pytest.approx(0.7 * WHOLE, rel=1e-6)
    assert point.active_limits == ("force_ceiling_x",)


def along_x(**objective: Any) -> OptimizeAnswer:
    """m r = 1 reciprocating along x on a rod of ratio 0.3, and a web in its plane, at 1 rad/s; all orders."""
    body = single_throw(1.0 / 0.3)
    body["throws"][0]["rotating_mass_kg"] = 0.0
    body["webs"] = [{"name": "w", "position_m": 0.0, "counterweight_radius_m": 1.0, "max_mass_kg": 9.0}]
    return optimized({"machine": body, "objective": {"orders": "all", "moment_weight": 0, **objective}})


@pytest.mark.parametrize(
    ("ceiling", "mass"),
    [({"force_ceiling_y_N": 0.2}, 0.2), ({"force_ceiling_x_N": 0.5}, 0.8), ({"force_ceiling_x_N": 1.25}, 0.603531)],
)
def test_all_orders_keep_ceilings_along_axes(ceiling: dict[str, float], mass: float) -> None:
    """Analytic: a web c opposite the crank puts c along y, and leaves 1 + lam - c along x at the inner dead centre.

    Published in the mathematics of this project: without ceilings c is .603531.
    """
    response = along_x(**ceiling)
    assert response.status == "optimal"
    assert response.total_mass_kg == pytest.approx(mass, abs=1e-3 if mass == 0.603531 else 4e-6)
    assert response.active_limits == ((next(iter(ceiling)).removesuffix("_N"),) if mass != 0.603531 else ())


def test_all_orders_cannot_come_below_what_is_left_along_an_axis() -> None:
    """Published in the mathematics of this project: lam/sqrt(1 - lam^2) is left along x, whatever the web."""
    response = along_x(force_ceiling_x_N=0.3)
    assert response.infeasibility is not None
    assert response.infeasibility.conflict == ("force_ceiling_x_N",)
    (least,) = response.infeasibility.smallest
    assert (least.response, least.ceiling_field) == ("force:x", "force_ceiling_x_N")
    assert least.smallest == pytest.approx(0.3 / math.sqrt(1.0 - 0.09), rel=1e-6)
    assert least.lower_bound == pytest.approx(least.smallest, rel=1e-6)
    # analytic: along x at most 0.5 needs 0.8 of the web, which is what is then along y
    both = along_x(force_ceiling_x_N=0.5, force_ceiling_y_N=0.7)
    assert both.infeasibility is not None
    assert set(both.infeasibility.conflict) == {"force_ceiling_x_N", "force_ceiling_y_N"}


@pytest.mark.parametrize("rotation", ["ccw", "cw"])
def test_all_orders_of_a_v_keep_ceilings_of_either_sense(rotation: str) -> None:
    """Independent: forces and couples of all orders summed by hand over the turn."""
    body = machines.shaft([0.0, 90.0, 200.0], (45.0, 120.0), rotation=rotation)
    free = optimized({"machine": body, "objective": {"orders": "all"}})
    peaks = all_orders(body, free)
    allowed = dict(zip(FIELDS, (0.98 * peaks[0], 1.5 * peaks[1], 1.3 * peaks[2], 0.97 * peaks[3]), strict=True))
    optimum = optimized({"machine": body, "objective": {"orders": "all", **allowed}})
    assert optimum.status == "optimal"
    assert set(optimum.active_limits) <= {field.rpartition("_")[0] for field in FIELDS}
    assert optimum.active_limits
    there = all_orders(body, optimum)
    assert np.all(there <= np.array(list(allowed.values())) * (1 + 1e-8))
    touched = [field.rpartition("_")[0] in optimum.active_limits for field in FIELDS]
    assert there[touched] == pytest.approx(np.array(list(allowed.values()))[touched], rel=1e-5)


def all_orders(body: dict[str, Any], optimum: OptimizeAnswer) -> np.ndarray:
    """Peaks of force and couple about the reference plane, x and y of each."""
    omega, sense = body["speed_rpm"] * math.pi / 30, 1 if body["rotation"] == "ccw" else -1
    turn = np.deg2rad(np.arange(0.0, 360.0, 0.05))
    swing = np.exp(1j * sense * turn)
    force, moment = np.zeros(turn.size, complex), np.zeros(turn.size, complex)

    def put(vector: np.ndarray, plane: float) -> None:
        nonlocal force, moment
        force, moment = force + vector, moment + vector * (plane - optimum.reference_plane_m)

    for body_throw in body["throws"]:
        radius, crank = body_throw["crank_radius_m"], np.deg2rad(body_throw["crank_angle_deg"])
        put(body_throw["rotating_mass_kg"] * radius * omega**2 * np.exp(1j * crank) * swing, body_throw["position_m"])
        for line in body_throw["rows"]:
            rod = line["connecting_rod"]
            axis, lam = np.deg2rad(line["axis_deg"]), radius / rod["length_m"]
            phi = crank + sense * turn - axis
            # the second derivative of r cos phi + sqrt(l^2 - r^2 sin^2 phi), to first order of nothing
            upright = np.sqrt(1.0 - (lam * np.sin(phi)) ** 2)
            outward = np.cos(phi) + lam * np.cos(2 * phi) / upright
            outward += lam**3 * (np.sin(phi) * np.cos(phi)) ** 2 / upright**3
            mass = line["reciprocating_mass_kg"] + rod["reciprocating_share"] * rod["mass_kg"]
            plane = body_throw["position_m"] + line["offset_m"]
            put(mass * radius * omega**2 * outward * np.exp(1j * axis), plane)
            # the other end of the rod goes round with the pin
            put(
                (1 - rod["reciprocating_share"]) * rod["mass_kg"] * radius * omega**2 * np.exp(1j * crank) * swing,
                plane,
            )
    places = {body_web["name"]: body_web for body_web in body["webs"]}
    for counterweight in optimum.counterweights:
        at = places[counterweight.web]
        product = counterweight.mass_kg * at["counterweight_radius_m"] * omega**2
        put(product * np.exp(1j * np.deg2rad(counterweight.angle_deg)) * swing, at["position_m"])
    return np.max(np.abs([force.real, force.imag, moment.real, moment.imag]), axis=-1)
