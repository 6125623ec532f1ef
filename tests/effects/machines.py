"""Every output of every machine, for the tests of the effects."""

from typing import Any, get_args

from schemas.answer.answers import AnalyzeAnswer
from schemas.answer.outputs import OutputName
from tests.analyze.driven import ask, random_driven

# of a reciprocating machine
EVERY: tuple[str, ...] = tuple(name for name in get_args(OutputName) if name != "pin_loads")
SCROLL = {
    "kind": "scroll",
    "speed_rpm": 3000.0,
    "orbit_radius_m": 0.005,
    "orbiting_mass_kg": 1.2,
    "orbiting_position_m": 0.05,
    "anti_rotation": {"type": "oldham", "mass_kg": 0.3, "axis_deg": 90.0, "position_m": 0.03},
}


def complete(seed: int = 0, **rest: Any) -> dict[str, Any]:
    """A machine that lacks nothing that any output needs."""
    return random_driven(seed, "v", throws=2, **rest)


def figures(answer: AnalyzeAnswer) -> dict[str, Any]:
    """Figures of an answer by output, without times."""
    dumped = answer.model_dump()
    return {name: dumped[name] for name in EVERY}


def outputs_with_counterweight(*outputs: str, body: dict[str, Any] | None = None, **rest: Any) -> AnalyzeAnswer:
    """Outputs of a machine, with a counterweight on it."""
    fitted = [{"web": "a", "mass_kg": 12.0, "angle_deg": 70.0}]
    return ask(complete() if body is None else body, *outputs, step_deg=15.0, counterweights=fitted, **rest)
