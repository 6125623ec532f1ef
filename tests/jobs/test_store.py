"""The store on SQLite and on a real PostgreSQL: every expected value is analytic."""

import sys
from concurrent.futures import ThreadPoolExecutor

import pytest

from service.jobs.database import Database
from service.jobs.fingerprints import fingerprint
from service.jobs.job import Chunk, Computed, Order
from service.jobs.leases import Leases
from service.jobs.retention import Retention
from service.jobs.rows import Limits, UnknownJob
from service.jobs.store import KeyReused, Store, TooManyJobs
from tests.jobs.house import House

LEASE_S = 60.0


def claim_all(leases: Leases, owner: str = "a") -> list[Chunk]:
    return list(iter(lambda: leases.claim(owner, LEASE_S), None))


def spans(store: Store, job: str) -> list[tuple[int, int]]:
    return [(piece.start, piece.stop) for piece in store.pieces(job)]


def test_every_row_is_given_out_once_and_counted_once(any_house: House) -> None:
    store, leases, job = any_house.store, any_house.leases, any_house.submit(total=95, chunk_rows=10)
    assert store.get(job).state == "queued"
    chunks = claim_all(leases)
    assert [(chunk.start, chunk.stop) for chunk in chunks] == [(s, min(s + 10, 95)) for s in range(0, 95, 10)]
    assert store.get(job).state == "running"
    for chunk in chunks:
        leases.finish([Computed(chunk, 1, "d", 9)])
        leases.finish([Computed(chunk, 1, "d", 9)])
    record = store.get(job)
    assert (record.state, record.done, record.failed, record.total) == ("done", 95, 10, 95)
    assert spans(store, job) == [(chunk.start, chunk.stop) for chunk in chunks]
    assert leases.claim("a", LEASE_S) is None


def test_many_claim_at_once(any_house: House) -> None:
    store, leases, job = any_house.store, any_house.leases, any_house.submit(total=200, chunk_rows=5)

    def work(owner: str) -> list[Chunk]:
        mine = claim_all(leases, owner)
        for chunk in mine:
            leases.finish([Computed(chunk, 0, "d", 9)])
        return mine

    with ThreadPoolExecutor(4) as threads:
        claimed = [chunk.start for chunks in threads.map(work, "abcd") for chunk in chunks]
    assert sorted(claimed) == list(range(0, 200, 5))
    assert (store.get(job).state, store.get(job).done) == ("done", 200)


def test_a_lease_that_is_not_renewed_is_free_again(any_house: House) -> None:
    now = 1000.0
    leases = Leases(any_house.database, clock=lambda: now)
    any_house.submit(total=1, chunk_rows=1)
    mine = leases.claim("a", LEASE_S)
    assert mine is not None
    now += LEASE_S - 1
    assert leases.claim("b", LEASE_S) is None
    leases.renew("a", [mine], LEASE_S)
    now += LEASE_S - 1
    assert leases.claim("b", LEASE_S) is None
    now += 2
    theirs = leases.claim("b", LEASE_S)
    assert theirs == mine
    # both finish: it counts once
    leases.finish([Computed(theirs, 0, "d", 9)])
    leases.finish([Computed(mine, 0, "d", 9)])
    assert any_house.store.get(mine.job).done == 1


def test_nobody_keeps_the_lease_of_another(any_house: House) -> None:
    now = 1000.0
    leases = Leases(any_house.database, clock=lambda: now)
    any_house.submit(total=1, chunk_rows=1)
    chunk = leases.claim("a", LEASE_S)
    assert chunk is not None
    now += LEASE_S - 1
    # one that has been cut off still believes in its lease, or a liar names the chunk
    leases.renew("b", [chunk], LEASE_S)
    now += 2
    assert leases.claim("c", LEASE_S) == chunk
    # what was given to c is not a's any more
    leases.renew("a", [chunk], 10 * LEASE_S)
    now += LEASE_S + 1
    assert leases.claim("d", LEASE_S) == chunk


def test_what_is_released_is_free_at_once(any_house: House) -> None:
    any_house.submit(total=3, chunk_rows=1)
    assert len(claim_all(any_house.leases, "a")) == 3
    any_house.leases.release("b")
    assert claim_all(any_house.leases, "b") == []
    any_house.leases.release("a")
    assert len(claim_all(any_house.leases, "b")) == 3


def test_a_small_job_does_not_wait_for_a_large_one(any_house: House) -> None:
    large, small = any_house.submit(total=100), any_house.submit(total=20)
    first = [any_house.leases.claim("a", LEASE_S) for _ in range(4)]
    assert [chunk.job for chunk in first if chunk] == [large, small, large, small]


def test_many_chunks_of_one_job_in_one_transaction(any_house: House) -> None:
    store, leases, job = any_house.store, any_house.leases, any_house.submit(total=95, chunk_rows=10)
    some, rest = leases.claim_chunks("a", LEASE_S, 4), leases.claim_chunks("a", LEASE_S, 20)
    assert [chunk.start for chunk in (*some, *rest)] == list(range(0, 95, 10))
    assert leases.claim_chunks("a", LEASE_S, 4) == []
    before = store.get(job).version
    assert leases.finish([Computed(chunk, 1, "d", 9, 2, 1) for chunk in some]) == [True] * 4
    record = store.get(job)
    assert (record.done, record.failed, record.invalid, record.infeasible, record.version) == (40, 4, 8, 4, before + 1)
    assert leases.finish([Computed(chunk, 1, "d", 9) for chunk in (some[1], *rest, some[3])]) == [
        False,
        *[True] * 6,
        False,
    ]
    state = store.get(job)
    assert (state.state, state.done, state.failed) == ("done", 95, 10)
    assert leases.finish([]) == []


def test_many_chunks_at_a_time_go_to_one_job_after_the_other(any_house: House) -> None:
    large, small = any_house.submit(total=200), any_house.submit(total=60)
    turns = [any_house.leases.claim_chunks("a", LEASE_S, 3) for _ in range(4)]
    assert [{chunk.job for chunk in turn} for turn in turns] == [{large}, {small}, {large}, {small}]
    assert [len(turn) for turn in turns] == [3, 3, 3, 3]


def test_the_same_key(any_house: House) -> None:
    store = any_house.store

    def submit(body: str, key: str | None, owner: str | None = None) -> tuple[str, bool]:
        job, new = store.submit(Order("k", b"{}", fingerprint("k", body.encode()), owner=owner, key=key))
        return job.id, new

    first, new = submit('{"a": 1, "b": 2}', "x")
    assert new
    assert submit('{"b":2e0,"a":1.0}', "x") == (first, False)
    with pytest.raises(KeyReused):
        submit('{"a": 2}', "x")
    # of another owner it is another key, and no key is never the same
    futures = [submit('{"a": 2}', "x", "somebody"), submit('{"a": 1}', None), submit('{"a": 1}', None)]
    assert all(new for _, new in futures)
    with ThreadPoolExecutor(4) as threads:
        together = list(threads.map(lambda _: submit('{"c": 1}', "y"), range(8)))
    assert len({job for job, _ in together}) == 1
    assert [new for _, new in together].count(True) == 1


def test_a_cancelled_job_keeps_its_rows_and_goes_on_where_it_ended(any_house: House) -> None:
    store, leases, job = any_house.store, any_house.leases, any_house.submit(total=30, chunk_rows=10)
    first, second = leases.claim("a", LEASE_S), leases.claim("a", LEASE_S)
    assert first is not None
    assert second is not None
    leases.finish([Computed(first, 0, "d", 9)])
    assert store.cancel(job).state == "cancelled"
    leases.finish([Computed(second, 0, "d", 9)])
    assert (store.get(job).done, spans(store, job)) == (10, [(0, 10)])
    assert leases.claim("a", LEASE_S) is None
    assert store.cancel(job).state == "cancelled"
    assert store.resume(job).state == "queued"
    assert [chunk.start for chunk in claim_all(leases)] == [10, 20]


def test_failure_and_its_reason(any_house: House) -> None:
    store, job = any_house.store, any_house.submit()
    version = store.get(job).version
    store.fail(job, "the disk is full")
    store.fail(job, "later")
    record = store.get(job)
    assert (record.state, record.error, record.version) == ("failed", "the disk is full", version + 1)


def test_halves_of_a_chunk(any_house: House) -> None:
    store, leases, job = any_house.store, any_house.leases, any_house.submit(total=5, chunk_rows=5)
    whole = leases.claim("a", LEASE_S)
    assert whole is not None
    assert [leases.halve(whole), leases.halve(whole)] == [1, 1]
    assert leases.claim("a", LEASE_S) is None
    halves = list(iter(lambda: leases.claim("a", LEASE_S, attempted=True), None))
    assert [(half.start, half.stop) for half in halves] == [(0, 2), (2, 5)]
    for half in halves:
        leases.finish([Computed(half, 0, "d", 9)])
    assert store.get(job).state == "done"


def test_results_expire(any_house: House) -> None:
    now = 1000.0
    store = Store(any_house.database, Limits(keep_s=100))
    retention = Retention(any_house.database, clock=lambda: now)
    retention.mark_expired()
    future, gone = any_house.submit(), any_house.submit()
    store.cancel(gone)
    now += 99
    retention.mark_expired()
    assert retention.removed() == []
    now += 2
    retention.mark_expired()
    assert retention.removed() == [gone]
    with pytest.raises(UnknownJob):
        store.get(gone)
    retention.forget(gone)
    retention.forget(future)
    assert retention.removed() == []
    assert store.get(future).active


def test_pages_newest_first(any_house: House) -> None:
    # a clock may stand, or go back
    clock = iter(range(5))
    store = Store(any_house.database, clock=lambda: float(next(clock)))
    jobs = [store.submit(Order("synthetic", b"{}", "d"))[0].id for _ in range(5)]
    first = any_house.store.page(["synthetic"], 3)
    rest = any_house.store.page(["synthetic"], 3, before=first[-1].id)
    assert [job.id for job in first + rest] == jobs[::-1]
    assert any_house.store.page(["sweep"], 3) == []


def test_too_many_jobs(any_house: House) -> None:
    store = Store(any_house.database, Limits(active=3, active_per_owner=2))
    for _ in range(2):
        store.submit(Order("k", b"{}", "d", owner="one"))
    with pytest.raises(TooManyJobs):
        store.submit(Order("k", b"{}", "d", owner="one"))
    # there is room for others still, and then there is not
    store.submit(Order("k", b"{}", "d"))
    with pytest.raises(TooManyJobs):
        store.submit(Order("k", b"{}", "d", owner="two"))


@pytest.mark.parametrize("id", ["", "../../etc/passwd", "x" * 10_000, "%2e%2e", "a\x00b", "é"])
def test_ids_that_there_are_not(any_house: House, id: str) -> None:  # noqa: A002
    any_house.submit()
    with pytest.raises(UnknownJob):
        any_house.store.get(id)


def test_what_postgresql_needs_is_named_where_it_is_not_installed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "psycopg", None)
    with pytest.raises(ValueError, match=r"pip install '\.\[postgres\]'"):
        Database("postgresql://host/name")


@pytest.mark.parametrize("url", ["nonsense", "nosuch://host/name", ""])
def test_connection_strings_that_are_none(url: str) -> None:
    with pytest.raises(ValueError, match="not a database"):
        Database(url)


def test_chunks_of_a_service_that_is_gone_are_given_out_first(any_house: House) -> None:
    seconds = [1000.0]
    leases = Leases(any_house.database, clock=lambda: seconds[0])
    any_house.submit(total=40, chunk_rows=10)
    had = leases.claim("gone", 15.0)
    assert had is not None
    seconds[0] += 10.0
    fresh = leases.claim("other", 15.0)
    assert fresh is not None
    assert fresh.start == 10
    seconds[0] += 10.0
    again = leases.claim("other", 15.0)
    # before, when nothing fresh was left: at the end of the sweep
    assert again == had
