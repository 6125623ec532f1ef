"""What in a history of calls cannot be, whatever happened between them.

Calls overlap, and one that was not answered may have had its effect or not, then or later. So one answer contradicts
another only if its call began after that of the other had ended, and no call in between may explain it.
"""

from collections.abc import Iterator, Mapping, Sequence
from itertools import groupby

from tests.jobs.calls import Call

#: by name of a service, or "database": when it was not there, from and until
Outages = Mapping[str, Sequence[tuple[float, float]]]

_EXPECTED = {"submit": {202}, "resume": {202}, "end": {200, 204}}
_RANK = {"queued": 0, "running": 1, "done": 2, "cancelled": 2}


def contradictions(calls: Sequence[Call], outages: Outages) -> list[str]:
    """What is wrong, a line for each; none if all is well."""
    ordered = sorted(calls, key=lambda call: call.began)
    accepted = [call for call in ordered if call.action == "submit" and call.document is not None]
    about: dict[str, list[Call]] = {}
    for call in ordered:
        for job in call.ids if call.action == "submit" else {call.subject} - {""}:
            if call.action != "submit" or call.document is not None:
                about.setdefault(job, []).append(call)
    texts = [*_answers(ordered, outages), *_keys(accepted), *_lists(ordered, accepted, about)]
    for job, its in about.items():
        texts += [f"{job}: {fault}" for check in (_existence, _states, _rows) for fault in check(its)]
    return texts


# ---- single answers


def _answers(calls: Sequence[Call], outages: Outages) -> Iterator[str]:
    for call in calls:
        deed = f"{call.action} {call.subject}"
        if call.wrong:
            yield f"{deed}: {call.wrong}"
        if call.status is None:
            explained = call.cut or _away(call, outages.get(call.service, ())) or _cut_by_removal(call, calls)
            if not explained:
                yield f"{deed}: not answered by a service that lived"
        elif call.status >= 500:
            if call.status != 503 or not _away(call, outages.get("database", ())):
                yield f"{deed}: {call.status} while the database was there"
        elif call.status != 404 and call.status not in _EXPECTED.get(call.action, {200}):
            yield f"{deed}: {call.status}"


def _away(call: Call, times: Sequence[tuple[float, float]]) -> bool:
    return any(call.began <= until and since <= call.ended for since, until in times)


def _cut_by_removal(call: Call, calls: Sequence[Call]) -> bool:
    """Whether rows were removed while they were read."""
    return call.action in ("rows", "kept") and any(
        deletion.action == "end" and deletion.subject == call.subject and deletion.began <= call.ended
        for deletion in calls
    )


# ---- who is there


def _keys(accepted: Sequence[Call]) -> Iterator[str]:
    """A key is one sweep, and a sweep has one key."""
    pairs = {(call.subject, job) for call in accepted for job in call.ids}
    for part, subject in ((0, "key"), (1, "sweep")):
        for name, group in groupby(sorted(pairs, key=lambda pair: pair[part]), key=lambda pair: pair[part]):
            if len(list(group)) > 1:
                yield f"{subject} {name}: not one to one"


def _existence(calls: Sequence[Call]) -> Iterator[str]:
    """There is a sweep from when it was accepted until it is deleted, and never again."""
    ends = [call for call in calls if call.action == "end"]
    gone = min((call.ended for call in calls if call.status in (204, 404)), default=float("inf"))
    for call in calls:
        if call.status == 404 and not any(end is not call and end.began <= call.ended for end in ends):
            yield "lost"
        if call.status in (200, 202) and call.began > gone:
            yield f"back after it was deleted ({call.action})"


def _lists(calls: Sequence[Call], accepted: Sequence[Call], about: Mapping[str, Sequence[Call]]) -> Iterator[str]:
    since = {job: call.ended for call in reversed(accepted) for job in call.ids}
    until, gone = {}, {}
    for job, its in about.items():
        until[job] = min((call.began for call in its if call.action == "end"), default=float("inf"))
        gone[job] = min((call.ended for call in its if call.status in (204, 404)), default=float("inf"))
    for call in calls:
        if call.action == "list" and call.status == 200:
            yield from (f"{job}: listed, and nobody's" for job in call.ids - since.keys())
            for job in since:
                if since[job] < call.began and call.ended < until[job] and job not in call.ids:
                    yield f"{job}: not in the list"
                if gone[job] < call.began and job in call.ids:
                    yield f"{job}: in the list after it was deleted"


# ---- what becomes of one


def _states(calls: Sequence[Call]) -> Iterator[str]:
    """Queued, running, then done or cancelled; nothing but a request to resume leads back."""
    values = [(call, call.document["state"]) for call in calls if call.document is not None]
    resumes = [call for call in calls if call.action == "resume"]
    for call, state in values:
        if state == "cancelled" and not any(end.action == "end" and end.began <= call.ended for end in calls):
            yield "cancelled by nobody"
        for before, earlier in values:
            if before.ended >= call.began or (_RANK[state] >= _RANK[earlier] and not _turned(earlier, state)):
                continue
            if earlier == "done" or not any(
                resume.began <= call.ended and (resume.status is None or resume.ended >= before.began)
                for resume in resumes
            ):
                yield f"{earlier}, then {state}"


def _turned(earlier: str, state: str) -> bool:
    """Whether it ended once more in another way."""
    return _RANK[earlier] == 2 and state != earlier


def _rows(calls: Sequence[Call]) -> Iterator[str]:
    """Rows that were there are there."""
    reads = [call for call in calls if call.action == "rows" and call.status == 200 and call.whole]
    counts = [(call, len(call.rows)) for call in reads]
    counts += [(call, call.document["done"]) for call in calls if call.document is not None]
    for call, count in counts:
        most = max((count for before, count in counts if before.ended < call.began), default=0)
        if most > count:
            yield f"{most} rows, then {count}"
    for call in reads:
        for before in reads:
            if before.ended < call.began and not before.rows <= call.rows:
                yield f"{len(before.rows - call.rows)} rows are gone"
