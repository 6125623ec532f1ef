"""Pairs of phasors as ellipses in plain numbers: some are read at once, for few cost by their number."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from optimizer.mechanics.angles import angle_deg
from optimizer.responses.response import Phasors


class Ellipse(NamedTuple):
    """How the vector of one pair moves.

    co, counter : magnitudes of both phasors.
    peak, minor : semi-axes.
    axis_deg : direction of the major axis, from 0 up to 180; 0 for a circle.
    co_deg, counter_deg : directions of both phasors at shaft angle 0, from 0 up to 360.
    """

    co: float
    counter: float
    peak: float
    minor: float
    axis_deg: float
    co_deg: float
    counter_deg: float


def ellipses(pairs: Sequence[Phasors]) -> list[Ellipse]:
    """Those of pairs of one machine."""
    both = np.array([(pair.co, pair.counter) for pair in pairs]).T
    every, (co, counter) = Phasors(*both), np.abs(both)
    of_co, of_counter = angle_deg(both)
    columns = np.array([co, counter, co + counter, np.abs(co - counter), every.major_axis_deg, of_co, of_counter])
    return [Ellipse(*column) for column in columns.T.tolist()]
