"""Responses over a revolution at the angles of an even grid, whole or with their low orders alone.

The mean square has no angle. Its cuts are splits of a unit between the part that stays and the part that moves
(:mod:`optimizer.program.cuts.cut`), as many as there are angles.
"""

from collections.abc import Iterator, Mapping

import numpy as np

from optimizer.numerics.arrays import Complex, Real
from optimizer.program.cuts.cut import Cut, Quantity
from optimizer.program.cuts.semi_infinite import Cuts, Problem


def angle_cuts(problem: Problem, angles: int, position: float) -> Cuts:
    """The cuts of every quantity at the angles of a grid.

    Parameters
    ----------
    angles : in one revolution.
    position : of the grid, as a share of its step.
    """
    every = list[tuple[Cut, ...]]([()]) * len(problem.quantities)
    for q, quantity in _deciding(problem):
        every[q] = tuple(_cuts(problem, q, _grid(quantity, angles, position)))
    return tuple(every)


def order_cuts(problem: Problem, most: int, angles: int, senses: Mapping[str | None, float]) -> Cuts:
    """The same of quantities without the orders of the shaft above some, on the frame; no peak is above those.

    Parameters
    ----------
    senses : of rotation, by scenario, by which the shaft sees a vector turn less than the frame.
    """
    every = list[tuple[Cut, ...]]([()]) * len(problem.quantities)
    for q, quantity in _deciding(problem):
        grid = _grid(quantity, angles, 0.0)
        if quantity.measure == "rms" or problem.samples.cancelled[q]:
            every[q] = tuple(_cuts(problem, q, grid))
            continue
        sense = 0.0 if quantity.response.scalar else senses[quantity.scenario]
        values = low_orders(quantity.response.at(grid), most, quantity.response.period_deg, sense)
        every[q] = tuple(quantity.cut(*pair) for pair in zip(grid.tolist(), values.tolist(), strict=True))
    return tuple(every)


def samples_of(problem: Problem, angles: int) -> int:
    """Number of cuts at so many angles of a revolution, of all quantities."""
    return sum(_grid(quantity, angles, 0.0).size for _, quantity in _deciding(problem))


def low_orders(values: Complex, most: int, period_deg: float, sense: float) -> Complex:
    """A curve (n,) as the shaft sees it, without the orders above some that it has on the frame.

    Parameters
    ----------
    period_deg : of the curve; its orders are multiples of 360 degrees over it.
    sense : order on the frame of what stands still for the shaft.
    """
    count = values.size
    order = np.fft.fftfreq(count, 1.0 / count) * 360.0 / period_deg + sense
    low: Complex = np.fft.ifft(np.where(np.abs(order) <= most + 1e-9, np.fft.fft(values), 0.0))
    return low


def _deciding(problem: Problem) -> Iterator[tuple[int, Quantity]]:
    """Quantities that are weighed or limited, with their places; of others no cut counts."""
    places = {member.quantity for group in problem.groups for member in group.weighed}
    places |= {q for q, _ in problem.limited}
    return ((q, problem.quantities[q]) for q in sorted(places))


def _grid(quantity: Quantity, angles: int, position: float) -> Real:
    """Angles of the whole period, rad."""
    count = round(angles * quantity.response.period_deg / 360.0)
    return 2.0 * np.pi * (np.arange(count) + position) / angles


def _cuts(problem: Problem, q: int, grid: Real) -> Iterator[Cut]:
    quantity = problem.quantities[q]
    if quantity.measure == "rms":
        for split in (0.5 * np.pi * (np.arange(grid.size) + 0.5) / grid.size).tolist():
            along, across = float(np.cos(split)), float(np.sin(split))
            floor = across * quantity.spread - quantity.rms_error
            yield Cut(along * quantity.mean, along * quantity.response.influence, floor, share=along)
        return
    # of a curve that cancels nothing is left but its rounding
    values = np.zeros(grid.size, complex) if problem.samples.cancelled[q] else quantity.response.at(grid)
    for pair in zip(grid.tolist(), values.tolist(), strict=True):
        yield quantity.cut(*pair)
