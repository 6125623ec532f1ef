"""Which answers of the other tests go through the checker, and that a false one fails its test."""

import pytest

from optimizer.optimize import optimize
from schemas.answer.answers import OptimizeAnswer
from schemas.request.requests import OptimizeRequest
from service.documents.examples import bodies
from tests.verification.checking import Spread, is_checked, require
from tests.verification.every import _checked, unchecked


def test_the_first_of_a_file_and_a_twentieth_of_the_others() -> None:
    spread = Spread(every=False)
    assert [number for number in range(1, 61) if spread("file::one (call)")] == [1, 20, 40, 60]
    # whichever of its tests asks
    names = [f"another::test_{number}[x::y] (call)" for number in range(1, 32)]
    assert [number for number, name in enumerate(names, 1) if spread(name)] == [1, 20]


def test_every_one_at_night() -> None:
    spread = Spread(every=True)
    assert all(spread("one") for _ in range(40))


def test_every_one_outside_of_tests(monkeypatch: pytest.MonkeyPatch) -> None:
    spread = Spread(every=False)
    assert [number for number in range(1, 32) if is_checked(spread)] == [1, 20]
    monkeypatch.delenv("PYTEST_CURRENT_TEST")
    assert all(is_checked(spread) for _ in range(12))


def test_a_false_answer_fails_the_test_that_asked_for_it() -> None:
    request = OptimizeRequest.model_validate(bodies("")["2d12"])
    right = unchecked(optimize)(request)
    assert right.certificate is not None
    certificate = right.certificate.model_copy(update={"lower_bound": 1.001 * right.certificate.lower_bound})
    false = right.model_copy(update={"certificate": certificate})

    def compute(_: OptimizeRequest) -> OptimizeAnswer:
        return false

    with pytest.raises(AssertionError):
        _checked(compute)(request)
    assert _checked(lambda _: right)(request) is right
    body = bodies("")["2d12"]
    every = Spread(every=True)
    require(body, right, every)
    with pytest.raises(AssertionError):
        require(body, false, every)
