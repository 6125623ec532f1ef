"""Regression: what every function of the mechanics comes to, on designs and machines of every kind, to 1e-10."""

import pytest

from tests.mechanics.recorded import cases, records
from tests.prints import alike, print_of


@pytest.mark.parametrize("name", cases())
def test_functions_come_to_what_they_did(name: str) -> None:
    found, recorded = print_of(cases()[name]()), records()[name]
    differ = [pair for pair in zip(found, recorded, strict=False) if not alike(*([each] for each in pair))]
    assert alike(found, recorded), differ[:4]


def test_nothing_is_recorded_that_is_not_tried() -> None:
    assert cases().keys() == records().keys()
