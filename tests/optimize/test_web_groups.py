"""Webs that get identical castings: the same weight in the same place on their own cranks."""

from typing import Any

import numpy as np
import pytest
from pydantic import ValidationError
from scipy.optimize import minimize

from optimizer.errors import OutOfRange
from optimizer.formulation.groups import _same_options
from schemas.answer.answers import OptimizeAnswer
from schemas.request.requests import OptimizeRequest
from tests.verification.checking import broken, optimized

ANGLES, PLANES, RADIUS = (0.0, 120.0, 250.0), (-0.3, 0.0, 0.3), 0.2
NAMES = ["0a", "0b", "1a", "1b", "2a", "2b"]


def body(groups: list[list[str]], max_mass_kg: float = 30.0, **more: Any) -> dict[str, Any]:
    """Three throws that balance nothing, two webs on each."""
    throws = [
        {"position_m": z, "crank_radius_m": 0.1, "crank_angle_deg": a, "rotating_mass_kg": 20 + 5 * t,
         "rows": [{"axis_deg": 90, "reciprocating_mass_kg": 10}]}
        for t, (a, z) in enumerate(zip(ANGLES, PLANES, strict=True))
    ]  # fmt: skip
    webs = [
        {"name": f"{t}{side}", "position_m": z + off, "counterweight_radius_m": RADIUS, "max_mass_kg": max_mass_kg}
        for t, z in enumerate(PLANES)
        for side, off in (("a", -0.08), ("b", 0.08))
    ]
    named = [{"name": str(n), "webs": group} for n, group in enumerate(groups)]
    return {
        "machine": {"kind": "reciprocating", "speed_rpm": 300, "throws": throws, "webs": webs, "web_groups": named},
        **more,
    }


def phasors(answer: OptimizeAnswer) -> np.ndarray:
    """Mass and place on the own crank (K,), kg."""
    angles = np.repeat(ANGLES, 2)
    return np.array(
        [
            counterweight.mass_kg * np.exp(1j * np.radians(counterweight.angle_deg - a))
            for counterweight, a in zip(answer.counterweights, angles, strict=True)
        ]
    )


def objective(request: dict[str, Any], u: np.ndarray, moment_share: float = 1.0) -> Any:
    """Independent: weighted peaks of the first order by hand, in newtons, of unbalances (..., K) kg m."""
    machine = request["machine"]
    square = (machine["speed_rpm"] * np.pi / 30) ** 2
    force, couple, back, back_couple = 0j, 0j, 0j, 0j
    for throw in machine["throws"]:
        crank = np.exp(1j * np.radians(throw["crank_angle_deg"]))
        co = 0.1 * crank * (throw["rotating_mass_kg"] + 5.0)
        counter = -0.1 * 5.0 * np.conj(crank)
        force, couple = force + co, couple + throw["position_m"] * co
        back, back_couple = back + counter, back_couple + throw["position_m"] * counter
    places = np.array([web["position_m"] for web in machine["webs"]])
    force, couple = force + np.sum(u, axis=-1), couple + np.sum(places * u, axis=-1)
    span = np.ptp(places)
    return square * (abs(force) + abs(back) + moment_share * (abs(couple) + abs(back_couple)) / span)


def test_all_alike_is_one_unknown() -> None:
    """Independent: the same by a search over the two components of the one casting."""
    payload = body([NAMES])
    answer = optimized(payload)
    assert answer.status == "optimal"
    alike = phasors(answer)
    assert np.allclose(alike, alike[0], rtol=0, atol=1e-12 * abs(alike[0]))
    assert len({counterweight.mass_kg for counterweight in answer.counterweights}) == 1
    turn = np.exp(1j * np.radians(np.repeat(ANGLES, 2))) * RADIUS
    best = min(
        minimize(lambda p: objective(payload, (p[0] + 1j * p[1]) * turn), start, method="Nelder-Mead",
                 options={"xatol": 1e-10, "fatol": 1e-10, "maxiter": 4000}).fun
        for start in ((-5.0, 0.0), (-5.0, 2.0))
    )  # fmt: skip
    assert answer.certificate is not None
    assert answer.certificate.objective == pytest.approx(best, rel=1e-5)
    assert answer.certificate.lower_bound is not None
    assert answer.certificate.lower_bound <= best * (1 + 1e-9)


@pytest.mark.parametrize("groups", [[["0a", "0b"], ["1a", "1b"], ["2a", "2b"]], [["0a", "1a", "2a"], ["0b", "2b"]]])
@pytest.mark.parametrize("goal", [{}, {"combine": "max"}, {"direction_weights": {"x": 2, "y": 1}}])
def test_groups_are_kept_and_cost_something(groups: list[list[str]], goal: dict[str, Any]) -> None:
    """Independent: no better than each web by itself, and than what a search finds no worse."""
    answer, free = (optimized(body(values, objective=goal)) for values in (groups, []))
    assert answer.status == free.status == "optimal"
    place = dict(zip(NAMES, phasors(answer), strict=True))
    for group in groups:
        assert np.allclose([place[name] for name in group], place[group[0]], rtol=0, atol=1e-12)
    assert answer.certificate is not None
    assert free.certificate is not None
    assert answer.certificate.objective >= free.certificate.lower_bound * (1 - 1e-12)
    assert answer.certificate.mass_relative_gap is not None
    assert answer.certificate.mass_relative_gap <= 1e-4


def test_the_largest_mass_and_the_budget_count_for_each() -> None:
    full = optimized(body([NAMES], max_mass_kg=2.0))
    assert [counterweight.mass_kg for counterweight in full.counterweights] == [2.0] * 6
    assert all(counterweight.active_limits == ("max_mass",) for counterweight in full.counterweights)
    payload = body([NAMES])
    payload["machine"]["max_total_mass_kg"] = 9.0
    spent = optimized(payload)
    assert [counterweight.mass_kg for counterweight in spent.counterweights] == pytest.approx([1.5] * 6, rel=1e-4)
    assert spent.active_limits == ("max_total_mass",)


def test_sectors_turn_with_the_cranks() -> None:
    payload = body([NAMES])
    for web, angle in zip(payload["machine"]["webs"], np.repeat(ANGLES, 2).tolist(), strict=True):
        web["sector"] = {"centre_deg": angle + 150.0, "half_angle_deg": 10.0}
    answer = optimized(payload)
    assert answer.status == "optimal"
    off = [counterweight.angle_from_crank_deg for counterweight in answer.counterweights]
    assert off == pytest.approx([off[0]] * 6, abs=1e-9)
    assert 140.0 - 1e-9 <= (off[0] or 0.0) <= 160.0 + 1e-9


def test_ceilings_with_and_without_reach() -> None:
    best = optimized(body([NAMES]))
    assert best.residual.after is not None
    low = 0.98 * best.residual.after.force.peak_N
    answer = optimized(body([NAMES], objective={"force_ceiling_N": low}))
    assert answer.status == "optimal"
    assert answer.residual.after is not None
    assert answer.residual.after.force.peak_N <= low * (1 + 1e-9)
    # all by themselves come down to the floor of both, one unknown does not
    ceilings = {"force_ceiling_N": 1.05 * best.floor.force_N, "moment_ceiling_Nm": 1.05 * best.floor.moment_Nm}
    free, tight = (optimized(body(groups, objective=ceilings)) for groups in ([], [NAMES]))
    assert (free.status, tight.status) == ("optimal", "infeasible")
    assert tight.infeasibility is not None
    assert set(tight.infeasibility.conflict) <= {"force_ceiling_N", "moment_ceiling_Nm"}
    closest = tight.infeasibility.closest.counterweights
    assert len({counterweight.mass_kg for counterweight in closest}) == 1


def test_no_limit_becomes_one_for_each_web() -> None:
    payload = body([NAMES])
    for web in payload["machine"]["webs"]:
        web["max_mass_kg"] = None
    answer = optimized(payload)
    assert answer.status == "optimal"
    assert answer.certificate is not None
    assert set(answer.certificate.implied_max_mass_kg) == set(NAMES)
    assert answer.certificate.objective == pytest.approx(optimized(body([NAMES])).certificate.objective, rel=1e-6)  # type: ignore[union-attr]


def test_the_checker_finds_castings_that_differ() -> None:
    payload = body([NAMES])
    answer = optimized(payload).model_dump(mode="json")
    assert not broken(payload, answer)
    answer["counterweights"][0]["mass_kg"] *= 1.001
    assert any("web_groups" in claim for claim in broken(payload, answer))


def refused(fields: dict[str, Any], kind: Any = OptimizeRequest) -> tuple[tuple[str | int, ...], str]:
    with pytest.raises(ValidationError) as refusal:
        kind.model_validate(fields)
    (problem, *_) = refusal.value.errors()
    first = problem["ctx"]["problems"][0]
    return first.path, first.message


@pytest.mark.parametrize(
    ("groups", "path", "message"),
    [
        ([["0a", "9z"]], ("web_groups", 0, "webs", 1), "no web of this name"),
        ([["0a", "0a"]], ("web_groups", 0, "webs", 1), "in a group already"),
        ([["0a", "0b"], ["0b", "1a"]], ("web_groups", 1, "webs", 0), "in a group already"),
    ],
)
def test_bad_groups_name_the_field(groups: list[list[str]], path: tuple[str | int, ...], message: str) -> None:
    at, words = refused(body(groups))
    assert at == path
    assert message in words


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"counterweight_radius_m": 0.3}, "its counterweight_radius_m must equal that of 0a"),
        ({"max_mass_kg": 1.0}, "its max_mass_kg must equal that of 0a"),
        (
            {"sector": {"centre_deg": 0, "half_angle_deg": 10}},
            "its sector, counted from the own crank, must equal that of",
        ),
        ({"position_m": -0.15}, "belongs to no crank: name its throw"),
    ],
)
def test_unlike_webs_are_refused(change: dict[str, Any], words: str) -> None:
    payload = body([["0a", "0b"]])
    payload["machine"]["webs"][1] |= change
    with pytest.raises(OutOfRange) as refusal:
        optimized(payload)
    assert refusal.value.problems[0].path == ("machine", "web_groups", 0, "webs", 1)
    assert words in refusal.value.problems[0].message


@pytest.mark.parametrize("mirrored", [False, True])
def test_holes_that_leave_the_mass_open_are_alike_by_their_angles(mirrored: bool) -> None:
    # analytic: 10 and 50 degrees ahead of a crank at 0, and of one at 90; or behind it
    side = -1.0 if mirrored else 1.0
    first = [(None, 10.0), (None, 50.0)]
    assert _same_options(first, 0.0, [(None, 90.0 + side * 50.0), (None, 90.0 + side * 10.0)], 90.0, mirrored)
    assert not _same_options(first, 0.0, [(None, 90.0 + side * 50.0), (None, 91.0 + side * 10.0)], 90.0, mirrored)
    # what rounding leaves is no difference, a ten-thousandth of a degree is one
    for off, same in ((1e-10, True), (1e-4, False)):
        values = [(None, 90.0 + side * 50.0), (None, 90.0 + side * 10.0 + off)]
        assert _same_options(first, 0.0, values, 90.0, mirrored) == same


def test_masses_that_leave_the_angle_open_are_alike_in_any_order() -> None:
    assert _same_options([(1.0, None), (2.0, None)], 0.0, [(2.0, None), (1.0, None)], 90.0, False)
    assert not _same_options([(1.0, None), (2.0, None)], 0.0, [(2.0, None), (1.5, None)], 90.0, False)
