"""Main bearings: influences and bending moments of both shaft models.

Reference for the continuous shaft: deflection of a free beam by Macaulay's brackets, held to 0 at the bearings, with
both balances, as one linear system at 50 digits (the mechanics have the equation of three moments). Loads are
measured against the largest in the same column, moments against the largest along the shaft with one-sided terms
taken without regard for their signs.
"""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from optimizer.mechanics.bearings import bending_moment, continuous_beam_influence, simple_spans_influence
from tests.hard_effects.case import ALGEBRAIC, Case, Finding, error
from tests.hard_effects.exact import Number, mp


class Shaft(NamedTuple):
    """Bearings and planes of loads, m."""

    name: str
    why: str
    bearings: list[float]
    loads: list[float]


_RNG = np.random.default_rng(11)

SHAFTS = (
    Shaft("ordinary", "none: for comparison", [0.0, 0.5, 1.1], [-0.2, 0.2, 0.8, 1.4]),
    Shaft(
        "spans of 1e-5 and 1e3 m",
        "eight decades of spans share support moments",
        [0.0, 1e-5, 1000.0, 1000.5],
        [-1.0, 5e-6, 3.0, 1000.2],
    ),
    Shaft(
        "shaft at 1e6 m", "every length is a small difference", [1e6, 1e6 + 0.25, 1e6 + 1.0], [1e6 - 0.125, 1e6 + 0.7]
    ),
    Shaft(
        "load 1e-12 m beside a bearing",
        "the far bearing carries 1e-12",
        [0.0, 1.0, 2.0],
        [1e-12, 1.0 - 1e-12, 2.0 + 1e-12],
    ),
    Shaft("overhang of 1e6 spans", "bearing loads 1e6 times the load, of opposite signs", [0.0, 1.0], [1e6, -1e6, 0.5]),
    Shaft(
        "bearings 1e-8 of the shaft apart",
        "support moments of a span that is almost nothing",
        [0.0, 1.0, 1.0 + 1e-8, 2.0],
        [0.3, 1.0 + 5e-9, 1.7, 2.5],
    ),
    Shaft(
        "thirty bearings",
        "influence falls by 0.27 a span over 29 spans: from 1 to 1e-16",
        [float(k) for k in range(30)],
        [0.5, 14.5, 29.5],
    ),
    Shaft(
        "thirty random bearings",
        "spans of all sizes, in any order",
        _RNG.permutation(np.cumsum(10.0 ** _RNG.uniform(-4, 1, 30))).tolist(),
        _RNG.uniform(-5.0, 60.0, 12).tolist(),
    ),
    Shaft("loads on the bearings", "shares are exactly 1 and 0", [0.0, 0.3, 0.7, 1.9], [0.0, 0.3, 0.7, 1.9]),
)


def _macaulay(bearings: list[Number], load: Number) -> list[Number]:
    n = len(bearings)
    matrix, right = mp.zeros(n + 2), mp.zeros(n + 2, 1)
    for i, at in enumerate(bearings):
        # deflection a + b x + (load (x - z)^3+ - sum R (x - z_i)^3+) / 6 = 0
        matrix[i, n], matrix[i, n + 1] = mp.mpf(1), at
        for j, bearing in enumerate(bearings):
            matrix[i, j] = -(max(at - bearing, mp.mpf(0)) ** 3) / 6
        right[i] = -(max(at - load, mp.mpf(0)) ** 3) / 6
        matrix[n, i], matrix[n + 1, i] = mp.mpf(1), at
    right[n], right[n + 1] = mp.mpf(1), load
    return list(mp.lu_solve(matrix, right))[:n]


def _hinged(bearings: list[Number], load: Number) -> list[Number]:
    order = sorted(range(len(bearings)), key=lambda i: bearings[i])
    inner = [i for i in order[1:-1] if bearings[i] <= load]
    left = inner[-1] if inner else order[0]
    right = order[order.index(left) + 1]
    share = (load - bearings[left]) / (bearings[right] - bearings[left])
    return [1 - share if i == left else share if i == right else mp.mpf(0) for i in range(len(bearings))]


def _measure(shaft: Shaft) -> Iterator[Finding]:
    bearings, loads = np.array(shaft.bearings), np.array(shaft.loads)
    with mp.workdps(110):  # cubes of nine decades
        places, planes = [mp.mpf(z) for z in shaft.bearings], [mp.mpf(z) for z in shaft.loads]
        exact = {
            "continuous": [_macaulay([p - places[0] for p in places], z - places[0]) for z in planes],
            "hinged": [_hinged(places, z) for z in planes],
        }
    got = {"continuous": continuous_beam_influence(bearings, loads), "hinged": simple_spans_influence(bearings, loads)}
    stations = np.unique(np.concatenate([bearings, loads]))
    for model, columns in exact.items():
        off = max(error(got[model][:, k], column) for k, column in enumerate(columns))
        yield Finding(f"bearing loads, {model}", off, ALGEBRAIC)
        worst = 0.0
        for k, column in enumerate(columns):
            moments, size = [], mp.mpf(0)
            for station in map(mp.mpf, stations.tolist()):
                terms = [r * max(station - x, 0) for r, x in zip(column, places, strict=True)]
                terms.append(-max(station - planes[k], mp.mpf(0)))
                moments.append(sum(terms))
                nearer = [r * max(x - station, 0) for r, x in zip(column, places, strict=True)]
                size = max(size, min(sum(map(abs, terms)), sum(map(abs, nearer)) + max(planes[k] - station, 0)))
            moment = bending_moment(bearings, got[model][:, k : k + 1], loads[k : k + 1], np.ones((1, 1)), stations)
            worst = max(worst, error(moment[:, 0], moments, size))
        yield Finding(f"bending moment, {model}", worst, ALGEBRAIC)


CASES = tuple(Case("bearings", shaft.name, shaft.why, lambda shaft=shaft: _measure(shaft)) for shaft in SHAFTS)
