"""What counterweights do to responses on the frame and to cuts, and whose crank they are on, in closed form."""

import math
from types import SimpleNamespace as Fields
from typing import Any

import pytest

from tests.verification.test_curves import part


def real(value: float) -> Any:
    return part("numbers").real(value)


@pytest.mark.parametrize("exact", [True, False])
@pytest.mark.parametrize(("force", "moment"), [(1.0, 0.0), (0.0, 1.0), (2.0, 3.0), (0.0, 3.0), (5.0, 0.0)])
def test_a_response_of_force_and_moment(force: float, moment: float, exact: bool) -> None:
    """Analytic: a unit of force at 7 m adds 1, and about 3 m a moment of 4."""
    numbers = part("numbers")
    shares = tuple({0.0: numbers.ZERO, 1.0: numbers.ONE}.get(value, real(value)) for value in (force, moment))
    machine = Fields(shares={"both": shares}, plane=real(3.0))
    arm = part("machine").Machine.arm(machine, "both", real(7.0), numbers.ONE if exact else numbers.ABOUT_ONE)
    assert float(arm) == pytest.approx(force + 4.0 * moment, rel=1e-12)


@pytest.mark.parametrize(("scalar", "expected"), [(True, 3.0 + 2.0 * 5.0), (False, math.hypot(13.0, 4.0 + 2.0 * 7.0))])
def test_what_counterweights_come_to_at_a_cut(scalar: bool, expected: float) -> None:
    """Analytic: along an axis the real part alone counts, in a plane the length."""
    numbers = part("numbers")
    none = Fields(of=lambda factors, sizes: numbers.ZERO)
    machine = Fields(webs=[Fields(fixed=None)], wide=numbers.ONE, blur=numbers.ZERO)
    program = Fields(machine=machine, first=Fields(geared=[]), off=none, goal_names=["objective"])
    cut = Fields(start=real(3.0) + numbers.J * real(4.0), factors=[real(2.0)], scalar=scalar, mean=False,
                 group=(None, 0), row="force", floor=numbers.ZERO)  # fmt: skip
    fitted = Fields(turning=[Fields(product=numbers.ONE, co=real(5.0) + numbers.J * real(7.0))], on_shafts=[])
    reached = part("multipliers").Program.reached(program, [cut], fitted)
    assert float(reached) == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize(("far", "throws"), [(100.0, {0: 0.5, 1: 0.5}), (1.0, {1: 1.0})])
def test_cranks_are_equally_near_by_the_extent_of_all(far: float, throws: dict[int, float]) -> None:
    """Analytic: 2e-8 m are within 1e-9 of 101 m, and not of 3 m."""
    places = [0.0, 1.0, far]
    webs = [{"name": "between", "position_m": 0.5 + 1e-8}, {"name": "far", "position_m": far}]
    design = part("numbers").Place({"throws": [{"position_m": place} for place in places[:2]], "webs": webs})
    shares = part("cranks").shares(design)["between"]
    assert {throw: float(share) for throw, share in shares.items()} == throws


@pytest.mark.parametrize(("own", "expected"), [({"reciprocating_mass_kg": 2.0}, 5.0), ({}, 3.0)])
def test_parts_add_to_the_mass_of_a_row(own: dict[str, float], expected: float) -> None:
    """Analytic: a row without a mass of its own has that of its parts, and a row without parts its own."""
    design = part("numbers").Place({"throws": [{"rows": [own, {"reciprocating_mass_kg": 7.0}]}]})
    rows = part("match")._with(design, {(0, 0): 3.0}).value["throws"][0]["rows"]
    assert [row["reciprocating_mass_kg"] for row in rows] == [expected, 7.0]
