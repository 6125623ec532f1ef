"""Rounds: whose bytes are looked at next."""

from collections import deque
from collections.abc import Callable

from hypothesis import given
from hypothesis import strategies as st

from service.http.rounds import Rounds


class Loop:
    """Turns of an event loop, one after the other."""

    def __init__(self) -> None:
        self.soon: deque[Callable[[], None]] = deque()

    def turn(self) -> None:
        for _ in range(len(self.soon)):
            self.soon.popleft()()


def test_what_is_alone_is_done_at_once_and_one_piece_in_a_turn() -> None:
    loop, done = Loop(), list[int]()
    rounds = Rounds(loop.soon.append)
    assert rounds.ask("a", lambda: done.append(1))
    assert not rounds.ask("a", lambda: done.append(2))
    assert done == [1]
    loop.turn()
    assert done == [1, 2]
    loop.turn()
    assert rounds.ask("a", lambda: done.append(3))


def test_one_of_many_connections_delays_nobody() -> None:
    loop, done = Loop(), list[str]()
    rounds = Rounds(loop.soon.append)
    for k in range(300):
        rounds.ask("many", lambda k=k: done.append(f"many {k}"))  # type: ignore[misc]
    rounds.ask("few", lambda: done.append("few"))
    for _ in range(2):
        loop.turn()
    assert done == ["many 0", "many 1", "few"]


@given(st.lists(st.sampled_from("abc"), max_size=30), st.lists(st.integers(0, 3), max_size=30))
def test_all_is_done_once_and_in_the_order_of_its_client(clients: list[str], turns: list[int]) -> None:
    loop, done = Loop(), list[tuple[str, int]]()
    rounds = Rounds(loop.soon.append)
    for number, client in enumerate(clients):
        rounds.ask(client, lambda client=client, number=number: done.append((client, number)))  # type: ignore[misc]
        for _ in range(turns[number] if number < len(turns) else 0):
            loop.turn()
    for _ in range(len(clients) + 1):
        loop.turn()
    for client in "abc":
        asked = [(each, number) for number, each in enumerate(clients) if each == client]
        assert [one for one in done if one[0] == client] == asked
    assert not loop.soon
