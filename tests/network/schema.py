"""What schemathesis is told about this service.

``python -m tests.network.schema`` makes up requests from the published document for every operation, valid and invalid
ones, and prints how many were answered with what.
"""

import argparse
import sys
from collections import Counter
from collections.abc import Callable
from typing import Any

import schemathesis
from hypothesis import HealthCheck, Phase, given, settings
from schemathesis import Case, GenerationMode
from schemathesis.checks import not_a_server_error
from schemathesis.specs.openapi.checks import (
    content_type_conformance,
    response_headers_conformance,
    response_schema_conformance,
    status_code_conformance,
)

from tests.network.serving import service


def operations(url: str) -> list[Any]:
    """The operations that the document of a running service names."""
    return [result.ok() for result in schemathesis.openapi.from_url(f"{url}/openapi.json").get_all_operations()]


def modes(operation: Any) -> list[GenerationMode]:
    """What can be asked: what is right, and what is wrong if there is anything that could be."""
    described = operation.definition.raw
    both = "parameters" in described or "requestBody" in described
    return list(GenerationMode) if both else [GenerationMode.POSITIVE]


def checks() -> list[Callable[..., Any]]:
    """What holds for every answer. That keys are ignored is right on loopback, so that is not checked here."""
    return [
        not_a_server_error,
        status_code_conformance,
        content_type_conformance,
        response_headers_conformance,
        response_schema_conformance,
    ]


def main() -> int:
    """Every operation."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--examples", type=int, default=150)
    many = parser.parse_args().examples
    total, failures = Counter[int](), 0
    with service(log_level="warning") as target:
        for operation in operations(target.url):
            statuses = Counter[int]()
            for mode in modes(operation):
                try:
                    send(operation.as_strategy(generation_mode=mode), many, statuses)
                except Exception as error:
                    failures += 1
                    print(f"    {operation.label}, {mode.value}: {str(error)[:1500]}")
            print(f"{operation.label:<36}{statuses.total():>6}  {dict(sorted(statuses.items()))}")
            total += statuses
        faults = target.faults()
    print(f"{total.total()} requests, {failures} failures: {dict(sorted(total.items()))}")
    print(f"{len(faults)} faults logged", *faults, sep="\n")
    return 1 if failures or faults else 0


def send(strategy: Any, many: int, statuses: Counter[int]) -> None:
    """Send so many requests of a strategy, check the answers, and count them by status."""

    @settings(max_examples=many, deadline=None, suppress_health_check=list(HealthCheck), phases=[Phase.generate])
    @given(case=strategy)
    def ask(case: Case) -> None:
        response = case.call(timeout=600)
        statuses[response.status_code] += 1
        case.validate_response(response, checks=checks())

    ask()


if __name__ == "__main__":
    sys.exit(main())
