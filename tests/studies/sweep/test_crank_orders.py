"""All orders of crank angles that are different machines: how many, the best, and what tells them apart."""

from itertools import permutations
from typing import Any

import numpy as np
import pytest
from pydantic import ValidationError

from optimizer.mechanics.slider_crank import acceleration_harmonic
from optimizer.studies.sweep.chunk import run_chunk
from optimizer.studies.sweep.crank_orders import orders
from schemas.sweep.request import SweepRequest
from tests.night import part

RADIUS, MASS, RATIO, RPM, PITCH = 0.1, 3.0, 0.25, 600.0, 0.4
UNIT = MASS * RADIUS * (RPM * np.pi / 30) ** 2 * PITCH


def body(angles: list[float], **machine: Any) -> dict[str, Any]:
    """Equal rows in line, a pitch apart."""
    throws = [
        {
            "position_m": PITCH * k,
            "crank_radius_m": RADIUS,
            "crank_angle_deg": 0,
            "rows": [{"axis_deg": 90, "reciprocating_mass_kg": MASS, "connecting_rod": {"length_m": RADIUS / RATIO}}],
        }
        for k in range(len(angles))
    ]
    design = {"kind": "reciprocating", "speed_rpm": RPM, "throws": throws, **machine}
    return {
        "task": "analyze",
        "base": {"machine": design, "outputs": ["residual", "orders", "internal_moment"]},
        "design": "crank_orders",
        "angles_deg": angles,
    }


def sweep(angles: list[float], **machine: Any) -> SweepRequest:
    return SweepRequest.model_validate(body(angles, **machine))


def once(count: int) -> list[float]:
    return [360.0 * k / count for k in range(count)]


def twice(count: int) -> list[float]:
    return [720.0 * (k // 2) / count for k in range(count)]


@pytest.mark.parametrize(
    ("angles", "count"),
    part(
        2,
        [
            *((once(n), count) for n, count in zip(range(3, 11), (1, 3, 8, 38, 192, 1320, 10176, 91296), strict=True)),
            *((twice(n), count) for n, count in ((4, 3), (6, 11), (8, 183), (10, 5796))),
        ],
        rows=True,
    ),
)
def test_their_number(angles: list[float], count: int) -> None:
    """Independent: counts by enumeration with another program; here by Burnside's lemma, and by enumeration."""
    request = sweep(angles)
    assert request.total == count
    assert request.crank_orders is not None
    harmonics = orders(request.crank_orders)
    assert len(harmonics) == count
    assert np.array_equal(np.sort(harmonics, axis=-1), np.tile(np.sort(angles), (count, 1)))


def moments(angles: list[float]) -> np.ndarray:
    """First and second order and internal moment (N, 3) in units of m r w^2 and pitches, from the rows of the sweep."""
    request = sweep(angles)
    table = run_chunk(request.model_dump_json().encode(), 0, request.total)
    second = float(acceleration_harmonic(2, np.asarray(RATIO)))
    columns = {"moment_peak_Nm": 1.0, "moment_peak_Nm.order_2": second, "internal_moment_Nm": 1.0}
    return np.array([table[name].to_numpy() / (UNIT * size) for name, size in columns.items()]).T


def has(values: np.ndarray, *expected: float) -> bool:
    return bool(np.any(np.all(np.abs(values[:, : len(expected)] - expected) < 6e-4, axis=-1)))


def test_the_known_best_orders() -> None:
    """Independent: prototype and textbooks (moments of order 1 and 2 of 3 to 8 throws, m r w^2 times the pitch)."""
    assert moments(once(3))[0, :2] == pytest.approx([np.sqrt(3.0)] * 2, rel=1e-9)
    four = moments(once(4))
    assert all(has(four, *pair) for pair in ((1.414, 4.0), (2.828, 2.0), (3.162, 0.0)))
    assert has(moments(once(5)), 0.449, 4.980)
    seven = moments(once(7))
    assert all(has(seven, *pair) for pair in ((0.267, 1.006), (0.0765, 9.149)))
    assert np.min(seven[:, 0]) == pytest.approx(0.0765, abs=6e-4)
    eight = moments(once(8))
    assert has(eight, 0.131, 1.414)
    assert np.min(eight[eight[:, 1] < 1e-9, 0]) == pytest.approx(0.448, abs=6e-4)


def test_the_balanced_six() -> None:
    """Published: 0-120-240-240-120-0 is the only one without moments of order 1 and 2; analytic: it bends by root 3."""
    request, actual_moments = sweep(twice(6)), moments(twice(6))
    (balanced,) = np.flatnonzero(np.all(actual_moments[:, :2] < 1e-9, axis=-1))
    assert request.crank_orders is not None
    order = orders(request.crank_orders)[balanced]
    assert np.array_equal(order, order[::-1])
    assert actual_moments[balanced, 2] == pytest.approx(np.sqrt(3.0), rel=1e-9)


def test_three_balanced_eights_are_told_apart_by_the_internal_moment_alone() -> None:
    """Independent: prototype; the first by hand: 0, 180, 90, 270 mirrored has |1 + j| at its middle."""
    actual_moments = moments(twice(8))
    balanced = actual_moments[np.all(actual_moments[:, :2] < 1e-9, axis=-1)]
    assert np.sort(balanced[:, 2]) == pytest.approx([np.sqrt(2.0), np.sqrt(8.0), np.sqrt(10.0)], rel=1e-9)


def test_ten_throws() -> None:
    """Independent: prototype; straight from the orders, which 91,296 rows of a sweep would say too."""
    request = sweep(once(10))
    assert request.crank_orders is not None
    crank = np.deg2rad(orders(request.crank_orders))
    first, second = (np.abs(np.exp(1j * k * crank) @ np.arange(10.0)) for k in (1, 2))
    assert np.min(second[first < 1e-9]) == pytest.approx(0.898, abs=6e-4)


@pytest.mark.parametrize(
    ("change", "count"),
    [
        # the first angle stays, and both ends are alike: (24 + 24 unmoved 0) / 2
        ({"webs": [{"name": "a", "position_m": 0.6, "counterweight_radius_m": 0.1, "max_mass_kg": 1,
                    "sector": {"centre_deg": 0, "half_angle_deg": 10}}]}, 12),
        # a web at one end: turned and mirrored only
        ({"webs": [{"name": "a", "position_m": 0.0, "counterweight_radius_m": 0.1, "max_mass_kg": 1}]}, 3),
        ({"reference_plane_m": 0.0}, 3),
    ],
)  # fmt: skip
def test_what_the_machine_does_not_allow(change: dict[str, Any], count: int) -> None:
    """Analytic: four angles, 24 sequences; every pair of ends is reached by turning and mirroring as well."""
    assert sweep(once(4), **change).total == count


def test_every_order_is_one_of_them() -> None:
    """Independent: of random sequences, moments by hand stand among those of the orders."""
    request = sweep(twice(6))
    assert request.crank_orders is not None

    def by_hand(sequences: np.ndarray) -> set[tuple[float, ...]]:
        crank = np.deg2rad(sequences)
        arm = np.arange(6.0)
        both = [np.abs(np.exp(1j * k * crank) @ arm) for k in (1, 2)]
        return set(map(tuple, np.round(np.stack(both, axis=-1), 6)))

    assert by_hand(np.array(list(permutations(twice(6))))) == by_hand(orders(request.crank_orders))


@pytest.mark.parametrize(
    ("changes", "where"),
    [
        ({"angles_deg": [0, 90]}, ("angles_deg",)),
        ({"angles_deg": None}, ("angles_deg",)),
        ({"axes": [{"path": "/machine/speed_rpm", "values": [1]}]}, ("axes",)),
        ({"samples": 3}, ("samples",)),
        ({"design": "grid"}, ("angles_deg",)),
        ({"design": "grid", "angles_deg": None}, ("axes",)),
    ],
)
def test_bad_input_names_the_field(changes: dict[str, Any], where: tuple[str, ...]) -> None:
    with pytest.raises(ValidationError) as caught:
        SweepRequest.model_validate({**body(once(4)), **changes})
    problems = caught.value.errors()[0]["ctx"]["problems"]
    assert problems[0].path == where


@pytest.mark.parametrize("count", [12, 20])
def test_too_many_to_look_through(count: int) -> None:
    with pytest.raises(ValidationError) as caught:
        sweep(once(count))
    assert caught.value.errors()[0]["ctx"]["problems"][0].path == ("angles_deg",)


def test_with_counterweights() -> None:
    """Metamorphic: each row of the optimisation is no worse than as it stands."""
    webs = [
        {"name": name, "position_m": place, "counterweight_radius_m": 0.1, "max_mass_kg": 1}
        for name, place in (("a", -0.1), ("b", 1.3))
    ]
    payload = body(once(4), webs=webs)
    bare = SweepRequest.model_validate(payload)
    chosen = SweepRequest.model_validate({**payload, "task": "optimize"})
    assert chosen.total == bare.total == 3
    first, second_body = (run_chunk(query.model_dump_json().encode(), 0, 3) for query in (bare, chosen))
    assert set(second_body["status"].to_pylist()) == {"optimal"}
    before = first["force_peak_N"].to_numpy() + first["moment_peak_Nm"].to_numpy() / 1.4
    assert np.all(second_body["objective"].to_numpy() <= before * (1 + 1e-9) + 1e-9)


def test_counterweights_that_are_given_stay_where_they_are() -> None:
    """Analytic: no order of cranks is another one seen differently, so that none is left out."""
    webs = [
        {"name": name, "position_m": place, "counterweight_radius_m": 0.1, "max_mass_kg": 1}
        for name, place in (("a", 0.0), ("b", PITCH))
    ]
    payload = body([0.0, 180.0], webs=webs)
    payload["base"]["counterweights"] = [{"web": "a", "mass_kg": MASS, "angle_deg": 180}]
    request = SweepRequest.model_validate(payload)
    assert request.total == 2
    moments = run_chunk(request.model_dump_json().encode(), 0, 2)["moment_peak_Nm"].to_numpy()
    # the rows leave half of UNIT in either sense; the counterweight takes that of its sense away, or doubles it
    assert moments == pytest.approx([UNIT / 2, 3 * UNIT / 2], rel=1e-12)
