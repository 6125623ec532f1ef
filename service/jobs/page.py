"""A page of the list of sweeps."""

from pydantic import Field

from schemas.base.model import Model
from schemas.sweep.answers import SweepState


class SweepPage(Model):
    """Sweeps, newest first."""

    sweeps: tuple[SweepState, ...] = Field(description="states of the sweeps", examples=[[]])
    next: str | None = Field(description="where older ones are; null where there are none", examples=[None])
