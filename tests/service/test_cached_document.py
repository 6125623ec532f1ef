"""Documents that are made when somebody first asks for them."""

import asyncio
import threading
from types import SimpleNamespace
from typing import Any

import pytest

from service.fairness.threads import Threads
from service.http.cached_document import CachedDocument, Shelf

_LONG = b"a document " * 1000


def _request() -> Any:
    app = SimpleNamespace(state=SimpleNamespace(threads=Threads()))
    return SimpleNamespace(app=app, scope={"state": {"holding": SimpleNamespace(who="a client")}})


def test_it_is_made_once_however_many_ask_and_the_loop_goes_on() -> None:
    go = threading.Event()
    values: list[tuple[str, bool]] = []

    def make(name: str) -> CachedDocument:
        values.append((name, threading.current_thread() is threading.main_thread()))
        assert go.wait(60)
        return CachedDocument(_LONG, "text/plain")

    shelf, request = Shelf(make), _request()

    async def story() -> list[CachedDocument]:
        waiting = [asyncio.ensure_future(shelf.take(request, "it")) for _ in range(5)]
        while not values:
            await asyncio.sleep(0.001)
        go.set()
        return [*await asyncio.gather(*waiting), await shelf.take(request, "it")]

    first, *documents = asyncio.run(story())
    assert values == [("it", False)]
    assert all(document is first for document in documents)


@pytest.mark.parametrize(("content", "packed"), [(_LONG, True), (b"short", False)])
def test_it_is_compressed_before_it_is_sent(content: bytes, packed: bool) -> None:
    document = Shelf[str](lambda _: CachedDocument(content, "text/plain")).document("it")
    assert ("compressed" in vars(document)) == packed


def test_what_could_not_be_made_is_tried_again() -> None:
    outcomes: list[Any] = [OSError("no disk"), CachedDocument(_LONG, "text/plain")]

    def make(name: str) -> CachedDocument:
        outcome = outcomes.pop(0)
        if isinstance(outcome, Exception):
            raise outcome
        return outcome  # type: ignore[no-any-return]

    shelf = Shelf(make)
    with pytest.raises(OSError, match="no disk"):
        shelf.document("it")
    assert shelf.document("it").content == _LONG
