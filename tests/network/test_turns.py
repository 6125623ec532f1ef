"""Turns: nobody waits behind all that another one asks, and nobody's place is lost."""

from collections import Counter

import anyio
import pytest
from hypothesis import given
from hypothesis import strategies as st

from service.workers.turns import Full, Turns


class Asked:
    """Turns that are asked for in order, each ended by hand."""

    def __init__(self, turns: Turns, group: anyio.abc.TaskGroup) -> None:
        self.turns = turns
        self.begun: list[str] = []
        self.refused: list[str] = []
        self._group = group
        self._ends: dict[str, anyio.Event] = {}

    async def ask(self, name: str, long: bool = False) -> None:
        """Ask for a turn of the owner that the first letter of a name names."""
        self._ends[name] = anyio.Event()

        async def have() -> None:
            try:
                async with self.turns.turn(name[0], long):
                    self.begun.append(name)
                    await self._ends[name].wait()
            except Full:
                self.refused.append(name)

        self._group.start_soon(have)
        await anyio.wait_all_tasks_blocked()

    async def end(self, *names: str) -> None:
        for name in names:
            self._ends[name].set()
            await anyio.wait_all_tasks_blocked()


def play(turns: Turns, story: object) -> Asked:
    found: list[Asked] = []

    async def tell() -> None:
        async with anyio.create_task_group() as group:
            found.append(Asked(turns, group))
            await story(found[0])  # type: ignore[operator]
            group.cancel_scope.cancel()

    anyio.run(tell)
    assert turns.waiting == 0
    return found[0]


def test_owners_take_turns() -> None:
    async def story(asked: Asked) -> None:
        for name in ("a1", "b1", "a2", "a3", "a4", "b2", "b3"):
            await asked.ask(name)
        # b1 has the one more that is for an owner who has none
        assert asked.begun == ["a1", "b1"]
        await asked.end("a1", "b1", "a2", "b2", "a3", "b3")
        assert asked.begun[2:] == ["a2", "b2", "a3", "b3", "a4"]

    play(Turns(1, 10, 10), story)


def test_who_has_nothing_begins_at_once_though_another_one_has_everything() -> None:
    async def story(asked: Asked) -> None:
        for k in range(10):
            await asked.ask(f"a{k}")
        await asked.ask("b0")
        assert asked.begun == ["a0", "a1", "b0"]
        await asked.ask("b1")
        await asked.end("a0")
        # as many as there are to be, and one owner of each
        assert asked.begun == ["a0", "a1", "b0"]
        await asked.end("a1")
        assert asked.begun[3:] == ["a2"]

    play(Turns(2, 20, 20), story)


def test_an_owner_has_its_share_of_the_places_and_gives_up_the_last_to_others() -> None:
    async def story(asked: Asked) -> None:
        for k in range(6):
            await asked.ask(f"a{k}")
        assert asked.refused == ["a5"]
        for name in ("b0", "b1", "c0", "c1"):
            await asked.ask(name)
        # b0 begins, as b has none; b1 and c0 take the places that a has last; then c1 would have as many as a
        assert asked.refused == ["a5", "a4", "a3", "c1"]

    play(Turns(1, 4, 4), story)


def test_long_ones_leave_a_turn_to_the_others_of_their_owner() -> None:
    async def story(asked: Asked) -> None:
        await asked.ask("a0", long=True)
        await asked.ask("a1", long=True)
        await asked.ask("a2")
        assert asked.begun == ["a0", "a2"]
        await asked.end("a0")
        assert asked.begun[2:] == ["a1"]

    play(Turns(2, 4, 4), story)


def test_nobody_waits_where_nobody_may() -> None:
    async def story(asked: Asked) -> None:
        await asked.ask("a0")
        await asked.ask("a1")
        assert asked.refused == ["a1"]

    play(Turns(1, 0, 0), story)


async def _leave(turns: Turns) -> None:
    async with turns.turn("a", False):
        with anyio.move_on_after(0.01):
            async with turns.turn("a", False):
                pytest.fail("there is one turn")
        assert turns.waiting == 0
    async with turns.turn("a", False):
        pass


def test_who_goes_away_leaves_no_place_taken() -> None:
    anyio.run(_leave, Turns(1, 4, 4))


@given(st.lists(st.tuples(st.sampled_from("abc"), st.booleans(), st.booleans()), max_size=40), st.integers(1, 3))
def test_everybody_is_served_or_refused_and_never_more_than_there_are(
    steps: list[tuple[str, bool, bool]], size: int
) -> None:
    turns = Turns(size, 6, 4)

    async def story(asked: Asked) -> None:
        open_turns: list[str] = []
        for index, (owner, long, end) in enumerate(steps):
            await asked.ask(f"{owner}{index}", long)
            open_turns = [name for name in asked.begun if not asked._ends[name].is_set()]
            assert len(open_turns) <= size + 1
            assert turns.waiting <= 6
            if end and open_turns:
                await asked.end(open_turns[0])
        while left := [name for name in asked.begun if not asked._ends[name].is_set()]:
            await asked.end(left[0])
        assert Counter([*asked.begun, *asked.refused]) == Counter(f"{o}{k}" for k, (o, _, _) in enumerate(steps))

    play(turns, story)
