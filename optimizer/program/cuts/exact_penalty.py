"""Goals that are to stay below levels, as sums beside the one that is to be small.

The largest of P and least + price (Q - level) is P wherever Q keeps its level, since P is nowhere below its least. So
what is proven of it, whatever the price, is proven of P under the level; and a search takes it as any other objective.
"""

from dataclasses import replace

import numpy as np

from optimizer.numerics.arrays import Real
from optimizer.program.cuts.proof import times
from optimizer.program.cuts.semi_infinite import Problem
from optimizer.program.statement import Statement


def under_levels(statement: Statement, program: Problem, most: Real, least: float, steep: float) -> Statement:
    """The statement of several goals as the one of its last goal under levels of the others, of as many sums.

    Parameters
    ----------
    statement : of the program with some cuts.
    most : levels of all goals but the last.
    least : lower bound of the last goal under them. Of more than that it is nowhere below the last
        goal all the same, and what makes it small keeps the levels where it comes to no more.
    steep : price of the goals before, each by what it is measured by, in units of the last one.
    """
    if not most.size:
        return statement
    units = program.units
    price = np.append(steep * units[-1] / units[:-1], 1.0)
    result = times(statement, price[program.goal_of])
    # once for every sum, however many groups it has
    _, first = np.unique(program.case_of, return_index=True)
    of_group = np.zeros(len(program.groups))
    of_group[first] = np.append(least - price[:-1] * most, 0.0)[program.goal_of_case]
    return replace(result, floor=result.floor + of_group[result.group])
