"""What a worker says goes over its socket in plain values, and is the same at the other end."""

import pickle

import pytest

from optimizer.errors import NotComputable
from service.workers.worker import Answer, Certified, Long, Outcome, Refused, Reply

_PROOF = Certified("interior point", 0.001, 1e-9)


def _answer(certified: Certified | None) -> Answer:
    return Answer(b"{}", "gzip", 2, 0.5, certified, 1_000, faults=("a fault",), stem="report")


@pytest.mark.parametrize(
    "outcome",
    [_answer(_PROOF), _answer(None), Refused(NotComputable, ("why",), {}), Long()],
    ids=["certified", "no certificate", "refused", "long"],
)
def test_a_reply_is_the_same_after_its_way(outcome: Outcome | Long) -> None:
    reply = Reply(outcome, 0.25, 3.0)
    # analytic, as nothing is lost or changed
    assert Reply.of(pickle.loads(pickle.dumps(reply.parts))) == reply
