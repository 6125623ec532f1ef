"""How closely an optimum is wanted: what the searches need of the accuracy and the objective of a request."""

from typing import NamedTuple

from schemas.request.requests import Accuracy, OptimizeRequest


class Demand(NamedTuple):
    """How closely an optimum is wanted, and how long a search may take."""

    relative_gap: float  # relative to the yardstick of the objective
    least_mass: bool  # take the least total mass among the optima
    time_limit_s: float


def demand(request: OptimizeRequest) -> Demand:
    """What a request says."""
    accuracy = request.accuracy
    return Demand(accuracy.relative_gap, request.objective.least_mass, accuracy.time_limit_s)


def of_any_mass(request: OptimizeRequest) -> Demand:
    """Of the optimum without a catalogue, any mass at any angle, that a search of choices begins with."""
    return Demand(Accuracy().relative_gap, False, request.accuracy.time_limit_s)
