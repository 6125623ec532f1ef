"""Where the stages of the interior point for discs start, compiled, program by program.

A state is a row of numbers: x and y of v, x, z, x and y of p of each web, (K,) each; x and y of the multiplier of each
vector, its size and that of the multiplier, (Q, 4); prices of the objective and of the budget; and where there are
sectors the multipliers of both edges, (2, K).
"""

from typing import NamedTuple

import numpy as np

from optimizer.numerics.arrays import Real
from optimizer.program.kernel.compiling import inner
from optimizer.program.kernel.stages import CENTRALITY, OPEN, RESERVE

#: first stage: product of slack and multiplier of a web at the start, the same within a budget, what sizes are above
#: their vectors, share of its size that a web has along a sector, and share of a budget that is spent at most
_PRODUCT, _PRODUCT_IN_BUDGET, _ABOVE_VECTOR, _ALONG, _SPENT = 0.1, 0.02, 0.1, 0.6, 0.85
#: second stage: what the size of the multiplier of a web is above its mass at least
_ABOVE_MASS = 0.05


class Discs(NamedTuple):
    """Scaled programs of one row of J terms; Q vectors are the terms, then what is below I ceilings.

    Those that are solved, n of N; of the vectors (N, ...) the first Q.
    """

    basis: np.ndarray  # (Q,) whether a vector is a multiple of the first influence, 0, or of the second, 1
    multiple: Real  # (N, Q)
    constant: Real  # (N, Q, 2)
    influence: Real  # (N, 2, K) of full reach, on force and moment
    mass: Real  # (N, K) mass at full reach
    budget: Real  # (N, K) the same relative to the budget; 0 without one
    cap: Real  # (N, I)
    #: (N, 5, K) x and y of the normal of either edge, then 1, all 0 of a web without a sector; (N, 5, 0) if all are
    normals: Real
    numbers: np.ndarray  # (n,) the programs to solve


@inner
def begin_first(programs, n, budgeted, cost, where):  # type: ignore[no-untyped-def]
    """The first stage: nothing on free webs, others along their sectors, and sizes above the vectors."""
    vectors, webs = programs.basis.size, cost.size
    terms, at_prices = vectors - programs.cap.shape[1], 6 * webs + 4 * vectors
    for k in range(webs):
        where[2 * webs + k] = 1.0
    price, product = 0.0, _PRODUCT
    if budgeted:
        # near the middle of 0 <= x <= 1 and the budget, as if the rest of it were two even shares
        full, product = 0.0, _PRODUCT_IN_BUDGET
        for k in range(webs):
            cost[k] = programs.budget[n, k]
            worth = 0.5 * cost[k] * (webs + 1.0)
            where[2 * webs + k] = 2.0 / (2.0 + worth + np.sqrt(4.0 + worth * worth))
            full += cost[k] * where[2 * webs + k]
        for k in range(webs):
            where[2 * webs + k] *= min(_SPENT / full, 1.0)
        price = product / (1.0 - min(full, _SPENT))
    where[at_prices], where[at_prices + 1] = 1.0, price
    for k in range(webs):
        where[3 * webs + k] = max(product / where[2 * webs + k], price * cost[k] + product)
    for k in range(programs.normals.shape[2]):
        normals = programs.normals[n]
        grip = 1.0
        if normals[4, k] > 0.0:
            # both normals together point along the centre, and are twice the sine
            along_x, along_y = normals[0, k] + normals[2, k], normals[1, k] + normals[3, k]
            twice = np.sqrt(along_x * along_x + along_y * along_y)
            along = _ALONG * where[2 * webs + k] / twice
            where[k], where[webs + k] = along * along_x, along * along_y
            # the edges hold it where it is
            where[3 * webs + k] /= 1.0 - _ALONG * _ALONG
            pull = _ALONG * where[3 * webs + k]
            where[4 * webs + k], where[5 * webs + k] = -pull * along_x / twice, -pull * along_y / twice
            grip = pull / twice
        where[at_prices + 2 + k] = where[at_prices + 2 + webs + k] = grip
    for j in range(vectors):
        at = 6 * webs + 4 * j
        vx, vy = _vector(programs, n, j, where)
        size = np.sqrt(vx * vx + vy * vy) + _ABOVE_VECTOR
        where[at + 2], where[at + 3] = (size, 1.0) if j < terms else (max(size, programs.cap[n, j - terms]), 0.5)


@inner
def begin_second(programs, n, budgeted, share, gap, end, cost, where):  # type: ignore[no-untyped-def]
    """The second stage, from where the first one ended and the middle of the optima; its unit of mass and target."""
    vectors, webs = programs.basis.size, cost.size
    terms, at_prices = vectors - programs.cap.shape[1], 6 * webs + 4 * vectors
    total, value, sizes = 0.0, 0.0, 0.0
    for k in range(webs):
        total += programs.mass[n, k] * np.sqrt(end[k] ** 2 + end[webs + k] ** 2)
    # a first stage that did not end well may be anywhere
    unit = total if 0.0 < total < np.inf else 1.0
    for j in range(terms):
        vx, vy = _vector(programs, n, j, end)
        value += np.sqrt(vx * vx + vy * vy)
        sizes += where[6 * webs + 4 * j + 2]
    # what the first stage leaves open is kept back, so that the lightest is an optimum for certain
    most = value + share * (1.0 - RESERVE) - OPEN * gap
    # every multiplier at the price of the objective
    price = CENTRALITY / max(most - sizes, 1e-300)
    if budgeted:
        # the price of the budget becomes that of the mass, which is what the multipliers of the webs stand against
        for k in range(webs):
            if programs.budget[n, k] > 0.0:
                price = min(price, programs.mass[n, k] / (unit * programs.budget[n, k] * where[at_prices + 1]))
    # the first stage ended with an optimum within the budget, and none that is lighter is beyond it
    where[at_prices], where[at_prices + 1] = price, 1.0
    for j in range(vectors):
        at = 6 * webs + 4 * j
        where[at], where[at + 1], where[at + 3] = where[at] * price, where[at + 1] * price, where[at + 3] * price
    for k in range(webs):
        px, py = 0.0, 0.0
        for j in range(vectors):
            h, at = programs.multiple[n, j] * programs.influence[n, programs.basis[j], k], 6 * webs + 4 * j
            px -= h * where[at]
            py -= h * where[at + 1]
        if programs.normals.shape[2] > 0:
            normals = programs.normals[n]
            for i in range(2):
                at = at_prices + 2 + i * webs + k
                where[at] *= price if normals[4, k] > 0.0 else 1.0
                px -= where[at] * normals[2 * i, k]
                py -= where[at] * normals[2 * i + 1, k]
        vx, vy = where[k], where[webs + k]
        cost[k] = programs.mass[n, k] / unit
        # in the middle between |v| and 1
        x = (1.0 + np.sqrt(1.0 + 3.0 * (vx * vx + vy * vy))) / 3.0
        # no farther above p for a full web: there is next to nothing left for its size, and the gap would be huge
        z = max(np.sqrt(px * px + py * py) + CENTRALITY, cost[k] + _ABOVE_MASS)
        where[2 * webs + k], where[3 * webs + k], where[4 * webs + k], where[5 * webs + k] = x, z, px, py
    return unit, most


@inner
def _vector(programs, n, j, where):  # type: ignore[no-untyped-def]
    """Vector j of program n at a state."""
    vx, vy, webs = programs.constant[n, j, 0], programs.constant[n, j, 1], programs.mass.shape[1]
    for k in range(webs):
        h = programs.multiple[n, j] * programs.influence[n, programs.basis[j], k]
        vx += h * where[k]
        vy += h * where[webs + k]
    return vx, vy
