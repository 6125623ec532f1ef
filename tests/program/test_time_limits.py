"""Where time is up no further method begins: what stands is proven as far as it says, and its status says so."""

from typing import Any

import numpy as np
import pytest

from optimizer.optimize import optimize
from optimizer.program import optimum as whole
from optimizer.program.kernel.finer_numbers import EXTENDED, FIFTY_DIGITS, OutOfTime
from optimizer.program.methods import cascade, empty_webs
from optimizer.program.methods.optima import optima
from optimizer.program.methods.single import Target, interior_point
from optimizer.program.reference import solver
from optimizer.solve import plates
from tests.optimize.asking import single
from tests.program.cases import random_statement
from tests.studies.accuracy.test_choices import cut, twin

#: time.thread_time() that is over
OVER = 0.0


@pytest.mark.parametrize("precision", [EXTENDED, FIFTY_DIGITS])
def test_finer_numbers_end_at_the_next_step(precision: Any) -> None:
    program = random_statement(1, "sum", (1.0, 1.0), True, True, True, 4)
    for until, ends in ((OVER, True), (np.inf, False), (OVER, True)):
        target = Target(1e-9, 1e-9, False, until)
        if ends:
            with pytest.raises(OutOfTime):
                interior_point(program, target, precision)
        else:
            assert interior_point(program, target, precision).smallest.gap < 1e-9


@pytest.mark.parametrize("seed", range(6))
def test_what_stands_is_proven_of_the_same_program(seed: int) -> None:
    """Property: a bound of the time that was is below every value, and no value below the bound without a limit."""
    program = random_statement(seed, "sum", (1.0, 0.3), True, True, True, 6).alone()
    late, sharp = optima(program, 1e-9, True, OVER), optima(program, 1e-9, True)
    size = float(program.at_rest[0])
    assert late.lower_bound[0] <= sharp.objective[0] + 1e-12 * size
    assert late.objective[0] >= sharp.lower_bound[0] - 1e-9 * size or late.excess[0] > 0.0
    assert late.unreachable[0] == sharp.unreachable[0]


def test_no_method_begins_after_its_time(monkeypatch: pytest.MonkeyPatch) -> None:
    """Each of them may take a hundred times as long as all before it."""
    begun: list[str] = []

    def counted(module: Any, name: str) -> None:
        own = getattr(module, name)

        def run(*arguments: Any, **more: Any) -> Any:
            begun.append(name)
            return own(*arguments, **more)

        monkeypatch.setattr(module, name, run)

    counted(cascade, "_in_finer_numbers")
    counted(solver, "_attempt")
    counted(empty_webs, "_without")
    # no method is content with what it has
    monkeypatch.setattr(cascade, "enough", lambda *_: False)
    program = random_statement(3, "sum", (1.0, 1.0), False, False, False, 4)
    target = Target(0.0, 0.0, True)
    quick = interior_point(program, target)._replace(certified=False)
    monkeypatch.setattr(cascade, "polished", lambda statement, target, quick, inside=None: quick)
    monkeypatch.setattr(cascade, "lightened", lambda statement, target, quick, precision=None: quick)
    for until, attempts, finer in ((OVER, 2, 0), (np.inf, 16, 1)):
        begun.clear()
        cascade.cascade(program, target._replace(until=until), quick)
        assert begun.count("_attempt") == attempts
        assert begun.count("_in_finer_numbers") == finer


def test_the_status_names_the_limit(monkeypatch: pytest.MonkeyPatch) -> None:
    """A request whose time is up before its proof is inaccurate, and says why; one that is proven is optimal."""
    body = {"machine": single([(90.0, 20.0)]), "accuracy": {"time_limit_s": 1e-9}}
    assert optimize(body).status == "optimal"
    own = whole.optima

    def loose(*arguments: Any) -> Any:
        answer = own(*arguments)
        answer.lower_bound[:] = 0.5 * answer.objective
        return answer

    monkeypatch.setattr(whole, "optima", loose)
    late = optimize(body)
    assert late.status == "inaccurate"
    assert late.status_reason.startswith("The time limit of 1e-09 s ended the search.")
    in_time = optimize(body | {"accuracy": {"time_limit_s": 30}})
    assert in_time.status == "inaccurate"
    assert "time limit" not in in_time.status_reason


def test_plates_end_at_the_limit_too(monkeypatch: pytest.MonkeyPatch) -> None:
    """Equal plates are another search, and webs without dust are; neither begins when time is up."""
    begun: list[str] = []

    def counted(name: str) -> None:
        own = getattr(plates, name)

        def run(*arguments: Any) -> Any:
            begun.append(name)
            return own(*arguments)

        monkeypatch.setattr(plates, name, run)

    counted("alike")
    counted("emptied")
    body = {"machine": cut(twin())}
    answers = [optimize(body | {"accuracy": {"time_limit_s": limit}}) for limit in (1e-9, 30)]
    assert begun == ["alike"]
    late, whole_time = answers
    assert late.certificate is not None
    assert whole_time.certificate is not None
    assert late.certificate.lower_bound is not None
    assert late.certificate.lower_bound <= whole_time.certificate.objective * (1.0 + 1e-12)
    assert whole_time.status == "optimal"
