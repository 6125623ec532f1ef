"""What must hold for every machine: the certified optimum knows no frame, no units and no order."""

import copy
import random
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from schemas.answer.answers import OptimizeAnswer
from tests.optimize.machines import random_machine
from tests.verification.checking import optimized

SEEDS = st.integers(0, 10**6)
OBJECTIVES = st.sampled_from([{"combine": "sum"}, {"combine": "max"}, {"combine": "sum", "moment_weight": 2.0}])


def answer(body: dict[str, Any], objective: dict[str, Any]) -> OptimizeAnswer:
    return optimized({"machine": body, "objective": objective})


def same(a: OptimizeAnswer, b: OptimizeAnswer, objective: float = 1.0, mass: float = 1.0) -> None:
    """The second answer is the first, times factors; both are certified to 1e-6, the mass a little less sharply."""
    assert a.status == b.status == "optimal"
    rest = a.certificate.objective_without_counterweights
    assert b.certificate.objective_without_counterweights == pytest.approx(rest * objective, rel=1e-9, abs=1e-9)
    assert b.certificate.objective == pytest.approx(
        a.certificate.objective * objective, rel=1e-9, abs=2.1e-6 * rest * objective + 1e-12
    )
    assert b.total_mass_kg == pytest.approx(a.total_mass_kg * mass, rel=1e-4, abs=1e-9 * mass)


def every_angle(body: dict[str, Any], change: Any) -> dict[str, Any]:
    body = copy.deepcopy(body)
    for throw in body["throws"]:
        throw["crank_angle_deg"] = change(throw["crank_angle_deg"])
        for row in throw["rows"]:
            row["axis_deg"] = change(row["axis_deg"])
    for web in body["webs"]:
        if web["sector"]:
            web["sector"]["centre_deg"] = change(web["sector"]["centre_deg"])
    return body


@given(SEEDS, OBJECTIVES, st.floats(-720, 720))
def test_turning_the_frame(seed: int, objective: dict[str, Any], turn: float) -> None:
    body = random_machine(seed)
    same(answer(body, objective), answer(every_angle(body, lambda angle: angle + turn), objective))


@given(SEEDS, OBJECTIVES)
def test_looking_from_the_other_end(seed: int, objective: dict[str, Any]) -> None:
    """Mirroring x turns every angle a into 180 - a and the sense of rotation into the other."""
    body = random_machine(seed)
    mirrored = every_angle(body, lambda angle: 180.0 - angle)
    mirrored["rotation"] = {"cw": "ccw", "ccw": "cw"}[body["rotation"]]
    same(answer(body, objective), answer(mirrored, objective))


@given(SEEDS, OBJECTIVES)
def test_the_sense_of_rotation_changes_no_peak(seed: int, objective: dict[str, Any]) -> None:
    body = random_machine(seed)
    same(answer(body | {"rotation": "cw"}, objective), answer(body | {"rotation": "ccw"}, objective))


@given(SEEDS, st.sampled_from([1e-3, 0.37, 12.0, 1e4]))
def test_scaling_the_speed(seed: int, factor: float) -> None:
    body = random_machine(seed)
    faster = body | {"speed_rpm": body["speed_rpm"] * factor}
    same(answer(body, {}), answer(faster, {}), objective=factor**2)


@given(SEEDS, st.sampled_from([1e-3, 0.37, 12.0, 1e4]))
def test_scaling_the_masses(seed: int, factor: float) -> None:
    body = random_machine(seed)
    heavier = copy.deepcopy(body)
    for throw in heavier["throws"]:
        throw["rotating_mass_kg"] *= factor
        for row in throw["rows"]:
            row["reciprocating_mass_kg"] *= factor
            row["connecting_rod"]["mass_kg"] *= factor
    for web in heavier["webs"]:
        web["max_mass_kg"] *= factor
    if heavier["max_total_mass_kg"]:
        heavier["max_total_mass_kg"] *= factor
    same(answer(body, {}), answer(heavier, {}), objective=factor, mass=factor)


@given(SEEDS, st.sampled_from([1e-2, 0.37, 12.0, 1e3]))
def test_scaling_the_lengths(seed: int, factor: float) -> None:
    """Forces and moments over the span both grow with the length."""
    body = random_machine(seed)
    longer = copy.deepcopy(body)
    for throw in longer["throws"]:
        throw["position_m"] *= factor
        throw["crank_radius_m"] *= factor
        for row in throw["rows"]:
            row["offset_m"] *= factor
            if row["connecting_rod"]["length_m"]:
                row["connecting_rod"]["length_m"] *= factor
    for web in longer["webs"]:
        web["position_m"] *= factor
        web["counterweight_radius_m"] *= factor
    if longer["reference_plane_m"]:
        longer["reference_plane_m"] *= factor
    same(answer(body, {}), answer(longer, {}), objective=factor)


@given(SEEDS, OBJECTIVES)
def test_the_order_of_throws_rows_and_webs(seed: int, objective: dict[str, Any]) -> None:
    body = random_machine(seed)
    shuffled = copy.deepcopy(body)
    rng = random.Random(seed)
    rng.shuffle(shuffled["throws"])
    rng.shuffle(shuffled["webs"])
    for throw in shuffled["throws"]:
        rng.shuffle(throw["rows"])
    same(answer(body, objective), answer(shuffled, objective))


@given(SEEDS)
def test_more_room_never_hurts(seed: int) -> None:
    body = random_machine(seed)
    roomier = copy.deepcopy(body)
    for web in roomier["webs"]:
        web["max_mass_kg"] *= 2
        web["sector"] = None
    roomier["max_total_mass_kg"] = None
    tight, wide = answer(body, {}).certificate, answer(roomier, {}).certificate
    assert wide.lower_bound <= tight.objective * (1 + 1e-12)
