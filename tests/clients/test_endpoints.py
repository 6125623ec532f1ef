"""The client knows every endpoint that the service describes."""

import re
from types import ModuleType
from typing import Any

import pytest

from service.app import create_app
from service.computations.table import COMPUTATIONS


@pytest.fixture(scope="module")
def described() -> set[tuple[str, str]]:
    """Method and path of every operation below /v1."""
    paths = create_app(warm=False).openapi()["paths"]
    return {
        (method.upper(), path) for path, operations in paths.items() if path.startswith("/v1/") for method in operations
    }


class _Sent(Exception):
    """Something was sent; there is no answer."""


def test_every_endpoint_has_a_method(counterweight: ModuleType, described: set[tuple[str, str]], tmp_path: Any) -> None:
    names: set[tuple[str, str]] = set()

    class Recorder(counterweight.Service):  # type: ignore[misc, name-defined]
        def _send(self, method: str, path: str, *_: Any) -> Any:
            names.add((method, "/" + path.lstrip("/").partition("?")[0]))
            raise _Sent

    service, job = Recorder(), {"links": {"self": "/v1/sweeps/{id}", "results": "/v1/sweeps/{id}/results"}}
    calls: list[tuple[Any, ...]] = [
        (service.version,),
        (service.effects,),
        (service.examples,),
        (service.example, "{name}"),
        *((call, {}) for call in (service.optimize, service.analyze, service.pareto, service.match, service.rating)),
        *((call, {}) for call in (service.pin_loads, service.accuracy, service.sweep, service.round)),
        (service.shaft, {}),
        (service.layout, {}),
        (service.verify, {}, {}),
        (service.report, {}, tmp_path / "report.pdf"),
        (service.drawings, {}, tmp_path / "drawings.zip"),
        *((service.picture, path.rpartition("/")[2], {}) for _, path in described if path.startswith("/v1/pictures/")),
        (service.template, tmp_path / "machine.xlsx"),
        (service.request_of, __file__),
        (service.later, "v1/match", {}),
        (lambda: next(service.sweeps()),),
        *((call, job) for call in (service.state, service.result, service.metadata, service.resume, service.end)),
        (lambda: next(service.rows(job)),),
        (lambda: next(service.events(job)),),
    ]
    pictures = [path.rpartition("/")[2] for _, path in described if path.startswith("/v1/pictures/")]
    calls += [(service.picture, name, {}) for name in pictures]
    tables = [path.rpartition("/")[2] for _, path in described if path.startswith("/v1/tables/")]
    calls += [(service.table, name, {}) for name in tables]
    # what has no method of its own yet is posted by its path
    calls += [
        (service.post, computation.path, {})
        for computation in COMPUTATIONS.values()
        if not hasattr(service, computation.name)
    ]
    for call, *values in calls:
        with pytest.raises(_Sent):
            call(*values)
    assert described <= names, sorted(described - names)
    # and nothing that is not there
    texts = {re.sub(r"[{].*?[}]", "{}", path) for _, path in described}
    assert {re.sub(r"[{].*?[}]", "{}", path) for _, path in names} <= texts


def test_a_computation_is_answered_later(counterweight: ModuleType, url: str) -> None:
    service = counterweight.Service(url)
    request = service.example("2d12")
    job = service.later("v1/optimize", request)
    # the last state ends the events
    assert [state["state"] for state in service.events(job)][-1] == "done"
    now = service.optimize(request)
    assert service.result(job)["certificate"]["objective"] == pytest.approx(now["certificate"]["objective"], rel=1e-9)
    assert service.metadata(job) == {"kind": "optimize"}
    assert service.resume(job)["state"] == "done"
    assert service.end(job) is None
    with pytest.raises(counterweight.Refused, match="404"):
        service.state(job)


def test_an_answer_is_verified(counterweight: ModuleType, url: str) -> None:
    service = counterweight.Service(url)
    request = service.example("single-horizontal")
    assert service.verify(request, service.optimize(request))["verdict"] == "held"


def test_a_workbook_holds_the_request_that_was_written(counterweight: ModuleType, url: str, tmp_path: Any) -> None:
    service = counterweight.Service(url)
    # independent: an example as it is published, whose quantities are numbers
    assert service.request_of(service.template(tmp_path / "machine.xlsx", "w60")) == service.example("w60")


def test_the_effects_and_the_version_are_told(counterweight: ModuleType, url: str) -> None:
    service = counterweight.Service(url)
    assert service.effects()["effects"]
    assert service.version()["version"]


def test_sweeps_are_listed_page_by_page(counterweight: ModuleType, url: str) -> None:
    service = counterweight.Service(url)
    base = service.example("single-horizontal")
    axes = [{"path": "/machine/speed_rpm", "values": [300.0]}]
    started = {service.sweep({"base": base, "axes": axes})["id"] for _ in range(3)}
    assert started <= {sweep["id"] for sweep in service.sweeps(limit=2)}
