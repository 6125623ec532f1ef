"""What the peaks of curves come to at least, whatever is added to them: the smallest circles around the curves."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from optimizer.numerics.arrays import Complex, Real
from optimizer.numerics.enclosing_circle import Circle


class Floor(NamedTuple):
    """What the peak of a curve comes to at least, whatever the counterweights."""

    circle: Circle  # around some points of the curve; no constant brings the peak below its radius
    angle: Real  # (support,) rad, of the points that hold it
    value: Complex  # (support,) the curve there
    upper: Real  # proven peak about the circle's centre, () : the floor is between the radius and this


class Floors(NamedTuple):
    """The same of J curves: circles around some points of each, and their proven peaks about the centres."""

    centre: Complex  # (J,)
    radius: Real  # (J,)
    upper: Real  # (J,)
    angle: Real  # (J, 3) rad, of the points that hold a circle, as many as there are
    value: Complex  # (J, 3)
    weights: Real  # (J, 3)
    counts: NDArray[np.intp]  # (J,) how many

    def floor(self, number: int) -> Floor:
        """That of one curve, with the points that hold its circle."""
        support = np.arange(self.counts[number])
        circle = Circle(
            complex(self.centre[number]), float(self.radius[number]), support, self.weights[number, support]
        )
        return Floor(circle, self.angle[number, support], self.value[number, support], self.upper[number])
