"""The workbench's own arithmetic against the service, and what it says of a difference."""

from typing import Any

import pytest
from freecad.counterweight.first_order import first_order
from freecad.counterweight.moments import Moments
from freecad.counterweight.verdict import verdict
from hypothesis import given
from hypothesis import strategies as st

from optimizer.analyze import analyze
from schemas.request.requests import AnalyzeRequest

ANGLES, PLACES = st.floats(-180.0, 180.0), st.floats(-1.0, 1.0)
RODS = (
    st.none()
    | st.fixed_dictionaries(
        {"length_m": st.floats(0.5, 2.0), "mass_kg": st.floats(0.0, 50.0)},
        optional={"reciprocating_share": st.floats(0.0, 1.0)},
    )
    | st.just({"length_m": 0.8, "mass_kg": 40.0, "centre_of_mass_m": 0.25})
)
PARTS = st.just(
    [{"name": "a", "mass_kg": 3.0, "motion": "reciprocating"}, {"name": "b", "mass_kg": 2.0, "motion": "rotating"}]
)
ROWS = st.fixed_dictionaries(
    {"axis_deg": ANGLES, "reciprocating_mass_kg": st.floats(1.0, 300.0), "connecting_rod": RODS},
    optional={"offset_m": st.floats(-0.1, 0.1), "parts": PARTS},
)
THROWS = st.fixed_dictionaries(
    {
        "position_m": PLACES,
        "crank_radius_m": st.floats(0.05, 0.2),
        "crank_angle_deg": ANGLES,
        "rows": st.lists(ROWS, max_size=3),
    },
    optional={"rotating_mass_kg": st.floats(0.0, 50.0)},
)
ROTORS = st.builds(
    Moments, st.just(100.0), st.complex_numbers(max_magnitude=10.0), st.complex_numbers(max_magnitude=10.0)
)


@given(st.lists(THROWS, min_size=1, max_size=4), ROTORS)
def test_the_first_order_is_that_of_the_service(throws: list[dict[str, Any]], rotor: Moments) -> None:
    unbalances = rotor.as_unbalances("rotor", -1.5, 2.0)
    machine = {"kind": "reciprocating", "speed_rpm": 500, "throws": throws, "unbalances": unbalances}
    answer = analyze(AnalyzeRequest.model_validate({"machine": machine, "outputs": ["residual"]}))
    assert answer.residual is not None
    order = answer.residual.before
    force, moment = first_order(rotor, throws, 500.0, answer.reference_plane_m)
    # what cancels is as exact as what it cancels of
    near = {"rel": 1e-12, "abs": 1e-9 * (force.peak + moment.peak + 1.0)}
    assert force.peak == pytest.approx(order.force.peak_N, **near)
    assert force.co_rotating == pytest.approx(order.force.co_rotating_N, **near)
    assert moment.peak == pytest.approx(order.moment.peak_Nm, **near)
    assert moment.counter_rotating == pytest.approx(order.moment.counter_rotating_Nm, **near)


@given(ROTORS, PLACES, st.floats(0.1, 2.0))
def test_two_unbalances_are_the_rotor(rotor: Moments, low: float, length: float) -> None:
    static = axial = 0j
    for fields in rotor.as_unbalances("rotor", low, low + length):
        unbalance = complex(fields["x_kg_m"], fields["y_kg_m"])
        static += unbalance
        axial += fields["position_m"] * unbalance
    # analytic: they were chosen so
    assert static == pytest.approx(rotor.static_kg_m, abs=1e-11)
    assert axial == pytest.approx(rotor.axial_kg_m2, abs=1e-11)


MACHINE = {"throws": [], "speed_rpm": 30 / 3.141592653589793}  # 1 rad/s
FIGURES = {"peak": 2.0, "co_rotating": 2.0, "counter_rotating": 0.0}
ANSWER = {
    "reference_plane_m": 0.0,
    "residual": {
        when: {
            "force": {f"{name}_N": value for name, value in FIGURES.items()},
            "moment": {f"{name}_Nm": 0.0 for name in FIGURES},
        }
        for when in ("before", "after")
    },
    "counterweights": [{"web": "a", "mass_kg": 10.0}],
}


def test_the_same_is_held_in_words() -> None:
    judgement = verdict(MACHINE, ANSWER, Moments(5.0, 1.0 + 0j, 0j), {"a": Moments(10.0, 1.0 + 0j, 0j)})
    assert judgement.held
    first, *words = judgement.words()
    assert first == "HELD: the solids leave what the service says: peak force 2 of 2 N, peak moment 0 of 0 N m."
    assert words[0].startswith("peak force: solids 2 N, service 2 N, without 2 N")


def test_what_rounding_leaves_of_nothing_is_no_difference() -> None:
    machine = {**MACHINE, "webs": [{"position_m": 0.1}]}
    judgement = verdict(machine, ANSWER, Moments(5.0, 1.0 + 0j, 1e-17 + 0j), {"a": Moments(10.0, 1.0 + 0j, 0j)})
    assert judgement.held
    # no figure is what rounding leaves
    assert "e-" not in judgement.headline
    assert all("e-" not in line.partition(", difference")[0] for line in judgement.words())


@pytest.mark.parametrize(
    ("weights", "named"),
    [
        ({"a": Moments(10.0, 1.0 + 1e-8 + 0j, 0j)}, 5e-9),
        ({"a": Moments(10.0 * (1 + 2e-9), 1.0 + 0j, 0j)}, 2e-9),
        ({"a": Moments(10.0, 1.0 + 0j, 0j), "b": Moments(1.0, 0j, 0j)}, 0.1),
        ({}, 1.0),
    ],
)
def test_a_difference_is_refused(weights: dict[str, Moments], named: float) -> None:
    judgement = verdict(MACHINE, ANSWER, Moments(5.0, 1.0 + 0j, 0j), weights)
    assert not judgement.held
    assert judgement.worst == pytest.approx(named, rel=1e-6)
    assert "REFUSED" in judgement.words()[0]
