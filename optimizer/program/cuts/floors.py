"""Bounds that need no solver: the smallest circles around the cuts of quantities.

The radius of the smallest circle around points of a curve is a floor of its peak, and the weights of its support are
the multipliers that prove it. They have sum lam (point - centre) = 0, so that no counterweight enters
(:mod:`optimizer.numerics.enclosing_circle`).
"""

import numpy as np

from optimizer.numerics.enclosing_circle import smallest_circle
from optimizer.program.certificate import Multipliers
from optimizer.program.cuts.semi_infinite import Cuts, Problem
from optimizer.program.statement import Statement


def floor_multipliers(program: Problem, cuts: Cuts, statement: Statement) -> Multipliers:
    """Multipliers of the largest floor of each group: of a row by itself, or of a quantity by its circle.

    Parameters
    ----------
    statement : of the program with these cuts, its groups times factors or not.
    """
    points = [np.array([cut.constant for cut in entry]) for entry in cuts]
    circles = [smallest_circle(point) for point in points]
    row = np.zeros(statement.floor.size)
    term = np.zeros(statement.row.size, complex)
    first_term = np.searchsorted(statement.row, np.arange(statement.floor.size))
    start = 0
    for group in program.groups:
        # floor, first row, quantity
        floors = [(float(statement.floor[start + k]), start + k, -1) for k in range(len(group.rows))]
        start += len(group.rows)
        for entry in group.weighed:
            floors.append((entry.offset + entry.weight * circles[entry.quantity].radius, start, entry.quantity))
            start += len(cuts[entry.quantity])
        _, place, quantity = max(floors)
        if quantity < 0:
            row[place] = 1.0
            continue
        circle = circles[quantity]
        support = place + circle.support
        row[support] = circle.weights
        if circle.radius > 0.0:
            outward = (points[quantity][circle.support] - circle.centre) / circle.radius
            term[first_term[support]] = circle.weights * outward
    return Multipliers(term, row, np.zeros_like(statement.ceilings.norms.constant))
