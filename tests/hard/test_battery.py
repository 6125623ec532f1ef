"""Every hard case, through the service's own computation, against its 100-digit reference.

All expected numbers are independent: tests/hard/reference.json, computed by tests/hard/reference.py.
"""

import pytest

from tests.hard import stored
from tests.hard.battery import run
from tests.hard.cases import all_cases
from tests.hard.cases.case import Case, case, machine, v_twin, web
from tests.hard.reference import reference
from tests.night import part
from tests.verification.checking import optimized

_CASES = all_cases()
_REFERENCES = stored.read()
#: every eleventh case of moderate size is computed anew
_SAMPLE = [case for case in _CASES if len(case.body["machine"]["webs"]) <= 4][::11]


def _name(case: Case) -> str:
    return case.name


@pytest.mark.parametrize("case", part(4, _CASES), ids=_name)
def test_case(case: Case) -> None:
    """Optimal within the asked gap, or infeasible where it is; nothing differs from the reference."""
    verdict = run(case, _REFERENCES[stored.digest(case.body)])
    assert not verdict.faults, "\n".join([case.why, *verdict.faults])


@pytest.mark.nightly
@pytest.mark.parametrize("case", _SAMPLE, ids=_name)
def test_stored_reference_is_what_the_reference_computes(case: Case) -> None:
    """Independent: the same numbers again, to the digits that are stored and the gap that is proven."""
    standard, again = _REFERENCES[stored.digest(case.body)], reference(case.body)
    assert standard.feasible == again.feasible
    for name in ("excess", "objective", "relaxed", "rest", "mass", "mass_relaxed", "force", "moment"):
        left, right = getattr(standard, name), getattr(again, name)
        assert (left is None) == (right is None)
        if left is not None:
            assert abs(left - right) <= 1e-15 * abs(right), name


def test_the_battery_is_what_was_promised() -> None:
    """At least 150 cases, each with a reason; two in five or more are ordinary ones."""
    assert len(_CASES) >= 150
    assert all(len(case.why) > 5 for case in _CASES)
    assert sum(case.ordinary for case in _CASES) >= 0.4 * len(_CASES)
    assert {len(case.body["machine"]["webs"]) for case in _CASES} >= {1, 2, 200}


def test_no_reference_is_left_over() -> None:
    """The file holds the cases there are, and no others."""
    assert set(_REFERENCES) == {stored.digest(case.body) for case in _CASES}


def test_what_a_double_cannot_hold_is_called_inaccurate() -> None:
    """A couple of 88 000 t on webs 1e-12 m apart, rounded to doubles, moves the least mass by more than is allowed.

    The status says so, and the bounds hold all the same (independent: the 100-digit reference).
    """
    webs = [web("a", 0.1, 1e8), web("b", 0.1 + 1e-12, 1e8)]
    beyond = case("webs/beyond-doubles", "masses of 1/gap in 53 bits", machine(v_twin(), webs))
    verdict = run(beyond, reference(beyond.body))
    assert verdict.status == "inaccurate"
    assert not [fault for fault in verdict.faults if "bound" in fault or "below" in fault]


@pytest.mark.parametrize("gap", part(3, [1e-9, 1e-12, 1e-15]))
@pytest.mark.parametrize(("place", "limit"), [(0.0, 1e9), (0.1, 1e12)])
def test_bounds_hold_where_the_webs_can_hardly_be_told_apart(place: float, limit: float, gap: float) -> None:
    """Slopes that cancel, times a reach of up to 1e12 kg (independent: the 100-digit reference)."""
    webs = [web("a", place, limit), web("b", place + gap, limit)]
    instance = case("webs/far", "slope times reach", machine(v_twin(), webs))
    answer, expected = optimized(instance.body), reference(instance.body)
    assert answer.certificate.lower_bound <= expected.objective <= answer.certificate.objective
    assert answer.certificate.mass_lower_bound_kg <= expected.mass
    # sharp all the same
    assert expected.objective - answer.certificate.lower_bound <= 1e-4 * answer.certificate.yardstick
