"""One optimisation, phase by phase."""

import time

from optimizer.optimize import optimize
from schemas.request.requests import OptimizeRequest

PHASES = ("validation", "mechanics", "program", "certificate", "report", "serialisation", "total")


def measure(body: bytes) -> dict[str, float]:
    """Milliseconds of every phase of one request, from its bytes to the bytes of its answer."""
    start = time.perf_counter()
    request = OptimizeRequest.model_validate_json(body)
    validated = time.perf_counter()
    answer = optimize(request)
    answered = time.perf_counter()
    answer.model_dump_json()
    end = time.perf_counter()
    timing = answer.timing
    return {
        "validation": (validated - start) * 1e3,
        "mechanics": timing.mechanics_ms,
        "program": timing.solve_ms,
        "certificate": timing.certificate_ms,
        "report": timing.report_ms,
        "serialisation": (end - answered) * 1e3,
        "total": (end - start) * 1e3,
    }
