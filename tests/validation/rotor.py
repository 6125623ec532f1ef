"""Min-max balancing of a flexible rotor from measured influence coefficients, a published problem of the same form.

W. C. Foiles, P. E. Allaire and E. J. Gunter, Min-max optimum flexible rotor balancing compared to weighted least
squares (IMechE 2000), as quoted in the tests of hsbalance: 11 readings of vibration and 4 planes, no weight above
3.402. It is the program of docs/mathematics.md section 4 with complex influences: the largest |A + alpha W|.
"""

from collections.abc import Iterator

import numpy as np

from optimizer.mechanics.angles import direction
from optimizer.numerics.arrays import Complex
from optimizer.program.limits import Limits
from optimizer.program.methods.optima import optima
from optimizer.program.rows import Row, statement, weighted_peak
from optimizer.program.solution import ConeSolution
from optimizer.responses.response import Phasors, Response
from tests.validation.comparison import Comparison, Misprint

_MOST = 3.402
# fmt: off
_INFLUENCE = (
    (9.8, 117), (17, 124), (7.2, 114), (38.5, 77),
    (2.7, 43), (14.3, 317), (4.5, 213), (14.3, 270),
    (12.5, 323), (25, 261), (15.2, 158), (30, 238),
    (22.4, 92), (32.6, 45), (23.3, 315), (27.8, 210),
    (26, 94), (40.3, 9), (25, 330), (34, 213),
    (40.3, 355), (43, 144), (29.6, 61), (65.4, 322),
    (20.6, 339), (32.3, 152), (36.7, 41), (61.8, 322),
    (12.6, 226), (37.6, 52), (18.8, 153), (26, 176),
    (13.4, 209), (26.9, 76), (47.5, 98), (71.7, 312),
    (13.4, 154), (22.4, 307), (52, 299), (102, 165),
    (5.4, 24), (7.2, 199), (22.4, 2), (27.8, 99),
)
_READINGS = (
    (55, 259), (45, 118), (124, 21), (138, 349), (107, 349), (90, 280), (58, 354), (108, 201), (88, 190), (56, 48),
    (73, 158),
)
#: as published
_WEIGHTS = ((3.402, 91), (2.325, 354), (1.361, 318), (1.786, 305))
# fmt: on


def _vectors(pairs: tuple[tuple[float, float], ...]) -> Complex:
    size, angle = np.array(pairs, dtype=float).T
    extent: Complex = size * direction(angle)
    return extent


_NAME = "rotor of Foiles, Allaire and Gunter"


def _solution() -> ConeSolution:
    rows = [
        Row(
            str(k),
            (weighted_peak(Response(str(k), "N", Phasors(np.asarray(reading), np.asarray(0j)), influence), 1.0),),
        )
        for k, (reading, influence) in enumerate(zip(_vectors(_READINGS), _influence(), strict=True))
    ]
    free, ones = np.ones(4, bool), np.ones(4)
    limits = Limits(ones, _MOST * ones, free, ones + 0j, 0.0 * ones, ones, np.asarray(np.inf))
    solution = optima(statement([rows], [], limits).alone(), 1e-7, False).single()
    assert isinstance(solution, ConeSolution)
    return solution


def _influence() -> Complex:
    return _vectors(_INFLUENCE).reshape(11, 4)


def _left(weights: Complex) -> float:
    return float(np.max(np.abs(_vectors(_READINGS) + _influence() @ weights)))


def comparisons() -> Iterator[Comparison]:
    solution, theirs = _solution(), _vectors(_WEIGHTS)
    # what half a digit of each weight and half a degree may change
    printing = float(np.max(np.abs(_influence()) @ (5e-4 + np.abs(theirs) * np.deg2rad(0.5))))
    yield Comparison(_NAME, "largest vibration left", "published", _left(theirs), solution.objective, printing, "-")
    bound = "the same, proven for all weights"
    yield Comparison(_NAME, bound, "independent", solution.objective, solution.lower_bound, 1e-5, "-")
    for k, (weight, ours) in enumerate(zip(theirs, solution.unbalance, strict=True)):
        sizes = float(np.abs(weight)), float(np.abs(ours))
        yield Comparison(_NAME, f"weight in plane {k + 1}", "published", *sizes, 0.01, "-")
        angle = float(_WEIGHTS[k][1])
        # a maximum that is flat is found to a degree by methods of a few digits
        if k != 3:
            off = float(np.rad2deg(np.angle(ours / weight)))
            yield Comparison(_NAME, f"its angle in plane {k + 1}", "published", angle, angle + off, 1.0, "deg")


def misprints() -> Iterator[Misprint]:
    """The angle of plane 4: the best one for the other weights as printed, by trying all of them."""
    *vectors, last = _vectors(_WEIGHTS)
    angles = np.arange(295.0, 325.0, 0.01)
    left = [_left(np.array([*vectors, np.abs(last) * direction(angle)])) for angle in angles]
    ours = float(np.mod(np.rad2deg(np.angle(_solution().unbalance[3])), 360.0))
    right = Comparison(_NAME, "angle in plane 4", "independent", float(angles[np.argmin(left)]), ours, 1.0, "deg")
    reason = f"with it {_left(_vectors(_WEIGHTS)):.4g} is left, with the right one {min(left):.4g}"
    yield Misprint("Foiles, Allaire and Gunter, as quoted", "weight in plane 4, angle", 305.0, right, reason)
