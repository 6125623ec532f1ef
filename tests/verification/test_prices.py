"""Prices of limits in the checker: of a limit of nothing, and of what rounding alone makes worth something."""

from typing import Any

import pytest

from tests.verification.test_curves import part


@pytest.mark.parametrize(("off", "held"), [(0.0, True), (0.9e-9, True), (1.1e-9, False), (-1.1e-9, False)])
def test_a_price_is_held_up_to_what_rounding_leaves_of_it(off: float, held: bool) -> None:
    stated = part("prices").Priced("max_mass", "a", 1e-8, 1e3, "kg", True)
    assert _held(stated, [{"limit": "max_mass", "web": "a", "value": 1e-8 + off, "unit": "N/kg"}], 1e-9) == held


def _held(stated: Any, values: list[Any], dust: float = 0.0) -> bool:
    place = part("numbers").Place(values, "answer", "shadow_prices")
    claims = part("prices").price_entries(place, [stated], 1.0, "N", 1e-9, 1.0, dust)
    return all(room.high >= 0 for _, _, room, _ in claims)


@pytest.mark.parametrize(("price", "held"), [(5.0, True), (5.1, False), (0.0, False)])
def test_a_budget_of_nothing_has_its_price(price: float, held: bool) -> None:
    """Regression: a quotient by the size of a limit that is 0 was no number."""
    stated = part("prices").Priced("max_total_mass", "", 5.0, 0.0, "kg", True)
    assert _held(stated, [{"limit": "max_total_mass", "web": None, "value": price, "unit": "N/kg"}]) == held


@pytest.mark.parametrize(("dust", "held"), [(1e-22, True), (0.0, False)])
def test_a_limit_beyond_any_need_may_be_left_out(dust: float, held: bool) -> None:
    """Regression: what rounding leaves of a price, times 1e30 kg, had to be listed."""
    stated = part("prices").Priced("max_mass", "a", 1e-25, 1e30, "kg", False)
    assert _held(stated, [], dust) == held
