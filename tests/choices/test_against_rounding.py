"""One random machine in every mode, each night: no answer is worse than rounding by hand with local search."""

import pytest

from tests.choices.against_rounding import MODES, compared


@pytest.mark.nightly
def test_no_answer_is_worse() -> None:
    """Independent: a plain search from the rounded continuous optimum; ``python -m tests.choices.against_rounding``."""
    found = list(compared(0))
    assert [one.mode for one in found] == list(MODES)
    assert not any(one.worse for one in found)
