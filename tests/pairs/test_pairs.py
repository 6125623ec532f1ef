"""Any two features of a request go together or are refused by a field: property, of every pair.

A legal request is answered: without an exception, with a bound that is not above the value, a status that is honest,
counterweights within their limits, figures that agree, and no claim that the independent checker proves to be wrong.
"""

import pytest

from tests.night import ALL, but, part
from tests.pairs.asking import Outcome, ask
from tests.pairs.combinations import Combination, all_pairs, pairs_with_shafts, random_triples, some_pairs
from tests.pairs.features import FEATURES
from tests.pairs.machines import BASES
from tests.pairs.ways import accuracy_fault, pareto_fault, round_fault, sweep_fault

#: CPU seconds of a warm answer, the time limit of its search being a sixth of it
_MOST_CPU_S = 3.0
_TRIPLES = 2_000
_BLOCKS = 12


def _faults(outcomes: list[Outcome]) -> list[str]:
    return [f"{outcome.name} | {outcome.message}" for outcome in outcomes if outcome.kind == "fault"]


def _short(combination: Combination) -> str:
    base, features = combination
    return f"{base}: {' + '.join(features)}"


@pytest.mark.parametrize("base", but(("twin", "scroll") if ALL else ("scroll",), BASES))
def test_every_feature_is_legal_somewhere(base: str) -> None:
    outcomes = [ask(base, [name]) for name in FEATURES]
    assert not _faults(outcomes)
    answered = {outcome.features[0] for outcome in outcomes if outcome.kind == "answered"}
    alone = {
        "twin": {"roll weight", "bearings without sizes", "outputs of gas"},
        "vee": {"roll weight", "bearings without sizes", "outputs of gas"},
    }
    if base in alone:
        assert set(FEATURES) - answered == alone[base]
    else:
        assert len(answered) > len(FEATURES) // 2


@pytest.mark.parametrize("quarter", but((0, 2) if ALL else (0,), range(4)))
def test_some_pairs(quarter: int) -> None:
    outcomes = [ask(base, pair) for base, pair in some_pairs()[quarter::4]]
    assert not _faults(outcomes)
    assert sum(outcome.kind == "answered" for outcome in outcomes) >= 27


@pytest.mark.parametrize("combination", part(2, some_pairs()[::9]), ids=_short)
def test_some_pairs_in_rows_and_fronts(combination: Combination) -> None:
    """A row is the answer to its design alone, and a front is computed or refused by a field."""
    assert sweep_fault(*combination) is None
    assert pareto_fault(*combination) is None


@pytest.mark.parametrize("combination", part(12, [*pairs_with_shafts()][::5]), ids=_short)
def test_some_pairs_with_balance_shafts(combination: Combination) -> None:
    """What stands beside balance shafts is computed by every way in, or refused by a field."""
    assert pareto_fault(*combination) is None
    assert round_fault(*combination) is None


@pytest.mark.parametrize("combination", part(8, [*pairs_with_shafts()][::29]), ids=_short)
def test_some_ladders_with_balance_shafts(combination: Combination) -> None:
    assert accuracy_fault(*combination) is None


@pytest.mark.nightly
@pytest.mark.parametrize("scenarios", ["scenario of masses", "scenario of speed"])
@pytest.mark.parametrize("base", BASES)
def test_all_ladders_with_scenarios(base: str, scenarios: str) -> None:
    faults = [
        f"{_short((base, (scenarios, name)))} | {fault}"
        for name in FEATURES
        for fault in [accuracy_fault(base, (scenarios, name))]
        if fault is not None
    ]
    assert not faults


@pytest.mark.nightly
@pytest.mark.parametrize("goal", ["orders all", "bearing weight", "bearing rms", "bending weight", "roll weight"])
@pytest.mark.parametrize("base", BASES)
def test_all_ladders_over_a_revolution(base: str, goal: str) -> None:
    faults = [
        f"{_short((base, (goal, name)))} | {fault}"
        for name in FEATURES
        for fault in [accuracy_fault(base, (goal, name))]
        if fault is not None
    ]
    assert not faults


@pytest.mark.nightly
@pytest.mark.parametrize("block", range(_BLOCKS))
def test_all_pairs_with_balance_shafts(block: int) -> None:
    faults = [
        f"{_short(pair)} | {fault}"
        for pair in [*pairs_with_shafts()][block::_BLOCKS]
        for fault in (pareto_fault(*pair), round_fault(*pair))
        if fault is not None
    ]
    assert not faults


@pytest.mark.nightly
@pytest.mark.parametrize("block", range(_BLOCKS))
def test_all_pairs(block: int) -> None:
    outcomes = [ask(base, pair) for n, (base, pair) in enumerate(all_pairs()) if n % _BLOCKS == block]
    assert not _faults(outcomes)
    assert not _slow(outcomes)


@pytest.mark.nightly
@pytest.mark.parametrize("block", range(_BLOCKS))
def test_random_triples(block: int) -> None:
    some = [triple for n, triple in enumerate(random_triples(_TRIPLES)) if n % _BLOCKS == block]
    outcomes = [ask(base, triple) for base, triple in some]
    assert not _faults(outcomes)
    assert not _slow(outcomes)


def _slow(outcomes: list[Outcome]) -> list[str]:
    """What takes too long twice: once a kernel may be loaded, or an import made."""
    slow = [outcome for outcome in outcomes if outcome.cpu_s > _MOST_CPU_S]
    again = [ask(outcome.base, outcome.features) for outcome in slow]
    return [f"{outcome.name} took {outcome.cpu_s:.1f} s" for outcome in again if outcome.cpu_s > _MOST_CPU_S]
