"""Analytic: a machine of 2^-20 times the speed is judged alike: forces of inertia go with the square of the speed.

Masses stay as they are, so that prices are 2^-40 times as large, and multipliers of a mass 2^40 times. What the checker
compares with a price of its own is seen by that; of what is compared with a mass of its own see
:mod:`tests.verification.test_lighter`.
"""

import re
from typing import Any

import pytest

from tests.night import every
from tests.verification.recorded import records
from tests.verification.scaled import differences
from tests.verification.test_lighter import LEFT_OUT

_SLOWER = 2.0**-40
_SPEED = re.compile(r"(^|_)rpm$")
#: what is proportional to forces
_PROPORTIONAL = re.compile(
    r"_(N|Nm|Pa)(_|$)|^(objective|lower_bound|continuous_lower_bound|gap|yardstick|objective_without_counterweights"
    r"|objective_rise_per_(deg|percent)|mass_objective_limit|smallest|ceiling|peak|value|limit|nominal|nominal_optimum"
    r"|nominal_optimum_worst_case|nominal_lower_bound)$"
)
#: units of prices that are proportional to forces; of ceilings they are shares
_PRICES = ("N/kg", "N/deg", "N m/kg", "N m/deg")
#: what holds forces of gas or gravity, powers, or grades of a speed
_OTHER_FORCES = (
    "gravity",
    "roll",
    "shaking",
    "cheaper",
    "inline",
    "2d12",
    "bolts",
    "parts",
    "areas",
    "balance quality",
)
_NAMES = [name for name in records() if not any(part in name for part in (*LEFT_OUT, *_OTHER_FORCES))]


def slower(value: Any, name: str = "") -> Any:
    """The same at 2^-20 times the speed."""
    if name == "shadow_prices" and isinstance(value, list):
        return [
            multiplier | {"value": multiplier["value"] * (_SLOWER if multiplier["unit"] in _PRICES else 1.0)}
            for multiplier in value
        ]
    if name in ("multipliers", "nominal_multipliers") and isinstance(value, dict):
        return {key: _slower_multipliers(value, key) for key, value in value.items()}
    if isinstance(value, dict):
        return {key: slower(value, key) for key, value in value.items()}
    if isinstance(value, list):
        return [slower(value, name) for value in value]
    if not isinstance(value, int | float) or isinstance(value, bool):
        return value
    return value * (2.0**-20 if _SPEED.search(name) else _SLOWER if _PROPORTIONAL.search(name) else 1.0)


def _slower_multipliers(proof: Any, bounded: str) -> Any:
    """Those of forces are shares in a bound of a force; a kilogram of the budget has a price there."""
    if not isinstance(proof, dict) or "terms" not in proof:
        return proof
    of_forces, of_budget = (1.0 / _SLOWER, 1.0) if bounded == "mass" else (1.0, _SLOWER)

    def times(value: Any, factor: float) -> Any:
        return value * factor if isinstance(value, float) else value

    changed = {
        part: [
            {k: times(v, of_forces) if k in ("x", "y", "value") else v for k, v in multiplier.items()}
            for multiplier in values
        ]
        for part, values in proof.items()
        if isinstance(values, list)
    }
    return proof | changed | {"budget": times(proof["budget"], of_budget)}


@pytest.mark.parametrize("name", every(3, _NAMES))
def test_a_slower_machine_is_judged_alike(name: str) -> None:
    """Rooms are forces, masses, prices or shares."""
    assert differences(name, slower, (1.0, _SLOWER, 1.0 / _SLOWER))[:4] == []
