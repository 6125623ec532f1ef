"""Counterweights on balance shafts that are at least so heavy, or not there."""

import cmath
import math
from itertools import product
from typing import Any

import cvxpy as cp
import numpy as np
import pytest

from optimizer.optimize import optimize
from schemas.answer.answers import OptimizeAnswer
from schemas.request.requests import OptimizeRequest
from service.common.validation import InvalidRequest, check
from tests.night import part
from tests.optimize.machines import row, throw, web
from tests.optimize.shafts import OMEGA, WHOLE, at, every_place, first_order, in_line_four, shaft, single
from tests.verification.checking import sound_answer

FORCE = {"moment_weight": 0}
SHARP = {"relative_gap": 1e-6, "time_limit_s": 30}


def answer(machine: dict[str, Any], goal: dict[str, Any], **more: Any) -> OptimizeAnswer:
    """The answer, no claim of which the independent checker breaks."""
    optimum = sound_answer({"machine": machine, "objective": goal, **more})
    for place, counterweight in zip(every_place(machine), every_weight(optimum), strict=True):
        assert counterweight.mass_kg == 0 or counterweight.mass_kg >= place.get("min_fitted_mass_kg", 0.0)
    return optimum


def every_weight(optimum: OptimizeAnswer) -> list[Any]:
    return [
        *optimum.counterweights,
        *(counterweight for of_shaft in optimum.balance_shafts for counterweight in of_shaft.counterweights),
    ]


@pytest.mark.parametrize(
    ("least", "left"),
    # analytic: of what turns backwards half is the shaft's, 10 kg at half the radius; a least above that leaves the
    # difference, and from twice that on nothing is better
    [(4.0, 0.0), (10.0, 0.0), (11.0, 0.05), (15.0, 0.25), (25.0, 0.5)],
)
def test_a_lanchester_shaft_cancels_what_its_least_leaves(least: float, left: float) -> None:
    machine = single([shaft("back", -1, radius=0.05, max_mass=200.0, min_fitted_mass_kg=least)])
    optimum = answer(machine, FORCE, accuracy=SHARP)
    assert optimum.status == "optimal"
    assert optimum.certificate.objective == pytest.approx(left * WHOLE, abs=3e-6 * WHOLE)
    assert optimum.certificate.lower_bound == pytest.approx(left * WHOLE, abs=3e-6 * WHOLE)
    assert optimum.balance_shafts_mass_kg == pytest.approx(max(least, 10.0) if left < 0.5 else 0.0, rel=1e-4)


def test_two_on_a_shaft_lean_apart() -> None:
    # analytic: two of 6 kg at +-a from 270 degrees pull as 10 kg with 12 cos a, each alone too light
    places = [web(name, 0.0, 200.0, radius=0.05, min_fitted_mass_kg=6.0) for name in ("p", "q")]
    machine = single([{"name": "back", "speed_ratio": -1, "webs": places}])
    optimum = answer(machine, FORCE, accuracy=SHARP)
    assert optimum.certificate.objective == pytest.approx(0.0, abs=3e-6 * WHOLE)
    pull = sum(
        cmath.rect(counterweight.mass_kg, math.radians(counterweight.angle_deg - 270.0))
        for counterweight in optimum.balance_shafts[0].counterweights
    )
    assert pull == pytest.approx(10.0, rel=1e-5)


def bracket(machine: dict[str, Any], pieces: int) -> tuple[float, float]:
    """What the first-order force and moment of a machine come to at least and at most, by convex programs of cvxpy.

    A least mass is that of a chord or of a tangent of each of so many pieces of its circle, or nothing is fitted.
    """
    places, order = every_place(machine), first_order(machine)
    mass = cp.Variable(len(places), complex=True)
    sums = [sum(cp.abs(part_force) for part_force in both) for both in order.terms(mass)]
    goal = sums[0] + sums[1] / order.span
    edge = [cp.Parameter(complex=True) for _ in places]
    floor = [cp.Parameter() for _ in places]
    most = [cp.Parameter(nonneg=True) for _ in places]
    free = [cp.abs(mass[k]) <= most[k] for k in range(len(places))]
    free += [cp.real(cp.conj(edge[k]) * mass[k]) >= floor[k] for k in range(len(places))]
    problem = cp.Problem(cp.Minimize(goal * OMEGA**2 * 1e-3), free)
    ways = [[None, *range(pieces)] if place.get("min_fitted_mass_kg") else [-1] for place in places]
    results = []
    for share in (math.cos(math.pi / pieces), 1.0):
        best = np.inf
        for way in product(*ways):
            for k, (place, piece) in enumerate(zip(places, way, strict=True)):
                edge[k].value = np.exp(2j * np.pi * (piece or 0) / pieces)
                fitted = piece is not None and piece >= 0
                floor[k].value = share * place["min_fitted_mass_kg"] if fitted else -1e3
                most[k].value = 0.0 if piece is None else place["max_mass_kg"]
            problem.solve(solver=cp.CLARABEL)
            if problem.status in ("optimal", "optimal_inaccurate"):
                best = min(best, float(problem.value) * 1e3)
        results.append(best)
    return results[0], results[1]


def two_throws(least: float, on_shaft: float) -> dict[str, Any]:
    """Two cylinders along y with cranks at right angles, one web on each and one on a shaft that turns backwards."""
    rows = [row(90.0, 10.0, connecting_rod={"length_m": 0.4})]
    machine = single([shaft("back", -1, 0.05, 40.0, radius=0.06, min_fitted_mass_kg=on_shaft)])
    machine["throws"] = [throw(0.0, 90.0, rows), throw(0.2, 200.0, [row(90.0, 8.0, connecting_rod={"length_m": 0.4})])]
    machine["webs"] = [web("a", 0.0, 20.0, min_fitted_mass_kg=least), web("b", 0.2, 20.0)]
    return machine


@pytest.mark.parametrize(("least", "on_shaft"), part(4, [(6.0, 9.0), (9.0, 4.0), (12.0, 12.0), (3.0, 20.0)], rows=True))
def test_no_choice_is_better_than_the_bound(least: float, on_shaft: float) -> None:
    # independent: programs of cvxpy in every piece of the circles of least masses
    machine = two_throws(least, on_shaft)
    optimum = answer(machine, {}, accuracy={"relative_gap": 1e-5, "time_limit_s": 30})
    low, high = bracket(machine, 20)
    proof = optimum.certificate
    assert optimum.status == "optimal"
    assert proof.lower_bound <= high * (1 + 1e-6)
    assert low * (1 - 1e-6) <= proof.objective <= high * (1 + 2e-5)
    assert high - low <= 0.03 * high


CASES = [
    {"name": "slow", "changes": [{"path": "/machine/speed_rpm", "value": 400}]},
    {"name": "place", "changes": [{"path": "/machine/balance_shafts/0/webs/0/position_m", "value": 0.05}]},
]
BACK = single([shaft("back", -1, radius=0.05, max_mass=100.0, min_fitted_mass_kg=12.0)])
WITHIN = single(
    [
        shaft("back", -1, max_mass=20.0, min_fitted_mass_kg=7.0, sector={"centre_deg": 250.0, "half_angle_deg": 15.0}),
        shaft("on", 1, max_mass=20.0, min_fitted_mass_kg=2.0),
    ]
)
TWICE = in_line_four(
    [shaft("a", 2, x_m=0.1, min_fitted_mass_kg=2.0, max_mass=20.0), shaft("b", -2, y_m=-0.1, max_mass=20.0)]
)


@pytest.mark.parametrize("machine", part(3, [TWICE, BACK, WITHIN]))
@pytest.mark.parametrize(
    "goal",
    part(
        4,
        [
            {},
            {"orders": "all"},
            {"orders": "all", "roll_weight": 1.0},
            {"moment_ceiling_x_Nm": 1000.0, "force_ceiling_y_N": 0.9 * WHOLE},
            {"combine": "max"},
            {"priorities": [{"goal": "external", "allowance": 0.05}, {"goal": "mass"}]},
        ],
    ),
)
@pytest.mark.parametrize(
    "more",
    part(
        2,
        [{}, {"scenarios": CASES}, {"tolerances": {"unbalance_kg_m": 0.01, "reciprocating_mass_relative": 0.02}}],
    ),
)
def test_no_claim_is_broken(machine: dict[str, Any], goal: dict[str, Any], more: dict[str, Any]) -> None:
    optimum = answer(machine, goal, accuracy={"relative_gap": 1e-2, "time_limit_s": 0.5}, **more)
    assert optimum.status in ("optimal", "inaccurate")


@pytest.mark.parametrize("rotation", part(2, ["ccw", "cw"]))
def test_forces_are_masses_times_accelerations(rotation: str) -> None:
    # independent: the force from definitions at every third degree, of all orders
    optimum = answer(WITHIN | {"rotation": rotation}, {"orders": "all", "moment_weight": 0})
    turn = [abs(at(WITHIN | {"rotation": rotation}, optimum.model_dump(), theta)[0]) for theta in range(0, 360, 3)]
    assert max(turn) == pytest.approx(optimum.certificate.objective, rel=2e-3)


def test_equal_castings_on_the_crankshaft_stand_beside_it() -> None:
    machine = single([shaft("back", -1, radius=0.05, max_mass=60.0, min_fitted_mass_kg=12.0)], webs=2)
    machine["webs"] = [web(name, z, 20.0, throw=0) for name, z in (("a", -0.1), ("b", 0.1))]
    machine["web_groups"] = [{"name": "pair", "webs": ["a", "b"]}]
    optimum = answer(machine, FORCE, accuracy=SHARP)
    # analytic: 12 kg where 10 are called for leave a tenth of what turns backwards
    assert optimum.certificate.objective == pytest.approx(0.1 * WHOLE, rel=1e-5)
    assert optimum.counterweights[0].mass_kg == optimum.counterweights[1].mass_kg == pytest.approx(2.5, rel=1e-4)


@pytest.mark.parametrize(
    ("change", "path", "words"),
    [
        (
            {"min_fitted_mass_kg": 101.0},
            ("balance_shafts", 0, "webs", 0, "min_fitted_mass_kg"),
            "more than max_mass_kg",
        ),
        ({"max_mass_kg": None}, ("balance_shafts", 0, "webs", 0, "max_mass_kg"), "have a limit"),
    ],
)
def test_what_is_wrong_is_named(change: dict[str, Any], path: tuple[object, ...], words: str) -> None:
    place = shaft("back", -1, radius=0.05, max_mass=100.0, min_fitted_mass_kg=12.0)
    place["webs"][0] |= change
    machine = single([place], webs=2)
    machine["webs"] = [web(name, z, 20.0, throw=0) for name, z in (("a", -0.1), ("b", 0.1))]
    machine["web_groups"] = [{"name": "pair", "webs": ["a", "b"]}]
    with pytest.raises(InvalidRequest) as refused:
        check(OptimizeRequest, {"machine": machine})
    (problem,) = refused.value.problems
    assert problem.path == ("machine", *path)
    assert words in problem.message


def test_ceilings_that_a_least_mass_breaks_are_named() -> None:
    # analytic: 11 kg where 10 are called for leave a twentieth, and nothing leaves half
    machine = single([shaft("back", -1, radius=0.05, max_mass=200.0, min_fitted_mass_kg=11.0)])
    for share, status in ((0.051, "optimal"), (0.049, "infeasible")):
        goal = {"moment_weight": 0, "force_ceiling_x_N": share * WHOLE, "force_ceiling_y_N": share * WHOLE}
        optimum = optimize(OptimizeRequest.model_validate({"machine": machine, "objective": goal}))
        assert optimum.status == status, optimum.status_reason
