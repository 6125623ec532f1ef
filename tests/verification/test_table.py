"""What is falsified in an answer of any kind is caught, or named as not covered: the table, in short and in full."""

import pytest

from service.verification import checker
from tests.night import part
from tests.verification.__main__ import tally
from tests.verification.answers import names, pair
from tests.verification.falsified import numbers

#: numbers of an answer that the short form falsifies, each in all ways, of some kinds that take a check 0.1 s at most
_SOME = 2
_LONG = ("matching", "gas", "indicated pressure", "dynamics", "four strokes")


@pytest.mark.parametrize("name", part(2, [name for name in names() if name not in _LONG][::8]))
def test_some_of_the_table(name: str) -> None:
    request, answer = pair(name)
    counts, missed = tally(request, answer, max(1, len(list(numbers(answer))) // _SOME))
    assert not missed, [(forgery.path, forgery.way) for forgery in missed]
    assert counts["caught"] > 0


@pytest.mark.nightly
@pytest.mark.parametrize("name", names())
def test_the_whole_table(name: str) -> None:
    request, answer = pair(name)
    assert checker().verify(request, answer)["verdict"] != "broken"
    _, missed = tally(request, answer, 1)
    assert not missed, [(forgery.path, forgery.way) for forgery in missed]


#: what nobody may falsify, whatever else of an answer is not covered
_CORE = (
    "mass_kg", "angle_deg", "angle_from_crank_deg", "throw", "centrifugal_force_N", "x_kg_m", "y_kg_m", "radius_m",
    "position_m", "mass_radius_kg_m", "total_mass_kg", "gap", "relative_gap", "rate", "sideways", "peak_N", "real_Nm",
    "smallest_force_N", "smallest_moment_Nm", "mass_relative_gap",
)  # fmt: skip


@pytest.mark.nightly
@pytest.mark.parametrize("name", [name for name in names() if name not in ("matching", "sweep")])
def test_core_claims_are_caught_whatever_else_is_not_covered(name: str) -> None:
    from tests.verification.falsified import falsified, outcome, silent

    request, answer = pair(name)
    for path in numbers(answer):
        if path[-1] in _CORE and not {"main_bearings", "roll", "multipliers"} & {*path}:
            for forgery in falsified(answer, path, None):
                assert outcome(request, forgery, silent()) in ("caught", "rounding"), (path, forgery.way)
