"""No counterweight is dust: property, of random machines of every mode.

Regression: before dust was taken away in the answers of all methods 130 of 10,000 machines had some, and 62 had plates
of one kind that differed by less than a thousandth of a degree.
"""

import pytest

from tests.dust.judgement import judgement, seeds
from tests.dust.modes import MODES

_MACHINES = 2_000
#: machines of which no optimum was found without that web: three goals whose levels leave nothing for it
_NEEDED = {("priorities", 7)}


@pytest.mark.parametrize("mode", MODES)
def test_every_mode_is_answered(mode: str) -> None:
    found = judgement(mode, 0)
    assert found.answers > 0
    assert not found.dust


#: machines that had dust, or unlike plates
_REGRESSIONS = (
    ("sectors", 157), ("directions", 279), ("budget", 36), ("ceilings", 75), ("balance shafts", 163), ("gaps", 232),
    ("plates", 3), ("plates", 182), ("plates", 201), ("plates", 615), ("plates in budget", 170), ("bearings", 112),
    ("bending", 101), ("priorities", 13), ("priorities", 19), ("front", 127), ("trade", 31), ("rows", 599),
)  # fmt: skip


@pytest.mark.parametrize(("mode", "seed"), _REGRESSIONS)
def test_dust_stays_away(mode: str, seed: int) -> None:
    """Regression: webs left empty that no optimum needs, and plates of one size."""
    found = judgement(mode, seed)
    assert found.open == 0
    assert not found.dust
    assert not found.unlike


@pytest.mark.nightly
@pytest.mark.parametrize("mode", MODES)
def test_no_dust(mode: str) -> None:
    at_fault = [
        f"seed {seed}: {'; '.join([*found.dust, *found.unlike])}"
        for name, seed in seeds(_MACHINES)
        if name == mode and (name, seed) not in _NEEDED and ((found := judgement(name, seed)).dust or found.unlike)
    ]
    assert not at_fault
