"""Random programs over the turn: curves that are short Fourier series, shifted by counterweights."""

from collections.abc import Sequence

import numpy as np

from optimizer.program.cuts.cut import Quantity
from optimizer.program.cuts.dominance import Group, Weighed
from optimizer.program.cuts.semi_infinite import Goal, Problem
from optimizer.program.limits import Limits
from optimizer.program.rows import Row, weighted_peak
from optimizer.responses.curve import TurnResponse
from optimizer.responses.response import Phasors, Response
from tests.program.cases import random_limits
from tests.responses.fourier import FourierCurves

ORDERS = np.arange(-6.0, 7.0)


def wide(webs: int, max_mass: float = 1e3) -> Limits:
    """Limits that do not bind."""
    ones = np.ones(webs)
    return Limits(0.2 * ones, max_mass * ones, np.ones(webs, bool), ones + 0j, 0.0 * ones, ones, np.asarray(np.inf))


def quantities(
    rng: np.random.Generator, count: int, webs: int, measure: str = "peak", name: str = "bearing"
) -> tuple[Quantity, ...]:
    """Curves of all orders from -6 to 6, and real influences."""
    size = 10.0 ** rng.uniform(-2, 0, ORDERS.size)
    curves = FourierCurves(ORDERS, (rng.normal(size=(count, 13, 2)) @ [1, 1j]) * size)
    influence = rng.uniform(-1.0, 1.0, (count, webs))
    return tuple(
        Quantity(TurnResponse(f"{name} {j}", "N", influence[j], curves, j), measure)  # type: ignore[arg-type]
        for j in range(count)
    )


def largest(first: int, last: int, weight: float = 1.0) -> Group:
    """The largest of some quantities, each times a weight."""
    return Group(weighed=tuple(Weighed(q, weight) for q in range(first, last)))


def force_and_moment(rng: np.random.Generator, webs: int) -> Group:
    """The sum of two first-order peaks."""
    peaks = []
    for name, influence in (("force", np.ones(webs)), ("moment", rng.uniform(-1, 1, webs))):
        co, counter = rng.normal(size=(2, 2)) @ [1, 1j]
        response = Response(name, "N", Phasors(np.asarray(co), np.asarray(counter)), influence)
        peaks.append(weighted_peak(response, 1.0))
    return Group(rows=(Row("sum", tuple(peaks)),))


def bearings(
    seed: int, count: int = 4, webs: int = 6, measure: str = "peak", limits: Limits | None = None, beside: bool = False
) -> Problem:
    """The largest of some bearing loads, alone or beside force and moment."""
    rng = np.random.default_rng(seed)
    every = quantities(rng, count, webs, measure)
    groups: Sequence[Group] = [largest(0, count)]
    if beside:
        groups = [force_and_moment(rng, webs), *groups]
    limits = random_limits(rng, webs, bool(seed % 2), bool(seed // 2 % 2)) if limits is None else limits
    return Problem(every, (Goal("bearings", tuple(groups)),), (), (), limits)
