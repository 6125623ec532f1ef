"""Counterweights from a catalogue on the crankshaft, and any masses on balance shafts beside them."""

from collections.abc import Iterator
from itertools import product
from typing import Any

import cvxpy as cp
import numpy as np
import pytest

from optimizer.optimize import optimize
from schemas.answer.answers import Certificate, OptimizeAnswer
from schemas.request.requests import OptimizeRequest
from service.common.validation import InvalidRequest, check
from tests.night import part
from tests.optimize.machines import row, throw, web
from tests.optimize.shafts import OMEGA, WHOLE, at, every_place, first_order, in_line_four, shaft, single
from tests.verification.checking import sound_answer

FORCE = {"moment_weight": 0}


def answer(machine: dict[str, Any], goal: dict[str, Any], **more: Any) -> OptimizeAnswer:
    """The answer, no claim of which the independent checker breaks; what is on the crankshaft is of the catalogue."""
    optimum = sound_answer({"machine": machine, "objective": goal, **more})
    masses = machine["catalogue"].get("masses_kg")
    for counterweight in optimum.counterweights:
        assert counterweight.fixed or counterweight.mass_kg == 0 or masses is None or counterweight.mass_kg in masses
    return optimum


def proof_of(optimum: OptimizeAnswer) -> Certificate:
    assert optimum.certificate is not None
    return optimum.certificate


@pytest.mark.parametrize(
    ("masses", "left"),
    # analytic: 10 kg at 0.1 m halve into what turns with the crankshaft and against it. The shaft takes all of one
    # half, and the casting that is next to 5 kg what it can of the other
    [([5.0], 0.0), ([4.0, 3.0], 0.1), ([2.0, 7.0], 0.2), ([11.0], 0.5)],
)
def test_a_lanchester_shaft_cancels_its_half_whatever_the_casting(masses: list[float], left: float) -> None:
    machine = single([shaft("back", -1, radius=0.05)], catalogue={"masses_kg": masses, "angle_step_deg": 30})
    optimum = answer(machine, FORCE)
    assert optimum.status == "optimal"
    assert proof_of(optimum).objective == pytest.approx(left * WHOLE, abs=3e-6 * WHOLE)
    assert proof_of(optimum).lower_bound == pytest.approx(left * WHOLE, abs=1.1e-3 * WHOLE)
    assert optimum.balance_shafts_mass_kg == pytest.approx(10.0, rel=2e-5)


def sets(machine: dict[str, Any]) -> Iterator[np.ndarray]:
    """Weights (webs,) complex kg of all sets of castings that keep the counts."""
    stock = machine["catalogue"]
    options = []
    for place in machine["webs"]:
        angles = place.get("hole_angles_deg", [])
        masses = place.get("catalogue_masses_kg", stock.get("masses_kg", []))
        options.append([0j, *(mass * np.exp(1j * np.deg2rad(angle)) for mass, angle in product(masses, angles))])
    for some in product(*options):
        chosen = np.array(some)
        if np.sum(np.abs(chosen) > 0) <= machine.get("max_counterweights", len(chosen)):
            yield chosen


def best_by_force(machine: dict[str, Any], combine: str, ceilings: dict[str, float]) -> float:
    """The best of all sets, each with a convex program of cvxpy of what is on the shafts; of the first order."""
    places, order, webs = every_place(machine), first_order(machine), len(machine["webs"])
    there = cp.Parameter(webs, complex=True)
    rest = cp.Variable(len(places) - webs, complex=True)
    terms = order.terms(cp.hstack([there, rest]))
    sums = [sum(cp.abs(part_force) for part_force in both) for both in terms]
    goals = [sums[0], sums[1] / order.span]
    limits = [cp.abs(rest[k]) <= place["max_mass_kg"] for k, place in enumerate(places[webs:])]
    for name, most in ceilings.items():
        with_, against = terms[0 if name.startswith("force") else 1]
        sign = 1.0 if "_x_" in name else -1.0
        limits.append(cp.abs(with_ + sign * cp.conj(against)) * OMEGA**2 <= most)
    objective = (goals[0] + goals[1]) if combine == "sum" else cp.maximum(*goals)
    problem = cp.Problem(cp.Minimize(objective * OMEGA**2 * 1e-3), limits)
    best = np.inf
    for some in sets(machine):
        there.value = some
        problem.solve(solver=cp.CLARABEL)
        if problem.status in ("optimal", "optimal_inaccurate"):
            best = min(best, float(problem.value) * 1e3)
    return best


def two_throws(seed: int, shafts: list[dict[str, Any]]) -> dict[str, Any]:
    """Two cylinders and three webs with holes at random, castings of two masses."""
    rng = np.random.default_rng(seed)
    rows = [[row(rng.uniform(0, 180), rng.uniform(5, 15), connecting_rod={"length_m": 0.4})] for _ in range(2)]
    machine = single(shafts)
    machine["throws"] = [throw(0.3 * n, rng.uniform(0, 360), rows[n], rotating=rng.uniform(0, 5)) for n in range(2)]
    machine["webs"] = [
        web(f"w{k}", 0.15 * k, 20.0, hole_angles_deg=[float(rng.integers(0, 360)) for _ in range(3)]) for k in range(3)
    ]
    machine["catalogue"] = {"masses_kg": [3.0, 7.0]}
    return machine


@pytest.mark.parametrize("seed", part(5, range(9)))
@pytest.mark.parametrize("combine", part(2, ["sum", "max"]))
@pytest.mark.parametrize("back", part(2, [-1, 1]))
def test_no_set_is_better(seed: int, combine: str, back: int) -> None:
    # independent: all sets, each with a program of cvxpy
    machine = two_throws(seed, [shaft("a", back, 0.1, 12.0), shaft("b", -1, 0.25, 5.0)][: 1 + seed % 2])
    if seed % 3 == 2:
        machine["max_counterweights"] = 2
    optimum = answer(machine, {"combine": combine}, accuracy={"relative_gap": 1e-6, "time_limit_s": 20})
    best, proof = best_by_force(machine, combine, {}), proof_of(optimum)
    assert optimum.status == "optimal"
    assert proof.lower_bound is not None
    assert proof.objective == pytest.approx(best, rel=1e-5, abs=3e-6 * (proof.yardstick or 1.0))
    assert proof.lower_bound <= best * (1 + 1e-6)


@pytest.mark.parametrize("share", part(2, [1.02, 1.2]))
def test_ceilings_along_axes_hold_and_no_set_is_better_under_them(share: float) -> None:
    # independent: the same under ceilings
    machine = two_throws(4, [shaft("a", -1, 0.1, 12.0)])
    free = answer(machine, {}, accuracy={"relative_gap": 1e-6})
    assert free.residual.after is not None
    least = free.residual.after.force.peak_x_N
    ceilings = {"force_ceiling_x_N": least / share, "force_ceiling_y_N": 2.0 * least}
    optimum = answer(machine, ceilings, accuracy={"relative_gap": 1e-6, "time_limit_s": 20})
    best = best_by_force(machine, "sum", ceilings)
    if best == np.inf:
        assert optimum.status == "infeasible"
    else:
        assert proof_of(optimum).objective == pytest.approx(best, rel=2e-5)


@pytest.mark.parametrize("rotation", part(2, ["cw", "ccw"]))
def test_no_set_is_better_over_all_orders(rotation: str) -> None:
    # independent: all sets, each with a program of cvxpy at every third degree of forces from the definitions
    machine = two_throws(1, [shaft("a", -1, 0.1, 12.0), shaft("b", 2, 0.0, 3.0)]) | {"rotation": rotation}
    machine["webs"] = machine["webs"][:2]
    optimum = answer(machine, {"orders": "all", "moment_weight": 0}, accuracy={"time_limit_s": 20})
    places = every_place(machine)
    angles = np.arange(0, 360, 3)

    def forces(weights: np.ndarray) -> np.ndarray:
        fitted = [{"mass_kg": abs(weight), "angle_deg": np.rad2deg(np.angle(weight))} for weight in weights]
        body = {"counterweights": fitted[:2], "balance_shafts": [{"counterweights": [fields]} for fields in fitted[2:]]}
        return np.array([at(machine, body, theta)[0] for theta in angles])

    fixed = forces(np.zeros(4, complex))
    unit = np.array([forces(np.eye(4)[k].astype(complex)) - fixed for k in range(4)]).T
    there, rest = cp.Parameter(len(angles), complex=True), cp.Variable(2, complex=True)
    limits = [cp.abs(rest[k]) <= places[2 + k]["max_mass_kg"] for k in range(2)]
    problem = cp.Problem(cp.Minimize(cp.max(cp.abs(there + (unit[:, 2:] / 1e3) @ rest))), limits)
    best = np.inf
    for some in sets(machine):
        there.value = (fixed + unit[:, :2] @ some) / 1e3
        problem.solve(solver=cp.CLARABEL)
        best = min(best, float(problem.value) * 1e3)
    proof = proof_of(optimum)
    assert optimum.status == "optimal"
    assert proof.lower_bound is not None
    # samples miss the peak by little
    assert proof.lower_bound <= best * 1.003
    assert best * (1 - 1e-6) <= proof.objective <= best * 1.003 + 1e-3 * (proof.yardstick or 0.0)


def test_castings_and_least_masses_on_a_shaft_are_chosen_together() -> None:
    # analytic: of castings of 4.5 kg one leaves a twentieth of the whole, and 11 kg in place of 10 another
    machine = single([shaft("back", -1, radius=0.05, max_mass=40.0, min_fitted_mass_kg=11.0)])
    machine["catalogue"] = {"masses_kg": [4.5], "angle_step_deg": 30}
    optimum = answer(machine, FORCE)
    assert optimum.status == "optimal"
    assert proof_of(optimum).objective == pytest.approx(0.1 * WHOLE, rel=1e-6)
    assert optimum.balance_shafts_mass_kg == pytest.approx(11.0)


def test_equal_castings_and_fixed_weights_stand_beside_it() -> None:
    machine = single([shaft("back", -1, radius=0.05)])
    machine["webs"] = [web(name, z, 20.0, throw=0) for name, z in (("a", -0.1), ("b", 0.1), ("c", 0.0))]
    machine["webs"][2] |= {"fixed": {"mass_kg": 1.0, "angle_deg": 270.0}}
    machine["web_groups"] = [{"name": "pair", "webs": ["a", "b"]}]
    machine["catalogue"] = {"masses_kg": [1.8, 3.0], "angle_step_deg": 45}
    optimum = answer(machine, FORCE)
    # analytic: two of 1.8 kg and 1 kg of the 5 kg that turn with the crankshaft
    assert proof_of(optimum).objective == pytest.approx(0.04 * WHOLE, abs=3e-6 * WHOLE)
    assert [counterweight.mass_kg for counterweight in optimum.counterweights] == [1.8, 1.8, 1.0]
    assert optimum.balance_shafts_mass_kg == pytest.approx(10.0, rel=2e-5)


STOCK = {"masses_kg": [2.0, 4.5], "angle_step_deg": 30}
BACK = single([shaft("back", -1, radius=0.05, max_mass=100.0)], webs=2, catalogue=STOCK)
WITHIN = single(
    [shaft("back", -1, max_mass=20.0, sector={"centre_deg": 250.0, "half_angle_deg": 15.0}), shaft("on", 1)],
    catalogue=STOCK,
)
MIXED = in_line_four([shaft("a", 2, x_m=0.1), shaft("b", -1, y_m=-0.1)], ratio=0.25)
MIXED |= {"webs": [web("a", 0.0, 20.0, throw=0), web("b", 0.36, 20.0, throw=3)], "catalogue": STOCK}
CASES = [
    {"name": "slow", "changes": [{"path": "/machine/speed_rpm", "value": 400}]},
    {"name": "place", "changes": [{"path": "/machine/balance_shafts/0/webs/0/position_m", "value": 0.05}]},
]


@pytest.mark.parametrize("machine", part(3, [MIXED, BACK, WITHIN]))
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
            {"orders": "all", "force_ceiling_x_N": 0.8 * WHOLE},
            {"priorities": [{"goal": "external", "allowance": 0.05}, {"goal": "pieces"}, {"goal": "mass"}]},
            {
                "priorities": [{"goal": "mass", "allowance": 0.5}, {"goal": "external"}],
                "force_ceiling_y_N": 0.8 * WHOLE,
            },
            {"priorities": [{"goal": "external", "allowance": 0.05}, {"goal": "sizes"}], "orders": "all"},
        ],
    ),
)
@pytest.mark.parametrize(
    "more",
    part(
        2,
        [
            {},
            {"scenarios": CASES},
            {"tolerances": {"unbalance_kg_m": 0.01, "reciprocating_mass_relative": 0.02}},
            {"alternatives": [0.05, 0.3]},
        ],
    ),
)
def test_no_claim_is_broken(machine: dict[str, Any], goal: dict[str, Any], more: dict[str, Any]) -> None:
    if "alternatives" in more and "priorities" in goal:
        more = {}
    optimum = answer(machine, goal, accuracy={"relative_gap": 1e-2, "time_limit_s": 0.5}, **more)
    assert optimum.status in ("optimal", "inaccurate")
    for alternative in optimum.alternatives:
        assert alternative.objective <= proof_of(optimum).objective * (1 + alternative.allowance) * (1 + 1e-6)
        carried = [
            *alternative.counterweights,
            *(counterweight for of in alternative.balance_shafts for counterweight in of.counterweights),
        ]
        assert alternative.total_mass_kg == pytest.approx(sum(counterweight.mass_kg for counterweight in carried))


def test_tolerances_of_masses_and_angles_scatter_castings_and_shafts() -> None:
    # analytic: half of the mass on either shaft is off by its share
    optimum = answer(
        BACK | {"catalogue": {"masses_kg": [2.5], "angle_step_deg": 30}}, FORCE, tolerances={"mass_relative": 0.05}
    )
    assert proof_of(optimum).objective == pytest.approx(0.05 * WHOLE, rel=1e-3)


def test_what_is_lightest_is_that_of_all_shafts() -> None:
    # analytic: half of what turns backwards may stay, which 5 kg on the shaft take; the casting may stay away as well
    goal = {
        "moment_weight": 0,
        "force_ceiling_x_N": 0.5 * WHOLE,
        "force_ceiling_y_N": 0.75 * WHOLE,
        "priorities": [{"goal": "mass"}, {"goal": "external"}],
    }
    optimum = answer(BACK, goal)
    # along y what is there is 1, and a quarter of it is to go: 2.5 kg at the radius of the crank are the lightest
    total = optimum.total_mass_kg + optimum.balance_shafts_mass_kg
    assert optimum.status in ("optimal", "inaccurate")
    assert proof_of(optimum).goals[0].lower_bound <= total * (1 + 1e-9)
    assert total <= 4.5 + 1e-6


@pytest.mark.parametrize(
    ("place", "change", "path"),
    [
        ("shaft", {"throw": 0}, ("balance_shafts", 0, "webs", 0, "throw")),
        ("web", {"hole_angles_deg": []}, ("webs", 0, "hole_angles_deg")),
    ],
)
def test_what_is_wrong_is_named(place: str, change: dict[str, Any], path: tuple[object, ...]) -> None:
    machine = single([shaft("back", -1)], catalogue=STOCK)
    (machine["balance_shafts"][0] if place == "shaft" else machine)["webs"][0] |= change
    with pytest.raises(InvalidRequest) as refused:
        check(OptimizeRequest, {"machine": machine})
    assert [problem.path for problem in refused.value.problems] == [("machine", *path)]


def test_castings_that_keep_no_ceilings_beside_any_shaft_are_infeasible() -> None:
    # analytic: castings of 11 kg leave half of the whole or more of what turns with the crankshaft
    for share, status in ((0.51, "optimal"), (0.49, "infeasible")):
        machine = single([shaft("back", -1)], catalogue={"masses_kg": [11.0], "angle_step_deg": 90})
        goal = {"moment_weight": 0, "force_ceiling_x_N": share * WHOLE, "force_ceiling_y_N": share * WHOLE}
        optimum = optimize(OptimizeRequest.model_validate({"machine": machine, "objective": goal}))
        assert optimum.status == status, optimum.status_reason
