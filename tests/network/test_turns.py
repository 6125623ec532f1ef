"""Turns: nobody waits behind all that another one asks, and nobody's place is lost."""

from collections import Counter

import anyio
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.network.turns import ABOVE, FairQueue, Queue, play


def test_owners_take_turns() -> None:
    async def story(rung: Queue) -> None:
        for name in ("a1", "b1", "a2", "a3", "a4", "b2", "b3"):
            await rung.ask(name)
        # b1 is above the size, as b has none
        assert rung.begun == ["a1", "b1"]
        await rung.end("a1", "b1", "a2", "b2", "a3", "b3")
        assert rung.begun[2:] == ["a2", "b2", "a3", "b3", "a4"]

    play(FairQueue(1, 10, 10), story)


def test_who_has_nothing_begins_at_once_though_another_one_has_everything() -> None:
    async def story(rung: Queue) -> None:
        for k in range(10):
            await rung.ask(f"a{k}")
        await rung.ask("b0")
        assert rung.begun == ["a0", "a1", "b0"]
        await rung.ask("b1")
        # b has one
        assert rung.begun == ["a0", "a1", "b0"]
        await rung.end("a0", after_s=1.0)
        # a has had twice as much
        assert rung.begun[3:] == ["b1"]
        await rung.end("a1", after_s=1.0)
        assert rung.begun[4:] == ["a2"]

    play(FairQueue(2, 20, 20), story)


def test_who_asks_without_end_gives_way_as_long_as_another_computes() -> None:
    turns = FairQueue(2, 20, 20)

    async def story(_: Queue) -> None:
        busy, later, turn = turns.turn("a"), turns.turn("a"), turns.turn("b")
        turns.ask(busy)
        turns.clock.seconds += 5.0
        busy.end()
        turns.ask(later)
        assert (later.seldom, turns.gives_way(later)) == (False, False)
        turns.ask(turn)
        assert (turn.seldom, turns.gives_way(turn), turns.gives_way(later)) == (True, False, True)
        turn.end()
        assert not turns.gives_way(later)
        later.end()

    play(turns, story)


def test_owners_who_ask_without_end_leave_two_to_who_asks_now_and_then() -> None:
    async def story(rung: Queue) -> None:
        for name in ("a0", "b0", "c0", "a1", "b1", "c1", "a2", "b2", "c2"):
            await rung.ask(name)
        # nobody has had more than c
        assert rung.begun == ["a0", "b0", "c0"]
        await rung.end("c0", after_s=10.0)
        # c has none now, but has had as much as a and b
        assert rung.begun[3:] == []
        for name in ("d0", "e0", "f0"):
            await rung.ask(name)
        assert rung.begun[3:] == ["d0", "e0"]
        await rung.end("d0", after_s=0.1)
        assert rung.begun[5:] == ["f0"]
        await rung.end("a0", after_s=0.1)
        # what a had is none of the two, which e and f have
        assert rung.begun[6:] == ["c1"]
        await rung.end("e0", "f0", after_s=0.1)
        # a has none now, and had none for a moment
        assert rung.begun[7:] == []

    play(FairQueue(2, 20, 20), story)


def test_who_wants_several_in_its_first_moments_has_none_of_those_turns() -> None:
    async def story(rung: Queue) -> None:
        for name in ("a0", "b0", "c0", "d0", "c1", "c2", "d1"):
            await rung.ask(name)
        assert rung.begun == ["a0", "b0", "c0", "d0"]
        await rung.end("c0", "d0", after_s=0.01)
        # c and d are as new, but c wants two
        assert rung.begun[4:] == ["d1"]
        await rung.ask("e0")
        assert rung.begun[5:] == ["e0"]

    play(FairQueue(2, 20, 20), story)


def test_who_has_had_least_is_next() -> None:
    async def story(rung: Queue) -> None:
        for name in ("a0", "b0", "a1", "a2", "b1", "b2"):
            await rung.ask(name)
        await rung.end("a0", after_s=0.2)
        await rung.end("b0", after_s=0.4)
        assert rung.begun == ["a0", "b0", "a1"]
        await rung.end("a1", after_s=0.5)
        # a has had 0.7 s, b 0.5 s with its next one: it is before a, though it began last
        await rung.end("b1", after_s=0.1)
        assert rung.begun[3:] == ["b1", "b2"]
        await rung.end("b2", after_s=0.1)
        assert rung.begun[5:] == ["a2"]

    play(FairQueue(1, 10, 10, above=0), story)


def test_nobody_waits_for_ever_however_many_come() -> None:
    async def story(rung: Queue) -> None:
        for name in ("a0", "b0", "c0", "a1"):
            await rung.ask(name)
        # somebody who has had nothing comes before every end
        for ends, comes in zip("bacde", "defgh", strict=True):
            await rung.ask(f"{comes}0")
            await rung.end(f"{ends}0", after_s=0.5)
        # after two seconds without any a is before h
        assert rung.begun == ["a0", "b0", "c0", "d0", "e0", "f0", "g0", "a1"]

    play(FairQueue(1, 20, 20), story)


def test_a_place_that_was_given_up_leaves_nothing_behind() -> None:
    async def story(rung: Queue) -> None:
        for name in ("a0", "a1", "a2", "b0", "b1", "c0", "c1"):
            await rung.ask(name)
        for name in ("a0", "b0", "c0", "a1", "b1", "c1"):
            if name in rung.begun:
                await rung.end(name, after_s=1.0)

    turns = FairQueue(1, 2, 2)
    play(turns, story)
    assert not [owner for owner in "abc" if owner in turns._accounts]


def test_an_owner_has_its_share_of_the_places_and_gives_up_the_last_to_others() -> None:
    async def story(rung: Queue) -> None:
        for k in range(6):
            await rung.ask(f"a{k}")
        assert rung.refused == ["a5"]
        for name in ("b0", "b1", "c0", "c1", "c2"):
            await rung.ask(name)
        # b0 and c0 begin, as b and c have none; b1 and c1 take the places that a has last; c2 would be as many as a has
        assert rung.refused == ["a5", "a4", "a3", "c2"]

    play(FairQueue(1, 4, 4), story)


def test_none_above_the_size_where_there_are_none() -> None:
    async def story(rung: Queue) -> None:
        for name in ("a0", "b0", "b1", "c0"):
            await rung.ask(name)
        assert rung.begun == ["a0"]
        await rung.end("a0", "b0", after_s=1.0)
        assert rung.begun[1:] == ["b0", "c0"]

    play(FairQueue(1, 4, 4, above=0), story)


async def _step_by_step(turns: FairQueue) -> None:
    first, second = turns.turn("a"), turns.turn("b")
    await first.granted()
    assert not turns.crowded.is_set()
    with anyio.move_on_after(0.01):
        await second.granted()
    # who has stopped waiting keeps the place, and waits for it again
    assert (turns.waiting, turns.crowded.is_set()) == (1, True)
    first.end()
    await second.granted()
    # what has ended ends once
    first.end()
    assert (second.begun, turns.waiting, turns.crowded.is_set()) == (True, 0, False)
    second.end()
    turns.turn("c").end()
    async with turns.turn("d"):
        pass


def test_a_turn_is_had_step_by_step() -> None:
    anyio.run(_step_by_step, FairQueue(1, 4, 4, above=0))


def test_nobody_waits_where_nobody_may() -> None:
    async def story(rung: Queue) -> None:
        await rung.ask("a0")
        await rung.ask("a1")
        assert rung.refused == ["a1"]

    play(FairQueue(1, 0, 0), story)


async def _leave(turns: FairQueue) -> None:
    async with turns.turn("a"):
        with anyio.move_on_after(0.01):
            async with turns.turn("a"):
                pytest.fail("there is one turn")
        assert turns.waiting == 0
    async with turns.turn("a"):
        pass


def test_who_goes_away_leaves_no_place_taken() -> None:
    anyio.run(_leave, FairQueue(1, 4, 4))


@given(st.lists(st.tuples(st.sampled_from("abc"), st.booleans()), max_size=40), st.integers(1, 3))
def test_everybody_is_served_or_refused_and_never_more_than_there_are(steps: list[tuple[str, bool]], size: int) -> None:
    turns = FairQueue(size, 6, 4)

    async def story(rung: Queue) -> None:
        open_turns: list[str] = []
        for index, (owner, end) in enumerate(steps):
            await rung.ask(f"{owner}{index}")
            open_turns = [name for name in rung.begun if not rung._ends[name].is_set()]
            assert len(open_turns) <= size + ABOVE
            assert turns.waiting <= 6
            if end and open_turns:
                await rung.end(open_turns[0])
        while left := [name for name in rung.begun if not rung._ends[name].is_set()]:
            await rung.end(left[0])
        assert Counter([*rung.begun, *rung.refused]) == Counter(f"{o}{k}" for k, (o, _) in enumerate(steps))

    play(turns, story)
