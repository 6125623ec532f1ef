"""The machines that one set of counterweights is to suit: every kind of case that a request can state.

One more kind is one more field of :class:`schemas.request.requests.OptimizeRequest` and one more entry here. All that
looks at cases goes by this table: rules, refusals of studies, the program, answers, reports.
"""

from collections.abc import Callable, Iterator, Mapping
from typing import Any, NamedTuple

from schemas.base.rules import Path, Rule, all_rules
from schemas.base.target import find_target, pointer
from schemas.request.scenarios import Scenario, change_rules, machine_of
from schemas.request.scene import Scene


class Case(NamedTuple):
    """A machine that the counterweights are to suit: that of the request, with changes.

    name, changes : of the request, where its name and its changes are stated.
    values : the same of the value of every change.
    """

    scenario: Scenario
    name: Path
    changes: Path
    values: tuple[Path, ...]


class CaseKind(NamedTuple):
    """What a field states of cases.

    default : the field where it states none.
    cases : those that it states; what it holds is no default.
    rules : what is wrong with it where all other fields are right; paths from the root of the request. Names and
        machines of its cases are looked at besides.
    """

    default: Any
    cases: Callable[[Any], Iterator[Case]]
    rules: Callable[[Scene, Any], Iterator[Rule]]


def _cases_of(scenarios: tuple[Scenario, ...]) -> Iterator[Case]:
    for i, scenario in enumerate(scenarios):
        place = ("scenarios", i)
        values = tuple((*place, "changes", j, "value") for j in range(len(scenario.changes)))
        yield Case(scenario, (*place, "name"), (*place, "changes"), values)


#: by field of the request, in the order of answers
KINDS: dict[str, CaseKind] = {
    "scenarios": CaseKind((), _cases_of, change_rules),
    # beside this one
}
#: fields of a request about the unchanged machine
NOMINAL: Mapping[str, Any] = {field: kind.default for field, kind in KINDS.items()}


def stated(request: Scene) -> Iterator[str]:
    """Fields of a request that state cases."""
    fields = vars(request)
    return (field for field, kind in KINDS.items() if fields[field] != kind.default)


def cases(request: Scene) -> tuple[Case, ...]:
    """All cases of a request; the unchanged machine is one only where it is among them."""
    return tuple(case for field in stated(request) for case in KINDS[field].cases(getattr(request, field)))


def case_rules(request: Scene) -> Iterator[Rule]:
    """What is wrong with the cases of a request whose other parts are right; paths from its root."""
    fields = list(stated(request))
    if not fields:
        return
    rules = [rule for field in fields for rule in KINDS[field].rules(request, getattr(request, field))]
    yield from rules
    wrong, names = [rule.path for rule in rules if rule.broken], set[str]()
    for case in cases(request):
        yield Rule(case.scenario.name in names, case.name, "another scenario has this name")
        names.add(case.scenario.name)
        if not any(path[: len(case.changes)] == case.changes for path in wrong):
            yield from _machine_rules(request, case)


def _machine_rules(request: Scene, case: Case) -> Iterator[Rule]:
    """What is wrong with the machine of a case, in the change at fault where it is one of them."""
    changes = zip(case.scenario.changes, case.values, strict=True)
    places = {find_target(request, change.path).path: place for change, place in changes}
    for broken, rest, message in all_rules(machine_of(request, case.scenario)):
        where = ("machine", *rest)
        yield (
            Rule(broken, places[where], message)
            if where in places
            else Rule(broken, case.changes, f"{pointer(where)}: {message}")
        )
