"""Sweeps: the request, its axes, the columns of its result, and what is answered about it."""

from schemas.outputs import Column
from schemas.sweep.answers import JobState, SweepColumn, SweepEstimate, SweepLinks, SweepState
from schemas.sweep.axes import MAX_DESIGNS, Axis
from schemas.sweep.request import SweepRequest, TopFilter
from schemas.target import Target, pointer

__all__ = [
    "MAX_DESIGNS",
    "Axis",
    "Column",
    "JobState",
    "SweepColumn",
    "SweepEstimate",
    "SweepLinks",
    "SweepRequest",
    "SweepState",
    "Target",
    "TopFilter",
    "pointer",
]
