"""Analytic: a machine whose masses are all 2^-40 times as large is judged alike, for all forces are proportional.

Numbers are scaled by a power of 2, so nothing is rounded in another way. What the checker compares with a number of its
own, and not with a share of the forces, is seen by that.
"""

import re
from typing import Any

import pytest

from tests import night
from tests.verification.recorded import records
from tests.verification.scaled import differences

_LIGHTER = 2.0**-40
#: what is proportional to the masses; plates of one density are thinner
_PROPORTIONAL = re.compile(
    r"_(kg|N|Nm|Pa|W|J)(_|$)|^(objective|lower_bound|continuous_lower_bound|gap|yardstick|thickness_m"
    r"|objective_without_counterweights|objective_rise_per_(deg|percent)|mass_objective_limit|smallest|ceiling|peak"
    r"|value|limit|nominal|nominal_optimum|nominal_optimum_worst_case|nominal_lower_bound)$"
)
#: prices are quotients of forces and masses, and multipliers of forces
_QUOTIENTS = ("shadow_prices", "multipliers", "nominal_multipliers")
#: what is dear, of other forms, or holds values that are no masses
LEFT_OUT = ("four strokes", "dynamics", "gas", "friction", "sweep", "front", "match", "texts", "scenario", "few ",
             "seed", "masses off", "priorities", "cheaper")  # fmt: skip
_NAMES = [name for name in records() if not any(part in name for part in LEFT_OUT)]


def lighter(value: Any, name: str = "") -> Any:
    """The same, all masses 2^-40 times as large."""
    if name in _QUOTIENTS:
        return _lighter_prices(value) if isinstance(value, list) else value
    if isinstance(value, dict):
        inside = name if name.endswith("implied_max_mass_kg") else ""
        return {key: lighter(value, inside or key) for key, value in value.items()}
    if isinstance(value, list):
        return [lighter(value, name) for value in value]
    number = isinstance(value, int | float) and not isinstance(value, bool)
    return value * _LIGHTER if number and _PROPORTIONAL.search(name) else value


def _lighter_prices(prices: list[Any]) -> list[Any]:
    """Those of angles are forces by the degree."""
    return [
        price | {"value": price["value"] * (_LIGHTER if price["unit"].endswith("/deg") else 1.0)} for price in prices
    ]


@pytest.mark.parametrize("name", night.part(2, _NAMES[::4]))
def test_a_lighter_machine_is_judged_alike(name: str) -> None:
    """Rooms are forces, or shares of them."""
    assert differences(name, lighter, (1.0, _LIGHTER))[:4] == []
