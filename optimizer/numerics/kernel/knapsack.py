"""A budget spent where a kilogram gains most, compiled: :meth:`optimizer.program.limits.Limits.spent`."""

import numpy as np

from optimizer.numerics.compiling import inner, kernel


@kernel
def filled(gain, most, budget):  # type: ignore[no-untyped-def]
    """The masses of largest total gain, and what a kilogram gains on the web at which the budget ends.

    No mass enters that is larger than the budget, so that no digits are lost to a limit that cannot bind.

    Parameters
    ----------
    gain : (N, K) per kilogram; of webs that gain alike the first comes first.
    most : (N, K) kg.
    budget : (N,) kg, inf where there is none.

    Returns
    -------
    masses : (N, K) kg.
    price : (N,) at least 0; 0 where the budget does not end.
    """
    number, webs = gain.shape
    masses, price = np.zeros((number, webs)), np.zeros(number)
    order, buffer = np.zeros(webs, np.int64), np.zeros(webs, np.int64)
    for n in range(number):
        price[n] = fill(gain[n], most[n], budget[n], order, buffer, masses[n])
    return masses, price


@inner
def fill(gain, most, budget, order, buffer, masses):  # type: ignore[no-untyped-def]
    """The same of one program: its masses (K,), and the price. Of places (K,) two arrays to be written to."""
    if budget == np.inf:
        for k in range(gain.size):
            masses[k] = most[k]
        return 0.0
    _in_falling_order(gain, order, buffer)
    spent, price = 0.0, 0.0
    for k in order:
        left = max(budget - spent, 0.0)
        masses[k] = min(most[k], left)
        if most[k] > left:
            price = max(price, gain[k])
        spent += min(most[k], budget)
    return price


@inner
def _in_falling_order(values, order, buffer):  # type: ignore[no-untyped-def]
    """Places (K,) of values in falling order, of equal ones the first first: sorted runs, merged two by two."""
    count = values.size
    for k in range(count):
        order[k] = k
    width = 1
    while width < count:
        for begin in range(0, count, 2 * width):
            middle, end = min(begin + width, count), min(begin + 2 * width, count)
            cursor, two = begin, middle
            for k in range(begin, end):
                if two >= end or (cursor < middle and values[order[cursor]] >= values[order[two]]):
                    buffer[k], cursor = order[cursor], cursor + 1
                else:
                    buffer[k], two = order[two], two + 1
        for k in range(count):
            order[k] = buffer[k]
        width *= 2
