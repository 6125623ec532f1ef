"""The faults that rooms declare are joined into one table, in which each exception stands once."""

from importlib import import_module
from pkgutil import walk_packages

import pytest

import service
from service.app import FAULTS
from service.common.problems import FaultTable, fixed, later_by_error
from service.http.errors import union


def declared() -> dict[str, FaultTable]:
    """The tables of all modules of the service but the application's own."""
    names = (info.name for info in walk_packages(service.__path__, "service.") if not info.name.endswith("__main__"))
    modules = {name: vars(import_module(name)) for name in names if name.endswith(("faults", "validation", "leaving"))}
    return {name: content["FAULTS"] for name, content in modules.items() if "FAULTS" in content}


def test_the_application_joins_what_every_room_declares() -> None:
    tables = declared()
    assert len(tables) >= 7
    assert {kind for table in tables.values() for kind in table} == set(FAULTS)


def test_every_fault_is_declared_by_the_room_of_its_exception() -> None:
    for name, table in declared().items():
        room = name.split(".")[1]
        own = {kind.__module__.split(".")[1] for kind in table if kind.__module__.startswith("service.")}
        assert own == {room}, name


def test_no_exception_stands_in_two_tables() -> None:
    table = {KeyError: fixed(404, "Not there")}
    with pytest.raises(ValueError, match="in two tables of faults: KeyError"):
        union(table, {ValueError: fixed(422, "Wrong")}, table)


@pytest.mark.parametrize(("after_s", "headers"), [(3, {"Retry-After": "3"}), (0, {"Retry-After": "0"}), (None, {})])
def test_an_error_says_itself_when_a_retry_helps(after_s: int | None, headers: dict[str, str]) -> None:
    error = RuntimeError("busy")
    vars(error)["retry_after_s"] = after_s
    assert dict(later_by_error(429, "Busy")(error).headers) == headers
