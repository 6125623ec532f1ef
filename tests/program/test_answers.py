"""Regression: recorded requests of every kind have the status, proven figures and empty webs that they had.

The answers are those that the checker's record holds (``tests/verification/recorded.py``), where all else of them is
looked at. An optimum is told to its gap: a search that finds less, or proves less, is seen by that.
"""

from typing import Any

import pytest

from tests.night import part
from tests.verification.answers import answered
from tests.verification.recorded import records

#: of the objective and of the mass without counterweights: the gaps that are asked for
_GAP, _MASS_GAP = 1e-6, 1e-5
#: studies, what differs in outputs alone, and what takes a fifth of a second
_LEFT_OUT = (
    "sweep", "front", "matching", "built", "shaking", "weight with", "four strokes", "dynamics", "cheaper",
    "no limits, max", "priorities, masses", "axis ceilings 73", "orders of all", "balance shafts, ceil",
)  # fmt: skip
_NAMES = [name for name in records() if not any(part in name for part in _LEFT_OUT)]


@pytest.mark.parametrize("name", part(3, _NAMES))
def test_an_answer_is_as_good_and_as_well_proven_as_it_was(name: str) -> None:
    request, recorded = records()[name]["request"], records()[name]["answer"]
    found = answered(request)
    assert (found["status"], found["active_limits"]) == (recorded["status"], recorded["active_limits"])
    if found["status"] == "infeasible":
        _alike(found["infeasibility"], recorded["infeasibility"])
        return
    proof, known = found["certificate"], recorded["certificate"]
    for field in ("objective", "lower_bound", "objective_without_counterweights", "mass_objective_limit"):
        assert _near(proof[field], known[field], _GAP * known["yardstick"]), field
    assert _near(proof["yardstick"], known["yardstick"], 1e-9 * known["yardstick"])
    size = _MASS_GAP * (known["mass_yardstick_kg"] or 0.0)
    assert _near(proof["mass_lower_bound_kg"], known["mass_lower_bound_kg"], size)
    if known["mass_lower_bound_kg"] is not None:
        assert _near(found["total_mass_kg"], recorded["total_mass_kg"], size)
        fitted, before = ([each["mass_kg"] > 0.0 for each in one["counterweights"]] for one in (found, recorded))
        assert fitted == before


def _near(found: float | None, recorded: float | None, off: float) -> bool:
    return found == recorded or (found is not None and recorded is not None and abs(found - recorded) <= off)


def _alike(found: dict[str, Any], recorded: dict[str, Any]) -> None:
    assert found["conflict"] == recorded["conflict"]
    for field, value in recorded.items():
        if field.startswith("smallest_") and isinstance(value, float):
            assert found[field] == pytest.approx(value, rel=1e-5, abs=1e-9), field
