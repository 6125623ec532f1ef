"""The battery's demands can fail: an answer that is tampered with is found out, by the fault that it has.

Expected outcomes are analytic: each change breaks one claim.
"""

import math
from collections.abc import Callable
from io import StringIO
from typing import Any

import pytest
from rich.console import Console

from schemas.answer.answers import OptimizeAnswer
from tests.hard import battery
from tests.hard.cases.case import Case, case, machine, single_row, throw, v_twin, web
from tests.hard.judge import judge
from tests.hard.reference import Reference, reference
from tests.night import every
from tests.verification.checking import optimized

_PLAIN = case("plain", "plain", machine(v_twin(), [web("a", -0.45, 9, 0.2, (170, 90)), web("b", 0.5)]))
_LIMITED = case(
    "limited", "plain", machine(single_row(), [web("a", 0.0)], omega=60.0), force_ceiling_N=0.6 * 10 * 0.1 * 3600
)
_HOPELESS = case("hopeless", "plain", machine([throw(0, 0, [], rotating=3)], [web("a", 0, 1)]), force_ceiling_N=1.0)


def _expected(instance: Case) -> Reference:
    return reference(instance.body)


def _answer(instance: Case) -> OptimizeAnswer:
    return optimized(instance.body)


def _certificate(answer: OptimizeAnswer, **change: Any) -> OptimizeAnswer:
    return answer.model_copy(update={"certificate": answer.certificate.model_copy(update=change)})


def _heavier(answer: OptimizeAnswer, factor: float, turn: float = 0.0) -> OptimizeAnswer:
    """The same claims with other counterweights."""
    weights = tuple(
        weight.model_copy(update={"mass_kg": weight.mass_kg * factor, "angle_deg": weight.angle_deg + turn})
        for weight in answer.counterweights
    )
    total = sum(weight.mass_kg for weight in weights)
    return answer.model_copy(update={"counterweights": weights, "total_mass_kg": total})


_CHANGES: tuple[tuple[str, Case, Callable[[OptimizeAnswer], OptimizeAnswer]], ...] = (
    ("is nan", _PLAIN, lambda a: _certificate(a, gap=math.nan)),
    ("must be optimal", _PLAIN, lambda a: a.model_copy(update={"status": "inaccurate"})),
    ("certified gap", _PLAIN, lambda a: _certificate(a, relative_gap=2e-6)),
    ("certified gap of the mass", _PLAIN, lambda a: _certificate(a, mass_relative_gap=1e-2)),
    ("objective", _PLAIN, lambda a: _certificate(a, objective=a.certificate.objective * (1 + 1e-11))),
    ("lower bound", _PLAIN, lambda a: _certificate(a, lower_bound=a.certificate.objective * (1 + 1e-9))),
    ("bound of the mass", _PLAIN, lambda a: _certificate(a, mass_lower_bound_kg=a.total_mass_kg * 1.001)),
    ("peak force", _PLAIN, lambda a: _heavier(a, 1 + 1e-10)),
    ("kg, least is", _PLAIN, lambda a: _heavier(a, 1.001)),
    ("is less than the least", _PLAIN, lambda a: _heavier(a, 0.999)),
    ("from its centre", _PLAIN, lambda a: _heavier(a, 1.0, 180.0)),
    ("ceiling exceeded", _LIMITED, lambda a: _heavier(a, 0.5)),
    ("must be infeasible", _HOPELESS, lambda _: _answer(case("", "", _HOPELESS.body["machine"]))),
)


@pytest.mark.parametrize("number", every(4, range(len(_CHANGES))), ids=[fault for fault, _, _ in _CHANGES])
def test_a_false_claim_is_found_out(number: int) -> None:
    fault, instance, change = _CHANGES[number]
    """The change brings the fault, which the answer itself does not have."""
    expected, answer = _expected(instance), _answer(instance)
    assert not judge(instance, answer, expected).faults
    faults = judge(instance, change(answer), expected).faults
    assert any(fault in single_fault for single_fault in faults), faults


def test_an_exception_is_a_fault_and_is_printed() -> None:
    """A request that raises is counted, named and explained."""
    broken = Case("theme/broken", "no machine at all", {"machine": {}})
    verdict = battery.run(broken, None)
    assert verdict.status == "exception"
    console = Console(file=StringIO(), width=200)
    battery.summary([verdict, battery.run(_PLAIN, None)], console)
    text = console.file.getvalue()
    assert "2 cases, 1 failed" in text
    assert "theme/broken" in text
