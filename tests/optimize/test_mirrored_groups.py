"""Mirrored pairs: the same weight at the same angle on the other side of the own crank; and groups wherever they go."""

import json
from typing import Any

import numpy as np
import pytest
from scipy.optimize import minimize

from optimizer.errors import OutOfRange
from optimizer.studies.pareto.pareto import pareto
from schemas.answer.answers import OptimizeAnswer
from schemas.front.pareto import ParetoRequest
from tests.night import part
from tests.optimize.test_web_groups import ANGLES, NAMES, RADIUS, body, objective, phasors, refused
from tests.verification.checking import broken, optimized

PAIRS = [["0a", "0b"], ["1a", "1b"], ["2a", "2b"]]
CASES = pytest.mark.parametrize("mirror", [False, True])


def grouped(groups: list[list[str]], mirror: bool, max_mass_kg: float = 30.0, **more: Any) -> dict[str, Any]:
    """Of the machine of the other tests; rods make it one for the whole turn too."""
    request = body(groups, max_mass_kg, **more)
    for throw in request["machine"]["throws"]:
        throw["rows"][0]["connecting_rod"] = {"length_m": 0.4}
    request["machine"]["bearings"] = [{"name": "A", "position_m": -0.5}, {"name": "B", "position_m": 0.5}]
    for group in request["machine"]["web_groups"]:
        group["mirror"] = mirror
    return request


def alike(answer: Any, groups: list[list[str]], mirror: bool) -> None:
    """Analytic: one weight in every group, each at the angle of the first or on the other side of its crank."""
    place = dict(zip(NAMES, phasors(answer), strict=True))
    mass = {counterweight.web: counterweight.mass_kg for counterweight in answer.counterweights}
    for group in groups:
        assert len({mass[name] for name in group}) == 1
        nps = [np.conj(place[name]) if mirror and n % 2 else place[name] for n, name in enumerate(group)]
        assert np.allclose(nps, nps[0], rtol=0, atol=1e-12 * (1 + abs(nps[0])))


def certified(answer: OptimizeAnswer, mass_gap: float = 1e-4) -> None:
    assert answer.status == "optimal", answer.status_reason
    assert answer.certificate is not None
    assert answer.certificate.relative_gap is not None
    assert answer.certificate.mass_relative_gap is not None
    assert answer.certificate.mass_relative_gap <= mass_gap


def test_a_mirrored_pair_on_every_throw_is_a_search_over_its_components() -> None:
    """Independent: the same by a search over the two components of the one casting on each of all cranks."""
    query = grouped([NAMES], True, max_mass_kg=12.0)
    answer = optimized(query)
    certified(answer)
    alike(answer, [NAMES], True)
    turn = np.exp(1j * np.radians(np.repeat(ANGLES, 2))) * RADIUS

    def value(p: np.ndarray) -> float:
        # beyond the limit nothing counts
        w = (p[0] + 1j * p[1]) * min(1.0, 12.0 / max(float(np.hypot(*p)), 1e-300))
        return objective(query, np.where(np.arange(6) % 2, np.conj(w), w) * turn)

    best = min(
        minimize(value, start, method="Nelder-Mead", options={"xatol": 1e-10, "fatol": 1e-10, "maxiter": 4000}).fun
        for start in ((-5.0, 1.0), (-5.0, -6.0), (-2.0, 9.0), (1.0, 10.0))
    )
    assert answer.certificate is not None
    assert answer.certificate.objective == pytest.approx(best, rel=1e-5)
    assert answer.certificate.lower_bound is not None
    assert answer.certificate.lower_bound <= best * (1 + 1e-9)


@pytest.mark.parametrize("goal", [{}, {"combine": "max"}, {"direction_weights": {"x": 2, "y": 1}}])
def test_mirrored_pairs_are_no_better_than_webs_by_themselves(goal: dict[str, Any]) -> None:
    answer, free = optimized(grouped(PAIRS, True, objective=goal)), optimized(grouped([], False, objective=goal))
    certified(answer)
    alike(answer, PAIRS, True)
    assert answer.certificate is not None
    assert free.certificate is not None
    assert answer.certificate.objective >= free.certificate.lower_bound * (1 - 1e-12)
    assert answer.total_mass_kg is not None
    assert free.total_mass_kg is not None
    # both webs of a throw carry what together points along its crank, which costs mass
    assert answer.total_mass_kg > free.total_mass_kg


def test_pairs_in_one_plane_are_the_same_mirrored_or_not() -> None:
    """Analytic: cranks, rows and optimum lie in one plane, which is that of the mirror."""
    answers = []
    for mirror in (False, True):
        query = grouped([["0a", "2a"], ["0b", "2b"]], mirror)
        for throw, angle in zip(query["machine"]["throws"], (90.0, 270.0, 90.0), strict=True):
            throw["crank_angle_deg"] = angle
        answers.append(optimized(query))
    assert answers[0].total_mass_kg == pytest.approx(answers[1].total_mass_kg, rel=1e-4)
    assert answers[0].certificate is not None
    assert answers[1].certificate is not None
    assert answers[0].certificate.objective == pytest.approx(answers[1].certificate.objective, rel=1e-6)


def test_sectors_are_mirrored_too() -> None:
    query = grouped(PAIRS, True)
    for n, web in enumerate(query["machine"]["webs"]):
        side = 1 if n % 2 == 0 else -1
        web["sector"] = {"centre_deg": ANGLES[n // 2] + side * 150.0, "half_angle_deg": 10.0}
    answer = optimized(query)
    certified(answer)
    alike(answer, PAIRS, True)
    off = [counterweight.angle_from_crank_deg or 0.0 for counterweight in answer.counterweights]
    assert all(140.0 - 1e-9 <= (angle if n % 2 == 0 else 360.0 - angle) <= 160.0 + 1e-9 for n, angle in enumerate(off))
    query["machine"]["webs"][1]["sector"]["centre_deg"] = 150.0
    with pytest.raises(OutOfRange) as refusal:
        optimized(query)
    assert refusal.value.problems[0].path == ("machine", "web_groups", 0, "webs", 1)


def test_a_pair_without_a_limit_is_refused() -> None:
    query = grouped(PAIRS, True)
    query["machine"]["webs"][0]["max_mass_kg"] = None
    at, words = refused(query)
    assert at == ("web_groups", 0, "webs", 0)
    assert "max_mass_kg" in words


def test_ceilings_of_mirrored_pairs() -> None:
    best = optimized(grouped([NAMES], True, max_mass_kg=12.0))
    assert best.residual.after is not None
    low = 0.98 * best.residual.after.force.peak_N
    answer = optimized(grouped([NAMES], True, max_mass_kg=12.0, objective={"force_ceiling_N": low}))
    certified(answer)
    assert answer.residual.after is not None
    assert answer.residual.after.force.peak_N <= low * (1 + 1e-9)
    none = optimized(grouped([NAMES], True, max_mass_kg=12.0, objective={"force_ceiling_N": 0.5 * low}))
    assert none.status == "infeasible"
    assert none.infeasibility is not None
    assert none.infeasibility.conflict == ("force_ceiling_N",)


@CASES
@pytest.mark.parametrize(
    "more",
    part(
        2,
        [
            {"objective": {"orders": "all"}},
            {"objective": {"force_weight": 0, "moment_weight": 0, "bearing_weight": 1}},
            {"objective": {"bending_weight": 1.0, "force_weight": 0.1}},
            {
                "scenarios": [
                    {"name": "as it is", "changes": []},
                    {"name": "heavy", "changes": [{"path": "/machine/throws/0/rotating_mass_kg", "value": 40}]},
                ]
            },
            {"tolerances": {"mass_relative": 0.02, "angle_deg": 2, "reciprocating_mass_relative": 0.01}},
        ],
    ),
    ids=["orders", "bearings", "bending", "scenarios", "tolerances"],
)
def test_over_the_turn_and_in_the_worst_case(mirror: bool, more: dict[str, Any]) -> None:
    """Independent: webs by themselves are proven to do no worse."""
    # however busy the machine, and whatever is compiled first
    more = {"accuracy": {"time_limit_s": 30}, **more}
    answer, free = optimized(grouped(PAIRS, mirror, **more)), optimized(grouped([], False, **more))
    certified(answer)
    alike(answer, PAIRS, mirror)
    assert answer.certificate is not None
    assert free.certificate is not None
    assert free.certificate.lower_bound is not None
    assert answer.certificate.objective >= free.certificate.lower_bound * (1 - 1e-9)
    assert answer.shadow_prices == ()


@CASES
@pytest.mark.parametrize("budget", [None, 30.0])
def test_plates_of_a_group_are_cut_alike(mirror: bool, budget: float | None) -> None:
    query = grouped(PAIRS, mirror)
    query["machine"]["max_total_mass_kg"] = budget
    for web in query["machine"]["webs"]:
        del web["counterweight_radius_m"], web["max_mass_kg"]
        web["envelope"] = {"shape": "segment", "outer_radius_m": 0.25, "inner_radius_m": 0.06, "thickness_m": 0.03}
    answer = optimized(query)
    certified(answer)
    alike(answer, PAIRS, mirror)
    for a, b in zip(answer.counterweights[::2], answer.counterweights[1::2], strict=True):
        assert a.shape == b.shape
        assert a.radius_m == b.radius_m
    assert (answer.total_mass_kg or 0.0) <= (budget or 1e3) * (1 + 1e-9)


@CASES
def test_fronts(mirror: bool) -> None:
    front = pareto(ParetoRequest.model_validate(grouped([NAMES], mirror, points=3, max_mass_kg=12.0)))
    assert front.status == "optimal"
    assert len(front.fronts[0].points) > 1
    for point in front.fronts[0].points:
        alike(point, [NAMES], mirror)
        assert point.certificate.mass_relative_gap is not None
        assert point.certificate.mass_relative_gap <= 1e-4
    query = grouped(PAIRS, mirror, points=2, responses=["bearings", "mass"])
    trade = pareto(ParetoRequest.model_validate(query))
    assert trade.status == "optimal"
    for position in trade.trades[0].points:
        alike(position, PAIRS, mirror)


def test_beside_balance_shafts() -> None:
    query = grouped(PAIRS, True)
    web = {"name": "s", "position_m": 0.0, "counterweight_radius_m": 0.05, "max_mass_kg": 20}
    query["machine"]["balance_shafts"] = [{"name": "back", "speed_ratio": -1, "webs": [web]}]
    answer = optimized(query)
    certified(answer)
    alike(answer, PAIRS, True)
    assert answer.balance_shafts[0].total_mass_kg > 0


def test_the_checker_finds_a_pair_that_is_not_mirrored() -> None:
    query = grouped(PAIRS, True)
    answer = json.loads(optimized(query).model_dump_json())
    assert not broken(query, answer)
    answer["counterweights"][1]["angle_deg"] += 0.5
    assert any("web_groups" in claim for claim in broken(query, answer))
    query["machine"]["web_groups"][0]["mirror"] = False
    answer["counterweights"][1]["angle_deg"] -= 0.5
    assert any("web_groups" in claim for claim in broken(query, answer))
