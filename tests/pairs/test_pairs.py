"""Any two features of a request go together or are refused by a field: property, of every pair.

A legal request is answered: without an exception, with a bound that is not above the value, a status that is honest,
counterweights within their limits, figures that agree, and no claim that the independent checker proves to be wrong.
"""

import pytest

from tests.night import ALL, but, part
from tests.pairs.asking import Outcome, ask
from tests.pairs.combinations import (
    PINS,
    Combination,
    all_pairs,
    features_of,
    pairs_of_pins,
    pairs_of_scrolls,
    pairs_with_shafts,
    random_triples,
    some_pairs,
)
from tests.pairs.features import FEATURES
from tests.pairs.forms import form_fault
from tests.pairs.machines import BASES
from tests.pairs.ways import accuracy_fault, pareto_fault, round_fault, sweep_fault

#: CPU seconds of a warm answer, the time limit of its search being a sixth of it
_MOST_CPU_S = 3.0
_TRIPLES = 2_000
_BLOCKS = 12
#: whose rows once did not refuse what an answer refuses
_IN_ROWS = ("scroll", ("plates, segments", "fitted"))


def _faults(outcomes: list[Outcome]) -> list[str]:
    return [f"{outcome.name} | {outcome.message}" for outcome in outcomes if outcome.kind == "fault"]


def _short(combination: Combination) -> str:
    base, features = combination
    return f"{base}: {' + '.join(features)}"


@pytest.mark.parametrize("base", but(("twin", "scroll", PINS) if ALL else ("scroll", PINS), [*BASES, PINS]))
def test_every_feature_is_legal_somewhere(base: str) -> None:
    names = features_of(base)
    outcomes = [ask(base, [name]) for name in names]
    assert not _faults(outcomes)
    answered = {outcome.features[0] for outcome in outcomes if outcome.kind == "answered"}
    alone = {
        "twin": {"roll weight", "bearings without sizes", "outputs of gas"},
        "vee": {"roll weight", "bearings without sizes", "outputs of gas"},
    }
    if base in alone:
        assert set(names) - answered == alone[base]
    else:
        assert set(names) - answered - set(FEATURES) == {"torque and gas force"}
        assert len(answered) > len(names) // 2


@pytest.mark.parametrize("quarter", but((0, 2) if ALL else (0,), range(4)))
def test_some_pairs(quarter: int) -> None:
    outcomes = [ask(base, pair) for base, pair in some_pairs()[quarter::4]]
    assert not _faults(outcomes)
    assert sum(outcome.kind == "answered" for outcome in outcomes) >= 27


@pytest.mark.parametrize("combination", part(24, [_IN_ROWS, *[*pairs_of_scrolls()][::61]]), ids=_short)
def test_some_scrolls_by_every_way(combination: Combination) -> None:
    assert sweep_fault(*combination) is None
    assert pareto_fault(*combination) is None
    assert round_fault(*combination) is None


@pytest.mark.parametrize("combination", part(30, [*[*pairs_of_scrolls()][::61], *[*pairs_of_pins()][::5]]), ids=_short)
def test_some_scrolls_in_every_form(combination: Combination) -> None:
    """Terminal, documents, tables, pictures, drawings and workbooks are written, or refused by a field."""
    assert form_fault(*combination) is None


@pytest.mark.parametrize("combination", part(2, [pair for pair in some_pairs() if pair[0] != PINS][::9]), ids=_short)
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
@pytest.mark.parametrize(
    "goal", ["orders all", "bearing weight", "bearing rms", "bending weight", "roll weight", "priorities"]
)
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
def test_all_scrolls(block: int) -> None:
    """Every pair in a row, a front and on steps; the loads of pins by themselves; and a third of them in every form."""
    scrolls = [*pairs_of_scrolls()][block::_BLOCKS]
    outcomes = [ask(*pair) for pair in [*pairs_of_pins()][block::_BLOCKS]]
    faults = [
        f"{_short(pair)} | {fault}"
        for way in (sweep_fault, pareto_fault, round_fault)
        for pair in scrolls
        for fault in [way(*pair)]
        if fault is not None
    ]
    forms = [form_fault(*pair) for pair in scrolls[::3]]
    assert not _faults(outcomes)
    assert not faults
    assert not any(forms), [fault for fault in forms if fault]


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
