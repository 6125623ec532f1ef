"""What owners have had: nobody gathers credit by staying away, and nobody pays for what others did not want."""

import pytest

from service.fairness.accounts import Accounts


class Played:
    """Accounts, and the time that they are told."""

    def __init__(self) -> None:
        self.seconds = 0.0
        self.accounts = Accounts(lambda: self.seconds)

    def have(self, owner: str, seconds: float, turns: int = 1) -> None:
        """An owner who is here has turns for so long."""
        self.accounts.take(owner, turns)
        self.seconds += seconds
        self.accounts.take(owner, -turns)


def test_turns_count_for_as_long_as_they_last() -> None:
    played = Played()
    played.accounts.come("a")
    played.have("a", 2.0, turns=3)
    played.seconds += 100.0
    # analytic
    assert played.accounts.had("a") == 6.0
    played.accounts.take("a", 1)
    played.seconds += 0.5
    assert played.accounts.had("a") == 6.5


def test_who_stays_away_gathers_no_credit() -> None:
    played = Played()
    played.accounts.come("a")
    played.have("a", 3600.0)
    played.accounts.come("b")
    assert played.accounts.had("b") == played.accounts.had("a") == 3600.0


def test_who_has_had_more_than_others_comes_back_with_it() -> None:
    played = Played()
    played.accounts.come("a")
    played.accounts.come("b")
    played.have("a", 10.0)
    played.have("b", 4.0)
    played.accounts.go("a")
    assert "a" not in played.accounts
    played.accounts.come("a")
    assert (played.accounts.had("a"), played.accounts.had("b")) == (10.0, 4.0)


def test_it_is_forgotten_when_the_others_have_had_as_much() -> None:
    played = Played()
    played.accounts.come("a")
    played.accounts.come("b")
    played.have("a", 10.0)
    played.accounts.go("a")
    played.have("b", 15.0)
    played.accounts.come("a")
    assert played.accounts.had("a") == 15.0


def test_nothing_is_held_against_anybody_when_nobody_is_left() -> None:
    played = Played()
    for owner, seconds in (("a", 10.0), ("b", 4.0)):
        played.accounts.come(owner)
        played.have(owner, seconds)
    played.accounts.go("a")
    played.accounts.go("b")
    played.accounts.come("a")
    played.accounts.come("b")
    assert played.accounts.had("a") == played.accounts.had("b")


@pytest.mark.parametrize("owners", [10, 1000])
def test_those_who_left_are_forgotten_in_time(owners: int) -> None:
    played = Played()
    played.accounts.come("a")
    for number in range(owners):
        # a has a turn all the time
        played.accounts.come(str(number))
        played.accounts.take("a", 1)
        played.have(str(number), 0.01)
        played.accounts.take("a", -1)
        played.accounts.go(str(number))
    assert len(played.accounts._left) <= 1
