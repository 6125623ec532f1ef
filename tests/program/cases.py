"""Random programs with every combination of limits, in plain numbers."""

from collections.abc import Sequence
from dataclasses import fields, is_dataclass, replace
from itertools import product
from typing import Any

import numpy as np

from optimizer.mechanics.angles import direction
from optimizer.numerics.arrays import Complex
from optimizer.program.limits import Limits
from optimizer.program.methods.optima import optima
from optimizer.program.rows import combined, statement, weighted_peak
from optimizer.program.solution import ConeSolution
from optimizer.program.statement import Statement
from optimizer.responses.response import Phasors, Response

DIRECTION_WEIGHTS = ((1.0, 1.0), (1.0, 0.3), (0.0, 1.0))
COMBINATIONS = tuple(
    product(("sum", "max"), DIRECTION_WEIGHTS, (False, True), (False, True), (False, True))
)  # combine, direction weights, sectors, budget, ceilings


def optimum(problem: Statement, relative_gap: float, least_mass: bool) -> ConeSolution:
    """Of one program, the only one of a batch."""
    return optima(problem.alone(), relative_gap, least_mass).single()


def random_limits(rng: np.random.Generator, webs: int, sectors: bool, budget: bool) -> Limits:
    free = rng.random(webs) < 0.4 if sectors else np.ones(webs, bool)
    half = np.where(free, 90.0, rng.choice([2.0, 10.0, 40.0, 90.0], webs))
    edge = direction(half)
    centre = np.where(free, 1.0 + 0j, direction(rng.uniform(0, 360, webs)))
    max_mass = rng.choice([0.5, 3.0, 20.0]) * rng.uniform(0.1, 1.0, webs)
    return Limits(
        radius=rng.uniform(0.1, 0.4, webs),
        max_mass=max_mass,
        free=free,
        centre=centre,
        half_angle_cos=edge.real,
        half_angle_sin=edge.imag,
        max_total_mass=np.asarray(0.4 * max_mass.sum() if budget else np.inf),
    )


def random_responses(rng: np.random.Generator, webs: int) -> tuple[Response, Response]:
    def pair() -> Phasors:
        values = rng.normal(size=(2, 2)) @ [1, 1j]
        return Phasors(values[0], values[1])

    return (
        Response("force", "N", pair(), np.ones(webs)),
        Response("moment", "N m", pair(), rng.uniform(-1.0, 1.0, webs)),
    )


def random_statement(
    seed: int,
    combine: str,
    weights: tuple[float, float],
    sectors: bool,
    budget: bool,
    ceilings: bool,
    webs: int | None = None,
) -> Statement:
    """A program; its ceilings, if any, are met by some point within the limits."""
    rng = np.random.default_rng(seed)
    webs = int(rng.integers(1, 9)) if webs is None else webs
    limits = random_limits(rng, webs, sectors, budget)
    responses = random_responses(rng, webs)
    inside = random_point(rng, limits)
    allowed = [(response, 1.01 * float(response.to(inside).peak)) for response in responses] if ceilings else []
    return statement(
        combined([weighted_peak(response, 1.0, *weights) for response in responses], combine), allowed, limits
    )


def stacked(problems: Sequence[Statement]) -> Statement:
    """Programs of one shape as one statement, with a leading axis."""

    def stack(parts: list[Any]) -> Any:
        first = parts[0]
        if isinstance(first, np.ndarray):
            return np.stack(parts)
        if is_dataclass(first):
            return replace(first, **{f.name: stack([getattr(part, f.name) for part in parts]) for f in fields(first)})
        assert all(part == first for part in parts)
        return first

    return replace(stack(list(problems)), row=problems[0].row, group=problems[0].group)


def random_point(rng: np.random.Generator, limits: Limits) -> Complex:
    """Any point within the limits."""
    webs = limits.radius.size
    u = limits.radius * limits.max_mass * rng.uniform(0, 1.5, webs) * direction(rng.uniform(0, 360, webs))
    return limits.into(u)
