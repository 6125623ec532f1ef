"""Hard cases with scenarios and tolerances: nothing is silent. Expected numbers are independent, to 100 digits."""

import pytest

from tests.hard import stored
from tests.hard.cases import all_cases
from tests.hard.worst_case import KINDS, faults
from tests.night import part

_CASES = all_cases()
_REFERENCES = stored.read()


def _held(kind: str, cases: range) -> None:
    fields = {
        case.name: wrong
        for case in _CASES[cases.start :: cases.step]
        if (wrong := faults(kind, case, _REFERENCES[stored.digest(case.body)])[1])
    }
    assert not fields, fields


@pytest.mark.parametrize(("offset", "kind"), part(2, list(enumerate(KINDS)), rows=True))
def test_some_cases_of_each_kind(offset: int, kind: str) -> None:
    _held(kind, range(offset, len(_CASES), 24))


@pytest.mark.nightly
@pytest.mark.parametrize("kind", KINDS)
def test_all_cases(kind: str) -> None:
    _held(kind, range(0, len(_CASES), 1))
