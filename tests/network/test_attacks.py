"""Hand-written attacks in short; ``python -m tests.network.attacks`` is the whole of them."""

import asyncio

import pytest

from tests.network.attacks import CEILING_MB, by_chance, run
from tests.network.hostile import ATTACKS, Attack
from tests.network.serving import Service
from tests.night import ALL

#: every so many requests of the attacks that have thousands
_EVERY = {
    "no numbers": 101,
    "lone surrogates": 101,
    "lone surrogates, half-typed": 37,
    "wrong types": 137 if ALL else 211,
    "nesting": 1 if ALL else 5,
    # of the three bodies at each route one, at the next the next; of all the first and the last, or the second
    "duplicate keys": 2 if ALL else 4,
    "pointers into nowhere": 5,
    "paths astray": 7,
}


@pytest.mark.parametrize("attack", ATTACKS, ids=lambda attack: attack.name)
def test_nothing_that_means_ill_does_harm(target: Service, attack: Attack) -> None:
    outcome = asyncio.run(run(target, attack, every=_EVERY.get(attack.name, 1)))
    assert outcome.wrong == []
    assert outcome.statuses.total() >= 9
    own, worker = outcome.memory_mb
    assert own < CEILING_MB[0]
    assert worker < CEILING_MB[1]


def test_nothing_by_chance_does_harm(target: Service) -> None:
    outcome = asyncio.run(by_chance(target, 120, seed=0))
    assert outcome.wrong == []
    assert outcome.statuses.total() >= 120
    # few are so wrong that the connection ends without an answer
    assert outcome.statuses[0] < 30


def test_the_service_says_nothing_of_faults_and_still_computes(target: Service) -> None:
    assert asyncio.run(target.ask("GET", "/readyz")).status == 200
    assert target.faults() == []
