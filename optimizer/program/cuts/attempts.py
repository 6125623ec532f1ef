"""Settings of clarabel for one program of a stage by cuts, in order: the next is tried where the gap stays open."""

from typing import NamedTuple


class Attempt(NamedTuple):
    """How a program is solved."""

    tolerance: float  # of the solver
    margins: float  # multiple of what is kept back
    boosted: bool  # cones about the last point
    regularization: float  # of the solver


#: of a goal with nothing to be kept: where bearings share their peaks, boosts cost more digits than they show
FREELY = (
    Attempt(1e-10, 1.0, True, 1e-8),
    Attempt(1e-10, 1.0, False, 1e-8),
    Attempt(1e-12, 1.0, True, 1e-8),
    Attempt(1e-10, 1.0, False, 1e-10),
)
#: under goals and ceilings that leave a thin room
WITHIN = (
    Attempt(1e-10, 1.0, True, 1e-8),
    Attempt(1e-10, 1.0, True, 1e-11),
    Attempt(1e-10, 20.0, True, 1e-8),
    Attempt(1e-12, 1.0, True, 1e-8),
    Attempt(1e-8, 50.0, True, 1e-8),
    # goals so steep in one another that what is kept back leaves no room; the second time by what the first missed
    Attempt(1e-10, 0.1, True, 1e-8),
    Attempt(1e-10, 0.1, True, 1e-8),
    Attempt(1e-10, 0.1, True, 1e-8),
)
