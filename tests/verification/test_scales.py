"""Genuine answers of machines of extreme scales: rounding of what cancels breaks no claim."""

import json
from math import radians, sin

import pytest

from optimizer.optimize import optimize
from schemas.request.requests import OptimizeRequest
from service.verification import checker
from tests import night
from tests.hard.bodies import drawn
from tests.optimize.machines import machine, row, throw, web
from tests.verification.answers import pair
from tests.verification.checking import broken, is_broken
from tests.verification.test_curves import part


@pytest.mark.parametrize(
    ("mode", "number", "seed", "claim"),
    night.part(
        4,
        [
            # weights of 8e19 N that leave 2e14 N, and of 1e-6 N that leave 5e-9 N
            ("balance shafts", 191, 77, "cuts"),
            ("balance shafts", 261, 77, "cuts"),
            # a minimum of 9e-44 kg beside a budget of 35 t, whose least price of 1e-30 would cost 3e-26 kg
            ("plates", 267, 77, "mass_lower_bound"),
            # webs of 1e15 kg and more in a scenario, which the unchanged machine has no use for
            ("scenarios", 88, 78, "nominal_optimum"),
            ("tolerances", 404, 78, "nominal_optimum"),
            # a limit of 1e300 kg: 8e-8 kg are enough where masses are off, 2e-9 kg where none is
            ("tolerances", 390, 79, "nominal_optimum"),
            # plates of up to 9 kg: 5e-23 kg are enough for the moment by itself
            ("plates", 267, 79, "smallest_moment"),
            # a force of 9e22 N under a moment of 1e-10 N m, which is exceeded by the rounding of a mass of 2e19 kg
            ("scenarios", 116, 80, "nominal_optimum"),
            # a plate that is open to 89.999999 degrees, where an unbalance tells the opening to 1e-8
            ("plates", 204, 80, "shape"),
            # nothing without counterweights, and no use for a budget of a gram; and 6e-14 N m of rounding beside
            # no budget
            ("axis ceilings", 451, 78, "yardstick"),
            ("axis ceilings", 444, 78, "yardstick"),
            # nothing without counterweights, and 0.04 kg are as much as the proof counts with
            ("axis ceilings", 864, 83, "yardstick"),
            # a moment of nothing, of which nothing is allowed, beside a force of 58 N
            ("balance shafts", 135, 83, "ceilings"),
            # ceilings that conflict within 1000 kg at a radius of 5e7 m; a peak by itself counts with 6e21 kg there
            ("balance shafts", 1381, 83, "conflict"),
            # a moment of 10 N m that turns against the shaft, the rounding of which is 1e12 N m
            ("balance shafts", 1871, 83, "conflict"),
            # any masses keep a ceiling that no choice in time does
            ("catalogue", 5488, 83, "objective"),
            # 1e16 N along x, of which nothing counts, beside 3 kN along y
            ("scenarios", 1971, 90, "sensitivity"),
            # a moment of nothing, which places on a balance shaft of 1e9 m change
            ("balance shafts", 2277, 90, "ceilings"),
            # a web without a limit, at which 1e-8 N/kg are left of 3 kN/kg m that cancel
            ("plates", 4677, 92, "shadow_prices"),
            # 5e18 kg at a radius of 6e4 m, in a sector that points away
            ("catalogue", 1337, 83, "smallest_force"),
            # 9e17 kg m in a sector that points away, of which it is not told whether it does
            ("balance shafts", 1031, 94, "lower_bound"),
            # a budget that is used by 1e-10 of what cancels, at a price that is rounding for the most part
            ("scenarios", 4078, 96, "lower_bound"),
            # a plate of up to 2e10 kg m, at which 2e-12 N are left of what cancels
            ("plates", 2185, 95, "shadow_prices"),
            # a moment of 6e-9 N m, none of which is allowed, beside 1e12 N whose arm is 0 but for rounding
            ("balance shafts", 261, 95, "mass_lower_bound"),
        ],
        rows=True,
    ),
)
def test_what_cancels_is_judged_by_its_parts(mode: str, number: int, seed: int, claim: str) -> None:
    drawing = drawn(number, seed, mode)
    assert drawing is not None
    answer = optimize(OptimizeRequest.model_validate(drawing))
    verdicts = {
        statement["claim"]: statement["verdict"]
        for statement in checker().verify(json.loads(json.dumps(drawing)), json.loads(answer.model_dump_json()))[
            "claims"
        ]
    }
    assert verdicts[claim] == "held"
    assert "broken" not in verdicts.values()


def test_a_yardstick_of_what_webs_are_implied_to_carry_is_named() -> None:
    """Regression: webs that are implied to carry nothing cancel nothing, which the checker does not show."""
    drawing = drawn(4934, 95, "parts")
    assert drawing is not None
    answer = json.loads(optimize(OptimizeRequest.model_validate(drawing)).model_dump_json())
    assert answer["certificate"]["implied_max_mass_kg"] == {"1": 0.0, "2": 0.0}
    verdict = checker().verify(json.loads(json.dumps(drawing)), answer)
    assert [claim["claim"] for claim in verdict["claims"] if claim["verdict"] != "held"] == ["yardstick"]
    answer["certificate"]["mass_yardstick_kg"] *= 1.01
    assert [claim.split()[0] for claim in broken(drawing, answer)] == ["yardstick"]


@pytest.mark.parametrize(
    ("mode", "number", "seed", "share"),
    night.part(
        4,
        [
            # a speed of 3e-7 rpm, at which what proves that no mass is below 0 is beyond all numbers
            ("plates", 32, 85, 0.001),
            # other masses are the worst where counterweights are off
            ("scenarios", 14, 85, 0.1),
            # a bound of the unchanged machine that counts with less than its plates
            ("plates", 128, 85, 0.001),
            # no time to look for the worst masses of what was come to
            ("plates", 135, 86, 1.0),
            # a ceiling whose peak is lost in rounding in a scenario
            ("scenarios", 98, 86, 0.1),
            # a ring of 8e11 kg that may weigh nothing, beside 1e-9 kg
            ("plates", 51, 87, 1.0),
            # two ways to be off whose peaks differ by 3e-13
            ("tolerances", 29, 88, 0.02),
            # ceilings that the best of the unchanged machine does not keep
            ("axis ceilings", 100, 88, 0.001),
            # a ceiling of nothing on a moment that there is with heavy masses only
            ("axis ceilings", 55, 95, 1.0),
            # a price of the budget that is raised by its rounding
            ("balance shafts", 983, 89, 1.0),
            # a plate of up to 66 t, at which what cancels leaves 2e-4 of 2e10 N, or 1e-2
            ("plates", 4880, 96, 0.1),
        ],
        rows=True,
    ),
)
def test_masses_that_are_off_are_judged_at_every_corner(mode: str, number: int, seed: int, share: float) -> None:
    drawing = drawn(number, seed, mode)
    assert drawing is not None
    drawing["tolerances"] = (drawing.get("tolerances") or {}) | {"reciprocating_mass_relative": share}
    answer = optimize(OptimizeRequest.model_validate(drawing))
    judged = checker().verify(json.loads(json.dumps(drawing)), json.loads(answer.model_dump_json()))
    assert "broken" not in {claim["verdict"] for claim in judged["claims"]}


def test_every_figure_of_masses_that_are_off_is_covered() -> None:
    """One of them changed at a time: the worst case, its peaks, its proof and what a degree costs are caught."""
    request, answer = pair("tolerances of rows")
    judged = checker().verify(request, answer)
    assert (judged["verdict"], judged["checked"]) == ("held", judged["leaves"])
    places = (
        ("certificate", "objective"),
        ("certificate", "lower_bound"),
        ("worst_case", "force_peak_N"),
        ("price_of_robustness", "nominal"),
        ("sensitivity", "objective_rise_per_deg"),
    )
    for room, field in places:
        figure = answer[room][field]
        answer[room][field] = figure * 1.001
        assert is_broken(request, answer), field
        answer[room][field] = figure


@pytest.mark.parametrize("size", [1e-6, 0.5, 20.0])
def test_the_lightest_that_cancels_a_row_of_any_size(size: float) -> None:
    """Analytic: a force by a kilogram on the web of the larger radius that may carry any, and no row of nothing."""
    place, real = part("numbers").Place, part("numbers").real
    body = {"machine": machine([throw(0.0, 0.0, [row(0.0, 1.0)])], [web("a", 0.0, 4.0, 0.1), web("b", 0.2, 4.0, 0.4)])}
    position = place(body, "request")
    built = part("machine").Machine(position / "machine", position / "objective", place(None), place(None))
    rows = {name: {name: part("numbers").ONE} for name in ("force", "moment")}
    statement, sizes = part("program").Statement(built, place({}), rows), {"force": real(size), "moment": real(0.0)}
    for implied, radius in ({}, 0.4), ({"b": 0.0}, 0.1):
        extent = statement.lightest(sizes, place(implied))
        assert float(extent) == pytest.approx(size / (radius * float(built.square)), rel=1e-12)


def _full_plate(opening_deg: float) -> bool:
    """Whether it is held that a plate of up to 60 degrees either way is open so far."""
    angle, areal, inner, outer = radians(opening_deg), 78.5, 0.1, 0.3
    mass = areal * angle * (outer**2 - inner**2)
    shape = {
        "half_angle_deg": opening_deg,
        "inertia_kg_m2": areal * angle * (outer**4 - inner**4) / 2,
        "outer_radius_m": outer,
        "chord_height_m": None,
    }
    lever = 2 / 3 * areal * (outer**3 - inner**3) * sin(angle) / mass
    weight = part("numbers").Place({"mass_kg": mass, "radius_m": lever, "shape": shape}, "answer", "counterweights")
    plate = part("plates").Plate(False, inner, outer, areal, radians(60.0))
    return all(room.high >= 0 for _, _, room, _ in part("weights")._cut(plate, weight))


@pytest.mark.parametrize(("opening_deg", "held"), [(45.0, True), (60.0, True), (60.0 + 1e-9, False)])
def test_a_plate_is_open_as_far_as_it_may_be_and_no_further(opening_deg: float, held: bool) -> None:
    """Analytic: sectors of rings; the last is heavier by less than figures are printed to."""
    assert _full_plate(opening_deg) == held
