"""What shakes the frame, as outputs show it, is held entirely; what the numbers mean is exact in a case of its own."""

from math import pi
from typing import Any

import pytest

from service.verification import checker
from tests.optimize.machines import machine, row, throw, web
from tests.verification.checking import broken, optimized
from tests.verification.test_curves import part

_OUTPUTS = {"outputs": ["hodograph", "orders", "foundation_loads"], "angles": {"step_deg": 30}}


def _answered(rotation: str, order: int, **more: Any) -> tuple[dict[str, Any], dict[str, Any]]:
    rods = {"connecting_rod": {"length_m": 0.35, "mass_kg": 3.0}}
    throws = [throw(-0.3, 70.0, [row(25.0, 12.0, **rods)]), throw(0.4, 190.0, [row(115.0, 11.0, **rods)])]
    body = {
        "machine": machine(throws, [web("a", -0.4, 4.0), web("b", 0.5, 4.0)], rotation=rotation, **more),
        "foundation_orders": [order],
        **_OUTPUTS,
    }
    return body, optimized(body).model_dump(mode="json")


@pytest.mark.parametrize("rotation", ["ccw", "cw"])
@pytest.mark.parametrize("order", [1, 2, 3, 4, 6])
def test_every_number_of_them_is_held(rotation: str, order: int) -> None:
    body, answer = _answered(rotation, order)
    assert not broken(body, answer)
    verdict = checker().verify(body, answer)
    assert (verdict["verdict"], verdict["checked"]) == ("held", verdict["leaves"])


@pytest.mark.parametrize("rotation", ["ccw", "cw"])
def test_a_phase_of_the_other_sense_is_broken(rotation: str) -> None:
    """Analytic: mirrored, a phase counts against the sense of rotation."""
    body, answer = _answered(rotation, 2)
    load = answer["foundation_loads"][0]["after"]["couple_of_x_forces"]
    assert load["amplitude_Nm"] > 0
    load["phase_deg"] = (360.0 - load["phase_deg"]) % 360.0
    assert any(claim.startswith("foundation") for claim in broken(body, answer))


def test_a_load_that_is_none_may_not_be_called_some_nor_the_other_way_round() -> None:
    body, answer = _answered("ccw", 3)
    before = answer["foundation_loads"][0]["before"]
    before["force_x"]["amplitude_N"] = 1e-3
    assert any(claim.startswith("foundation") for claim in broken(body, answer))
    body, answer = _answered("ccw", 4)
    before = answer["foundation_loads"][0]["before"]
    before["force_x"] = {"amplitude_N": 0.0, "phase_deg": 0.0}
    assert any(claim.startswith("foundation") for claim in broken(body, answer))


def test_what_a_load_is_small_beside() -> None:
    """Analytic: the sizes of all that is added up, of a rod a third with the piston, about a plane midway."""
    body, _ = _answered("ccw", 1)
    place = part("numbers").Place
    position = place(body, "request")
    built = part("machine").Machine(position / "machine", position / "objective", place(None), place(None))
    mass = part("machine").Mass
    heavy = mass(part("numbers").real(0.5), part("numbers").ONE, part("numbers").ZERO, part("numbers").real(0.45))
    fitted = part("answer").NOTHING_FITTED._replace(turning=[heavy])
    square = (600 * pi / 30) ** 2
    for there, more in ((None, 0.0), (fitted, 0.5)):
        sizes = part("shaking")._size(built, there)
        # masses are 15 and 14 kg on cranks of 0.1 m; planes and weight are 0.35 and 0.4 m away from 0.05 m
        assert float(sizes["force"]) == pytest.approx((2.9 + more) * square, rel=1e-12)
        assert float(sizes["moment"]) == pytest.approx((2.9 * 0.4 + more * 0.45) * square, rel=1e-12)


@pytest.mark.parametrize("ratio", [1e-9, 0.2, 0.9, 0.9999, 1.0])
@pytest.mark.parametrize("order", [2, 4, 6])
def test_the_harmonics_of_a_rod(ratio: float, order: int) -> None:
    """Independent: scipy's hypergeometric function."""
    import sys

    from optimizer.mechanics.slider_crank import acceleration_harmonic

    checker()
    share, off = sys.modules["verify_orders"].harmonic(order, ratio)
    assert abs(share - float(acceleration_harmonic(order, ratio))) <= off + 1e-13 * ratio
    # at 1 the series falls as 1 / n^3 only
    assert off <= (1e-11 if ratio < 1 else 1e-4) * abs(share)
