"""What tests of the whole flow ask, and of what."""

import math
from typing import Any

from schemas.answer.answers import OptimizeAnswer
from tests.optimize.machines import machine, row, throw, web
from tests.verification.checking import optimized

OMEGA_SQUARED = (600 * math.pi / 30) ** 2


def answer(body: dict[str, Any], **objective: Any) -> OptimizeAnswer:
    request = {"machine": body, "objective": objective}
    return optimized(request)


def single(axes_and_masses: list[tuple[float, float]], rotating: float = 0.0) -> dict[str, Any]:
    rows = [row(axis, mass) for axis, mass in axes_and_masses]
    return machine([throw(0.0, 0.0, rows, rotating=rotating)], [web("a", -0.1), web("b", 0.1)])
