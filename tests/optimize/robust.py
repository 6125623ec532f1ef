"""What tests of scenarios and tolerances ask, and of what."""

from typing import Any

import numpy as np

from optimizer.optimize import optimize
from schemas.answer.answers import OptimizeAnswer
from schemas.request.requests import OptimizeRequest
from tests.optimize.machines import machine, row, throw, web


def answered(fields: dict[str, Any], **rest: Any) -> OptimizeAnswer:
    return optimize(OptimizeRequest.model_validate({"machine": fields, "angles": {"step_deg": 30}, **rest}))


def scenario(name: str, weight: float = 1.0, **values: Any) -> dict[str, Any]:
    """Fields of the machine by their pointers, with / written as __."""
    changes = [{"path": f"/machine/{path.replace('__', '/')}", "value": value} for path, value in values.items()]
    return {"name": name, "weight": weight, "changes": changes}


def crank(angle: float = 0.0, max_mass: float = 100.0) -> dict[str, Any]:
    """20 kg at 0.1 m and 10 rad/s, 200 N, with a web in the same plane."""
    return machine([throw(0.0, angle, [], rotating=20.0)], [web("a", 0.0, max_mass)], speed_rpm="10 rad/s")


def worst(answer: OptimizeAnswer) -> float:
    assert answer.worst_case is not None
    assert answer.certificate is not None
    assert answer.worst_case.objective == answer.certificate.objective
    return answer.worst_case.objective


def six_rows(rods: bool = False) -> dict[str, Any]:
    rng = np.random.default_rng(8)
    throws = [
        throw(z, angle, [row(axis, float(rng.uniform(5, 20))) for axis in (45.0, 120.0, 190.0)], rotating=8.0)
        for z, angle in ((-0.3, 20.0), (0.4, 130.0))
    ]
    return machine(throws, [web("a", -0.5), web("b", 0.0), web("c", 0.6)])
