"""Optima by another route: least mass over the revolution at all angles at once, and a front point by point.

Independent: the mechanics are written down here, and one convex program has every angle in it, without cuts.
"""

import copy
from typing import Any, NamedTuple

import cvxpy
import numpy as np
import pytest
from numpy.typing import NDArray

from optimizer.studies.pareto.pareto import pareto
from schemas.front.pareto import ParetoRequest
from tests.pairs.machines import BASES
from tests.verification.checking import optimized

Body = dict[str, Any]
Vector = NDArray[np.complex128]
#: shaft angles, of which the largest load misses 1e-6
ANGLES = np.linspace(0.0, 2 * np.pi, 2_000, endpoint=False)


class Load(NamedTuple):
    """What turns with the shaft as the shaft sees it: planes [m], and forces (n, angles) in N."""

    planes: list[float]
    forces: list[Vector]


def omega(body: Body) -> float:
    return float(body["machine"]["speed_rpm"]) * np.pi / 30


def masses(row: Body) -> tuple[float, float]:
    """What reciprocates, and what turns with the pin."""
    rod = row["connecting_rod"]
    part = rod["reciprocating_share"] * rod["mass_kg"]
    return row["reciprocating_mass_kg"] + part, rod["mass_kg"] - part


def load(body: Body) -> Load:
    """Rows and rotating masses, by the exact stroke."""
    actual_load = Load([], [])
    for throw in body["machine"]["throws"]:
        radius, crank = throw["crank_radius_m"], np.deg2rad(throw["crank_angle_deg"])
        turning = throw["rotating_mass_kg"] + sum(masses(row)[1] for row in throw["rows"])
        actual_load.planes.append(throw["position_m"])
        actual_load.forces.append(np.full(ANGLES.size, turning * radius * omega(body) ** 2 * np.exp(1j * crank)))
        for row in throw["rows"]:
            axis, ratio = np.deg2rad(row["axis_deg"]), radius / row["connecting_rod"]["length_m"]
            own = ANGLES + crank - axis
            sine, cosine = np.sin(own), np.cos(own)
            leaning = np.sqrt(1 - (ratio * sine) ** 2)
            outward = cosine + ratio * np.cos(2 * own) / leaning + ratio**3 * (sine * cosine) ** 2 / leaning**3
            pull = masses(row)[0] * radius * omega(body) ** 2 * outward
            actual_load.planes.append(throw["position_m"])
            actual_load.forces.append(
                pull * np.exp(1j * axis) * (1 - 1j * ratio * sine / leaning) * np.exp(-1j * ANGLES)
            )
    return actual_load


def test_the_least_mass_over_the_revolution() -> None:
    body = copy.deepcopy(dict(BASES["twin"]))
    body["objective"] = {"force_weight": 0, "moment_weight": 0, "bearing_weight": 1}
    answer = optimized(body)
    proof = answer.certificate
    assert answer.status == "optimal"
    assert proof is not None
    webs, (first, last) = body["machine"]["webs"], [bearing["position_m"] for bearing in body["machine"]["bearings"]]
    weights = cvxpy.Variable(len(webs), complex=True)
    rows, largest = load(body), cvxpy.Variable()
    limits = [cvxpy.abs(weights) <= [web["max_mass_kg"] * web["counterweight_radius_m"] for web in webs]]
    for here, there in ((first, last), (last, first)):

        def share(place: float, here: float = here, level: float = there) -> float:
            """Lever rule."""
            return (place - level) / (here - level)

        still = sum(share(plane) * force for plane, force in zip(rows.planes, rows.forces, strict=True))
        added = sum(share(web["position_m"]) * weights[k] for k, web in enumerate(webs))
        # in kN: what a solver likes
        limits.append(cvxpy.abs(still / 1e3 + omega(body) ** 2 / 1e3 * added) <= largest)
    best = cvxpy.Problem(cvxpy.Minimize(largest), limits).solve(solver=cvxpy.CLARABEL)
    assert 1e3 * best == pytest.approx(proof.objective, rel=3e-6)
    assert proof.mass_objective_limit is not None
    assert proof.mass_lower_bound_kg is not None
    mass = cvxpy.sum(cvxpy.multiply(cvxpy.abs(weights), [1 / web["counterweight_radius_m"] for web in webs]))
    masks = [*limits, largest <= proof.mass_objective_limit / 1e3]
    least = cvxpy.Problem(cvxpy.Minimize(mass), masks).solve(solver=cvxpy.CLARABEL)
    # fewer angles allow a little less
    assert proof.mass_lower_bound_kg * (1 - 1e-3) <= least <= answer.total_mass_kg * (1 + 1e-6)


def test_every_point_of_a_front_has_the_least_force_with_its_moment() -> None:
    body = copy.deepcopy(dict(BASES["twin"]))
    machine, square = body["machine"], omega(body) ** 2
    # what force and moment compete for
    machine["max_total_mass_kg"] = 4.0
    answer = pareto(ParetoRequest.model_validate({**body, "points": 4}))
    (front,) = answer.fronts
    co, counter, places = [], [], []
    for throw in machine["throws"]:
        crank = np.exp(1j * np.deg2rad(throw["crank_angle_deg"]))
        size, turning = throw["crank_radius_m"] * square, throw["rotating_mass_kg"]
        moving = 0j
        for row in throw["rows"]:
            reciprocating, with_pin = masses(row)
            turning += with_pin + reciprocating / 2
            moving += reciprocating / 2 * np.exp(2j * np.deg2rad(row["axis_deg"])) / crank
        places.append(throw["position_m"])
        co.append(turning * size * crank)
        counter.append(moving * size)
    arms = np.array(places) - answer.reference_plane_m
    webs = machine["webs"]
    weights = cvxpy.Variable(len(webs), complex=True)
    own = np.array([web["position_m"] for web in webs]) - answer.reference_plane_m
    masses_kg = cvxpy.multiply(cvxpy.abs(weights), [1 / web["counterweight_radius_m"] for web in webs])
    limits = [masses_kg <= [web["max_mass_kg"] for web in webs], cvxpy.sum(masses_kg) <= 4.0]
    force = cvxpy.abs(np.sum(co) / 1e3 + square / 1e3 * cvxpy.sum(weights)) + abs(np.sum(counter)) / 1e3
    moment = cvxpy.abs(arms @ np.array(co) / 1e3 + square / 1e3 * (own @ weights)) + abs(arms @ np.array(counter)) / 1e3
    assert len(front.points) > 1
    for point in front.points:
        slack = 1e-9 * front.points[0].moment_peak_Nm / 1e3
        problem = cvxpy.Problem(cvxpy.Minimize(force), [*limits, moment <= point.moment_peak_Nm / 1e3 + slack])
        least = 1e3 * problem.solve(solver=cvxpy.CLARABEL)
        # at the smallest moment there is the force falls as the root of what a solver allows
        steep = point is front.points[-1]
        assert least == pytest.approx(point.force_peak_N, rel=1e-4 if steep else 1e-5)
