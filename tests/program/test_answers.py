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
    answer = answered(request)
    assert (answer["status"], answer["active_limits"]) == (recorded["status"], recorded["active_limits"])
    if answer["status"] == "infeasible":
        _alike(answer["infeasibility"], recorded["infeasibility"])
        return
    proof, certificate = answer["certificate"], recorded["certificate"]
    for field in ("objective", "lower_bound", "objective_without_counterweights", "mass_objective_limit"):
        assert _near(proof[field], certificate[field], _GAP * certificate["yardstick"]), field
    assert _near(proof["yardstick"], certificate["yardstick"], 1e-9 * certificate["yardstick"])
    size = _MASS_GAP * (certificate["mass_yardstick_kg"] or 0.0)
    assert _near(proof["mass_lower_bound_kg"], certificate["mass_lower_bound_kg"], size)
    if certificate["mass_lower_bound_kg"] is not None:
        assert _near(answer["total_mass_kg"], recorded["total_mass_kg"], size)
        fitted, before = (
            [counterweight["mass_kg"] > 0.0 for counterweight in optimum["counterweights"]]
            for optimum in (answer, recorded)
        )
        assert fitted == before


def _near(figure: float | None, recorded: float | None, off: float) -> bool:
    return figure == recorded or (figure is not None and recorded is not None and abs(figure - recorded) <= off)


def _alike(fields: dict[str, Any], recorded: dict[str, Any]) -> None:
    assert fields["conflict"] == recorded["conflict"]
    for field, figure in recorded.items():
        if field.startswith("smallest_") and isinstance(figure, float):
            assert fields[field] == pytest.approx(figure, rel=1e-5, abs=1e-9), field
