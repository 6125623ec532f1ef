"""Every leaf of an answer is checked, or named as not covered; what is missing or no number is broken or refused."""

import copy
import json
import sys
from typing import Any

import pytest

from service.verification import checker
from tests import night
from tests.verification.answers import names, pair
from tests.verification.checking import broken, is_broken
from tests.verification.falsified import deleted, numbers, replaced
from tests.verification.form import all_fields, all_nulls

#: enough for what has to hold of every kind, and for a test
KINDS = ("sum", "infeasible", "plates, sectors", "balance quality", "scenarios", "shaking", "front")


def test_the_form_is_that_of_the_models() -> None:
    """Independent: the models, which the checker does not import."""
    checker()
    module = sys.modules["verify_form"]
    for path, fields in all_fields().items():
        parts = tuple(part for part in path.split("/") if part not in ("", "*"))
        assert module.names(parts) == fields, path


def test_null_is_where_the_models_have_it() -> None:
    """Independent: of every field that may hold null, and of no other but where places of one end differ."""
    checker()
    module, nullable = sys.modules["verify_form"], all_nulls()
    tables = {}
    for path in all_fields():
        tables[path] = {*module.names(tuple(part for part in path.split("/") if part not in ("", "*")), module.NULL)}
        assert {*all_fields()[path]} & nullable[path] <= tables[path], path
    for path, table in tables.items():
        for name in table:
            assert any(name in nullable[place] for place, other in tables.items() if other == table), (path, name)


@pytest.mark.parametrize("name", KINDS)
def test_no_number_is_null_that_an_answer_has(name: str) -> None:
    """Regression: a figure that was replaced by null was held, as nothing was claimed."""
    request, answer = pair(name)
    kind, module = ("pareto",) if "fronts" in answer else (), sys.modules["verify_form"]
    count = 0
    for path in list(numbers(answer))[::7]:
        parts = (*kind, *(part for part in path[:-1] if isinstance(part, str)))
        if path[-1] in module.names(parts) and path[-1] not in module.names(parts, module.NULL):
            count += 1
            try:
                assert any(claim.startswith("form") for claim in broken(request, replaced(answer, path, None))), path
            except checker().Unreadable:
                continue
    assert count > 5


@pytest.mark.parametrize("name", KINDS)
def test_an_answer_lacks_no_field(name: str) -> None:
    request, answer = pair(name)
    for path in list(numbers(answer))[::7]:
        if not {"timing", "effects", "multipliers"} & {*path} and not isinstance(path[-1], int):
            wrong = deleted(answer, path)
            try:
                assert is_broken(request, wrong), path
            except checker().Unreadable:
                continue


@pytest.mark.parametrize("number", night.part(3, [float("nan"), float("inf"), -float("inf")]))
def test_a_number_that_is_none_is_refused(number: float) -> None:
    request, answer = pair("scenarios")
    for path in list(numbers(answer))[::5]:
        with pytest.raises(checker().Unreadable):
            checker().verify(request, replaced(answer, path, number))


@pytest.mark.parametrize("name", KINDS[:-1])
def test_a_counterweight_twice_or_not_at_all_is_broken(name: str) -> None:
    request, answer = pair(name)
    there = answer if answer["counterweights"] else answer["infeasibility"]["closest"]
    first = there["counterweights"][0]
    for wrong in ([first, *there["counterweights"]], there["counterweights"][1:], there["counterweights"][::-1]):
        counterweights, there["counterweights"] = there["counterweights"], wrong
        assert is_broken(request, answer)
        there["counterweights"] = counterweights


@pytest.mark.parametrize("name", ["hodograph", "orders", "foundation_loads"])
def test_an_output_that_was_requested_is_there(name: str) -> None:
    request, answer = pair("shaking")
    assert checker().verify(request, answer)["verdict"] == "held"
    assert checker().verify(request, {**answer, name: None})["verdict"] == "broken"


def test_what_is_added_is_named() -> None:
    request, answer = pair("sum")
    answer["savings"] = {"per_year": 1000.0}
    verdict = checker().verify(request, answer)
    assert verdict["not_covered"] == ["/answer/savings"]
    assert (verdict["verdict"], verdict["leaves"] - verdict["checked"]) == ("not covered", 1)


@pytest.mark.parametrize("name", KINDS)
def test_all_leaves_are_counted(name: str) -> None:
    """Independent: every leaf below a name that is not covered, and all others."""
    request, answer = pair(name)
    verdict = checker().verify(request, answer)
    checker()
    silent = sys.modules["verify_leaves"].REMARKS
    named = [pointer.split("/")[2:] for pointer in verdict["not_covered"]]
    missed = counted = 0
    for path in _leaves(answer):
        if silent & {*path} or {"multipliers", "nominal_multipliers", "implied_max_mass_kg"} & {*path}:
            continue
        counted += 1
        missed += any(["*" if part.isdecimal() else part for part in path[: len(name)]] == name for name in named)
    assert (verdict["leaves"], verdict["checked"]) == (counted, counted - missed) or "multipliers" in str(named)
    assert verdict["verdict"] == ("held" if missed == 0 and not named else "not covered")


def _leaves(value: Any, path: tuple[str, ...] = ()) -> list[tuple[str, ...]]:
    if isinstance(value, dict | list):
        items = value.items() if isinstance(value, dict) else enumerate(value)
        return [leaf for key, value in items for leaf in _leaves(value, (*path, str(key)))]
    return [] if value is None else [path]


def test_the_kinds_hold_as_they_are() -> None:
    for name in KINDS:
        request, answer = pair(name)
        verdict = checker().verify(copy.deepcopy(request), json.loads(json.dumps(answer)))
        assert verdict["verdict"] in ("held", "not covered"), (name, verdict["claims"])
    assert len(names()) >= 26
